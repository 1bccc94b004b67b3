# SPDX-License-Identifier: LGPL-3.0-or-later
"""Logs of wells: depths against arithmetic, blocks against `names_of`, errors, and the program's files."""

import pathlib
import pickle

import numpy as np
import pytest

import terrane
from conftest import run_program


def level(name, z):
    return terrane.Surface([(-1, -1, z), (9, -1, z), (9, 9, z), (-1, 9, z)], [(0, 1, 2), (0, 2, 3)], name, "horizon")


FAULT = terrane.Surface([(2, -1, -1), (4, 9, -1), (6, 9, 9), (4, -1, 9)], [(0, 1, 2), (0, 2, 3)], "fault", "fault")


@pytest.fixture(scope="module")
def model():
    return terrane.model([level("lower", 2), level("upper", 5), FAULT], box=((0, 0, 0), (8, 8, 8)))


def test_depths_and_blocks(model):
    log = terrane.log_well(model, [(7, 1, 9), (7, 1, -1)], depths=[100, 120], name="A")
    assert [(i.top, i.base) for i in log.intervals] == [(100, 102), (102, 108), (108, 114), (114, 118), (118, 120)]
    assert [(m.surface, m.depth, m.point) for m in log.markers] == [
        ("boundary top", 102, (7, 1, 8)), ("upper", 108, (7, 1, 5)), ("lower", 114, (7, 1, 2)),
        ("boundary bottom", 118, (7, 1, 0))]
    assert log.intervals[0].blocks == ["outside"] and log.name == "A"
    assert repr(log) == "<WellLog: A, 5 intervals, 4 markers>"


def test_blocks_are_those_of_points(model):
    random = np.random.default_rng(3)
    for _ in range(50):
        points = random.uniform(-1, 9, (4, 3))
        log = terrane.log_well(model, points)
        ends = np.concatenate(([0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))))
        assert log.intervals[-1].base == pytest.approx(ends[-1])
        depths = random.uniform(0, ends[-1], 40)
        places = np.stack([np.interp(depths, ends, points[:, k]) for k in range(3)], axis=1)
        for depth, name in zip(depths, model.names_of(places)):
            inside = [i for i in log.intervals if i.top < depth < i.base]
            assert [i.blocks for i in inside] == [[name]]
        for above, below in zip(log.intervals, log.intervals[1:]):
            assert above.base == below.top and above.exit == below.entry


def test_a_part_in_a_surface(model):
    log = terrane.log_well(model, [(7, 1, 5), (7, 3, 5)])
    assert len(log.intervals) == 1
    assert log.intervals[0].surfaces == ["upper"] and len(log.intervals[0].blocks) == 2
    assert pickle.loads(pickle.dumps(log)) == log != terrane.log_well(model, [(7, 1, 5), (7, 2, 5)])


def test_files_are_those_of_the_program(model, tmp_path):
    for surface in (level("lower", 2), level("upper", 5), FAULT):
        surface.save(tmp_path / f"{surface.name}.ts")
    (tmp_path / "A.csv").write_text("md,inclination,azimuth\n0,0,0\n3,0,0\n6,60,45\n9,90,45\n")
    status, _, errors = run_program("well", *(tmp_path / f for f in ("lower.ts", "upper.ts", "fault.ts")), "--box",
                                    "0,0,0,8,8,8", "--path", tmp_path / "A.csv", "--head", "1,1,9",
                                    "-o", tmp_path / "p.csv", "-o", tmp_path / "p.las")
    assert status == 0, errors
    path, = terrane.read_wells(tmp_path / "A.csv", heads={"A": (1, 1, 9)})
    assert path.points.shape == (4, 3) and path.depths.tolist() == [0, 3, 6, 9]
    log = terrane.log_well(model, path)
    for name in ("p.csv", "p.las"):
        log.save(tmp_path / ("m" + name))
        assert pathlib.Path(tmp_path / ("m" + name)).read_text() == (tmp_path / name).read_text()
    log.save(tmp_path / "step.las", step=0.5)
    assert "\n8.5 " in (tmp_path / "step.las").read_text()


@pytest.mark.parametrize("points, more, place", [
    ([(1, 1, 1)], {}, "well"), ([(1, 1, 1), (1, 1, 1)], {}, "well"), ([(1, 1, 1), (1, 1, 2)], {"depths": [1]}, "well"),
    ([(1, 1, 1), (1, 1, 2)], {"depths": [2, 1]}, "well"), ([(1, 1, 1), (1, 1, float("nan"))], {}, "points")])
def test_mistakes(model, points, more, place):
    with pytest.raises(terrane.Error) as raised:
        terrane.log_well(model, points, **more)
    assert place in str(raised.value)


def test_mistakes_of_files(model, tmp_path):
    with pytest.raises(terrane.Error, match="csv or .las"):
        terrane.log_well(model, [(1, 1, 9), (1, 1, 0)]).save(tmp_path / "a.svg")
    with pytest.raises(terrane.Error, match="step"):
        terrane.log_well(model, [(1, 1, 9), (1, 1, 0)]).save(tmp_path / "a.csv", step=1)
    (tmp_path / "A.csv").write_text("md,inclination,azimuth\n0,0,0\n3,0,0\n")
    with pytest.raises(terrane.Error, match="head"):
        terrane.read_wells(tmp_path / "A.csv")
    with pytest.raises(terrane.Error, match="opened"):
        terrane.read_wells(tmp_path / "none.csv")
    with pytest.raises(TypeError):
        terrane.log_well([FAULT], [(1, 1, 9), (1, 1, 0)])
