#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Arranges closed units that were cut from one volume and meshed apart, so that their contacts nearly coincide.

    tests/oracles/coincident_units.py --terrane build/release/cli/terrane [--count 2000] [--seed 1] [--kind NAME]
        [--units N] [--cells N] [--keep DIR] [--options "..."] [--threads N] [--page FILE]

A model is a box of warped cells, each of which belongs to the unit of the nearest of N seeds. A unit is the boundary of its
cells, in triangles that it divides by itself: at other points of the edges, about other points inside. So neighbours share no
vertices but those of the cells, and their contacts coincide but for the rounding of coordinates. Kinds:

doubles   as computed
float32   rounded to float32
decimals  rounded to three decimals
moved     each vertex moved by up to 1, 1e2, 1e4 or 1e6 spacings of the doubles
Each may be shifted to map coordinates of millions of metres (utm).

Each model must end in a conforming mesh, as `terrane check` says of the file, within the default limit of moves, or with the limit named that would do, within which
it must then end conforming. The greatest numbers of all models of a row are in the table.

With --tolerance F, T is F times the largest distance of a vertex from where it was computed (1e-9 of the model where that
is less). `terrane volume --tolerance T` must then find exactly the parts of units that hang together, each with the volume
that its cells have, but for T times the area around it, and no vertex of a surface may be farther than T from where the
surface was, nor one that was there from the surface; some vertices are tested. No edge may be shorter than T / 256.
With --tetrahedra the blocks are meshed, too.

