# SPDX-License-Identifier: LGPL-3.0-or-later
"""The parts of a model: its mesh, and its blocks and interfaces, each by name or number."""

from __future__ import annotations

from typing import Any, Dict, Iterator, List, Mapping, NamedTuple, Optional, Tuple

from . import _core
from ._arrays import Path, UInt32Array, as_count, as_number
from ._blocks import BlockParts, InterfaceParts, Structure, Volumes
from ._errors import Error
from ._mesh import Mesh
from ._picture import card
from ._report import facts
from ._results import Part, Result, T
from ._run import how
from ._surface import parts_of_surfaces


class Parts(Result):
    """The parts of every `Model`; a class of its own, as blocks and tetrahedra refer to it and `Model` to them."""

    __slots__ = ("_core", "_made_by", "_mesh", "_structure", "_labels", "_blocks")

    def __init__(self, core: _core.Model, made_by: Tuple[Any, ...]) -> None:
        self._core = core
        self._made_by = made_by
        self._mesh: Optional[Mesh] = None
        self._structure: Optional[Structure] = None
        self._labels: Optional[List[str]] = None
        self._blocks: Optional[Blocks] = None

    @property
    def mesh(self) -> Mesh:
        """All surfaces and the boundary, conforming, in doubles."""
        if self._mesh is None:
            self._mesh = Mesh(self._core.mesh)
        return self._mesh

    @property
    def structure(self) -> Structure:
        """Corners, lines, patches, interfaces, blocks."""
        if self._structure is None:
            self._structure = Structure(self._core.structure)
        return self._structure

    @property
    def labels(self) -> List[str]:
        """The names of the surfaces, made different."""
        if self._labels is None:
            self._labels = _core.unique_labels(self._core.mesh.surfaces)
        return self._labels

    @property
    def volumes(self) -> Volumes:
        """The volumes of the mesh, by the numbers of the blocks."""
        return Volumes(self._core.volumes, self.mesh)

    @property
    def blocks(self) -> Blocks:
        """The blocks by name."""
        if self._blocks is None:
            self._blocks = Blocks(self)
        return self._blocks

    @property
    def interfaces(self) -> List[Interface]:
        """The interfaces, by number."""
        return [Interface(self, i) for i in range(len(self.structure.interfaces))]

    def _report(self, path: Path, command: str, tetrahedra: Optional[_core.Tetrahedra], threads: Optional[int]) -> None:
        """Write the page of the model, with the tetrahedra that fill it."""
        made = self._made_by
        options: Dict[str, Any] = {}
        while made[0] == "improved":
            options = {**made[2], **options}
            made = made[1]
        surfaces: List[Any] = []
        if made[0] == "model":
            surfaces = made[1]
            options = {**made[3], **options}
        about = facts(command, [s.name for s in surfaces] or self.labels, options)
        _core.report_model(self._core, tetrahedra, parts_of_surfaces(surfaces), path, about, how(threads, None))


class _Said(Part[T]):
    """What the structure of a model says of a block or an interface."""

    def _source(self, part: Any) -> Any:
        return part._said


class _Numbered:
    """A block or an interface: a number in a model, which holds all that is said of it."""

    __slots__ = ("_model", "number")

    def __init__(self, model: Parts, number: int) -> None:
        self._model = model
        self.number = number

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, _Numbered) or type(self) is not type(other):
            return NotImplemented
        return self.number == other.number and (self._model is other._model or self._model == other._model)


class PartAbove(NamedTuple):
    """The part of a block above a contact, a level plane.

    Attributes
    ----------
    volume : float
        Cubic unit of the input.
    area : float
        Of the block's section by the contact, squared unit.
    column : float
        The height of the block's highest point above the contact; 0: the block is below it.

    Examples
    --------
    >>> m = ...
    >>> m.blocks["above flat"].above_contact(1)
    PartAbove(volume=16.0, area=16.0, column=1.0)
    """

    volume: float
    area: float
    column: float


