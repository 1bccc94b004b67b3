# SPDX-License-Identifier: LGPL-3.0-or-later
"""Better triangles."""

from __future__ import annotations

from typing import Any, Dict, Mapping, Optional

import numpy as np

from . import _core
from ._arrays import Float64Array, UInt32Array, as_count, as_flag, as_mapping, as_number
from ._blocks import Volumes
from ._errors import bad_option
from ._mesh import Mesh, OnMesh, mesh_of, proven
from ._run import describing, how
from ._surface import as_surface, parts_of_surfaces

_OPTIONS = tuple(field["name"] for field in _core.improve_fields if field["type"] == "double")


class Improved(OnMesh):
    """An improved mesh: conforming, with the same blocks, regions, lines and corners.

    Attributes
    ----------
    mesh : Mesh
    volumes : Volumes
        Of the mesh.
    near_of : ndarray, uint32
        Per triangle a triangle of the mesh before, near its centroid.
    bounds : ndarray, float64
        Per surface no point of it is farther from the mesh before; unit of the input.
    deviations : ndarray, shape (s, 2), float64
        Per surface the measured distance from the new to the old mesh, and back.
    report : dict
        Counts of changes, and why the worst triangle cannot be better.
    resolution : dict, or None
        What was joined at a resolution, and how blocks and contacts changed by it; None: nothing was asked for.

    Examples
    --------
    >>> better = ...
    >>> better
    <Improved: 244 triangles, within 0.05 of the mesh before>
    >>> bool(better.bounds.max() <= 0.05)
    True
    """

    __slots__ = ("mesh", "volumes", "near_of", "bounds", "deviations", "report", "resolution")

    def __init__(self, mesh: Mesh, volumes: Volumes, near_of: UInt32Array, bounds: Float64Array,
                 deviations: Float64Array, report: Dict[str, Any], resolution: Optional[Dict[str, Any]] = None) -> None:
        self.mesh = mesh
        self.volumes = volumes
        self.near_of = near_of
        self.bounds = bounds
        self.deviations = deviations
        self.report = report
        self.resolution = resolution

    def _line(self) -> str:
        largest = float(np.max(self.bounds)) if len(self.bounds) else 0.0
        return f"{len(self.mesh.triangles)} triangles, within {_core.figure(largest, 3)} of the mesh before"

    def _numbers(self) -> Dict[str, Any]:
        return {**self.mesh._numbers(), "splits": self.report["splits"],
                "collapses": self.report["collapses"], "swaps": self.report["swaps"]}



def improve_options(mesh: Mesh, edge_length: float, options: Mapping[str, Any]) -> Dict[str, Any]:
    """Return the options of `improve`, checked."""
    values: Dict[str, Any] = {"passes": as_count(options.get("passes", 6), "passes", 1, 100)}
    values["dissolve"] = as_flag(options.get("dissolve", False), "dissolve")
    if values["dissolve"] and not options.get("resolution"):
        raise bad_option("needs a resolution", "dissolve")
    for name, value in {"edge_length": edge_length, **options}.items():
        if name in ("passes", "edge_length_of", "dissolve"):
            continue
        if name not in _OPTIONS:
            raise TypeError(f"improve() has no option {name}; it has {', '.join(_OPTIONS)}")
        values[name] = as_number(value, name, least=0)
    lengths_of = as_mapping(options.get("edge_length_of"), "edge_length_of")
    if lengths_of:
        names = [s.name for s in mesh.surfaces]
        lengths = [0.0] * len(names)
        for name, length in lengths_of.items():
            if name not in names:
                raise bad_option(f"no surface is called {name}; there are {', '.join(names)}", "edge_length_of")
            for i, own in enumerate(names):
                if own == name:
                    lengths[i] = as_number(length, f"edge_length_of[{name!r}]", least=0)
        values["edge_length_of"] = lengths
    return values


@describing(_core.improve_fields)
def improve(mesh: Any, edge_length: float = 0, *, max_deviation: float = 0,
            edge_length_of: Optional[Mapping[str, float]] = None, passes: int = 6,
            resolution: float = 0, dissolve: bool = False,
            threads: Optional[int] = None, progress: Any = None, **options: float) -> Improved:
    """Remesh a conforming mesh with better triangles.

    Parameters
    ----------
    mesh : Mesh, or a result with one
    OPTIONS
    **options : float
        Those of them that the signature does not have.
    edge_length_of : dict, optional
        Wanted length of edges on one surface; None: `edge_length`.

    Examples
    --------
    >>> import terrane
    >>> mesh = terrane.round(terrane.arrange(terrane.box((0, 0, 0), (1, 1, 1)))).mesh
    >>> better = terrane.improve(mesh, 0.25)
    >>> len(better.mesh.triangles) > 100, better.report["sides_kept"]
    (True, True)
    >>> flat = [terrane.Surface([[0, 0, z], [4, 0, z], [4, 4, z], [0, 4, z]], [[0, 1, 2], [0, 2, 3]], f"h{z}", "horizon")
    ...         for z in (0, 0.1)]
    >>> joined = terrane.improve(terrane.model(flat, box=((0, 0, -1), (4, 4, 2))).mesh, 1.0, resolution=0.3,
    ...                          dissolve=True)
    >>> len(joined.volumes.measures), [block["parts"] for block in joined.resolution["blocks"]]
    (3, [0])
    """
    whole = proven(mesh_of(mesh), threads, progress)
    values = improve_options(whole, edge_length, {"max_deviation": max_deviation, "passes": passes,
                                                  "edge_length_of": edge_length_of, "resolution": resolution,
                                                  "dissolve": dissolve, **options})
    core, volumes, near_of, bounds, _, deviations, report, joined = _core.improve(whole._core, values,
                                                                                  how(threads, progress))
    made = Mesh(core)
    return Improved(made, Volumes(volumes, made), near_of, bounds, deviations, report, joined)


def distance(from_surface: Any, to_surface: Any, *, threads: Optional[int] = None, progress: Any = None) -> float:
    """Return the largest distance of a point of one surface to another (one-sided Hausdorff), within 5 %.

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
    >>> terrane.distance(flat, flat.replace(vertices=flat.vertices + [0, 0, 2]))
    2.0
    """
    return _core.distance(parts_of_surfaces([as_surface(from_surface)]),
                          parts_of_surfaces([as_surface(to_surface)]), how(threads, progress))
