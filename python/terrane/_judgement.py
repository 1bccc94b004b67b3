# SPDX-License-Identifier: LGPL-3.0-or-later
"""Judges any mesh by the surfaces that it was made from."""

from __future__ import annotations

from typing import Any, List, NamedTuple, Optional, Tuple

import numpy as np

from . import _core
from ._arrangement import _whole
from ._arrays import as_count, as_indices, as_number, as_points, as_word
from ._errors import bad_option
from ._mesh import Mesh
from ._run import how
from ._surface import as_surfaces, parts_of_surfaces
from ._tetrahedra import Tetrahedra

OPERATIONS = ("union", "intersection", "difference", "symmetric-difference")


class PropertyFlaw(NamedTuple):
    """A place where a property fails: a sentence, the place, triangles, and an area, distance or angle, or 0.

    Triangles are those of the judged mesh, counted through all of its surfaces; of tetrahedra they are these.

    Examples
    --------
    >>> flat, wall = ...
    >>> found = terrane.judge([flat, wall])
    >>> found["conforming"].flaws[0].sentence
    'two triangles meet improperly: crossing'
    """

    sentence: str
    place: Tuple[float, float, float]
    triangles: Tuple[int, ...]
    size: float


class JudgedProperty(NamedTuple):
    """A property: its name, "holds", "fails" or "not judged", what was found, and the first of its flaws.

    Examples
    --------
    >>> flat, wall = ...
    >>> terrane.judge(terrane.mesh([flat, wall]), [flat, wall])["curves"].verdict
    'fails'
    """

    name: str
    verdict: str
    sentence: str
    flaw_count: int
    size: float
    flaws: List[PropertyFlaw]


class MeshJudgement(NamedTuple):
    """The properties of a mesh. It is true if all hold; ``judgement["coverage"]`` is one of them.

    Examples
    --------
    >>> flat, wall = ...
    >>> terrane.judge(terrane.round(terrane.arrange([flat, wall])), [flat, wall])
    <MeshJudgement: all 8 properties hold>
    """

    properties: List[JudgedProperty]

    def __bool__(self) -> bool:
        return all(p.verdict == "holds" for p in self.properties)

    def __getitem__(self, name: Any) -> Any:
        if not isinstance(name, str):
            return tuple.__getitem__(self, name)
        for p in self.properties:
            if p.name == name:
                return p
        raise KeyError(f"{name} is none of {', '.join(p.name for p in self.properties)}")

    def __repr__(self) -> str:
        failing = [p.name for p in self.properties if p.verdict == "fails"]
        if failing:
            return f"<MeshJudgement: {', '.join(failing)} {'fail' if len(failing) > 1 else 'fails'}>"
        unknown = [p.name for p in self.properties if p.verdict == "not judged"]
        if unknown:
            return f"<MeshJudgement: {', '.join(unknown)} not judged>"
        return f"<MeshJudgement: all {len(self.properties)} properties hold>"


def judge(output: Any, inputs: Any = None, *, operation: Optional[str] = None, spacings: float = 16,
          most_flaws: int = 10, threads: Optional[int] = None, progress: Any = None) -> MeshJudgement:
    """Judge a mesh, whatever program made it, by its inputs: exactly, but for the rounding of points.

    Parameters
    ----------
    output : Mesh, surface, list of surfaces, Tetrahedra or tuple of arrays
        The mesh that is judged. Of tetrahedra of any program it is ``(vertices, tetrahedra)`` or ``(vertices, tetrahedra,
        labels)``: arrays of the shapes (n, 3), (m, 4) and (m,), with a label for each block.
    inputs : list of surfaces, optional
        The surfaces that it was made from. The mesh is compared with their exact arrangement, or with its blocks. Without
        inputs the triangles are judged alone.
    operation : str, optional
        "union", "intersection", "difference" or "symmetric-difference": what the mesh is of the inputs, each a solid.
    spacings : float, optional
        How far points may be rounded, in spacings of doubles at the largest coordinate of the inputs.
    most_flaws : int, optional
        The number of flaws that are listed for each property.

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]], "top")
    >>> wall = terrane.Surface([[1, 1, -1], [1, 1, 1], [1, 9, 0]], [[0, 1, 2]], "F1", "fault")
    >>> bool(terrane.judge(terrane.round(terrane.arrange([flat, wall])), [flat, wall]))
    True
    >>> terrane.judge([flat, wall])
    <MeshJudgement: conforming, closed, tetgen fail>
    """
    if isinstance(output, Tetrahedra):
        output = output.vertices, output.tetrahedra, output.block_of
    if isinstance(output, tuple) and len(output) in (2, 3) and np.shape(output[1])[1:] == (4,):
        if inputs is None or operation is not None:
            raise TypeError("tetrahedra are judged by inputs, without operation")
        return _judgement(_core.judge_tetrahedra(
            as_points(output[0], "vertices"), as_indices(np.ravel(output[1]), "tetrahedra").reshape(-1, 4),
            as_indices(output[2] if len(output) == 3 else [], "labels"), parts_of_surfaces(as_surfaces(inputs)),
            as_number(spacings, "spacings", least=0), as_count(most_flaws, "most_flaws"), how(threads, progress)))
    made = output if isinstance(output, Mesh) else getattr(output, "mesh", output)
    parts = _whole(made) if isinstance(made, Mesh) else as_surfaces(made)
    if operation is not None:
        if inputs is None:
            raise TypeError("operation is for a mesh with inputs")
        if as_word(operation, "operation") not in OPERATIONS:
            raise bad_option(f"is one of {', '.join(OPERATIONS)}, not {operation}", "operation")
    return _judgement(_core.judge(parts_of_surfaces(parts), None if inputs is None else parts_of_surfaces(as_surfaces(inputs)),
                                  operation, as_number(spacings, "spacings", least=0), as_count(most_flaws, "most_flaws"),
                                  how(threads, progress)))


def _judgement(found: List[Tuple[Any, ...]]) -> MeshJudgement:
    return MeshJudgement([JudgedProperty(name, verdict, sentence, count, size, [PropertyFlaw(*f) for f in flaws])
                          for name, verdict, sentence, count, size, flaws in found])
