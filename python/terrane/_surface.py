# SPDX-License-Identifier: LGPL-3.0-or-later
"""Surfaces, made of arrays and of what other packages call surfaces."""

from __future__ import annotations

import re
import warnings
from collections.abc import Mapping as MappingOf
from typing import Any, Dict, Iterable, List, Mapping, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from . import _core
from ._arrays import Float64Array, Path, UInt32Array, as_count, as_flag, as_format, as_points, as_text, as_triangles, as_word
from ._errors import Error, bad_option, doubts_of
from ._interop import meshio_mesh, polydata
from ._modellers import parts_of_vtk, refuse_internal_coordinates, surfaces_of_model
from ._picture import card
from ._results import Part, counted
from ._run import how

#: The roles that a surface can have.
ROLES: Tuple[str, ...] = ("unknown", "horizon", "fault", "boundary")


class Frame(NamedTuple):
    """The statements of a file about the coordinates of a surface. They influence no geometry.

    Examples
    --------
    >>> import terrane
    >>> terrane.Frame("m", "m", "", 1, False)
    Frame(horizontal_unit='m', vertical_unit='m', system='', vertical_axis=1, column_of_depths=False)

    ``vertical_axis`` is 0 (not stated), 1 (up) or 2 (down: depths, which were turned into heights).
    """

    horizontal_unit: str = ""
    vertical_unit: str = ""
    system: str = ""
    vertical_axis: int = 0
    column_of_depths: bool = False


def as_role(value: Any) -> str:
    """Return a role."""
    if not isinstance(value, str) or value not in ROLES:
        raise bad_option(f"no role is called {value!r}; there are {', '.join(ROLES)}", "role")
    return value


