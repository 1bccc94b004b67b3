#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Fills holes of random surfaces, whose truth is known, and judges heights and expected errors.

Each draw has a truth (planes, domes, waves, saddles, steps, fields with exponential, Matern and gaussian
covariance, sums of two), an amplitude, noise of 0 to 30 %, a mesh, and a hole of 1 to 30 % of the area (round,
long, irregular, with an island, next to the outer border). The program fills it. Others fill it from the same
vertices: SciPy's thin plates, cubic radial basis functions and linear interpolation, and universal kriging of
degree 0 to 2 with exponential covariance; fields are also estimated with their true covariance. Nothing here is
shared with the program.

  tests/oracles/filled_fields.py --draws 2000 --jobs 2

With --real, the surfaces of files are punched at random places instead, and the vertices that are taken out are the
truth, up to the rounding of their coordinates: the new triangles are compared with it. Holes and others are the same;
the program converts the files, and a place where it says that the surface is no graph is left for another one.

  tests/oracles/filled_fields.py --draws 200 --real horizons.ts seabed.irap

The exit status is 1 where a limit is exceeded. Seeds are those of the clock, unless --seed gives the first."""

import argparse
import functools
import json
import os
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
try:
    import numpy as np
    from scipy.interpolate import LinearNDInterpolator, RBFInterpolator
    from scipy.linalg import solve_triangular
    from scipy.spatial.distance import cdist
except ImportError as missing:
    print(f"nothing is judged: {missing} (Debian: python3-scipy)")
    sys.exit(0)

SIZE = 1000.0
COVARIANCES = {
    "exponential": lambda h: np.exp(-h),
    "matern 3/2": lambda h: (1 + h) * np.exp(-h),
    "matern 5/2": lambda h: (1 + h + h * h / 3) * np.exp(-h),
    "gaussian": lambda h: np.exp(-h * h / 2),
}
JITTER = 1e-9  # of the variance, by which fields are rough so that they can be drawn


def directions(rng):
    turn = rng.uniform(0, 2 * np.pi)
    return np.array([np.cos(turn), np.sin(turn)]), np.array([-np.sin(turn), np.cos(turn)])


def smooth_truth(rng):
    kind = rng.choice(["plane", "dome", "wave", "saddle", "step"])
    middle, (u, v) = rng.uniform(200, 800, 2), directions(rng)
    if kind == "plane":
        return kind, lambda p: (p - 500) @ u / 300
    if kind == "dome":
        wide = rng.uniform(200, 500)
        high = wide * rng.uniform(0.5, 1)
        return kind, lambda p: 2 * np.exp(-(((p - middle) @ u / wide) ** 2 + ((p - middle) @ v / high) ** 2) / 2)
    if kind == "wave":
        length, other, phase = rng.uniform(500, 2000), rng.uniform(800, 4000), rng.uniform(0, 2 * np.pi)
        return kind, lambda p: 1.4 * np.sin(2 * np.pi * (p @ u) / length + phase) * np.cos(2 * np.pi * (p @ v) / other)
    if kind == "saddle":
        ratio = rng.uniform(-1, 1)
        return kind, lambda p: (((p - middle) @ u) ** 2 + ratio * ((p - middle) @ v) ** 2) / 300**2
    width = rng.uniform(50, 300)
    return kind, lambda p: np.tanh((p - middle) @ u / width)


def hole_of(rng):
    """Returns the kind, the share of the area, and a function that tells whether places are inside."""
    kind = rng.choice(["round", "long", "irregular", "island", "border"])
    share = np.exp(rng.uniform(np.log(0.01), np.log(0.30)))
    radius, (u, v) = np.sqrt(share / np.pi) * SIZE, directions(rng)
    stretch = np.sqrt(min(rng.uniform(1.5, 4), max(1, (430 / radius) ** 2))) if kind == "long" else 1
    phases, waves = rng.uniform(0, 2 * np.pi, 6), rng.uniform(0, 0.3, 6) / np.arange(1, 7)
    waves *= kind == "irregular"
    island = rng.uniform(0.2, 0.5) if kind == "island" else 0
    margin = min(radius * stretch + 40, 500)
    middle = rng.uniform(margin, SIZE - margin, 2)
    if kind == "border":
        radius = min(radius, 420)
        middle = np.array([rng.uniform(radius + 60, SIZE - radius - 60), radius + rng.uniform(65, 110)])

    def inside(p):
        x, y = (p - middle) @ u / stretch, (p - middle) @ v * stretch
        angle, distance = np.arctan2(y, x), np.hypot(x, y)
        rim = radius * (1 + sum(w * np.cos((i + 2) * angle + f) for i, (w, f) in enumerate(zip(waves, phases))))
        return (distance < rim) & (distance >= island * rim)

    return kind, share, inside


class Draw:
    def __init__(self, seed):
        rng = self.rng = np.random.default_rng(seed)
        self.points = np.zeros((0, 2))
        while len(self.points) < 20:  # a hole may leave nothing, or be none
            self.hole, self.share, inside = hole_of(rng)
            self.make_mesh(rng, inside)
        self.parts, self.covariances, smooth = [], [], []
        for i in range(1 + (rng.random() < 0.3)):
            height = rng.uniform(0.3, 1) if i else 1.0
            if rng.random() < 0.5:
                kind, function = smooth_truth(rng)
                smooth.append((height, function))
            else:
                kind = rng.choice(list(COVARIANCES))
                length = np.exp(rng.uniform(np.log(60), np.log(500)))
                if kind == "gaussian":
                    length = np.clip(length, 100, 300)
                self.covariances.append((height**2, kind, length))
            self.parts.append(str(kind))
        self.smooth = lambda p: sum((h * f(p) for h, f in smooth), np.zeros(len(p)))
        self.field = np.zeros(len(self.points))
        if self.covariances:
            self.factor = np.linalg.cholesky(self.covariance(self.points, self.points, JITTER))
            self.field = self.factor @ rng.standard_normal(len(self.points))
        exact = self.smooth(self.points) + self.field
        self.amplitude = np.exp(rng.uniform(0, np.log(300)))
        self.share_of_noise = 0 if rng.random() < 0.35 else rng.uniform(0, 0.3)
        self.deviation = exact.std() * self.amplitude
        self.noise = self.share_of_noise * self.deviation
        self.z = exact * self.amplitude + self.noise * rng.standard_normal(len(exact))

    def make_mesh(self, rng, inside):
        spacing = self.spacing = rng.uniform(25, 60)
        axis = np.arange(0, SIZE + 1e-9, spacing)
        n = len(axis)
        nodes = np.array(np.meshgrid(axis, axis, indexing="ij")).reshape(2, -1).T
        nodes = nodes + rng.integers(0, 2) * rng.uniform(-0.2, 0.2, nodes.shape) * spacing
        kept = ~inside(nodes)
        number = np.arange(n * n).reshape(n, n)
        a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
        triangles = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
        triangles = triangles[kept[triangles].all(1)]
        used = np.unique(triangles)
        self.points, self.triangles = np.zeros((0, 2)), triangles
        rim = np.ones((n, n), bool)
        rim[2:-2, 2:-2] = False
        if kept.all() or not kept[rim.ravel()].all() or not np.isin(number[rim], used).all():
            return  # it reaches the outer border
        renumber = np.full(n * n, -1)
        renumber[used] = np.arange(len(used))
        self.points, self.triangles = nodes[used], renumber[triangles]

    def covariance(self, p, q, jitter=0.0):
        h = cdist(p, q)
        total = sum(v * COVARIANCES[kind](h / length) for v, kind, length in self.covariances)
        return total + jitter * np.eye(len(p)) if jitter else total

    def truth(self, places):
        """Returns heights at places: of fields, a draw given what they are at the vertices."""
        exact = self.smooth(places)
        if self.covariances:
            across = solve_triangular(self.factor, self.covariance(self.points, places), lower=True)
            rest = self.covariance(places, places, 3 * JITTER) - across.T @ across
            value, vector = np.linalg.eigh(rest)
            drawn = vector @ (np.sqrt(np.maximum(value, 0)) * self.rng.standard_normal(len(places)))
            exact = exact + across.T @ solve_triangular(self.factor, self.field, lower=True) + drawn
        return exact * self.amplitude

    def unknowable(self, places):
        """Returns the standard deviation of the part of the truth that no data tell: JITTER."""
        return np.full(len(places), 3e-5 * self.amplitude * bool(self.covariances))

    def write(self, path):
        lines = [f"v {x!r} {y!r} {z!r}" for (x, y), z in zip(self.points.tolist(), self.z.tolist())]
        lines += [f"f {a} {b} {c}" for a, b, c in (self.triangles + 1).tolist()]
        path.write_text("g top\n" + "\n".join(lines) + "\n")

    def others(self, places):
        p, z = self.points, self.z
        plates = RBFInterpolator(p, z, kernel="thin_plate_spline", degree=1)(places)
        linear = LinearNDInterpolator(p, z)(places)
        found = {"thin plates": plates, "cubic": RBFInterpolator(p, z, kernel="cubic", degree=1)(places),
                 "linear": np.where(np.isfinite(linear), linear, plates)}
        some = self.rng.permutation(len(p))[:500]
        found.update(universal_kriging(p[some], z[some], places))
        if len(self.covariances) == len(self.parts):
            k = self.amplitude**2 * self.covariance(p, p, JITTER) + self.noise**2 * np.eye(len(p))
            found["optimum"] = self.amplitude**2 * self.covariance(places, p) @ np.linalg.solve(k, z)
        return found


def unit_of(numbers):
    """Returns the decimal to which numbers are rounded; 0 if there is none."""
    units = (10.0**-digits for digits in range(7))
    return next((u for u in units if np.allclose(np.round(numbers / u) * u, numbers, rtol=1e-14, atol=0)), 0.0)


def rounding_of(vertices, triangles):
    """Returns the standard deviation that rounding of coordinates gives heights at vertices: on slopes, of x and y."""
    units = np.array([unit_of(c) for c in vertices.T])
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    with np.errstate(divide="ignore", invalid="ignore"):
        squares = np.nan_to_num((normal[:, :2] / normal[:, 2:] * units[:2]) ** 2, posinf=0).sum(1)  # of no walls
    sums, count = (np.bincount(triangles.ravel(), w, len(vertices)) for w in (np.repeat(squares, 3), None))
    return np.sqrt((sums / count + units[2] ** 2) / 12)


@functools.lru_cache(maxsize=None)
def surfaces_of(program, paths):
    """Reads the surfaces of files with room for a hole: names, vertices, triangles and their rounding."""
    found = []
    for path in paths:
        with tempfile.TemporaryDirectory() as name:
            converted = Path(name) / "all.obj"
            subprocess.run([program, "convert", "--quiet", path, str(converted)], check=True, stderr=subprocess.DEVNULL)
            vertices, names, triangles = [], [], []
            for words in map(str.split, converted.read_text().splitlines()):
                if words[:1] == ["v"]:
                    vertices.append([float(w) for w in words[1:4]])
                elif words[:1] in (["g"], ["o"]):
                    names.append(words[1])
                    triangles.append([])
                elif words[:1] == ["f"]:
                    triangles[-1].append([int(w.split("/")[0]) - 1 for w in words[1:4]])
        for surface, corners in zip(names, triangles):
            used, corners = np.unique(np.array(corners, int).reshape(-1, 3), return_inverse=True)
            if len(used) >= 150:
                label = f"{Path(path).stem} {surface}".replace("+", "")
                used, corners = np.array(vertices)[used], corners.reshape(-1, 3)
                found.append((label, used, corners, rounding_of(used, corners)))
    return found


class Punched(Draw):
    """A hole in a part of a real surface, whose truth are the vertices that are taken out."""

    covariances, amplitude, share_of_noise = [], 1.0, 0.0

    def __init__(self, seed, surfaces, attempt):
        self.rng = np.random.default_rng([seed, attempt])
        name, self.vertices, triangles, self.rounding = surfaces[seed % len(surfaces)]
        self.parts = [name]
        for _ in range(200):
            if self.punch(triangles):
                return
        raise LookupError(f"{name} has no room for a hole")

    def punch(self, triangles):
        flat = self.vertices[:, :2]
        middle = flat[self.rng.integers(len(flat))]
        far = np.abs(flat - middle).max(1)
        half = np.partition(far, k := min(len(flat) - 1, self.rng.integers(300, 1200)))[k]
        self.hole, self.share, inside = hole_of(self.rng)
        taken = (far <= half) & inside((flat - middle) * SIZE / (2 * half) + SIZE / 2)
        near = triangles[(far <= half)[triangles].all(1)]
        edges = np.sort(np.concatenate([near[:, [0, 1]], near[:, [1, 2]], near[:, [2, 0]]]), 1)
        edges, count = np.unique(edges, axis=0, return_counts=True)
        in_hole = taken[near].any(1)
        used, corners = np.unique(near[~in_hole], return_inverse=True)
        if not in_hole.any() or len(used) < 100 or taken[edges[count == 1]].any():
            return False
        lost = np.setdiff1d(near, used)
        self.lost, self.lost_rounding = self.vertices[lost], self.rounding[lost]
        self.triangles = corners.reshape(-1, 3)
        self.points, self.z = flat[used], self.vertices[used, 2]
        if len(np.unique(self.points, axis=0)) < len(used):
            return False  # no graph
        self.deviation = self.vertices[np.unique(near), 2].std()
        return self.deviation > 0

    def truth(self, places):
        """Returns heights at places of vertices that were taken out."""
        return self.lost[self.nearest_lost(places), 2]

    def unknowable(self, places):
        """Returns what the rounding of coordinates makes of heights."""
        return self.lost_rounding[self.nearest_lost(places)]

    def nearest_lost(self, places):
        return cdist(places, self.lost[:, :2]).argmin(1)


def interpolated(vertices, triangles, places):
    """Returns rows of vertices at places, linear within triangles; without those outside."""
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    u, v, p = (b - a)[:, :2], (c - a)[:, :2], places[:, None] - a[:, :2]
    area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    area = np.where(area == 0, np.nan, area)
    t = (p[..., 0] * v[:, 1] - p[..., 1] * v[:, 0]) / area
    s = (u[:, 0] * p[..., 1] - u[:, 1] * p[..., 0]) / area
    least = np.nan_to_num(np.minimum(np.minimum(t, s), 1 - t - s), nan=-1)
    row, best = np.arange(len(places)), least.argmax(1)
    t, s = t[row, best][:, None], s[row, best][:, None]
    found = a[best] + t * (b - a)[best] + s * (c - a)[best]
    return np.c_[places, found[:, 2:]][least.max(1) > -1e-9]


def universal_kriging(p, z, places):
    """Universal kriging of degree 0 to 2 with exponential covariance, whose range and nugget are likeliest of a few."""
    middle, scale = p.mean(0), p.std()

    def terms(at):
        x, y = ((at - middle) / scale).T
        return np.stack([np.ones(len(at)), x, y, x * x, x * y, y * y], 1)

    trend, h, best = terms(p), cdist(p, p), {}
    for length in np.array((0.1, 0.3, 1)) * np.ptp(p, 0).max():
        for nugget in (1e-6, 0.02, 0.2, 1):
            factor = np.linalg.cholesky(np.exp(-h / length) + nugget * np.eye(len(p)))
            both = solve_triangular(factor, np.c_[trend, z], lower=True)
            for degree, m in enumerate((1, 3, 6)):
                q, r = np.linalg.qr(both[:, :m])
                left = both[:, -1] - q @ (q.T @ both[:, -1])
                likelihood = -(len(p) - m) / 2 * np.log(left @ left + 1e-300)
                likelihood -= np.log(np.diag(factor)).sum() + np.log(np.abs(np.diag(r))).sum()
                if degree not in best or likelihood > best[degree][0]:
                    best[degree] = (likelihood, length, nugget)
    found, across = {}, cdist(places, p)
    for degree, m in enumerate((1, 3, 6)):
        _, length, nugget = best[degree]
        k, some = np.exp(-h / length) + nugget * np.eye(len(p)), trend[:, :m]
        system = np.block([[k, some], [some.T, np.zeros((m, m))]])
        weights = np.linalg.solve(system, np.r_[z, np.zeros(m)])
        found[f"kriging {degree}"] = np.exp(-across / length) @ weights[:-m] + terms(places)[:, :m] @ weights[-m:]
    return found


def filled(program, draw, method):
    """Returns places, heights and expected errors of new vertices; of triangles without any, their middles."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        draw.write(folder / "in.obj")
        command = [program, "fill", str(folder / "in.obj"), "-o", str(folder / "out.obj"), "--points",
                   str(folder / "new.csv"), "--stats", str(folder / "stats.json"), "--threads", "1", "--method", method,
                   "--bridge-faults"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}: {done.stdout}{done.stderr}")
        rows = [[float(w) if w not in ("", "null") else np.nan for w in line.split(",")[:4]]
                for line in (folder / "new.csv").read_text().splitlines()[1:]]
        holes = json.loads((folder / "stats.json").read_text())["holes"]
        if not holes:
            raise RuntimeError("0 holes")
        if rows and not isinstance(draw, Punched):
            return np.array(rows)
        lines = [line.split() for line in (folder / "out.obj").read_text().splitlines()]
        vertices = np.array([w[1:4] for w in lines if w and w[0] == "v"], float)
        triangles = np.array([w[1:4] for w in lines if w and w[0] == "f"], int) - 1
        expected = holes[0]["filled"]["expected_error"]
        expected = np.nan if expected is None else expected
        new = triangles[len(draw.triangles):]
        if isinstance(draw, Punched):
            if not rows:
                flat = interpolated(vertices, new, draw.lost[:, :2])
                return np.c_[flat, np.full(len(flat), expected)]
            deviation = np.r_[np.zeros(len(vertices) - len(rows)), np.array(rows)[:, 3]]
            found = interpolated(np.c_[vertices, deviation], new, draw.lost[:, :2])
            return found[~(found[:, 3] <= 0.1 * expected)]  # the border is given, and has no expected error
        middles = vertices[new].mean(1)
        return np.c_[middles, np.full(len(middles), expected)]


