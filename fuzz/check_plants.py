#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks that each bug of fuzz/plants.txt can be planted.

Each change must fit in exactly one place of its file. fuzz/README.md must list the same bugs.

    fuzz/check_plants.py [COMPILE_COMMANDS]

With the commands of a build, each file with its changes must compile by them, too (it is parsed only). That takes as
long as parsing all these files; scripts/nightly.sh does it.
"""

import collections
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
Plant = collections.namedtuple("Plant", "name target file change what")


def plants():
    lines = (ROOT / "fuzz" / "plants.txt").read_text().splitlines()
    return [Plant(*line.split("~")) for line in lines if line and not line.startswith("#")]


def planted(text, change):
    """Returns the number of places that a change fits, and the text with all of them changed."""
    program = f"undef $/; $_ = <STDIN>; my $n = ({change}g) || 0; print \"$n\\n$_\";"
    run = subprocess.run(["perl", "-e", program], input=text, capture_output=True, text=True, check=True)
    count, _, changed = run.stdout.partition("\n")
    return int(count), changed


def compile_errors(command, directory, source, names):
    """Parses `source` with the command of another file. Returns the errors, or nothing."""
    words = shlex.split(command)
    at = words.index("-c")
    words = [w for i, w in enumerate(words) if i not in (at, at + 1) and w != "-o" and words[i - 1] != "-o"]
    run = subprocess.run([*words, "-fsyntax-only", source], cwd=directory, capture_output=True, text=True)
    return f"{', '.join(names)}: does not compile\n{run.stderr}" if run.returncode else ""


def commands_by_source(commands_file):
    """Returns the entry that compiles each source; files that are compiled together share one."""
    commands = {}
    for entry in json.loads(pathlib.Path(commands_file).read_text()):
        commands[entry["file"]] = entry
        if "/Unity/" in entry["file"] and os.path.exists(entry["file"]):
            for source in re.findall(r'^#include "(.*)"', pathlib.Path(entry["file"]).read_text(), re.M):
                commands[source] = entry
    return commands


def compile_all(texts, names, commands_file):
    """Returns the errors of all changed files."""
    commands = commands_by_source(commands_file)
    errors, results = [], []
    with tempfile.TemporaryDirectory() as scratch:
        with concurrent.futures.ThreadPoolExecutor(min(4, os.cpu_count() or 1)) as pool:
            for number, (file, text) in enumerate(texts.items()):
                source = pathlib.Path(scratch) / f"{number}_{file.name}"
                source.write_text(text)
                entry = commands.get(str(file))
                if entry is None:
                    errors.append(f"{', '.join(names[file])}: {file} is not compiled in this build")
                    continue
                results.append(pool.submit(compile_errors, entry["command"], entry["directory"], str(source), names[file]))
    return errors + [result.result() for result in results]


def main(commands_file=None):
    errors = []
    texts, names = {}, collections.defaultdict(list)
    for plant in plants():
        file = ROOT / plant.file
        if not file.exists():
            errors.append(f"{plant.name}: there is no file {plant.file}")
            continue
        count, _ = planted(file.read_text(), plant.change)
        if count != 1:
            errors.append(f"{plant.name}: fits in {count} places of {plant.file} instead of one")
            continue
        _, texts[file] = planted(texts.get(file, file.read_text()), plant.change)
        names[file].append(plant.name)
    if commands_file:
        errors += compile_all(texts, names, commands_file)

    rows = re.findall(r"^\| `([^`]+)`: (.*) \| `(\w+)` \|", (ROOT / "fuzz" / "README.md").read_text(), re.M)
    if rows != [(p.name, p.what, p.target) for p in plants()]:
        errors.append("fuzz/README.md does not list the bugs of fuzz/plants.txt")

    errors = [e for e in errors if e]
    print("\n".join(errors) or f"{len(plants())} bugs in {len(texts)} files can be planted")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