Prints a line for each model that does not, and a table; status 1 if there is one.
"""
import argparse
import collections
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

import numpy as np

BEGIN, END = "<!-- made by tests/oracles/coincident_units.py -->", "<!-- end of the table -->"
KINDS = ("doubles", "float32", "decimals", "moved", "doubles_utm", "float32_utm", "decimals_utm", "moved_utm")
CORNERS = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)])
#: Faces of a cell, outward: four of its corners, and the neighbour across.
FACES = [((0, 2, 3, 1), (0, 0, -1)), ((4, 5, 7, 6), (0, 0, 1)), ((0, 1, 5, 4), (0, -1, 0)), ((2, 6, 7, 3), (0, 1, 0)),
         ((0, 4, 6, 2), (-1, 0, 0)), ((1, 3, 7, 5), (1, 0, 0))]


def cells_of(rng, units, cells):
    """Corners of warped cells by (i, j, k), and the unit of each cell."""
    size = np.array([cells, cells, max(2, cells // 2)])
    grid = np.stack(np.meshgrid(*(np.arange(n + 1.0) for n in size), indexing="ij"), axis=-1)
    inner = np.ones(grid.shape, bool)
    for axis, n in enumerate(size):
        inner[..., axis] &= (grid[..., axis] > 0) & (grid[..., axis] < n)
    points = (grid + inner * rng.uniform(-0.2, 0.2, grid.shape)) * np.array([100.0, 100.0, 60.0])
    middles = np.stack(np.meshgrid(*(np.arange(n) + 0.5 for n in size), indexing="ij"), axis=-1)
    seeds = rng.uniform(0, 1, (units, 3)) * size
    return points, np.argmin(((middles[..., None, :] - seeds) ** 2).sum(-1), axis=-1)


def faces_of(labels, unit):
    """Triangles on the boundary of a unit, as corners (i, j, k)."""
    triangles = []
    for cell in np.argwhere(labels == unit):
        for corners, step in FACES:
            across = cell + step
            if (across >= 0).all() and (across < labels.shape).all() and labels[tuple(across)] == unit:
                continue
            a, b, c, d = (tuple(cell + CORNERS[k]) for k in corners)
            # Both sides of a face have the same diagonal: that through its least corner.
            if min(a, b, c, d) in (a, c):
                triangles += [(a, b, c), (a, c, d)]
            else:
                triangles += [(a, b, d), (b, c, d)]
    return triangles


def divided(rng, points, triangles):
    """Vertices and triangles of a unit, which divides edges and faces by itself."""
    vertices, number = [], {}

    def vertex(key, place):
        if key not in number:
            number[key] = len(vertices)
            vertices.append(place)
        return number[key]

    cuts, out = {}, []
    for corners in triangles:
        ring = []
        for a, b in zip(corners, corners[1:] + corners[:1]):
            ring.append(vertex(a, points[a]))
            edge = (min(a, b), max(a, b))
            if edge not in cuts:
                cuts[edge] = sorted(rng.uniform(0.15, 0.85, rng.integers(0, 3)))
            places = [(edge, i, points[edge[0]] * (1 - t) + points[edge[1]] * t) for i, t in enumerate(cuts[edge])]
            for e, i, place in places if edge[0] == a else reversed(places):
                ring.append(vertex((e, i), place))
        weights = rng.dirichlet((4, 4, 4))
        middle = vertex((corners, "middle"), sum(w * points[c] for w, c in zip(weights, corners)))
        out += [(u, v, middle) for u, v in zip(ring, ring[1:] + ring[:1])]
    return np.array(vertices), np.array(out)


def model(seed, kind, units, cells):
    """(name, vertices, triangles) of each unit, and the volumes of the units."""
    rng = np.random.default_rng(seed)
    units = units or int(rng.integers(2, 41))
    cells = cells or int(rng.integers(3, 7))
    points, labels = cells_of(rng, units, cells)
    if kind.endswith("utm"):
        points = points + np.array([480000.0, 6900000.0, -1500.0])
    moves = float(rng.choice((1, 1e2, 1e4, 1e6)))
    out = []
    misfit = 0.0
    for unit in np.unique(labels):
        vertices, triangles = divided(rng, points, faces_of(labels, unit))
        computed = vertices
        if kind.startswith("float32"):
            vertices = vertices.astype(np.float32).astype(float)
        elif kind.startswith("decimals"):
            vertices = np.round(vertices, 3)
        elif kind.startswith("moved"):
            vertices = vertices + rng.uniform(-moves, moves, vertices.shape) * np.spacing(np.abs(points).max())
        misfit = max(misfit, np.sqrt(((vertices - computed) ** 2).sum(1)).max())
        out.append(("unit%d" % unit, vertices, triangles))
    return out, parts_of(points, labels), misfit


def parts_of(points, labels):
    """(volume, area around it) of each part of a unit that hangs together across faces of its cells."""
    part = np.full(labels.shape, -1)
    parts = []
    for start in np.argwhere(labels >= 0):
        if part[tuple(start)] >= 0:
            continue
        number, unit, todo, volume, area = len(parts), labels[tuple(start)], [tuple(start)], 0.0, 0.0
        part[tuple(start)] = number
        while todo:
            cell = todo.pop()
            for corners, step in FACES:
                a, b, c, d = (points[tuple(np.array(cell) + CORNERS[k])] for k in corners)
                index = [tuple(np.array(cell) + CORNERS[k]) for k in corners]
                pair = [(a, b, c), (a, c, d)] if min(index) in (index[0], index[2]) else [(a, b, d), (b, c, d)]
                across = tuple(np.array(cell) + step)
                is_inside = all(0 <= i < n for i, n in zip(across, labels.shape))
                if is_inside and labels[across] == unit:
                    if part[across] < 0:
                        part[across] = number
                        todo.append(across)
                    continue
                for p, q, r in pair:
                    volume += np.dot(p - points[0, 0, 0], np.cross(q - points[0, 0, 0], r - points[0, 0, 0])) / 6
                    area += np.linalg.norm(np.cross(q - p, r - p)) / 2
        parts.append((volume, area))
    return parts


def write(units, path):
    lines, first = [], 1
    for name, vertices, triangles in units:
        lines.append("o " + name)
        lines += ["v %.17g %.17g %.17g" % tuple(v) for v in vertices]
        lines += ["f %d %d %d" % tuple(t + first) for t in triangles]
        first += len(vertices)
    pathlib.Path(path).write_text("\n".join(lines) + "\n")


def run(args, path, folder, more=()):
    """What arrange says, its statistics, and the seconds that it took."""
    stats = folder / "stats.json"
    stats.unlink(missing_ok=True)
    begin = time.perf_counter()
    made = subprocess.run([args.terrane, "arrange", path, "-o", folder / "out.obj", "--stats", stats, "--threads", str(args.threads),
                           *args.options.split(), *more], capture_output=True, text=True)
    seconds = time.perf_counter() - begin
    if made.returncode == 0:
        made.returncode = subprocess.run([args.terrane, "check", folder / "out.obj"], capture_output=True).returncode * 100
    return made, json.loads(stats.read_text()) if stats.exists() else {}, seconds


def judge(args, path, folder):
    """(how it ended, what is wrong, statistics, seconds)."""
    made, stats, seconds = run(args, path, folder)
    if made.returncode == 0:
        return "conforming", "", stats, seconds
    named = re.search(r"--max-move (\S+) would do", made.stderr + made.stdout)
    if made.returncode == 1 and named:
        again, stats, more = run(args, path, folder, ("--max-move", named[1]))
        if again.returncode == 0:
            return "named", "", stats, seconds + more
        return "failed", "with --max-move %s: status %d" % (named[1], again.returncode), stats, seconds + more
    left = stats.get("rounding", {}).get("contacts")
    return "failed", "status %d, %s of %s pairs left" % (made.returncode, left, stats.get("rounding", {}).get("naive_contacts")), stats, seconds


def distances(places, vertices, triangles):
    """Distance of each place from the triangles; all pairs are compared."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    ab, ac = b - a, c - a
    normal = np.cross(ab, ac)
    square = np.maximum((normal ** 2).sum(1), 1e-300)
    out = []
    for p in places:
        ap = p - a
        height = (ap * normal).sum(1)
        v = (np.cross(ap, ac) * normal).sum(1) / square
        w = (np.cross(ab, ap) * normal).sum(1) / square
        best = np.where((v >= 0) & (w >= 0) & (v + w <= 1), np.abs(height) / np.sqrt(square), np.inf)
        for start, end in ((a, b), (b, c), (c, a)):
            along = end - start
            t = np.clip(((p - start) * along).sum(1) / np.maximum((along ** 2).sum(1), 1e-300), 0, 1)
            best = np.minimum(best, np.linalg.norm(p - start - t[:, None] * along, axis=1))
        out.append(best.min())
    return np.array(out)


