# SPDX-License-Identifier: LGPL-3.0-or-later
"""Volumes, structure, models, sealing: against exact numbers and the program's folder."""

import filecmp
import os
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import terrane
from conftest import BOX, DATA, SANITIZED, run_program, sheet, stack, wall


def assert_same_folders(a, b):
    """Compare two folders, byte by byte."""
    names = sorted(os.path.relpath(os.path.join(d, f), a) for d, _, files in os.walk(a) for f in files)
    assert names == sorted(os.path.relpath(os.path.join(d, f), b) for d, _, files in os.walk(b) for f in files)
    assert names
    for name in names:
        assert filecmp.cmp(os.path.join(a, name), os.path.join(b, name), shallow=False), name


@pytest.mark.parametrize("options, arguments", [
    ({}, []),
    ({"box": ((0, 0, -1700), (2000, 1500, -700))}, ["--box", "0,0,-1700,2000,1500,-700"]),
    ({"box": (0, 0, -1700, 2000, 1500, -700), "seal": 30}, ["--box", "0,0,-1700,2000,1500,-700", "--seal", "30"]),
    ({"box": (0, 0, -1700, 2000, 1500, -700), "seal": "auto"}, ["--box", "0,0,-1700,2000,1500,-700", "--seal", "auto"]),
    ({"box": (0, 0, -1700, 2000, 1500, -700), "seal": {None: 20, ("top", "fault"): 0}},
     ["--box", "0,0,-1700,2000,1500,-700", "--seal", "20", "--seal", "top/fault=0"]),
    ({"box": (-100, -100, -1700, 2100, 1600, -700), "extend": 500},
     ["--box", "-100,-100,-1700,2100,1600,-700", "--extend", "500"]),
    ({"box": (0, 0, -1700, 2000, 1500, -700), "min_volume": "auto"},
     ["--box", "0,0,-1700,2000,1500,-700", "--min-volume", "auto"]),
])
def test_folders_are_those_of_the_program(options, arguments):
    files = [DATA / "top.ts", DATA / "base.ts", DATA / "fault.ts"]
    status, _, text = run_program("volume", *files, "-o", "program", *arguments)
    assert status == 0, text
    terrane.model(terrane.read(files), **options).save("python")
    assert_same_folders("program", "python")


@pytest.mark.parametrize("format", ["obj", "ts", "stl", "msh22"])
def test_formats_of_blocks(format, model):
    model.save("out", format=format)
    assert len(os.listdir("out/blocks")) == len(model.blocks)


def test_a_folder_that_is_not_empty_is_left_alone(model):
    os.mkdir("out")
    open("out/mine", "w").close()
    with pytest.raises(terrane.Error) as raised:
        model.save("out")
    assert raised.value.code == "cannot_open" and os.listdir("out") == ["mine"]
    with pytest.raises(terrane.Error, match="xyzzy"):
        model.save("new", format="xyzzy")
    assert not os.path.exists("new")


def test_blocks(model):
    assert len(model.blocks) == 6
    total = sum(b.volume for b in model.blocks.values())
    assert total == pytest.approx(4.6 * 4.6 * 4, rel=1e-12)
    assert sorted(b.number for b in model.blocks.values()) == list(range(1, 7))
    for name, block in model.blocks.items():
        assert model.blocks[name].name == name == model.blocks[block.number].name
        assert block.area > 0 and "outside" in block.neighbours
        assert terrane.volumes(block.mesh).total == pytest.approx(block.volume, rel=1e-12)


def test_blocks_by_what_bounds_them(model):
    keys = [b.key for b in model.blocks.values()]
    assert all("/" in k and "F1" in k for k in keys)
    for key in keys:
        found = [b for b in model.blocks.values() if b.key == key]
        if len(found) == 1:
            assert model.blocks[key].number == found[0].number
        else:
            with pytest.raises(KeyError, match="several blocks"):
                model.blocks[key]


def test_the_issue_s_key():
    half = [sheet(z=1.0, name="top", role="horizon"), sheet(z=-1.0, name="base", role="horizon"), wall()]
    model = terrane.model(half, box=((0.2, 0.2, -2.0), (2.29, 4.8, 2.0)))
    block = model.blocks["top/base"]
    assert block.above == ("top",) and block.below == ("base",)
    assert block.volume == pytest.approx(2 * 2.09 * 4.6)


@pytest.mark.parametrize("key", ["nothing", "", "top/base/fault", 0, 7, -1])
def test_blocks_that_do_not_exist(model, key):
    with pytest.raises((KeyError, terrane.Error)) as raised:
        model.blocks[key]
    assert str(raised.value)


def test_block_is_a_mapping(model):
    assert set(model.blocks) == set(model.blocks.keys()) and len(list(model.blocks.items())) == 6
    assert "nothing" not in model.blocks and next(iter(model.blocks)) in model.blocks


def test_interfaces(model):
    interfaces = model.interfaces
    assert len(interfaces) == len(model.structure.interfaces)
    assert sum(len(i.triangles) for i in interfaces) == len(model.mesh.triangles)
    for i in interfaces:
        assert len(i.mesh.triangles) == len(i.triangles) and i.area > 0
        assert set(i.surfaces) <= set(model.labels)
        assert all(b == "outside" or b in model.blocks for b in i.blocks)


