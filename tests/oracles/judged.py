#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Arranges the files of tests/data, and has `terrane judge` compare each result with its inputs: none may fail.

    tests/oracles/judged.py --terrane build/release/cli/terrane [FILE ...]

FILEs are arranged, each alone, instead. Files that cannot be read, or not be made conforming, are left out and counted.
So are those not judged: exact results with parts that are thinner than the bound for rounded points, or that rounding
had to move farther.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

DATA = pathlib.Path(__file__).resolve().parent.parent / "data"
ENDINGS = {".ts", ".obj", ".off", ".ply", ".stl", ".ml", ".vtp", ".vtu", ".vtk", ".msh"}


def groups():
    """Files that are arranged together: each alone, and those of some folders."""
    files = sorted(f for f in DATA.rglob("*") if f.suffix in ENDINGS)
    together = [sorted(DATA.glob(p)) for p in ("manifold/Cray_*.obj", "manifold/Havoc*.obj", "arch-platform/*.ts")]
    return [[f] for f in files] + [group for group in together if len(group) > 1]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--terrane", required=True)
    parser.add_argument("files", nargs="*", type=pathlib.Path)
    arguments = parser.parse_args()
    counts = {"judged": 0, "left out": 0, "in doubt": 0, "failed": 0}
    with tempfile.TemporaryDirectory() as folder:
        made = pathlib.Path(folder) / "made.vtp"
        for group in [[f] for f in arguments.files] or groups():
            made.unlink(missing_ok=True)
            arranged = subprocess.run([arguments.terrane, "arrange", *group, "-o", made, "--quiet"], capture_output=True)
            if arranged.returncode or not made.exists():
                counts["left out"] += 1
                continue
            judged = subprocess.run([arguments.terrane, "judge", made, *group], capture_output=True, text=True)
            counts["judged"] += 1
            counts["in doubt"] += judged.returncode == 2
            if judged.returncode not in (0, 2):
                counts["failed"] += 1
                print(*group, judged.stdout, judged.stderr, sep="\n")
    print(", ".join(f"{n} {what}" for what, n in counts.items()))
    return 1 if counts["failed"] or not counts["judged"] else 0


if __name__ == "__main__":
    sys.exit(main())
