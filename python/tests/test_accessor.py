# SPDX-License-Identifier: LGPL-3.0-or-later
"""`mesh.terrane` of PyVista, by a stand-in that follows PyVista's registry of accessors and readers."""

import configparser
import importlib
import sys

import numpy as np
import pytest

import terrane
from conftest import BOX, SOURCE, sheet, stack


class OnFirstUse:
    """What PyVista's registry puts on a class: it makes the accessor of a mesh once."""

    def __init__(self, name, accessor):
        self.name, self.accessor = name, accessor

    def __get__(self, mesh, kind):
        if mesh is None:
            return self.accessor
        made = self.accessor(mesh)
        mesh.__dict__[self.name] = made
        return made


@pytest.fixture
def meshes(pyvista, monkeypatch):
    """The surfaces of `stack` as meshes of PyVista with names, where the accessor is registered."""
    class PolyData(pyvista.PolyData):
        pass

    def register_dataset_accessor(name, target, *, override=False):
        def decorate(accessor):
            setattr(target, name, OnFirstUse(name, accessor))
            return accessor
        return decorate

    pyvista.PolyData, pyvista.register_dataset_accessor = PolyData, register_dataset_accessor
    monkeypatch.delitem(sys.modules, "terrane.accessor", raising=False)
    importlib.import_module("terrane.accessor")
    terrane.save(stack(), "stack.ts")
    read = dict(sys.modules["terrane.accessor"].read("stack.ts"))
    assert list(read) == ["top", "base", "F1"]
    return list(read.values())


def test_arrange_is_that_of_the_surfaces(meshes):
    made, right = meshes[0].terrane.arrange(*meshes[1:]), terrane.round(terrane.arrange(stack()))
    assert np.array_equal(made.points, right.mesh.vertices)
    assert np.array_equal(made.cell_data["surface"], right.mesh.surfaces_of.first)
    assert meshes[0].terrane is meshes[0].terrane


def test_blocks_have_the_names_of_the_surfaces(meshes):
    right = terrane.model(stack(), box=BOX)
    assert list(meshes[0].terrane.blocks(*meshes[1:], box=BOX)) == list(right.blocks)
    assert list(meshes[0].terrane.blocks(stack()[1:], box=BOX)) == list(right.blocks)


def test_others_are_what_the_functions_make(meshes):
    top, others = meshes[0], meshes[1:]
    assert len(top.terrane.check(*others).contacts) == len(terrane.check(stack()).contacts) > 0
    assert np.array_equal(top.terrane.improve(2.0).points,
                          terrane.improve(terrane.mesh(stack()[:1]), 2.0).mesh.vertices)


@pytest.mark.tetgen
def test_tetrahedra(meshes):
    assert len(meshes[0].terrane.tetrahedra(*meshes[1:], box=BOX).kinds) > 20


def test_filled_holes_have_an_expected_error(meshes):
    s = sheet(9, 9, wave=0.1)
    centres = s.vertices[s.triangles].mean(axis=1)
    holed = s.replace(triangles=s.triangles[np.hypot(*(centres[:, :2] - 2.5).T) > 1])
    made = type(meshes[0])(holed.vertices, np.insert(holed.triangles.astype(int), 0, 3, axis=1).ravel())
    assert np.nanmax(made.terrane.fill().point_data["expected_error"]) > 0


def test_errors_are_terranes(meshes):
    with pytest.raises(terrane.Error, match="mesh_size"):
        meshes[0].terrane.fill(mesh_size=-1)


def test_readers_of_one_surface_give_a_mesh(meshes):
    sheet(name="top").save("one.ts")
    made = sys.modules["terrane.accessor"].read("one.ts")
    assert isinstance(made, type(meshes[0])) and made.field_data["name"] == ["top"]


def test_without_pyvista_or_with_an_old_one(monkeypatch, pyvista):
    monkeypatch.delitem(sys.modules, "terrane.accessor", raising=False)
    importlib.import_module("terrane.accessor")  # before 0.48 there is no registry
    monkeypatch.delitem(sys.modules, "terrane.accessor")
    monkeypatch.setitem(sys.modules, "pyvista", None)
    with pytest.raises(ImportError, match="pyvista is not installed"):
        importlib.import_module("terrane.accessor")


def test_what_pip_registers_is_there(pyvista, monkeypatch):
    monkeypatch.delitem(sys.modules, "terrane.accessor", raising=False)
    monkeypatch.syspath_prepend(SOURCE / "python")
    points = configparser.ConfigParser(delimiters="=")
    points.read_string(importlib.import_module("make_wheel").ENTRY_POINTS)
    module = importlib.import_module("terrane.accessor")
    assert dict(points["pyvista.accessors"]) == {"terrane": module.__name__}
    assert dict(points["pyvista.readers"]) == dict.fromkeys(module.EXTENSIONS, module.__name__ + ":read")