def test_relations_and_juxtapositions(model):
    assert ("top", "F1", "crosses") in [r[:3] for r in model.relations] or \
        ("F1", "top", "crosses") in [tuple(r[:3]) for r in model.relations]
    assert any(j.surface == "F1" and "outside" not in j.blocks for j in model.juxtapositions)


def gap_surfaces():
    """A horizon that ends 0.1 short of a fault."""
    return [sheet(z=0.0, name="top", role="horizon", low=(-1, -1), size=(3.2, 8)), wall(x=2.3)]


def test_leaks_are_found_and_closed():
    leaky = terrane.model(gap_surfaces(), box=BOX)
    separating = [leak for leak in leaky.leaks if leak.verdict == "separates"]
    assert [(s.from_surface, s.to_surface) for s in separating] == [("top", "F1")]
    assert separating[0].largest == pytest.approx(0.1)
    closed = terrane.model(gap_surfaces(), box=BOX, seal=0.2)
    assert len(closed.blocks) == len(leaky.blocks) + 1 and closed.sealed["changes"]
    assert not any(leak.from_surface == "top" for leak in closed.leaks)


@pytest.mark.parametrize("seal, blocks", [(None, 2), (0, 2), (0.2, 3), ("auto", 3), ({"top": 0.2}, 3), ({("top", "F1"): 0.2}, 3),
                                          ({"top/F1": 0.2}, 3), ({None: 0.2, "top/F1": 0}, 2), (np.float32(0.25), 3)])
def test_ways_to_state_seal(seal, blocks):
    assert len(terrane.model(gap_surfaces(), box=BOX, seal=seal).blocks) == blocks


@pytest.mark.parametrize("seal", ["much", -1, np.nan, [1], {"nobody": 1}, {"top": -1}])
def test_seals_that_are_refused(seal):
    with pytest.raises((terrane.Error, TypeError), match="seal"):
        terrane.model(gap_surfaces(), box=BOX, seal=seal)


def test_suggest_seal():
    advice = terrane.suggest_seal(gap_surfaces(), BOX)
    assert 0.1 <= advice.distance < 0.5
    assert [t.blocks for t in advice.trials] == [2, 3]


def test_seal_gives_an_arrangement():
    sealed = terrane.seal(gap_surfaces(), 0.2)
    assert sealed.changes[0].kind == "extended" and sealed.closed and sealed.surfaces[0].name == "top"
    assert len(sealed.surfaces[0].triangles) > len(gap_surfaces()[0].triangles)
    assert terrane.round(sealed).clean


@pytest.mark.parametrize("distance", [-1, np.inf, "0.1", None])
def test_distances_that_are_refused(distance):
    with pytest.raises((terrane.Error, TypeError), match="distance"):
        terrane.seal(gap_surfaces(), distance)


def test_columns_name_blocks():
    surfaces = [sheet(z=1.0, name="top", role="horizon"), sheet(z=-1.0, name="base", role="horizon")]
    for column in ([("Cover", "top", 5.0), ("Middle", "base", 20.0), ("Basement", "")],
                   [{"unit": "Cover", "surface": "top", "age": 5}, {"unit": "Middle", "surface": "base", "age": 20,
                                                                 "contact": "erosive"}, {"unit": "Basement"}]):
        model = terrane.model(surfaces, box=BOX, column=column)
        assert set(model.blocks) == {"Cover", "Middle", "Basement"}
        assert model.blocks["Middle"].age == 20.0 and model.blocks["Middle"].unit == "Middle"


@pytest.mark.parametrize("column", [[("A", "top"), ("A", "base")], [("A", "nobody")], [{"name": "A"}],
                                    [("A", "top", 9), ("B", "base", 1)], [("A", "top", 1, "rough")]])
def test_columns_that_are_refused(column):
    with pytest.raises(terrane.Error, match="column"):
        terrane.model(stack(), box=BOX, column=column)


def test_points_are_located(model):
    points = np.array([[1, 1, -1.9], [1, 1, 0], [1, 1, 1.9], [4, 4, -1.9], [4, 4, 0], [4, 4, 1.9], [9, 9, 9]])
    numbers = model.block_of(points)
    assert numbers.dtype == np.uint32 and numbers[-1] == 0
    assert sorted(numbers[:6]) == [1, 2, 3, 4, 5, 6]
    names = model.names_of(points)
    assert "below base" in names[0] and "above top" in names[5] and names[6] == "outside"


def test_points_on_a_surface_count_to_greater_x():
    model = terrane.model([wall(x=1.0)], box=((0, 0, 0), (2, 2, 2)))
    on, left, right = model.block_of([[1, 1, 1], [np.nextafter(1, 0), 1, 1], [np.nextafter(1, 2), 1, 1]])
    assert on == right != left


@pytest.mark.parametrize("points", [np.zeros((0, 3)), [], [[1, 1, 1]], np.asfortranarray(np.ones((5, 3))),
                                    np.ones((4, 3), dtype="f4"), np.ones((4, 3), dtype=int), [(1, 1, 1)] * 3])
