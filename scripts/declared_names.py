#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Finds names of types, aliases and constants that are declared where they get in each other's way.

    scripts/declared_names.py [ROOT]

(1) No name is declared twice in plain `terrane`.
(2) No name of plain `terrane` is declared in a namespace inside it as well: a file that uses both
    would be ambiguous. The verifier, which is a library of its own, is left out.
(3) Headers in detail/ declare into a namespace of their own, not into plain `terrane`.
(4) A constant is listed by the name of its member (core/constants.hpp), followed by its number in an array.
Names in unnamed namespaces and in classes do not count. Exit status 1 where a rule is broken. Reads
the layout of clang-format: what stands at a namespace's level starts its line.
"""
import re
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
OTHER_LIBRARIES = ("terrane::verifier",)
OPENING = re.compile(r"^(?:inline )?namespace ?([\w:]*) \{")
CLOSING = re.compile(r"^\} // namespace\b")
DECLARED = re.compile(
    r"^(?:template <.*>\s*)?(?:struct|class|enum class|enum|union) (\w+)(?!\w|::)(?: final)?\s*(?::[^;{]*)?\{"
    r"|^using (\w+) ="
    r"|^(?:inline )?constexpr (?:[\w:<>, ]+ )(\w+)\s*(?:=|\{)"
)


def declarations(path: Path):
    """Pairs of namespace and name, in the order of the file."""
    inside = []
    for line in path.read_text().splitlines():
        if opening := OPENING.match(line):
            inside.append(opening[1] or "(unnamed)")
        elif CLOSING.match(line):
            inside.pop()
        elif found := DECLARED.match(line):
            if "(unnamed)" not in inside:
                yield "::".join(inside), next(filter(None, found.groups()))


def misnamed(path: Path):
    """Members that are constants listed by another name."""
    for member, values in re.findall(r" (\w+) =\s+add(?:<[\w:]+>)?\((.*?)\);", path.read_text(), re.S):
        names = re.findall(r'"(\w+)"', values)
        if names not in ([member], [f"{member}_{i + 1}" for i in range(len(names))]):
            yield member


def problems(root: Path):
    """A sentence for each broken rule."""
    found = []
    for path in sorted((root / "algorithms").rglob("*.?pp")):
        found += [f"{path.relative_to(root)}: {name} is listed by another name" for name in misnamed(path)]
    places = defaultdict(list)
    for top in ("kernel", "algorithms", "io"):
        for path in sorted((root / top).rglob("*.?pp")):
            for space, name in declarations(path):
                places[name].append((space, str(path.relative_to(root))))
    for name, where in sorted(places.items()):
        plain = sorted({file for space, file in where if space == "terrane"})
        nested = sorted({(space, file) for space, file in where
                         if space.startswith("terrane::") and not space.startswith(OTHER_LIBRARIES)})
        if len(plain) > 1:
            found.append(f"{name} is declared twice in terrane: {', '.join(plain)}")
        if plain and nested:
            spaces = ", ".join(f"{space} ({file})" for space, file in nested)
            found.append(f"{name} is declared in terrane ({plain[0]}) and in {spaces}")
    for path in sorted((root / "algorithms").rglob("detail/*.hpp")) + sorted(
            (root / "io").rglob("detail/*.hpp")):
        names = [name for space, name in declarations(path) if space == "terrane"]
        if names:
            found.append(f"{path.relative_to(root)} declares into plain terrane: {', '.join(names)}")
    return found


def main():
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT
    found = problems(root)
    for sentence in found:
        print(f"declared_names: {sentence}", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
