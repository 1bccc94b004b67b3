# SPDX-License-Identifier: LGPL-3.0-or-later
"""Surfaces from arrays of all kinds, and what is refused."""

import contextlib
import copy
import gc
import io
import pickle
import re

import numpy as np
import pytest

import terrane
from conftest import BOX, SOURCE, run_python, stack

V = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 1.0], [4.0, 4.0, 2.0]]
T = [[0, 1, 2], [1, 3, 2]]


def strided(array):
    """Return an equal array that is not contiguous."""
    wide = np.zeros((2 * array.shape[0], 2 * array.shape[1]), dtype=array.dtype)
    wide[::2, ::2] = array
    return wide[::2, ::2]


@pytest.mark.parametrize("dtype", ["f8", "f4", "f2", "i8", "i4", "i2", "i1", "u8", "u4", "u2", "u1", ">f8", ">i4", "g"])
def test_vertices_of_each_type(dtype):
    s = terrane.Surface(np.array(V, dtype=dtype), T)
    assert s.vertices.dtype == np.float64
    assert s.vertices.tolist() == V


@pytest.mark.parametrize("dtype", ["i8", "i4", "i2", "i1", "u8", "u4", "u2", "u1", ">i8", ">u4"])
def test_triangles_of_each_type(dtype):
    s = terrane.Surface(V, np.array(T, dtype=dtype))
    assert s.triangles.dtype == np.uint32
    assert s.triangles.tolist() == T


@pytest.mark.parametrize("make", [list, tuple, np.array, np.asfortranarray, lambda a: strided(np.array(a)),
                                  lambda a: np.array(a)[::-1][::-1], lambda a: np.matrix(a),
                                  lambda a: [np.array(r) for r in a], lambda a: [[np.float64(x) for x in r] for r in a],
                                  lambda a: np.ma.array(a)])
def test_vertices_in_each_layout(make):
    assert terrane.Surface(make(V), T).vertices.tolist() == V


@pytest.mark.parametrize("make", [list, tuple, np.array, np.asfortranarray, lambda a: strided(np.array(a)),
                                  lambda a: [[np.int64(x) for x in r] for r in a], lambda a: [tuple(r) for r in a]])
def test_triangles_in_each_layout(make):
    assert terrane.Surface(V, make(T)).triangles.tolist() == T


def test_arrays_outlive_their_names():
    s = terrane.Surface(np.array(V), np.array(T, dtype="u4"))
    gc.collect()
    assert s.vertices.tolist() == V


@pytest.mark.parametrize("attribute", ["vertices", "triangles"])
def test_arrays_are_read_only(attribute):
    s = terrane.Surface(V, T)
    with pytest.raises(ValueError):
        getattr(s, attribute)[0] = 0
    with pytest.raises(AttributeError):
        setattr(s, attribute, V)


@pytest.mark.parametrize("empty", [[], np.zeros((0, 3)), np.zeros(0), (), np.zeros((0, 3), dtype="f4")])
def test_empty_arrays_are_a_surface_without_triangles(empty):
    s = terrane.Surface(empty, [])
    assert s.vertices.shape == (0, 3) and s.triangles.shape == (0, 3)


def test_vertices_without_triangles():
    assert len(terrane.Surface(V, []).triangles) == 0


@pytest.mark.parametrize("vertices, code, words", [
    ([[0, 0], [1, 0]], "bad_option", "shape (n, 3)"),
    ([0, 0, 0], "bad_option", "shape (n, 3)"),
    (np.zeros((2, 2, 3)), "bad_option", "shape (n, 3)"),
    (np.zeros((3, 4)), "bad_option", "shape (n, 3)"),
    (np.zeros((0, 2)), "bad_option", "shape (n, 3)"),
    ([[0, 0, 0], [1, 0]], "bad_option", "3 numbers"),
    ([["a", "b", "c"]], "bad_option", "numbers"),
    (np.array([[1j, 0, 0]]), "bad_option", "complex128"),
    (np.array([[None, 0, 0]]), "bad_option", "object"),
    (5.0, "bad_option", "shape (n, 3)"),
])
def test_vertices_that_are_refused(vertices, code, words):
    with pytest.raises(terrane.Error, match="vertices") as raised:
        terrane.Surface(vertices, T)
    assert raised.value.code == code
    assert words in raised.value.sentence


