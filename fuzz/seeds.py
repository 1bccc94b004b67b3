#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Writes the seed corpora: fuzz/seeds.py [FOLDER]   (fuzz/corpus unless given)

Every seed is a case with a name, in the language that the target reads its bytes in: see
fuzzing/generators.cpp, corefine.cpp, predicates.cpp, search.cpp and forge.cpp. The same files come out each time.
"""
import base64
import pathlib
import struct
import sys

TRIANGLE, FAN, SHEET, TETRAHEDRON, COPY, BOX = 5, 0, 1, 2, 3, 4  # add_piece
UTM, TENTHS, TURNED = 2 << 4, 2, 3 << 2  # Frame
PLAIN = 0
ULP_UP, ULP_DOWN, HALF = 176, 200, 224  # coordinate


class Points:
    """Points of the lattice -4..4; the second time a point is named, by number."""

    RANGE = 4

    def __init__(self):
        self.earlier = []

    def number(self, value, extra=0):
        """The byte for a lattice number, nudged where extra says so."""
        low = extra
        while (low % (2 * self.RANGE + 1)) != 0:
            low += 1
        return low + value + self.RANGE

    def __call__(self, *p, nudge=0):
        if nudge == 0 and p in self.earlier and self.earlier.index(p) * 3 < 256:
            return bytes([self.earlier.index(p) * 3])
        self.earlier.append(p if nudge == 0 else None)
        return bytes([1, self.number(p[0]), self.number(p[1]), self.number(p[2], nudge)])


def header(frame=PLAIN, exponent=None):
    if exponent is None:
        return bytes([frame, Points.RANGE - 1])
    return bytes([frame | 2 << 6, exponent + 12, Points.RANGE - 1])


# Pairs of triangles by how they meet: the classes of contact.
CONTACTS = {
    "apart": ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 0, 2), (1, 0, 2), (0, 1, 3)]),
    "common-corner": ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 0, 0), (-1, 0, 1), (0, -1, 1)]),
    "common-edge": ([(0, 0, 0), (2, 0, 0), (0, 2, 0)], [(0, 0, 0), (2, 0, 0), (0, 0, 2)]),
    "corner-on-edge": ([(0, 0, 0), (2, 0, 0), (0, 2, 0)], [(1, 0, 0), (1, -1, 2), (0, -2, 2)]),
    "corner-on-face": ([(-2, -2, 0), (3, -1, 0), (0, 3, 0)], [(0, 0, 0), (1, 1, 2), (0, 1, 2)]),
    "edges-cross": ([(-1, 0, 0), (1, 0, 0), (0, -2, 0)], [(0, 0, -1), (0, 0, 1), (0, 2, 0)]),
    "edges-overlap": ([(-2, 0, 0), (2, 0, 0), (0, 2, 0)], [(-1, 0, 0), (3, 0, 0), (0, 0, 2)]),
    "edge-in-edge": ([(-2, 0, 0), (2, 0, 0), (0, 2, 0)], [(-1, 0, 0), (1, 0, 0), (0, 0, 2)]),
    "edge-on-face": ([(-3, -3, 0), (3, -3, 0), (0, 3, 0)], [(-1, -1, 0), (1, -1, 0), (0, 0, 2)]),
    "edge-across-face": ([(-2, 0, 0), (2, 0, 0), (0, 3, 0)], [(-3, 1, 0), (3, 1, 0), (0, 1, 3)]),
    "pierced": ([(-3, -3, 0), (3, -3, 0), (0, 3, 0)], [(0, 0, -1), (1, 0, 1), (-1, 0, 1)]),
    "linked": ([(-3, -3, 0), (3, -3, 0), (0, 3, 0)], [(0, 0, -2), (0, 0, 2), (0, 4, 1)]),
    "through-corner": ([(0, 0, 0), (3, 1, 0), (1, 3, 0)], [(-1, -1, -1), (1, 1, 1), (2, 2, -2)]),
    "corner-and-crossing": ([(0, 0, 0), (3, 0, 0), (0, 3, 0)], [(0, 0, 0), (2, 2, 2), (1, 1, -2)]),
    "coplanar-star": ([(-3, -2, 0), (3, -2, 0), (0, 3, 0)], [(-3, 2, 0), (3, 2, 0), (0, -3, 0)]),
    "coplanar-inside": ([(-4, -4, 0), (4, -4, 0), (0, 4, 0)], [(-1, -1, 0), (1, -1, 0), (0, 0, 0)]),
    "coplanar-common-edge": ([(0, 0, 0), (3, 0, 0), (0, 3, 0)], [(0, 0, 0), (3, 0, 0), (3, 3, 0)]),
    "coplanar-corner": ([(0, 0, 0), (3, 0, 0), (0, 3, 0)], [(0, 0, 0), (3, 1, 0), (1, 3, 0)]),
    "coplanar-edges": ([(0, 0, 0), (2, 0, 0), (0, 2, 0)], [(1, 0, 0), (3, 0, 0), (1, -2, 0)]),
    "coplanar-tilted": ([(0, 0, 0), (2, 0, 2), (0, 2, 1)], [(1, 0, 1), (-1, 2, 0), (2, 2, 3)]),
}
FRAMES = {"plain": header(), "utm": header(UTM | TENTHS), "turned": header(TURNED),
          "scaled": header(PLAIN, 9), "tenths": header(TENTHS)}


def triangle(points, corners, nudge=0):
    return b"".join(points(*p, nudge=nudge if i == 0 else 0) for i, p in enumerate(corners))


def tri_tri():
    for name, (s, t) in CONTACTS.items():
        for frame, head in FRAMES.items():
            points = Points()
            yield f"{name}-{frame}", head + triangle(points, s) + triangle(points, t)
        points = Points()
        yield f"{name}-ulp", header() + triangle(points, s) + triangle(points, t, ULP_UP)


def sheet(n, m, axis, heights, holes=None, at=(0, 0), diagonals=0):
    r = Points.RANGE
    head = [n - 1, m - 1, axis] + ([holes] if holes is not None else [])
    return bytes(head + [diagonals, at[0] + r, at[1] + r] + [h + r for h in heights])


def box(low, size):
    r = Points.RANGE
    return bytes(v for a, s in zip(low, size) for v in (a + r, s - 1))


FLAT = [0] * 9
RIDGE = [0, 1, 0, 0, 1, 0, 0, 1, 0]
BUMPS = [0, 1, -1, 1, -1, 0, 1, 0, 1]


def soups():
    """For arrange, rounding, regions and tetrahedra."""
    for name, (s, t) in list(CONTACTS.items())[::2]:
        points = Points()
        pieces = bytes([0, TRIANGLE]) + triangle(points, s) + bytes([1, TRIANGLE])
        third = bytes([0, TRIANGLE]) + triangle(points, [(0, -2, -2), (1, 2, 2), (-2, 1, 3)])
        yield name, header() + bytes([1]) + pieces + triangle(points, t) + third
    for frame, head in FRAMES.items():
        sheets = bytes([0, SHEET]) + sheet(2, 2, 0, BUMPS, 0) + bytes([1, SHEET]) + \
            sheet(2, 1, 1, RIDGE[:6], 0, (-2, -1))
        yield f"sheets-{frame}", head + bytes([1]) + sheets
        yield f"copies-{frame}", head + bytes([1, 0, SHEET]) + sheet(1, 1, 0, FLAT[:4], 0) + \
            bytes([1, COPY, 1, 1, 0, 0, TRIANGLE]) + \
            triangle(Points(), [(0, 0, -1), (1, 0, 1), (0, 1, 1)])
    yield "holes", header() + bytes([0, 0, SHEET]) + sheet(2, 2, 0, RIDGE, 0b00010010)
    points = Points()
    fan = points(0, 0, -2) + points(0, 0, 2) + bytes([2]) + points(2, 0, 0) + points(0, 2, 1) + \
        points(-2, 0, 0) + points(0, -2, 1)
    yield "fan", header() + bytes([0, 0, FAN]) + fan
    points = Points()
    yield "tetrahedron-and-triangle", header() + bytes([1, 0, TETRAHEDRON]) + points(0, 0, 0) + \
        points(3, 0, 0) + points(0, 3, 0) + points(0, 0, 3) + bytes([1, TRIANGLE]) + \
        triangle(points, [(-1, -1, 1), (4, 0, 1), (0, 4, 1)])


# In the plane of a crowd: sides of the three cross in a triangle that turns over in doubles at 2^46.
TURNED_OVER = [
    [[(99, 97), (104, 63), (118, 115)], [(98, 82), (108, 63), (116, 116)], [(106, 61), (93, 107), (113, 116)]],
    [[(66, 94), (91, 83), (118, 113)], [(82, 86), (62, 98), (119, 113)], [(67, 91), (86, 88), (123, 120)]],
]


def crowded():
    """Very many triangles in one plane, at one line or at one vertex (crowded.cpp)."""
    nested, at_line, at_vertex, overlapping, in_plane = (bytes([1, k]) for k in range(5))
    here, far = 0, 2
    def plane(u, v):
        return bytes(4 + c for c in (0, 0, 0, *u, *v))
    def triangles(several):
        return b"".join(in_plane + bytes(c for p in t for c in p) for t in several)
    base = triangles([[(0, 0), (255, 0), (0, 255)]])
    flat, upright, tilted = plane((1, 0, 0), (0, 1, 0)), plane((1, 0, 0), (0, 0, 1)), plane((1, 0, 1), (0, 1, 2))
    for k, three in enumerate(TURNED_OVER):
        for name, where in (("flat", flat), ("upright", upright)):
            yield f"turned-over-{name}-{k}", header() + bytes([far]) + where + base + nested + bytes([39]) + \
                triangles(three)
    points = Points()
    across = bytes([0]) + triangle(points, [(-4, 0, -4), (4, 1, -4), (0, 2, 4)])
    for frame, head in FRAMES.items():
        yield f"nested-{frame}", head + bytes([here]) + tilted + nested + bytes([30]) + across
        yield f"line-{frame}", head + bytes([here]) + tilted + at_line + bytes([40, 6]) + across
        yield f"vertex-{frame}", head + bytes([here]) + flat + at_vertex + bytes([79, 4]) + across
        yield f"overlapping-{frame}", head + bytes([here]) + tilted + overlapping + bytes([4, 7]) + across
    yield "stacks", header() + bytes([here]) + flat + nested + bytes([40]) + at_line + bytes([20, 2]) + across
    yield "pencil", header() + bytes([far]) + flat + at_line + bytes([35, 1]) + at_line + bytes([20, 3]) + across


def corefine_bodies(points):
    """Kind, (flag for holes,) and what follows."""
    tetrahedron = bytes([3]) + points(0, 0, 0) + points(3, 0, 0) + points(0, 3, 0) + points(0, 0, 3)
    pyramid = bytes([5]) + points(2, 0, 0) + points(-1, 2, 0) + points(-1, -2, 0) + \
        points(0, 0, 2) + points(0, 0, -2)
    disc = bytes([6, 1]) + points(0, 0, 0) + points(2, 0, 1) + points(0, 2, -1) + \
        points(-2, 0, 1) + points(0, -2, -1) + bytes([1])
    return {
        "sheet": bytes([0, 1]) + sheet(2, 2, 0, BUMPS, 0, (-2, -2)),
        "flat": bytes([0, 1]) + sheet(2, 1, 0, FLAT[:6], 0, (-1, -1)),
        "wall": bytes([0, 1]) + sheet(2, 2, 1, RIDGE, 0, (-2, -2), 5),
        "hole": bytes([0, 0]) + sheet(2, 2, 0, RIDGE, 0b0010, (-2, -1)),
        "tetrahedron": tetrahedron,
        "pyramid": pyramid,
        "disc": disc,
        "box": bytes([7]) + box((-1, -1, -1), (2, 2, 2)),
        "cube": bytes([7]) + box((0, 0, 0), (1, 1, 1)),
    }


def corefine():
    names = list(corefine_bodies(Points()))
    for i, a in enumerate(names):
        for j, b in enumerate(names[i:]):
            first = corefine_bodies(Points())[a]
            # points named by number would be those of the first body: name all anew
            second = corefine_bodies(Points())[b]
            frame = list(FRAMES)[(i + j) % len(FRAMES)] if j % 2 else "plain"
            yield f"{a}-{b}-{frame}", FRAMES[frame] + first + second


def predicates():
    def coordinate(kind, integer, *more):
        return bytes([kind, integer + 8, *more])

    kinds = {"integers": 0, "up": 128, "down": 160, "tenths": 192, "utm": 208}
    for name, kind in kinds.items():
        for plane in (0, 1, 129):
            points = b"".join(coordinate(kind, (i * j) % 7 - 3) for i in range(1, 9)
                              for j in (1, 2, 5))
            rest = bytes(range(64))
            if plane % 4 == 0:  # each point after the third has two numbers more
                points = b"".join(points[6 * i:6 * i + 6] + (bytes([i, 8 - i]) if i > 2 else b"")
                                  for i in range(8))
            yield f"{name}-{plane}", bytes([4, plane]) + points + b"\x03" + rest
    huge = b"".join(coordinate(248, i % 5 - 2, (20 * i) % 250) for i in range(24))
    yield "any-exponent", bytes([4, 1]) + huge + b"\x03" + bytes(range(64))


def search():
    row = bytes([192 + 31, 16, 16, 16, 1, 1, 1])
    column = bytes([192 + 8 + 21, 16, 0, 16, 2, 1, 0])
    singles = b"".join(bytes([0, i % 33, (5 * i) % 33, (3 * i) % 33, i % 4, i % 3, 1])
                       for i in range(30))
    small = b"".join(bytes([0, i % 33, (7 * i) % 33, 16, 201 + i, 1, 240 - i]) for i in range(30))
    groups = bytes([1]) * 3 + bytes(range(90))
    for name, boxes in {"row": row, "cross": row + column, "singles": singles,
                        "sizes": small + row}.items():
        for frame, head in {"plain": b"\x00", "utm": bytes([UTM | TENTHS])}.items():
            yield f"{name}-{frame}", head + bytes([90]) + boxes + groups
    yield "many", bytes([255, 255, 7, 0])
    yield "many-groups", bytes([255, 255, 7, 1])


OBJ = """# two surfaces
v 0 0 0
v 1 0 0.5
v 0 1 -1e-3
v 1 1 0
g top main_fault
f 1 2 3
f -2/1 -3//2 4/2/1
g base
f 1 2 \\
4 3
"""
OFF = "OFF\n4 2 5\n0 0 0\n1 0 0.5\n0 1 -1e-3\n1 1 0\n3 0 1 2\n4 0 1 3 2 255 0 0\n"
COFF = "COFF # colours\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n3 0 1 2\n"
STL = """solid top
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0.5
vertex 0 1 -1e-3
endloop
endfacet
endsolid top
"""
PLY = """ply
format ascii 1.0
comment terrane surface horizon top
element vertex 4
property double x
property double y
property double z
element face 2
property list uchar int vertex_indices
property uchar surface
property list uchar uchar surfaces
end_header
0 0 0
1 0 0.5
0 1 -1e-3
1 1 0
3 0 1 2 0 1 0
3 1 3 2 0 1 0
"""
TS = """GOCAD TSurf 1
HEADER {
name: "top horizon"
*solid*color: 1 0 0 1
}
GOCAD_ORIGINAL_COORDINATE_SYSTEM
NAME Default
AXIS_NAME "X" "Y" "Z"
AXIS_UNIT "m" "m" "m"
ZPOSITIVE Depth
END_ORIGINAL_COORDINATE_SYSTEM
GEOLOGICAL_FEATURE top
GEOLOGICAL_TYPE horizon
TFACE
VRTX 1 0 0 0
PVRTX 3 1 0 0.5 7
VRTX 4 0 1 -1e-3
ATOM 9 3
TRGL 1 3 4
TFACE
TRGL 1 9 4
BSTONE 1
BORDER 5 1 3
END
"""
ML = """GOCAD Model3d 1
HEADER {
name: model
}
TSURF top
TFACE 1 top top
    0 0 0
    1 0 0
    0 1 0
