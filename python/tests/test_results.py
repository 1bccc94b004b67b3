# SPDX-License-Identifier: LGPL-3.0-or-later
"""All results: representation, pickling, copying, equality, other packages."""

import copy
import gc
import pickle
import re
import sys
import types

import numpy as np
import pytest

import terrane
from conftest import BOX, HAS_TETGEN, SANITIZED, environment_of_python, sheet, stack, wall


def holed():
    """Return a sheet with a hole in the middle."""
    s = sheet(9, 9, wave=0.1, name="holed")
    keep = np.ones(len(s.triangles), dtype=bool)
    centres = s.vertices[s.triangles].mean(axis=1)
    keep[np.hypot(centres[:, 0] - 2.5, centres[:, 1] - 2.5) < 1.0] = False
    return s.replace(triangles=s.triangles[keep])


def project():
    """Return a project as a dict, and write its files."""
    for s in stack():
        s.save(s.name + ".ts")
    return {"format": "terrane-project 1",
            "surfaces": [{"file": s.name + ".ts", "role": s.role} for s in stack()],
            "volume_of_interest": {"box": {"low": list(BOX[0]), "high": list(BOX[1])}},
            "outputs": {"surfaces": ["vtp", "obj"], "blocks": "vtp", "gocad": True}}


MAKE = {
    "Arrangement": lambda: terrane.arrange(stack()),
    "cut Arrangement": lambda: terrane.volume_of_interest(stack(), BOX).arrangement,
    "sealed Arrangement": lambda: terrane.seal(stack(), 0.2).arrangement,
    "RoundedMesh": lambda: terrane.round(terrane.arrange(stack())),
    "Mesh": lambda: terrane.round(terrane.arrange(stack())).mesh,
    "CheckReport": lambda: terrane.check(stack()),
    "Regions": lambda: terrane.regions(terrane.round(terrane.arrange(stack()))),
    "Volumes": lambda: terrane.volumes(terrane.round(terrane.arrange(terrane.box((0, 0, 0), (1, 2, 3))))),
    "exact Volumes": lambda: terrane.volumes(terrane.arrange(terrane.box((0, 0, 0), (1, 2, 3)))),
    "Structure": lambda: terrane.structure(terrane.round(terrane.arrange(stack()))),
    "VolumeOfInterest": lambda: terrane.volume_of_interest(stack(), BOX),
    "Sealed": lambda: terrane.seal(stack(), 0.2),
    "Improved": lambda: terrane.improve(terrane.round(terrane.arrange(stack())), 1.0),
    "Filled": lambda: terrane.fill(holed()),
    "Layered": lambda: terrane.layers(stack(), {"top": 1, "base": 2}),
    "Selected": lambda: terrane.select([s.replace(name="box") for s in terrane.box((0, 0, 0), (1, 2, 3))], "box"),
    "Map": lambda: terrane.map_surface(stack(), "dip", step=1),
    "Section": lambda: terrane.section(terrane.model(stack(), box=BOX), level=0.5),
    "BlocksInCells": lambda: terrane.model(stack(), box=BOX).grid(cells=(3, 2, 5)),
    "WellLog": lambda: terrane.log_well(terrane.model(stack(), box=BOX), [(0.5, 0.5, 3), (0.5, 0.5, -1)]),
    "Model": lambda: terrane.model(stack(), box=BOX),
    "Built": lambda: terrane.build(project()),
    "IndexLists": lambda: terrane.round(terrane.arrange(stack())).mesh.surfaces_of,
}
if HAS_TETGEN:
    MAKE["Tetrahedra"] = lambda: terrane.tetrahedralize(terrane.model(terrane.box((0, 0, 0), (1, 2, 3))))


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """All results, made once."""
    import os
    before = os.getcwd()
    os.chdir(tmp_path_factory.mktemp("results"))
    made = {name: make() for name, make in MAKE.items()}
    yield made
    os.chdir(before)


@pytest.mark.parametrize("kind", MAKE)
def test_repr_is_one_line(results, kind):
    text = repr(results[kind])
    assert text.startswith("<") and text.endswith(">") and "\n" not in text and len(text) < 200
    assert kind.split()[-1] in text


@pytest.mark.parametrize("kind", [k for k in MAKE if k != "IndexLists"])
def test_html(results, kind):
    text = re.sub('base64,[^"]*', "", results[kind]._repr_html_())
    assert ("<img" in text) == (kind not in ("CheckReport", "Regions", "Structure", "WellLog"))
    assert "<table>" in text and "nan" not in text.lower().replace("inan", "")


@pytest.mark.parametrize("kind", MAKE)
def test_pickle(results, kind, tmp_path, monkeypatch):
    if kind == "Built":
        project()  # a pickle of a project has names of files
    value = results[kind]
    other = pickle.loads(pickle.dumps(value))
    assert type(other) is type(value)
    assert other == value
    assert pickle.loads(pickle.dumps(other)) == value


@pytest.mark.parametrize("kind", MAKE)
def test_copies_are_equal(results, kind):
    assert copy.copy(results[kind]) == results[kind]
    assert copy.deepcopy(results[kind]) == results[kind]


@pytest.mark.parametrize("kind", MAKE)
def test_equality_is_of_values(results, kind):
    assert results[kind] != 3
    with pytest.raises(TypeError):
        hash(results[kind])


