#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Interrupts the program at random times, and judges what it leaves.

    scripts/interrupts.py [--terrane build/release/cli/terrane] [--runs 2000] [--seed 1] [--large]

Each run has old files where it writes. It gets SIGINT, SIGTERM or SIGHUP at a random time, some runs
a second one, or it has a random limit on the size of files (SIGXFSZ). Afterwards either all outputs
are those of an undisturbed run and the status is the same, or the status is 2, the message says why,
and all files are the old ones; nothing else is left, but for the finished realisations of an ensemble, which it keeps.
The process must end within a second. A signal that comes before the program listens ends the process by itself;
then nothing may have changed, either, and it must listen soon after its start. --large takes larger models, too.
Some runs are ensembles. They need the Python package, beside the program or in a folder of PYTHONPATH.
"""
import argparse
import hashlib
import os
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DATA = ROOT / "tests/data"
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
PROJECT = """{"format": "terrane-project 1", "folder": "out",
 "surfaces": [{"file": "in.obj", "role": "horizon"}, {"file": "fault.obj", "role": "fault"}],
 "volume_of_interest": {"box": {"low": [0, 0, 0], "high": [8, 8, 8]}},
 "outputs": {"surfaces": ["vtp", "msh22"], "blocks": "obj", "tetrahedra": ["vtu"], "certificate": true}}"""
HORIZONS = """o base
v -1 -1 3\nv 9 -1 3\nv 9 9 3\nv -1 9 3\nf 1 2 3 4
o top
v -1 -1 5\nv 9 -1 5\nv 9 9 5\nv -1 9 5\nf 5 6 7 8
"""
FAULT = "v 4 -1 -1\nv 4 4 -1\nv 4 4 9\nv 4 -1 9\nf 1 2 3 4\n"
HOLED = "o holed\n" + "".join(f"v {i} {j} {0.1 * (i * j % 3)}\n" for j in range(9) for i in range(9)) + "".join(
    f"f {a} {a + 1} {a + 10}\nf {a} {a + 10} {a + 9}\n" for j in range(8) for i in range(8)
    if not (2 < i < 6 and 2 < j < 6) for a in (9 * j + i + 1,))
UNCERTAIN = """{"format": "terrane-project 1", "folder": "run", "surfaces": [{"file": "in.obj", "role": "horizon"}],
 "volume_of_interest": {"box": {"low": [0, 0, 0], "high": [8, 8, 8]}}, "outputs": {"surfaces": ["vtp"]},
 "uncertainty": [{"surface": "top", "shift": 0.2}, {"surface": "base", "shift": 0.2}]}"""
BOX = "--box 0,0,0,8,8,8"
# The command line, its output files, and its output folders. Times in some files differ.
COMMANDS = [
    ("arrange in.obj fault.obj -o a.vtp -o b.obj --certificate c.json --exact e.txt --stats s.json",
     ("a.vtp", "b.obj", "c.json", "e.txt", "s.json"), ()),
    (f"volume in.obj fault.obj {BOX} -o model --certificate c.json --gocad m.ml --relations r.csv",
     ("c.json", "m.ml", "r.csv"), ("model",)),
    (f"tetrahedralize in.obj fault.obj {BOX} -o t.vtu -o t.msh --certificate c.json --stats s.json",
     ("t.vtu", "t.msh", "c.json", "s.json"), ()),
    (f"tetrahedralize in.obj fault.obj {BOX} -o t.vtu --edge-length 0.5", ("t.vtu",), ()),
    (f"improve in.obj fault.obj {BOX} -o i.obj -o i.vtp --edge-length 1 --certificate c.json",
     ("i.obj", "i.vtp", "c.json"), ()),
    ("build project.json", (), ("out",)),
    ("layer in.obj --layer top=1 --layer base=2 -o l.obj --certificate c.json", ("l.obj", "c.json"), ()),
    ("convert in.obj x.vtp", ("x.vtp",), ()),
    ("fill holed.obj -o f.obj --certificate c.json --points p.csv --map m.svg", ("f.obj", "c.json", "p.csv", "m.svg"), ()),
    (f"report in.obj fault.obj {BOX} -o r.html", ("r.html",), ()),
    ("arrange in.obj fault.obj -o a.vtp -o p.pvtp --memory 1KiB --digest", ("a.vtp", "p.pvtp"), ("p_pieces",)),
    (f"verify proof.json {DATA}/ringmesh/modelA1.ml", (), ()),
    ("ensemble uncertain.json --realisations 60 --engine serial", (), ("run",)),
]
LARGE = [
    (f"arrange {DATA}/arch-platform/faults.ts {DATA}/arch-platform/mnt.ts -o a.vtp -o b.obj --certificate c.json",
     ("a.vtp", "b.obj", "c.json"), ()),
    (f"volume {DATA}/ringmesh/modelA1.ml -o model --certificate c.json", ("c.json",), ("model",)),
    (f"tetrahedralize {DATA}/ringmesh/modelA1.ml -o t.vtu -o t.msh", ("t.vtu", "t.msh"), ()),
]
UNSTEADY = {"s.json", "statistics.json", "log.txt", "r.html", "report.html", "ensemble.json", "ensemble.h5"}
KEPT = "run.realisations"  # for the next run of the same ensemble
MOST_TO_END = 1.0  # seconds, after the signal
# Seconds after which a process must have said what it does at a signal; an interpreter first loads its modules.
MOST_TO_LISTEN = {"ensemble": 1.0}
USUAL_TO_LISTEN = 0.25


class Flaw(Exception):
    pass


def state(folder):
    """All files and folders with their contents."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if name.startswith(KEPT):
            continue
        if path.is_dir():
            found[name] = "folder"
        elif path.name in UNSTEADY and path.stat().st_size > 3:
            found[name] = "changes from run to run"
        else:
            found[name] = hashlib.sha256(path.read_bytes()).hexdigest()
    return found


