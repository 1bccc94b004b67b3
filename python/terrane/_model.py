# SPDX-License-Identifier: LGPL-3.0-or-later
"""The everyday call: surfaces to blocks with names, volumes, neighbours and leaks."""

from __future__ import annotations

import warnings
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrangement import as_move
from ._arrays import Path, as_count, as_flag, as_list, as_number, as_pair, as_text, as_word
from ._cells import BlocksInCells, cells_wanted, grid_of
from ._errors import Doubt, bad_option, doubts_of
from ._interop import meshio_mesh, package
from ._maps import Map, nodes_of
from ._mesh import Mesh
from ._parts import Block, Parts
from ._picture import apart, card, unlike_neighbours
from ._quality import improve_options
from ._relations import Juxtaposition, Leak, Relation
from ._results import counted
from ._rounding import RoundingReport, rounding_report
from ._run import how
from ._selection import Selected
from ._surface import as_surfaces, parts_of_surfaces
from ._tetrahedra import Tetrahedra, tetrahedralize
from ._volume_of_interest import as_boundary


class Model(Parts):
    """A conforming mesh with its blocks.

    Examples
    --------
    >>> m = ...
    >>> m
    <Model: 2 blocks, 7 surfaces, 34 triangles, 0 leaks>
    >>> [b.volume for b in m.blocks.values()]
    [16.0, 32.0]
    """

    __slots__ = ()

    @property
    def leaks(self) -> List[Leak]:
        """Where surfaces end without meeting another one: those that separate blocks first."""
        separating, others, verdicts, _ = self._core.leaks
        made = [self._leak(leak, "separates") for leak in separating]
        for i, leak in enumerate(others):
            verdict = verdicts[i] if verdicts else ""
            if verdict != "separates" or not separating:
                made.append(self._leak(leak, verdict))
        return made

    @property
    def doubts(self) -> List[Doubt]:
        """Likely mistakes in the surfaces, of which `model` warned."""
        return doubts_of(self._core.doubts, self.labels)

    @property
    def relations(self) -> List[Relation]:
        """Which surface stops at which other one, crosses it, or ends near it."""
        return [Relation(self.labels[r[0]], self.labels[r[1]], *r[2:]) for r in self._core.relations]

    @property
    def juxtapositions(self) -> List[Juxtaposition]:
        """Which blocks face each other across which surface, and the area."""
        blocks = self.structure.blocks
        return [Juxtaposition(self.labels[s], (blocks[pair[0]].name, blocks[pair[1]].name), area)
                for s, pair, area in self._core.juxtapositions]

    @property
    def rounding(self) -> Optional[RoundingReport]:
        """How the exact result became doubles."""
        values = self._core.rounding
        return None if values is None else rounding_report(values)

    @property
    def sealed(self) -> Optional[Dict[str, Any]]:
        """The changes by sealing, as in `Sealed`; None where nothing was sealed."""
        report: Optional[Dict[str, Any]] = self._core.sealed
        return report

    def _leak(self, leak: Tuple[Any, ...], verdict: str) -> Leak:
        return Leak(self.labels[leak[0]], self.labels[leak[1]], leak[3], leak[4], leak[5], leak[6], verdict)

    def block_of(self, points: Any, *, threads: Optional[int] = None,
                 progress: Any = None) -> npt.NDArray[np.uint32]:
        """Return the number of the block that each point lies in, exactly; 0 is the outside.

        Parameters
        ----------
        points : array_like, shape (n, 3)
            Unit of the input. Points on a surface count to the side of greater x, then y, then z.

        Examples
        --------
        >>> import terrane
        >>> flat = terrane.Surface([[-1, -1, 0], [9, -1, 0], [-1, 9, 0]], [[0, 1, 2]], "top", "horizon")
        >>> model = terrane.model([flat], box=((0, 0, -1), (2, 2, 1)))
        >>> numbers = model.block_of([[1, 1, -0.5], [1, 1, 0.5], [1, 1, 7]])
        >>> [model.structure.blocks[n].name for n in numbers]
        ['below top', 'above top', 'outside']
        """
        return self.volumes.locate(points, threads=threads, progress=progress)

    def names_of(self, points: Any, *, threads: Optional[int] = None) -> List[str]:
        """Return the name of the block that each point lies in, as `block_of`.

        Examples
        --------
        >>> m = ...
        >>> m.names_of([[1, 1, -0.5], [1, 1, 1], [9, 9, 9]])
        ['below flat', 'above flat', 'outside']
        """
        blocks = self.structure.blocks
        return [blocks[n].name for n in self.block_of(points, threads=threads)]

    def improved(self, edge_length: float = 0, *, threads: Optional[int] = None, progress: Any = None,
                 **options: Any) -> "Model":
        """Return the same model with better triangles; see `terrane.improve` for the options.

        Blocks keep their numbers and names. Volumes are those of the improved mesh. With a resolution, the blocks are those
        of the surfaces that were joined at it, as `build` has them.

        Examples
        --------
        >>> import terrane
        >>> model = terrane.model(terrane.box((0, 0, 0), (1, 1, 1)))
        >>> len(model.improved(0.25).mesh.triangles) > 100
        True
        """
        values = improve_options(self.mesh, edge_length, options)
        core = _core.improve_model(self._core, values, how(threads, progress))
        return Model(core, ("improved", self._made_by, values))

    @property
    def is_improved(self) -> bool:
        """Whether `improved` made this model."""
        return bool(self._made_by[0] == "improved")

    def tetrahedra(self, edge_length: Optional[float] = None, *, improve: Optional[bool] = None,
                   **options: Any) -> Tetrahedra:
        """Fill the blocks with tetrahedra; see `terrane.tetrahedralize` for the other options.

        Parameters
        ----------
        edge_length : float, optional
            Wanted length, unit of the input; as few tetrahedra as possible unless given.
        improve : bool, optional
            Whether the triangles are improved to that length first, as thin ones spoil tetrahedra; by default where
            `edge_length` is given and the model is not improved yet.

        Examples
        --------
        >>> import terrane
        >>> cells = terrane.model(terrane.box((0, 0, 0), (1, 1, 1))).tetrahedra(edge_length=0.5)
        >>> cells.violations, round(cells.volumes[1].tetrahedra, 12)
        ([], 1.0)
        """
        wanted = edge_length is not None and not self.is_improved if improve is None else as_flag(improve, "improve")
        run = {name: options[name] for name in ("threads", "progress") if name in options}
        base = self.improved(edge_length or 0, **run) if wanted else self
        return tetrahedralize(base, edge_length=edge_length, **options)

    def save(self, folder: Path, format: str = "auto", *, threads: Optional[int] = None) -> None:
        """Write the model into a new folder, as ``terrane volume -o`` does.

        `format` is that of blocks and interfaces; ``"auto"`` is VTP, with one file for all blocks and one for all
        interfaces if they are more than 1000. The folder must not exist, or be empty.

        Examples
        --------
        >>> m = ...
        >>> m.save("folder")
        >>> len(terrane.read("folder/result.vtp"))
        7
        """
        self._core.save(folder, as_word(format, "format"), how(threads, None))

    def report(self, path: Path, *, threads: Optional[int] = None) -> None:
        """Write the page of ``terrane report``: one HTML file that shows the model, what is wrong with it, and its numbers.

        Every browser opens it, from disk. The page has the bytes of the program's as far as both know the same: it lacks
        input files, times and statistics.

        Parameters
        ----------
        path : path
            The file, which is replaced if it is there. Lengths, areas and volumes in it are in the unit of the input.

        Raises
        ------
        terrane.Error
            ``unsupported`` in a build without report pages, which says why; ``cannot_open`` and ``write_failed`` for
            the file.

        Examples
        --------
        >>> import os, terrane
        >>> model = terrane.model(terrane.box((0, 0, 0), (1, 1, 1)))
        >>> if terrane.HAS_REPORTS:
        ...     model.report("model.html")
        >>> os.path.exists("model.html") == terrane.HAS_REPORTS
        True
        """
        self._report(path, "Model.report", None, threads)

    def to_pyvista(self) -> Any:
        """Return a ``pyvista.MultiBlock`` of the blocks by name. Needs PyVista.

        Examples
        --------
        >>> m = ...
        >>> list(m.to_pyvista().keys())
        ['below flat', 'above flat']
        """
        blocks = package("pyvista", "to_pyvista()").MultiBlock()
        for name, block in self.blocks.items():
            blocks[name] = block.mesh.to_pyvista()
        return blocks

    def where(self, expression: str, *, others: Any = (), rule: str = "nonzero", fractions: bool = False,
              max_move: Optional[float] = None, threads: Optional[int] = None, progress: Any = None) -> Selected:
        """Select a region of the model by an expression over its blocks and surfaces.

        Parameters
        ----------
        expression : str
            As in `select`, with ``block(name)``, ``unit(name)``, ``volume < 1e6``, ``volume > 1e6``, ``age < 66`` and
            ``age > 66`` as operands besides the surfaces of the model. Blocks may be named by their numbers, too.
        others : as in `arrange`, optional
            Surfaces that the expression names besides.
        rule, fractions, max_move : optional
            As in `select`.

        Raises
        ------
        terrane.Error
            ``bad_option`` for a name of no block, unit or surface, with those that there are; those of `select`.

        Notes
        -----
        The region is closed, and has the surfaces of the model. `parents_of` of its mesh are triangles of the model's mesh,
        then of `others`.

        Examples
        --------
        >>> m = ...
        >>> m.where('block("above flat")').volume
        32.0
        """
        mesh, piece_of, report = _core.select_of_model(
            self._core, as_text(expression, "expression"), parts_of_surfaces(as_surfaces(others, "others")),
            as_word(rule, "rule"), as_flag(fractions, "fractions"), as_move(max_move), how(threads, progress))
        return Selected(Mesh(mesh), piece_of, report)

    def map_thickness(self, blocks: Any, *, step: Optional[float] = None, like: Any = None,
                      threads: Optional[int] = None, progress: Any = None) -> Map:
        """Map the thickness of blocks: the length of each vertical within them, 0 where it meets none.

        Parameters
        ----------
        blocks : str, int, Block, or list of these
            Blocks by name or number, or themselves, which count as one.
        step, like : as in `map_surface`

        Raises
        ------
        KeyError
            For a name of no block.
        terrane.Error
            As `map_surface`.

        Examples
        --------
        >>> m = ...
        >>> m.map_thickness("above flat", step=2).values.max()
        2.0
        """
        given = [blocks] if isinstance(blocks, (str, int, Block)) else as_list(blocks, "blocks")
        chosen = [self.blocks[block.number if isinstance(block, Block) else block] for block in given]
        nodes = nodes_of(parts_of_surfaces(self.mesh.split()), ", ".join(b.name for b in chosen), step, like)
        return Map(nodes, _core.map_thickness(self._core.mesh, self._core.volumes, [b.number for b in chosen], nodes,
                                              how(threads, progress)))

    def grid(self, *, step: Any = None, cells: Any = None, x: Any = None, y: Any = None, z: Any = None,
             threads: Optional[int] = None, progress: Any = None) -> BlocksInCells:
        """Fill the cells of a rectilinear grid with blocks: that of each centre, and the part of each cell that a block fills.

        Parameters
        ----------
        step : float or (float, float, float), optional
            Sizes of cells, at whose multiples the planes between them are.
        cells : (int, int, int), optional
            Numbers of cells along x, y and z that divide the box around the model.
        x, y, z : sequence of float, optional
            Planes across an axis, ascending; all three, or in place of those of `step` or `cells`.

        Raises
        ------
        terrane.Error
            ``bad_option`` for what makes no grid, or more than 10^9 cells.

        Notes
        -----
        A centre on a surface counts to the block on the side of greater x; where the surface is parallel to x, of greater
        y, and then of greater z.

        Examples
        --------
        >>> m = ...
        >>> m.grid(step=1).fraction(1).sum()
        16.0
        """
        return grid_of(self._core, cells_wanted(step, cells, (x, y, z)), threads, progress)

    def to_meshio(self) -> Any:
        """Return a ``meshio.Mesh`` of the surfaces, with the blocks on both sides. Needs meshio.

        Examples
        --------
        >>> m = ...
        >>> m.to_meshio().cells_dict["triangle"].shape
        (34, 3)
        """
        sides = self._core.volumes.of_sides.astype(np.int32)
        return meshio_mesh(self.mesh.vertices, {"triangle": self.mesh.triangles},
                           {"surface": [self.mesh.surfaces_of.first.astype(np.int32)],
                            "volume_front": [sides[:, 0]], "volume_back": [sides[:, 1]]})

    def plot(self, **options: Any) -> Any:
        """Show the blocks in a window or notebook. Needs PyVista, which gets the options.

        Examples
        --------
        >>> m = ...
        >>> shown = m.plot()
        """
        return self.to_pyvista().plot(**{"multi_colors": True, **options})

    def _state(self) -> Tuple[Any, ...]:
        return self._made_by

    @classmethod
    def _from_state(cls, *state: Any) -> "Model":
        if state[0] == "build":
            made: Model = state[1](*state[2:]).model
            return made
        if state[0] == "improved":
            old = cls._from_state(*state[1])
            return cls(_core.improve_model(old._core, state[2], how(None, None)), tuple(state))
        surfaces, boundary, options = state[1:]
        return _made(surfaces, boundary, options, None, None)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Model):
            return NotImplemented
        return bool(self.mesh == other.mesh and self.structure == other.structure
                    and np.array_equal(self._core.exact_volumes, other._core.exact_volumes))

    __hash__ = None  # type: ignore[assignment]

    def _line(self) -> str:
        return (f"{counted(len(self.blocks), 'block')}, {counted(len(self._core.mesh.surfaces), 'surface')}, "
                f"{counted(len(self.mesh.triangles), 'triangle')}, {counted(len(self.leaks), 'leak')}")

    def _numbers(self) -> Dict[str, Any]:
        return {"blocks": len(self.blocks), "surfaces": len(self._core.mesh.surfaces),
                "triangles": len(self.mesh.triangles), "leaks": len(self.leaks),
                "volume": _core.figure(self._core.total_volume)}

    def _repr_html_(self) -> str:
        sides = self._core.volumes.of_sides
        vertices, triangles, of = apart(self.mesh.vertices, self.mesh.triangles, sides)
        colours = unlike_neighbours(sides)
        legend = [(b.name, _core.figure(b.volume), int(colours[b.number])) for b in self.blocks.values()]
        return card("Model", self._numbers(), vertices, triangles, colours[of], legend)