def drawn(program, method, seed, files):
    """Returns a draw and its filling."""
    if not files:
        draw = Draw(seed)
        return draw, *timed(lambda: filled(program, draw, method))
    for attempt in range(20):
        draw = Punched(seed, surfaces_of(program, files), attempt)
        try:
            return draw, *timed(lambda: filled(program, draw, method))
        except RuntimeError as refused:
            if "no graph" not in str(refused) and "0 holes" not in str(refused):
                raise
    raise LookupError(f"{draw.parts[0]} is no graph")


def timed(function):
    start = time.monotonic()
    return function(), time.monotonic() - start


def measure(task):
    try:
        draw, new, seconds = drawn(*task)
    except LookupError as none:
        return f"  left out: {none}"
    except RuntimeError as failed:
        return f"EXCEEDED: seed {task[2]}: {failed}"
    seed = task[2]
    new = new[draw.rng.permutation(len(new))[:250]]
    truth = draw.truth(new[:, :2])
    new, truth = new[np.isfinite(truth)], truth[np.isfinite(truth)]
    if np.isnan(new[:, 3]).any():
        return f"  left out: {draw.parts[0]}: an expected error is unknown"
    if len(new) == 0:
        return f"  left out: {draw.parts[0]}: no vertex that was taken out is in the filled hole"
    rms = lambda e: float(np.sqrt(np.mean(e**2)))
    error, least = new[:, 2] - truth, 1e-4 * draw.deviation  # of fields as rough as JITTER
    others = {name: max(least, rms(z - truth)) for name, z in draw.others(new[:, :2]).items()}
    optimum = others.pop("optimum", np.nan)
    own = max(least, rms(error))
    expected = np.hypot(new[:, 3], draw.unknowable(new[:, :2]))
    return {"seed": seed, "truth": " + ".join(draw.parts), "hole": draw.hole, "share": draw.share,
            "noise": draw.share_of_noise, "vertices": len(draw.points), "new": len(new), "seconds": seconds,
            "error": rms(error), "expected": rms(expected), "ratio": rms(error / expected),
            "within": float(np.mean(np.abs(error) <= 2 * expected)), "best": min(others.values()),
            "of_best": own / min(others.values()), "of_optimum": own / optimum,
            "of_best_or_expected": own / max(min(others.values()), rms(expected))}


