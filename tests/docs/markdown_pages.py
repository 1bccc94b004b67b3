# SPDX-License-Identifier: LGPL-3.0-or-later
"""Reads what the documentation tests need from Markdown: fenced blocks, commands, links, headings."""
import re
import unicodedata
from dataclasses import dataclass, field

FENCE = re.compile(r"^(\s*)(`{3,}|~{3,})\s*([\w+-]*)")
DIRECTIVE = re.compile(r"^\s*<!--\s*(file|given|not run|needs|source):\s*(.*?)\s*-->\s*$")
HEADING = re.compile(r"^#{1,6}\s+(.*?)\s*#*\s*$")
LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\[\]]*\])*\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
LINK_DEFINITION = re.compile(r"^\s{0,3}\[[^\]]+\]:\s+<?(\S+?)>?(?:\s|$)")
HTML_LINK = re.compile(r"""<(?:a|img)\b[^>]*?\b(?:href|src)=["']([^"']+)["']""")
QUOTED_NUMBER = re.compile(r"\*\*(\d[\d. ]*(?:e[+-]?\d+)?)\*\*")
INLINE_CODE = re.compile(r"(`+)(?:(?!\1).)+?\1")


class PageError(Exception):
    """A page breaks the rules of tests/docs/README.md."""


@dataclass
class Block:
    """A fenced block. Line numbers count from 1; `line` is that of the opening fence."""
    language: str
    line: int
    lines: list
    directive: str = ""  # "file", "given", "source", "not run" or empty: from a comment right before the block
    argument: str = ""


@dataclass
class Command:
    """A command of a console block and the output that the page shows."""
    text: str
    line: int  # of the first line of the command
    output_line: int  # of the first line of the output, or where it would be
    output: list = field(default_factory=list)


def blocks_of(text, page="page"):
    """All fenced blocks of a page, in order."""
    blocks, open_block, marker = [], None, ""
    directive = ("", "")
    for number, line in enumerate(text.splitlines(), 1):
        if open_block is not None:
            if line.strip().startswith(marker) and line.strip().strip(marker[0]) == "":
                blocks.append(open_block)
                open_block = None
            else:
                open_block.lines.append(line)
            continue
        found = DIRECTIVE.match(line)
        if found:
            directive = found.groups()
            continue
        fence = FENCE.match(line)
        if fence:
            if fence.group(1):
                raise PageError(f"{page}:{number}: an indented block is no block to MkDocs")
            marker = fence.group(2)
            open_block = Block(fence.group(3), number, [], *directive)
        if line.strip():
            directive = ("", "")
    if open_block is not None:
        raise PageError(f"{page}:{open_block.line}: the block has no end")
    return blocks


def needs_of(text):
    """What the comments <!-- needs: X --> of a page ask for."""
    found = (DIRECTIVE.match(line) for line in text.splitlines())
    return [m.group(2) for m in found if m and m.group(1) == "needs"]


def commands_of(block, page="page"):
    """The commands of a console block. A line that ends in a backslash goes on after '> '."""
    commands, continues = [], False
    for offset, line in enumerate(block.lines, 1):
        number = block.line + offset
        if continues:
            if not line.startswith("> "):
                raise PageError(f"{page}:{number}: a continued command needs '> ' here")
            commands[-1].text += "\n" + line[2:]
            commands[-1].output_line = number + 1
            continues = line.endswith("\\")
        elif line.startswith("$ "):
            commands.append(Command(line[2:], number, number + 1))
            continues = line.endswith("\\")
        elif not commands:
            raise PageError(f"{page}:{number}: a console block begins with '$ '")
        else:
            commands[-1].output.append(line)
    if not commands:
        raise PageError(f"{page}:{block.line}: the console block has no command")
    return commands


def lines_of_text(text):
    """Pairs of number and line of all lines outside of fenced blocks."""
    marker = ""
    for number, line in enumerate(text.splitlines(), 1):
        fence = FENCE.match(line)
        if marker:
            if line.strip().startswith(marker) and line.strip().strip(marker[0]) == "":
                marker = ""
        elif fence:
            marker = fence.group(2)
        else:
            yield number, line


def without_code(text):
    """The text with fenced blocks and code spans blanked; the lines keep their numbers."""
    lines = [""] * len(text.splitlines())
    for number, line in lines_of_text(text):
        lines[number - 1] = INLINE_CODE.sub("", line)
    return "\n".join(lines)


def numbers_not_shown(text):
    """Pairs of line number and number: bold numbers in sentences that no block of the page has."""
    shown = {word.strip(".,;:") for block in blocks_of(text) for line in block.lines
             for word in re.split(r"[\s()%]+", line)}
    return [(number, found) for number, line in enumerate(without_code(text).splitlines(), 1)
            for found in QUOTED_NUMBER.findall(line) if found.replace(" ", "") not in shown]


def links_of(text):
    """Pairs of line number and target of all links and images outside of code."""
    plain, links = without_code(text), []
    for found in LINK.finditer(plain):
        links.append((plain.count("\n", 0, found.start()) + 1, found.group(1)))
    for number, line in enumerate(plain.splitlines(), 1):
        links += [(number, m.group(1)) for m in HTML_LINK.finditer(line)]
        definition = LINK_DEFINITION.match(line)
        if definition:
            links.append((number, definition.group(1)))
    return sorted(links)


def headings_of(text):
    """The headings of a page as plain text, in order."""
    found = (HEADING.match(line) for _, line in lines_of_text(text))
    return [re.sub(r"[`*]|\[([^\]]*)\]\([^)]*\)", r"\1", heading.group(1)) for heading in found if heading]


def host_slug(heading):
    """The anchor that code hosts give a heading."""
    kept = [c for c in heading.strip().lower() if c.isalnum() or c in " -_"]
    return "".join(kept).replace(" ", "-")


def site_slug(heading):
    """The anchor that MkDocs (Python-Markdown's toc) gives a heading."""
    plain = unicodedata.normalize("NFKD", heading).encode("ascii", "ignore").decode()
    plain = re.sub(r"[^\w\s-]", "", plain).strip().lower()
    return re.sub(r"[-\s]+", "-", plain)


def anchors_of(text):
    """Anchors that work both on code hosts and on the site; repeated headings get none but one."""
    headings = headings_of(text)
    return {host_slug(h) for h in headings if host_slug(h) == site_slug(h)}
