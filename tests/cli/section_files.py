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
    for (_, _, block), ring in rings.items(): # of data without holes
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
        for ring in path.get("d").split("Z")[:-1]:
            points = [tuple(map(float, p.split())) for p in re.split("[ML]", ring) if p]
            areas[path.find(SVG + "title").text] += abs(shoelace(points)) / scale
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

    def section(*options):
        names = ["s." + extension for extension in ("geojson", "csv", "dxf", "vtp", "svg")]
        words = [*base, *options, *(word for name in names for word in ("-o", name))]
        subprocess.run(words, cwd=folder, check=True)
        return [(folder / name).read_text() for name in names if name != "s.vtp"]

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
        drawn, texts = areas_of_svg(svg, pixels)
        same(areas, drawn, 1e-3, "SVG")
        check(set(areas) <= texts, "the legend names all blocks")
        check({"fault"} <= texts, "lines are named")
    # A geological map shows the blocks below.
    geojson, _, _, svg = section("--by", "top")
    below = {f["properties"]["behind"] for f in json.loads(geojson)["features"] if f["geometry"]["type"] == "Polygon"}
    check(set(areas_of_svg(svg, 1)[0]) == below, "a map shows what is below")
    print("SVG, GeoJSON, CSV, DXF and VTP agree")


if __name__ == "__main__":
    main()
