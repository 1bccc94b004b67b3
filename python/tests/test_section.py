# SPDX-License-Identifier: LGPL-3.0-or-later
"""Sections: areas against arithmetic, blocks against `block_of`, errors, and the program's files."""

import json
import pathlib
import pickle

import numpy as np
import pytest

import terrane
from conftest import run_program


def level(name, z, role="horizon"):
    return terrane.Surface([(-1, -1, z), (9, -1, z), (9, 9, z), (-1, 9, z)], [(0, 1, 2), (0, 2, 3)], name, role)


FAULT = terrane.Surface([(2, -1, -1), (4, 9, -1), (6, 9, 9), (4, -1, 9)], [(0, 1, 2), (0, 2, 3)], "fault", "fault")


@pytest.fixture(scope="module")
def model():
    return terrane.model([level("lower", 2), level("upper", 5), FAULT], box=((0, 0, 0), (8, 8, 8)))


def shoelace(points):
    x, y = np.asarray(points).T
    return (x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def crossings(ring, point):
    """How often a ray from a point to greater x crosses a ring."""
    (x, y), count = point, 0
    for (xa, ya), (xb, yb) in zip(ring, np.roll(ring, -1, axis=0)):
        count += (ya > y) != (yb > y) and xa + (xb - xa) * (y - ya) / (yb - ya) > x
    return count


@pytest.mark.parametrize("where, area", [
    (dict(plane=((1, 3, 1), (0, -1, 0))), 64), (dict(level=1), 64), (dict(level=[1, 6]), 128),
    (dict(fence=[(0, 4), (4, 4), (4, 8)]), 64), (dict(by="upper"), 64), (dict(by=level("any", 3)), 64),
    (dict(plane=((4, 4, 4), (1, 0, 1))), 64 * 2 ** 0.5)])
def test_areas(model, where, area):
    made = terrane.section(model, **where)
    assert made.area == pytest.approx(area)
    for polygon in made.polygons:
        rings = [shoelace(made.flat[ring]) for ring in polygon.rings]
        assert rings[0] > 0 and all(hole < 0 for hole in rings[1:])
        if "by" not in where:
            assert sum(rings) == pytest.approx(polygon.area)
    assert len(made.mesh.triangles) == len(made.triangles) == len(made.polygon_of)


def test_blocks_are_those_of_points(model):
    random = np.random.default_rng(1)
    made = terrane.section(model, plane=((0, 3, 0), (0, -1, 0)))
    points = random.uniform(0.01, 7.99, (500, 2))
    names = model.names_of([(x, 3, z) for x, z in points])
    for point, name in zip(points, names):
        around = [p for p in made.polygons if sum(crossings(made.flat[ring], point) for ring in p.rings) % 2]
        assert [p.block for p in around] == [name]


def test_a_surface_lies_between_the_blocks_in_front_and_behind(model):
    made = terrane.section(model, by="upper")
    assert all(p.block != p.behind for p in made.polygons)
    assert {line.surface for line in made.lines} >= {"upper", "fault"}
    assert np.all(made.vertices[:, 2] == 5)
    assert pickle.loads(pickle.dumps(made)) == made != terrane.section(model, by="lower")


def test_files_are_those_of_the_program(model, tmp_path):
    for surface in (level("lower", 2), level("upper", 5), FAULT):
        surface.save(tmp_path / f"{surface.name}.ts")
    made = terrane.section(model, level=1)
    for name in ("s.geojson", "s.csv", "s.dxf", "s.vtp"):
        status, _, errors = run_program("section", *(tmp_path / f for f in ("lower.ts", "upper.ts", "fault.ts")), "--box",
                                        "0,0,0,8,8,8", "--level", "1", "-o", tmp_path / ("p" + name))
        assert status == 0, errors
        made.save(tmp_path / name)
        if name != "s.vtp":  # which states what wrote it
            assert (tmp_path / name).read_bytes() == (tmp_path / ("p" + name)).read_bytes()
    assert len(json.loads((tmp_path / "s.geojson").read_text())["features"]) == len(made.polygons) + len(made.lines)
    made.save(tmp_path / "s.svg", title="A < B", exaggeration=2)
    assert "A &lt; B" in (tmp_path / "s.svg").read_text() and "exaggeration 2" in (tmp_path / "s.svg").read_text()
    with pytest.raises(terrane.Error):
        made.save(tmp_path / "s.unknown")
    assert not pathlib.Path(tmp_path, "s.unknown").exists()


@pytest.mark.parametrize("where", [
    {}, dict(level=1, by="upper"), dict(plane=((0, 0, 0), (0, 0, 0))), dict(plane=((0, 0, 0),)), dict(level=[]),
    dict(fence=[(0, 0)]), dict(fence=[(0, 0), (4, 0), (2, 0)]), dict(by="uper"), dict(level=float("nan"))])
def test_what_makes_no_sense_is_refused(model, where):
    with pytest.raises(terrane.Error) as refused:
        terrane.section(model, **where)
    assert refused.value.code in ("bad_option", "bad_number")


def test_needs_a_model():
    with pytest.raises(TypeError):
        terrane.section([FAULT], level=1)


def test_what_is_beside_the_model_is_not_written(model, tmp_path):
    for name in ("beside.svg", "beside.vtp"):
        with pytest.raises(terrane.Error, match="does not meet the model"):
            terrane.section(model, level=1e6).save(tmp_path / name)
    assert not list(tmp_path.iterdir())
