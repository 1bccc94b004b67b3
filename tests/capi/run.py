#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs the tests of the C interface, and compares the files that they write with the program's.

    run.py --program TERRANE --tests CAPI_TESTS --data DOCS_DATA --work FOLDER [PART]

The program writes its files first, among them a certificate that the tests judge. With PART only this
part of the tests runs, and nothing is compared.
"""
import argparse
import json
import shutil
import subprocess
import sys
from pathlib import Path


def terrane(options, *arguments, folder):
    done = subprocess.run([options.program, *arguments], cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{arguments} in {folder}: status {done.returncode}\n{done.stderr}")


def holed_square():
    """A square of 12 x 12 cells without those in the middle, as OBJ."""
    lines = ["o holed"]
    lines += [f"v {i / 2} {j / 2} {(i * j % 5) / 16}" for j in range(13) for i in range(13)]
    for j in range(12):
        for i in range(12):
            if not (4 <= i < 8 and 4 <= j < 8):
                a = 13 * j + i + 1
                lines += [f"f {a} {a + 1} {a + 14}", f"f {a} {a + 14} {a + 13}"]
    return "\n".join(lines) + "\n"


def prepare_certificates(options, folder):
    """Has the program certify a result of each kind."""
    (folder / "holed.obj").write_text(holed_square())
    three, box = ("top.ts", "base.ts", "fault.ts"), ("--box", "0,0,-1700,2000,1500,-700")
    for kind, output, words in (
            ("arrangement", "arrangement.obj", ("arrange", *three)),
            ("improved", "improved.vtp", ("improve", *three, "--edge-length", "150")),
            ("cut", "cut.off", ("arrange", *three, *box)),
            ("sealed", "sealed.stl", ("arrange", *three, "--seal", "20")),
            ("tetrahedra", "tetrahedra.vtu", ("tetrahedralize", *three, *box, "--blocks-only", "--mesher", "tetgen",
                            "--no-optimise")),
            ("filled", "filled.vtp", ("fill", "holed.obj")),
            ("layered", "layered.vtp", ("layer", "salt.ts", "shale.ts", "--layer", "shale=1", "--layer", "salt=2"))):
        if kind == "tetrahedra" and not options.tetrahedra:
            continue
        terrane(options, *words, "-o", output, "--certificate", f"{kind}.json", folder=folder)


def prepare(options):
    """Has the program write what the tests read, and what their files are compared with."""
    work = options.work
    shutil.rmtree(work, ignore_errors=True)
    certified = work / "certified"
    certified.mkdir(parents=True)
    for name in ("top", "base", "fault", "salt", "shale"):
        shutil.copy(options.data / f"{name}.ts", certified)
    terrane(options, "arrange", "top.ts", "fault.ts", "-o", "model.obj", "--certificate", "model.json",
            folder=certified)
    prepare_certificates(options, certified)
    project = {
        "format": "terrane-project 1",
        "surfaces": [{"file": str(options.data / f"{name}.ts")} for name in ("top", "base", "fault")],
        "volume_of_interest": {"box": {"low": [0, 0, -1700], "high": [2000, 1500, -700]}},
        "improve": {"edge_length": 150},
        "outputs": {"surfaces": ["vtp"], "tetrahedra": ["vtu"] if options.tetrahedra else []},
    }
    (work / "project.json").write_text(json.dumps(project))
    terrane(options, "build", "project.json", "-o", "built", folder=work)
    terrane(options, "arrange", *(str(options.data / f"{name}.ts") for name in ("top", "base", "fault")),
            "-o", "by_program.vtp", folder=work)


def compare(options):
    """Returns the pairs of files that differ."""
    pairs = [("arranged.vtp", "by_program.vtp"), ("built.vtp", "built/surfaces.vtp")]
    if options.tetrahedra:
        pairs.append(("built.vtu", "built/tetrahedra.vtu"))
    return [pair for pair in pairs
            if (options.work / pair[0]).read_bytes() != (options.work / pair[1]).read_bytes()]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=Path, required=True)
    parser.add_argument("--tests", type=Path, required=True)
    parser.add_argument("--data", type=Path, required=True)
    parser.add_argument("--work", type=Path, required=True)
    parser.add_argument("--tetrahedra", action="store_true", help="TetGen's helper program is there")
    parser.add_argument("part", nargs="?")
    options = parser.parse_args()
    for name in ("program", "tests", "data", "work"):
        setattr(options, name, getattr(options, name).resolve())
    prepare(options)
    tests = [options.tests, options.data, options.work] + ([options.part] if options.part else [])
    status = subprocess.run(tests).returncode
    if status != 0:
        sys.exit(f"the tests end with status {status}")
    for one, other in [] if options.part else compare(options):
        print(f"{one} differs from {other}", file=sys.stderr)
        status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
