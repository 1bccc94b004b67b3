#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Writes the C and C++ blocks of README.md and docs/ as files that can be compiled.

    snippets.py FOLDER

FOLDER/readme has the files that README.md tells its reader to save, FOLDER/snippets one file for each other block. A
block that is no whole file becomes a function: the comment <!-- given: PARAMETERS --> before it says of what.
"""
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/docs"))
from markdown_pages import blocks_of  # noqa: E402

HEADERS = {"cpp": "#include <terrane/advanced.hpp>", "c": "#include <terrane/terrane.h>"}


def text_of(block, place):
    text = "\n".join(block.lines) + "\n"
    if block.directive == "given":
        return f"{HEADERS[block.language]}\n\nvoid given({block.argument}) {{\n{text}}}\n"
    if "#include <terrane/" not in text:
        sys.exit(f"{place}: a block that is no whole file needs <!-- given: PARAMETERS -->")
    return text


def write_all(folder):
    for name in ("readme", "snippets"):
        (folder / name).mkdir(parents=True)
    for page in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))):
        name = page.relative_to(ROOT)
        for block in blocks_of(page.read_text(), name):
            if page.name == "README.md" and page.parent == ROOT and block.directive == "file":
                (folder / "readme" / block.argument).write_text("\n".join(block.lines) + "\n")
            elif block.language in HEADERS:
                place = f"{name}:{block.line}"
                file = place.replace("/", "-").replace(":", "-") + "." + block.language
                (folder / "snippets" / file).write_text(text_of(block, place))


if __name__ == "__main__":
    write_all(Path(sys.argv[1]))
