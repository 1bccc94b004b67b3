#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Compares `terrane fill` with the truth and with SciPy's interpolators, family by family.

Needs NumPy and SciPy (Debian: python3-numpy python3-scipy), which the build itself does not.

    tests/bench/fill_families.py build/release/cli/terrane --seeds 20

Each family is a kind of surface: planes, domes, cylinders, waves, random fields with a known covariance, real
horizons; with and without noise of known standard deviation. Each seed gives another surface and another hole of 4
to 10 edges' radius. The program fills it from a file; its new vertices are compared with the truth there (of real
horizons, the heights of its triangles at the nodes that were taken out), and so are SciPy's thin plate spline, cubic
radial basis functions and linear interpolation of the same five rings of vertices. Per family and method the table
has:

    error     root mean square error over all new vertices and seeds
    / best    that, divided by the least one of the three interpolators
    / optimum that, divided by kriging with the true covariance (exponential fields only)
    error / expected  root mean square of error over expected error: 1 is right, more is overconfident
    median, worst  of such root mean squares of the single seeds
    s         median time of the processor, the program's start included (with --jobs 1)
    within 2  share of vertices whose error is at most twice the expected one
"""
import argparse
import json
import os
import resource
import struct
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
import numpy as np
from scipy.interpolate import LinearNDInterpolator, RBFInterpolator
from scipy.spatial.distance import cdist

ROOT = Path(__file__).resolve().parents[2]
SPACING = 25.0
# name: (kind, its parameters, standard deviation of the noise)
FAMILIES = {
    "plane": ("plane", (), 0.0),
    "plane, noise .1": ("plane", (), 0.1),
    "plane, noise 1": ("plane", (), 1.0),
    "plane, noise 5": ("plane", (), 5.0),
    "paraboloid": ("paraboloid", (), 0.0),
    "paraboloid, noise 1": ("paraboloid", (), 1.0),
    "saddle, noise .1": ("saddle", (), 0.1),
    "dome 250": ("dome", (250,), 0.0),
    "dome 250, noise .1": ("dome", (250,), 0.1),
    "dome 250, noise 1": ("dome", (250,), 1.0),
    "dome 400, noise 1": ("dome", (400,), 1.0),
    "cylinder": ("cylinder", (800,), 0.0),
    "cylinder, noise .1": ("cylinder", (800,), 0.1),
    "wave 1000": ("wave", (1000,), 0.0),
    "wave 600": ("wave", (600,), 0.0),
    "wave 600, noise 1": ("wave", (600,), 1.0),
    "exponential 150": ("exponential", (50,), 0.0),
    "exponential 600": ("exponential", (200,), 0.0),
    "exponential 1800": ("exponential", (600,), 0.0),
    "exponential 600, noise 2": ("exponential", (200,), 2.0),
    "matern 3/2, 300": ("matern", (1.5, 60), 0.0),
    "matern 3/2, 1000": ("matern", (1.5, 200), 0.0),
    "matern 3/2, 1000, noise 1": ("matern", (1.5, 200), 1.0),
    "matern 5/2, 900": ("matern", (2.5, 150), 0.0),
    "matern 5/2, 900, noise 1": ("matern", (2.5, 150), 1.0),
    "gaussian 200": ("matern", (np.inf, 80), 0.0),
    "gaussian 500": ("matern", (np.inf, 200), 0.0),
    "gaussian 300, noise 1": ("matern", (np.inf, 120), 1.0),
    "F3": ("f3", (), 0.0),
    "Drogon": ("drogon", (), 0.0),
    "Norne": ("norne", (), 0.0),
}


def generator(family, seed):
    return np.random.default_rng([seed] + [ord(c) for c in family])


def smooth_field(kind, parameters, rng):
    """Returns a function of places, exact everywhere."""
    turn = rng.uniform(0, 2 * np.pi)
    c, s = np.cos(turn), np.sin(turn)
    off = rng.uniform(-150, 150, 2)

    def along(p):
        d = p - 500 - off
        return c * d[:, 0] + s * d[:, 1], c * d[:, 1] - s * d[:, 0]

    if kind == "plane":
        return lambda p: 0.03 * along(p)[0] + 25
    if kind == "paraboloid":
        return lambda p: 50 - 50 * (((p - 500 - off) / 500) ** 2).sum(1)
    if kind == "saddle":
        return lambda p: 30 * along(p)[0] * along(p)[1] / 500**2
    if kind == "dome":
        return lambda p: 50 * np.exp(-((p - 500 - off) ** 2).sum(1) / (2 * parameters[0] ** 2))
    if kind == "cylinder":
        return lambda p: np.sqrt(parameters[0] ** 2 - along(p)[0] ** 2)
    if kind == "wave":
        phase = rng.uniform(0, 2 * np.pi, 2)
        k = 2 * np.pi / parameters[0]
        return lambda p: 15 * np.sin(k * along(p)[0] + phase[0]) * np.cos(k / 1.3 * along(p)[1] + phase[1])
    if kind == "matern":  # a sum of waves with the spectrum of the covariance
        nu, scale = parameters
        waves = rng.standard_normal((1500, 2)) / scale
        if np.isfinite(nu):
            waves *= np.sqrt(2 * nu / rng.chisquare(2 * nu, 1500))[:, None]
        phase = rng.uniform(0, 2 * np.pi, 1500)
        return lambda p: 10 * np.sqrt(2 / 1500) * np.cos((p - 500) @ waves.T + phase).sum(1)
    raise ValueError(kind)


def drogon():
    """Irap binary, big-endian records."""
    path = Path(os.environ.get("TERRANE_DATA", "/work/shared/data")) / (
        "equinor+xtgeo-testdata/surfaces/drogon/1/01_topvolantis.gri")
    data, at, records = path.read_bytes(), 0, []
    while at < len(data):
        (size,) = struct.unpack(">i", data[at:at + 4])
        records.append(data[at + 4:at + 4 + size])
        at += 8 + size
    (rows,) = struct.unpack(">i", records[0][4:8])
    (columns,) = struct.unpack(">i", records[2][0:4]) if len(records[2]) >= 4 else (0,)
    (rows,) = struct.unpack(">i", records[0][4:8])
    values = np.concatenate([np.frombuffer(r, ">f4") for r in records[3:]]).astype(float)
    grid = values.reshape(rows, -1)[:, :columns] if columns else values.reshape(rows, -1)
    return np.where(grid > 9e6, np.nan, grid)


def f3():
    nodes = {}
    for line in (ROOT / "tests/data/gio/F3_FS6_ILXL.dat").read_text().splitlines():
        if not line.startswith("#"):
            words = line.split()
            nodes[int(words[-3]), int(words[-2])] = float(words[-1])
    rows, columns = sorted({k[0] for k in nodes}), sorted({k[1] for k in nodes})
    grid = np.full((len(rows), len(columns)), np.nan)
    for (i, j), z in nodes.items():
        grid[rows.index(i), columns.index(j)] = z
    return grid


def norne():
    import lzma
    path = Path(os.environ.get("TERRANE_DATA", "/work/shared/data")) / (
        "OPM+ResInsight/ApplicationLibCode/UnitTests/TestData/RifSurfaceImporter/norne_xyz.dat.xz")
    rows = []
    for line in lzma.open(path, "rt"):
        words = line.replace(",", " ").split()
        try:
            rows.append([float(w) for w in words[:5]])
        except ValueError:
            continue
    p = np.array([r[:3] for r in rows if len(r) >= 3])
    steps = np.diff(p[:, :2], axis=0)  # a turned grid of squares, row by row
    size = np.median(np.hypot(*steps.T))
    along = np.median(steps, axis=0)
    along /= np.hypot(*along)
    off = p[:, :2] - p[0, :2]
    i = np.rint(off @ along / size).astype(int)
    j = np.rint((off[:, 1] * along[0] - off[:, 0] * along[1]) / size).astype(int)
    grid = np.full((np.ptp(i) + 1, np.ptp(j) + 1), np.nan)
    grid[i - i.min(), j - j.min()] = p[:, 2]
    # The file rounds x to 0.01, y to 0.1 and z to 0.0001, which on slopes changes heights.
    up, across = np.gradient(grid, size)
    slope_x, slope_y = up * along[0] - across * along[1], up * along[1] + across * along[0]
    ROUNDING["norne"] = np.sqrt(((0.01 * slope_x) ** 2 + (0.1 * slope_y) ** 2 + 0.0001**2) / 12)
    return grid


REAL, ROUNDING = {}, {}


def real_field(kind, nodes, rng):
    """Cuts a window out of a real horizon, whose truth is known at its nodes, up to rounding."""
    if kind not in REAL:
        REAL[kind] = {"f3": f3, "drogon": drogon, "norne": norne}[kind]()
    grid = REAL[kind]
    if min(grid.shape) < nodes:
        raise LookupError("too small a horizon")
    for _ in range(2000):
        i, j = rng.integers(0, grid.shape[0] - nodes + 1), rng.integers(0, grid.shape[1] - nodes + 1)
        window = grid[i:i + nodes, j:j + nodes]
        if np.isfinite(window).all():
            break
    else:
        raise LookupError("no whole window")
    g = np.arange(nodes) * SPACING
    X, Y = np.meshgrid(g, g, indexing="ij")
    rounding = ROUNDING.get(kind, np.zeros_like(grid))[i:i + nodes, j:j + nodes]
    flat = np.c_[X.ravel(), Y.ravel()]
    return LinearNDInterpolator(flat, window.ravel()), LinearNDInterpolator(flat, np.nan_to_num(rounding.ravel()))


class Case:
    def __init__(self, family, seed):
        kind, parameters, self.noise = FAMILIES[family]
        rng = self.rng = generator(family, seed)
        nodes = 29 if kind in ("f3", "drogon", "norne") else 41
        middle = (nodes - 1) / 2 * SPACING
        radius = rng.uniform(4, 7 if nodes == 29 else 10) * SPACING
        centre = middle + rng.uniform(-SPACING, SPACING, 2)
        X, Y = np.meshgrid(np.arange(nodes), np.arange(nodes), indexing="ij")
        at = np.c_[X.ravel(), Y.ravel()] * SPACING
        distance = np.hypot(*(at - centre).T) if seed % 2 else np.abs(at - centre).max(1) * 1.1
        wanted = (distance > radius) & (distance < radius + 10 * SPACING)
        self.hidden = at[distance <= radius] if nodes == 29 else None  # where the truth is known
        self.points = at[wanted]
        self.rings = distance[wanted] < radius + 5.01 * SPACING
        number = np.full(nodes * nodes, -1)
        number[wanted] = np.arange(wanted.sum())
        number = number.reshape(nodes, nodes)
        a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
        both = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
        self.triangles = both[(both >= 0).all(1)]
        used = np.unique(self.triangles)
        self.points, self.rings = self.points[used], self.rings[used]
        renumber = np.full(number.max() + 1, -1)
        renumber[used] = np.arange(len(used))
        self.triangles = renumber[self.triangles]
        self.covariance, self.rounding = None, lambda places: np.zeros(len(places))
        if kind == "exponential":
            self.covariance = lambda p, q: 100 * np.exp(-cdist(p, q) / parameters[0])
            k = self.covariance(self.points, self.points)
            self.exact = np.linalg.cholesky(k + 1e-9 * np.eye(len(k))) @ rng.standard_normal(len(k))
        else:
            if nodes == 29:
                self.field, self.rounding = real_field(kind, nodes, rng)
            else:
                self.field = smooth_field(kind, parameters, rng)
            self.exact = self.field(self.points)
        self.z = self.exact + self.noise * rng.standard_normal(len(self.points))

    def write(self, path):
        with open(path, "w") as out:
            out.write("g top\n")
            for (x, y), z in zip(self.points, self.z):
                out.write(f"v {float(x)!r} {float(y)!r} {float(z)!r}\n")
            for t in self.triangles + 1:
                out.write(f"f {t[0]} {t[1]} {t[2]}\n")

    def truth(self, places):
        if self.covariance is None:
            return self.field(places)
        # A draw of the field given what it is at the vertices.
        k, kp = self.covariance(self.points, self.points), self.covariance(self.points, places)
        solved = np.linalg.solve(k + 1e-9 * np.eye(len(k)), kp)
        rest = self.covariance(places, places) - kp.T @ solved
        factor = np.linalg.cholesky(rest + 1e-7 * np.eye(len(rest)))
        return solved.T @ self.exact + factor @ np.random.default_rng(7).standard_normal(len(rest))

    def interpolators(self, places):
        p, z = self.points[self.rings], self.z[self.rings]
        result = {
            "thin plates": RBFInterpolator(p, z, kernel="thin_plate_spline", degree=1)(places),
            "cubic": RBFInterpolator(p, z, kernel="cubic", degree=1)(places),
            "linear": LinearNDInterpolator(p, z)(places),
        }
        if self.covariance is not None:
            k = self.covariance(self.points, self.points)
            k = k + (self.noise**2 + 1e-9) * np.eye(len(k))
            result["optimum"] = self.covariance(places, self.points) @ np.linalg.solve(k, self.z)
        return result


def on_triangles(mesh, new, places):
    """Returns x, y, height and expected error of the filled surface at those of the places that it covers."""
    words = [line.split() for line in Path(mesh).read_text().splitlines()]
    vertices = np.array([w[1:4] for w in words if w and w[0] == "v"], float)
    triangles = np.array([w[1:4] for w in words if w and w[0] == "f"], int) - 1
    given = len(vertices) - len(new)
    expected = np.r_[np.zeros(given), new[:, 3]]
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    u, v = (b - a)[:, :2], (c - a)[:, :2]
    area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    rows = []
    for p in places:
        d = p - a[:, :2]
        second = (d[:, 0] * v[:, 1] - d[:, 1] * v[:, 0]) / area
        third = (u[:, 0] * d[:, 1] - u[:, 1] * d[:, 0]) / area
        shares = np.c_[1 - second - third, second, third]
        t = np.argmax(shares.min(1))
        if shares[t].min() < -1e-9:
            continue
        corners = triangles[t]
        # Between three given vertices nothing is expected, as nothing was estimated.
        off = shares[t] @ expected[corners] if (corners >= given).any() else np.nan
        rows.append([*p, shares[t] @ vertices[corners, 2], off])
    return np.array(rows)


def run(program, method, path, folder):
    points = Path(folder) / "new.csv"
    command = [program, "fill", str(path), "-o", str(Path(folder) / "out.obj"), "--points", str(points),
               "--threads", "1", "--method", method]
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run(command, capture_output=True, text=True)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    if not points.exists():
        raise RuntimeError(done.stderr + done.stdout)
    rows = [line.split(",") for line in points.read_text().splitlines()[1:]]
    if not rows:
        raise RuntimeError(done.stderr + done.stdout)
    number = lambda w: float(w) if w not in ("", "null") else float("nan")
    return np.array([[number(w) for w in r[:4]] for r in rows]), seconds


def measure(program, method, family, seed):
    case = Case(family, seed)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "in.obj"
        case.write(path)
        new, seconds = run(program, method, path, folder)
        if case.hidden is not None:
            new = on_triangles(Path(folder) / "out.obj", new, case.hidden)
    places = new[:, :2]
    truth = case.truth(places)
    ok = np.isfinite(truth)
    error = (new[:, 2] - truth)[ok]
    expected = np.hypot(new[ok, 3], case.rounding(places[ok]))
    result = {"family": family, "seed": seed, "method": method, "n": len(error), "seconds": seconds, "square": float(np.mean(error**2)),
              "unknown": float(np.mean(~np.isfinite(expected)))}
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.abs(error) / expected
    ratio = ratio[np.isfinite(expected)]
    result["ratio"] = float(np.mean(ratio**2)) if len(ratio) else None
    result["within"] = float(np.mean(ratio <= 2)) if len(ratio) else None
    result["expected"] = float(np.sqrt(np.nanmean(expected**2))) if len(ratio) else None
    for name, value in case.interpolators(places[ok]).items():
        off = value - truth[ok]
        result[name] = float(np.nanmean(off**2))
    return result


def table(rows):
    lines = ["| family | method | error | / best | / optimum | error / expected | median | worst | within 2 | s |",
             "|---|---|---|---|---|---|---|---|---|---|"]
    for family in FAMILIES:
        for method in sorted({r["method"] for r in rows}):
            some = [r for r in rows if r["family"] == family and r["method"] == method]
            if not some:
                continue
            mean = lambda key: float(np.sqrt(np.mean([r[key] for r in some])))
            best = min(mean(k) for k in ("thin plates", "cubic", "linear"))
            optimum = f"{mean('square') / mean('optimum'):.3f}" if "optimum" in some[0] else ""
            known = [r for r in some if r["ratio"] is not None]
            calibration = "unknown | | |"
            if known:
                ratios = [r["ratio"] for r in known]
                calibration = (f"{np.sqrt(np.mean(ratios)):.2f} | {np.sqrt(np.median(ratios)):.2f} | {np.sqrt(max(ratios)):.2f} | "
                               f"{100 * np.mean([r['within'] for r in known]):.0f} %")
            over = f"{mean('square') / best:.2f}" if best > 1e-10 else "exact"
            lines.append(f"| {family} | {method} | {mean('square'):.3g} | {over} | {optimum} | {calibration} | "
                         f"{np.median([r['seconds'] for r in some]):.2f} |")
    return "\n".join(lines)


def plot(rows, path):
    """Draws error / expected per family: the root mean square, and each seed."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    methods = sorted({r["method"] for r in rows})
    families = [f for f in FAMILIES if any(r["family"] == f for r in rows)]
    figure, all_axes = plt.subplots(1, len(methods), figsize=(4 * len(methods), 0.2 * len(families) + 1), sharey=True,
                                    squeeze=False)
    for axes, method in zip(all_axes[0], methods):
        axes.axvspan(0.7, 1.5, color="#dde8dd")
        for k, family in enumerate(families):
            ratios = [r["ratio"] for r in rows
                      if r["family"] == family and r["method"] == method and r["ratio"] is not None]
            if ratios:
                axes.plot(np.sqrt(ratios), [k] * len(ratios), ".", color="#9aa5b1", markersize=3)
                axes.plot(np.sqrt(np.mean(ratios)), k, "o", color="#1f5f99", markersize=5)
        axes.set_xscale("log")
        axes.set_xlim(0.05, 20)
        axes.set_title(method, fontsize=9)
        axes.set_xlabel("error / expected error", fontsize=8)
        axes.set_yticks(range(len(families)), families, fontsize=7)
        axes.tick_params(axis="x", labelsize=7)
        axes.invert_yaxis() if method == methods[0] else None
    figure.tight_layout()
    figure.savefig(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="path of terrane")
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--methods", default="kriging,rbf")
    parser.add_argument("--families", default="", help="those whose name contains one of these, separated by ;")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--json", help="file for the numbers of each seed")
    parser.add_argument("--plot", help="picture of the calibration (needs Matplotlib)")
    arguments = parser.parse_args()
    words = [w for w in arguments.families.split(";") if w]
    families = [f for f in FAMILIES if not words or any(w in f for w in words)]
    tasks = [(m, f, s) for f in families for m in arguments.methods.split(",") for s in range(arguments.seeds)]
    rows, failed = [], []

    def one(task):
        method, family, seed = task
        try:
            rows.append(measure(arguments.program, method, family, seed))
        except (LookupError, FileNotFoundError) as error:
            failed.append(f"{family} is left out: {error}")
        except RuntimeError as error:
            failed.append(f"{family}, {method}, seed {seed}: {error}")

    with ThreadPoolExecutor(arguments.jobs) as pool:
        list(pool.map(one, tasks))
    rows.sort(key=lambda r: (r["family"], r["method"], r["seed"]))
    print(table(rows))
    for line in sorted(set(failed)):
        print(line)
    if arguments.json:
        Path(arguments.json).write_text(json.dumps(rows))
    if arguments.plot:
        plot(rows, arguments.plot)


if __name__ == "__main__":
    sys.exit(main())
