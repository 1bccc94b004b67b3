# SPDX-License-Identifier: LGPL-3.0-or-later
"""Lies in the text of a certificate, which certificate-format.md rules out: functions of the text and random numbers,
which return another text, or None. TEXT_LIES has with each the sentence that it breaks."""
import re

TEXT_LIES = {}


def text_lie(sentence):
    def add(function):
        TEXT_LIES[function.__name__] = (function, sentence)
        return function
    return add


def at_random(rng, pattern, text, replace):
    """Replaces one of the matches of a pattern."""
    found = list(re.finditer(pattern, text))
    if not found:
        return None
    one = rng.choice(found)
    return text[:one.start()] + replace(one) + text[one.end():]


INDEX = r"(?<=[\[,])\d+(?=[\],])"
NUMBER = r'"-?\d+(?:\.\d+)?"(?=[\],])'
KEY = r'"(?:exact|inputs|outputs|kind|version|triangles|name|bytes|surfaces|vertices)":'
KEYS_ONCE = "each object has these keys and no others, each once"
WHOLE = "numbers are whole and without sign, fraction or exponent"
AROUND = "nothing stands before the text or behind it"
SHORTEST = "x, y, z as text: the shortest decimals that read back as the same doubles"


@text_lie(KEYS_ONCE)
def a_kind_twice(text, rng):
    return text.replace('"kind":', '"kind":"arrangement","kind":', 1)


@text_lie(KEYS_ONCE)
def the_last_kind_counts(text, rng):
    return text.replace('"version":2,', '"version":2,"kind":"filled",', 1)


@text_lie(KEYS_ONCE)
def inputs_twice(text, rng):
    return text.replace('"inputs":', '"inputs":[],"inputs":', 1)


@text_lie(KEYS_ONCE)
def a_key_twice_once_escaped(text, rng):
    return text.replace('"inputs":', '"\\u0069nputs":[],"inputs":', 1)


@text_lie(KEYS_ONCE)
def a_key_inside_an_object_twice(text, rng):
    return at_random(rng, r'"bytes":(\d+)', text, lambda m: f'"bytes":{int(m[1]) + 1},{m[0]}')


@text_lie(KEYS_ONCE)
def an_unknown_key(text, rng):
    return at_random(rng, KEY, text, lambda m: f'"note":"checked by hand",{m[0]}')


@text_lie(KEYS_ONCE)
def a_key_that_another_kind_has(text, rng):
    key = rng.choice([k for k in ("layered", "filled", "improved", "tetrahedra") if f'"{k}":' not in text])
    return text.replace('"inputs":', f'"{key}":null,"inputs":', 1)


@text_lie(KEYS_ONCE)
def a_key_missing(text, rng):
    return at_random(rng, r'"(?:role|bytes|name)":[^,}]*,', text, lambda m: "")


@text_lie(KEYS_ONCE)
def a_key_in_capitals(text, rng):
    return at_random(rng, KEY, text, lambda m: m[0].capitalize().upper())


@text_lie(WHOLE)
def an_index_with_a_sign(text, rng):
    return at_random(rng, INDEX, text, lambda m: "+" + m[0])


@text_lie(WHOLE)
def an_index_below_nothing(text, rng):
    return at_random(rng, INDEX, text, lambda m: "-" + m[0])


@text_lie(WHOLE)
def an_index_with_a_fraction(text, rng):
    return at_random(rng, INDEX, text, lambda m: m[0] + ".0")


@text_lie(WHOLE)
def an_index_with_an_exponent(text, rng):
    return at_random(rng, INDEX, text, lambda m: m[0] + "e0")


@text_lie(WHOLE)
def an_index_with_zeros_before(text, rng):
    return at_random(rng, INDEX, text, lambda m: "0" + m[0])


@text_lie(WHOLE)
def an_index_in_hexadecimal(text, rng):
    return at_random(rng, INDEX, text, lambda m: hex(int(m[0])))


@text_lie("R1: an index is out of range")
def an_index_behind_32_bits(text, rng):
    return at_random(rng, INDEX, text, lambda m: str(int(m[0]) + 2 ** 32))


@text_lie("R1: an index is out of range")
def an_index_behind_64_bits(text, rng):
    return at_random(rng, INDEX, text, lambda m: str(int(m[0]) + 2 ** 64))


@text_lie("R1: an index is out of range")
def an_index_of_a_thousand_digits(text, rng):
    return at_random(rng, INDEX, text, lambda m: "9" * 1000)


