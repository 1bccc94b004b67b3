# SPDX-License-Identifier: LGPL-3.0-or-later
"""Terrane on meshes of PyVista 0.48 and newer: ``mesh.terrane.blocks(...)``, and ``pyvista.read("top.ts")``.

PyVista finds both where the package was installed by pip; elsewhere ``import terrane.accessor`` registers the accessor. A
mesh is one surface. Its name and role are in ``field_data["name"]`` and ``field_data["role"]``, where `read` puts them.
Others that a method takes are such meshes, or what `terrane.as_surfaces` takes. Errors are `terrane.Error`.
"""

from __future__ import annotations

from typing import Any, List, Sequence

import terrane

from ._interop import package
from ._surface import Surface, as_surface, as_surfaces

pyvista = package("pyvista", "terrane.accessor")

#: Extensions that `read` is registered for: those of geologists, which PyVista does not read.
EXTENSIONS = (".ts", ".ml", ".gp", ".irap", ".gri", ".zmap", ".cps3")


def read(path: Any, **options: Any) -> Any:
    """Return the ``pyvista.PolyData`` of the surface in a file, or a ``pyvista.MultiBlock`` of several by name.

    Parameters
    ----------
    path : path
    **options
        Those of `terrane.read`.
    """
    made = []
    for surface in terrane.read(path, **options):
        made.append(surface.to_pyvista())
        made[-1].field_data["name"], made[-1].field_data["role"] = [surface.name], [surface.role]
    if len(made) == 1:
        return made[0]
    blocks = pyvista.MultiBlock()
    for mesh in made:
        blocks[str(mesh.field_data["name"][0])] = mesh
    return blocks


def _surfaces(mesh: Any) -> List[Surface]:
    if not isinstance(mesh, pyvista.PolyData):
        return as_surfaces(mesh)
    said = {key: str(mesh.field_data[key][0]) for key in ("name", "role") if key in mesh.field_data}
    return [as_surface(mesh, **said)]


class TerraneAccessor:
    """What Terrane makes of a mesh of triangles, alone or with others. Options are those of the functions that are named."""

    def __init__(self, mesh: Any) -> None:
        self._mesh = mesh

    def _all(self, others: Sequence[Any]) -> List[Surface]:
        return [surface for mesh in (self._mesh, *others) for surface in _surfaces(mesh)]

    def arrange(self, *others: Any, **options: Any) -> Any:
        """Return one conforming mesh with the curves where surfaces meet, as `terrane.round` of `terrane.arrange`.

        Returns
        -------
        pyvista.PolyData
            With ``cell_data["surface"]``: 0 for this mesh, then the others in their order.
        """
        return terrane.round(terrane.arrange(self._all(others), **options)).to_pyvista()

    def blocks(self, *others: Any, box: Any = None, **options: Any) -> Any:
        """Return the closed blocks that the surfaces enclose, a ``pyvista.MultiBlock`` by name, as `terrane.model`."""
        return terrane.model(self._all(others), box, **options).to_pyvista()

    def check(self, *others: Any, **options: Any) -> terrane.CheckReport:
        """Return where triangles cross, touch, overlap or repeat, as `terrane.check`."""
        return terrane.check(self._all(others), **options)

    def fill(self, **options: Any) -> Any:
        """Return the surface without its holes, with ``point_data["expected_error"]``, as `terrane.fill`."""
        return terrane.fill(self._all(())[0], **options).to_pyvista()

    def improve(self, edge_length: float = 0, **options: Any) -> Any:
        """Return better triangles within a proven distance, as `terrane.improve`."""
        return terrane.improve(terrane.mesh(self._all(())), edge_length, **options).to_pyvista()

    def tetrahedra(self, *others: Any, box: Any = None, edge_length: Any = None, **options: Any) -> Any:
        """Return tetrahedra in all blocks, a ``pyvista.UnstructuredGrid``, as `terrane.Model.tetrahedra`."""
        return terrane.model(self._all(others), box).tetrahedra(edge_length, **options).to_pyvista()


if hasattr(pyvista, "register_dataset_accessor"):
    pyvista.register_dataset_accessor("terrane", pyvista.PolyData)(TerraneAccessor)
