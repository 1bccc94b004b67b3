#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Fills models with tetrahedra by Terrane, and by TetGen and Gmsh where these are installed, and has `terrane judge`
compare each result with the surfaces that it fills: none may fail, and each must once it is damaged.

    tests/oracles/judged_tetrahedra.py --terrane build/release/cli/terrane
"""
import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SMALL = ROOT / "docs/data"
BODY = """OFF
6 8 0
1400 700 -1250\n1100 700 -1250\n1250 850 -1250\n1250 550 -1250\n1250 700 -1180\n1250 700 -1320
3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5
"""
VOLUME = ["--box", "0,0,-1700,2000,1500,-700"]


class Run:
    def __init__(self, terrane, folder):
        self.terrane, self.folder, self.counts, self.flaws = terrane, folder, {}, []

    def call(self, *words):
        return subprocess.run([str(w) for w in words], cwd=self.folder, capture_output=True, text=True, timeout=600)

    def made(self, *words):
        done = self.call(self.terrane, *words, "--quiet")
        if done.returncode:
            raise SystemExit(f"{words}: {done.stderr}")

    def judge(self, maker, name, inputs, expected=0):
        found = self.call(self.terrane, "judge", name, *inputs)
        self.counts[maker] = self.counts.get(maker, 0) + 1
        if found.returncode != expected:
            self.flaws.append(f"{maker}: {name}: {inputs}: status {found.returncode}\n{found.stdout}{found.stderr}")

    def damage(self, name, inputs):
        """Judges the mesh without a tetrahedron, and with a node that is moved."""
        text = (self.folder / name).read_text()
        lines = text.splitlines(keepends=True)
        nodes, elements = lines.index("$Nodes\n"), lines.index("$Elements\n")
        count = int(lines[elements + 1])
        first = next(i for i in range(elements + 2, elements + 2 + count) if lines[i].split()[1] == "4")
        without = lines[:elements + 1] + [f"{count - 1}\n"] + lines[elements + 2:first] + lines[first + 1:]
        number, x, y, z = lines[nodes + 2].split()
        moved = lines[:nodes + 2] + [f"{number} {float(x) + 0.01!r} {y} {z}\n"] + lines[nodes + 3:]
        for made in (without, moved):
            (self.folder / "damaged.msh").write_text("".join(made))
            self.judge("damaged", "damaged.msh", inputs, 1)


def models(run):
    """The inputs of each model."""
    (run.folder / "body.off").write_text(BODY)
    surfaces = [SMALL / name for name in ("top.ts", "base.ts", "fault.ts")]
    run.made("arrange", *surfaces, "body.off", *VOLUME, "--seal", "20", "-o", "bodies.vtp")
    run.made("arrange", *surfaces, *VOLUME, "-o", "ends.vtp")  # the fault ends inside
    yield ["bodies.vtp"]
    yield ["ends.vtp"]
    yield surfaces  # up to a box round them


def by_terrane(run, inputs):
    for words in (["--order", "2", "--split", "fault"], ["--no-optimise"]):
        run.made("tetrahedralize", *inputs, *words, "-o", "made.vtu", "-o", "made.msh")
        run.judge("Terrane", "made.vtu", inputs)
        run.judge("Terrane", "made.msh", inputs)
    run.made("tetrahedralize", *inputs, "-o", "old.msh", "--msh", "2.2")
    run.judge("Terrane", "old.msh", inputs)
    run.damage("old.msh", inputs)


def by_others(run, inputs):
    """TetGen gets facets that it may not join (-M), Gmsh the solid alone, as it has no volumes otherwise."""
    if shutil.which("tetgen"):
        run.made("convert", *inputs, "facets.smesh")
        if run.call("tetgen", "-pkAQM", "facets.smesh").returncode == 0:
            run.judge("TetGen", "facets.1.vtk", inputs)
    if shutil.which("gmsh"):
        run.made("convert", "body.off", "body.stl")
        (run.folder / "body.geo").write_text('Merge "body.stl";\nSurface Loop(1) = {1};\nVolume(1) = {1};\n')
        for name, words in (("body.msh", []), ("old.msh", ["-format", "msh22"]), ("body.vtk", [])):
            run.call("gmsh", "-3", "body.geo", *words, "-o", name)
            run.judge("Gmsh", name, ["body.off"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--terrane", required=True, type=pathlib.Path)
    terrane = parser.parse_args().terrane.resolve()
    with tempfile.TemporaryDirectory() as folder:
        run = Run(terrane, pathlib.Path(folder))
        for inputs in models(run):
            by_terrane(run, inputs)
        by_others(run, ["bodies.vtp"])
    print(*run.flaws, ", ".join(f"{maker}: {count}" for maker, count in run.counts.items()), sep="\n")
    return 1 if run.flaws or run.counts.get("Terrane", 0) < 10 else 0


if __name__ == "__main__":
    sys.exit(main())
