#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Changes what `terrane build --resume` kept, at random, and judges what the next run makes of it.

    scripts/kept_stages.py --terrane build/release/cli/terrane [--count 20 | --seconds 3600] [--seed 1] [--keep FOLDER]

Several projects, with sealing, a resolution, and rounds of refinement, are built once without --resume, and once up to the
point where both stages are kept. Then files of kept stages get flipped bits and other numbers, are cut, grow, change places with
the other stage, with those of sibling projects, of another version and of another user, or become links, pipes and folders.

without the key  Hashes and lengths in the first line are computed anew, for some changes, but not its code: the run has status 0
                 and writes the same bytes as without --resume, and says so where a file is not as it was kept.
with the key     The code is computed anew, too: the run ends with a status of its own, within its memory and its time.

Prints one line for each run that breaks a promise, and a summary. Status 1 if any does.
"""
import argparse
import filecmp
import hashlib
import hmac
import json
import os
import pathlib
import random
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import time

MEMORY = 8 << 30  # bytes of addresses: far more than such models need
HANG = 1800       # seconds
STAGES = ("improve", "tetrahedra")
KINDS = ("bytes", "hash", "other key", "key", "moved", "cut", "stage", "version", "user", "thing")  # of changes, in turn
NUMBERS = (0, 1, 2, 255, 1 << 16, (1 << 31) - 1, 1 << 31, (1 << 32) - 1, 1 << 33, 1 << 40, (1 << 63) - 1, (1 << 64) - 1)

BASE = "o base\nv -1 -1 3\nv 9 -1 4.5\nv 9 9 4.5\nv -1 9 3\nf 1 2 3 4\n"
TOP = "o top\nv -1 -1 {0}\nv 9 -1 3.5\nv 9 9 3.5\nv -1 9 {0}\nf 1 2 3 4\n"
FAULT = "o F1\nv {0} -1 -1\nv {0} {1} -1\nv {0} {1} 9\nv {0} -1 9\nf 1 2 3 4\n"
PROJECT = {"format": "terrane-project 1",
           "surfaces": [{"file": "base.obj", "role": "horizon"}, {"file": "top.obj", "role": "horizon"},
                        {"file": "fault.obj", "role": "fault"}],
           "volume_of_interest": {"box": {"low": [0, 0, 0], "high": [8, 8, 8]}},
           "improve": {"edge_length": 3}, "tetrahedra": {"edge_length": 4},
           "outputs": {"surfaces": ["vtp"], "tetrahedra": ["vtu"], "blocks": "obj"}}


def projects():
    """Names, the height of the top, the place and the end of the fault, and what differs in the project."""
    yield "plain", 5, 4, 4, {}
    yield "moved", 5.25, 4, 4, {}
    yield "coarse", 5, 4, 4, {"improve": {"edge_length": 4}}
    yield "sealed", 5, 4, 7.9, {"seal": 0.5}
    yield "resolved", 5, 4, 4, {"improve": {"edge_length": 3, "resolution": 0.2}}
    yield "rounds", 5, 4, 4, {"tetrahedra": {"edge_length": 4, "refine_bad": 1}}


class Kept:
    """A project, what it writes, and what it keeps."""

    def __init__(self, name, folder):
        self.name, self.folder = name, folder
        self.stages = {stage: (folder / "kept.stages" / stage).read_bytes() for stage in STAGES}


class Trials:
    def __init__(self, terrane, scratch, seed):
        self.terrane, self.scratch, self.random = str(pathlib.Path(terrane).resolve()), scratch, random.Random(seed)
        self.findings = self.runs = 0
        self.of_kind, self.taken = {}, 0
        self.kept = [self.make(*project) for project in projects()]
        self.keys = {user: (scratch / user / "terrane" / "stages.key").read_bytes() for user in ("mine", "other")}

    def start(self, folder, *arguments, user="mine"):
        return subprocess.Popen([self.terrane, "build", "p.json", "--threads", "1", *arguments], cwd=folder,
                                env={**os.environ, "XDG_STATE_HOME": str(self.scratch / user)}, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY)))

    def run(self, folder, *arguments):
        """The status and what was printed; None for a hang."""
        with self.start(folder, *arguments) as process:
            try:
                out, err = process.communicate(timeout=HANG)
            except subprocess.TimeoutExpired:
                process.kill()
                return None
        return process.returncode, out.decode("utf-8", "replace"), err.decode("utf-8", "replace")

    def keep(self, folder, name, user):
        """Ends runs when they begin to write, until one has left both stages."""
        for _ in range(1000):
            with self.start(folder, "-o", name, "--resume", user=user) as process:
                for line in process.stdout:
                    if line.rstrip().endswith(b": write"):
                        process.kill()
            if all((folder / f"{name}.stages" / stage).exists() for stage in STAGES):
                return
            shutil.rmtree(folder / name, ignore_errors=True)
        sys.exit(f"kept_stages: {name} keeps nothing")

    def make(self, name, height, place, end, differs):
        folder = self.scratch / name
        folder.mkdir()
        (folder / "base.obj").write_text(BASE)
        (folder / "top.obj").write_text(TOP.format(height))
        (folder / "fault.obj").write_text(FAULT.format(place, end))
        (folder / "p.json").write_text(json.dumps({**PROJECT, **differs}))
        status, _, said = self.run(folder, "-o", "whole")
        if status != 0:
            sys.exit(f"kept_stages: {name}: status {status}: {said}")
        self.keep(folder, "kept", "mine")
        self.keep(folder, "other", "other")
        return Kept(name, folder)

    # ---- Changes --------------------------------------------------------------------------------------------------

    def sealed(self, bytes_, line, user):
        """The bytes with a first line that has their length and hash, and the code of a user, or the old one for None."""
        name = line.split(b" ")[:5]
        text = b" ".join(name + [str(len(bytes_)).encode(), hashlib.sha256(bytes_).hexdigest().encode(), b""])
        code = line.split(b" ")[-1] if user is None else hmac.new(self.keys[user], text, "sha256").hexdigest().encode()
        return text + code + b"\n" + bytes_

    def altered(self, bytes_):
        """Bytes of which a few are others."""
        changed = bytearray(bytes_)
        for _ in range(self.random.choice((1, 1, 2, 4, 16))):
            at = self.random.randrange(len(changed))
            kind = self.random.randrange(8)
            if kind < 3:
                changed[at] ^= 1 << self.random.randrange(8)
            elif kind == 3:
                changed[at] = self.random.randrange(256)
            elif kind == 4:
                changed[at // 4 * 4:at // 4 * 4 + 4] = struct.pack("<I", self.random.choice(NUMBERS) & 0xffffffff)
            elif kind == 5:
                changed[at // 4 * 4:at // 4 * 4 + 8] = struct.pack("<Q", self.random.choice(NUMBERS))
            elif kind == 6:
                changed[at // 4 * 4:at // 4 * 4 + 8] = struct.pack("<d", self.random.choice((0., -1e308, 5e-324, 1e9, float("nan"),
                                                                                             float("inf"), 0.1)))
            else:
                start = self.random.randrange(len(changed))
                part = changed[start:start + self.random.randrange(64)]
                if self.random.random() < 0.5:
                    changed[at:at + len(part)] = part
                else:
                    changed[at:at] = part
        return bytes(changed)

    def cut_or_grown(self, text):
        length = self.random.choice((0, 1, 64, 200, 600, self.random.randrange(len(text)), len(text) - 1))
        return self.random.choice((text[:length], text + bytes(length), text + text, b"\n" + text))

    def put_something_else(self, path):
        """Puts something that is no regular file of some bytes where a stage is."""
        other = self.random.choice(("link", "dangling", "pipe", "folder", "large", "unreadable name"))
        path.unlink(missing_ok=True)
        if other == "link":
            path.symlink_to(self.random.choice(self.kept).folder / "kept.stages" / path.name)
        elif other == "dangling":
            path.symlink_to("/nonexistent/file")
        elif other == "pipe":
            os.mkfifo(path)
        elif other == "folder":
            path.mkdir()
        elif other == "large":
            with open(path, "wb") as file:
                file.write(self.random.choice(self.kept).stages[path.name])
                file.truncate(1 << 42)
        else:
            path.write_bytes(b"\x1b[31m\xff\xfe" * 64)
        return other

    def change(self, project, folder):
        """Changes the stages in a folder. Returns the kind of the change, and whether it was made with the key."""
        kind = KINDS[self.runs % len(KINDS)]
        for stage in self.random.sample(STAGES, self.random.randint(1, 2)):
            path = folder / stage
            text = project.stages[stage]
            sibling = self.random.choice(self.kept).stages[stage]
            line, bytes_ = text.split(b"\n", 1)
            users = {"hash": None, "other key": "other", "key": "mine"}
            if kind == "bytes":
                text = self.altered(text)
            elif kind in users:
                new = self.random.choice((bytes_, sibling.split(b"\n", 1)[1]))
                text = self.sealed(self.altered(new), line, users[kind])
            elif kind == "moved":
                text = sibling
            elif kind == "cut":
                text = self.cut_or_grown(text)
            elif kind == "stage":
                text = project.stages[STAGES[1 - STAGES.index(stage)]]
            elif kind == "version":
                text = self.sealed(bytes_, line.replace(b" 2, terrane ", b" 2, terrane 9"), "mine")
            elif kind == "user":
                text = (project.folder / "other.stages" / stage).read_bytes()
            else:
                kind = self.put_something_else(path)
                continue
            path.write_bytes(text)
        return kind, kind == "key"

    # ---- Judgement ------------------------------------------------------------------------------------------------

    def differs(self, whole, out):
        names = {str(p.relative_to(whole)) for p in whole.rglob("*") if p.is_file()}
        if names != {str(p.relative_to(out)) for p in out.rglob("*") if p.is_file()}:
            return "other files"
        names -= {"log.txt", "statistics.json"}  # with times
        _, wrong, missing = filecmp.cmpfiles(whole, out, names, shallow=False)
        if wrong or missing:
            return f"other bytes in {wrong + missing}"
        of = [json.loads((folder / "statistics.json").read_text()) for folder in (whole, out)]
        for statistics in of:
            for times in ("seconds", "resumed", "memory", "peak_rss_mb", "threads"):
                statistics.pop(times, None)
            statistics["improve"].pop("pairs")  # a mesh that was taken is proven conforming in another way
        return "other statistics" if of[0] != of[1] else ""

    def trial(self):
        project = self.random.choice(self.kept)
        folder, out = project.folder / "out.stages", project.folder / "out"
        for left in (folder, out):
            shutil.rmtree(left, ignore_errors=True)
        shutil.copytree(project.folder / "kept.stages", folder)
        kind, with_key = self.change(project, folder)
        same = all((folder / s).is_file() and (folder / s).stat().st_size == len(project.stages[s]) and
                   (folder / s).read_bytes() == project.stages[s] for s in STAGES)
        done = self.run(project.folder, "-o", "out", "--resume")
        if done is None:
            return project, kind, "hangs"
        status, printed, said = done
        if not 0 <= status <= 3:
            return project, kind, f"ends by signal {-status}: {said}"
        self.taken += "taken from" in printed
        if with_key:
            return project, kind, "" if (status == 0) == out.is_dir() else f"status {status} and results"
        if status != 0:
            return project, kind, f"status {status}: {said}"
        if not same and "is run again" not in said:
            return project, kind, "no word about what is not as it was kept"
        return project, kind, self.differs(project.folder / "whole", out)

    def repeat(self, goes_on):
        while goes_on(self.runs):
            project, kind, wrong = self.trial()
            self.runs += 1
            self.of_kind[kind] = self.of_kind.get(kind, 0) + 1
            if wrong:
                self.findings += 1
                print(f"kept_stages: run {self.runs}, {project.name}, {kind}: {wrong}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--terrane", required=True)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seconds", type=float, help="instead of --count")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", help="an empty folder for all files (default: a temporary one)")
    arguments = parser.parse_args()
    end = time.monotonic() + (arguments.seconds or 0)
    with tempfile.TemporaryDirectory() as scratch:
        trials = Trials(arguments.terrane, pathlib.Path(arguments.keep or scratch).resolve(), arguments.seed)
        trials.repeat((lambda runs: time.monotonic() < end) if arguments.seconds else (lambda runs: runs < arguments.count))
    print(f"kept_stages: {trials.runs} runs ({', '.join(f'{n} {k}' for k, n in sorted(trials.of_kind.items()))}), "
          f"{trials.taken} took a stage, {trials.findings} findings")
    return 1 if trials.findings or not trials.taken else 0


if __name__ == "__main__":
    sys.exit(main())