@pytest.mark.parametrize("triangles, code, words", [
    ([[0, 1]], "bad_option", "shape (m, 3)"),
    ([[0, 1, 2, 3]], "bad_option", "shape (m, 3)"),
    ([0, 1, 2], "bad_option", "shape (m, 3)"),
    ([[0.0, 1.0, 2.0]], "bad_option", "integers"),
    ([[0, 1, 2.5]], "bad_option", "integers"),
    ([[True, False, True]], "bad_option", "integers"),
    ([[0, 1, 4]], "bad_index", "[0, 1, 4]"),
    ([[0, 1, 2], [0, -1, 2]], "bad_index", "[0, -1, 2]"),
    ([[0, 1, 2**32]], "bad_index", "4294967296"),
    ([[0, 1, 2], [1, 2]], "bad_option", "3 indices"),
])
def test_triangles_that_are_refused(triangles, code, words):
    with pytest.raises(terrane.Error, match="triangles") as raised:
        terrane.Surface(V, triangles)
    assert raised.value.code == code
    assert words in raised.value.sentence


def test_a_wrong_index_is_named_with_its_row():
    with pytest.raises(terrane.Error) as raised:
        terrane.Surface(V, [[0, 1, 2], [0, 1, 9]], "top")
    assert raised.value.place == "top: triangles[1]"


def test_longdouble_that_does_not_fit_is_refused():
    if np.finfo(np.longdouble).nmant <= 52:
        pytest.skip("no longer than double")
    v = np.array(V, dtype=np.longdouble)
    v[3, 0] += np.longdouble(2) ** -60
    with pytest.raises(terrane.Error, match="float64 does not"):
        terrane.Surface(v, T)


@pytest.mark.parametrize("role", terrane.ROLES)
def test_roles(role):
    assert terrane.Surface(V, T, role=role).role == role


@pytest.mark.parametrize("role", ["Fault", "", "salt", None, 3])
def test_unknown_roles_are_refused_with_the_known_ones(role):
    with pytest.raises(terrane.Error, match="unknown, horizon, fault, boundary"):
        terrane.Surface(V, T, role=role)


@pytest.mark.parametrize("name", [None, 3, b"top"])
def test_names_are_str(name):
    with pytest.raises(TypeError):
        terrane.Surface(V, T, name=name)


@pytest.mark.parametrize("name", ["", "top", "Übergang 1", "a\nb", "x" * 1000, "F1/F2", "\udcff"])
def test_any_name_goes_through_the_library(name):
    s = terrane.Surface(V, T, name)
    assert terrane.mesh([s]).surfaces[0].name == name
    assert terrane.mesh([s]).split()[0].name == name


def test_equality():
    s = terrane.Surface(V, T, "top", "horizon")
    assert s == terrane.Surface(np.array(V), np.array(T), "top", "horizon")
    assert s != s.replace(name="base") and s != s.replace(role="fault")
    assert s != s.replace(vertices=np.array(V) + 1) and s != s.replace(triangles=T[:1])
    assert s != "top"
    with pytest.raises(TypeError):
        hash(s)


def test_pickle_and_copy():
    s = terrane.Surface(V, T, "top", "horizon", terrane.Frame("m", "m", "", 1, False))
    for other in (pickle.loads(pickle.dumps(s)), copy.copy(s), copy.deepcopy(s)):
        assert other == s and other.frame == s.frame
        assert not other.vertices.flags.writeable


def test_repr_is_one_line():
    text = repr(terrane.Surface(V, T, "top", "horizon"))
    assert text == "<Surface 'top': horizon, 4 vertices, 2 triangles>"
    assert "\n" not in repr(terrane.Surface(V, T, "a\nb"))


def test_html_has_counts_and_a_picture():
    text = terrane.Surface(V, T, "<top>")._repr_html_()
    assert "<img" in text
    assert "&lt;top&gt;" in text and "<top>" not in text
    assert "triangles</td><td>2" in text


def test_html_of_nothing():
    assert "<img" not in terrane.Surface([], [])._repr_html_()


