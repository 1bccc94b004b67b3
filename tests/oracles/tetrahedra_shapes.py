#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Judges what `terrane build` states of the shapes of tetrahedra by the file that it wrote, with NumPy.

    tests/oracles/tetrahedra_shapes.py --terrane build/release/cli/terrane [--rounds 1]

count    `tetrahedra` is the number of tetrahedra in the file, and so are the sums of all histograms.
shapes   Dihedral angles, ratios of circumradius to shortest edge, SICN and mean ratios: least, mean, largest and histograms are
         those of the file. A value within a millionth of the end of a class may count for either.
causes   Each tetrahedron with an angle below 10 degrees counts for the first cause that applies; the least angle of each
         cause and its place are those of the file.
rounds   With tetrahedra.refine_bad, no round has fewer bad tetrahedra apart from sharp angles of the surfaces than the one that was
         taken, nor as few and fewer misshapen ones; and the counts stated of that are those of the file.

Status 1, with a line for each statement that is wrong.
"""
import argparse
import itertools
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy

BAD = 10
MISSHAPEN = 0.3
KEYS = ("apart", "bad", "misshapen")  # what makes one round better than another, the first key first
EDGES = list(itertools.combinations(range(4), 2))
RATIOS = [0, .75, 1, 1.25, 1.5, 2, 3, 5, 10, 20, 50, 100, numpy.inf]


def build(terrane, data, rounds):
    project = {"format": "terrane-project 1", "folder": "out", "surfaces": [{"file": str(data / "ringmesh" / "modelA1.ml")}],
               "volume_of_interest": {"box": {"low": [-3000, -2500, -2500], "high": [9000, 4500, 1200]}},
               "improve": {"edge_length": 500}, "tetrahedra": {"refine_bad": rounds} if rounds else {},
               "outputs": {"tetrahedra": ["mesh"]}}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "a.json").write_text(json.dumps(project))
        done = subprocess.run([terrane, "build", "a.json"], cwd=folder, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"tetrahedra_shapes: terrane failed: {done.stderr}")
        return read(folder / "out" / "tetrahedra.mesh"), json.loads((folder / "out" / "statistics.json").read_text())


def read(path):
    """Points, tetrahedra, and faces with the reference of their surface."""
    lists, rows = {}, []
    for line in path.read_text().splitlines():
        words = line.split("#")[0].split()
        if words and words[0].isalpha():
            rows = lists.setdefault(words[0], [])
        elif words:
            rows.append([float(w) for w in words])
    faces = numpy.array(lists["Triangles"][1:]).astype(int)
    return (numpy.array(lists["Vertices"][1:])[:, :3], numpy.array(lists["Tetrahedra"][1:])[:, :4].astype(int) - 1,
            faces[:, :3] - 1, faces[:, 3])


# ---- Shapes, by the definitions in docs/reference/statistics.md

def unit(v):
    return v / numpy.linalg.norm(v, axis=-1, keepdims=True)


def angle(u, v):
    """Of Kahan's formula, accurate for all angles."""
    u, v = unit(u), unit(v)
    return numpy.degrees(2 * numpy.arctan2(numpy.linalg.norm(u - v, axis=-1), numpy.linalg.norm(u + v, axis=-1)))


def dihedral(p):
    """Between the parts of the other two corners that are perpendicular to the edge."""
    angles = []
    for i, j in EDGES:
        k, l = (m for m in range(4) if m not in (i, j))
        axis = unit(p[:, j] - p[:, i])
        spokes = [v - (v * axis).sum(axis=1, keepdims=True) * axis for v in (p[:, k] - p[:, i], p[:, l] - p[:, i])]
        angles.append(angle(*spokes))
    return numpy.column_stack(angles)


def edge_lengths(p):
    return numpy.column_stack([numpy.linalg.norm(p[:, j] - p[:, i], axis=1) for i, j in EDGES])


