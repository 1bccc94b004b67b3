# SPDX-License-Identifier: LGPL-3.0-or-later
"""One mesh of several surfaces, and what is found in it."""

from __future__ import annotations

from typing import Any, Dict, List, NamedTuple, Optional, Tuple

import numpy as np

from . import _core
from ._arrays import Float64Array, IndexLists, Path, Point, SurfaceInfo, UInt32Array, as_flag, as_format
from ._errors import Error
from ._interop import meshio_mesh, polydata
from ._picture import card
from ._results import Part, Result, counted
from ._run import how
from ._surface import Surface, as_surfaces, parts_of_surfaces, surface_of_parts

class Mesh(Result):
    """One mesh of several surfaces, with coordinates in doubles.

    A triangle belongs to several surfaces where these coincide. All arrays are read-only views of the library's
    memory, which they keep alive. Stages make meshes; `terrane.mesh` makes one of surfaces as they are.

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]], "top")
    >>> wall = terrane.Surface([[1, 1, -1], [1, 1, 1], [1, 9, 0]], [[0, 1, 2]], "F1", "fault")
    >>> mesh = terrane.round(terrane.arrange([flat, wall])).mesh
    >>> mesh
    <Mesh: 2 surfaces, 8 vertices, 8 triangles, 1 intersection edge>
    """

    __slots__ = ("_core",)

    def __init__(self, core: _core.Mesh) -> None:
        self._core = core

    surfaces = Part[List[SurfaceInfo]](
        "Names and roles of the surfaces, in the order of the input.", SurfaceInfo.all_of)
    vertices = Part[Float64Array]("Coordinates in the unit of the input: ndarray, shape (n, 3), float64.")
    triangles = Part[UInt32Array]("Indices into `vertices`: ndarray, shape (m, 3), uint32.")
    surfaces_of = Part[IndexLists](
        "Per triangle the surfaces that it belongs to, at least one: indices into `surfaces`.", IndexLists._of)
    regions_of = Part[IndexLists](
        "Per triangle its region in each of its surfaces; no lists where regions were not found.", IndexLists._of)
    parents_of = Part[IndexLists](
        "Per triangle the input triangles that contain it, counted through all surfaces; or no lists.", IndexLists._of)
    intersection_edges = Part[UInt32Array](
        "Edges at which surfaces meet: ndarray, shape (k, 2), uint32, vertices, the lower first.")
    is_proven = Part[bool]("Whether exact predicates have shown that the doubles are a conforming mesh.")

    def split(self, surfaces: Any = ()) -> List[Surface]:
        """Return the surfaces of the mesh as surfaces of their own.

        Parameters
        ----------
        surfaces : surfaces, optional
            Those that the mesh was made of, in their order: their ``point_data`` and ``cell_data`` are carried to the
            result. A vertex at the place of a given one has the same value. At others, floating-point values are linear
            in the nearest triangle; there is none (NaN) where a corner has none. Other numbers and texts are those of
            the nearest corner, and values of triangles those of the triangle nearest to the centre.

        Examples
        --------
        >>> import terrane
        >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]], "top")
        >>> terrane.mesh([flat]).split() == [flat]
        True
        >>> flat = flat.replace(point_data={"height": [1.0, 5.0, 1.0]})
        >>> wall = terrane.Surface([[1, 1, -1], [1, 1, 1], [1, 9, 0]], [[0, 1, 2]], "F1", "fault")
        >>> mesh = terrane.round(terrane.arrange([flat, wall])).mesh
        >>> part = mesh.split([flat, wall])[0]
        >>> bool((part.point_data["height"] == 1 + part.vertices[:, 0]).all())
        True
        """
        given = parts_of_surfaces(as_surfaces(surfaces))
        return [surface_of_parts(parts) for parts in _core.surfaces_of_mesh(self._core, given)]

    def quality(self, *, threads: Optional[int] = None, progress: Any = None) -> Dict[str, Any]:
        """Return the quality of the triangles: q = 2 r / R, angles in degrees, edge lengths.

        Examples
        --------
        >>> import terrane
        >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]], "top")
        >>> round(terrane.mesh([flat]).quality()["q"]["mean"], 3)
        0.828
        """
        return _core.quality(self._core, how(threads, progress))

    def save(self, path: Path, format: Optional[str] = None, *, ascii: bool = False,
             compress: bool = True) -> None:
        """Write the mesh; the extension selects the format, or `format` does ("vtp", "msh22", ...).

        The bytes are those that ``terrane arrange`` writes. `ascii` is for STL, `compress` for VTP.

        Examples
        --------
        >>> import terrane
        >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]], "top")
        >>> terrane.mesh([flat]).save("flat.vtp")
        """
        _core.write_mesh(self._core, path, as_format(format), as_flag(ascii, "ascii"),
                         as_flag(compress, "compress"), how(1, None))

    def to_pyvista(self) -> Any:
        """Return a ``pyvista.PolyData`` with the array ``surface``. Needs PyVista.

        Examples
        --------
        >>> import terrane
        >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]], "flat")
        >>> terrane.mesh([flat]).to_pyvista().points.shape
        (3, 3)
        """
        return polydata(self.vertices, self.triangles, {"surface": self.surfaces_of.first})

    def to_meshio(self) -> Any:
        """Return a ``meshio.Mesh`` with the array ``surface``. Needs meshio.

        Examples
        --------
        >>> import terrane
        >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]], "flat")
        >>> terrane.mesh([flat]).to_meshio().cells_dict["triangle"].shape
        (1, 3)
        """
        return meshio_mesh(self.vertices, {"triangle": self.triangles},
                           {"surface": [self.surfaces_of.first.astype(np.int32)]})

    def plot(self, **options: Any) -> Any:
        """Show the mesh in a window or notebook. Needs PyVista, which gets the options.

        Examples
        --------
        >>> import terrane
        >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]], "flat")
        >>> shown = terrane.mesh([flat]).plot()
        """
        return self.to_pyvista().plot(**{"scalars": "surface", "show_edges": True, **options})

    def _state(self) -> Tuple[Any, ...]:
        c = self._core
        return (list(c.surfaces), c.vertices, c.triangles, tuple(c.surfaces_of), tuple(c.regions_of),
                tuple(c.parents_of), c.intersection_edges)

    @classmethod
    def _from_state(cls, *state: Any) -> "Mesh":
        return cls(_core.Mesh(tuple(state)))

    def _line(self) -> str:
        return (f"{counted(len(self._core.surfaces), 'surface')}, {counted(len(self.vertices), 'vertex')}, "
                f"{counted(len(self.triangles), 'triangle')}, "
                f"{counted(len(self.intersection_edges), 'intersection edge')}")

    def _numbers(self) -> Dict[str, Any]:
        return {"surfaces": len(self._core.surfaces), "vertices": len(self.vertices),
                "triangles": len(self.triangles), "intersection edges": len(self.intersection_edges)}

    def _repr_html_(self) -> str:
        return card("Mesh", self._numbers(), self.vertices, self.triangles, self.surfaces_of.first, self._legend())

    def _legend(self) -> List[Tuple[str, str, int]]:
        return [(s.name, "", k) for k, s in enumerate(self.surfaces)]


