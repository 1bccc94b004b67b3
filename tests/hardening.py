#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks that the programs and libraries that are installed are hardened, by what readelf shows.

    hardening.py --plain PROGRAM --library LIB.a... --helper PROGRAM... PROGRAM...

Programs must be position-independent, resolve all symbols at their start and protect the tables of
these (full RELRO), have no executable stack, call the stack protector, and call fortified functions.
The objects of the libraries must be marked for indirect branch tracking and shadow stacks (on x86;
a linked program loses the mark where the C library's start files have none). PROGRAM of --plain is
one that is not hardened: it must fail, or this test would see nothing. Helpers are started as well:
one that runs must be confined.
"""
import argparse
import os
import platform
import re
import resource
import subprocess
import sys
import time


def readelf(option, path):
    return subprocess.run(["readelf", "--wide", option, path], capture_output=True, text=True,
                          env={**os.environ, "LC_ALL": "C"}, check=True).stdout


def flaws_of_program(path, fortified=True):
    """What a program lacks."""
    flaws = []
    if not re.search(r"Type:\s+DYN", readelf("--file-header", path)):
        flaws.append("is not position-independent")
    segments = readelf("--segments", path)
    if "GNU_RELRO" not in segments:
        flaws.append("has no RELRO")
    if not re.search(r"GNU_STACK\s+(0x\S+\s+){5}RW\s", segments):
        flaws.append("has an executable stack")
    if "NOW" not in "".join(re.findall(r"\(FLAGS(?:_1)?\).*", readelf("--dynamic", path))):
        flaws.append("resolves symbols late")
    symbols = readelf("--dyn-syms", path)
    if "__stack_chk_fail" not in symbols:
        flaws.append("has no stack protector")
    if fortified and not re.search(r"__\w+_chk\b", symbols.replace("__stack_chk_fail", "")):
        flaws.append("calls no fortified function")
    return flaws


def flaws_of_library(path):
    """What the objects of a static library lack."""
    flaws = []
    notes = re.split(r"^File: ", readelf("--notes", path), flags=re.M)[1:]
    unmarked = [n.split("\n")[0] for n in notes if not re.search(r"x86 feature: IBT, SHSTK", n)]
    if platform.machine() == "x86_64" and (unmarked or not notes):
        flaws.append(f"has {len(unmarked)} objects without CET, of {len(notes)}: {unmarked[:3]}")
    objects = re.split(r"^File: ", readelf("--symbols", path), flags=re.M)[1:]
    protected = sum("__stack_chk_fail" in o for o in objects)
    if not objects or 3 * protected < len(objects):
        flaws.append(f"has stack protectors in {protected} objects, of {len(objects)}")
    return flaws


def flaws_of_running(helper):
    """In what a helper that waits for its request is not confined."""
    process = subprocess.Popen([helper], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    try:
        status = limits = ""
        while process.poll() is None:
            with open(f"/proc/{process.pid}/limits", encoding="ascii") as file:
                limits = file.read()
            with open(f"/proc/{process.pid}/status", encoding="utf-8") as file:
                status = file.read()
            if re.search(r"Max address space\s+\d", limits):
                break
            time.sleep(0.01)
    finally:
        process.kill()
        process.communicate()
    flaws = []
    if not re.search(r"NoNewPrivs:\s+1", status):
        flaws.append("can gain rights")
    for name in ("Max file size", "Max core file size"):
        if not re.search(name + r"\s+0\s+0", limits):
            flaws.append(f"has no limit of 0: {name}")
    memory = re.search(r"Max address space\s+(\d+)\s+(\d+)", limits)
    with open("/proc/meminfo", encoding="ascii") as file:
        sizes = dict(re.findall(r"(\w+):\s+(\d+) kB", file.read()))
    most = 1024 * (int(sizes["MemTotal"]) + int(sizes["SwapTotal"]))
    given = resource.getrlimit(resource.RLIMIT_AS)[0]
    if given != resource.RLIM_INFINITY:
        most = min(most, given)
    if not memory or max(map(int, memory.groups())) > most:
        flaws.append("may have more memory than the machine")
    return flaws


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--plain", required=True)
    parser.add_argument("--library", action="append", default=[])
    parser.add_argument("--helper", action="append", default=[])
    parser.add_argument("programs", nargs="+")
    options = parser.parse_args()
    found = []
    for path in options.programs:
        found += [f"{path} {flaw}" for flaw in flaws_of_program(path)]
    for path in options.helper:  # a small program may have nothing to fortify
        flaws = flaws_of_program(path, fortified=False) + flaws_of_running(path)
        found += [f"{path} {flaw}" for flaw in flaws]
    for path in options.library:
        found += [f"{path} {flaw}" for flaw in flaws_of_library(path)]
    if not {"resolves symbols late", "has no stack protector"} <= set(
            flaws_of_program(options.plain)):
        found.append(f"{options.plain} counts as hardened, so this test sees nothing")
    print("\n".join(found) or "all is hardened")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
