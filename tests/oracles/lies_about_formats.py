# SPDX-License-Identifier: LGPL-3.0-or-later
"""Lies in output files.

FILE_LIES change the bytes of a file: functions of them and random numbers, with the sentence that they break and the
formats in which they can be told. They return None where they can say nothing. The certificate then has the hash and
the size of what they return, so that only R21 is left."""
import base64
import re
import struct
import zlib

FILE_LIES = {}
EVERY_BYTE = "the certificate determines every byte of an output"


def adds_to(lies):
    def with_sentence(sentence=EVERY_BYTE, formats=None):
        def add(function):
            lies[function.__name__] = (function, sentence, formats)
            return function
        return add
    return with_sentence


file_lie = adds_to(FILE_LIES)

TEXTS = {"obj", "off", "ts", "stl-ascii", "msh", "msh22", "inp", "json"}
VTK = {"vtp", "vtu"}


# ---- Any format

@file_lie()
def a_bit_turned(data, rng):
    at = rng.randrange(len(data))
    return data[:at] + bytes([data[at] ^ 1 << rng.randrange(8)]) + data[at + 1:]


@file_lie()
def a_byte_behind(data, rng):
    return data + b"\n"


@file_lie()
def a_byte_before(data, rng):
    return b"\n" + data


@file_lie()
def the_last_byte_left_out(data, rng):
    return data[:-1]


@file_lie()
def an_empty_file(data, rng):
    return b""


@file_lie()
def the_file_twice(data, rng):
    return data + data


@file_lie()
def a_byte_missing(data, rng):
    at = rng.randrange(len(data))
    return data[:at] + data[at + 1:]


# ---- Lines of text

def lines(data):
    return data.split(b"\n")


@file_lie(formats=TEXTS | VTK)
def ends_of_lines_of_windows(data, rng):
    return data.replace(b"\n", b"\r\n")


@file_lie(formats=TEXTS | VTK)
def a_mark_of_byte_order(data, rng):
    return b"\xef\xbb\xbf" + data


@file_lie(formats=TEXTS)
def a_line_twice(data, rng):
    all_lines = lines(data)
    at = rng.randrange(len(all_lines) - 1)
    return b"\n".join(all_lines[:at + 1] + all_lines[at:])


@file_lie(formats=TEXTS)
def a_line_missing(data, rng):
    all_lines = lines(data)
    del all_lines[rng.randrange(len(all_lines) - 1)]
    return b"\n".join(all_lines)


@file_lie(formats=TEXTS)
def two_lines_exchanged(data, rng):
    all_lines = lines(data)
    a, b = rng.sample(range(len(all_lines) - 1), 2)
    all_lines[a], all_lines[b] = all_lines[b], all_lines[a]
    return b"\n".join(all_lines)


@file_lie(formats=TEXTS)
def a_blank_at_the_end_of_a_line(data, rng):
    all_lines = lines(data)
    all_lines[rng.randrange(len(all_lines) - 1)] += b" "
    return b"\n".join(all_lines)


@file_lie(formats=TEXTS)
def a_digit_that_differs(data, rng):
    at = rng.choice([m.start() for m in re.finditer(rb"\d", data)])
    return data[:at] + (b"5" if data[at:at + 1] != b"5" else b"6") + data[at + 1:]


@file_lie("numbers are the shortest decimals", TEXTS)
def a_number_spelled_otherwise(data, rng):
    m = rng.choice(list(re.finditer(rb"(?<=[ ,\[:])-?\d+\.\d+", data)) or [None])
    return data[:m.end()] + b"0" + data[m.end():] if m else None


@file_lie("numbers are the doubles of the certificate", TEXTS)
def a_number_a_double_away(data, rng):
    m = rng.choice(list(re.finditer(rb"(?<=[ ,\[:])-?\d+\.\d{6,}", data)) or [None])
    if not m:
        return None
    bits = struct.unpack("<q", struct.pack("<d", float(m[0])))[0]
    return data[:m.start()] + repr(struct.unpack("<d", struct.pack("<q", bits + 1))[0]).encode() + data[m.end():]


@file_lie(formats={"obj", "off", "inp", "msh", "msh22", "ts"})
def a_comment_in_the_file(data, rng):
    mark = b"# " if not data.startswith(b"*") else b"** "
    all_lines = lines(data)
    all_lines.insert(rng.randrange(1, len(all_lines)), mark + b"sealed and checked")
    return b"\n".join(all_lines)


@file_lie("the file calls surfaces as the certificate says", {"obj", "ts", "ply", "vtp", "vtu", "msh", "inp", "json"})
def another_name_of_a_surface(data, rng):
    for name in (b"outer", b"top", b"cross", b"floor", b"holes", b"O"):
        codes = b"".join(b"%d " % c for c in name) + b"0\n"
        if codes in data:
            return data.replace(codes, b"%d" % (name[0] + 1) + codes[codes.index(b" "):], 1)
        if re.search(rb"(?m)(?<=[ \"])" + name + rb"(?=[\"\n])", data):
            return re.sub(rb"(?<=[ \"])" + name + rb"(?=[\"\n])", b"x" + name[1:], data, count=1)
    return None


