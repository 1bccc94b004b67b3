#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Prints the include graph of the source tree, folder by folder, and judges it.

    scripts/include_graph.py [--dot] [--files]

A folder may include itself and the folders above it in the table of docs/explanation/architecture.md. Headers in
detail/ belong to their own folder alone. A module of the Python package may import those before it in the list of that
page, and only at its top. Prints, for each folder, the folders that it includes; --dot prints Graphviz
instead, --files names the files behind each arrow. Exit status 1 if an arrow points back, if
detail/ is used from outside, if a file stands in no known folder, or if the graph has a cycle.
"""
import argparse
import ast
import re
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# The order is written once, in the table and the list of modules of this page; CMakeLists.txt reads the table, too.
PAGE = (ROOT / "docs/explanation/architecture.md").read_text()
ORDER = re.findall(r"^\| `([a-z_/]+)` \|", PAGE, re.M)
MODULES = re.findall(r"`(\w+)`", re.search(r"imports only modules before it in this list:(.*?)\n\n", PAGE, re.S).group(1))

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]terrane/([^>"]+)[>"]', re.M)


def sources(root: Path):
    """Paths of all files of the library and the program, relative to the root."""
    return [
        path.relative_to(root)
        for top in ("fuzzing", "kernel", "algorithms", "io", "capi", "cli")
        for path in sorted((root / top).rglob("*"))
        if path.suffix in (".hpp", ".cpp", ".h")
    ]


def public_headers(root: Path):
    """The headers that are installed, but terrane.hpp and advanced.hpp, which include them."""
    tiers = [root / name for name in ("terrane.hpp", "advanced.hpp")]
    return [h for tier in tiers if tier.exists() for h in INCLUDE.findall(tier.read_text()) if h != "terrane.hpp"]


def folder_of(path: Path) -> str:
    """The folder that a file counts to: detail/ and helper/ are parts of the folder around them."""
    parent = path.parent
    return str(parent.parent if parent.name in ("detail", "helper") else parent)


def judge(root: Path, order=ORDER):
    """Arrows between folders with the files behind them, and what is wrong with them."""
    rank = {folder: i for i, folder in enumerate(order)}
    arrows, problems = defaultdict(set), []
    for path in sources(root):
        folder = folder_of(path)
        if folder not in rank:
            problems.append(f"{path}: stands in no known folder ({folder})")
            continue
        for target in INCLUDE.findall((root / path).read_text()):
            included = Path(target)
            if not (root / included).exists():
                problems.append(f"{path}: includes {target}, which does not exist")
                continue
            other = folder_of(included)
            if included.parent.name == "detail" and other != folder:
                problems.append(f"{path}: includes {target}, private to {other}")
            if other == folder:
                continue
            arrows[folder, other].add((str(path), target))
            if rank.get(other, len(order)) > rank[folder]:
                problems.append(f"{path}: includes {target}: the arrow {folder} -> {other} points back")
    return arrows, problems


def arrows_within(root: Path, folder: str):
    """Arrows between the units of a folder: a header and the source of the same name are one unit."""
    files = [path for path in sources(root) if folder_of(path) == folder]
    units = {path.with_suffix("") for path in files}
    return {(str(path.with_suffix("")), str(other)) for path in files
            for other in (Path(target).with_suffix("") for target in INCLUDE.findall((root / path).read_text()))
            if other in units and other != path.with_suffix("")}


def judge_modules(package: Path, order=MODULES):
    """Return what is wrong with the imports of one module of a Python package by another."""
    files = {path.stem: path for path in sorted(package.glob("*.py"))}
    problems = [f"{name}: is no module of {package.name}, but listed" for name in order if name not in files]
    for name, path in files.items():
        if name not in order:
            problems.append(f"{path.name}: is not in the list of modules")
            continue
        above = order[:order.index(name)]
        tree = ast.parse(path.read_text())
        for node in ast.walk(tree):
            if not isinstance(node, ast.ImportFrom) or node.level == 0:
                continue
            for other in [node.module] if node.module else [alias.name for alias in node.names]:
                if other in files and other not in above:
                    problems.append(f"{path.name}:{node.lineno}: imports {other}, which is not before it")
            if node not in tree.body:
                problems.append(f"{path.name}:{node.lineno}: imports a module of ours below its top")
    return problems


def cycle_in(arrows):
    """Folders of one cycle, in order, or an empty list: found without the order above."""
    after = defaultdict(set)
    for source, target in arrows:
        after[source].add(target)
    done, stack = set(), []

    def visit(folder):
        if folder in stack:
            return stack[stack.index(folder):] + [folder]
        if folder in done:
            return []
        stack.append(folder)
        for other in sorted(after[folder]):
            if found := visit(other):
                return found
        done.add(stack.pop())
        return []

    for folder in sorted(after):
        if found := visit(folder):
            return found
    return []


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--dot", action="store_true", help="print Graphviz instead of text")
    parser.add_argument("--files", action="store_true", help="name the files behind each arrow")
    parser.add_argument("--root", type=Path, default=ROOT, help="the tree to look at")
    options = parser.parse_args()
    arrows, problems = judge(options.root)
    problems += judge_modules(options.root / "python/terrane")
    if cycle := cycle_in(arrows):
        problems.append("cycle: " + " -> ".join(cycle))

    if options.dot:
        print("digraph terrane {\n  rankdir=BT;")
        for source, target in sorted(arrows):
            print(f'  "{source}" -> "{target}";')
        print("}")
    else:
        for folder in ORDER:
            targets = [t for t in ORDER if (folder, t) in arrows]
            print(f"{folder}: {', '.join(targets) if targets else 'nothing of ours'}")
            if options.files:
                for target in targets:
                    for path, header in sorted(arrows[folder, target]):
                        print(f"    {path} -> {header}")
        files = sources(options.root)
        headers = [f for f in files if f.suffix == ".hpp"]
        private = sum(f.parent.name == "detail" for f in headers)
        public = len(public_headers(options.root))
        print(f"{len(files)} files, {len(headers)} headers ({public} public, {private} in detail/), "
              f"{len(arrows)} arrows between {len(ORDER)} folders, "
              f"{'acyclic' if not cycle else 'with a cycle'}")
    for problem in problems:
        print(f"include_graph: {problem}", file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
