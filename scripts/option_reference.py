#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Writes what the described options do (algorithms/core/fields.hpp) where they are listed a second time: in
docs/reference/commands.md and project.md, in io/project.schema.json and in the structs of the C interface.

    PYTHONPATH=build/release/python scripts/option_reference.py [--check]

A row may say more than the description, after it. With --check nothing is written, and the exit status is 1 where a
text is another one, or an option is missing.
"""
import argparse
import json
import re
import sys
import textwrap
from pathlib import Path

from terrane import _core

NUMBER = r"[\d.e]+"
ROOT = Path(__file__).resolve().parent.parent
# Fields, the command, the object of a project, and the struct of C in mesh.h, where it has them
# in their order.
STRUCTS = (
    (_core.improve_fields, "improve", "improve", "terrane_improve_options"),
    (_core.fill_fields, "fill", "fill[]", None),
    (_core.tetrahedra_fields, "tetrahedralize", "tetrahedra", None),
)


class Pages(dict):
    """Texts of files, which may be changed, and what was wrong with them."""

    def __init__(self):
        super().__init__()
        self.flaws = []

    def __missing__(self, name):
        self[name] = (ROOT / name).read_text()
        return self[name]

    def change(self, name, old, new, what):
        if old != new:
            self.flaws.append(f"{name}: {what} is described otherwise")
            self[name] = self[name].replace(old, new, 1)

    def row(self, name, start, key, text, what):
        """The row of a table that begins with `key`, after `start`."""
        page = self[name]
        section = page[page.index(start):]
        found = re.search(rf"^\| `{re.escape(key)}` \| (.*?) \|(.*?)\|$", section, re.M)
        if not found:
            self.flaws.append(f"{name}: {what} is missing")
            return
        sentence = found[1] if found[1].startswith(text) else text + "."
        self.change(name, found[0], f"| `{key}` | {sentence} |{found[2]}|", what)


def dashed(name):
    return "--" + name.replace("_", "-")


def plain(field):
    return field["text"].replace("`", "")


def check_pages(pages, fields, section, key):
    for field in fields:
        name = field["name"]
        if field["type"] == "none":
            continue  # a choice, whose words each language lists by itself
        text = re.sub(r"`(\w+)`", lambda m: f"`{dashed(m[1])}`", field["text"])
        pages.row("docs/reference/commands.md", f"\n## {section}\n", f"{dashed(name)} {field['placeholder']}".strip(), text, name)
        if field["in_project"]:
            pages.row("docs/reference/project.md", "\n| Key |", f"{key}.{name}", field["text"], f"{key}.{name}")


def check_schema(pages, fields, key):
    name = "io/project.schema.json"
    level = key.removesuffix("[]")  # of the object, or of the entries of an array
    known = json.loads(pages[name])["properties"][level]
    known = known.get("items", known)["properties"]
    wanted = {f["name"]: f for f in fields if f["in_project"]}
    pages.flaws += [f"{name}: {key}.{n} is missing" for n in wanted.keys() - known.keys()]
    for field in known.keys() & {n for n, f in wanted.items() if f["type"] != "none"}:
        default = wanted[field]["default"]
        text = plain(wanted[field]) + "."
        if not re.fullmatch(NUMBER + "|true|false", default):  # the schema states these by itself
            text += f" Default: {default}.".replace("`", "")
        object_at = pages[name].index(f'    "{level}": {{\n')
        start = pages[name].index(f'      "{field}": {{\n', object_at)
        old = re.compile(r'"description": ".*"').search(pages[name], start)[0]
        if not json.loads("{" + old + "}")["description"].startswith(plain(wanted[field]) + "."):
            pages.change(name, old, f'"description": {json.dumps(text)}', f"{key}.{field}")


def check_c(pages, fields, struct):
    """Members come in the order that capi/detail/fields.hpp relies on: 64 bits first, then 32."""
    header = "capi/mesh.h"
    body = re.search(rf"typedef struct {struct} \{{\n(.*?)\n\}}", pages[header], re.S)[1]
    members = re.findall(r"^ +(\w+[\w ]*\*?) (\w+); *///< ((?:.*\n)(?: +///<.*\n)*)", body + "\n", re.M)
    found = [(kind, name) for kind, name, _ in members]
    mine = [f for f in fields if f["name"] not in ("resolution", "dissolve")]
    wanted = [("size_t", "struct_size")]
    for wide in (True, False):
        for field in mine:
            if field["type"] == "other value":
                wanted += [("const double*", field["name"]), ("size_t", field["name"] + "_count")] if wide else []
            elif (field["type"] == "double") == wide:
                wanted.append((field["type"], field["name"]))
    if found[:len(wanted)] != wanted or len(found) > len(wanted) + 1:
        pages.flaws.append(f"{header}: the members of {struct} are not {wanted}")
    column = body.splitlines()[0].index("///<")
    for _, name, comment in members:
        text = " ".join(line.strip().removeprefix("///<").strip() for line in comment.strip().splitlines())
        for field in mine:
            if field["name"] != name or field["type"] == "other value":
                continue
            without = "" if re.fullmatch(NUMBER, field["default"]) else f"; 0: {field['default']}"
            sentence = plain(field)[0].lower() + plain(field)[1:] + without
            if text != sentence:
                line = re.search(rf"^.* {name}; *///< {re.escape(comment)}", pages[header], re.M)[0]
                code = line.split(";")[0] + ";"
                pages.change(header, line, trailing(code, column, sentence), f"{struct}.{name}")


def trailing(code, column, comment):
    """A member with its comment in lines of at most 100 columns, as clang-format aligns them."""
    lines = textwrap.wrap(comment, 100 - column - len("///< "))
    return "".join(f"{code if i == 0 else '':<{column}}///< {line}\n" for i, line in enumerate(lines))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="compare, and write nothing")
    options = parser.parse_args()
    pages = Pages()
    for fields, command, key, struct in STRUCTS:
        check_pages(pages, fields, f"terrane {command}", key)
        check_schema(pages, fields, key)
        if struct:
            check_c(pages, fields, struct)
    if not options.check:
        for name, text in pages.items():
            (ROOT / name).write_text(text)
    for flaw in pages.flaws:
        print(f"option_reference: {flaw}", file=sys.stderr)
    return 1 if pages.flaws and options.check else 0


if __name__ == "__main__":
    sys.exit(main())
