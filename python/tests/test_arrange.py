# SPDX-License-Identifier: LGPL-3.0-or-later
"""Arranging, rounding, checking: against the program's files, the verifier, and laws."""

import gc
import subprocess
import sys
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import terrane
from conftest import DATA, SANITIZED, run_program, sheet, stack, wall

SOURCES = [("top.ts", "base.ts", "fault.ts"), ("body.ts",), ("salt.ts", "shale.ts"), ("fold.ts", "fault.ts"),
           ("top.ts",), ("seabed.asc", "salt.ts")]


@pytest.mark.parametrize("names", SOURCES, ids="+".join)
@pytest.mark.parametrize("ending", ["vtp", "obj", "ts", "ply"])
def test_files_are_those_of_the_program(names, ending):
    files = [DATA / name for name in names]
    status, _, text = run_program("arrange", *files, "-o", f"program.{ending}")
    assert status == 0, text
    terrane.round(terrane.arrange(terrane.read(files))).save(f"python.{ending}")
    assert open(f"python.{ending}", "rb").read() == open(f"program.{ending}", "rb").read()


@pytest.mark.parametrize("threads", [1, 2, 3, np.int64(2), np.uint8(1)])
def test_threads_change_nothing(threads, arrangement):
    assert terrane.arrange(stack(), threads=threads) == arrangement


@pytest.mark.parametrize("search", ["auto", "grid", "ab", "ab-balanced", "ab-median", "mixed", "hierarchy", "brute"])
def test_search_changes_nothing(search, arrangement):
    assert terrane.arrange(stack(), search=search) == arrangement


@pytest.mark.parametrize("threads", [0, -1, 5000, 2.0, "2", True])
def test_threads_that_are_refused(threads):
    with pytest.raises((terrane.Error, TypeError), match="threads"):
        terrane.arrange(stack(), threads=threads)


def test_search_that_is_refused():
    with pytest.raises(terrane.Error, match="ab-balanced"):
        terrane.arrange(stack(), search="fast")


@pytest.mark.parametrize("name, dtype, columns", [
    ("vertices", "f8", 3), ("triangles", "u4", 3), ("intersection_edges", "u4", 2), ("degenerate", "u4", None),
    ("duplicates", "u4", 2), ("first_triangle", "u4", None)])
def test_arrays_of_an_arrangement(arrangement, name, dtype, columns):
    array = getattr(arrangement, name)
    assert array.dtype == dtype and not array.flags.writeable
    assert array.shape[1:] == (() if columns is None else (columns,))
    with pytest.raises(ValueError):
        array.flags.writeable = True


@pytest.mark.parametrize("name", ["vertices", "triangles", "intersection_edges"])
def test_arrays_of_a_mesh_keep_it_alive(name):
    mesh = terrane.round(terrane.arrange(stack())).mesh
    array, copied = getattr(mesh, name), np.array(getattr(mesh, name))
    lists = mesh.parents_of
    values = np.array(lists.values)
    del mesh
    gc.collect()
    junk = [np.ones(array.size * 8) for _ in range(8)]
    assert np.array_equal(array, copied) and np.array_equal(lists.values, values) and junk


def test_views_are_no_copies(rounded):
    assert np.shares_memory(rounded.mesh.vertices, rounded.mesh.vertices)


def test_each_triangle_names_its_parents(arrangement):
    assert len(arrangement.parents_of) == len(arrangement.triangles) == len(arrangement.surfaces_of)
    total = arrangement.first_triangle[-1]
    assert arrangement.parents_of.values.max() < total
    assert set(np.unique(arrangement.parents_of.values)) == set(range(total))


def test_coordinates_are_exact():
    flat = terrane.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    cut = terrane.Surface([[0.25, -1, -1], [0.25, -1, 2], [0.25, 3, 0.3]], [[0, 1, 2]])
    a = terrane.arrange([flat, cut])
    found = [a.coordinates(v) for v in range(len(a.vertices))]
    assert (Fraction(1, 4), Fraction(3, 4), Fraction(0)) in found
    for exact, near in zip(found, a.vertices):
        assert [float(x) for x in exact] == near.tolist()


