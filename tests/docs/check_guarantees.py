#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks that each test that stands behind a guarantee exists, and that README.md stays short.

check_guarantees.py [ROOT]    Reads the table of README.md and docs/explanation/guarantees.md.

A name in code marks is a test case of Catch2, a test of CTest or a file; '...' stands for any text.
"""
import pathlib
import re
import sys

MOST_LINES = 160  # of README.md
CODE = re.compile(r"`([^`]+)`")
LONG_NAME = re.compile(r'"((?:[^"\\]|\\.)*)"')


def test_names(root):
    """Names of the test cases in the sources and of the tests in the CMake files."""
    names = set()
    for path in (root / "tests").rglob("*.cpp"):
        for start in re.finditer(r"\bTEST_CASE\(", path.read_text()):
            rest = path.read_text()[start.end():start.end() + 400]
            literal = re.match(r'\s*((?:"(?:[^"\\]|\\.)*"\s*)+)', rest) # a long name has several parts
            if literal:
                names.add("".join(LONG_NAME.findall(literal.group(1))))
    for path in (root / "tests").rglob("CMakeLists.txt"):
        names |= set(re.findall(r"(?:add_test|terrane_test_of_texts)\(NAME (\S+)", path.read_text()))
    return names


def in_table(text):
    """(guarantee, names) of the rows whose first cell is G and a number."""
    for line in text.splitlines():
        cells = [c.strip() for c in line.strip().strip("|").split("|")]
        if line.startswith("|") and re.fullmatch(r"G\d+", cells[0]):
            yield cells[0], CODE.findall(cells[-1])


def in_lists(text):
    """(heading, names) of the items that begin with "- Tests:", to the next item or blank line."""
    heading = ""
    for block in re.split(r"\n\s*\n|\n(?=- )", text):
        if block.startswith("#"):
            heading = block.lstrip("# ").split("\n")[0]
        if block.startswith("- Tests:"):
            yield heading, CODE.findall(" ".join(block.split()))


def exists(name, tests, root):
    if "..." in name:
        pattern = ".*".join(re.escape(part) for part in name.split("..."))
        return any(re.fullmatch(pattern, test) for test in tests)
    return name in tests or (root / name).is_file()


def check(root):
    """The count of names, and the flaws as sentences."""
    tests, count, flaws = test_names(root), 0, []
    readme = (root / "README.md").read_text()
    if readme.count("\n") > MOST_LINES:
        flaws.append(f"README.md has more than {MOST_LINES} lines: details belong in docs/")
    table = list(in_table(readme))
    lists = list(in_lists((root / "docs" / "explanation" / "guarantees.md").read_text()))
    if {g for g, _ in table} != {h.split()[0] for h, _ in lists if re.match(r"G\d+ ", h)}:
        flaws.append("README.md and docs/explanation/guarantees.md state other guarantees")
    for where, names in [(f"README.md, {g}", n) for g, n in table] + lists:
        if not names:
            flaws.append(f"{where}: there is no test behind it")
        for name in names:
            count += 1
            if not exists(name, tests, root):
                flaws.append(f"{where}: there is no test or file called {name}")
    return count, flaws


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else __file__).resolve()
    if root.is_file():
        root = root.parents[2]
    count, flaws = check(root)
    for flaw in flaws:
        print(flaw)
    print(f"{count} names of tests, {len(flaws)} flaws")
    return 0 if count > 0 and not flaws else 1


if __name__ == "__main__":
    sys.exit(main())