def test_bounds():
    assert terrane.Surface(V, T).bounds == ((0, 0, 0), (4, 4, 2))
    with pytest.raises(terrane.Error, match="no bounds"):
        terrane.Surface([], []).bounds


def test_replace_refuses_what_a_surface_has_not():
    with pytest.raises(TypeError, match="colour"):
        terrane.Surface(V, T).replace(colour="red")


# --- Surfaces of other packages


class Plain:
    """An object with these attributes."""

    def __init__(self, **values):
        self.__dict__.update(values)


def as_vtk_cells(triangles):
    return np.hstack([np.full((len(triangles), 1), 3), triangles]).ravel()


class Cells:
    """A block of meshio."""

    def __init__(self, kind, data):
        self.type, self.data = kind, data


FOREIGN = {
    "pyvista.PolyData": lambda: Plain(points=np.array(V, "f4"), faces=as_vtk_cells(np.array(T)), n_points=4),
    "trimesh.Trimesh": lambda: Plain(vertices=np.array(V), faces=np.array(T), edges=np.zeros((6, 2), int),
                                     triangles=np.zeros((2, 3, 3))),
    "meshio.Mesh": lambda: Plain(points=np.array(V), cell_data={}, cells=[Cells("line", [[0, 1]]),
                                                                        Cells("triangle", np.array(T))]),
    "LoopStructural": lambda: Plain(vertices=np.array(V), triangles=np.array(T), normals=np.zeros((4, 3)), name="top"),
    "GemPy": lambda: Plain(vertices=np.array(V), edges=np.array(T), name="top"),
    "tuple": lambda: (np.array(V), np.array(T)),
    "skimage.measure.marching_cubes": lambda: (np.array(V), np.array(T), np.zeros((4, 3)), np.zeros(4)),
    "Surface": lambda: terrane.Surface(V, T),
}


@pytest.mark.parametrize("package", FOREIGN)
def test_duck_typing(package):
    s = terrane.as_surface(FOREIGN[package]())
    assert s.vertices.tolist() == V and s.triangles.tolist() == T


@pytest.mark.parametrize("package", FOREIGN)
def test_stages_take_surfaces_of_other_packages(package):
    assert len(terrane.arrange([FOREIGN[package]()]).triangles) == 2


def element(name, vertices=V):
    return Plain(name=name, vertices=None if vertices is None else np.array(vertices, float), edges=np.array(T))


def test_models_of_gempy():
    groups = [Plain(is_fault=True, elements=[element("F1")]),
              Plain(is_fault=False, elements=[element("top"), element("basement", None)])]
    model = Plain(structural_frame=Plain(structural_groups=groups))
    assert [(s.name, s.role) for s in terrane.as_surfaces(model)] == [("F1", "fault"), ("top", "horizon")]
    assert len(terrane.arrange(model).surfaces) == 2
    with pytest.raises(terrane.Error, match="compute it first"):
        terrane.as_surfaces(Plain(structural_frame=Plain(structural_groups=groups[:0])))


def test_meshes_in_internal_coordinates_of_gempy_are_refused():
    with pytest.raises(terrane.Error, match="internal coordinates"):
        terrane.arrange([Plain(vertices=np.array(V), edges=np.array(T), dc_data=None)])


def test_models_of_loopstructural():
    surface = Plain(vertices=np.array(V), triangles=np.array(T), name="base of sand")
    fault = Plain(vertices=np.array(V), triangles=np.array(T), name="F1")
    model = Plain(get_stratigraphic_surfaces=lambda: [surface], get_fault_surfaces=lambda: [fault])
    assert [(s.name, s.role) for s in terrane.as_surfaces(model)] == [("base of sand", "horizon"), ("F1", "fault")]
    with pytest.raises(terrane.Error, match="no surfaces"):
        terrane.as_surfaces(Plain(get_stratigraphic_surfaces=list, get_fault_surfaces=list))


