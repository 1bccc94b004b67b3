#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Judges the manual pages and completion scripts of a build tree.

    manual_pages.py PROGRAM PAGES

(1) PAGES has terrane.1 and a page for each command, and they are what the program prints now.
(2) mandoc finds no warning in them, nor does man. Either is left out, and named, where it is not installed.
(3) A page shows each option of --help with its description, and the examples, word by word.
"""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

PROGRAM, PAGES = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2])
findings = []


def expect(holds, sentence):
    if not holds:
        findings.append(sentence)
        print(f"manual_pages: {sentence}", file=sys.stderr)


def said(*words):
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=True).stdout


def commands():
    listed = said("--help").split("Subcommands:\n")[1].split("\n\n")[0]
    return [line.split()[0] for line in listed.splitlines()]


def judge_with_mandoc(page):
    done = subprocess.run(["mandoc", "-Tlint", "-Wwarning", page], capture_output=True, text=True, check=False)
    # A date would make each build another one.
    warnings = [line for line in done.stdout.splitlines() if "missing date" not in line]
    expect(not warnings, "\n".join(warnings))


def shown(page):
    """The page as man shows it, in one line without hyphenation, and what man warns of."""
    done = subprocess.run(["man", "--warnings", "--no-hyphenation", "--no-justification", "-E", "UTF-8", "-l", page],
                          capture_output=True, text=True, check=False,
                          env={**os.environ, "LC_ALL": "C.UTF-8", "MANWIDTH": "500", "MAN_KEEP_FORMATTING": ""})
    expect(done.returncode == 0 and done.stderr == "", f"{page.name}: man warns: {done.stderr}")
    return " ".join(re.sub(r".\x08|\x1b\[\d*m", "", done.stdout).split())


def help_of(command):
    """The descriptions of options in --help, and its examples."""
    text = said(command, "--help")
    rows = re.findall(r"^  (-\S+|[A-Z]+)(?: \S+)*? {2,}(.*(?:\n {28}.*)*)", text, re.M)
    examples = text.split("Examples:\n")[1].splitlines() if "Examples:\n" in text else []
    return rows, [line.strip() for line in examples if line.strip()]


def judge_content(command, page):
    text = shown(page)
    rows, examples = help_of(command)
    expect(rows, f"{command}: no option is found in --help")
    for name, description in rows:
        expect(name.replace(",", ", ") in text, f"{page.name} has no {name}")
        words = " ".join(description.split())
        expect(words in text, f"{page.name} does not say of {name}: {words}")
    for line in examples:
        expect(" ".join(line.split()) in text, f"{page.name} has no example {line}")


def main():
    pages = {PAGES / "man/man1/terrane.1": ("manual",)}
    for command in commands():
        pages[PAGES / f"man/man1/terrane-{command}.1"] = ("manual", command)
    scripts = {PAGES / "bash-completion/completions/terrane": ("completion", "bash"),
               PAGES / "zsh/vendor-completions/_terrane": ("completion", "zsh"),
               PAGES / "fish/vendor_completions.d/terrane.fish": ("completion", "fish")}
    for file, words in {**pages, **scripts}.items():
        expect(file.exists() and file.read_text() == said(*words), f"{file} is not what the program prints")
    there = set((PAGES / "man/man1").iterdir())
    expect(there == set(pages), f"other pages are {sorted(there ^ set(pages))}")
    for tool in ("mandoc", "man"):
        if not shutil.which(tool):
            print(f"skipped: {tool} is not installed")
    for page, words in pages.items():
        if shutil.which("mandoc"):
            judge_with_mandoc(page)
        if shutil.which("man") and len(words) == 2:
            judge_content(words[1], page)
    print(f"{len(pages)} pages, {len(findings)} findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