def test_constructions_name_input_vertices(arrangement):
    kinds = {arrangement.construction(v)[0] for v in range(len(arrangement.vertices))}
    assert {"input", "line_plane"} <= kinds
    kind, numbers = arrangement.construction(0)
    assert kind == "input" and len(numbers) == 1


@pytest.mark.parametrize("vertex", [-1, 10**6, 1.0, "0"])
def test_vertices_that_do_not_exist(arrangement, vertex):
    with pytest.raises((terrane.Error, TypeError)):
        arrangement.coordinates(vertex)


def test_digest_is_the_program_s():
    run_program("arrange", DATA / "top.ts", DATA / "fault.ts", "-o", "a.vtp", "--certificate", "c.json")
    import json
    a = terrane.arrange(terrane.read([DATA / "top.ts", DATA / "fault.ts"]))
    assert a.digest() == json.load(open("c.json"))["digest"]


def test_the_order_of_files_does_not_change_the_digest():
    first, second, third = stack()
    assert terrane.arrange([first, second, third]).digest() == terrane.arrange([third, first, second]).digest()


def test_arranging_twice_changes_nothing(rounded):
    again = terrane.arrange(rounded.mesh.split())
    assert len(again.triangles) == len(rounded.mesh.triangles)
    assert again.statistics["constructed_points"] == 0


def test_rounded_mesh(rounded):
    assert rounded.clean and rounded.mesh.is_proven
    assert rounded.report.contacts == [] and rounded.report.max_move < 1e-12
    assert len(rounded.regions) == len(terrane.regions(rounded).regions)
    assert terrane.check(rounded).clean
    assert bool(terrane.verify(rounded.mesh))


def test_regions_are_parallel_to_surfaces(rounded):
    found = terrane.regions(rounded.mesh)
    assert found.regions_of == rounded.mesh.regions_of
    assert np.array_equal(found.regions_of.offsets, rounded.mesh.surfaces_of.offsets)
    assert sum(r.triangles for r in found.regions) == len(found.regions_of.values)


def test_check_finds_what_crosses():
    report = terrane.check(stack())
    assert not report and not report.clean and report.contacts
    contact = report.contacts[0]
    assert contact.kind in ("crossing", "edges cross", "edge on face", "vertex on face", "vertex on edge")
    assert len(contact.triangles) == 2 and len(contact.place) == 3


@pytest.mark.parametrize("flaw, count", [("degenerate", 1), ("repeated", 1), ("shared", 0)])
def test_check_finds_each_flaw(flaw, count):
    v = [[0, 0, 0], [4, 0, 0], [0, 4, 0], [2, 0, 0]]
    t = {"degenerate": [[0, 1, 2], [0, 1, 3]], "repeated": [[0, 1, 2], [1, 2, 0]], "shared": [[0, 1, 2]]}[flaw]
    report = terrane.check(terrane.Surface(v, t))
    assert len(getattr(report, flaw)) == count


def test_a_report_has_no_other_attributes():
    with pytest.raises(AttributeError, match="colour"):
        terrane.check(stack()).colour


@pytest.mark.parametrize("surfaces", [[], [terrane.Surface([], [])], [terrane.Surface([[0, 0, 0]], [])]])
def test_nothing_is_arranged_to_nothing(surfaces):
    a = terrane.arrange(surfaces)
    assert len(a.triangles) == 0 and len(a.vertices) == 0 and len(a.surfaces) == len(surfaces)
    assert len(terrane.round(a).mesh.triangles) == 0


def test_max_rounds():
    assert terrane.round(terrane.arrange(stack()), max_rounds=0).report.rounds == 0
    for bad in (-1, 9, 1.5):
        with pytest.raises((terrane.Error, TypeError), match="max_rounds"):
            terrane.round(terrane.arrange(stack()), max_rounds=bad)


