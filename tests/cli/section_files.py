#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Reads back what `terrane section` writes, with VTK, Python's modules and the description of DXF.

    tests/cli/section_files.py TERRANE DATA

The polygons of a section of a closed box cover a rectangle whose area is known; so do those of each format, and each block has
the same area in all of them.
"""
import csv
import json
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from collections import defaultdict

from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

SVG = "{http://www.w3.org/2000/svg}"


def check(condition, what):
    if not condition:
        sys.exit(f"section_files.py: {what}")


def cube(name, low, high):
    """A closed cube as OBJ."""
    corners = "".join(f"v {x} {y} {z}\n" for x in (low, high) for y in (low, high) for z in (low, high))
    return f"o {name}\n{corners}f -8 -7 -5 -6\nf -4 -2 -1 -3\nf -8 -4 -3 -7\nf -6 -5 -1 -2\nf -8 -6 -2 -4\nf -7 -3 -1 -5\n"


def shoelace(ring):
    """The area of a ring whose first point is not repeated; counterclockwise: > 0."""
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(ring, ring[1:] + ring[:1])) / 2


def areas_of_geojson(text):
    areas = defaultdict(float)
    for feature in json.loads(text)["features"]:
        kind, coordinates, properties = feature["geometry"]["type"], feature["geometry"]["coordinates"], feature["properties"]
        check(kind in ("Polygon", "LineString"), kind)
        if kind == "LineString":
            check(properties["surface"] and len(coordinates) > 1, "a line is named and has points")
            continue
        whole = 0
        for number, ring in enumerate(coordinates):
            check(ring[0] == ring[-1] and len(ring) > 3, "rings are closed")
            area = shoelace(ring[:-1])
            check((area > 0) == (number == 0), "outer rings are counterclockwise, holes clockwise")
            whole += area
        check(abs(whole - properties["area"]) < 1e-6 * whole, "the area is that of the rings")
        areas[properties["block"]] += whole
    return areas


def areas_of_csv(text):
    rings, areas = defaultdict(list), defaultdict(float)
    for row in csv.DictReader(text.splitlines()):
        if row["kind"] != "line":
            rings[row["part"], row["kind"], row["block"]].append((float(row["along"]), float(row["up"])))
    for (_, _, block), ring in rings.items():
        check(ring[0] == ring[-1], "rings are closed")
        areas[block] += shoelace(ring[:-1])
    return areas


def areas_of_dxf(text, axes):
    lines = text.splitlines()
    pairs = [(int(code), value) for code, value in zip(lines[::2], lines[1::2])]
    check(pairs[-1] == (0, "EOF"), "a DXF ends with EOF")
    areas, polyline = defaultdict(float), None
    for code, value in pairs:
        if code == 0:
            if value == "SEQEND" and polyline["flags"] & 1 and not polyline["layer"].startswith("boundary"):
                areas[polyline["layer"]] += abs(shoelace([[p[a] for a in axes] for p in polyline["points"]]))
            if value == "POLYLINE":
                polyline = {"points": []}
            elif value == "VERTEX":
                polyline["points"].append([0, 0, 0])
            entity = value
        elif entity == "POLYLINE" and code in (8, 70):
            polyline["layer" if code == 8 else "flags"] = value if code == 8 else int(value)
        elif entity == "VERTEX" and code in (10, 20, 30):
            polyline["points"][-1][code // 10 - 1] = float(value)
    return areas


def shapes_of(path):
    """The shapes of a shapefile, each a list of rings or lines, by ESRI's description; and its index agrees."""
    data, index = path.read_bytes(), path.with_suffix(".shx").read_bytes()
    for head in (data, index):
        code, length, version = *struct.unpack(">i20xi", head[:28]), struct.unpack("<i", head[28:32])[0]
        check((code, 2 * length, version) == (9994, len(head), 1000), "the header of a shapefile")
    shapes, at = [], 100
    while at < len(data):
        number, words = struct.unpack(">2i", data[at:at + 8])
        check(struct.unpack(">2i", index[92 + 8 * number:100 + 8 * number]) == (at // 2, words), "the index of a shapefile")
        kind, parts, count = struct.unpack("<i32x2i", data[at + 8:at + 52])
        check(kind == struct.unpack("<i", data[32:36])[0] and kind in (3, 5, 13, 15), f"shapes of type {kind}")
        starts = [*struct.unpack(f"<{parts}i", data[at + 52:at + 52 + 4 * parts]), count]
        begin = at + 52 + 4 * parts
        points = list(struct.iter_unpack("<2d", data[begin:begin + 16 * count]))
        shapes.append([points[a:b] for a, b in zip(starts, starts[1:])])
        at += 8 + 2 * words
        check(number == len(shapes), "records are numbered")
    return shapes


def rows_of(path):
    """The rows of a table of dBase, by its description."""
    data = path.read_bytes()
    count, head, width = struct.unpack("<i2H", data[4:12])
    fields = [data[at:at + 32] for at in range(32, head - 1, 32)]
    rows = []
    for k in range(count):
        row, at = {}, head + k * width + 1
        for field in fields:
            row[field[:11].rstrip(b"\0").decode()] = data[at:at + field[16]].decode().strip()
            at += field[16]
        rows.append(row)
    check(path.with_suffix(".cpg").read_text().strip() == "UTF-8", "names are UTF-8")
    return rows


def areas_of_shp(path):
    areas, shapes, rows = defaultdict(float), shapes_of(path), rows_of(path.with_suffix(".dbf"))
    check(len(shapes) == len(rows), "a row per shape")
    for rings, row in zip(shapes, rows):
        whole = 0
        for number, ring in enumerate(rings):
            check(ring[0] == ring[-1] and (shoelace(ring[:-1]) < 0) == (number == 0), "outer rings are clockwise, holes are not")
            whole -= shoelace(ring[:-1])
        check(abs(whole - float(row["AREA"])) < 1e-6 * whole, "the area is that of the rings")
        areas[row["BLOCK"]] += whole
    return areas


def areas_of_vtp(path, axes):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    data, areas = reader.GetOutput(), defaultdict(float)
    names = data.GetFieldData().GetAbstractArray("surface_name")
    surface = data.GetCellData().GetArray("surface")
    check(names is not None and surface is not None, "a VTP names its surfaces")
    for i in range(data.GetNumberOfCells()):
        points = data.GetCell(i).GetPoints()
        triangle = [[points.GetPoint(k)[a] for a in axes] for k in range(3)]
        areas[names.GetValue(int(surface.GetTuple1(i)))] += abs(shoelace(triangle))
    return areas


def areas_of_svg(text, scale):
    root, areas = ElementTree.fromstring(text), defaultdict(float)
    for path in root.iter(SVG + "path"):
        if path.get("fill-rule") != "evenodd":
            continue
        for number, ring in enumerate(path.get("d").split("Z")[:-1]): # the outer one first
            points = [tuple(map(float, p.split())) for p in re.split("[ML]", ring) if p]
            areas[path.find(SVG + "title").text] += abs(shoelace(points)) / scale * (-1 if number else 1)
    return areas, {t.text for t in root.iter(SVG + "text")}


def same(one, other, tolerance, what):
    check(set(one) == set(other), f"{what} has the blocks {sorted(other)}, not {sorted(one)}")
    for block, area in one.items():
        check(abs(area - other[block]) <= tolerance * area, f"{what}, {block}: {other[block]}, not {area}")


def main():
    program, data = (pathlib.Path(word).absolute() for word in sys.argv[1:])
    folder = pathlib.Path(tempfile.mkdtemp())
    base = [str(program), "section", *(str(data / name) for name in ("top.ts", "base.ts", "fault.ts")),
            "--box", "0,0,-1700,2000,1500,-700", "--quiet"]
    model = base[2:]

    def section(*options):
        names = ["s." + extension for extension in ("geojson", "csv", "dxf", "vtp", "shp", "svg")]
        words = [*base, *options, *(word for name in names for word in ("-o", name))]
        subprocess.run(words, cwd=folder, check=True)
        return [(folder / name).read_text() for name in names if name not in ("s.vtp", "s.shp")]

    plain = lambda areas: {name.replace(" ", "_").replace(",", "_"): area for name, area in areas.items()}
    for options, whole, axes, pixels in ((("--plane", "1000,750,0,0,-1,0"), 2000 * 1000, (0, 2), 0.45 ** 2),
                                         (("--plane", "1000,750,0,1,0,0"), 1500 * 1000, (1, 2), 0.6 ** 2),
                                         (("--level", "-1000"), 2000 * 1500, (0, 1), 0.4 ** 2)):
        geojson, table, dxf, svg = section(*options)
        areas = areas_of_geojson(geojson)
        check(abs(sum(areas.values()) - whole) < 1e-9 * whole, f"{options}: {sum(areas.values())}, not {whole}")
        same(areas, areas_of_csv(table), 1e-9, "CSV")
        same(plain(areas), areas_of_dxf(dxf, axes), 1e-9, "DXF")
        same(areas, areas_of_vtp(str(folder / "s.vtp"), axes), 1e-9, "VTP")
        same(areas, areas_of_shp(folder / "s.shp"), 1e-9, "SHP")
        surfaces = [row["SURFACE"] for row in rows_of(folder / "s_lines.dbf")]
        lines = [f for f in json.loads(geojson)["features"] if f["geometry"]["type"] == "LineString"]
        check(surfaces == [f["properties"]["surface"] for f in lines], "lines are named in their order")
        for shape, line in zip(shapes_of(folder / "s_lines.shp"), lines):
            check([list(p) for p in shape[0]] == [p[:2] for p in line["geometry"]["coordinates"]], "lines of SHP are those of GeoJSON")
        drawn, texts = areas_of_svg(svg, pixels)
        same(areas, drawn, 1e-3, "SVG")
        check(set(areas) <= texts, "the legend names all blocks")
        check({"fault"} <= texts, "lines are named")
    # A block within another one is a hole in it.
    (folder / "nested.obj").write_text(cube("outer", 0, 8) + cube("inner", 3, 5))
    base[2:] = ["nested.obj", "--quiet"]
    geojson, table, _, svg = section("--level", "4")
    areas = areas_of_geojson(geojson)
    check(sorted(areas.values()) == [4, 60], f"{areas} of a cube in a cube")
    for other in (areas_of_csv(table), areas_of_shp(folder / "s.shp"), areas_of_vtp(str(folder / "s.vtp"), (0, 1)),
                  areas_of_svg(svg, 75 ** 2)[0]):
        same(areas, other, 1e-3, "a hole")
    base[2:] = model
    # A geological map shows the blocks below.
    geojson, _, _, svg = section("--by", "top")
    below = {f["properties"]["behind"] for f in json.loads(geojson)["features"] if f["geometry"]["type"] == "Polygon"}
    check(set(areas_of_svg(svg, 1)[0]) == below, "a map shows what is below")
    print("SVG, GeoJSON, SHP, CSV, DXF and VTP agree")


if __name__ == "__main__":
    main()
