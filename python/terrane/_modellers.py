# SPDX-License-Identifier: LGPL-3.0-or-later
"""Surfaces of programs that model and draw, none of which is needed: attributes decide."""

from __future__ import annotations

from typing import Any, List, Optional, Tuple

import numpy as np

from ._errors import Error, bad_option
from ._interop import package


def surfaces_of_model(model: Any) -> Optional[List[Tuple[Any, str]]]:
    """Return the surfaces of a model of GemPy or LoopStructural, with their roles; None of anything else.

    Both give them in the coordinates of their users.
    """
    groups = getattr(getattr(model, "structural_frame", None), "structural_groups", None)
    if groups is not None:
        found = [(element, "fault" if group.is_fault else "horizon") for group in groups for element in group.elements
                 if element.vertices is not None and len(element.vertices) > 0]
        if not found:
            raise Error("nothing_to_do", "the model of GemPy has no meshes: compute it first", "surfaces")
        return found
    horizons, faults = (getattr(model, f"get_{kind}_surfaces", None) for kind in ("stratigraphic", "fault"))
    if not callable(horizons) or not callable(faults):
        return None
    found = [(surface, "horizon") for surface in horizons()] + [(surface, "fault") for surface in faults()]
    if not found:
        raise Error("nothing_to_do", "the model of LoopStructural has no surfaces", "surfaces")
    return found


def refuse_internal_coordinates(value: Any) -> None:
    """Refuse a mesh of GemPy's dual contouring, whose coordinates are not those of the user."""
    if hasattr(value, "dc_data"):
        raise bad_option("the mesh has GemPy's internal coordinates; give its GeoModel, or elements of its "
                         "structural_frame", "surfaces")


def parts_of_vtk(value: Any) -> Optional[Tuple[Any, Any]]:
    """Return points and triangles of a vtkPolyData; None of anything else."""
    if not hasattr(value, "GetPolys") or not hasattr(value, "GetStrips"):
        return None
    vtk_to_numpy = package("vtkmodules.util.numpy_support", "a vtkPolyData").vtk_to_numpy
    polygons = value.GetPolys()
    offsets = vtk_to_numpy(polygons.GetOffsetsArray())
    if value.GetStrips().GetNumberOfCells() > 0 or np.any(np.diff(offsets) != 3):
        raise bad_option("cells are not all triangles; use vtkTriangleFilter first", "polys")
    if value.GetPoints() is None:
        return np.zeros((0, 3)), np.zeros((0, 3), np.int64)
    return vtk_to_numpy(value.GetPoints().GetData()), vtk_to_numpy(polygons.GetConnectivityArray()).reshape(-1, 3)
