#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Prints the include graph of the source tree, folder by folder, and judges it.

    scripts/include_graph.py [--dot] [--files]

A folder may include itself and the folders above it in ORDER. Headers in detail/ belong to their
own folder alone. Prints, for each folder, the folders that it includes; --dot prints Graphviz
instead, --files names the files behind each arrow. Exit status 1 if an arrow points back, if
detail/ is used from outside, if a file stands in no known folder, or if the graph has a cycle.
"""
import argparse
import re
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# Bottom-up: what stands lower in the tree includes what stands above it in this list.
ORDER = (
    "kernel algorithms/core algorithms/mesh algorithms/plausibility algorithms/search algorithms/intersection "
    "algorithms/triangulation algorithms/arrangement algorithms/check algorithms/regions "
    "algorithms/rounding algorithms/volumes algorithms/structure algorithms/tiles algorithms/layers "
    "algorithms/quality algorithms/simplification algorithms/reconstruction/holes algorithms/reconstruction/joining "
    "algorithms/reconstruction/kriging algorithms/reconstruction/rbf algorithms/reconstruction "
    "algorithms/sealing algorithms/volume_of_interest algorithms/model algorithms/tetrahedra "
    "algorithms/optimisation algorithms/tetgen algorithms/project algorithms/uncertainty algorithms/verify "
    "io/text io/atomic io/surfaces io/gocad io/grids io/points io/meshes io io/page capi "
    "cli/session cli/options cli/paper cli/reports cli/stages cli/commands cli/mpi cli"
).split()

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]terrane/([^>"]+)[>"]', re.M)


def sources(root: Path):
    """Paths of all files of the library and the program, relative to the root."""
    return [
        path.relative_to(root)
        for top in ("kernel", "algorithms", "io", "capi", "cli")
        for path in sorted((root / top).rglob("*"))
        if path.suffix in (".hpp", ".cpp", ".h")
    ]


def public_headers(root: Path):
    """The headers that are installed; terrane.hpp, which includes the others, is none of sources()."""
    listed = root / "scripts/cmake/public_headers.cmake"
    lines = listed.read_text() if listed.exists() else ""
    return [h for h in re.findall(r"^ +([a-z0-9_/]+\.hpp)", lines, re.M) if h != "terrane.hpp"]


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