INPUTS = {"in.obj": HORIZONS, "fault.obj": FAULT, "project.json": PROJECT, "holed.obj": HOLED, "uncertain.json": UNCERTAIN}


def certified(terrane):
    """Returns a certificate of modelA1.ml and its output: what takes the verifier a while."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        subprocess.run([terrane, "arrange", DATA / "ringmesh/modelA1.ml", "-o", "proven.obj", "--certificate", "proof.json",
                        "--quiet"], cwd=folder, check=True)
        return {name: (folder / name).read_text() for name in ("proven.obj", "proof.json")}


def prepare(folder, files):
    for name, text in INPUTS.items():
        (folder / name).write_text(text)
    for name in files:
        (folder / name).write_text("old")


def start(terrane, line, folder, limit=None):
    def limits():
        signal.pthread_sigmask(signal.SIG_SETMASK, [])
        for number in SIGNALS:
            signal.signal(number, signal.SIG_DFL)
        if limit is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
    # Messages go to a pipe: the limit would cut a file short, too.
    return subprocess.Popen([terrane, *line.split()], cwd=folder, stdin=subprocess.DEVNULL,
                            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, preexec_fn=limits)


def ended(process, seconds):
    """Waits for the process; returns its status and what it said."""
    try:
        said = process.communicate(timeout=seconds)[1].decode(errors="replace")
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        raise Flaw("it did not end")
    return process.returncode, said


def answer(process, number):
    """Return "hears", "ignores" or "dies": what a signal does to the process. It may ignore it when all is written."""
    try:
        text = Path(f"/proc/{process.pid}/status").read_text(encoding="utf-8")
    except OSError:
        return "hears"  # it has ended
    masks = {line[:6]: int(line.split()[1], 16) for line in text.splitlines() if re.match("Sig(Cgt|Blk|Ign):", line)}
    has = {name for name, mask in masks.items() if mask >> (number - 1) & 1}
    if has & {"SigCgt", "SigBlk"} or "State:\tZ" in text:
        return "hears"
    return "ignores" if has else "dies"


class Command:
    """A command and what it does when nobody disturbs it."""

    def __init__(self, terrane, line, files, folders):
        self.terrane, self.line, self.files, self.folders = terrane, line, files, folders
        with tempfile.TemporaryDirectory() as scratch:
            folder = Path(scratch) / "work"
            folder.mkdir()
            prepare(folder, files)
            self.before = state(folder)
            begun = time.monotonic()
            self.status, said = ended(start(terrane, line, folder), 600)
            self.seconds = time.monotonic() - begun
            self.after = state(folder)
            self.largest = max(p.stat().st_size for p in folder.rglob("*"))
        if self.status not in (0, 1) or ((files or folders) and self.after == self.before):
            sys.exit(f"{line}: status {self.status}: {said}")

    def disturbed(self, draw):
        """Runs it once, with one kind of trouble; returns what came of it."""
        with tempfile.TemporaryDirectory() as scratch:
            folder = Path(scratch) / "work"
            folder.mkdir()
            prepare(folder, self.files)
            limit = draw.randrange(self.largest + 1) if draw.random() < 0.2 else None
            process = start(self.terrane, self.line, folder, limit)
            late, does = "", ""
            if limit is None:
                begun = time.monotonic()
                time.sleep(draw.uniform(0, 1.1 * self.seconds))
                number = draw.choice(SIGNALS)
                waited = time.monotonic() - begun
                does = answer(process, number)
                if does == "dies" and waited > MOST_TO_LISTEN.get(self.line.split()[0], USUAL_TO_LISTEN):
                    late = f"it does not listen to signal {number:d} after {waited:.2f} s"
                sent = time.monotonic()
                process.send_signal(number)
                if draw.random() < 0.2:
                    time.sleep(draw.uniform(0, 0.05))
                    process.send_signal(draw.choice(SIGNALS))
            status, said = ended(process, 600 + 10 * self.seconds)
            if late:
                raise Flaw(f"{late}; it ended with status {status} and said {said.strip()[-200:]!r}")
            if limit is None and (status != self.status or does == "ignores") and time.monotonic() - sent > MOST_TO_END:
                raise Flaw(f"it took {time.monotonic() - sent:.2f} s to end, with status {status}")
            return self.judged(status, said, limit, state(folder))

    def judged(self, status, said, limit, after):
        if status == self.status:
            if after != self.after:
                raise Flaw(f"status {status}, but not all outputs are there: {differences(self.after, after)}")
            return "ended well"
        if after != self.before:
            raise Flaw(f"status {status}, but files changed: {differences(self.before, after)}; {said}")
        if status < 0:
            if limit is not None or -status not in SIGNALS:
                raise Flaw(f"signal {-status} ended it")
            if said:
                raise Flaw(f"signal {-status} ended it after it said {said}")
            return "ended before it listened"
        if status != 2:
            raise Flaw(f"status {status}: {said}")
        wanted = "File too large"
        if limit is None:
            wanted = "interrupted, nothing written" if self.files else "interrupted"
        if wanted not in said:
            raise Flaw(f"it did not say {wanted!r} but {said!r}")
        return "was interrupted" if limit is None else "met the limit of sizes"


def differences(one, other):
    return sorted(k for k in {*one, *other} if one.get(k) != other.get(k))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--terrane", default=ROOT / "build/release/cli/terrane", type=Path)
    parser.add_argument("--runs", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="only commands that begin so")
    parser.add_argument("--large", action="store_true")
    options = parser.parse_args()
    terrane = str(options.terrane.resolve())
    INPUTS.update(certified(terrane))
    os.environ.pop("TERRANE_TETGEN", None)
    commands = [Command(terrane, *c) for c in COMMANDS + (LARGE if options.large else []) if c[0].startswith(options.only)]
    counts, flaws = {}, 0
    try:
        for run in range(options.runs):
            draw = random.Random(f"{options.seed} {run}")
            command = commands[run % len(commands)]
            try:
                what = command.disturbed(draw)
            except Flaw as flaw:
                what = "FLAW"
                flaws += 1
                print(f"run {run}: {command.line}: {flaw}", flush=True)
            counts[what] = counts.get(what, 0) + 1
    except KeyboardInterrupt:
        print(f"stopped after {sum(counts.values())} runs")
    print(", ".join(f"{n} {what}" for what, n in sorted(counts.items())))
    return 1 if flaws else 0


if __name__ == "__main__":
    sys.exit(main())
