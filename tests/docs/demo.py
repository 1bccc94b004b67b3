#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs scripts/demo.sh with a program that is built already, and compares what it prints with README.md.

Each line of README's sample but "..." must be printed, in this order.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]


def missing(shown, printed):
    """The first line of the sample that is not printed after the ones before it; None if there is none."""
    rest = iter(printed)
    return next((line for line in shown if line != "..." and line not in rest), None)


def main():
    readme = (ROOT / "README.md").read_text()
    shown = re.search(r"scripts/demo\.sh.*?```\n(.*?)```", readme, re.S)[1].splitlines()
    if len(shown) < 10 or missing(shown, [*reversed(shown)]) is None:
        sys.exit("demo: README.md shows no sample, or this test accepts any order")
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([ROOT / "scripts/demo.sh", sys.argv[1], folder], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"demo: status {done.returncode}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    printed = done.stdout.replace(folder, "out/demo").splitlines()
    line = missing(shown, printed)
    if line is not None:
        sys.exit(f"demo: README.md shows a line that is not printed: {line}")


if __name__ == "__main__":
    main()