def read_surfaces(path):
    """Vertices of a file, and the triangles of each surface; a triangle has one group for each."""
    vertices, surfaces, groups = [], collections.defaultdict(list), []
    for line in pathlib.Path(path).read_text().splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            vertices.append([float(w) for w in words[1:4]])
        elif words[0] == "g":
            groups = words[1:]
        elif words[0] == "f":
            for group in groups:
                surfaces[group].append([int(w.split("/")[0]) - 1 for w in words[1:]])
    return np.array(vertices), {name: np.array(faces) for name, faces in surfaces.items()}


def moved_too_far(units, path, tolerance, rng):
    """The farthest of some vertices from the other state of their surface, where it is beyond the tolerance."""
    vertices, surfaces = read_surfaces(path)
    worst = 0.0
    for name, before, triangles in units:
        after = surfaces.get(name)
        if after is None:
            return np.inf
        there = vertices[np.unique(after)]
        some = [places[rng.permutation(len(places))[:40]] for places in (there, before)]
        worst = max(worst, distances(some[0], before, triangles).max(), distances(some[1], vertices, after).max())
    return worst if worst > tolerance * (1 + 1e-9) else 0.0


def shortest_edge(path):
    vertices, surfaces = read_surfaces(path)
    corners = vertices[np.vstack(list(surfaces.values()))]
    return np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=-1).min()


