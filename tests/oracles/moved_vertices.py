#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Builds random models whose vertices move where tetrahedra are bad, and judges the files by what is promised.

    tests/oracles/moved_vertices.py --terrane build/release/cli/terrane [--count 100] [--seed 1] [--verbose]

The models are those of improved.py, in half of them within a box. Each is built with `tetrahedra.move_vertices` and
without; in half of them with `improve.resolution`, and in half of these in rounds (`tetrahedra.refine_bad`).

tetrahedra  Each has a positive volume, by fractions. Each triangle of the surfaces is a face of one. They fill what the
            tetrahedra of the other build fill.
blocks      block_volumes.py finds as many in the surfaces of both builds; without a resolution, no block differs by more than 5 %
            from the arranged one, unless it did before vertices moved.
distance    No sampled point of a surface is farther from it as it was than the bound that is stated, or the resolution.
curves      Without a resolution, vertices of two surfaces or more are where they are in the other build.
box         Vertices on the sides of the box stay there.
gain        Where there are no rounds, which lead to other triangles, all models together have no more tetrahedra with an angle below
            10 degrees than in the other builds, and none has a smaller least angle by more than a degree.

Prints one line for each model that breaks a promise, and a summary with how many models have moved vertices. Status 1 if any
model breaks a promise, or no vertex of any has moved.
"""
import argparse
import json
import pathlib
import random
import sys
import tempfile
from fractions import Fraction

import numpy

import block_volumes
import improved

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
import tetrahedra_measures as measures  # pylint: disable=wrong-import-position


class Built:
    """What a build wrote."""

    def __init__(self, folder):
        self.surfaces = improved.read_obj(folder / "surfaces.obj")
        self.stats = json.loads((folder / "statistics.json").read_text())
        self.mesh = measures.read_medit(folder / "tetrahedra.mesh")
        self.moved = self.stats["tetrahedra"]["moved_vertices"]["count"]
        angles = measures.dihedral_angles(self.mesh.points, self.mesh.corners)
        self.bad, self.least = int((angles.min(axis=1) < 10).sum()), float(angles.min())


def build(terrane, folder, project, moves, rounds):
    name = "moved" if moves else "still"
    project = {**project, "folder": name, "tetrahedra": {"move_vertices": moves, "outside": True, "refine_bad": rounds}}
    (folder / f"{name}.json").write_text(json.dumps(project))
    return improved.run(terrane, "build", folder / f"{name}.json")


def six_volume(p, q, r, s):
    return block_volumes.dot(block_volumes.minus(q, p), block_volumes.cross(block_volumes.minus(r, p), block_volumes.minus(s, p)))


def tetrahedra_flaws(built, other):
    points, factor = block_volumes.scaled(built.mesh.points.tolist())
    volumes = [six_volume(*(points[v] for v in c)) for c in built.mesh.corners.tolist()]
    flaws = [f"{sum(v <= 0 for v in volumes)} tetrahedra have no volume"] if min(volumes) <= 0 else []
    vertices, triangles, _ = built.surfaces
    if divided := measures.divided_triangles(built.mesh, numpy.array(vertices), numpy.array(triangles)):
        flaws.append(f"{divided} triangles are no faces")
    there, other_factor = block_volumes.scaled(other.mesh.points.tolist())
    whole = sum(six_volume(*(there[v] for v in c)) for c in other.mesh.corners.tolist())
    if Fraction(sum(volumes), factor**3) != Fraction(whole, other_factor**3):
        flaws.append("the tetrahedra do not fill what the others fill")
    return flaws


def volumes_of(surfaces):
    return sorted(float(volume) for volume, _ in block_volumes.blocks(surfaces[0], surfaces[1]))


def block_flaws(plain, still, moved, resolution):
    before, after = volumes_of(still.surfaces), volumes_of(moved.surfaces)
    if len(before) != len(after):
        return [f"{len(after)} blocks instead of {len(before)}"]
    if resolution:
        return []
    given = volumes_of(plain)
    return [f"a block of {v:.6g} has become one of {y:.6g}, and was {x:.6g} before" for v, x, y in zip(given, before, after)
            if abs(y - v) > .05 * v and abs(y - v) > abs(x - v)]


def of_surface(surfaces, name):
    return [[surfaces[0][i] for i in t] for t, names in zip(surfaces[1], surfaces[2]) if name in names]


def distance_flaws(plain, moved, resolution, rng):
    flaws = []
    rounding = 1e-12 * max(abs(x) for v in plain[0] for x in v)
    names = sorted({name for names in plain[2] for name in names})
    bounds = moved.stats["deviation"]["bound_of_surfaces"]
    for name in names:
        old, new = of_surface(plain, name), of_surface(moved.surfaces, name)
        if not new:
            continue  # what is smaller than the resolution may vanish
        out, back = improved.farthest(new, old, rng), improved.farthest(old, new, rng)
        most = resolution or max(bounds)
        if out > most + rounding or (resolution and back > most + rounding):
            flaws.append(f"{name} is {out:.4g} away, {back:.4g} back, more than {most:.4g}")
    return flaws


def curve_flaws(still, moved):
    at = [{} for _ in still.surfaces[0]]
    for t, names in zip(still.surfaces[1], still.surfaces[2]):
        for v in t:
            at[v].update(dict.fromkeys(names))
    if still.surfaces[1] != moved.surfaces[1]:
        return ["the triangles have other corners"]
    gone = sum(len(names) > 1 and p != q for names, p, q in zip(at, still.surfaces[0], moved.surfaces[0]))
    return [f"{gone} vertices of curves have moved"] if gone else []


def box_flaws(moved, box):
    if not box:
        return []
    vertices = moved.surfaces[0]
    sides = [(k, end[k]) for end in box for k in range(3)]
    off = sum(any(n.startswith("boundary") for n in names) and
              not any(all(vertices[v][k] == at for v in t) for k, at in sides)
              for t, names in zip(moved.surfaces[1], moved.surfaces[2]))
    return [f"{off} triangles of the box are not on its sides"] if off else []


def judge(terrane, seed):
    rng = random.Random(seed)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        paths, size = improved.model_files(rng, folder, None)
        size = size or 1000.
        vertices = numpy.concatenate([numpy.array(improved.read_obj(p)[0]) for p in paths])
        extent = float((vertices.max(axis=0) - vertices.min(axis=0)).max())
        length = extent * rng.choice([.1, .2])
        resolution = length * rng.choice([.1, .3]) if rng.random() < .5 else 0.
        rounds = rng.choice([0, 2]) if resolution else 0
        project = {"format": "terrane-project 1", "surfaces": [{"file": p} for p in paths],
                   "improve": {"edge_length": length, **({"resolution": resolution} if resolution else {})},
                   "outputs": {"surfaces": ["obj"], "tetrahedra": ["mesh"]}}
        box = None
        if rng.random() < .5:
            low, high = vertices.min(axis=0) + .13 * extent, vertices.max(axis=0) - .13 * extent
            low[2], high[2] = vertices[:, 2].min() - .2 * extent, vertices[:, 2].max() + .2 * extent
            box = (low.tolist(), high.tolist())
            project["volume_of_interest"] = {"box": {"low": box[0], "high": box[1]}}
        made = [build(terrane, folder, project, moves, rounds) for moves in (False, True)]
        if made[0].returncode != 0:
            return "not built", [] if made[1].returncode != 0 else ["built only with vertices that move"], 0
        if made[1].returncode != 0:
            return "failed", [f"status {made[1].returncode}: {made[1].stderr.strip()[-200:]}"], 0
        still, moved = Built(folder / "still"), Built(folder / "moved")
        options = [f"--box={','.join(map(repr, box[0] + box[1]))}"] if box else []
        arranged = improved.run(terrane, "arrange", *paths, "-o", folder / "plain.obj", *options)
        if arranged.returncode != 0:
            return "failed", [f"arrange: {arranged.stderr.strip()[-200:]}"], 0
        plain = improved.read_obj(folder / "plain.obj")
        flaws = (tetrahedra_flaws(moved, still) + block_flaws(plain, still, moved, resolution) +
                 distance_flaws(plain, moved, resolution, rng) + box_flaws(moved, box))
        if not resolution:
            flaws += curve_flaws(still, moved)
        if not rounds and moved.least < still.least - 1:
            flaws.append(f"the least angle is {moved.least:.3g} instead of {still.least:.3g} degrees")
        kind = (f"{'vertices moved' if moved.moved else 'none moved'}{', with a resolution' if resolution else ''}"
                f"{', in rounds' if rounds else ''}")
        gain = 0 if rounds else still.bad - moved.bad
        return f"{kind}; {still.bad} -> {moved.bad} bad, {still.least:.3g} -> {moved.least:.3g} degrees", flaws, gain


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--terrane", required=True, type=pathlib.Path, help="the program")
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1, help="of the first model; the others follow")
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    terrane = options.terrane.resolve()
    broken, outcomes, fewer = 0, {}, 0
    for seed in range(options.seed, options.seed + options.count):
        outcome, flaws, gain = judge(terrane, seed)
        fewer += gain
        kind = outcome.split(";")[0]
        outcomes[kind] = outcomes.get(kind, 0) + 1
        broken += bool(flaws)
        if flaws or options.verbose:
            print(f"model {seed}: {outcome}; {'; '.join(flaws) or 'holds'}", flush=True)
    print(f"{options.count} models, {broken} break a promise; {fewer} bad tetrahedra less; outcomes: {outcomes}")
    return 1 if broken or fewer < 0 or not any(kind.startswith("vertices moved") for kind in outcomes) else 0


if __name__ == "__main__":
    sys.exit(main())