def test_the_page_on_models_of_other_programs():
    (_, y0, z0), (x1, y1, z1) = BOX
    groups = [Plain(is_fault=s.role == "fault", elements=[Plain(name=s.name, vertices=s.vertices, edges=s.triangles)])
              for s in stack()]
    gempy = Plain(structural_frame=Plain(structural_groups=groups), grid=Plain(extent=(BOX[0][0], x1, y0, y1, z0, z1)))
    loop = Plain(bounding_box=Plain(origin=BOX[0], maximum=BOX[1]), get_fault_surfaces=lambda: stack()[2:],
                 get_stratigraphic_surfaces=lambda: stack()[:2])
    page = (SOURCE / "docs/how-to/coming-from.md").read_text()
    blocks = re.findall("```python\n(.*?)```", page, re.S)
    printed = []
    for block, given in zip(blocks[:2], ({"geo_model": gempy}, {"loop_model": loop}), strict=True):
        with contextlib.redirect_stdout(io.StringIO()) as out:
            exec(block, {"terrane": terrane, **given})
        printed.append(sorted(out.getvalue().splitlines()))
    assert printed[0] == printed[1] and len(printed[0]) == len(terrane.model(stack(), box=BOX).blocks)


def test_polydata_of_vtk():
    sources = pytest.importorskip("vtkmodules.vtkFiltersSources")
    plane = sources.vtkPlaneSource()
    plane.Update()
    with pytest.raises(terrane.Error, match="vtkTriangleFilter"):
        terrane.as_surface(plane.GetOutput())
    filters = pytest.importorskip("vtkmodules.vtkFiltersCore").vtkTriangleFilter()
    filters.SetInputData(plane.GetOutput())
    filters.Update()
    s = terrane.as_surface(filters.GetOutput(), name="plane")
    assert s.triangles.shape == (2, 3) and s.bounds == ((-0.5, -0.5, 0.0), (0.5, 0.5, 0.0))


@pytest.mark.parametrize("kind", ["quad", "polygon", "triangle6"])
def test_faces_of_meshio_that_are_no_triangles_are_refused(kind):
    mixed = Plain(points=np.array(V), cell_data={}, cells=[Cells("tetra", [[0, 1, 2, 3]]), Cells("triangle", np.array(T)),
                                                          Cells(kind, [[0, 1, 2, 3]])])
    with pytest.raises(terrane.Error, match=f"no triangles: {kind}"):
        terrane.as_surface(mixed)


def test_names_of_other_packages_are_kept():
    assert terrane.as_surface(FOREIGN["GemPy"]()).name == "top"
    assert terrane.as_surface(FOREIGN["GemPy"](), name="other", role="fault").role == "fault"


def test_polydata_of_quadrilaterals_is_refused_with_advice():
    with pytest.raises(terrane.Error, match="triangulate"):
        terrane.as_surface(Plain(points=np.array(V), faces=np.array([4, 0, 1, 3, 2])))


def test_meshio_without_triangles():
    with pytest.raises(terrane.Error, match="no triangles"):
        terrane.as_surface(Plain(points=np.array(V), cell_data={}, cells=[Cells("tetra", [[0, 1, 2, 3]])]))


def test_real_meshio():
    meshio = pytest.importorskip("meshio")
    s = terrane.as_surface(meshio.Mesh(np.array(V), [("triangle", np.array(T))]))
    assert s.triangles.tolist() == T


@pytest.mark.parametrize("value", [3, None, "top.ts", object(), [1, 2], np.zeros((3, 3))])
def test_what_is_no_surface_is_refused(value):
    with pytest.raises(TypeError):
        terrane.arrange(value)


def test_dicts_name_their_surfaces():
    a = terrane.arrange({"top": (V, T), "base": (V, T)})
    assert [s.name for s in a.surfaces] == ["top", "base"]


def test_one_surface_and_generators():
    assert len(terrane.arrange(terrane.Surface(V, T)).triangles) == 2
    assert len(terrane.arrange(terrane.Surface(V, T) for _ in range(2)).surfaces) == 2


def test_import_needs_no_other_package():
    run_python("import sys, terrane; bad = {'pyvista', 'meshio', 'trimesh', 'matplotlib', 'scipy'} & set(sys.modules);"
               "assert not bad, bad")


