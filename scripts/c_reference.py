#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Makes the reference of the C interface from its headers: MkDocs calls it to put that on the page reference/c.md.

    scripts/c_reference.py

Prints the reference; the status is 1 if a function or a header is not in it.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
HEADERS = ("base", "surfaces", "arrangement", "mesh", "sealing", "structure", "model", "reconstruction",
           "selection", "tetrahedra", "verification", "certificate", "project")

def prose(comment):
    """The text of comment lines, with names of the interface as code."""
    text = " ".join(line.strip().removeprefix("///").removeprefix("//").strip() for line in comment)
    text = re.sub(r"(?<![`\w])(\*?(?:terrane|TERRANE)_\w+|options->\w+|sizeof\(\w+\)|\w+ \+ offsets\[[^]]*\]|\*\w+|<terrane/terrane\.h>)(?!`)",
                  r"`\1`", text)
    return text.replace("|", "\\|").strip()


def rules():
    """The numbered rules at the top of terrane.h."""
    lines = [line[3:] for line in (ROOT / "terrane.h").read_text().splitlines() if line.startswith("// ")]
    text = " ".join(line.strip() for line in lines)
    items = re.split(r"\((\d+)\) ", text)[1:]
    return "".join(f"{number}. {prose([item])}\n" for number, item in zip(items[::2], items[1::2]))


def members(body):
    """Declaration and comment of each member of a struct or enum."""
    found = []
    for line in body.splitlines():
        code, _, comment = line.partition("///<")
        if code.strip():
            found.append([code.strip().rstrip(",;"), comment.strip()])
        elif found:
            found[-1][1] += " " + comment.strip()
    return found


def table(first, rows):
    lines = [f"| {first} | |", "|---|---|"]
    return "\n".join(lines + [f"| `{name}` | {prose([text])} |" for name, text in rows]) + "\n"


def entries(text):
    """Comment, kind and code of each declaration of a header, in order."""
    pattern = re.compile(
        r"((?:^///[^\n]*\n)+)"
        r"(?:^TERRANE_API ([^;]*);|^typedef struct (\w+) \{\n(.*?)^\}|^typedef (struct \w+ \w+);"
        r"|^typedef int32_t (\w+);\nenum \{\n(.*?)^\};|^typedef ((?:int|void) \(\*\w+\)[^;]*);|^#define (\w+) (\S+))",
        re.M | re.S)
    return list(pattern.finditer(text))


def entry(found):
    """One declaration as Markdown."""
    comment, function, struct, body, handle, enum, values, callback, name, value = found.groups()
    text = prose(comment.splitlines())
    if function:
        code = re.sub(r"\s+", " ", function).replace("( ", "(")
        title = re.search(r"(\w+)\(", code)[1]
        return f"### `{title}`\n\n```c\n{wrapped(code)};\n```\n\n{text}\n"
    if struct:
        return f"### `{struct}`\n\n{text}\n\n{table('Member', members(body))}"
    if handle:
        return f"### `{handle.split()[-1]}`\n\n{text}\n"
    if enum:
        return f"### `{enum}`\n\n{text}\n\n{table('Value', members(values))}"
    if callback:
        code = re.sub(r"\s+", " ", callback)
        return f"### `{re.search(r'[*](.*?)[)]', code)[1]}`\n\n```c\n{wrapped(code)};\n```\n\n{text}\n"
    return f"### `{name}`\n\n`{value}`: {text}\n"


def wrapped(code, width=100):
    """A declaration in lines of at most `width` characters, broken after commas."""
    if len(code) < width:
        return code
    indent, lines = " " * (code.index("(") + 1), [""]
    for part in re.split(r"(?<=,) ", code):
        if len(lines[-1]) + len(part) + 1 > width:
            lines.append(indent + part)
        else:
            lines[-1] += (" " if lines[-1] else "") + part
    return "\n".join(lines)


def reference():
    """The rules and all declarations."""
    text = "\n## Rules\n\n" + rules()
    for header in HEADERS:
        source = (ROOT / f"capi/{header}.h").read_text()
        purpose = re.match(r"// SPDX[^\n]*\n//\n((?://[^\n]*\n)+)", source)[1]
        text += f"\n## {header.capitalize()}\n\n{prose(purpose.splitlines())}\n\n"
        text += "\n".join(entry(found) for found in entries(source))
    return text


def on_page_markdown(markdown, page, **_):
    """MkDocs: a page as it is, and the reference below that of C."""
    return markdown + reference() if page.file.src_path == "reference/c.md" else markdown


def main():
    text = reference()
    declared = set(re.findall(r"^TERRANE_API [^;(]*?(\w+)\(",
                              "".join((ROOT / f"capi/{h}.h").read_text() for h in HEADERS), re.M))
    missing = {name for name in declared if f"### `{name}`" not in text}
    unlisted = {p.stem for p in (ROOT / "capi").glob("*.h")} ^ set(HEADERS)
    if missing or unlisted or len(declared) < 100:
        sys.exit(f"c_reference: not documented: {sorted(missing | unlisted)}, of {len(declared)} functions")
    print(text, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
