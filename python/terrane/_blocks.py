# SPDX-License-Identifier: LGPL-3.0-or-later
"""Volumes that surfaces enclose, and the boundary representation of a model."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, Dict, List, NamedTuple, Optional, Tuple

from . import _core
from ._arrangement import Arrangement, arrangement_of
from ._arrays import Float64Array, Point, UInt32Array, as_points
from ._errors import Error
from ._mesh import Mesh, mesh_of, proven
from ._results import Part, Result, by_value, counted
from ._run import how

#: The index that means none, as in the corners of a closed line.
NO_INDEX = 2**32 - 1


class Volumes(Result):
    """The volumes that a mesh or an arrangement encloses; 0 is the outside, 1, 2, ... are the blocks.

    Examples
    --------
    >>> m = ...
    >>> m.volumes.measures.tolist(), m.volumes.total
    ([inf, 16.0, 32.0], 48.0)
    """

    __slots__ = ("_core", "_source")

    def __init__(self, core: _core.Volumes, source: Any) -> None:
        self._core = core
        self._source = source

    of_sides = Part[UInt32Array](
        "Per triangle the volume in front of it (from where its corners are counterclockwise) and the one behind: "
        "ndarray, shape (m, 2), uint32.")
    measures = Part[Float64Array](
        "Per volume the double nearest to its exact measure, cubic unit of the input; [0] is infinite: the outside has no "
        "end: ndarray, shape (n,), float64.")
    total = Part[float]("The double nearest to the measure of all blocks together.")

    def __len__(self) -> int:
        """Return the number of blocks, without the outside."""
        return len(self.measures) - 1

    def exact(self, *, threads: Optional[int] = None) -> Dict[int, Fraction]:
        """Return the measure of each block as an exact fraction; slow for many constructed corners.

        Examples
        --------
        >>> import terrane
        >>> terrane.volumes(terrane.arrange(terrane.box((0, 0, 0), (1, 2, 3)))).exact()
        {1: Fraction(6, 1)}
        """
        run = how(threads, None)
        if isinstance(self._source, Arrangement):
            texts = _core.exact_volumes_of_arrangement(self._source._core, self._core, run)
        else:
            texts = _core.exact_volumes_of_mesh(self._source._core, self._core, run)
        return {block: Fraction(text) for block, text in enumerate(texts) if block > 0}

    def points(self, *, threads: Optional[int] = None) -> List[Tuple[Point, int]]:
        """Return a point inside each block of a mesh, and the number of the block.

        Examples
        --------
        >>> import terrane
        >>> mesh = terrane.mesh(terrane.box((0, 0, 0), (2, 2, 2)))
        >>> [number for place, number in terrane.volumes(terrane.round(terrane.arrange(
        ...     terrane.box((0, 0, 0), (2, 2, 2))))).points()]
        [1]
        """
        mesh = self._mesh()
        return [(place, number) for place, number in
                _core.block_points(mesh._core, self._core, how(threads, None))]

    def locate(self, points: Any, *, threads: Optional[int] = None, progress: Any = None) -> UInt32Array:
        """Return the volume that contains each point, exactly; the volumes are those of a mesh.

        A point on a triangle counts to the side of greater x, then y, then z.

        Examples
        --------
        >>> m = ...
        >>> m.volumes.locate([[1, 1, -0.5], [9, 9, 9]]).tolist()
        [1, 0]
        """
        mesh = self._mesh()
        return _core.locate(mesh._core, self._core, as_points(points, "points"), how(threads, progress))

    def _mesh(self) -> Mesh:
        if isinstance(self._source, Mesh):
            return self._source
        raise Error("unsupported", "these are the volumes of an exact arrangement; those of its mesh of "
                    "doubles can do that: terrane.volumes(terrane.round(arrangement))")

    def _state(self) -> Tuple[Any, ...]:
        return self.of_sides, self.measures, self.total, self._source

    @classmethod
    def _from_state(cls, *state: Any) -> "Volumes":
        return cls(_core.Volumes(*state[:3]), state[3])

    def _line(self) -> str:
        return f"{counted(len(self), 'block')}, {_core.figure(self.total)} in all"

    def _numbers(self) -> Dict[str, Any]:
        return {"blocks": len(self), "volume": _core.figure(self.total)}

    def _shape(self) -> Tuple[Any, Any]:
        return self._source.vertices, self._source.triangles


def volumes(source: Any, *, threads: Optional[int] = None, progress: Any = None) -> Volumes:
    """Find the volumes that an arrangement, or a conforming mesh, encloses, exactly.

    Parameters
    ----------
    source : Arrangement, Mesh, or a result with one
        A mesh that is not known to be conforming is checked first.

    Examples
    --------
    >>> import terrane
    >>> terrane.volumes(terrane.round(terrane.arrange(terrane.box((0, 0, 0), (1, 2, 3)))))
    <Volumes: 1 block, 6 in all>
    """
    if isinstance(source, Arrangement) or not hasattr(source, "mesh") and not isinstance(source, Mesh):
        arrangement = arrangement_of(source)
        return Volumes(_core.volumes_of_arrangement(arrangement._core, how(threads, progress)), arrangement)
    mesh = proven(mesh_of(source), threads, progress)
    return Volumes(_core.volumes_of_mesh(mesh._core, how(threads, progress)), mesh)


class Corner(NamedTuple):
    """A vertex at which lines end.

    Examples
    --------
    >>> m = ...
    >>> corner = m.structure.corners[0]
    >>> corner.vertex, len(corner.lines)
    (8, 3)
    """

    vertex: int
    lines: Tuple[int, ...]


@by_value
class Line(NamedTuple):
    """A chain of edges at which patches meet or end.

    ``kind`` is "free border", "boundary line", "cutoff line", "branch line" or "intersection curve"; ``vertices``
    are those of the mesh, in order; ``corners`` are those at its ends, or `NO_INDEX` for a closed line.

    Examples
    --------
    >>> m = ...
    >>> sorted({line.kind for line in m.structure.lines})
    ['boundary line']
    """

    kind: str
    vertices: UInt32Array
    patches: UInt32Array
    surfaces: Tuple[int, ...]
    corners: Tuple[int, int]
    length: float


@by_value
class Patch(NamedTuple):
    """A connected part of an interface.

    Examples
    --------
    >>> m = ...
    >>> patch = m.structure.patches[0]
    >>> patch.interface, patch.area
    (0, 4.0)
    """

    interface: int
    triangles: UInt32Array
    lines: Tuple[int, ...]
    area: float


@by_value
class InterfaceParts(NamedTuple):
    """The triangles between the same two volumes that belong to the same surfaces.

    Examples
    --------
    >>> m = ...
    >>> part = m.structure.interfaces[0]
    >>> part.volumes, part.surfaces, part.area
    ((0, 1), (6,), 4.0)
    """

    volumes: Tuple[int, int]
    surfaces: Tuple[int, ...]
    patches: Tuple[int, ...]
    triangles: UInt32Array
    area: float


class BlockParts(NamedTuple):
    """A block by the surfaces around it; surfaces, interfaces and volumes by number.

    Examples
    --------
    >>> m = ...
    >>> block = m.structure.blocks[1]
    >>> block.name, block.above, block.volume
    ('below flat', (0,), 16.0)
    """

    name: str
    unit: str
    age: Optional[float]
    above: Tuple[int, ...]
    below: Tuple[int, ...]
    beside: Tuple[int, ...]
    interfaces: Tuple[int, ...]
    inner_interfaces: Tuple[int, ...]
    neighbours: Tuple[int, ...]
    volume: float
    area: float


class Structure(Result):
    """The boundary representation of a model: corners, lines, patches, interfaces and blocks.

    Attributes
    ----------
    corners, lines, patches, interfaces, blocks : lists
        Of `Corner`, `Line`, `Patch`, `InterfaceParts`, `BlockParts`; blocks[0] is the outside.
    patch_of, interface_of : ndarray, uint32
        Per triangle.

    Examples
    --------
    >>> m = ...
    >>> m.structure
    <Structure: 2 blocks, 11 interfaces, 11 patches, 20 lines, 12 corners>
    """

    __slots__ = ("corners", "lines", "patches", "interfaces", "blocks", "patch_of", "interface_of")

    def __init__(self, values: Dict[str, Any]) -> None:
        self.corners: List[Corner] = [Corner(*c) for c in values["corners"]]
        self.lines: List[Line] = [Line(*c) for c in values["lines"]]
        self.patches: List[Patch] = [Patch(*c) for c in values["patches"]]
        self.interfaces: List[InterfaceParts] = [InterfaceParts(*c) for c in values["interfaces"]]
        self.blocks: List[BlockParts] = [BlockParts(*c) for c in values["blocks"]]
        self.patch_of: UInt32Array = values["patch_of"]
        self.interface_of: UInt32Array = values["interface_of"]

    def _state(self) -> Tuple[Any, ...]:
        return ({name: getattr(self, name) for name in self.__slots__},)

    def _line(self) -> str:
        return (f"{counted(len(self.blocks) - 1, 'block')}, {counted(len(self.interfaces), 'interface')}, "
                f"{len(self.patches)} {'patch' if len(self.patches) == 1 else 'patches'}, "
                f"{counted(len(self.lines), 'line')}, {counted(len(self.corners), 'corner')}")

    def _numbers(self) -> Dict[str, Any]:
        return {"blocks": len(self.blocks) - 1, "interfaces": len(self.interfaces),
                "patches": len(self.patches), "lines": len(self.lines), "corners": len(self.corners)}


def structure(mesh: Any, volumes_of_mesh: Optional[Volumes] = None, *, threads: Optional[int] = None,
              progress: Any = None) -> Structure:
    """Build the boundary representation of a conforming mesh.

    Parameters
    ----------
    mesh : Mesh, or a result with one
    volumes_of_mesh : Volumes, optional
        Those of the mesh; found unless given.

    Examples
    --------
    >>> import terrane
    >>> terrane.structure(terrane.round(terrane.arrange(terrane.box((0, 0, 0), (1, 2, 3)))))
    <Structure: 1 block, 6 interfaces, 6 patches, 12 lines, 8 corners>
    """
    whole = mesh_of(mesh)
    found = volumes(whole, threads=threads) if volumes_of_mesh is None else volumes_of_mesh
    if not isinstance(found, Volumes):
        raise TypeError(f"volumes_of_mesh are Volumes, not {type(found).__name__}")
    return Structure(_core.structure(whole._core, found._core, how(threads, progress)))