def test_surfaces_move_no_farther_than_allowed():
    arrangement = terrane.arrange(terrane.read([DATA / name for name in SOURCES[0]]))
    free = terrane.round(arrangement).report
    assert 0 < free.surface_deviation <= free.deviation <= free.max_allowed
    bound = terrane.round(arrangement, max_move=1e-6).report
    assert bound.clean and bound.max_allowed == 1e-6 >= bound.surface_deviation
    with pytest.raises(terrane.Error) as raised:
        terrane.round(arrangement, max_move=1e-300)
    assert raised.value.code == "bad_option"


@pytest.mark.parametrize("move", [0, -1, np.nan, np.inf, "far", True])
@pytest.mark.parametrize("stage", [
    lambda move: terrane.round(terrane.arrange(stack()), max_move=move),
    lambda move: terrane.model(stack(), max_move=move),
    lambda move: terrane.layers(stack(), {"top": 1, "base": 2}, max_move=move)], ids=["round", "model", "layers"])
def test_moves_that_are_refused(stage, move):
    with pytest.raises((terrane.Error, TypeError), match="max_move"):
        stage(move)


def test_what_has_no_arrangement_is_refused():
    with pytest.raises(TypeError, match="arrangement"):
        terrane.round(stack())


def test_progress_is_told():
    seen = []
    terrane.round(terrane.arrange([sheet(60, 60), wall()], progress=lambda *a: seen.append(a)))
    assert seen and all(isinstance(stage, str) and 0 <= share <= 1 for stage, share in seen)


def test_progress_bars_are_fed():
    class Bar:
        total, n, text = None, 0, ""

        def update(self, more):
            self.n += more

        def set_description(self, text, refresh=True):
            self.text = text
    bar = Bar()
    terrane.arrange([sheet(60, 60), wall()], progress=bar)
    assert bar.text and 0 < bar.n <= bar.total


@pytest.mark.parametrize("progress", [3, "bar", object()])
def test_progress_that_is_refused(progress):
    with pytest.raises(TypeError, match="progress"):
        terrane.arrange(stack(), progress=progress)


def test_volume_of_interest():
    inside = terrane.volume_of_interest(stack(), ((0.2, 0.2, -2), (4.8, 4.8, 2)))
    assert len(inside.surfaces) == 9
    whole = terrane.arrange(stack())
    assert whole.vertices[:, 0].max() > 4.8 >= inside.arrangement.vertices[:, 0].max()
    assert terrane.volumes(terrane.round(inside)).total == pytest.approx(4.6 * 4.6 * 4)


@pytest.mark.parametrize("box", [((0, 0, 0), (0, 1, 1)), ((0, 0), (1, 1)), (1, 2, 3), "box", [None], ((0, 0, 0), (1, 1, np.nan))])
def test_boxes_that_are_refused(box):
    with pytest.raises((terrane.Error, TypeError)):
        terrane.volume_of_interest(stack(), box)


def test_open_boundary_is_refused():
    with pytest.raises(terrane.Error) as raised:
        terrane.closed(terrane.box((0, 0, 0), (1, 1, 1))[:5])
    assert raised.value.code == "not_closed"


def test_polygon_that_crosses_itself():
    with pytest.raises(terrane.Error) as raised:
        terrane.polygon([[0, 0], [1, 1], [1, 0], [0, 1]], 0, 1)
    assert raised.value.code == "improper_contact"


def test_improper_contact_is_refused_when_saved():
    thin = [terrane.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])]
    r = terrane.round(terrane.arrange(thin))
    bad = terrane.RoundedMesh(r.mesh, r.regions, r.report._replace(clean=False))
    with pytest.raises(terrane.Error) as raised:
        bad.save("bad.vtp")
    assert raised.value.code == "improper_contact"
    bad.save("bad.vtp", keep_unverified=True)