@pytest.mark.parametrize("kind, other", [
    ("Mesh", lambda: terrane.mesh([sheet()])), ("Arrangement", lambda: terrane.arrange([sheet()])),
    ("Model", lambda: terrane.model([sheet()], box=BOX)), ("CheckReport", lambda: terrane.check([sheet()])),
    ("Regions", lambda: terrane.regions(terrane.mesh([sheet()]))), ("Filled", lambda: terrane.fill(sheet()))])
def test_other_values_differ(results, kind, other):
    assert results[kind] != other()


def test_a_restored_mesh_can_go_on(results):
    mesh = pickle.loads(pickle.dumps(results["Mesh"]))
    assert not mesh.is_proven, "a proof is not pickled"
    assert terrane.volumes(mesh) == terrane.volumes(results["Mesh"])
    assert terrane.improve(mesh, 1.0).mesh == results["Improved"].mesh


def test_a_forged_mesh_is_not_trusted():
    mesh = terrane.mesh(stack())
    forged = pickle.loads(pickle.dumps(mesh))
    with pytest.raises(terrane.Error) as raised:
        terrane.improve(forged)
    assert raised.value.code == "improper_contact"


@pytest.mark.skipif(SANITIZED, reason="the pool starts interpreters without the sanitizer")
def test_multiprocessing_spawn():
    code = """
import multiprocessing, sys
sys.path.insert(0, sys.argv[1])
import terrane
from conftest import stack
if __name__ == "__main__":
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        got = pool.map(terrane.arrange, [stack()])[0]
    assert got == terrane.arrange(stack())
    print("equal")
"""
    import pathlib
    with open("spawned.py", "w") as file:
        file.write(code)
    import subprocess
    done = subprocess.run([sys.executable, "spawned.py", str(pathlib.Path(__file__).parent)], capture_output=True,
                          text=True, env=environment_of_python())
    assert done.stdout == "equal\n", done.stderr


# --- PyVista, by the stand-in of conftest.py


@pytest.mark.parametrize("kind", ["Arrangement", "RoundedMesh", "Mesh", "Improved", "Filled", "Layered"])
def test_to_pyvista(results, kind, pyvista):
    made = results[kind].to_pyvista()
    triangles = made.faces.reshape(-1, 4)
    assert (triangles[:, 0] == 3).all() and made.points.flags.writeable
    back = terrane.as_surface(made)
    assert len(back.triangles) == len(triangles)
    assert all(len(values) == len(triangles) for values in made.cell_data.values())


def test_to_pyvista_of_models(results, pyvista):
    blocks = results["Model"].to_pyvista()
    assert set(blocks) == set(results["Model"].blocks)
    assert results["Model"].plot(show_edges=True)["show_edges"] is True
    assert set(results["Built"].to_pyvista()) == set(blocks)
    assert results["Mesh"].plot()["scalars"] == "surface"


@pytest.mark.tetgen
def test_to_pyvista_of_tetrahedra(results, pyvista):
    made = results["Tetrahedra"].to_pyvista()
    assert (made.kinds == 10).all() and len(made.cell_data["block"]) == len(made.kinds)


def test_without_pyvista_an_error_says_so(results, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyvista", None)
    with pytest.raises(ImportError, match="pyvista is not installed"):
        results["Mesh"].to_pyvista()


@pytest.mark.parametrize("kind", ["RoundedMesh", "Mesh", "Improved", "Filled", "Layered", "Model", "Built"])
def test_to_meshio(results, kind):
    pytest.importorskip("meshio")
    made = results[kind].to_meshio()
    assert len(made.cells_dict["triangle"]) > 0
    made.write("out.vtu")
    assert terrane.as_surface(made).vertices.shape[1] == 3


@pytest.mark.tetgen
def test_to_meshio_of_tetrahedra(results):
    meshio = pytest.importorskip("meshio")
    cells = results["Tetrahedra"]
    made = cells.to_meshio()
    made.write("out.vtu")
    assert np.array_equal(meshio.read("out.vtu").cells_dict["tetra"], cells.tetrahedra)


def test_vtk_reads_what_is_saved(results):
    vtk = pytest.importorskip("vtk")
    results["RoundedMesh"].save("out.vtp")
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName("out.vtp")
    reader.Update()
    assert reader.GetOutput().GetNumberOfCells() == len(results["Mesh"].triangles)


# --- Lists


def test_index_lists(results):
    lists = results["IndexLists"]
    assert len(lists) == len(lists.offsets) - 1
    assert [x.tolist() for x in lists] == [lists[i].tolist() for i in range(len(lists))]
    assert lists[-1].tolist() == lists[len(lists) - 1].tolist()
    assert lists.first.tolist() == [x[0] for x in lists]
    assert lists.contain(0).tolist() == [0 in x for x in lists]
    for bad in (len(lists), -len(lists) - 1):
        with pytest.raises(IndexError):
            lists[bad]


def test_empty_lists():
    lists = terrane.IndexLists([0, 0, 2, 2], [4, 4])
    assert lists.first.tolist() == [2**32 - 1, 4, 2**32 - 1] and lists.contain(4).tolist() == [False, True, False]


def test_references_are_counted():
    mesh = terrane.round(terrane.arrange(stack())).mesh
    core = mesh._core
    before = sys.getrefcount(core)
    views = [mesh.vertices for _ in range(10)]
    during = sys.getrefcount(core)
    del views
    gc.collect()
    after = sys.getrefcount(core)
    assert (during, after) == (before + 10, before)