class Surface:
    """A triangulated surface. It may be open, cross itself, and have duplicate or flat triangles.

    Parameters
    ----------
    vertices : array_like, shape (n, 3)
        Coordinates x, y, z in any one unit.
    triangles : array_like of integers, shape (m, 3)
        Indices into `vertices`, from 0.
    name : str, optional
        Name of the surface; need not be unique.
    role : {"unknown", "horizon", "fault", "boundary"}, optional
        What the surface is to the geologist.

    point_data, cell_data : mapping of str to array_like, shape (n,) or (n, k), optional
        Values per vertex and per triangle: numbers of any type, or texts. Files have them and get them.

    Raises
    ------
    terrane.Error
        ``bad_option`` for arrays of another shape or type, and for numbers that float64 does not hold; ``bad_number``
        for a coordinate that is not finite; ``bad_index`` for a triangle that names a vertex that does not exist.

    Notes
    -----
    A surface copies the arrays and checks the copy, 24 bytes per vertex and 12 per triangle, which nobody can change
    afterwards. Stages copy it once more while they run.

    Examples
    --------
    >>> import terrane
    >>> terrane.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], name="top", role="horizon")
    <Surface 'top': horizon, 3 vertices, 1 triangle>
    """

    __slots__ = ("_core",)

    def __init__(self, vertices: Any, triangles: Any, name: str = "", role: str = "unknown",
                 frame: Optional[Frame] = None, point_data: Optional[Mapping[str, Any]] = None,
                 cell_data: Optional[Mapping[str, Any]] = None) -> None:
        place = f"{name}: " if as_text(name, "name") else ""
        points, corners = as_points(vertices, place + "vertices"), as_triangles(triangles, place + "triangles")
        values = (_as_values(point_data, len(points), False, place + "point_data")
                  + _as_values(cell_data, len(corners), True, place + "cell_data"))
        self._core = _core.Surface(points, corners, name, as_role(role), _as_frame(frame), values)

    @classmethod
    def _of(cls, core: _core.Surface) -> "Surface":
        """Return a surface of the library."""
        made = cls.__new__(cls)
        made._core = core
        return made

    vertices = Part[Float64Array]("Coordinates: ndarray, shape (n, 3), float64, read-only.")
    triangles = Part[UInt32Array]("Indices into `vertices`: ndarray, shape (m, 3), uint32, read-only.")
    name = Part[str]("The name; may be empty.")
    role = Part[str]("One of `terrane.ROLES`.")
    frame = Part[Frame]("The statements of a file about the coordinates.", Frame._make)

    @property
    def point_data(self) -> Dict[str, Any]:
        """The values per vertex by their names: ndarrays, shape (n,) or (n, k), of their own types.

        Examples
        --------
        >>> import terrane
        >>> flat = ([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> s = terrane.Surface(*flat, point_data={"porosity": [0.1, 0.2, 0.3]}, cell_data={"rock": ["clay"]})
        >>> s.point_data["porosity"]
        array([0.1, 0.2, 0.3])
        >>> s.cell_data["rock"][0]
        'clay'
        """
        return _shown_values(self._core.values, False)

    @property
    def cell_data(self) -> Dict[str, Any]:
        """The values per triangle by their names: ndarrays, shape (m,) or (m, k), of their own types."""
        return _shown_values(self._core.values, True)

    @property
    def units(self) -> Dict[str, str]:
        """The units of values by their names, where the file states one."""
        return {name: unit for name, _, _, unit, _, _ in self._core.values if unit}

    @property
    def no_data(self) -> Dict[str, float]:
        """The numbers that stand for no value, by the names of the values, where the file states one."""
        return {name: number for name, _, _, _, number, _ in self._core.values if number is not None}

    @property
    def bounds(self) -> Tuple[Tuple[float, float, float], Tuple[float, float, float]]:
        """The least and the largest x, y, z of the vertices.

        Examples
        --------
        >>> import terrane
        >>> terrane.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 2]], [[0, 1, 2]]).bounds
        ((0.0, 0.0, 0.0), (1.0, 1.0, 2.0))
        """
        vertices = self.vertices
        if len(vertices) == 0:
            raise Error("nothing_to_do", "a surface without vertices has no bounds", self.name)
        low, high = vertices.min(axis=0), vertices.max(axis=0)
        return (float(low[0]), float(low[1]), float(low[2])), (float(high[0]), float(high[1]), float(high[2]))

    def replace(self, **changes: Any) -> "Surface":
        """Return a copy in which some of vertices, triangles, name, role, frame, point_data and cell_data are others.

        With other vertices or triangles it has only the values that are given.

        Examples
        --------
        >>> import terrane
        >>> s = terrane.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> s.replace(name="F1", role="fault")
        <Surface 'F1': fault, 3 vertices, 1 triangle>
        """
        values: Dict[str, Any] = {"vertices": self.vertices, "triangles": self.triangles,
                                  "name": self.name, "role": self.role, "frame": self.frame,
                                  "point_data": None, "cell_data": None}
        unknown = set(changes) - set(values)
        if unknown:
            raise TypeError(f"a surface has no {', '.join(sorted(unknown))}")
        values.update(changes)
        if changes.keys() & {"vertices", "triangles"}:
            return Surface(**values)
        if changes.keys() & {"point_data", "cell_data"}:
            return Surface(**{**values, **{data: changes.get(data, getattr(self, data))
                                           for data in ("point_data", "cell_data")}})
        return Surface._of(self._core.described_anew(as_text(values["name"], "name"), as_role(values["role"]),
                                                     _as_frame(values["frame"])))

    def save(self, path: Path, format: Optional[str] = None) -> None:
        """Write the surface to a file; the extension selects the format, or `format` does.

        Examples
        --------
        >>> import terrane
        >>> terrane.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], "top").save("top.obj")
        >>> terrane.read("top.obj")[0].name
        'top'
        """
        left_out = _core.write_surfaces([self._core], path, as_format(format), how(1, None))
        if left_out:
            warnings.warn(f"{path!s}: the format has no place for these values: {', '.join(left_out)}", stacklevel=2)

    def __or__(self, other: Any) -> "Surface":
        """Return the boundary of what is inside of one of two closed surfaces.

        Such operators are `terrane.select` of two operands, and raise its errors; ``improper_contact`` if the doubles
        are not conforming. The name of the result is the expression.

        Examples
        --------
        >>> a, b = ...
        >>> a | b
        <Surface 'a | b': unknown, 20 vertices, 36 triangles>
        """
        return self._selected("|", other)

    def __and__(self, other: Any) -> "Surface":
        """Return the boundary of what is inside of both; see ``a | b``.

        Examples
        --------
        >>> a, b = ...
        >>> (a & b).bounds
        ((1.0, 1.0, 1.0), (2.0, 2.0, 2.0))
        """
        return self._selected("&", other)

    def __xor__(self, other: Any) -> "Surface":
        """Return the boundary of what is inside of one but not of both; see ``a | b``.

        Examples
        --------
        >>> a, b = ...
        >>> (a ^ b).name
        'a ^ b'
        """
        return self._selected("^", other)

    def __sub__(self, other: Any) -> "Surface":
        """Return the boundary of what is inside of this surface and outside of the other; see ``a | b``.

        Examples
        --------
        >>> a, b = ...
        >>> (a | b) - b
        <Surface '(a | b) - b': unknown, 14 vertices, 24 triangles>
        """
        return self._selected("-", other)

    def _selected(self, operator: str, other: Any) -> "Surface":
        if not isinstance(other, Surface):
            return NotImplemented
        names = [s.name if re.fullmatch(r"[\w.]+", s.name) else f"({s.name})" for s in (self, other)]
        operands = [s.replace(name=name)._core for s, name in ((self, "a"), (other, "b"))]
        try:
            made, _, report = _core.select(operands, f"a {operator} b", "nonzero", False, None, how(None, None))
        except Error as error:
            place = {"a": self.name, "b": other.name}.get(error.place, error.place)
            raise Error(error.code, error.sentence, place) from None
        if not report["rounding"]["clean"]:
            raise Error("improper_contact", "the boundary is not conforming in doubles; terrane.select() tells where")
        return Surface(made.vertices, made.triangles, f"{names[0]} {operator} {names[1]}", self.role)

    def to_pyvista(self) -> Any:
        """Return a ``pyvista.PolyData`` with the values. Needs PyVista.

        Examples
        --------
        >>> import terrane
        >>> surface = terrane.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], "top")
        >>> surface.to_pyvista().points.shape
        (3, 3)
        """
        made = polydata(self.vertices, self.triangles, {})
        for name, values in self.point_data.items():
            made.point_data[name] = np.array(values)
        for name, values in self.cell_data.items():
            made.cell_data[name] = np.array(values)
        return made

    def to_meshio(self) -> Any:
        """Return a ``meshio.Mesh``. Needs meshio.

        Examples
        --------
        >>> import terrane
        >>> surface = terrane.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], "top")
        >>> surface.to_meshio().cells_dict["triangle"].shape
        (1, 3)
        """
        return meshio_mesh(self.vertices, {"triangle": self.triangles}, {})

    def plot(self, **options: Any) -> Any:
        """Show the surface in a window or notebook. Needs PyVista, which gets the options.

        Examples
        --------
        >>> import terrane
        >>> surface = terrane.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], "top")
        >>> shown = surface.plot()
        """
        return self.to_pyvista().plot(**options)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Surface):
            return NotImplemented
        return bool(self.name == other.name and self.role == other.role and self.frame == other.frame
                    and np.array_equal(self.vertices, other.vertices)
                    and np.array_equal(self.triangles, other.triangles)
                    and _are_same(self._core.values, other._core.values))

    __hash__ = None  # type: ignore[assignment]

    def __copy__(self) -> "Surface":
        return self

    def __deepcopy__(self, memo: Dict[int, Any]) -> "Surface":
        return self  # nobody can change it

    def __reduce__(self) -> Tuple[Any, ...]:
        return _made_of_state, (np.array(self.vertices), np.array(self.triangles), self.name, self.role,
                                tuple(self.frame), [(*v[:2], np.array(v[2]), *v[3:]) for v in self._core.values])

    def __repr__(self) -> str:
        return (f"<Surface {self.name!r}: {self.role}, {counted(len(self.vertices), 'vertex')}, "
                f"{counted(len(self.triangles), 'triangle')}>")

    def _repr_html_(self) -> str:
        return card("Surface " + self.name,
                    {"role": self.role, "vertices": len(self.vertices), "triangles": len(self.triangles)},
                    self.vertices, self.triangles)


