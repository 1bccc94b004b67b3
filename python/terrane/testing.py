# SPDX-License-Identifier: LGPL-3.0-or-later
"""Assertions for tests of programs that make meshes, and cases with exact answers.

It is a plugin of pytest, too: with ``pytest_plugins = ["terrane.testing"]`` in conftest.py, a test that takes
``certified_case`` runs once for each case of the folder that ``--certified-cases`` names.

Examples
--------
>>> import terrane
>>> from terrane.testing import assert_conforming, assert_judged
>>> corners, sides = [[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
>>> assert_conforming(corners, sides, closed=True)
>>> solid = terrane.Surface(corners, sides)
>>> assert_judged(solid, [solid, solid], operation="union")
"""

from __future__ import annotations

import json
import pathlib
from typing import Any, Dict, List, NamedTuple, Optional

from ._files import read
from ._judgement import JudgedProperty, judge
from ._surface import Surface

__all__ = ["Case", "assert_conforming", "assert_judged", "cases"]


class Case(NamedTuple):
    """A model with exact answers: its name, its surfaces, and the answers of docs/reference/case.md."""

    name: str
    surfaces: List[Surface]
    answers: Dict[str, Any]


def cases(folder: Any) -> List[Case]:
    """Return the cases of a folder, by name: each is a JSON file of the format "terrane-case 1".

    Raises FileNotFoundError if the folder has none.
    """
    found = []
    for path in sorted(pathlib.Path(folder).glob("*.json")):
        answers = json.loads(path.read_text(encoding="utf-8"))
        if answers.get("format") == "terrane-case 1":
            surfaces = [s for name in answers["inputs"] for s in read(str(path.parent / name))]
            found.append(Case(answers["name"], surfaces, answers))
    if not found:
        raise FileNotFoundError(f"{folder} has no cases")
    return found


def assert_conforming(vertices: Any, faces: Any, closed: bool = False) -> None:
    """Assert that triangles share a vertex, an edge or nothing, exactly, and none is there twice or without area.

    If ``closed``, they must also bound a solid: each edge has as many triangles one way as the other.
    """
    names = ("conforming", "distinct") + (("closed", "oriented") if closed else ())
    found = judge(Surface(vertices, faces, "mesh"))
    _require([p for p in found.properties if p.name in names])


def assert_judged(output: Any, inputs: Any, operation: Optional[str] = None, spacings: float = 16) -> None:
    """Assert that a mesh is the arrangement of its inputs, or a Boolean of them, as `terrane.judge` says.

    A property that is not judged, as parts are too near each other, is no failure.
    """
    _require(judge(output, inputs, operation=operation, spacings=spacings).properties)


def _require(properties: List[JudgedProperty]) -> None:
    """Raise an AssertionError that names the properties that fail, and the first place of each."""
    lines = []
    for p in properties:
        if p.verdict == "fails":
            lines.append(f"{p.name}: {p.sentence}")
            lines += [f"  {flaw.sentence} at {flaw.place}" for flaw in p.flaws[:1]]
    if lines:
        raise AssertionError("\n".join(lines))


def pytest_addoption(parser: Any) -> None:
    """Add the folder of cases to the options of pytest."""
    parser.addoption("--certified-cases", metavar="FOLDER", help="cases that tests with `certified_case` run for")


def pytest_generate_tests(metafunc: Any) -> None:
    """Run a test that takes `certified_case` once for each case."""
    if "certified_case" in metafunc.fixturenames:
        folder = metafunc.config.getoption("--certified-cases")
        found = cases(folder) if folder else []
        metafunc.parametrize("certified_case", found, ids=[case.name for case in found])