POINT_DATA = {"height": [1.0, 5.0, 1.0, 5.0], "flow": np.arange(12, dtype=np.float32).reshape(4, 3),
              "code": np.array([1, 2, 3, 4], dtype=">u2"), "flag": [True, False, True, False], "rock": ["b", "a", "b", "c"]}
CELL_DATA = {"number": np.array([2**63 - 1, -2**63])}


def with_values():
    return terrane.Surface(V, T, "top", point_data=POINT_DATA, cell_data=CELL_DATA)


def test_values_keep_their_types_and_cannot_be_changed():
    s = with_values()
    assert {name: a.dtype.str for name, a in s.point_data.items()} == {
        "height": "<f8", "flow": "<f4", "code": "<u2", "flag": "|u1", "rock": "|O"}
    for name, given in POINT_DATA.items():
        assert np.array_equal(s.point_data[name], given), name
        with pytest.raises(ValueError):
            s.point_data[name][0] = s.point_data[name][1]
    assert s.cell_data["number"].tolist() == [2**63 - 1, -2**63]


def test_values_are_part_of_a_surface():
    s = with_values()
    assert pickle.loads(pickle.dumps(s)) == s == copy.deepcopy(s)
    assert s != terrane.Surface(V, T, "top")
    assert s != s.replace(cell_data={"number": np.array([1, 2])})
    assert s.replace(name="a").point_data.keys() == s.point_data.keys()
    assert s.replace(point_data={}).cell_data.keys() == {"number"}
    assert not s.replace(triangles=T[:1]).point_data


def test_values_of_files(tmp_path):
    s = with_values()
    s.save(tmp_path / "a.vtp")
    read = terrane.read(tmp_path / "a.vtp")[0]
    assert read.point_data["rock"].tolist() == POINT_DATA["rock"]
    assert np.array_equal(read.point_data["flow"], POINT_DATA["flow"])
    assert read.cell_data["number"].tolist() == [2**63 - 1, -2**63]
    with pytest.warns(UserWarning, match="no place for these values: height, flow, code, flag, rock, number"):
        s.save(tmp_path / "a.off")
    (tmp_path / "b.ts").write_text("GOCAD TSurf 1\nHEADER {\nname:b\n}\nPROPERTIES p\nUNITS m\nNO_DATA_VALUES -9\nTFACE\n"
                                   "PVRTX 1 0 0 0 1\nPVRTX 2 1 0 0 -9\nPVRTX 3 0 1 0 3\nTRGL 1 2 3\nEND\n")
    b = terrane.read(tmp_path / "b.ts")[0]
    assert (b.point_data["p"].tolist(), b.units, b.no_data) == ([1, -9, 3], {"p": "m"}, {"p": -9})
    assert pickle.loads(pickle.dumps(b)).no_data == b.no_data


def test_values_are_carried_to_a_mesh():
    wall = terrane.Surface([[1, 1, -9], [1, 1, 9], [1, 9, 0]], [[0, 1, 2]], "F1")
    s = with_values()
    mesh = terrane.round(terrane.arrange([s, wall])).mesh
    top, cut = mesh.split([s, wall])
    assert not cut.point_data and not mesh.split()[0].point_data
    assert np.allclose(top.point_data["height"], 1 + top.vertices[:, 0], rtol=0, atol=1e-14)
    assert set(top.point_data["rock"]) == {"a", "b", "c"}
    assert len(top.triangles) > 2
    assert set(top.cell_data["number"].tolist()) == {2**63 - 1, -2**63}


def test_values_to_and_from_pyvista(pyvista):
    made = with_values().to_pyvista()
    assert made.point_data["height"].tolist() == POINT_DATA["height"]
    assert made.cell_data["number"].tolist() == [2**63 - 1, -2**63]
    assert terrane.as_surface(made, name="top") == with_values()


@pytest.mark.parametrize("values", [[1, 2], [1, 2, 3, 1j], np.zeros((4, 0)), np.zeros((4, 1, 1)), [None] * 4, 3])
def test_values_that_are_refused(values):
    with pytest.raises(terrane.Error) as e:
        terrane.Surface(V, T, "top", point_data={"a": values})
    assert e.value.code == "bad_option"
    assert e.value.place == "top: point_data['a']"
