#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs `terrane volume` and `terrane tetrahedralize` on every file of triangles in a folder and prints a table.

  scripts/survey_models.py [--terrane PROGRAM] [--data FOLDER] [--seconds S] [--json FILE] [PART...]

Each command has S seconds (default 120). Compressed files (.xz) and archives (.tar.xz) are unpacked, and their files
taken one by one. Only files whose path contains a PART are taken, if any is given. FOLDER has the collection of data
(default: ../shared/data beside the repository). The table lists what was not done, with the sentences that the program
gave; the last lines count. It is no part of CI, as it takes half an hour.
"""
import argparse
import json
import lzma
import pathlib
import re
import resource
import subprocess
import sys
import tarfile
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
TRIANGLES = {".ts", ".so", ".ml", ".off", ".obj", ".ply", ".stl", ".vtk", ".vtp", ".dxf", ".msh", ".mesh"}


def models(folder, scratch):
    """Yields the name of each file and its path, unpacked where it has to be."""
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if path.suffix.lower() in TRIANGLES:
            yield name, path
        elif path.name.endswith(".tar.xz"):
            with tarfile.open(path) as archive:
                archive.extractall(scratch / name)
            for file in sorted(p for p in (scratch / name).rglob("*") if p.suffix.lower() in TRIANGLES):
                yield f"{name}/{file.name}", file
        elif path.suffix == ".xz" and pathlib.Path(path.stem).suffix.lower() in TRIANGLES:
            unpacked = scratch / path.stem
            unpacked.write_bytes(lzma.decompress(path.read_bytes()))
            yield name, unpacked


def run(words, seconds):
    """Returns the status of a command (None: out of time), its processor seconds, and what it said about failing."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run(words, capture_output=True, text=True, errors="replace", timeout=seconds, check=False)
        status, said = done.returncode, done.stderr
    except subprocess.TimeoutExpired:
        status, said = None, f"not done in {seconds:g} s"
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    lines = [line for line in said.splitlines() if not re.match(r"(terrane: )?(warning|note|hint)", line.strip())]
    return status, used, " / ".join(lines)[:300].replace("|", "\\|")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--terrane", default=ROOT / "build/release/cli/terrane", type=pathlib.Path)
    parser.add_argument("--data", default=ROOT.parent / "shared/data", type=pathlib.Path)
    parser.add_argument("--seconds", default=120, type=float)
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("parts", nargs="*")
    options = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as name:
        scratch = pathlib.Path(name)
        for model, file in models(options.data, scratch):
            if options.parts and not any(part in model for part in options.parts):
                continue
            for command, output in (("volume", "blocks"), ("tetrahedralize", "out.vtu")):
                words = [options.terrane, command, file, "-o", scratch / output]
                if command == "tetrahedralize":
                    words += ["--time-limit", str(options.seconds / 5)]
                status, used, said = run(words, options.seconds)
                rows.append({"model": model, "command": command, "status": status, "seconds": used, "said": said})
                subprocess.run(["rm", "-rf", scratch / output], check=True)
                print(f"{model} {command} {status} {used:.1f}", file=sys.stderr, flush=True)
    print("| model | command | status | CPU s | said |\n|---|---|---|---|---|")
    for row in rows:
        if row["status"] != 0:
            print(f"| {row['model']} | {row['command']} | {row['status']} | {row['seconds']:.1f} | {row['said']} |")
    for command in ("volume", "tetrahedralize"):
        ran = [row for row in rows if row["command"] == command]
        done = [row for row in ran if row["status"] == 0]
        print(f"{command}: {len(done)} of {len(ran)} done, slowest {max((r['seconds'] for r in ran), default=0):.1f} s")
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1))
    return 0


if __name__ == "__main__":
    sys.exit(main())