# Small lattices, so that degenerate positions are common.
CORNER = st.tuples(*[st.integers(-3, 3)] * 3)
SOUP = st.lists(st.tuples(CORNER, CORNER, CORNER), min_size=1, max_size=8)


@settings(max_examples=20 if SANITIZED else 80, deadline=None, suppress_health_check=[HealthCheck.too_slow,
                                                        HealthCheck.function_scoped_fixture])
@given(SOUP, st.sampled_from(["f8", "f4", "i8"]), st.sampled_from([1.0, 2.0**-20, 2.0**40]))
def test_random_soups_hold_for_the_verifier(soup, dtype, scale):
    v = np.array(soup, dtype=np.float64).reshape(-1, 3) * scale
    if dtype == "f4" or scale >= 1:
        v = v.astype(dtype)
    s = terrane.Surface(v, np.arange(len(v)).reshape(-1, 3))
    a = terrane.arrange([s])
    assert terrane.verify(a).violations == []
    r = terrane.round(a)
    assert r.clean and terrane.verify(r.mesh)


@settings(max_examples=15 if SANITIZED else 40, deadline=None,
          suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture])
@given(st.data())
def test_random_layouts_give_equal_results(data):
    """An array's type, order and strides do not matter."""
    n = data.draw(st.integers(1, 6))
    v = np.array(data.draw(st.lists(CORNER, min_size=3 * n, max_size=3 * n)))
    t = np.arange(3 * n).reshape(-1, 3)
    expected = terrane.arrange([terrane.Surface(v.astype("f8"), t.astype("u4"))])
    layout = data.draw(st.sampled_from([np.asfortranarray, lambda a: a.tolist(), lambda a: np.repeat(a, 2, 0)[::2],
                                        lambda a: a[::-1].copy()[::-1]]))
    dtype = data.draw(st.sampled_from(["f8", "f4", "f2", "i1", ">i4", ">f8"]))
    got = terrane.arrange([terrane.Surface(layout(v.astype(dtype)), layout(t.astype(data.draw(
        st.sampled_from(["i1", "i4", "u8"])))))])
    assert np.array_equal(got.vertices, expected.vertices)
    assert np.array_equal(got.triangles, expected.triangles)


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.one_of(st.lists(st.lists(st.floats(width=32), max_size=4), max_size=4),
                 st.lists(st.lists(st.integers(-2**65, 2**65), min_size=3, max_size=3), max_size=4)),
       st.lists(st.lists(st.integers(-2**33, 2**33), min_size=2, max_size=4), max_size=3))
def test_any_lists_are_a_surface_or_an_error(vertices, triangles):
    try:
        s = terrane.Surface(vertices, triangles)
        terrane.check([s])
    except terrane.Error as error:
        assert error.code in ("bad_option", "bad_index", "bad_number")


FAULTS_OF_CALLS = """
import resource, sys
import numpy as np, terrane
if sys.argv[1] == "kept":
    terrane.keep_freed_memory()
x, y = (a.ravel() for a in np.meshgrid(np.linspace(0, 1, 300), np.linspace(0, 1, 300)))
i = (np.arange(299)[:, None] * 300 + np.arange(299)).ravel()
sheet = terrane.Surface(np.c_[x, y, 0 * x], np.r_[np.c_[i, i + 1, i + 301], np.c_[i, i + 301, i + 300]])
wall = terrane.Surface([[.5, -1, -1], [.5, 2, -1], [.5, .5, 2]], [[0, 1, 2]])
for _ in range(4):
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    terrane.arrange([sheet, wall], threads=1)
print(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
"""


@pytest.mark.skipif(SANITIZED, reason="the sanitizer has an allocator of its own")
def test_freed_memory_is_kept():
    """The last of four calls asks the system for hardly any page."""
    faults = {name: int(subprocess.run([sys.executable, "-c", FAULTS_OF_CALLS, name], check=True, capture_output=True).stdout)
              for name in ("default", "kept")}
    assert faults["default"] > 1000 and faults["kept"] < faults["default"] / 10
