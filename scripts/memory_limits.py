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
]


def state(folder):
    return {str(p.relative_to(folder)): p.read_bytes() if p.is_file() else b"" for p in folder.rglob("*")}


def run(terrane, line, files, limit):
    """Runs a command within a limit; returns its status, what it said, and whether files changed."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for name in files:
            (folder / name).write_text("old")
        before = state(folder)
        done = subprocess.run(
            [terrane, *line.split()], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, check=False,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)), timeout=900)
        return done.returncode, done.stderr.decode(errors="replace"), state(folder) != before


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
    options = parser.parse_args()
    os.environ["LC_ALL"] = "C"
    terrane = str(options.terrane.resolve())
    most = 4 << 30
    starts = least(lambda limit: run(terrane, "--version", (), limit)[0] == 0, 0, most)
    flaws = 0
    for line, files in COMMANDS:
        usual = run(terrane, line, files, most)[0]
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