def judge_joined(args, made, tolerance, path, folder):
    """(how it ended, what is wrong, statistics, seconds)."""
    units, parts, _ = made
    stats, seconds = folder / "stats.json", 0.0
    told = {}
    shutil.rmtree(folder / "out", ignore_errors=True)
    commands = [("volume", folder / "out"), ("arrange", folder / "out.obj")]
    if args.tetrahedra:
        commands.append(("tetrahedralize", folder / "out.vtu"))
    for command, out in commands:
        begin = time.perf_counter()
        ran = subprocess.run([args.terrane, command, path, "-o", out, "--tolerance", repr(float(tolerance)), "--threads", str(args.threads),
                              *(("--stats", stats) if command == "volume" else ()), *args.options.split()], capture_output=True, text=True)
        if ran.returncode:
            return "failed", "%s: status %d, %s" % (command, ran.returncode, ran.stderr[-200:].strip()), told, seconds
        if command == "volume":
            seconds = time.perf_counter() - begin
            told = json.loads(stats.read_text())
    found, wanted = sorted(told["volumes"]["blocks"]), sorted(parts)
    if len(found) != len(wanted):
        return "failed", "%d blocks, not %d; %d thin ones left, the least of %.3g" % (
            len(found), len(wanted), len(told["tolerance"]["left"]), found[0]), told, seconds
    for have, (want, area) in zip(found, wanted):
        if abs(have - want) > tolerance * area:
            return "failed", "volume %.9g, not %.9g" % (have, want), told, seconds
    worst = moved_too_far(units, folder / "out.obj", tolerance, np.random.default_rng(1))
    if worst:
        return "failed", "moved by %.3g, tolerance %.3g" % (worst, tolerance), told, seconds
    shortest = shortest_edge(folder / "out.obj")
    if shortest < tolerance / 256:
        return "failed", "an edge of %.3g, tolerance %.3g" % (shortest, tolerance), told, seconds
    return "joined", "", told, seconds


def table_of(table, tolerance):
    """The table in Markdown. Seconds are those of all runs of a model, --max-move as named included."""
    ends = ("joined", "failed") if tolerance else ("conforming", "named", "failed")
    lines = ["| kind | units | models | " + " | ".join(ends) + " | triangles | pairs | surfaces moved | seconds: median | most |",
             "|---" * (8 + len(ends)) + "|"]
    for (kind, size), row in sorted(table.items()):
        lines.append("| %s | up to %d | %d | %s | %s | %s | %.2g | %.2g | %.2g |" % (
            kind, size, len(row["seconds"]), " | ".join(str(len(row[end])) for end in ends),
            *("{:,}".format(max(row[what])).replace(",", " ") for what in ("triangles", "pairs")), max(row["moves"]),
            np.median(row["seconds"]), max(row["seconds"])))
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--terrane", required=True)
    parser.add_argument("--count", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kind", choices=KINDS)
    parser.add_argument("--units", type=int, default=0, help="2 to 40 unless given")
    parser.add_argument("--cells", type=int, default=0, help="along each side; 3 to 6 unless given")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--tolerance", type=float, help="in misfits, > 1")
    parser.add_argument("--tetrahedra", action="store_true", help="with --tolerance: mesh the blocks, too")
    parser.add_argument("--options", default="", help="for terrane arrange")
    parser.add_argument("--keep", type=pathlib.Path, help="keep the models that fail in this folder")
    parser.add_argument("--page", type=pathlib.Path, help="put the table between its two marks in this page")
    args = parser.parse_args()
    table = collections.defaultdict(lambda: collections.defaultdict(list))
    failures = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for seed in range(args.seed, args.seed + args.count):
            kind = args.kind or KINDS[seed % len(KINDS)]
            path = folder / ("units%d.obj" % seed)
            made = model(seed, kind, args.units, args.cells)
            write(made[0], path)
            if args.tolerance:
                tolerance = args.tolerance * max(made[2], 1e-9 * np.abs(made[0][0][1]).max())
                end, what, stats, seconds = judge_joined(args, made, tolerance, path, folder)
            else:
                end, what, stats, seconds = judge(args, path, folder)
            rounding = stats.get("rounding", {})
            size = next(most for most in (5, 10, 20, 40) if len(made[0]) <= most)
            row = table[kind, size]
            row[end].append(seed)
            row["triangles"].append(stats.get("input", {}).get("triangles", 0))
            row["pairs"].append(rounding.get("naive_contacts", 0))
            row["moves"].append(rounding.get("surface_deviation", 0))
            row["seconds"].append(seconds)
            if end == "failed":
                failures += 1
                print("units%d (%s): %s; %.3g s" % (seed, kind, what, seconds), flush=True)
                if args.keep:
                    args.keep.mkdir(exist_ok=True)
                    path.replace(args.keep / path.name)
            path.unlink(missing_ok=True)
    text = table_of(table, args.tolerance)
    print(text, end="")
    if args.page:
        page = args.page.read_text()
        begin = page.index(BEGIN) + len(BEGIN)
        args.page.write_text(page[:begin] + "\n\n" + text + "\n" + page[page.index(END, begin):])
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
