# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tetrahedra in the blocks of a model."""

from __future__ import annotations

import os
from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from . import _core
from ._arrays import (Float64Array, IndexLists, Path, SurfaceInfo, UInt32Array, as_count, as_flag, as_format, as_list,
                      as_mapping, as_number, as_point, as_text, as_word)
from ._errors import Error, bad_option
from ._interop import meshio_mesh, unstructured_grid
from ._parts import Parts, number_of
from ._results import Part, Result, counted
from ._run import describing, how


class Violation(NamedTuple):
    """A flaw that the check of tetrahedra found.

    Examples
    --------
    >>> cells = ...
    >>> cells.violations
    []
    """

    defect: str
    occurrences: int
    first: str


class BlockVolume(NamedTuple):
    """The volume of a block and of its tetrahedra, cubic unit; `equal`: exactly.

    Examples
    --------
    >>> cells = ...
    >>> volume = cells.volumes[1]
    >>> volume.block, volume.equal
    (16.0, True)
    """

    block: float
    tetrahedra: float
    difference: float
    bound: float
    equal: bool


class Tetrahedra(Result):
    """A tetrahedral mesh that conforms to the triangles of a model, checked exactly.

    Examples
    --------
    >>> cells = ...
    >>> int(cells.block_of.max()), len(cells.tetrahedra) > 0
    (2, True)
    """

    __slots__ = ("_core", "_model")

    def __init__(self, core: _core.Tetrahedra, model: Optional[Parts] = None) -> None:
        self._core = core
        self._model = model  # that they fill, for reports; a pickle has none

    surfaces = Part[List[SurfaceInfo]]("Names and roles of the surfaces.", SurfaceInfo.all_of)
    vertices = Part[Float64Array]("Unit of the input: ndarray, shape (n, 3), float64.")
    tetrahedra = Part[UInt32Array]("Indices into `vertices`, positively oriented: ndarray, shape (m, 4), uint32.")
    block_of = Part[UInt32Array]("Per tetrahedron the number of its block; 0 is the outside: ndarray, shape (m,), uint32.")
    faces = Part[UInt32Array]("Faces of tetrahedra that lie on a surface: ndarray, shape (k, 3), uint32.")
    face_triangle = Part[UInt32Array](
        "Per face the triangle of the model's mesh that it is part of, or 2**32 - 1 on the box around all: uint32.")
    surfaces_of = Part[IndexLists]("Per face its surfaces.", IndexLists._of)
    twins = Part[UInt32Array]("Pairs of faces in front of and behind a split surface: ndarray, shape (c, 2), uint32.")
    block_names = Part[List[str]]("Names of the blocks by number.")
    mesher = Part[str]("The program that made the tetrahedra.")
    is_checked = Part[bool]("Whether they are checked exactly; a check is not pickled.")

    def _need_check(self, place: str) -> None:
        if not self.is_checked:
            raise Error("unsupported", "tetrahedra from a pickle are not checked", place)

    @property
    def violations(self) -> List[Violation]:
        """The flaws that the exact check found; empty: the tetrahedra are sound.

        Raises
        ------
        terrane.Error
            ``unsupported`` if they are not `is_checked`.
        """
        self._need_check("violations")
        return [Violation(*v) for v in self._core.violations]

    @property
    def volumes(self) -> List[BlockVolume]:
        """Volumes of blocks and of their tetrahedra, by number; raises as `violations`."""
        self._need_check("volumes")
        return [BlockVolume(*v) for v in self._core.block_volumes]

    @property
    def optimised(self) -> Optional[Dict[str, Any]]:
        """The changes of `tetrahedralize` that made the mesher's shapes better; None: it made none.

        Its ``before`` and ``after`` have the least ``quality`` (sine of a dihedral angle, 0.7 times that of an obtuse one),
        ``least_angle`` and ``largest_angle`` (degrees). The other keys count what was done, and what is ``left`` worse
        than wanted. ``effort`` is the number of possible tetrahedra that were measured, and ``cut_short`` tells whether a
        limit of that ended the work.
        """
        report: Optional[Dict[str, Any]] = self._core.optimised
        return report

    def shape(self) -> Dict[str, Tuple[float, float, float]]:
        """Return least, mean and largest of: dihedral angles (degrees), radius-edge ratio, SICN, mean ratio.

        Examples
        --------
        >>> cells = ...
        >>> sorted(cells.shape())
        ['dihedral', 'mean_ratio', 'radius_edge', 'sicn']
        """
        return self._core.shape()

    def of_block(self, block: Any) -> UInt32Array:
        """Return the tetrahedra of a block, given by number or name.

        Examples
        --------
        >>> cells = ...
        >>> len(cells.of_block(1)) > 0
        True
        """
        names = self.block_names
        if isinstance(block, str) and block not in names:
            raise Error("bad_option", f"{block!r} is no block: {', '.join(map(repr, names))}", "block")
        number = names.index(block) if isinstance(block, str) else as_count(block, "block")
        return np.asarray(self.tetrahedra[self.block_of == number])

    def save(self, path: Path, format: Optional[str] = None, *, compress: bool = True, order: int = 1) -> List[str]:
        """Write the tetrahedra, as ``terrane tetrahedralize`` does, and return the files that were written.

        The extension tells the format: .vtu, .msh, .inp, .mesh, .exo (Exodus II) or .ugi (PFLOTRAN). `format` names others:
        "msh22", and "ogs" (OpenGeoSys), "geos" or "pylith". With `order` 2 tetrahedra have a node in the middle of each edge.

        Examples
        --------
        >>> cells = ...
        >>> cells.save("cells.vtu")
        ['cells.vtu']
        """
        return list(_core.write_tetrahedra(self._core, path, as_format(format), as_flag(compress, "compress"),
                                           as_count(order, "order", 1, 2), how(1, None)))

    def report(self, path: Path, *, threads: Optional[int] = None) -> None:
        """Write the page of the model with its tetrahedra: one HTML file, as `Model.report`.

        Raises
        ------
        terrane.Error
            As `Model.report`; ``unsupported`` also of tetrahedra from a pickle or a project, which do not hold their model.

        Examples
        --------
        >>> import os, terrane
        >>> cells = terrane.tetrahedralize(terrane.model(terrane.box((0, 0, 0), (1, 1, 1))))
        >>> if terrane.HAS_REPORTS:
        ...     cells.report("cells.html")
        >>> os.path.exists("cells.html") == terrane.HAS_REPORTS
        True
        """
        if self._model is None:
            raise Error("unsupported", "these tetrahedra do not hold their model, so they have no report", os.fsdecode(path))
        self._model._report(path, "Tetrahedra.report", self._core, threads)

    def to_pyvista(self) -> Any:
        """Return a ``pyvista.UnstructuredGrid`` with the array ``block``. Needs PyVista.

        Examples
        --------
        >>> import terrane
        >>> cells = terrane.tetrahedralize(terrane.model(terrane.box((0, 0, 0), (1, 1, 1))))
        >>> len(cells.to_pyvista().points) == len(cells.vertices)
        True
        """
        return unstructured_grid(self.vertices, self.tetrahedra, {"block": self.block_of})

    def to_meshio(self) -> Any:
        """Return a ``meshio.Mesh`` of tetrahedra and faces. Needs meshio.

        Examples
        --------
        >>> import terrane
        >>> cells = terrane.tetrahedralize(terrane.model(terrane.box((0, 0, 0), (1, 1, 1))))
        >>> len(cells.to_meshio().cells_dict["tetra"]) == len(cells.tetrahedra)
        True
        """
        kinds = {"tetra": self.tetrahedra, "triangle": self.faces}
        none = np.full(len(self.faces), -1, dtype=np.int32)
        return meshio_mesh(self.vertices, kinds, {
            "block": [self.block_of.astype(np.int32), none],
            "surface": [np.full(len(self.tetrahedra), -1, dtype=np.int32),
                        self.surfaces_of.first.astype(np.int32)]})

    def plot(self, **options: Any) -> Any:
        """Show the tetrahedra in a window or notebook. Needs PyVista.

        Examples
        --------
        >>> import terrane
        >>> cells = terrane.tetrahedralize(terrane.model(terrane.box((0, 0, 0), (1, 1, 1))))
        >>> shown = cells.plot()
        """
        return self.to_pyvista().plot(**{"scalars": "block", "show_edges": True, **options})

    def _state(self) -> Tuple[Any, ...]:
        c = self._core
        return (list(c.surfaces), c.vertices, c.tetrahedra, c.block_of, c.faces, c.face_triangle,
                tuple(c.surfaces_of), c.twins, c.block_count, c.mesher, list(c.block_names), c.added_nodes)

    @classmethod
    def _from_state(cls, *state: Any) -> "Tetrahedra":
        return cls(_core.Tetrahedra(tuple(state)))

    def _line(self) -> str:
        return (f"{counted(len(self.tetrahedra), 'tetrahedron')} in {counted(len(set(self.block_of.tolist())), 'block')}, "
                f"{counted(len(self.vertices), 'vertex')}, {counted(len(self.faces), 'face')}")

    def _numbers(self) -> Dict[str, Any]:
        return {"tetrahedra": len(self.tetrahedra), "vertices": len(self.vertices),
                "faces": len(self.faces), "mesher": self.mesher}

    def _shape(self) -> Tuple[Any, Any]:
        return self.vertices, self.faces


