# SPDX-License-Identifier: LGPL-3.0-or-later
"""The whole chain from a project."""

from __future__ import annotations

import json
import os
from typing import Any, Dict, List, Mapping, Optional, Tuple, Union

from . import _core
from ._arrays import Path
from ._errors import Error
from ._model import Model
from ._results import Part, Result
from ._run import how
from ._surface import Surface, surface_of_parts
from ._tetrahedra import Tetrahedra


class Built(Result):
    """The model of a project.

    Attributes
    ----------
    model : Model
    tetrahedra : Tetrahedra or None
        Where the project has ``outputs.tetrahedra``.
    surfaces : list of Surface
        After filling, ordering and sealing, with the boundary.
    folder : str
        Where the project wants its results; empty: not stated.

    Examples
    --------
    >>> built = ...
    >>> built
    <Built: 1 block, 6 surfaces, 12 triangles, 0 leaks>
    >>> built.model.blocks[1].volume
    1.0
    """

    __slots__ = ("_core", "_made_by", "model", "tetrahedra")

    def __init__(self, core: _core.Built, made_by: Tuple[Any, ...]) -> None:
        self._core = core
        self._made_by = made_by  # a function, and its arguments
        self.model = Model(core.model, ("build", *made_by))
        found = core.tetrahedra
        self.tetrahedra: Optional[Tetrahedra] = None if found is None else Tetrahedra(found)

    @property
    def surfaces(self) -> List[Surface]:
        """The surfaces after all changes, with the boundary."""
        return [surface_of_parts(p) for p in self._core.surfaces]

    folder = Part[str]("Where the project wants its results.")

    def save(self, folder: Optional[Path] = None, *, threads: Optional[int] = None) -> None:
        """Write the files that the project asks for, with the bytes that ``terrane build`` writes.

        The folder must not exist, or be empty; that of the project unless given. Statistics, logs and tables of
        fillings are the program's.

        Examples
        --------
        >>> import terrane
        >>> terrane.save(terrane.box((0, 0, 0), (1, 1, 1)), "box.ts")
        >>> project = {"format": "terrane-project 1", "surfaces": [{"file": "box.ts"}], "outputs": {"surfaces": ["obj"]}}
        >>> terrane.build(project).save("result")
        >>> len(terrane.read("result/surfaces.obj"))
        6
        """
        to = self.folder if folder is None else folder
        if not os.fspath(to):
            raise Error("bad_option", "the key folder is missing, and no folder is given", "folder")
        self._core.save(to, how(threads, None))

    def to_pyvista(self) -> Any:
        """Return a ``pyvista.MultiBlock`` of the blocks. Needs PyVista.

        Examples
        --------
        >>> built = ...
        >>> list(built.to_pyvista().keys())
        ['inside the boundary']
        """
        return self.model.to_pyvista()

    def to_meshio(self) -> Any:
        """Return a ``meshio.Mesh`` of the tetrahedra, or of the surfaces. Needs meshio.

        Examples
        --------
        >>> built = ...
        >>> built.to_meshio().cells_dict["triangle"].shape
        (12, 3)
        """
        return self.model.to_meshio() if self.tetrahedra is None else self.tetrahedra.to_meshio()

    def plot(self, **options: Any) -> Any:
        """Show the blocks. Needs PyVista.

        Examples
        --------
        >>> built = ...
        >>> shown = built.plot()
        """
        return self.model.plot(**options)

    def _state(self) -> Tuple[Any, ...]:
        return self._made_by

    @classmethod
    def _from_state(cls, *state: Any) -> "Built":
        made: Built = state[0](*state[1:])
        return made

    def _line(self) -> str:
        cells = "" if self.tetrahedra is None else f", {len(self.tetrahedra.tetrahedra)} tetrahedra"
        return self.model._line() + cells

    def _numbers(self) -> Dict[str, Any]:
        return self.model._numbers()

    def _shape(self) -> Tuple[Any, Any]:
        return self.model.mesh.vertices, self.model.mesh.triangles


def project_text(project: Union[Path, Mapping[str, Any]],
                 folder: Optional[Path]) -> Tuple[bytes, str, str]:
    """Return the text of a project, the folder of its files, and its name in messages."""
    if isinstance(project, Mapping):
        text = json.dumps(project)
        base, source = os.getcwd() if folder is None else os.fsdecode(folder), "project"
    else:
        source = os.fsdecode(project)
        try:
            with open(source, encoding="utf-8", errors="surrogateescape") as file:
                text = file.read()
        except OSError as error:
            raise Error("cannot_open", f"cannot be read: {error.strerror}", source) from None
        base = os.path.dirname(source)
        if folder is not None:
            raise TypeError("folder is for a project given as a dict")
    return text.encode("utf-8", "surrogateescape"), base, source


def build(project: Union[Path, Mapping[str, Any]], folder: Optional[Path] = None, *,
          threads: Optional[int] = None, progress: Any = None) -> Built:
    """Build the model of a project: a file, or a dict with the same keys.

    Parameters
    ----------
    project : path or dict
        docs/reference/project.md lists the keys. Files in a dict are relative to `folder`.
    folder : path, optional
        Of a dict: the folder of its files; the current one unless given.

    Returns
    -------
    Built

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[-1, -1, 0], [9, -1, 0], [-1, 9, 0]], [[0, 1, 2]], "top", "horizon")
    >>> flat.save("top.ts")
    >>> built = terrane.build({"format": "terrane-project 1", "surfaces": [{"file": "top.ts"}],
    ...                        "volume_of_interest": {"box": {"low": [0, 0, -1], "high": [2, 2, 1]}},
    ...                        "outputs": {"surfaces": ["vtp"]}})
    >>> built
    <Built: 2 blocks, 7 surfaces, 34 triangles, 0 leaks>
    """
    text, base, source = project_text(project, folder)
    core = _core.build(text, base, source, how(threads, progress))
    return Built(core, (build, project, folder))