def _length(value: Any, place: str) -> Tuple[float, bool]:
    """Return a length and whether it is chosen automatically; None is 0."""
    if value is None:
        return 0.0, False
    if isinstance(value, str):
        if value == "auto":
            return 0.0, True
        raise bad_option(f"{value!r} is neither a number nor 'auto'", place)
    return as_number(value, place, least=0), False


def _seal_options(seal: Any) -> Tuple[float, bool, Dict[str, float]]:
    """Return the distance, whether it is automatic, and exceptions by "F1" or "F1/F2"."""
    if not isinstance(seal, Mapping):
        return (*_length(seal, "seal"), {})
    distance, automatic = _length(seal.get(None), "seal[None]")
    of = {}
    for name, value in seal.items():
        if name is not None:
            pair = as_pair(name, "seal")
            of[pair] = as_number(value, f"seal[{pair!r}]", least=0)
    return distance, automatic, of


def column_of(column: Any) -> List[Tuple[str, str, Optional[float], bool]]:
    """Return units as tuples (unit, surface, age, erosive), from the top down."""
    made = []
    keys = ("unit", "surface", "age", "contact")
    for i, entry in enumerate([] if column is None else as_list(column, "column")):
        given = entry
        if not isinstance(entry, Mapping):
            given = as_list(entry, f"column[{i}]")
            entry = dict(zip(keys, given))
        if len(entry) != len(given) or set(entry) - set(keys) or "unit" not in entry:
            raise bad_option("an entry has unit, surface, and perhaps age and contact", f"column[{i}]")
        age = None if entry.get("age") is None else as_number(entry["age"], f"column[{i}].age")
        contact = entry.get("contact", "conformable")
        if contact not in ("conformable", "erosive"):
            raise bad_option(f"{contact!r} is neither conformable nor erosive", f"column[{i}].contact")
        surface = entry.get("surface")
        made.append((as_text(entry["unit"], f"column[{i}].unit"),
                     "" if surface is None else as_text(surface, f"column[{i}].surface"), age, contact == "erosive"))
    return made