def _made_of_state(vertices: Any, triangles: Any, name: str, role: str, frame: Any, values: List[Any]) -> Surface:
    """Return the surface of a pickle."""
    made = Surface(vertices, triangles, name, role, frame)
    if values:
        data: Tuple[Dict[str, Any], Dict[str, Any]] = ({}, {})
        for value in values:
            data[1 if value[1] else 0][as_text(value[0], "name")] = value[2]
        judged = (_as_values(data[0], len(made.vertices), False, "point_data")
                  + _as_values(data[1], len(made.triangles), True, "cell_data"))
        texts = {(v[0], v[1]): [as_text(t, "text") for t in v[5]] for v in values}
        extras = {(v[0], v[1]): (as_text(v[3], "unit"), v[4] if v[4] is None else float(v[4])) for v in values}
        made._core = _core.Surface(made.vertices, made.triangles, name, role, _as_frame(frame), [
            (of, on, rows, *extras[of, on], _as_texts(texts[of, on], rows)) for of, on, rows, _, _, _ in judged])
    return made


def _as_texts(texts: List[str], codes: Any) -> List[str]:
    """Return texts of which codes are the indices."""
    if texts and codes.size and not (0 <= int(codes.min()) and int(codes.max()) < len(texts)):
        raise Error("bad_index", "codes name texts that do not exist", "values")
    return texts


