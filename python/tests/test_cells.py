# SPDX-License-Identifier: LGPL-3.0-or-later
"""Grids of cells: fractions against arithmetic, centres against `block_of`, errors, and the program's files."""

import numpy as np
import pytest

import terrane
from conftest import run_program

LEVEL = np.array([[-1, -1, 0], [9, -1, 0], [9, 9, 0], [-1, 9, 0]], dtype=float)


def level(name, heights):
    vertices = LEVEL.copy()
    vertices[:, 2] = heights
    return terrane.Surface(vertices, [[0, 1, 2], [0, 2, 3]], name, "horizon")


@pytest.fixture(scope="module")
def model():
    return terrane.model([level("lower", [2, 2, 2, 2]), level("upper", [3.5, 5.5, 7.5, 5.5])], box=((0, 0, 0), (8, 8, 8)))


def test_fractions_are_those_of_arithmetic(model):
    made = model.grid(cells=(1, 1, 4))
    below, between, above = (model.blocks[name].number for name in ("below lower", "below upper, above lower", "above upper"))
    assert made.fraction(below).ravel().tolist() == [1, 0, 0, 0]
    assert made.block_of.ravel().tolist() == [below, between, between, above]
    assert np.array_equal(sum(made.fraction(n) for n in range(4)), np.ones((4, 1, 1)))


def test_fractions_add_up_to_volumes_and_centres_are_those_of_block_of(model):
    made = model.grid(step=(0.7, 1.1, 0.9))
    sizes = np.diff(made.z)[:, None, None] * np.diff(made.y)[:, None] * np.diff(made.x)
    for block in model.blocks.values():
        assert (made.fraction(block.number) * sizes).sum() == pytest.approx(block.volume, rel=1e-13)
    middles = [(a[1:] + a[:-1]) / 2 for a in (made.z, made.y, made.x)]
    z, y, x = np.meshgrid(*middles, indexing="ij")
    assert np.array_equal(model.block_of(np.stack((x, y, z), -1).reshape(-1, 3)), made.block_of.ravel())
    assert np.array_equal(np.unique(made.cells), np.arange(made.block_of.size))


def test_planes_take_the_place_of_those_of_steps(model):
    made = model.grid(step=2, z=[0, 1, 8])
    assert made.z.tolist() == [0, 1, 8] and made.x.tolist() == [0, 2, 4, 6, 8]
    assert made == model.grid(x=made.x, y=made.y, z=made.z) != model.grid(step=2)


def test_files_are_those_of_the_program(model, tmp_path):
    for surface in (level("lower", [2, 2, 2, 2]), level("upper", [3.5, 5.5, 7.5, 5.5])):
        surface.save(tmp_path / f"{surface.name}.ts")
    made = model.grid(step=2)
    for name in ("g.vti", "g.vtr", "g.csv"):
        status, _, errors = run_program("grid", tmp_path / "lower.ts", tmp_path / "upper.ts", "--box", "0,0,0,8,8,8", "--step", "2",
                                        "-o", tmp_path / ("p" + name))
        assert status == 0, errors
        made.save(tmp_path / name)
        assert (tmp_path / name).read_bytes() == (tmp_path / ("p" + name)).read_bytes()
    made.save(tmp_path / "g.grdecl")
    assert "FIPNUM" in (tmp_path / "g.grdecl").read_text()


@pytest.mark.parametrize("wanted", [
    {}, dict(step=1, cells=(1, 1, 1)), dict(x=[0, 1], y=[0, 1]), dict(step=0), dict(step=(1, 1)), dict(cells=(1, 1)),
    dict(step=1, z=[1, 0]), dict(step=1, z=[1]), dict(step=1e-9), dict(cells=(0, 1, 1))])
def test_what_makes_no_grid_is_refused(model, wanted):
    with pytest.raises(terrane.Error) as refused:
        model.grid(**wanted)
    assert refused.value.code == "bad_option"


def test_a_format_is_refused(model, tmp_path):
    with pytest.raises(terrane.Error) as refused:
        model.grid(step=4).save(tmp_path / "g.obj")
    assert refused.value.code == "unknown_format"