def radius_edge(p):
    """The centre c solves 2 (p_k - p_0) . c = |p_k|^2 - |p_0|^2."""
    q = p - p[:, :1]
    centre = numpy.linalg.solve(2 * q[:, 1:], (q[:, 1:] ** 2).sum(axis=2)[..., None])[..., 0]
    return numpy.linalg.norm(centre, axis=1) / edge_lengths(p).min(axis=1)


def sicn(p):
    regular = numpy.array([[1, 0, 0], [.5, 3 ** .5 / 2, 0], [.5, 3 ** .5 / 6, (2 / 3) ** .5]]).T
    j = (p[:, 1:] - p[:, :1]).transpose(0, 2, 1) @ numpy.linalg.inv(regular)
    return 3 / (numpy.linalg.norm(j, axis=(1, 2)) * numpy.linalg.norm(numpy.linalg.inv(j), axis=(1, 2)))


def mean_ratio(p):
    volume = numpy.linalg.det(p[:, 1:] - p[:, :1]) / 6
    return 12 * (3 * volume) ** (2 / 3) / (edge_lengths(p) ** 2).sum(axis=1)


# ---- Judging

class Judge:
    def __init__(self):
        self.wrong = 0

    def expect(self, what, holds, *details):
        if not holds:
            self.wrong += 1
            print(f"{what} is wrong:", *details)

    def spread(self, name, stated, values, ends):
        found = values.min(), values.mean(), values.max()
        for key, value in zip(("min", "mean", "max"), found):
            self.expect(f"{name}.{key}", abs(stated[key] - value) <= 1e-7 * abs(value) + 1e-7, stated[key], value)
        counts = numpy.array(stated["histogram"])
        self.expect(f"{name}: number of values", counts.sum() == values.size, counts.sum(), values.size)
        flat = values.ravel()
        for k, end in enumerate(ends[1:-1], 1):
            below = counts[:k].sum()
            self.expect(f"{name}: values below {end}",
                        (flat < end - 1e-6).sum() <= below <= (flat < end + 1e-6).sum(), below, (flat < end).sum())


def causes(points, tetrahedra, faces, angles):
    """The cause of each bad tetrahedron, by its number."""
    given = set(map(tuple, numpy.sort(faces, axis=1).tolist()))
    on_surface = set(faces.ravel().tolist())
    found = {}
    for t in numpy.flatnonzero(angles.min(axis=1) < BAD).tolist():
        corners = tetrahedra[t].tolist()
        opposite = [tuple(sorted(corners[:k] + corners[k + 1:])) in given for k in range(4)]
        sharp = [all(opposite[m] for m in range(4) if m not in edge) and angles[t, e] < BAD for e, edge in enumerate(EDGES)]
        thin = any(opposite[k] and least_corner(points, corners[:k] + corners[k + 1:]) < BAD for k in range(4))
        found[t] = ("input_angle" if any(sharp) else "thin_triangle" if thin
                    else "gap" if all(v in on_surface for v in corners) else "other")
    return found


def least_corner(points, face):
    a, b, c = points[face]
    return min(angle(b - a, c - a), angle(a - b, c - b), angle(a - c, b - c))


def apart(points, tetrahedra, faces, surface_of, angles, cause):
    """How many bad tetrahedra touch no sharp angle of the surfaces, and how many others of a low mean ratio do not."""
    at_edge = {}
    for f, face in enumerate(faces.tolist()):
        for i, j in itertools.combinations(sorted(face), 2):
            at_edge.setdefault((i, j), []).append(surface_of[f])
    sharp = {v for t, why in cause.items() if why == "input_angle" for v in sharp_ends(tetrahedra[t], faces_of(faces), angles[t])}
    for face in faces.tolist():
        for k in range(3):
            a, b, c = face[k], face[(k + 1) % 3], face[(k + 2) % 3]
            if angle(points[b] - points[a], points[c] - points[a]) < BAD and all(
                    len(at_edge[min(a, v), max(a, v)]) != 2 or len(set(at_edge[min(a, v), max(a, v)])) == 2 for v in (b, c)):
                sharp.add(a)
    low = set(numpy.flatnonzero(mean_ratio(points[tetrahedra]) < MISSHAPEN).tolist()) - set(cause)
    return [sum(not sharp.intersection(tetrahedra[t].tolist()) for t in which) for which in (cause, low)]