REGION 2 Universe
    +1 0
LAYER rock
    2 0
END
""" + TS.replace('"top horizon"', "top").replace("TFACE\nTRGL 1 9 4\n", "")


def binary_stl(triangles):
    body = b"".join(struct.pack("<12fH", 0, 0, 1, *[c for p in t for c in p], 0) for t in triangles)
    return b"binary".ljust(80) + struct.pack("<I", len(triangles)) + body


def binary_ply(order):
    sign = "<" if order == "little" else ">"
    head = PLY.replace("ascii", f"binary_{order}_endian").split("end_header\n")[0] + "end_header\n"
    vertices = [(0, 0, 0), (1, 0, 0.5), (0, 1, -1e-3), (1, 1, 0)]
    data = b"".join(struct.pack(sign + "3d", *v) for v in vertices)
    for t in ((0, 1, 2), (1, 3, 2)):
        data += struct.pack(sign + "B3iBBB", 3, *t, 0, 1, 0)
    return head.encode() + data


FILES = {
    "obj": {"groups": OBJ, "triangle": "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
    "off": {"polygon": OFF, "colours": COFF, "bare": OFF[4:]},
    "stl": {"text": STL, "two": STL + STL.replace("top", "base rock"),
            "binary": binary_stl([((0, 0, 0), (1, 0, 0.5), (0, 1, 0)),
                                  ((0, 1, 0), (1, 0, 0.5), (1, 1, 1))])},
    "ply": {"text": PLY, "little": binary_ply("little"), "big": binary_ply("big")},
    "ts": {"depth": TS, "two": TS + TS.replace("Depth", "Elevation").replace("top", "base")},
    "ml": {"model": ML},
}


def irap_binary(columns, rows, heights, rotation=0.0):
    def record(payload):
        size = struct.pack(">i", len(payload))
        return size + payload + size
    head = struct.pack(">ii6f", -996, rows, 0, 9, 0, 9, 1, 1)
    return (record(head) + record(struct.pack(">i3f", columns, rotation, 5, 6)) +
            record(struct.pack(">7i", *[0] * 7)) +
            record(struct.pack(f">{len(heights)}f", *heights)))


FILES.update({
    "irap": {
        "text": "-996 2 1.5 2\n0 3 0 2\n3 30 100 200\n0 0 0 0 0 0 0\n1 2 9999900.0 3 4 5\n",
        "binary": irap_binary(3, 2, [1, 2, 3, 4, 1e30, 6], 30)},
    "zmap": {
        "plain": "! made\n@top HEADER, GRID, 2\n 10, -99999.0, , 4, 1\n"
                 " 2, 3, 0.0, 2.0, 0.0, 1.0\n 0.0, 0.0, 0.0\n@\n+ data\n 1.0 2.0\n"
                 " -99999.0 3.0\n 4.0 5.0\n",
        "fields": "@top HEADER, GRID, 3\n4, -9, NUL, 0, 1\n3,2,0,1,0,2\n0,0,0\n@\n"
                  "100020003000\n4000-999 NUL\n"},
    "cps3": {
        "plain": "FSASCI 0 1 COMPUTED 0 0.1E+31\nFSATTR 0 0\nFSLIMI 0 2 0 1 1 6\nFSNROW 2 3\n"
                 "FSXINC 1 1\n->top\n1 2 0.1E+31\n4 5 6\n"},
    "asc": {
        "corner": "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 5\n"
                  "NODATA_value -9999\n1 2 3\n4 -9999 6\n",
        "centre": "NCOLS 2\nNROWS 2\nXLLCENTER 0\nYLLCENTER 0\nDX 1\nDY 2\n1 2\n3 4\n"},
    "xyz": {
        "columns": "0 0 1\n1 0 2\n0 1 3\n1 1 1e30\n999 999 999\n2 2 5\n",
        "named": "id;X;Y;Z\n7;0;0;1\n8;1;0;2\n9;0;1;3\n",
        "quoted": '# "X" "Y" "Z"\n"top" 0 0 1\n"top" 1 0 2\n"top" 0 1 3\n"base" 0 0 0\n',
        "five": "1 1 0 0 5\n1 2 0 1 5\n2 1 1 0 5\n2 2 1 1 -999.25\nEOD\n"},
    "vs": {
        "vset": "GOCAD VSet 1\nHEADER {\nname:top\n}\nZPOSITIVE Depth\nVRTX 1 0 0 1\n"
                "VRTX 2 1 0 2\nPVRTX 3 0 1 3 9\nATOM 4 1\nEND\n",
        "pline": "GOCAD PLine 1\nHEADER {\nname:stick\n}\nILINE\nVRTX 1 0 0 1\nVRTX 2 1 0 2\n"
                 "SEG 1 2\nEND\nGOCAD PLine 1\nILINE\nVRTX 1 0 1 3\nVRTX 2 1 1 4\nEND\n"},
})


def forge():
    """A list of changes (forge_changes.hpp), then an OBJ file: each change once per part."""
    certified = pathlib.Path(__file__).parent.parent / "tests" / "certified"
    inputs = ["contact_pierced", "coplanar_overlap", "junction_x", "triple_point", "duplicates",
              "degenerate", "triple_point_inexact", "tetrahedra_star", "one_ulp_tilted", "tips_touch"]
    kinds, change, most = 36, 8, 3
    for kind in range(kinds):
        for part in range(3):
            name = inputs[(3 * kind + part) % len(inputs)]
            first = bytes([kind, part, 7 * kind % 256, 0, part, kind + 1, 5 * part + kind, 0])
            header = bytes([0]) + first + bytes(change * (most - 1))
            yield (f"change_{kind:02}_{part}_{name}",
                   header + (certified / name / "input.obj").read_bytes())


def forge_kind(models=2, more=0):
    """The same for a kind that has small models of its own (forge_subjects.cpp); with output files that
    follow the changes, or not."""
    change, most = 8, 3
    for kind in range(46 + more):
        first = bytes([kind, 5 * kind % 256, 7 * kind % 256, 0, kind % 7, kind + 1, 5 + kind, 0])
        yield (f"change_{kind:02}", bytes([most * (kind // 2 % 2)]) + first +
               bytes(change * (most - 1)) + bytes([kind % models]))


def forge_sealed():
    """More for what surfaces were sealed with: parts that were dropped are kept, and input triangles left
    out (forge_sealed.cpp), in each of the four models and at several places."""
    yield from forge_kind(4, 9)
    for name, kind in (("kept", 32), ("left_out", 39)):
        for model in range(4):
            for place in range(4):
                change = bytes([kind, 0, (53 * place + 90 * model) % 256, 0, 5 * place, 3, 2 + place, 0])
                yield (f"{name}_{model}_{place}", bytes([3]) + change + bytes(16) + bytes([model]))


def pieces():
    """Numbers of which pieces are made, right and wrong, and files (pieces.cpp)."""
    def piece(vertices, triangles):
        made = bytes([0, 0, 0, len(vertices)]) + b"".join(bytes([v, 0]) for v in vertices)
        return made + bytes([len(triangles)]) + b"".join(
            bytes([0, number, *corners, 0, 1, 0]) for number, corners in triangles)

    whole = piece([0, 1, 2, 3], [(1, (0, 1, 2)), (0, (1, 2, 3))])
    yield "whole", bytes([0, 0]) + whole
    yield "two", bytes([0, 1]) + piece([0, 1, 2], [(1, (0, 1, 2))]) + piece([2, 1, 3], [(0, (0, 1, 2))])
    yield "three", bytes([0, 2]) + piece([2], []) + whole + piece([], [])
    yield "gap", bytes([0, 0]) + piece([0, 1, 3], [(0, (0, 1, 2))])
    yield "twice", bytes([0, 1]) + whole + whole
    names = b'<VTKFile type="PPolyData"><PPolyData><Piece Source="0.vtp"/></PPolyData></VTKFile>'
    points = base64_block("<9d", 0, 0, 0, 1, 0, 0, 0, 1, 0)
    array = '<DataArray type="%s" Name="%s" format="binary">%s</DataArray>'
    def numbers(name, *values):
        return array % ("Int64", name, base64_block("<%dq" % len(values), *values))
    text = "116 111 112 0"
    data = ('<VTKFile type="PolyData" header_type="UInt64"><PolyData><FieldData>'
            f'<Array Name="surface_name">{text}</Array><Array Name="surface_role">0</Array></FieldData>'
            f'<Piece><PointData>{numbers("GlobalNodeIds", 0, 1, 2)}</PointData>'
            f'<CellData>{numbers("GlobalElementIds", 0)}{numbers("surface", 0)}{numbers("region", 0)}'
            f'{numbers("parent", 0)}</CellData><Points>{array % ("Float64", "Points", points)}</Points>'
            f'<Polys>{numbers("connectivity", 0, 1, 2)}</Polys></Piece></PolyData></VTKFile>')
    yield "files", b"\1" + names + b"\x1e" + data.encode()
    yield "no_piece", b"\1" + names


def kept():
    """Projects, and changes of what they keep (kept.cpp)."""
    for kind in range(4):
        yield f"same_{kind}", bytes([kind])
        yield f"sibling_{kind}", bytes([kind, 1, (kind + 1) % 4])
        for how in range(8):
            yield f"changed_{kind}_{how}", bytes([kind, 0, (kind + how) % 2, 2]) + 2 * bytes([how, 1, 9 * how, 77, 3, 128])


def base64_block(form, *values):
    """A block of binary data in VTK's XML formats, with its length before it."""
    data = struct.pack(form, *values)
    return base64.b64encode(struct.pack("<Q", len(data)) + data).decode()


