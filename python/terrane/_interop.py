# SPDX-License-Identifier: LGPL-3.0-or-later
"""Results for other packages, none of which is needed otherwise."""

from __future__ import annotations

import importlib
from typing import Any, Dict, List

import numpy as np


def package(name: str, purpose: str) -> Any:
    """Return a package that only `purpose` needs."""
    try:
        return importlib.import_module(name)
    except ImportError:
        raise ImportError(f"{name} is not installed, which {purpose} needs") from None


def _vtk_cells(cells: Any) -> Any:
    """Return cells as VTK lists them: the number of corners, then the corners."""
    array = np.asarray(cells, dtype=np.int64)
    corners = np.full((len(array), 1), array.shape[1], dtype=np.int64)
    return np.hstack([corners, array])


def polydata(vertices: Any, triangles: Any, arrays: Dict[str, Any]) -> Any:
    """Return a ``pyvista.PolyData`` with arrays per triangle."""
    pyvista = package("pyvista", "to_pyvista()")
    made = pyvista.PolyData(np.array(vertices), _vtk_cells(triangles).reshape(-1))
    for name, values in arrays.items():
        made.cell_data[name] = np.asarray(values).astype(np.int32)
    return made


def unstructured_grid(vertices: Any, tetrahedra: Any, arrays: Dict[str, Any]) -> Any:
    """Return a ``pyvista.UnstructuredGrid`` of tetrahedra with arrays per cell."""
    pyvista = package("pyvista", "to_pyvista()")
    kinds = np.full(len(tetrahedra), 10, dtype=np.uint8)  # VTK_TETRA
    made = pyvista.UnstructuredGrid(_vtk_cells(tetrahedra).reshape(-1), kinds, np.array(vertices))
    for name, values in arrays.items():
        made.cell_data[name] = np.asarray(values).astype(np.int32)
    return made


def meshio_mesh(vertices: Any, cells: Dict[str, Any], arrays: Dict[str, List[Any]]) -> Any:
    """Return a ``meshio.Mesh``; `arrays` have one array per block of cells."""
    meshio = package("meshio", "to_meshio()")
    return meshio.Mesh(np.array(vertices), [(kind, np.array(rows, dtype=np.int64))
                                            for kind, rows in cells.items()], cell_data=arrays)