def _as_values(data: Optional[Mapping[str, Any]], count: int, on_triangles: bool, place: str) -> List[Tuple[Any, ...]]:
    """Return arrays of values as the extension module takes them; texts become codes."""
    found: List[Tuple[Any, ...]] = []
    if data is not None and not isinstance(data, MappingOf):
        raise TypeError(f"{place} is a mapping of names to arrays, not {type(data).__name__}")
    for name, given in (data or {}).items():
        as_text(name, place)
        at = f"{place}[{name!r}]"
        array = np.asarray(given)
        texts: List[str] = []
        if array.dtype.kind in "OU" and array.size and all(isinstance(text, str) for text in array.reshape(-1)):
            words, codes = np.unique(array.astype(str), return_inverse=True)
            texts, array = words.tolist(), codes.reshape(array.shape).astype(np.int32)
        if array.dtype.kind == "b":
            array = array.astype(np.uint8)
        if array.dtype.kind not in "fiu" or array.dtype.itemsize not in (1, 2, 4, 8) or array.dtype == np.float16:
            raise bad_option(f"must be numbers of at most 64 bits, or texts, not {array.dtype}", at)
        if array.ndim not in (1, 2) or len(array) != count or (array.ndim == 2 and array.shape[1] == 0):
            raise bad_option(f"must have the shape ({count},) or ({count}, k), not {array.shape}", at)
        rows = np.ascontiguousarray(array.reshape(count, -1 if count else 1), dtype=array.dtype.newbyteorder("="))
        found.append((as_text(name, place), on_triangles, rows, "", None, texts))
    return found


def _shown_values(values: List[Any], on_triangles: bool) -> Dict[str, Any]:
    """Return the arrays of values by their names, read-only."""
    shown: Dict[str, Any] = {}
    for name, is_on_triangles, rows, _, _, texts in values:
        if is_on_triangles != on_triangles:
            continue
        array = rows[:, 0] if rows.shape[1] == 1 else rows
        if texts:
            array = np.array(texts, dtype=object)[array]
            array.setflags(write=False)
        shown[name] = array
    return shown