def other_programs():
    """Small files that VTK, gmsh and meshio wrote, by format, and DXF and GeoJSON as others write them."""
    data = pathlib.Path(__file__).parent.parent / "tests" / "data" / "other_programs"
    files = {fmt: {path.stem: path.read_bytes() for path in sorted(data.glob("*." + fmt))}
             for fmt in ("vtp", "vtu", "vtk", "msh")}
    corners = [(0, 0, 0), (2, 0, 0), (2, 1, 0.5), (0, 1, 0.5)]
    face = "".join(f"1{k}\n{x}\n2{k}\n{y}\n3{k}\n{z}\n" for k, (x, y, z) in enumerate(corners))
    files["dxf"] = {"face": "0\nSECTION\n2\nENTITIES\n0\n3DFACE\n8\ntop\n" + face +
                            "0\nENDSEC\n0\nEOF\n"}
    pillars = "\n".join(f"{x} {y} 0 {x + lean} {y} 9" for y in (0, 5) for x, lean in ((0, 0), (4, 1), (8, 0)))
    files["grdecl"] = {"fault": "-- two columns\nSPECGRID\n2 1 2 1 F /\nCOORD\n" + pillars + "\n/\nZCORN\n" +
                                "".join(f"2*{z} 2*{z + 1.5}\n2*{z} {z + 1} {z - 0.5}\n" for z in (1, 3, 3, 5)) +
                                "/\nACTNUM\n3*1 0 /\nFAULTS\n'F1' 1 1 1 1 1 2 'I' /\n/\n"}
    files["sticks"] = {"charisma": "".join(f"INLINE- {i} 60 {i} {y} {-2 * y - 1} F 1 {i}\n" for i in (1, 2, 4)
                                           for y in range(i + 1)),
                       "heading": "x;y;depth;fault;stick\n0;0;1;A;1\n0;1;2;A;1\n3;0;1;A;2\n0;0;1;B;1\n5;5;5;B;2\n5;6;6;B;2\n",
                       "polygon": "0 0 0\n4 0 0\n4 0 -3\n2 0 -1\n0 0 -3\n0 0 0\n",
                       "breaks": "0 0 0\n0 0 -3\n999 999 999\n4 0 -3\n4 0 0\n999 999 999\nEOD\n"}
    polygon = '{"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 3.5], [0, 0]]]}'
    files["geojson"] = {"polygon": polygon,
                        "feature": '{"type": "FeatureCollection", "features": [{"type": "Feature", '
                                   '"geometry": ' + polygon + "}]}"}
    files["shp"] = {"polygon": shapefile(5, [(0, 0), (0, 3.5), (4, 0), (0, 0)]),
                    "heights": shapefile(15, [(0, 0), (0, 3.5), (4, 0), (0, 0)]),
                    "lines": shapefile(3, [(0, 0), (4, 3.5)])}
    return files


