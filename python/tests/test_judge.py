# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes judged by their inputs."""

import pathlib
import shutil
import subprocess
import sys
import textwrap

import pytest

import terrane
from conftest import environment_of_python, stack
from terrane.testing import assert_conforming, assert_judged, cases


def octahedron(x, name="solid"):
    v = [[x + 2, 0, 0], [x - 2, 0, 0], [x, 2, 0], [x, -2, 0], [x, 0, 2], [x, 0, -2]]
    t = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
    return terrane.Surface(v, t, name)


def test_the_mesh_of_an_arrangement_holds_and_a_damaged_one_does_not():
    rounded = terrane.round(terrane.arrange(stack()))
    judged = terrane.judge(rounded, stack())
    assert judged and [p.verdict for p in judged.properties] == ["holds"] * 8
    whole = terrane.Surface(rounded.mesh.vertices, rounded.mesh.triangles)
    assert terrane.judge(whole, stack())
    damaged = terrane.judge(whole.replace(triangles=whole.triangles[1:]), stack(), most_flaws=1)
    assert not damaged
    coverage = damaged["coverage"]
    assert coverage.verdict == "fails" and coverage.size > 0 and len(coverage.flaws) == 1
    with pytest.raises(KeyError, match="colour is none of conforming"):
        damaged["colour"]


def test_operations_need_solids():
    a, far = octahedron(0), octahedron(9)
    assert terrane.judge([a, far], [a, far], operation="union")
    assert terrane.judge(a, [a, far], operation="difference")["volume"].verdict == "holds"
    assert not terrane.judge(a, [a, far], operation="union")
    open_one = a.replace(triangles=a.triangles[1:])
    with pytest.raises(terrane.Error, match="operand 2: bounds no solid") as caught:
        terrane.judge(a, [far, open_one], operation="union")
    assert caught.value.code == "not_closed"
    with pytest.raises(terrane.Error, match="operation"):
        terrane.judge(a, [a], operation="merge")
    with pytest.raises(TypeError, match="with inputs"):
        terrane.judge(a, operation="union")


def test_points_may_be_rounded_as_far_as_is_stated():
    a = octahedron(0)
    moved = a.replace(vertices=a.vertices + [1e-12, 0, 0])
    assert not terrane.judge(moved, [a])
    assert terrane.judge(moved, [a], spacings=1e5)


def test_triangles_alone():
    assert terrane.judge(octahedron(0))
    assert terrane.judge(octahedron(0).replace(triangles=octahedron(0).triangles[1:]))["closed"].flaw_count == 3


def test_tetrahedra_of_any_program():
    corners, cells = [[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4], [4, 4, 4]], [[0, 1, 2, 3], [1, 2, 3, 4]]
    sides = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 4], [1, 4, 3], [2, 3, 4]]
    hull, wall = terrane.Surface(corners, sides, "hull"), terrane.Surface(corners, [[1, 2, 3]], "wall")
    judged = terrane.judge((corners, cells, [3, 8]), [hull, wall])
    assert judged and [p.name for p in judged.properties] == [
        "positive", "conforming", "welded", "vertices", "curves", "coverage", "topology", "labels", "volume"]
    assert terrane.judge((corners, cells), [hull, wall])
    assert terrane.judge((corners, cells, [3, 3]), [hull, wall])["labels"].verdict == "fails"
    lost = terrane.judge((corners, cells[:1]), [hull, wall])
    assert lost["volume"].verdict == "fails" and lost["volume"].flaw_count == 1
    with pytest.raises(TypeError, match="tetrahedra are judged by inputs"):
        terrane.judge((corners, cells))
    with pytest.raises(terrane.Error, match="there is no vertex 9"):
        terrane.judge((corners, [[0, 1, 2, 9]]), [hull])
    with pytest.raises(terrane.Error, match="one label per tetrahedron"):
        terrane.judge((corners, cells, [1]), [hull])


def test_tetrahedra_that_terrane_made():
    model = terrane.model(stack(), box=((-3, -3, -4), (8, 8, 4)))
    assert terrane.judge(terrane.tetrahedralize(model), terrane.Surface(model.mesh.vertices, model.mesh.triangles))


def test_assertions_name_the_property_and_the_place():
    a, far = octahedron(0), octahedron(9)
    assert_conforming(a.vertices, a.triangles, closed=True)
    assert_conforming(a.vertices, a.triangles[1:])
    with pytest.raises(AssertionError, match="^closed: 3 edges"):
        assert_conforming(a.vertices, a.triangles[1:], closed=True)
    with pytest.raises(AssertionError, match="^conforming: .*\n  two triangles meet improperly: crossing at "):
        near = octahedron(1)
        assert_conforming([*a.vertices, *near.vertices], [*a.triangles, *(near.triangles + len(a.vertices))])
    assert_judged([a, far], [a, far], "union")
    with pytest.raises(AssertionError, match="volume"):
        assert_judged(a, [a, far], "union")


def test_tests_run_for_each_case(tmp_path):
    folder = pathlib.Path(__file__).resolve().parents[2] / "tests" / "corpus"
    for name in ("cubes-share-a-face", "triangle-twice"):
        for path in folder.glob(f"{name}*"):
            shutil.copy(path, tmp_path)
    assert [case.name for case in cases(tmp_path)] == ["cubes-share-a-face", "triangle-twice"]
    with pytest.raises(FileNotFoundError, match="has no cases"):
        cases(tmp_path / "none")
    (tmp_path / "conftest.py").write_text('pytest_plugins = ["terrane.testing"]\n')
    (tmp_path / "test_engine.py").write_text(textwrap.dedent("""
        import terrane
        from terrane.testing import assert_judged

        def test_arrangement(certified_case):
            exact = terrane.arrange(certified_case.surfaces)
            assert len(exact.vertices) == len(certified_case.answers["points"])
            assert_judged(terrane.round(exact), certified_case.surfaces)

        def test_engine_that_does_nothing(certified_case):
            assert_judged(certified_case.surfaces, certified_case.surfaces)
    """))
    run = subprocess.run([sys.executable, "-B", "-W", "ignore", "-m", "pytest", "-q", "-p", "no:cacheprovider", "--rootdir", tmp_path,
                          "--certified-cases", tmp_path, tmp_path], capture_output=True, text=True, env=environment_of_python())
    assert run.returncode == 1 and "2 failed, 2 passed" in run.stdout, run.stdout + run.stderr
    assert "FAILED test_engine.py::test_engine_that_does_nothing[cubes-share-a-face]" in run.stdout
