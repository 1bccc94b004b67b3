#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Mutates the sources of folders, and sees which mutants their tests kill.

    scripts/mutants.py [--sample N] [--seed N] [--jobs N] [--work FOLDER] [--tests TEXT] [--longest S] FOLDER...

A mutant negates a comparison, moves its boundary (`<` to `<=`), drops a condition behind `&&` or `||`, negates the
condition of an `if`, or leaves out the first or last step of a loop. All are compiled once: scripts/mutants.hpp
switches one on at run time. The script needs a finished build of the preset release, from which it takes the
commands and all other objects. It runs the tests in tests/FOLDER once to see which places each of them reaches. Each
mutant of the sample is then judged by the tests that reach it, the shortest first, until one fails, crashes, or takes
ten times as long as before. Inline functions of the folders' headers are mutated where sources of the folders use
them.

It prints each survivor with its file, line and code, and counts. tests/FOLDER/survivors.txt lists survivors that are
no gaps in the tests: a line with the code of each, ` | ` and the reason. Exit status 1 if there are others.
"""
import argparse
import os
import random
import re
import resource
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build/release"
SKIPPED = re.compile(r"\b(static_assert|constexpr|requires|template|operator|concept|assert)\b|^\s*#|R\"|\bASSERT")
COMPARISONS = {"<": 0, "<=": 1, ">": 2, ">=": 3, "==": 4, "!=": 5}
OPERATOR = re.compile(r"(?<=\s)(<=|>=|<|>|==|!=|&&|\|\|)(?=\s|$)")
TEXT = re.compile(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])+\'|//.*')
LONGEST = 10  # times as long as without a mutant, and seconds for what is short


@dataclass
class Place:
    file: str
    line: int
    code: str
    variants: list  # their names

    def __str__(self):
        return f"{self.file}:{self.line}: {self.code}"


@dataclass
class Mutant:
    place: int
    variant: int
    name: str


def closing(text, start):
    """Returns the place of the parenthesis that closes the one at `start`."""
    depth = 0
    for i in range(start, len(text)):
        depth += {"(": 1, ")": -1}.get(text[i], 0)
        if depth == 0:
            return i
    return None


def edits_of_line(blank, is_loop):
    """Lists what can be written otherwise in a line without texts and comments: tuples of a start, an end, the
    beginning and the end of the new text, and the names of its variants."""
    edits = []
    for found in OPERATOR.finditer(blank):
        op = found[1]
        if op in ("&&", "||"):
            word, name = ("And", "true") if op == "&&" else ("Or", "false")
            edits.append((found.start(), found.end(), op + f"::terrane::mutants::{word}{{", "}|", [f"{op} {name}"]))
            continue
        kind = 6 if op == "<" and is_loop else COMPARISONS[op]
        ends = ("==", "==") if kind in (4, 5) else ("<=", ">=")
        names = [f"not {op}"]
        if kind < 4:
            names.append(f"{op} to {op[0] if op[1:] else op + '='}")
        elif kind == 6:
            names.append("last step left out")
        edits.append((found.start(), found.end(), f"{ends[0]}::terrane::mutants::Comparison<{kind}>{{", "}" + ends[1],
                      names))
    if found := re.search(r"\bif \(", blank):
        end = closing(blank, found.end() - 1)
        inside = blank[found.end():end] if end else ""
        if inside and not OPERATOR.search(inside) and not re.search(r" = |;|\bauto\b", inside):
            edits.append((found.end(), found.end(), "::terrane::mutants::Condition{", "}(", ["not if"]))
            edits.append((end, end, ")", None, []))
    if (found := re.search(r"\bfor \(", blank)) and " : " in blank[found.end():] and ";" not in blank[found.end():]:
        if end := closing(blank, found.end() - 1):
            edits.append((found.end(), found.end(), "::terrane::mutants::First first_step{", "}; ",
                          ["first step left out"]))
            edits.append((end + 1, end + 1, " if (first_step.skips()) {} else", None, []))
    return sorted(edits, key=lambda edit: edit[0])


def mutate(name, text, places, dropped):
    """Returns the text of a file with switches; adds these to `places`. `dropped` has lines that stay as they are."""
    lines = []
    for number, line in enumerate(text.split("\n"), 1):
        blank = TEXT.sub(lambda found: "x" * len(found[0]), line)
        if SKIPPED.search(blank):
            lines.append(line)
            continue
        new, end = "", 0
        is_loop = bool(re.search(r"\bfor \(.*;", blank))
        for start, stop, before, after, names in edits_of_line(blank, is_loop):
            new += line[end:start] + before
            if after is not None:
                places.append(Place(name, number, line.strip(), names))
                new += str(len(places)) + after
            end = stop
        lines.append(line if (name, number) in dropped else new + line[end:])
    return "\n".join(lines)


class Program:
    """The test program with all mutants of the folders."""

    def __init__(self, folders, work):
        self.folders, self.work = folders, work
        self.tree = work / "include/terrane"
        self.places = []
        self.dropped = set()
        self.path = work / "tests/terrane_tests"

    def build(self, jobs):
        files = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split()
        for file in files:
            if file.endswith((".hpp", ".cpp", ".h", ".inc")):
                (self.tree / file).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(ROOT / file, self.tree / file)
        ours = [file for file in files if file.endswith((".hpp", ".cpp")) and self.is_ours(file)]
        commands = subprocess.run(["ninja", "-t", "commands", "terrane_tests"], cwd=BUILD, capture_output=True,
                                  text=True, check=True).stdout.splitlines()
        ours_only = [command for command in commands if self.source(command)]
        left = ours_only
        while left:
            self.places.clear()
            for file in ours:
                (self.tree / file).write_text(mutate(file, (ROOT / file).read_text(), self.places, self.dropped))
            with ThreadPoolExecutor(jobs) as pool:
                errors = list(pool.map(self.compile, left))
            before = len(self.dropped)
            for text in errors:
                self.drop(text)
            left = [command for command, text in zip(left, errors) if text]
            if left and len(self.dropped) == before:
                sys.exit("mutants: this does not compile:\n" + "".join(errors)[:4000])
        self.link(commands[-1], [self.object_of(command) for command in ours_only])

    def is_ours(self, file):
        return any(file.startswith(folder + "/") for folder in self.folders)

    def source(self, command):
        """Returns the source of a command if it compiles sources of the folders."""
        words = command.split()
        if "-c" not in words:
            return None
        source = Path(words[words.index("-c") + 1])
        text = source.read_text() if "Unity" in source.parts else f'"{source}"'
        included = re.findall(r'"([^"]+)"', text)
        return source if any(self.is_ours(os.path.relpath(file, ROOT)) for file in included) else None

    def object_of(self, command):
        words = command.split()
        return self.work / Path(words[words.index("-o") + 1]).name

    def compile(self, command):
        """Compiles the mutated sources of a command; returns the errors."""
        source = self.source(command)
        text = source.read_text() if "Unity" in source.parts else f'#include "{source}"\n'
        copy = self.work / source.name
        copy.write_text(text.replace(f'"{ROOT}/', f'"{self.tree}/'))
        words = [word for word in shlex.split(command) if word != "-Werror"]
        words[words.index("-o") + 1] = str(self.object_of(command))
        words[words.index("-MF") + 1] = str(self.object_of(command)) + ".d"
        words[words.index("-c") + 1] = str(copy)
        words = [f"-I{self.work}/include" if word == f"-I{BUILD}/include" else word for word in words]
        words += ["-w", "-include", str(ROOT / "scripts/mutants.hpp"), "-O1"]
        done = subprocess.run(words, cwd=BUILD, capture_output=True, text=True)
        return done.stderr if done.returncode else ""

    def drop(self, errors):
        """Leaves out the lines that errors name."""
        for file, line in re.findall(re.escape(str(self.tree)) + r"/([^:\s]+):(\d+)", errors):
            if any((p.file, p.line) == (file, int(line)) for p in self.places):
                self.dropped.add((file, int(line)))

    def link(self, command, objects):
        self.path.parent.mkdir(exist_ok=True)
        if not (self.work / "libexec").exists():  # where the program looks for its helpers
            (self.work / "libexec").symlink_to(BUILD / "libexec")
        command = command.replace("-o tests/terrane_tests", f"-o {self.path}")
        for library in BUILD.glob("*.a"):
            members = subprocess.run(["ar", "t", library], capture_output=True, text=True, check=True).stdout.split()
            replaced = [o for o in objects if o.name in members]
            if replaced:
                copy = self.work / library.name
                shutil.copyfile(library, copy)
                subprocess.run(["ar", "r", copy, *replaced], check=True)
                command = re.sub(rf"(?<=\s)\S*\b{re.escape(library.name)}", str(copy), command)
        subprocess.run(command.split(" && cd ")[0], shell=True, cwd=BUILD, check=True)

    def run(self, test, limit, **environment):
        """Runs a test; returns whether it passes, and its time."""
        def limit_memory():
            resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        start = time.monotonic()
        try:
            done = subprocess.run([self.path, re.sub(r"([,\[\]*\\\"])", r"\\\1", test), "--abort"], cwd=self.work,
                                  env={**os.environ, **environment}, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL, timeout=limit, preexec_fn=limit_memory)
            return done.returncode == 0, time.monotonic() - start
        except subprocess.TimeoutExpired:
            return False, limit


def tests_of(folders, text):
    """Lists the names of the tests of folders."""
    names = []
    for folder in folders:
        for file in sorted((ROOT / "tests" / folder).rglob("*.cpp")):
            for found in re.finditer(r'^TEST_CASE\(\s*((?:"(?:\\.|[^"\\])*"\s*)+)', file.read_text(), re.MULTILINE):
                names.append("".join(re.findall(r'"((?:\\.|[^"\\])*)"', found[1])).replace('\\"', '"'))
    return [name for name in names if text in name]


def reach(program, tests, jobs, longest):
    """Runs each test without mutants. Returns per test, the shortest first, its time and the places it reaches."""
    def one(numbered):
        number, test = numbered
        record = program.work / f"reached_{number}"
        passed, seconds = program.run(test, longest, TERRANE_MUTANTS_REACHED=str(record))
        if seconds >= longest:
            return None
        if not passed:
            sys.exit(f"mutants: without mutants this test fails: {test}")
        places = {i for i, byte in enumerate(record.read_bytes()) if byte}
        record.unlink()
        return seconds, test, places
    with ThreadPoolExecutor(jobs) as pool:
        return sorted(filter(None, pool.map(one, enumerate(tests))), key=lambda result: result[0])


def judge(program, mutant, reached):
    """Returns how a mutant ends."""
    ours = [(seconds, test) for seconds, test, places in reached if mutant.place in places]
    for seconds, test in ours:
        if not program.run(test, LONGEST * (seconds + 1), TERRANE_MUTANT=f"{mutant.place}.{mutant.variant}")[0]:
            return "killed"
    return "survived" if ours else "not reached"


def explained(folders):
    """Returns the code of survivors that are no gaps."""
    codes = set()
    for folder in folders:
        file = ROOT / "tests" / folder / "survivors.txt"
        for line in file.read_text().splitlines() if file.exists() else []:
            if not line.startswith("#"):
                codes.add(line.rpartition(" | ")[0].strip())
    return codes


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folders", nargs="+", metavar="FOLDER")
    parser.add_argument("--sample", type=int, default=500, help="number of mutants (default 500)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--work", type=Path, help="keeps the build, and is a new folder by default")
    parser.add_argument("--tests", default="", help="only tests with this text in their names")
    parser.add_argument("--longest", type=float, default=600, help="seconds; tests that take longer are left out")
    options = parser.parse_args()
    program = Program([folder.rstrip("/") for folder in options.folders],
                      (options.work or Path(tempfile.mkdtemp(prefix="mutants"))).resolve())
    program.build(options.jobs)
    mutants = [Mutant(number, variant, name) for number, place in enumerate(program.places, 1)
               for variant, name in enumerate(place.variants, 1) if (place.file, place.line) not in program.dropped]
    reached = reach(program, tests_of(program.folders, options.tests), options.jobs, options.longest)
    print(f"{len(program.places)} places, {len(mutants)} mutants, {len(program.dropped)} lines left out, "
          f"{len(reached)} tests of {sum(seconds for seconds, _, _ in reached):.0f} s", flush=True)
    sample = random.Random(options.seed).sample(mutants, min(options.sample, len(mutants)))
    known = explained(program.folders)
    counts = {"killed": 0, "survived": 0, "not reached": 0, "explained": 0}
    with ThreadPoolExecutor(options.jobs) as pool:
        for mutant, end in zip(sample, pool.map(lambda m: judge(program, m, reached), sample)):
            place = program.places[mutant.place - 1]
            if end != "killed" and place.code in known:
                end = "explained"
            counts[end] += 1
            if end in ("survived", "not reached"):
                print(f"{place}\n    {end}: {mutant.name}", flush=True)
    print(", ".join(f"{number} {end}" for end, number in counts.items()))
    return 1 if counts["survived"] + counts["not reached"] else 0


if __name__ == "__main__":
    sys.exit(main())