def test_points_in_each_layout(model, points):
    assert len(model.block_of(points)) == len(points)


@pytest.mark.parametrize("points", [[1, 1, 1], [[1, 1]], [["a", "b", "c"]], [[np.nan, 0, 0]], [[0, 0, 0], [0, np.inf, 0]]])
def test_points_that_are_refused(model, points):
    with pytest.raises(terrane.Error, match="points"):
        model.block_of(points)


def test_many_points_agree_with_tetrahedra_of_the_box(model):
    """Shares of random points are those of the volumes."""
    rng = np.random.default_rng(1)
    points = rng.uniform(BOX[0], BOX[1], (20_000, 3))
    counts = np.bincount(model.block_of(points), minlength=7)
    whole = 4.6 * 4.6 * 4
    for block in model.blocks.values():
        share = block.volume / whole
        assert abs(counts[block.number] / 20_000 - share) < 5 * np.sqrt(share * (1 - share) / 20_000)
    assert np.array_equal(model.block_of(points, threads=2), model.block_of(points, threads=1))


@settings(max_examples=10 if SANITIZED else 30, deadline=None,
          suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture])
@given(st.lists(st.floats(-1.9, 1.9), min_size=1, max_size=4, unique=True), st.randoms())
def test_random_stacks_of_planes(heights, random):
    """Blocks between planes: exact volumes, and points by comparing heights."""
    heights = sorted(float(np.float32(h)) for h in heights)
    if len(set(heights)) < len(heights):
        return
    surfaces = [sheet(2, 2, z=h, name=f"h{i}", role="horizon", low=(-1, -1), size=(4, 4))
                for i, h in enumerate(heights)]
    random.shuffle(surfaces)
    model = terrane.model(surfaces, box=((0, 0, -2), (2, 2, 2)))
    exact = model.volumes.exact()
    levels = [Fraction(-2), *map(Fraction, heights), Fraction(2)]
    assert sorted(exact.values()) == sorted(4 * (b - a) for a, b in zip(levels, levels[1:]))
    points = np.array([[1, 1, (float(a) + float(b)) / 2] for a, b in zip(levels, levels[1:])])
    if np.all(np.diff(points[:, 2]) > 0):
        assert len(set(model.block_of(points).tolist())) == len(levels) - 1


def test_volumes_of_an_arrangement_are_exact():
    v = terrane.volumes(terrane.arrange(terrane.box((0, 0, 0), (1, 1, 1 / 3))))
    assert v.exact()[1] == Fraction(1 / 3)
    assert v.of_sides.shape == (12, 2) and len(v) == 1
    with pytest.raises(terrane.Error, match="doubles"):
        v.locate([[0, 0, 0]])


def test_volumes_need_a_conforming_mesh():
    with pytest.raises(terrane.Error) as raised:
        terrane.volumes(terrane.mesh(stack()))
    assert raised.value.code == "improper_contact"


def test_structure(rounded, model):
    s = model.structure
    assert len(s.blocks) == 7 and s.blocks[0].name == "outside"
    assert len(s.patch_of) == len(s.interface_of) == len(model.mesh.triangles)
    kinds = {line.kind for line in s.lines}
    assert {"boundary line", "cutoff line"} <= kinds
    for line in s.lines:
        assert len(line.vertices) >= 2 and line.length > 0
        assert (line.corners[0] == terrane.NO_INDEX) == (line.vertices[0] == line.vertices[-1])
    with pytest.raises(terrane.Error, match="triangles"):
        terrane.structure(rounded, model.volumes)


def test_model_without_box():
    m = terrane.model(terrane.box((0, 0, 0), (2, 2, 2)) + terrane.box((5, 0, 0), (6, 1, 1)))
    assert sorted(b.volume for b in m.blocks.values()) == [1.0, 8.0]


def test_model_of_nothing():
    assert len(terrane.model([]).blocks) == 0


def test_rotated_box():
    m = terrane.model([sheet(z=0, low=(-9, -9), size=(18, 18))], box=terrane.rotated_box((0, 0, 0), (2, 4, 6), azimuth=30))
    assert sum(b.volume for b in m.blocks.values()) == pytest.approx(48)


def test_min_volume():
    thin = [sheet(z=0, name="a"), sheet(z=0.001, name="b")]
    assert len(terrane.model(thin, box=BOX).blocks) == 3
    assert len(terrane.model(thin, box=BOX, min_volume=1).blocks) == 2
    assert len(terrane.model(thin, box=BOX, min_volume="auto").blocks) in (2, 3)


def test_rounding_report(model):
    assert model.rounding.clean and model.rounding.max_move < 1e-12


def test_repr_and_html(model):
    assert repr(model).startswith("<Model: 6 blocks, 9 surfaces, ")
    for value in (model, next(iter(model.blocks.values()))):
        assert "<img" in value._repr_html_() and "\n" not in repr(value)
    assert "\n" not in repr(model.blocks) and "\n" not in repr(model.interfaces[0])