def deciles(rows, key):
    rows = sorted(rows, key=lambda r: r[key])
    return [np.sqrt(np.mean([r["ratio"] ** 2 for r in part])) for part in np.array_split(rows, 10) if len(part)]


def judged(rows):
    """Prints the figures, each with its limit. Returns whether all are within."""
    ratio, within, best, optimum = (np.array([r[k] for r in rows]) for k in ("ratio", "within", "of_best", "of_optimum"))
    ratio_of_all, good = np.sqrt(np.mean(ratio**2)), True

    def say(name, value, low, high):
        nonlocal good
        fine = low <= value <= high
        good = good and fine
        print(f"{'' if fine else 'EXCEEDED: '}{name}: {value:.3f} (limits {low} to {high})")

    say("error / expected, root mean square", ratio_of_all, 0.7, 1.5)
    if len(rows) >= 200:
        for key in ("share", "noise"):
            of_parts = deciles(rows, key)
            say(f"  the same, least of the deciles of {key}", min(of_parts), 0.7, 1.5)
            say(f"  the same, largest of the deciles of {key}", max(of_parts), 0.7, 1.5)
    say("share within two expected errors", within.mean(), 0.9, 1)
    say("error / expected, largest of a draw", ratio.max(), 0, 6)
    say("error / best of others, geometric mean", np.exp(np.log(best).mean()), 0, 1.1)
    # The least of six errors is luck, above all of few new points or smooth surfaces: it can be far below what anybody
    # who knew the covariance would expect.
    either = max(r["of_best_or_expected"] for r in rows)
    say("error / larger one of best of others and expected error, largest of a draw", either, 0, 3)
    print(f"  error / best of others, largest of a draw: {best.max():.3f}")
    if np.isfinite(optimum).any():
        print(f"  the same of the optimum: {np.nanmax(best / optimum):.3f}")
        say("error / optimum, geometric mean", np.exp(np.nanmean(np.log(optimum))), 0, 1.06)
    return good


