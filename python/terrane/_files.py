# SPDX-License-Identifier: LGPL-3.0-or-later
"""Reading and writing files of any format."""

from __future__ import annotations

import glob
import os
from typing import Any, Dict, List, Mapping, Optional, Sequence, Union

from . import _core
from ._arrays import Path, as_flag, as_format, as_list, as_mapping, as_number, as_word
from ._errors import Error
from ._mesh import mesh
from ._run import how
from ._surface import Surface, as_surfaces, surface_of_parts


def _paths(value: Any) -> List[str]:
    """Return the files that a path or a pattern stands for."""
    if not isinstance(value, (str, bytes, os.PathLike)):
        raise TypeError(f"path is a path, or a list of paths, not {type(value).__name__}")
    path = os.fsdecode(value)
    if os.path.exists(path) or not glob.has_magic(path):
        return [path]
    found = sorted(glob.glob(path, recursive=True))
    if not found:
        raise Error("cannot_open", "no file matches", path)
    return found


def _columns(value: Optional[Sequence[Union[int, str]]]) -> str:
    """Return what the library takes for three columns."""
    if value is None:
        return ""
    given = as_list(value, "columns")
    for column in given:
        if isinstance(column, bool) or not isinstance(column, (int, str)):
            raise TypeError(f"columns are integers or names, not {type(column).__name__}")
    if any("," in str(column) for column in given):
        raise Error("bad_option", "a column whose name has a comma is stated by its number", "columns")
    return ",".join(str(column) for column in given)


def read(path: Any, *, format: Optional[str] = None, depth: bool = False, max_edge: float = 0,
         unit: str = "", columns: Optional[Sequence[Union[int, str]]] = None, roles: Optional[Dict[str, str]] = None, threads: Optional[int] = None,
         progress: Any = None) -> List[Surface]:
    """Read the surfaces of files.

    Parameters
    ----------
    path : path, pattern, or list of these
        ``"*.ts"`` stands for all files that match, in alphabetical order.
    format : str, optional
        Name of the format ("ts", "obj", "vtp", "xyz", ...) instead of the extension.
    depth : bool, optional
        Grids and points: values are depths, positive down.
    max_edge : float, optional
        Points: longest edge of the triangles between them; 0: twice the median.
    unit : str, optional
        Unit to which coordinates with a stated unit are converted: "m", "km", "ft", "ftUS", "cm".
    columns : three integers or names, optional
        Columns of numbers: those of x, y and z, by number from 1 or as a heading calls them.
    roles : dict, optional
        Roles by the names of surfaces.

    Returns
    -------
    list of Surface

    Raises
    ------
    terrane.Error
        With the file and the line as its place.

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], "top")
    >>> flat.save("top.ts")
    >>> terrane.read("t*.ts", roles={"top": "horizon"})
    [<Surface 'top': horizon, 3 vertices, 1 triangle>]
    """
    options = (as_format(format), as_flag(depth, "depth"), as_number(max_edge, "max_edge", least=0),
               as_word(unit, "unit"), _columns(columns))
    of = as_mapping(roles, "roles")
    names = [name for item in (path if isinstance(path, (list, tuple)) else [path]) for name in _paths(item)]
    _core.check_reading([os.path.basename(name).encode(errors="replace").decode() for name in names], *options[:3], options[4])
    surfaces = [surface_of_parts(parts) for name in names
                for parts in _core.read(name, *options, how(threads, progress))]
    return with_roles(surfaces, of)


def with_roles(surfaces: List[Surface], roles: Mapping[str, str]) -> List[Surface]:
    """Return the surfaces with the roles that are given by name."""
    names = {s.name for s in surfaces}
    for name in roles:
        if name not in names:
            raise Error("bad_option", f"no surface is called {name}; there are {', '.join(sorted(names))}",
                        "roles")
    return [s.replace(role=roles[s.name]) if s.name in roles else s for s in surfaces]


def save(surfaces: Any, path: Path, *, format: Optional[str] = None, ascii: bool = False) -> None:
    """Write surfaces as they are to one file.

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], "top")
    >>> terrane.save([flat, flat.replace(name="base")], "both.obj")
    >>> [s.name for s in terrane.read("both.obj")]
    ['top', 'base']
    """
    mesh(as_surfaces(surfaces)).save(path, format, ascii=ascii)
