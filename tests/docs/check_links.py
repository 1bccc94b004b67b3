#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks that each relative link of each Markdown page leads to a file, and to a heading of it, and the width of lines.

check_links.py [ROOT]    Links to other hosts are counted, not followed: the test needs no network.

No line has more than 120 columns, except in blocks, tables and comments, which Markdown cannot break.
"""
import os
import pathlib
import sys
import urllib.parse

from markdown_pages import anchors_of, headings_of, host_slug, lines_of_text, links_of

LEFT_OUT = {".git", ".cache", "out"}
MOST_COLUMNS = 120


def pages_of(root):
    """All Markdown files of the tree but those in build folders and those of other projects."""
    found = []
    for name, folders, files in os.walk(root):  # not into build folders, where tests come and go
        folders[:] = [f for f in folders if f not in LEFT_OUT and not f.startswith("build")]
        found += [pathlib.Path(name) / file for file in files if file.endswith(".md")]
    for path in sorted(found):
        folders = path.relative_to(root).parts[:-1]
        if not (len(folders) > 2 and folders[:2] == ("tests", "data")):
            yield path


def flaw_of(page, target, root):
    """What is wrong with a link, or None."""
    place, _, anchor = urllib.parse.unquote(target).partition("#")
    path = (page.parent / place).resolve() if place else page
    if place.startswith("/"):
        return "is an absolute path"
    if not path.is_relative_to(root):
        return "leads out of the repository"
    if not path.exists():
        return "leads nowhere"
    docs = root / "docs"
    if page.is_relative_to(docs) and not path.is_relative_to(docs):
        return "leads out of docs/, which the site does not have"
    if not anchor:
        return None
    if path.suffix != ".md":
        return "has an anchor, but is no page"
    text = path.read_text()
    if anchor in anchors_of(text):
        return None
    if anchor in {host_slug(h) for h in headings_of(text)}:
        return "names a heading whose anchor is another one on the site"
    return "names no heading of the page"


def too_wide(text):
    """The numbers of lines that can be broken and are not."""
    return [number for number, line in lines_of_text(text)
            if len(line) > MOST_COLUMNS and not line.startswith(("|", "<!--"))]


def check(root):
    """Counts of pages, links and other hosts, and the flaws."""
    pages = links = others = 0
    flaws = []
    for page in pages_of(root):
        pages += 1
        flaws += [f"{page.relative_to(root)}:{line}: more than {MOST_COLUMNS} columns" for line in too_wide(page.read_text())]
        for line, target in links_of(page.read_text()):
            if urllib.parse.urlsplit(target).scheme:
                others += 1
                continue
            links += 1
            flaw = flaw_of(page, target, root)
            if flaw:
                flaws.append(f"{page.relative_to(root)}:{line}: {target} {flaw}")
    return pages, links, others, flaws


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else __file__).resolve()
    if root.is_file():
        root = root.parents[2]
    pages, links, others, flaws = check(root)
    for flaw in flaws:
        print(flaw)
    print(f"{pages} pages, {links} relative links, {others} links to other hosts (not followed),"
          f" {len(flaws)} flaws")
    return 0 if pages > 0 and not flaws else 1


if __name__ == "__main__":
    sys.exit(main())
