# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes judged by their inputs."""

import pytest

import terrane
from conftest import stack


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