def _are_same(one: List[Any], other: List[Any]) -> bool:
    """Tell whether values are equal; no value (NaN) is equal to none."""
    return len(one) == len(other) and all(
        (*a[:2], *a[3:]) == (*b[:2], *b[3:]) and a[2].dtype == b[2].dtype
        and np.array_equal(a[2], b[2], equal_nan=a[2].dtype.kind == "f") for a, b in zip(one, other))


def _as_frame(value: Any) -> Frame:
    """Return a frame, checked."""
    if value is None:
        return Frame()
    if not isinstance(value, (tuple, list)) or len(value) != len(Frame._fields):
        raise TypeError(f"frame is a terrane.Frame, not {type(value).__name__}")
    horizontal, vertical, system, axis, depths = value
    return Frame(as_word(horizontal, "frame.horizontal_unit"), as_word(vertical, "frame.vertical_unit"),
                 as_word(system, "frame.system"), as_count(axis, "frame.vertical_axis", 0, 2),
                 as_flag(depths, "frame.column_of_depths"))


def _faces_of_polydata(faces: Any) -> Any:
    """Return the triangles of a VTK array of cells (3, a, b, c, 3, ...)."""
    flat = np.asarray(faces).reshape(-1)
    if len(flat) % 4 != 0 or np.any(flat[::4] != 3):
        raise bad_option("cells are not all triangles; use .triangulate() first", "faces")
    return flat.reshape(-1, 4)[:, 1:]


def _parts_of_meshio(mesh: Any) -> Tuple[Any, Any]:
    """Return points and triangles; points, lines and volumes are passed over, other faces refused."""
    passed_over = ("vertex", "line", "tetra", "hexahedron", "wedge", "pyramid")
    others = sorted({b.type for b in mesh.cells if b.type != "triangle" and not b.type.startswith(passed_over)})
    if others:
        raise bad_option(f"the meshio.Mesh has faces that are no triangles: {', '.join(others)}; write it as VTU, "
                         "which terrane.read() divides", "cells")
    blocks = [np.asarray(b.data) for b in mesh.cells if b.type == "triangle"]
    if not blocks:
        raise Error("nothing_to_do", "the meshio.Mesh has no triangles", "cells")
    return mesh.points, np.concatenate(blocks)


def _parts_of(value: Any) -> Optional[Tuple[Any, Any]]:
    """Return vertices and triangles of an object, judged by its attributes; None if it has none."""
    refuse_internal_coordinates(value)
    vtk = parts_of_vtk(value)
    if vtk is not None and not hasattr(value, "faces"):  # no pyvista.PolyData
        return vtk
    if hasattr(value, "vertices") and hasattr(value, "faces"):  # trimesh.Trimesh
        return np.asarray(value.vertices), np.asarray(value.faces)
    if hasattr(value, "points") and hasattr(value, "cells") and hasattr(value, "cell_data"):
        if not hasattr(value, "faces") and not callable(getattr(value, "cells", None)):
            return _parts_of_meshio(value)  # meshio.Mesh
    if hasattr(value, "points") and hasattr(value, "faces"):  # pyvista.PolyData
        return np.asarray(value.points), _faces_of_polydata(value.faces)
    if hasattr(value, "vertices") and hasattr(value, "triangles"):  # LoopStructural's Surface, and ours
        return value.vertices, value.triangles
    if hasattr(value, "vertices") and hasattr(value, "edges"):  # GemPy's surfaces: edges are triangles
        edges = np.asarray(value.edges)
        if edges.ndim == 2 and edges.shape[1] == 3:
            return value.vertices, edges
    return None


def _data_of(value: Any) -> Tuple[Dict[str, Any], Dict[str, Any]]:
    """Return the values of a pyvista.PolyData per point and per cell, but for normals."""
    if not hasattr(value, "points") or not hasattr(value, "faces"):
        return {}, {}
    kinds = [getattr(value, kind, None) for kind in ("point_data", "cell_data")]
    data = [{name: np.asarray(array) for name, array in kind.items() if name != "Normals"}
            if kind is not None and hasattr(kind, "items") else {} for kind in kinds]
    return data[0], data[1]