def table(rows):
    for kind in sorted({r["truth"] for r in rows if "+" not in r["truth"]}) + ["+"]:
        some = [r for r in rows if r["truth"] == kind or (kind == "+" and "+" in r["truth"])]
        if some:
            ratio = np.sqrt(np.mean([r["ratio"] ** 2 for r in some]))
            best, optimum = (np.log([r[k] for r in some]) for k in ("of_best", "of_optimum"))
            optimum = f"{np.exp(optimum[np.isfinite(optimum)].mean()):.3f}" if np.isfinite(optimum).any() else "-"
            print(f"  {'sums' if kind == '+' else kind:12} {len(some):5} draws: error / expected {ratio:.2f}, within two "
                  f"{100 * np.mean([r['within'] for r in some]):.0f} %, error / best {np.exp(best.mean()):.2f}, / optimum {optimum}")
    for key in ("ratio", "of_best"):
        for r in sorted(rows, key=lambda r: -r[key])[:4]:
            print(f"  {key} {r[key]:.2f}: seed {r['seed']}, {r['truth']}, {r['hole']} hole of {r['share']:.2f}, noise "
                  f"{r['noise']:.2f}, error {r['error']:.3g}, expected {r['expected']:.3g}, best {r['best']:.3g}")
    seconds = [r["seconds"] for r in rows]
    print(f"  seconds: median {np.median(seconds):.2f}, largest {max(seconds):.2f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--terrane", default="build/release/cli/terrane", help="the program")
    parser.add_argument("--draws", type=int, default=2000)
    parser.add_argument("--seed", type=int, help="of the first draw; the others count from it")
    parser.add_argument("--method", default="kriging")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--real", nargs="+", default=[], metavar="FILE", help="punches the surfaces of these files")
    parser.add_argument("--json", help="file for the numbers of each draw")
    arguments = parser.parse_args()
    first = int(time.time() * 1000) if arguments.seed is None else arguments.seed
    print(f"seeds {first} to {first + arguments.draws - 1}, method {arguments.method}", flush=True)
    tasks = [(arguments.terrane, arguments.method, first + k, tuple(arguments.real)) for k in range(arguments.draws)]
    if arguments.jobs > 1:
        with ProcessPoolExecutor(arguments.jobs) as pool:
            rows = list(pool.map(measure, tasks))
    else:
        rows = [measure(t) for t in tasks]
    for text in sorted({r for r in rows if isinstance(r, str)}):
        print(text)
    failed = any(isinstance(r, str) and r.startswith("EXCEEDED") for r in rows)
    rows = [r for r in rows if not isinstance(r, str)]
    table(rows)
    if arguments.json:
        Path(arguments.json).write_text(json.dumps(rows))
    return 0 if judged(rows) and not failed else 1


if __name__ == "__main__":
    sys.exit(main())