class Block(_Numbered):
    """A block of a model.

    Examples
    --------
    >>> m = ...
    >>> m.blocks[2]
    <Block 2 'above flat': volume 32>
    >>> m.blocks[2].below, m.blocks[2].volume
    (('flat',), 32.0)
    """

    __slots__ = ()

    name = _Said[str]("Different for all blocks.")
    unit = _Said[str]("The unit of the stratigraphic column; empty: none.")
    age = _Said[Optional[float]]("The age of the base of the unit.")
    area = _Said[float]("The area of the boundary, squared unit.")

    @property
    def _said(self) -> BlockParts:
        return self._model.structure.blocks[self.number]

    @property
    def key(self) -> str:
        """``"above/below|beside"`` by the names of the surfaces around it, without the model's boundary."""
        def names(numbers: Tuple[int, ...]) -> str:
            surfaces = self._model.mesh.surfaces
            return "+".join(self._model.labels[s] for s in numbers if surfaces[s].role != "boundary")
        beside = names(self._said.beside)
        return f"{names(self._said.above)}/{names(self._said.below)}" + (f"|{beside}" if beside else "")

    @property
    def volume(self) -> float:
        """The exact volume, rounded once; cubic unit of the input."""
        volumes = self._model._core.exact_volumes
        return float(volumes[self.number]) if self.number < len(volumes) else float("nan")

    @property
    def above(self) -> Tuple[str, ...]:
        """Names of the surfaces above."""
        return self._names(self._said.above)

    @property
    def below(self) -> Tuple[str, ...]:
        """Names of the surfaces below."""
        return self._names(self._said.below)

    @property
    def beside(self) -> Tuple[str, ...]:
        """Names of the surfaces beside."""
        return self._names(self._said.beside)

    @property
    def neighbours(self) -> Tuple[str, ...]:
        """Names of the blocks next to it, with "outside"."""
        blocks = self._model.structure.blocks
        return tuple(blocks[b].name for b in self._said.neighbours)

    def above_contact(self, contact: float) -> PartAbove:
        """Measure the part above a level, in floating point.

        Parameters
        ----------
        contact : float
            z of the level.

        Examples
        --------
        >>> m = ...
        >>> m.blocks["above flat"].above_contact(-1).volume
        32.0
        """
        measures = _core.measure_blocks(self._model._core, [as_number(contact, "contact")])
        return PartAbove(*measures[self.number][3][0])

    @property
    def mesh(self) -> Mesh:
        """The closed boundary of the block, wound outward. Neighbours share vertices to the last bit."""
        return Mesh(self._model._core.part(True, self.number)[0])

    def _names(self, numbers: Tuple[int, ...]) -> Tuple[str, ...]:
        return tuple(self._model.labels[s] for s in numbers)

    def __hash__(self) -> int:
        return hash((self.number, self.name))

    def __repr__(self) -> str:
        return f"<Block {self.number} {self.name!r}: volume {_core.figure(self.volume)}>"

    def _repr_html_(self) -> str:
        mesh = self.mesh
        return card(self.name, {"number": self.number, "volume": _core.figure(self.volume),
                                "area": _core.figure(self.area), "neighbours": ", ".join(self.neighbours)},
                    mesh.vertices, mesh.triangles, mesh.surfaces_of.first)


class Blocks(Mapping[str, Block]):
    """The blocks of a model by name; also by number, and by ``"above/below|beside"`` where that is one block.

    Examples
    --------
    >>> m = ...
    >>> len(m.blocks), list(m.blocks)
    (2, ['below flat', 'above flat'])
    >>> m.blocks["flat/"].number
    1
    """

    __slots__ = ("_model", "_by_name")

    def __init__(self, model: Parts) -> None:
        self._model = model
        self._by_name = {b.name: Block(model, i)
                         for i, b in enumerate(model.structure.blocks) if i > 0}

    def __getitem__(self, key: Any) -> Block:
        if isinstance(key, str):
            if key in self._by_name:
                return self._by_name[key]
            found = [b for b in self._by_name.values() if b.key == key]
            if len(found) == 1:
                return found[0]
            names = ", ".join(repr(b.name) for b in (found or self._by_name.values()))
            raise KeyError(f"{key!r} is {'several blocks' if found else 'no block'}: {names}")
        number = as_count(key, "number of a block")
        if not 1 <= number <= len(self):
            raise KeyError(f"there is no block {number}; they are 1 to {len(self)}")
        return Block(self._model, number)

    def __iter__(self) -> Iterator[str]:
        return iter(self._by_name)

    def __len__(self) -> int:
        return len(self._by_name)

    def __repr__(self) -> str:
        return f"<Blocks: {', '.join(self._by_name)}>"


class Interface(_Numbered):
    """The triangles between the same two blocks that belong to the same surfaces.

    Examples
    --------
    >>> m = ...
    >>> parts = [i for i in m.interfaces if i.surfaces == ("flat",)]
    >>> parts[0].area, parts[0].blocks
    (16.0, ('below flat', 'above flat'))
    """

    __slots__ = ()

    area = _Said[float]("Squared unit of the input.")
    triangles = _Said[UInt32Array]("Triangles of the mesh of the model: ndarray, uint32.")

    @property
    def _said(self) -> InterfaceParts:
        return self._model.structure.interfaces[self.number]

    @property
    def surfaces(self) -> Tuple[str, ...]:
        """Names of the surfaces."""
        return tuple(self._model.labels[s] for s in self._said.surfaces)

    @property
    def blocks(self) -> Tuple[str, str]:
        """Names of the blocks on its sides; equal where the surface ends inside a block."""
        low, high = self._said.volumes
        blocks = self._model.structure.blocks
        return blocks[low].name, blocks[high].name

    @property
    def mesh(self) -> Mesh:
        """The interface as a mesh of its own."""
        return Mesh(self._model._core.part(False, self.number)[0])

    def __hash__(self) -> int:
        return hash((self.number, self.surfaces))

    def __repr__(self) -> str:
        return f"<Interface {self.number} of {' and '.join(self.surfaces)}: {self.blocks[0]} | {self.blocks[1]}>"


def number_of(model: Parts, block: Any) -> int:
    """Return the number of a block, given as a block, a number, a name or a key."""
    if isinstance(block, Block):
        return block.number
    try:
        return model.blocks[block].number
    except KeyError as missing:
        raise Error("bad_option", str(missing.args[0]), "block") from None