def _made(surfaces: List[Any], boundary: List[Any], options: Dict[str, Any], threads: Optional[int],
          progress: Any) -> Model:
    core = _core.model(parts_of_surfaces(surfaces), parts_of_surfaces(boundary), options,
                       how(threads, progress))
    return Model(core, ("model", surfaces, boundary, options))


def model(surfaces: Any, box: Any = None, seal: Union[None, float, str, Mapping[Any, float]] = None, *,
          tolerance: Optional[float] = None, extend: float = 0, min_volume: Union[None, float, str] = None,
          column: Optional[Sequence[Any]] = None, max_rounds: int = 8, max_move: Optional[float] = None,
          threads: Optional[int] = None, progress: Any = None) -> Model:
    """Make blocks of surfaces in one call: join within a tolerance, extend, seal, arrange, cut, round, and find the blocks.

    Parameters
    ----------
    surfaces : Surface, list, or dict by name
        What `as_surfaces` takes. Roles help to name lines: give ``role="fault"``, ``"horizon"``.
    box : two corners, six numbers, or list of Surface, optional
        Volume of interest: from `box`, `polygon`, `rotated_box` or `closed`. It closes the blocks.
    seal : float, "auto", or dict, optional
        Close gaps up to this width, unit of the input. A dict has exceptions by ``"F1"`` or ``("F1", "F2")``, and the
        distance for all others under None.
    tolerance : float, optional
        Join what is nearer than this, unit of the input: borders and creases, gaps and overlaps that are thinner.
        No surface moves by more. Gaps of borders as wide are sealed unless `seal` is given.
    extend : float, optional
        Extend horizons that end inside the box to it, by at most this length.
    min_volume : float or "auto", optional
        Merge smaller blocks with a neighbour.
    column : list, optional
        Stratigraphic column from the top down: entries (unit, surface at its base, age, "conformable" or
        "erosive"), or dicts with these keys. The lowest needs no surface.
    max_rounds, max_move, threads, progress : optional
        As in `round` and `arrange`.

    Returns
    -------
    Model

    Warns
    -----
    terrane.Doubt
        For each likely mistake in the surfaces, and where they enclose no block.

    Raises
    ------
    terrane.Error
        ``improper_contact`` where the doubles are not conforming.

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[-1, -1, 0], [9, -1, 0], [-1, 9, 0]], [[0, 1, 2]], "top", "horizon")
    >>> model = terrane.model([flat], box=((0, 0, -1), (2, 2, 1)))
    >>> model
    <Model: 2 blocks, 7 surfaces, 34 triangles, 0 leaks>
    >>> model.blocks["below top"].volume, model.blocks["top/"].name
    (4.0, 'below top')
    """
    distance, automatic, of = _seal_options(seal)
    least, small = _length(min_volume, "min_volume")
    options = {"max_rounds": as_count(max_rounds, "max_rounds", 0, 8), "max_move": as_move(max_move),
               "tolerance": None if tolerance is None else as_number(tolerance, "tolerance", positive=True), "seal": distance,
               "seal_automatic": automatic, "seal_of": of, "extend": as_number(extend, "extend", least=0),
               "min_volume": least, "min_volume_automatic": small, "column": column_of(column)}
    made = _made(as_surfaces(surfaces), as_boundary(box), options, threads, progress)
    for doubt in made.doubts:
        warnings.warn(doubt, stacklevel=2)
    return made