@file_lie("triangles face the sides that the certificate says", {"obj", "off", "ts"})
def a_face_turned(data, rng):
    pattern = rb"(?m)^(f|3|TRGL) (\S+) (\S+) (\S+)"
    m = rng.choice(list(re.finditer(pattern, data)))
    return data[:m.start()] + b"%b %b %b %b" % (m[1], m[2], m[4], m[3]) + data[m.end():]


@file_lie("triangles begin with the corner that the certificate says", {"obj", "off", "ts"})
def a_face_that_begins_with_another_corner(data, rng):
    m = rng.choice(list(re.finditer(rb"(?m)^(f|3|TRGL) (\S+) (\S+) (\S+)", data)))
    return data[:m.start()] + b"%b %b %b %b" % (m[1], m[3], m[4], m[2]) + data[m.end():]


@file_lie(formats={"obj", "off", "ts", "inp", "msh22"})
def a_vertex_that_nothing_needs(data, rng):
    m = rng.choice(list(re.finditer(rb"(?m)^(v |VRTX \d+ |\d+,? )-?[\d.]+,? -?[\d.]+,? -?[\d.]+\n", data)) or [None])
    return data[:m.end()] + m[0] + data[m.end():] if m else None


@file_lie(formats={"ply"})
def another_property_of_ply(data, rng):
    return data.replace(b"end_header\n", b"comment sealed by hand\nend_header\n", 1)


@file_lie(formats={"ply"})
def another_order_of_bytes(data, rng):
    return data.replace(b"little_endian", b"big_endian", 1)