def shapefile(kind, corners):
    """A .shp with one polygon or line, and perhaps heights and measures."""
    xs, ys = zip(*corners)
    box = struct.pack("<4d", min(xs), min(ys), max(xs), max(ys))
    body = struct.pack("<i", kind) + box + struct.pack("<iii", 1, len(corners), 0)
    body += b"".join(struct.pack("<2d", *c) for c in corners)
    if kind == 15:
        body += 2 * struct.pack(f"<{2 + len(corners)}d", *(2 + len(corners)) * [-1])
    record = struct.pack(">ii", 1, len(body) // 2) + body
    return (struct.pack(">7i", 9994, 0, 0, 0, 0, 0, (100 + len(record)) // 2) + struct.pack("<ii", 1000, kind) + box +
            bytes(32) + record)


def solids():
    """Two solids, and in half of the cases a sheet (select.cpp)."""
    for k in range(12):
        yield f"solids-{k}", header() + bytes((7 * k + 13 * i + (k + 3) * i * i) % 256 for i in range(64))


def tiles():
    """Soups, and triangles in few doubles, far from the origin (tiles.cpp)."""
    yield from soups()
    for count, far, spacings, lattice in ((16, 0, 2, 4), (48, 1, 0, 7), (64, 2, 3, 3), (88, 0, 3, 4), (104, 3, 1, 5)):
        yield f"few-doubles-{count}", bytes([0x10, far, far, far, spacings, lattice - 2, count // 8 - 1, 1, count])


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else
                          pathlib.Path(__file__).parent / "corpus")
    targets = {"tri_tri": tri_tri, "corefine": corefine, "predicates": predicates, "search": search,
               "forge_arrangement": forge, "forge_volumes": forge_kind, "forge_tetrahedra": forge_kind,
               "forge_improved": forge_kind, "forge_filled": forge_kind,
               "forge_layered": lambda: forge_kind(5), "forge_cut": lambda: forge_kind(4, 1),
               "forge_sealed": forge_sealed,
               "arrange": soups, "rounding": soups, "crowded": crowded, "regions": soups,
                "tiles": tiles, "known": soups, "judge": soups,
                "volumes": soups, "select": solids, "tetrahedra": soups, "pieces": pieces,
                "kept": kept}
    seeds = {t: dict(make()) for t, make in targets.items()}
    for fmt, files in (FILES | other_programs()).items():
        seeds["read_" + fmt] = {n: f if isinstance(f, bytes) else f.encode()
                                for n, f in files.items()}
    for target, cases in seeds.items():
        (folder / target).mkdir(parents=True, exist_ok=True)
        for name, data in cases.items():
            (folder / target / name).write_bytes(data)


if __name__ == "__main__":
    main()