@text_lie("version: 2")
def a_version_behind_64_bits(text, rng):
    return text.replace('"version":2', f'"version":{2 ** 64 + 2}', 1)


@text_lie("version: 2")
def a_later_version(text, rng):
    return text.replace('"version":2', '"version":3', 1)


@text_lie("kind: one of eight")
def a_kind_with_a_blank(text, rng):
    return re.sub(r'"kind":"(\w+)"', r'"kind":"\1 "', text, count=1)


@text_lie(AROUND)
def a_byte_order_mark(text, rng):
    return "\ufeff" + text


@text_lie(AROUND)
def a_second_certificate_behind(text, rng):
    return text + text


@text_lie(AROUND)
def a_bracket_behind(text, rng):
    return text + "}"


@text_lie(AROUND)
def a_zero_behind(text, rng):
    return text + "\0"


@text_lie("a certificate is JSON")
def a_comment(text, rng):
    return at_random(rng, KEY, text, lambda m: "/* */" + m[0])


@text_lie("a certificate is JSON")
def a_comma_behind_the_last(text, rng):
    return at_random(rng, r"\d\]", text, lambda m: m[0][0] + ",]")


@text_lie("a certificate is JSON")
def half_of_the_text(text, rng):
    return text[:rng.randrange(1, len(text) - 2)]


@text_lie("a certificate is JSON")
def single_quotes(text, rng):
    return at_random(rng, KEY, text, lambda m: m[0].replace('"', "'"))


@text_lie("a certificate is JSON")
def lists_without_end(text, rng):
    return at_random(rng, KEY, text, lambda m: m[0] + "[" * 100000)


@text_lie("a certificate is JSON in UTF-8")
def half_of_a_character(text, rng):
    return at_random(rng, r'"name":"', text, lambda m: m[0] + "\\ud800")


@text_lie("a certificate is JSON in UTF-8")
def a_character_spelled_too_long(text, rng):
    return at_random(rng, r'"name":"', text, lambda m: m[0] + "\udcc0\udcaf")  # written as the bytes c0 af


@text_lie("a certificate is JSON in UTF-8")
def a_line_feed_in_a_name(text, rng):
    return at_random(rng, r'"name":"', text, lambda m: m[0] + "\n")


@text_lie(SHORTEST)
def a_coordinate_with_a_digit_too_many(text, rng):
    return at_random(rng, NUMBER, text, lambda m: m[0][:-1] + ("0" if "." in m[0] else ".0") + '"')


@text_lie(SHORTEST)
def a_coordinate_with_a_sign(text, rng):
    return at_random(rng, NUMBER, text, lambda m: '"+' + m[0][1:] if m[0][1] != "-" else '"-0' + m[0][2:])


@text_lie(SHORTEST)
def a_coordinate_with_a_blank(text, rng):
    return at_random(rng, NUMBER, text, lambda m: '" ' + m[0][1:])


@text_lie(SHORTEST)
def a_coordinate_with_an_exponent(text, rng):
    return at_random(rng, NUMBER, text, lambda m: m[0][:-1] + 'e0"')


@text_lie(SHORTEST)
def a_coordinate_with_a_zero_byte(text, rng):
    return at_random(rng, NUMBER, text, lambda m: m[0][:-1] + '\\u0000"')


@text_lie(SHORTEST)
def a_coordinate_without_quotes(text, rng):
    return at_random(rng, NUMBER, text, lambda m: m[0][1:-1])


@text_lie("R10, R22, R28, R40, R53, R60: a number is not finite")
def a_coordinate_that_is_none(text, rng):
    return at_random(rng, NUMBER, text, lambda m: rng.choice(('"nan"', '"inf"', '"1e309"', '"-inf"', '""')))


@text_lie("sha256: 64 lower-case hexadecimal digits")
def a_hash_in_capitals(text, rng):
    return re.sub(r'"sha256":"(\w+)"', lambda m: f'"sha256":"{m[1].upper()}"', text, count=1)


@text_lie("sha256: 64 lower-case hexadecimal digits")
def a_hash_that_is_too_short(text, rng):
    return at_random(rng, r'"sha256":"\w', text, lambda m: m[0][:-1])


@text_lie("the digest is a hash of the geometry")
def no_digest(text, rng):
    return re.sub(r'"digest":"[^"]*"', '"digest":""', text) if '"digest":' in text else None


@text_lie("the digest is a hash of the geometry")
def a_digest_by_another_name(text, rng):
    return text.replace('"digest":"sha256:', '"digest":"SHA256:') if '"digest":' in text else None
