#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks that the text of each licence that a source names is in LICENSES/, and only those.

check_licences.py [ROOT]    LICENSE, which hosts of code look at, must be the library's own text.
"""
import pathlib
import re
import sys

TITLES = {
    "LGPL-3.0-or-later": "GNU LESSER GENERAL PUBLIC LICENSE",
    "GPL-3.0-or-later": "GNU GENERAL PUBLIC LICENSE",  # the LGPL refers to it
    "AGPL-3.0-or-later": "GNU AFFERO GENERAL PUBLIC LICENSE",  # the program with TetGen
    "MIT": "MIT License",  # the folders of MIT alone
}
FOLDERS = ("kernel", "algorithms", "io", "capi", "cli", "fuzz", "fuzzing", "scripts", "tests", "docs")
SOURCES = {".cpp", ".hpp", ".py", ".sh", ".cmake", ".txt"}
MIT = ("fuzzing/", "docs/examples/clusterfuzzlite/", "docs/examples/github/")
FOREIGN = ("tests/data", "tests/certified", "fuzz/corpus", "docs/data")


def identifiers(root):
    """Pairs of path and SPDX identifier (None without one) of all sources."""
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            name = path.relative_to(root).as_posix()
            if path.suffix in SOURCES and path.is_file() and not name.startswith(FOREIGN):
                found = re.search(r"SPDX-License-Identifier: (\S+)", path.read_text()[:1000])
                yield name, found and found.group(1)


def check(root):
    """The count of sources, and the flaws as sentences."""
    flaws, count = [], 0
    for name, identifier in identifiers(root):
        count += 1
        if identifier not in TITLES:
            flaws.append(f"{name}: {identifier or 'no licence'} has no text in LICENSES/")
        elif (identifier == "MIT") != name.startswith(MIT):
            flaws.append(f"{name}: {identifier} is not the licence of this folder")
    texts = {path.stem: path.read_text() for path in (root / "LICENSES").glob("*.txt")}
    if set(texts) != set(TITLES):
        flaws.append(f"LICENSES/ has {sorted(texts)} instead of {sorted(TITLES)}")
    for identifier in set(texts) & set(TITLES):
        if texts[identifier].split("\n")[0].strip() != TITLES[identifier]:
            flaws.append(f"LICENSES/{identifier}.txt is another text")
    if not (root / "LICENSE").is_file() or (root / "LICENSE").read_text() != texts.get("LGPL-3.0-or-later"):
        flaws.append("LICENSE is not LICENSES/LGPL-3.0-or-later.txt")
    return count, flaws


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else __file__).resolve()
    if root.is_file():
        root = root.parents[2]
    count, flaws = check(root)
    for flaw in flaws:
        print(flaw)
    print(f"{count} sources, {len(flaws)} flaws")
    return 0 if count > 0 and not flaws else 1


if __name__ == "__main__":
    sys.exit(main())