@describing(_core.tetrahedra_fields)
def tetrahedralize(model: Parts, *, edge_length: Optional[float] = None,
                   size_of: Optional[Mapping[str, float]] = None,
                   size_in: Optional[Mapping[Any, float]] = None, quality: Optional[float] = None,
                   max_volume: Optional[float] = None, split: Sequence[str] = (),
                   split_surfaces: bool = False, optimise: bool = True, outside: bool = False, around: Any = None,
                   margin: float = 0.1, mesher: str = "auto", time_limit: float = 600,
                   helper: Path = "", gmsh_helper: Path = "", threads: Optional[int] = None,
                   progress: Any = None) -> Tetrahedra:
    """Fill the blocks of a model with tetrahedra and check them exactly.

    Parameters
    ----------
    model : Model
    OPTIONS
    size_of : dict, optional
        Edge lengths on surfaces, by name.
    size_in : dict, optional
        Edge lengths in blocks, by name or number.
    split : list of str, optional
        Surfaces whose sides get nodes of their own; "fault": all with that role.
    optimise : bool, optional
        Improve the shapes that the mesher made; `optimised` of the result says what that did.
    outside : bool, optional
        Fill the space between the model and a box around it as well, as block 0.
    around : pair of points, optional
        Corners of that box.
    mesher : {"auto", "tetgen", "gmsh"}, optional
    helper, gmsh_helper : path, optional
        The helper programs, where they are not found.

    Returns
    -------
    Tetrahedra

    Raises
    ------
    terrane.Error
        ``internal`` where the exact check finds violations, which are in its sentence.

    Examples
    --------
    >>> import terrane
    >>> model = terrane.model(terrane.box((0, 0, 0), (1, 1, 1)))
    >>> cells = terrane.tetrahedralize(model)
    >>> cells.volumes[1].equal, cells.violations
    (True, [])
    """
    if not isinstance(model, Parts):
        raise TypeError(f"tetrahedra are made of a Model, not of a {type(model).__name__}: terrane.model()")
    def number(value: Optional[float], name: str) -> Optional[float]:
        return None if value is None else as_number(value, name, positive=True)
    sizes_in = {}
    for block, length in as_mapping(size_in, "size_in").items():
        of = "0" if block in (0, "0", "outside") else str(number_of(model, block))
        sizes_in[of] = as_number(length, f"size_in[{block!r}]", positive=True)
    corners = None if around is None else [as_point(p, "around") for p in as_list(around, "around")]
    if corners is not None and len(corners) != 2:
        raise bad_option("is not two corners", "around")
    options = {
        "mesher": as_word(mesher, "mesher"), "box": corners, "margin": as_number(margin, "margin"),
        "edge_length": number(edge_length, "edge_length"), "quality": number(quality, "quality"),
        "split_surfaces": as_flag(split_surfaces, "split_surfaces"), "max_volume": number(max_volume, "max_volume"),
        "time_limit": as_number(time_limit, "time_limit", positive=True),
        "helper": helper, "gmsh_helper": gmsh_helper,
        "size_of": {as_text(k, "size_of"): as_number(v, f"size_of[{k!r}]", positive=True)
                    for k, v in as_mapping(size_of, "size_of").items()},
        "size_in": sizes_in, "split": [split] if isinstance(split, str) else as_list(split, "split"),
        "outside": as_flag(outside, "outside"), "optimise": as_flag(optimise, "optimise")}
    made = Tetrahedra(_core.fill_blocks(model._core, options, how(threads, progress)), model)
    if made.violations:
        raise Error("internal", "; ".join(v.first for v in made.violations), "tetrahedra")
    return made