@file_lie("binary STL has the doubles rounded to float32", {"stl"})
def a_float_that_is_one_away(data, rng):
    at = 84 + 50 * rng.randrange((len(data) - 84) // 50) + 12 + 4 * rng.randrange(9)
    bits = struct.unpack("<I", data[at:at + 4])[0]
    return data[:at] + struct.pack("<I", bits + 1) + data[at + 4:]


@file_lie("every byte of binary STL", {"stl"})
def a_normal_that_is_turned(data, rng):
    at = 84 + 50 * rng.randrange((len(data) - 84) // 50)
    return data[:at] + struct.pack("<3f", *(-x - 1 for x in struct.unpack("<3f", data[at:at + 12]))) + data[at + 12:]


@file_lie("every byte of binary STL", {"stl"})
def an_attribute_in_stl(data, rng):
    at = 84 + 50 * rng.randrange((len(data) - 84) // 50) + 48
    return data[:at] + b"\1\0" + data[at + 2:]


@file_lie("every byte of binary STL", {"stl"})
def a_count_that_is_huge(data, rng):
    return data[:80] + b"\xff\xff\xff\xff" + data[84:]


@file_lie("every byte of binary STL", {"stl"})
def another_title(data, rng):
    return data[:20] + b"by another hand" + data[35:]


# ---- VTK: arrays are decompressed first, and all else is compared as it stands

PACKED = re.compile(rb'(?<=format="binary">\n)([A-Za-z0-9+/]+={0,2})([A-Za-z0-9+/]*={0,2})(?=\n)')


def unpacked(data, m):
    """The header and the bytes of a compressed array with one block; None of others."""
    if b"compressor=" not in data:
        return None
    header = struct.unpack("<4Q", base64.b64decode(m[0][:44]))
    return (header, zlib.decompress(base64.b64decode(m[0][44:]))) if header[0] == 1 else None


def packed(header, content, level=6):
    small = zlib.compress(content, level)
    return base64.b64encode(struct.pack("<4Q", *header[:3], len(small))) + base64.b64encode(small)


def in_array(data, rng, change):
    """Changes one of the arrays, by a function of its header and bytes."""
    arrays = [m for m in re.finditer(rb'(?<=format="binary">\n)[A-Za-z0-9+/=]+(?=\n)', data) if unpacked(data, m)]
    if not arrays:
        return None
    m = rng.choice(arrays)
    new = change(*unpacked(data, m))
    return data[:m.start()] + new + data[m.end():] if new else None


@file_lie("compressed arrays are decompressed, and compared then", VTK)
def another_number_in_an_array(data, rng):
    def change(header, content):
        at = rng.randrange(len(content))
        return packed(header, content[:at] + bytes([content[at] ^ 1]) + content[at + 1:])
    return in_array(data, rng, change)


@file_lie("compressed arrays are decompressed, and compared then", VTK)
def a_number_more_in_an_array(data, rng):
    return in_array(data, rng, lambda header, content: packed(header, content + content[-8:]))


@file_lie("compressed arrays are decompressed, and compared then", VTK)
def a_number_less_in_an_array(data, rng):
    return in_array(data, rng, lambda header, content: packed(header, content[:-8]))


@file_lie("compressed arrays are decompressed, and compared then", VTK)
def something_behind_the_compressed_bytes(data, rng):
    def change(header, content):
        small = zlib.compress(content) + b"hidden"
        return base64.b64encode(struct.pack("<4Q", *header[:3], len(small))) + base64.b64encode(small)
    return in_array(data, rng, change)


@file_lie("compressed arrays are decompressed, and compared then", VTK)
def a_block_of_another_size(data, rng):
    return in_array(data, rng, lambda header, content: packed((header[0], header[1] * 2, header[2]), content))


@file_lie("compressed arrays are decompressed, and compared then", VTK)
def a_block_of_huge_size(data, rng):
    def change(header, content):
        return base64.b64encode(struct.pack("<4Q", *header[:3], 2 ** 63)) + base64.b64encode(zlib.compress(content))
    return in_array(data, rng, change)


@file_lie("compressed arrays are decompressed, and compared then", VTK)
def blocks_without_end(data, rng):
    return in_array(data, rng, lambda header, content: packed((2 ** 61, *header[1:3]), content))


@file_lie("all around compressed arrays is compared as it stands", VTK)
def another_way_of_writing_base64(data, rng):
    m = re.search(rb"[A-Za-z0-9+/]={1,2}\n", data)
    alphabet = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"
    return data[:m.start()] + bytes([alphabet[alphabet.index(m[0][0]) + 1]]) + data[m.start() + 1:]


@file_lie("all around compressed arrays is compared as it stands", VTK)
def a_second_piece(data, rng):
    m = re.search(rb"(?s)<Piece .*</Piece>\n", data)
    return data[:m.end()] + m[0] + data[m.end():]


@file_lie("all around compressed arrays is compared as it stands", VTK)
def another_array(data, rng):
    m = re.search(rb"(?s)<DataArray type=\"Int32\".*?</DataArray>\n", data)
    return data[:m.end()] + m[0] + data[m.end():]


@file_lie("all around compressed arrays is compared as it stands", VTK)
def an_array_by_another_name(data, rng):
    return data.replace(b'Name="surface_count"', b'Name="surfaces_all"', 1)


@file_lie("all around compressed arrays is compared as it stands", VTK)
def arrays_exchanged(data, rng):
    a, b = list(re.finditer(rb"(?s)<DataArray type=\"Int32\".*?</DataArray>\n", data))[:2]
    return data[:a.start()] + b[0] + a[0] + data[b.end():]


@file_lie("all around compressed arrays is compared as it stands", VTK)
def data_appended(data, rng):
    return data.replace(b"</VTKFile>", b'<AppendedData encoding="raw">_x</AppendedData>\n</VTKFile>')


@file_lie("all around compressed arrays is compared as it stands", VTK)
def a_comment_of_xml(data, rng):
    return data.replace(b"<Points>", b"<!-- --><Points>", 1)


@file_lie("all around compressed arrays is compared as it stands", VTK)
def an_entity_of_xml(data, rng):
    return data.replace(b'<?xml version="1.0"?>\n', b'<?xml version="1.0"?>\n<!DOCTYPE x [<!ENTITY e "e">]>\n', 1)


@file_lie("all around compressed arrays is compared as it stands", VTK)
def another_byte_order_of_vtk(data, rng):
    return data.replace(b"LittleEndian", b"BigEndian", 1)


# ---- model.json

@file_lie("model.json is a file of the folder", {"json"})
def a_key_of_the_model_twice(data, rng):
    return data.replace(b'"blocks": [', b'"blocks": [],\n"blocks": [', 1)


@file_lie("model.json is a file of the folder", {"json"})
def a_block_by_another_name(data, rng):
    return re.sub(rb'("blocks": \[\n\{"name":"[^"]*"(?s:.*?)\{"name":")', rb"\1x", data, count=1)


@file_lie("model.json is a file of the folder", {"json"})
def a_larger_volume_written(data, rng):
    return re.sub(rb'"volume_written":(\d)', lambda m: b'"volume_written":1' + m[1], data, count=1)


@file_lie("model.json is a file of the folder", {"json"})
def a_neighbour_less(data, rng):
    return re.sub(rb'"neighbours":\[\d+,', b'"neighbours":[', data, count=1)


@file_lie("model.json is a file of the folder", {"json"})
def a_line_of_another_kind(data, rng):
    return data.replace(b'"kind":"intersection curve"', b'"kind":"branch line"', 1)


@file_lie("model.json is a file of the folder", {"json"})
def a_file_that_is_elsewhere(data, rng):
    return re.sub(rb'"file":"(\w+)/', rb'"file":"../\1/', data, count=1)