def faces_of(faces, kept={}):
    return kept.setdefault(id(faces), set(map(tuple, numpy.sort(faces, axis=1).tolist())))


def sharp_ends(corners, given, angles):
    for (i, j), degrees in zip(EDGES, angles):
        if degrees < BAD and all(tuple(sorted(numpy.delete(corners, k).tolist())) in given for k in range(4) if k not in (i, j)):
            yield from (corners[i], corners[j])


def judge_bad(judge, stated, points, tetrahedra, cause, angles):
    judge.expect("bad.tetrahedra", stated["tetrahedra"] == len(cause), stated["tetrahedra"], len(cause))
    for key in ("input_angle", "thin_triangle", "gap", "other"):
        mine = [t for t, why in cause.items() if why == key]
        of_key = stated[key]
        judge.expect(f"bad.{key}.tetrahedra", of_key["tetrahedra"] == len(mine), of_key["tetrahedra"], len(mine))
        if not mine or not of_key["tetrahedra"]:
            judge.expect(f"bad.{key} without any", of_key["least"] is None and of_key["place"] is None or mine, of_key)
            continue
        least = min(angles[t].min() for t in mine)
        judge.expect(f"bad.{key}.least", abs(of_key["least"] - least) < 1e-6, of_key["least"], least)
        places = [points[tetrahedra[t]].mean(axis=0) for t in mine if angles[t].min() < least + 1e-6]
        judge.expect(f"bad.{key}.place", any(numpy.allclose(of_key["place"], p, rtol=0, atol=1e-6) for p in places), of_key["place"])


def judge_rounds(judge, stated, count, bad, clear, misshapen):
    rounds, taken = stated["rounds"], stated["taken_round"]
    judge.expect("number of rounds", len(rounds) >= 1 and taken < len(rounds), rounds, taken)
    judge.expect("taken round", all([rounds[taken][k] for k in KEYS] <= [r[k] for k in KEYS] for r in rounds), rounds)
    of_file = {"tetrahedra": count, **dict(zip(KEYS, (clear, bad, misshapen)))}
    for key, value in of_file.items():
        judge.expect(f"rounds[{taken}].{key}", rounds[taken][key] == value, rounds[taken][key], value)


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--terrane", required=True, type=pathlib.Path)
    arguments.add_argument("--rounds", default=1, type=int)
    options = arguments.parse_args()
    data = pathlib.Path(__file__).resolve().parents[1] / "data"
    (points, tetrahedra, faces, surface_of), statistics = build(options.terrane.resolve(), data, options.rounds)
    p, stated, judge = points[tetrahedra], statistics["tetrahedra"], Judge()
    judge.expect("tetrahedra", stated["tetrahedra"] == len(tetrahedra), stated["tetrahedra"], len(tetrahedra))
    angles, check = dihedral(p), stated["check"]
    judge.spread("dihedral", check["dihedral"], angles, range(0, 190, 10))
    judge.spread("radius_edge", check["radius_edge"], radius_edge(p), RATIOS)
    judge.spread("sicn", check["sicn"], sicn(p), numpy.arange(11) / 10)
    judge.spread("mean_ratio", check["mean_ratio"], mean_ratio(p), numpy.arange(11) / 10)
    cause = causes(points, tetrahedra, faces, angles)
    judge_bad(judge, check["bad"], points, tetrahedra, cause, angles)
    clear, misshapen = apart(points, tetrahedra, faces, surface_of, angles, cause)
    if options.rounds:
        judge_rounds(judge, stated, len(tetrahedra), len(cause), clear, misshapen)
    print(f"{len(tetrahedra)} tetrahedra, {len(cause)} below {BAD} degrees, {clear} of them apart from such angles of the surfaces, "
          f"{misshapen} others misshapen: {judge.wrong} statements are wrong")
    return 1 if judge.wrong or not cause else 0


sys.exit(main())
