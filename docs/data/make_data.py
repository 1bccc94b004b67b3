#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Writes the small models that the documentation uses: make_data.py [FOLDER].

All files are synthetic. Coordinates are in metres, z points up, and every number is rounded to
centimetres, so that the files do not depend on the machine that writes them.
"""
import math
import pathlib
import sys

WEST, EAST, SOUTH, NORTH = -100.0, 2100.0, -100.0, 1600.0


def grid_triangles(columns, rows):
    """Triangles of a grid of (columns + 1) x (rows + 1) vertices, counterclockwise seen from above."""
    triangles = []
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            b, c, d = a + 1, a + columns + 2, a + columns + 1
            triangles += [(a, b, c), (a, c, d)]
    return triangles


def tsurf(name, feature, vertices, triangles):
    """A GOCAD TSurf with the vertices that the triangles use."""
    used = sorted({v for t in triangles for v in t})
    number = {v: k + 1 for k, v in enumerate(used)}
    lines = ["GOCAD TSurf 1", "HEADER {", f"name:{name}", "}", "GOCAD_ORIGINAL_COORDINATE_SYSTEM",
             'AXIS_NAME "X" "Y" "Z"', 'AXIS_UNIT "m" "m" "m"', "ZPOSITIVE Elevation",
             "END_ORIGINAL_COORDINATE_SYSTEM"]
    if feature:
        lines.append(f"GEOLOGICAL_TYPE {feature}")
    lines.append("TFACE")
    lines += [f"VRTX {number[v]} {vertices[v][0]:.2f} {vertices[v][1]:.2f} {vertices[v][2]:.2f}"
              for v in used]
    lines += ["TRGL " + " ".join(str(number[v]) for v in t) for t in triangles]
    return "\n".join(lines) + "\nEND\n"


def fault_x(y, z):
    """Where the fault is: it strikes north, undulates, and dips east by 65 degrees."""
    return 1000 + 60 * math.sin(y / 400) - (z + 1200) / math.tan(math.radians(65))


def top_height(x, y):
    return -1000 + 60 * math.sin(x / 700) + 25 * math.cos(y / 450)


def base_height(x, y):
    return -1350 + 45 * math.sin(x / 800 + 0.4) + 30 * math.cos(y / 500 + 0.3)


def throw(y):
    """How far the hanging wall is down: 120 m in the south, 70 m in the north."""
    return 120 - 50 * (y - SOUTH) / (NORTH - SOUTH)


def horizon_side(height, down, beyond, columns, rows):
    """One side of a horizon. It ends `beyond` metres behind the fault (negative: before it)."""
    vertices = []
    for j in range(rows + 1):
        y = SOUTH + (NORTH - SOUTH) * j / rows
        drop = throw(y) if down else 0.0
        x = fault_x(y, -1200)
        for _ in range(50):  # where horizon and fault meet
            x = fault_x(y, height(x, y) - drop)
        for i in range(columns + 1):
            u = i / columns
            at = x - beyond + (EAST - x + beyond) * u if down else WEST + (x + beyond - WEST) * u
            vertices.append((at, y, height(at, y) - drop))
    return vertices, grid_triangles(columns, rows)


def horizon(name, height, beyond_west, beyond_east):
    columns, rows = 9, 14
    west, triangles = horizon_side(height, False, beyond_west, columns, rows)
    east, others = horizon_side(height, True, beyond_east, columns, rows)
    shifted = [tuple(v + len(west) for v in t) for t in others]
    return tsurf(name, "top", west + east, triangles + shifted)


def fault():
    columns, rows = 14, 10
    vertices = []
    for j in range(rows + 1):
        z = -1800 + 1200 * j / rows
        for i in range(columns + 1):
            y = -150 + 1800 * i / columns
            vertices.append((fault_x(y, z), y, z))
    return tsurf("fault", "fault", vertices, grid_triangles(columns, rows))


def seabed():
    """A grid of depths with a hole."""
    columns, rows, cell = 25, 20, 50
    lines = [f"ncols {columns}", f"nrows {rows}", "xllcenter 4000", "yllcenter 7000",
             f"cellsize {cell}", "NODATA_value -9999"]
    for j in range(rows - 1, -1, -1):
        heights = []
        for i in range(columns):
            in_hole = math.hypot(i - 14, (j - 10) * 1.3) < 4.2
            z = 240 + 30 * math.sin(i / 5) * math.cos(j / 6) + 0.8 * i
            heights.append("-9999" if in_hole else f"{z:.2f}")
        lines.append(" ".join(heights))
    return "\n".join(lines) + "\n"


def fold():
    """An overturned fold with a hole in its limb."""
    columns, rows = 32, 24
    vertices = []
    for j in range(rows + 1):
        for i in range(columns + 1):
            t = 2 * math.pi * i / columns
            vertices.append((7.5 * i - 40 * math.sin(2 * t), 10.0 * j, 60 * math.sin(t)))
    triangles = grid_triangles(columns, rows)
    kept = []
    for k, triangle in enumerate(triangles):
        i, j = (k // 2) % columns, k // 2 // columns
        if math.hypot(i + 0.5 - 14.5, j + 0.5 - 12) >= 3:
            kept.append(triangle)
    return tsurf("fold", "", vertices, kept)


def sheet(name, height):
    columns, rows = 16, 12
    vertices = []
    for j in range(rows + 1):
        for i in range(columns + 1):
            x, y = 100.0 * i, 100.0 * j
            vertices.append((x, y, height(x, y)))
    return tsurf(name, "top", vertices, grid_triangles(columns, rows))


def salt_height(x, y):
    return -900 + 350 * math.exp(-((x - 800) ** 2 + (y - 600) ** 2) / 300 ** 2)


def shale_height(x, y):
    return -720 + 20 * math.sin(x / 300) + 10 * math.cos(y / 250)


def licence_body():
    """A closed surface: an ellipsoid round the middle of the fault."""
    centre, half = (1000.0, 750.0, -1250.0), (450.0, 500.0, 300.0)
    columns, rows = 16, 8
    vertices, triangles = [], []
    for j in range(1, rows):
        theta = math.pi * j / rows
        for i in range(columns):
            phi = 2 * math.pi * i / columns
            vertices.append((centre[0] + half[0] * math.sin(theta) * math.cos(phi),
                             centre[1] + half[1] * math.sin(theta) * math.sin(phi),
                             centre[2] + half[2] * math.cos(theta)))
    top, bottom = len(vertices), len(vertices) + 1
    vertices += [(centre[0], centre[1], centre[2] + half[2]),
                 (centre[0], centre[1], centre[2] - half[2])]
    for i in range(columns):
        n = (i + 1) % columns
        triangles.append((top, i, n))
        last = (rows - 2) * columns
        triangles.append((bottom, last + n, last + i))
        for j in range(rows - 2):
            a, b = j * columns + i, j * columns + n
            triangles += [(a, a + columns, b + columns), (a, b + columns, b)]
    return tsurf("body", "boundary", vertices, triangles)


def unit(name, low, high, west, east, cells):
    """A closed unit between two heights, from 0 to 1200 m north, with cells along each side."""
    vertices, triangles, number = [], [], {}

    def vertex(i, j, k):
        if (i, j, k) not in number:
            x, y = west + (east - west) * i / cells, 1200.0 * j / cells
            number[i, j, k] = len(vertices)
            vertices.append((x, y, low(x, y) + (high(x, y) - low(x, y)) * k / cells))
        return number[i, j, k]

    for i in range(cells):
        for j in range(cells):
            for side, turned in ((0, False), (cells, True)):
                for places in ([(i, j, side), (i, j + 1, side), (i + 1, j + 1, side), (i + 1, j, side)],
                               [(i, side, j), (i + 1, side, j), (i + 1, side, j + 1), (i, side, j + 1)],
                               [(side, i, j), (side, i, j + 1), (side, i + 1, j + 1), (side, i + 1, j)]):
                    a, b, c, d = (vertex(*p) for p in places)
                    pair = [(a, b, c), (a, c, d)]
                    triangles += [t[::-1] for t in pair] if turned else pair
    return name, vertices, triangles


def units():
    """Three closed units that were meshed apart: their contacts nearly coincide."""
    def contact(x, y):
        return -1200 + 0.1 * x + 0.05 * y

    parts = [unit("basement", lambda x, y: -2000.0, contact, 0.0, 1600.0, 5),
             unit("west", contact, lambda x, y: -700.0, 0.0, 900.0, 4),
             unit("east", contact, lambda x, y: -700.0, 900.03, 1600.0, 3)]
    lines, first = [], 1
    for name, vertices, triangles in parts:
        lines.append("o " + name)
        lines += ["v %.1f %.1f %.1f" % v for v in vertices]
        lines += ["f %d %d %d" % tuple(first + v for v in t) for t in triangles]
        first += len(vertices)
    return "\n".join(lines) + "\n"


def files():
    """The text of each file by name."""
    return {
        "top.ts": horizon("top", top_height, 12, -8),
        "base.ts": horizon("base", base_height, 15, 10),
        "fault.ts": fault(),
        "seabed.asc": seabed(),
        "fold.ts": fold(),
        "salt.ts": sheet("salt", salt_height),
        "shale.ts": sheet("shale", shale_height),
        "body.ts": licence_body(),
        "units.obj": units(),
        "licence.txt": "# corners of the licence area: x y\n"
                       "200 100\n1900 200\n1700 1400\n900 1300\n300 1450\n",
    }


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
    for name, text in files().items():
        (folder / name).write_text(text)