class OnMesh(Result):
    """Base of results that are saved and shown by their `mesh`."""

    mesh: Mesh

    def save(self, path: Path, format: Optional[str] = None, **options: Any) -> None:
        """Write the mesh; see `Mesh.save`.

        Examples
        --------
        >>> better = ...
        >>> better.save("better.obj")
        >>> len(terrane.read("better.obj"))
        7
        """
        self.mesh.save(path, format, **options)

    def to_pyvista(self) -> Any:
        """Return the ``pyvista.PolyData`` of the mesh, with the array ``surface``. Needs PyVista.

        Examples
        --------
        >>> rounded = ...
        >>> rounded.to_pyvista().points.shape
        (10, 3)
        """
        return self.mesh.to_pyvista()

    def to_meshio(self) -> Any:
        """Return the ``meshio.Mesh`` of the mesh, with the array ``surface``. Needs meshio.

        Examples
        --------
        >>> rounded = ...
        >>> rounded.to_meshio().cells_dict["triangle"].shape
        (13, 3)
        """
        return self.mesh.to_meshio()

    def plot(self, **options: Any) -> Any:
        """Show the mesh in a window or notebook. Needs PyVista, which gets the options.

        Examples
        --------
        >>> rounded = ...
        >>> shown = rounded.plot()
        """
        return self.mesh.plot(**options)

    def _repr_html_(self) -> str:
        return card(type(self).__name__, self._numbers(), self.mesh.vertices, self.mesh.triangles,
                    self.mesh.surfaces_of.first, self.mesh._legend())


class Contact(NamedTuple):
    """Two triangles that meet other than in a shared vertex or edge.

    Examples
    --------
    >>> flat, wall = ...
    >>> contact = terrane.check([flat, wall]).contacts[0]
    >>> contact.kind, contact.triangles
    ('crossing', (0, 2))
    """

    triangles: Tuple[int, int]
    kind: str
    place: Point


