#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs each command of the program with each option at values that make no sense, and at one that does.

    tests/arguments/program_arguments.py --program TERRANE --data docs/data [--share S] [--seconds S] [--seed N] [--only NAME]

The commands and options are those of `--help`. (1) For each it is said here how it is tried. (2) A value that makes no sense
is refused with status 2 and a message, or it changes what is printed or written: none is ignored; no run crashes. (3) A value
that makes sense changes it, too; without the other options that it needs it is refused.

--share tries such a share of the values, drawn by --seed. --seconds goes on with random combinations for so long.
"""

import hashlib
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time

from trials import conclude, parse

BOX = "--box=0,0,-1700,2000,1500,-700"
#: Commands, and words that make them work.
BASES = {
    "arrange": "top.ts fault.ts -o out.stl", "volume": f"top.ts base.ts fault.ts -o out {BOX}",
    "tetrahedralize": f"top.ts -o out.vtu {BOX}", "improve": "top.ts fault.ts -o out.stl --edge-length=300",
    "build": "project.json -o out", "ensemble": "project.json -o out --realisations=2 --grid=5 --engine=serial",
    "info": "top.ts fault.ts", "check": "top.ts fault.ts", "fill": "dish.obj -o out.stl", "layer": "--hard=salt.ts --soft=shale.ts --keep=upper -o out.stl",
    "select": "body body.ts -o out.stl", "map": "depth top.ts --step=100 -o out.asc", "section": f"top.ts base.ts fault.ts -o out.svg --level=-1000 {BOX}", "well": f"top.ts base.ts fault.ts --path=wells.csv -o out.csv {BOX}", "grid": f"top.ts base.ts fault.ts -o out.vti --cells=4,4,4 {BOX}", "prisms": "top.ts base.ts -o out.vtu --layers=2", "pillars": "top.ts base.ts -o out.grdecl --step=200 --layers=2", "report": f"top.ts fault.ts -o out.html {BOX}", "view": f"top.ts fault.ts {BOX}", "convert": "top.ts out.stl",
    "verify": "certificate.json", "judge": "arranged.obj top.ts fault.ts", "minimise": "top.ts --test=false -o out.stl",
    "completion": "bash", "manual": "arrange"}
#: Commands that are not run, with the reason; their options are only refused.
NOT_RUN = {"bench": "it measures for hours"}
#: How a command runs or what it says, not what it makes: only nonsense is tried.
HOW = {"--threads", "--quiet", "--color", "--search", "--check", "--stats", "--strict", "--help", "--format", "--input-format",
       "--output", "--engine", "--workers", "--scheduler", "--retries", "--resume", "--memory", "--digest", "--volumes", "--mesher",
       "--time-limit", "--all", "--rounds", "--max-move", "--unit", "--role", "--skip", "--limit", "--large", "--output-format",
       "--suggest-seal", "--corner", "--keep-unverified", "--max-volume-change", "--least-quality", "--max-triangles",
       "--crease-angle", "--curve-angle", "--thickness-share", "--growth", "--smallest", "--layers-in-gaps", "--turn", "--passes",
       "--max-deviation", "--max-change", "--hard", "--soft", "--bridge-faults", "--gap-slope", "--extend", "--edge-length-of",
       "--size-of", "--dissolve", "--resolution", "--min-volume", "--tolerance", "--time", "--expect-input", "--no-optimise", "--optimise", "--spacings"}
#: A value that makes sense ("" for flags), and what it needs besides.
SENSE = {
    "--depth": ("", "IN=seabed.asc"), "--max-edge": ("90", "IN=points.csv"), "--columns": ("1,3,2", "IN=points.csv"), "--box": (BOX[6:], ""),
    "--rotated-box": ("1000,700,-1200,800,600,500,20", ""), "--polygon": ("100,100,1500,100,100,1200", "--between=-1700,-700"),
    "--between": ("-1700,-700", "--polygon=100,100,1500,100,100,1200"), "--within": ("body.ts", ""), "--folder": ("/", ""), "--seal": ("60", ""),
    "--ascii": ("", ""), "--msh": ("2.2", "OUT=out.msh"), "--certificate": ("c.json", "OUT=out.obj"), "--exact": ("x.txt", ""),
    "--report": ("r.html", ""), "--seal-plot": ("p.svg", "--suggest-seal"), "--column": ("column.json", ""), "--parts": ("obj", ""),
    "--relations": ("r.csv", ""), "--juxtaposition": ("j.csv", ""), "--gocad": ("g.ml", ""), "--lines": ("l.pl", ""),
    "--grid": ("grid.grdecl", ""), "--cells": ("cells.grdecl", "--grid=grid.grdecl"), "--order": ("2", ""),
    "--around": ("-500,-500,-2500,2500,2000,0", ""), "--margin": ("0.5", ""), "--edge-length": ("250", ""), "--size-in": ("1=150", ""),
    "--split": ("top", ""), "--blocks-only": ("", "BASE=body.ts -o out.vtu"), "--quality": ("1.3", ""), "--max-volume": ("1e7", ""), "--split-surfaces": ("", "--quality=1.3"),
    "--curve-length": ("80", ""), "--histogram": ("h.svg", ""), "--realisations": ("3", ""), "--seed": ("7", ""),
    "--contact": ("-1000", ""), "--only": ("1", "BASE=project.json -o out"), "--json": ("", ""), "--method": ("rbf", ""),
    "--model": ("gaussian", ""), "--isotropic": ("", ""), "--smoothing": ("3", "--method=rbf"), "--mesh-size": ("9", ""),
    "--rings": ("1", ""), "--holes": ("1", ""), "--max-area": ("1", ""), "--list": ("", "BASE=fold.ts"), "--map": ("m.svg", ""),
    "--soup": ("", "BASE=body.ts"), "--operation": ("union", "BASE=body.ts body.ts"), "--tags": ("", ""), "--test": ("true", "BASE=top.ts -o out.stl"),
    "--points": ("p.csv", ""), "--keep": ("lower", ""), "--min-thickness": ("5", ""),
    "--to": ("base.ts", "BASE=thickness top.ts --step=100 -o out.asc"), "--step": ("90", ""), "--like": ("seabed.asc", "BASE=depth top.ts -o out.asc"),
    "--plane": ("1000,750,0,0,-1,0", f"BASE=top.ts base.ts fault.ts -o out.svg {BOX}"), "--fence": ("100,100,1500,900", f"BASE=top.ts base.ts fault.ts -o out.svg {BOX}"),
    "--level": ("-1100", f"BASE=top.ts base.ts fault.ts -o out.svg {BOX}"), "--contours": ("100", f"BASE=top.ts base.ts fault.ts -o out.svg {BOX}"),
    "--by": ("fault", f"BASE=top.ts base.ts fault.ts -o out.svg {BOX}"), "--exaggeration": ("2", ""),
    "--x": ("0,300,600", ""), "--y": ("0,300,600", ""), "--z": ("-1700,-1200,-700", ""),
    "--path": ("C-3.csv", "--head=200,200,-600"), "--head": ("C-3=200,200,-600", "--path=C-3.csv"),
    "--rule": ("odd", "BASE=body body.ts body.ts -o out.stl"), "--fractions": ("", ""),
    "--layer": ("salt=2", "BASE=salt.ts shale.ts -o out.stl --layer=shale=1")}
#: The same option of another command.
ALSO = {("ensemble", "--grid"): ("7", ""), ("layer", "--certificate"): ("c.json", "OUT=out.obj"),
        ("grid", "--step"): ("400", f"BASE=top.ts base.ts fault.ts -o out.vti {BOX}"), ("grid", "--cells"): ("3,3,3", f"BASE=top.ts base.ts fault.ts -o out.vti {BOX}"),
        ("prisms", "--layers"): ("3", ""), ("prisms", "--follow"): ("top", "--thickness=20"), ("prisms", "--thickness"): ("30", "--follow=base"),
        ("prisms", "--depth"): None, ("prisms", "--max-edge"): None, ("prisms", "--columns"): None,
        ("pillars", "--layers"): ("3", ""), ("pillars", "--x"): ("0,300,900", "BASE=top.ts base.ts -o out.grdecl --y=0,300,900"),
        ("pillars", "--y"): ("0,300,900", "BASE=top.ts base.ts -o out.grdecl --x=0,300,900"), ("pillars", "--step"): ("90", ""),
        ("pillars", "--depth"): None, ("pillars", "--max-edge"): None, ("pillars", "--columns"): None,
        ("grid", "--depth"): None, ("grid", "--max-edge"): None, ("grid", "--columns"): None,
        ("convert", "--msh"): ("2.2", "BASE=top.ts out.msh"), ("convert", "--depth"): ("", "BASE=seabed.asc out.stl"),
        ("convert", "--max-edge"): ("90", "BASE=points.csv out.stl"), ("convert", "--columns"): ("1,3,2", "BASE=points.csv out.stl"),
        ("tetrahedralize", "--msh"): ("2.2", "OUT=out.msh"),
        ("tetrahedralize", "--certificate"): ("c.json", ""), ("volume", "--certificate"): ("c.json", ""),
        ("fill", "--depth"): ("", "IN=seabed.asc"), ("improve", "--edge-length"): ("150", "BASE=top.ts fault.ts -o out.stl"),
        ("layer", "--min-thickness"): ("5", "BASE=salt.ts shale.ts -o out.stl --layer=shale=1 --layer=salt=2"),
        ("layer", "--depth"): None, ("layer", "--max-edge"): None, ("layer", "--columns"): None, ("verify", "--depth"): None,
        ("verify", "--columns"): None, ("fill", "--columns"): None, ("verify", "--max-edge"): None,
        ("judge", "--depth"): None, ("judge", "--max-edge"): None, ("judge", "--columns"): None, ("minimise", "--depth"): None, ("minimise", "--max-edge"): None, ("minimise", "--columns"): None,
        ("volume", "--seal-plot"): ("p.svg", f"BASE=top.ts base.ts fault.ts {BOX} --suggest-seal"),
        ("volume", "--grid"): ("grid.grdecl", "--cells=cells.grdecl"),
        ("fill", "--max-edge"): None, ("select", "--depth"): None, ("map", "--depth"): None, ("map", "--max-edge"): None, ("map", "--columns"): None, ("select", "--max-edge"): None, ("select", "--columns"): None, ("section", "--columns"): None, ("well", "--columns"): None, ("well", "--step"): ("90", f"BASE=top.ts base.ts fault.ts --path=wells.csv -o out.las {BOX}"), ("tetrahedralize", "--seal"): None, ("report", "--seal"): None, ("view", "--seal"): None,
        ("tetrahedralize", "--column"): None, ("fill", "--model"): None, ("fill", "--isotropic"): None,
        ("build", "--report"): ("r.html", ""), ("check", "--depth"): None, ("fill", "--holes"): None}
NONSENSE = ["", "nonsense", "-1", "nan", "inf", "-inf", "1e999", "99999999999999999999999", "1,2", "=", "\x1b[31m", "/dev/null/x.obj",
            "\udcff", "7x", "0x10", "1 2", "%s%n", "a=b=c"]
VOLUMES = ("--rotated-box", "--polygon", "--between", "--within")
#: Limits that large numbers do not reach.
LIMITS = {"--spacings", "--rounds", "--max-move", "--max-volume-change", "--max-triangles", "--max-deviation", "--max-change", "--time-limit", "--time", "--memory",
          "--max-area", "--smallest", "--growth", "--curve-length", "--turn", "--thickness-share", "--least-quality", "--max-edge", "--rings", "--mesh-size", "--gap-slope", "--max-volume", "--retries"}


class Program:
    """The program in folders of its own, with its commands and options."""

    def __init__(self, program, data):
        self.program, self.data = os.path.abspath(program), pathlib.Path(data).absolute()
        self.scratch = tempfile.mkdtemp()
        self.results = {}
        self.options = {command: self.options_of(command) for command in self.commands()}
        self.inputs = pathlib.Path(self.scratch, "inputs")
        self.make_inputs()

    def commands(self):
        text = subprocess.run([self.program, "--help"], capture_output=True, text=True, check=True).stdout
        found = re.search(r"(?s)COMMANDS.*?:?\n(.*?)\n\n", text, re.I)
        return re.findall(r"^  ([a-z]+)  ", found[1], re.M)

    def options_of(self, command):
        """(name, whether it takes a value) of each option."""
        words = ["bench", "paper"] if command == "bench" else [command]
        text = subprocess.run([self.program, *words, "--help"], capture_output=True, text=True, check=True).stdout
        return {name: bool(kind) or name in ("--check", "--seal", "--keep", "--smoothing") for name, kind in re.findall(
            r"^ +(?:-\w,)?(--[a-z-]+)(?: ([A-Z]\S*))?", text.split("\nExamples")[0], re.M)}

    def make_inputs(self):
        shutil.copytree(self.data, self.inputs)
        (self.inputs / "points.csv").write_text("x,y,z\n" + "".join(f"{50 * i + 7 * i * j % 40},{50 * j + 11 * i * j % 30},{i * j}\n" for i in range(9) for j in range(9)))
        (self.inputs / "column.json").write_text('{"column": [{"unit": "upper", "surface": "top"}, {"unit": "lower"}]}')
        (self.inputs / "project.json").write_text(json.dumps({
            "format": "terrane-project 1", "surfaces": [{"file": "top.ts"}], "outputs": {"blocks": "obj"}, "folder": "out",
            "volume_of_interest": {"box": {"low": [0, 0, -1700], "high": [2000, 1500, -700]}},
            "uncertainty": [{"surface": "top", "shift": 5}]}))
        (self.inputs / "grid.grdecl").write_text(GRID)
        corners = [(i, j) for i in range(13) for j in range(13)]
        squares = [13 * i + j + 1 for i, j in corners if i < 12 and j < 12 and not (4 < i < 8 and 4 < j < 8)]
        (self.inputs / "dish.obj").write_text("".join(f"v {10 * i} {10 * j} {(i - 6) ** 2 + i * j % 5}\n" for i, j in corners) + "".join(
            f"f {s} {s + 13} {s + 14}\nf {s} {s + 14} {s + 1}\n" for s in squares))
        subprocess.run([self.program, "arrange", "top.ts", "fault.ts", "-o", "arranged.obj", "--certificate", "certificate.json"],
                       cwd=self.inputs, check=True, capture_output=True)

    def run(self, words):
        """(status, a text that differs where results do)."""
        key = tuple(words)
        if key not in self.results:
            folder = pathlib.Path(tempfile.mkdtemp(dir=self.scratch))
            shutil.rmtree(folder)
            shutil.copytree(self.inputs, folder)
            before = {p: p.stat().st_mtime_ns for p in folder.rglob("*")}
            done = subprocess.run([self.program, *words], cwd=folder, capture_output=True, stdin=subprocess.DEVNULL,
                                  env={**os.environ, "BROWSER": "true", "TMPDIR": str(folder)})
            texts = [done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace")]
            for path in sorted(folder.rglob("*")):
                if path.is_file() and before.get(path) != path.stat().st_mtime_ns:
                    name = re.sub("terrane-view-......", "view", str(path.relative_to(folder)))
                    data = re.sub(rb'id="terrane-run">.*?<', b"", path.read_bytes())
                    texts.append(f"{name} {hashlib.sha256(data).hexdigest()}")
            shutil.rmtree(folder)
            self.results[key] = done.returncode, re.sub(r"[\d.e+-]+ (?:s|MB)\b|terrane-view-......", "", "\n".join(texts))
        return self.results[key]


GRID = """SPECGRID
1 1 1 1 F /
COORD
100 100 -700 100 100 -1700 900 100 -700 900 100 -1700 100 900 -700 100 900 -1700 900 900 -700 900 900 -1700 /
ZCORN
-800 -800 -800 -800 -1500 -1500 -1500 -1500 /
"""


def sense_of(command, option):
    found = ALSO[command, option] if (command, option) in ALSO else SENSE.get(option)
    return None if option in HOW and (command, option) not in ALSO else found


def base_of(command, needs):
    """The words of a command that works, with what an option needs."""
    words = BASES[command]
    if needs.startswith("BASE="):
        return [command, *needs[5:].split()]
    if needs.startswith("OUT="):
        return [command, *re.sub(r"\bout\.\w+", needs[4:], words).split()]
    if needs.startswith("IN="):
        return [command, needs[3:], *[w for w in words.split() if not w.endswith((".ts", ".obj")) and not w.startswith("--box")]]
    return [command, *words.split(), *needs.split()]


def broken(status, text):
    """What is wrong about the end of a run, whatever it was asked."""
    if status not in (0, 1, 2):
        return f"status {status}: {text[-300:]}"
    return f"status 2 without a message: {text[-300:]}" if status == 2 and not any(
        word in text for word in ("terrane: ", "--help", "NOT verified", '"state": "missing"')) else None


def without(words, option):
    """The words without an option that is there already."""
    return [w for w in words if w.split("=")[0] != option]


def try_nonsense(program, command, option, value):
    if command in NOT_RUN:
        status, text = program.run([command, "paper", f"{option}={value}", "--limit=x"])
        return broken(status, text) or (None if status == 2 else "it is taken")
    base = base_of(command, "")
    words = [*without(base, option), f"{option}={value}"]
    status, text = program.run(words)
    flaw = broken(status, text)
    if flaw or status == 2:
        return flaw
    if (status, text) != program.run(base) or (option in LIMITS and value in ("inf", "0x10", "99999999999999999999999")):
        return None
    return "it is ignored"


def try_sense(program, command, option):
    value, needs = sense_of(command, option)
    base = without(base_of(command, needs), option)
    if option in VOLUMES:  # one of them can be given
        base = without(base, "--box")
    word = f"{option}={value}" if value else option
    status, text = program.run([*base, word])
    flaw = broken(status, text)
    if flaw or status == 2:
        return flaw or f"it is refused: {text[-300:]}"
    if (status, text) == program.run(base):
        return "it changes nothing"
    if not needs or needs.startswith("BASE="):
        return None
    plain = without(without(base_of(command, ""), option), "--box" if option in VOLUMES else "")
    status, text = program.run([*plain, word])
    return broken(status, text) or (None if status == 2 or (status, text) != program.run(plain) else f"it is ignored without {needs}")


def try_random(program, draw):
    """Several options at a time: no crash, and what is refused says why."""
    command = draw.choice([c for c in program.options if c not in NOT_RUN])
    words = base_of(command, "")
    for option in draw.sample(sorted(program.options[command]), min(4, len(program.options[command]))):
        sense = sense_of(command, option)
        if option == "--help":
            continue
        if sense and draw.random() < 0.6:
            words = [*without(words, option), f"{option}={sense[0]}" if sense[0] else option]
        elif program.options[command][option]:
            words = [*without(words, option), f"{option}={draw.choice(NONSENSE)}"]
    program.results.clear()
    return words, broken(*program.run(words))


def main():
    parser = parse(__doc__, 0.05)
    parser.add_argument("--program", required=True)
    parser.add_argument("--data", required=True)
    options = parser.parse_args()
    program, draw = Program(options.program, options.data), random.Random(options.seed)
    flaws, tried = [], 0

    def note(place, flaw):
        if flaw:
            flaws.append(f"{place}: {flaw}")
            print(flaws[-1].encode(errors="replace").decode(), flush=True)

    for command, names in program.options.items():
        if command not in BASES and command not in NOT_RUN:
            note(command, "nobody knows how to try it")
            continue
        for option, takes in names.items():
            if options.only and not f"{command} {option}".startswith(options.only):
                continue
            if option not in HOW and option not in SENSE and (command, option) not in ALSO:
                note(f"{command} {option}", "nobody knows how to try it")
            if command not in NOT_RUN and sense_of(command, option) and draw.random() < options.share:
                note(f"{command} {option}", try_sense(program, command, option))
                tried += 1
            for value in NONSENSE if takes else ["nonsense"]:
                if option != "--help" and draw.random() < options.share:
                    note(f"{command} {option}={value!r}", try_nonsense(program, command, option, value))
                    tried += 1
    end = time.monotonic() + options.seconds
    while time.monotonic() < end:
        note(*try_random(program, draw))
        tried += 1
    shutil.rmtree(program.scratch)
    return conclude(tried, flaws)


if __name__ == "__main__":
    sys.exit(main())