def as_surface(value: Any, name: Optional[str] = None, role: Optional[str] = None) -> Surface:
    """Return a surface of what has vertices and triangles, whatever package it is from.

    Parameters
    ----------
    value : object
        A `Surface`; a ``pyvista.PolyData`` or ``vtkPolyData`` of triangles; a ``meshio.Mesh``; a
        ``trimesh.Trimesh``; a surface of LoopStructural (``vertices``, ``triangles``) or an element of GemPy
        (``vertices``, ``edges`` of three indices); a tuple (vertices, triangles), or of the four arrays of
        ``skimage.measure.marching_cubes``. The packages are not needed: attributes decide.
    name, role : str, optional
        Name and role, instead of those that the object has.

    Examples
    --------
    >>> import terrane
    >>> terrane.as_surface(([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]), name="F1", role="fault")
    <Surface 'F1': fault, 3 vertices, 1 triangle>
    """
    if isinstance(value, Surface):
        changes = {k: v for k, v in (("name", name), ("role", role)) if v is not None}
        return value.replace(**changes) if changes else value
    # (vertices, triangles), and what else skimage.measure.marching_cubes returns.
    parts = value[:2] if isinstance(value, tuple) and len(value) in (2, 4) else _parts_of(value)
    if parts is None:
        raise TypeError(f"{type(value).__name__} is no surface: it has no vertices with faces, "
                        "triangles or cells")
    given = getattr(value, "name", "") if name is None else name
    own_role = getattr(value, "role", "unknown") if role is None else role
    points, cells = _data_of(value)
    return Surface(parts[0], parts[1], given if isinstance(given, str) else "",
                   own_role if isinstance(own_role, str) and own_role in ROLES else "unknown", None, points, cells)


def warn_of_doubts(surfaces: List[Surface], leave_out: Sequence[str] = ()) -> None:
    """Warn the caller's caller of likely mistakes in surfaces, but for some kinds."""
    labels = _core.unique_labels([(s.name, s.role) for s in surfaces])
    for doubt in doubts_of(_core.doubts(parts_of_surfaces(surfaces)), labels):
        if doubt.about not in leave_out:
            warnings.warn(doubt, stacklevel=3)


def as_surfaces(value: Any, place: str = "surfaces") -> List[Surface]:
    """Return a list of surfaces of one surface, a list of them, a dict of them by name, or a model.

    A model is a computed ``GeoModel`` of GemPy or a ``GeologicalModel`` of LoopStructural. Its surfaces have the
    model's names, are horizons or faults, and have the coordinates of the model's data.

    Examples
    --------
    >>> import terrane
    >>> flat = ([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> terrane.as_surfaces({"top": flat, "base": flat})
    [<Surface 'top': unknown, 3 vertices, 1 triangle>, <Surface 'base': unknown, 3 vertices, 1 triangle>]
    """
    as_text(place, "place")
    if isinstance(value, Surface):
        return [value]
    if isinstance(value, dict):
        return [as_surface(surface, name=name) for name, surface in value.items()]
    if isinstance(value, (str, bytes)):
        raise TypeError(f"{place} are surfaces, not a name; read files with terrane.read()")
    if isinstance(value, np.ndarray):
        raise TypeError(f"{place} are surfaces, not one array; make terrane.Surface(vertices, triangles)")
    if (of_model := surfaces_of_model(value)) is not None:
        return [as_surface(surface, role=role) for surface, role in of_model]
    if _parts_of(value) is not None:
        return [as_surface(value)]
    try:
        items: Sequence[Any] = list(value)
    except TypeError:
        raise TypeError(f"{place} are surfaces, not {type(value).__name__}") from None
    return [as_surface(item) for item in items]


def parts_of_surfaces(surfaces: Iterable[Surface]) -> List[_core.Surface]:
    """Return what the extension module takes."""
    return [surface._core for surface in surfaces]


def surface_of_parts(parts: _core.Surface) -> Surface:
    """Return the surface that the extension module made."""
    return Surface._of(parts)