class Region(NamedTuple):
    """A part of a surface that hangs together without crossing an intersection edge.

    Examples
    --------
    >>> rounded = ...
    >>> region = rounded.regions[0]
    >>> region.surface, region.triangles, region.area
    (0, 3, 4.0)
    """

    surface: int
    first_triangle: int
    triangles: int
    area: float
    neighbours: Tuple[int, ...]


class Regions(Result):
    """The regions into which intersection edges divide each surface.

    Attributes
    ----------
    regions_of : IndexLists
        Per triangle its region in each of its surfaces.
    regions : list of Region
        By surface, then by lowest triangle; areas in squared units of the input.

    Examples
    --------
    >>> rounded = ...
    >>> terrane.regions(rounded)
    <Regions: 3 regions>
    """

    __slots__ = ("regions_of", "regions")

    def __init__(self, regions_of: IndexLists, regions: List[Region]) -> None:
        self.regions_of = regions_of
        self.regions = regions

    def __len__(self) -> int:
        return len(self.regions)

    def _line(self) -> str:
        return counted(len(self.regions), "region")

    def _numbers(self) -> Dict[str, Any]:
        return {"regions": len(self.regions)}


class CheckReport(Result):
    """All that is wrong with surfaces. Triangles are numbered through all surfaces.

    Attributes
    ----------
    clean : bool
        Whether the surfaces are a conforming mesh.
    surfaces, triangles, vertices : int
        Their numbers; distinct points in use.
    first_triangle : ndarray, uint32
        Per surface its first triangle, and the total at the end.
    contacts : list of Contact
        Pairs of triangles that meet improperly.
    degenerate : ndarray, uint32
        Triangles without area.
    repeated, shared : ndarray, shape (k, 2), uint32
        Triangles, and the first with the same points in the same surface, or in another one (no flaw).
    non_manifold_edges : list
        Edges with more than two triangles of one surface (no flaw by itself).
    free_border_edges, components : int
        Edges with one triangle of a surface; connected parts.

    Examples
    --------
    >>> flat, wall = ...
    >>> report = terrane.check([flat, wall])
    >>> report.clean, len(report.contacts), report.free_border_edges
    (False, 2, 7)
    """

    __slots__ = ("_values",)

    def __init__(self, values: Dict[str, Any]) -> None:
        self._values = values

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            value = self._values[name]
        except KeyError:
            raise AttributeError(f"a CheckReport has no {name}") from None
        return [Contact(*c) for c in value] if name == "contacts" else value

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *self._values]

    def __bool__(self) -> bool:
        return bool(self._values["clean"])

    def _line(self) -> str:
        v = self._values
        if v["clean"]:
            return f"clean, {counted(v['triangles'], 'triangle')}"
        return (f"{counted(len(v['contacts']), 'improper contact')}, {len(v['degenerate'])} without area, "
                f"{len(v['repeated'])} repeated")

    def _numbers(self) -> Dict[str, Any]:
        v = self._values
        return {"triangles": v["triangles"], "improper contacts": len(v["contacts"]),
                "without area": len(v["degenerate"]), "repeated": len(v["repeated"])}


def mesh(surfaces: Any) -> Mesh:
    """Return one mesh of surfaces as they are: nothing is divided or merged.

    Examples
    --------
    >>> import terrane
    >>> terrane.mesh([terrane.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])])
    <Mesh: 1 surface, 3 vertices, 1 triangle, 0 intersection edges>
    """
    return Mesh(_core.concatenate(parts_of_surfaces(as_surfaces(surfaces))))


def mesh_of(value: Any, place: str = "mesh") -> Mesh:
    """Return the mesh of a result that has one."""
    if isinstance(value, Mesh):
        return value
    found = getattr(value, "mesh", None)
    if isinstance(found, Mesh):
        return found
    raise TypeError(f"{place} is a mesh or a result with one, not {type(value).__name__}")


def proven(value: Mesh, threads: Optional[int], progress: Any) -> Mesh:
    """Return the mesh with a proof that it is conforming."""
    if value.is_proven:
        return value
    return Mesh(_core.proven(value._core, how(threads, progress)))


def require_conforming(clean: bool, contacts: int) -> None:
    """Raise improper_contact unless a mesh is clean."""
    if not clean:
        raise Error("improper_contact", f"{counted(contacts, 'pair')} of triangles still meet improperly "
                    "in doubles; report.contacts lists them")
