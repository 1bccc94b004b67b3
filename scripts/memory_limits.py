#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs the program with too little memory, at many limits on its address space (ulimit -v).

    scripts/memory_limits.py [--terrane build/release/cli/terrane] [--limits 100]

For each command, the limits lie between the least one at which the program starts and the least one
at which the command succeeds. Each run must end well, or end with status 3 and a message about
memory (or a thread or process that cannot be started), and leave all files as they were.
"""
import argparse
import os
import resource
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DATA = ROOT / "tests/data"
LAYERS = "".join(f"o {name}\nv -1 -1 {z}\nv 9 -1 {z}\nv 9 9 {z}\nv -1 9 {6 - z}\nf {a} {a + 1} {a + 2}\nf {a} {a + 2} {a + 3}\n"
                 for name, z, a in (("top", 4, 1), ("base", 2, 5)))
HOLED = "o holed\n" + "".join(f"v {i} {j} {0.1 * (i * j % 3)}\n" for j in range(7) for i in range(7)) + "".join(
    f"f {a} {a + 1} {a + 8}\nf {a} {a + 8} {a + 7}\n" for j in range(6) for i in range(6)
    if (i, j) not in ((2, 2), (3, 2), (2, 3), (3, 3)) for a in (7 * j + i + 1,))
PROJECT = """{"format": "terrane-project 1", "folder": "out", "surfaces": [{"file": "layers.obj", "role": "horizon"}],
 "layers": {"order": [{"surface": "top", "hardness": 1}, {"surface": "base", "hardness": 2}]},
 "volume_of_interest": {"box": {"low": [0, 0, 0], "high": [8, 8, 8]}}, "improve": {"edge_length": 2},
 "outputs": {"surfaces": ["vtp"], "blocks": "obj", "tetrahedra": ["vtu"]}}"""
# What the commands below read.
INPUTS = {"layers.obj": LAYERS, "holed.obj": HOLED, "project.json": PROJECT}
PAGE = resource.getpagesize()
# Each with its outputs; the folder has an old file in place of each that is no folder.
COMMANDS = [
    (f"arrange {DATA}/arch-platform/faults.ts {DATA}/arch-platform/mnt.ts -o a.vtp -o b.obj --certificate c.json "
     "--threads 2", ("a.vtp", "b.obj", "c.json")),
    (f"volume {DATA}/ringmesh/modelA1.ml -o model --certificate c.json", ("c.json",)),
    (f"tetrahedralize {DATA}/ringmesh/modelA1.ml -o t.vtu -o t.msh", ("t.vtu", "t.msh")),
    (f"improve {DATA}/ringmesh/modelA1.ml -o i.obj --max-triangles 1e6", ("i.obj",)),
    (f"check {DATA}/ringmesh/modelA1.ml", ()),
    (f"convert {DATA}/ringmesh/modelA1.ml x.vtp", ("x.vtp",)),
    ("build project.json", ()),
    ("fill holed.obj -o f.obj --certificate c.json", ("f.obj", "c.json")),
    ("layer layers.obj --layer top=1 --layer base=2 -o l.obj --certificate c.json", ("l.obj", "c.json")),
    ("verify proof.json", ()),
    ("report layers.obj --box 0,0,0,8,8,8 -o r.html", ("r.html",)),
]


def state(folder):
    return {str(p.relative_to(folder)): p.read_bytes() if p.is_file() else b"" for p in folder.rglob("*")}


def run(terrane, line, files, limit):
    """Runs a command within a limit; returns its status, what it said, and whether files changed."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for name, text in {**INPUTS, **dict.fromkeys(files, "old")}.items():
            (folder / name).write_text(text)
        before = state(folder)
        done = subprocess.run(
            [terrane, *line.split()], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, check=False,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)), timeout=900)
        return done.returncode, done.stderr.decode(errors="replace"), state(folder) != before


def certified(terrane):
    """Returns a certificate of layers.obj, and its output, for `verify`."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        (folder / "layers.obj").write_text(LAYERS)
        subprocess.run([terrane, "arrange", "layers.obj", "-o", "proven.obj", "--certificate", "proof.json", "--quiet"],
                       cwd=folder, check=True)
        return {name: (folder / name).read_text() for name in ("proven.obj", "proof.json")}


def least(good, low, high):
    """The least limit that is good, to a sixteenth of a MiB."""
    while high - low > 1 << 16:
        middle = (low + high) // 2 // PAGE * PAGE
        if good(middle):
            high = middle
        else:
            low = middle
    return high


def trouble(status, said, changed, usual):
    if status == usual:
        return ""
    if changed:
        return "files changed"
    if status != 3:
        return f"signal {signal.Signals(-status).name}" if status < 0 else f"status {status}"
    return "" if "memory" in said or "resources" in said or "no process" in said else "no word of memory"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--terrane", default=ROOT / "build/release/cli/terrane", type=Path)
    parser.add_argument("--limits", type=int, default=100)
    parser.add_argument("--only", default="", help="only commands that begin so")
    options = parser.parse_args()
    os.environ["LC_ALL"] = "C"
    terrane = str(options.terrane.resolve())
    most = 4 << 30
    INPUTS.update(certified(terrane))
    starts = least(lambda limit: run(terrane, "--version", (), limit)[0] == 0, 0, most)
    flaws = 0
    for line, files in COMMANDS:
        if not line.startswith(options.only):
            continue
        usual, said, _ = run(terrane, line, files, most)
        if usual not in (0, 1):
            sys.exit(f"{line}: status {usual}: {said}")
        ends = least(lambda limit: run(terrane, line, files, limit)[0] == usual, starts, most)
        counts = {}
        for k in range(options.limits):
            # A little above and below both ends as well: addresses differ from run to run.
            limit = (starts + (ends - starts) * (k + 1) // options.limits) // PAGE * PAGE
            status, said, changed = run(terrane, line, files, limit)
            wrong = trouble(status, said, changed, usual)
            counts[status] = counts.get(status, 0) + 1
            if wrong:
                flaws += 1
                print(f"{line} within {limit >> 10} KiB: {wrong}; {said.strip()}", flush=True)
        print(f"{line.split()[0]}: {starts >> 20} to {ends >> 20} MiB, status: "
              + ", ".join(f"{n} times {s}" for s, n in sorted(counts.items())), flush=True)
    return 1 if flaws else 0


if __name__ == "__main__":
    sys.exit(main())
