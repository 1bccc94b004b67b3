# SPDX-License-Identifier: LGPL-3.0-or-later
"""Maps of surfaces and blocks: values in closed form, grids written and read, errors."""

import warnings

import numpy as np
import pytest

import terrane


def plane(a, b, c, name="plane"):
    """Return the square from (0, 0) to (10, 10) with heights a x + b y + c."""
    corners = [(x, y, a * x + b * y + c) for x, y in ((0, 0), (10, 0), (10, 10), (0, 10))]
    return terrane.Surface(corners, [[0, 1, 2], [0, 2, 3]], name, "horizon")


def test_numbers_of_a_plane():
    top = plane(0.5, -0.25, 3)
    height = terrane.map_surface(top, "height", step=2.5)
    x, y = height.points[..., 0], height.points[..., 1]
    assert height.values.shape == (5, 5) and x[0, 4] == 10 and y[4, 0] == 10
    np.testing.assert_allclose(height.values, 0.5 * x - 0.25 * y + 3, rtol=1e-15)
    assert np.array_equal(terrane.map_surface(top, "depth", like=height).values, -height.values)
    dip = terrane.map_surface(top, "dip", step=5).values
    np.testing.assert_allclose(dip, np.degrees(np.arctan(np.hypot(0.5, 0.25))), rtol=1e-14)
    azimuth = terrane.map_surface(top, "azimuth", step=5).values
    np.testing.assert_allclose(azimuth, np.degrees(np.arctan2(-0.5, 0.25)) % 360, rtol=1e-14)


def test_thickness_and_distance():
    top, base = plane(0.75, 0, 5, "top"), plane(0.75, 0, 0, "base")
    assert np.all(terrane.map_surface(top, "thickness", to=base, step=1).values == 5)
    distance = terrane.map_surface(top, "distance", to=[base], step=1)
    np.testing.assert_allclose(distance.values[:, :7], 4, rtol=1e-14)  # the feet of the others are off the base


def test_units_that_differ_are_a_doubt():
    metres, feet = (plane(0, 0, 1, unit).replace(frame=terrane.Frame(unit, unit)) for unit in ("m", "ft"))
    with pytest.warns(terrane.Doubt, match="different units"):
        terrane.map_surface(metres, "thickness", to=feet, step=5)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        terrane.map_surface(metres, "thickness", to=metres, step=5)


def test_thickness_of_blocks_is_volume_over_area():
    model = terrane.model([plane(0.5, 0, 1)], box=((0, 0, 0), (10, 10, 8)))
    below, above = sorted(model.blocks.values(), key=lambda b: b.name != "below plane")
    fine = [model.map_thickness(b.name, step=0.5) for b in (below, above)]
    x = fine[0].points[..., 0]
    np.testing.assert_allclose(fine[0].values, 0.5 * x + 1, rtol=1e-14)
    np.testing.assert_allclose(fine[0].values + fine[1].values, 8, rtol=1e-14)
    both = model.map_thickness([1, 2], like=fine[0])
    assert np.all(both.values == 8) and both.name == "below plane, above plane"
    assert model.map_thickness([below, above], like=fine[0]) == both
    assert model.map_thickness(below, step=0.5) == fine[0]
    with pytest.raises(KeyError, match="no block"):
        model.map_thickness("salt", step=1)


@pytest.mark.parametrize("order", [1, -1])
def test_blocks_are_thick_only_where_they_are_though_surfaces_meet_at_nodes(order):
    surfaces = [terrane.Surface([(x, y, a * x) for x, y in ((-4, -4), (4, -4), (4, 4), (-4, 4))],
                                [[0, 1, 2], [0, 2, 3]], name, "horizon") for name, a in (("top", 0.25), ("base", -0.5))]
    with pytest.warns(terrane.Doubt, match="run through each other"):
        model = terrane.model(surfaces[::order], box=((-4, -4, -10), (4, 4, 10)))
    between = model.map_thickness("below top, above base", step=1)
    x = between.points[..., 0]
    np.testing.assert_allclose(between.values, 0.75 * np.maximum(x, 0), rtol=1e-14)


def test_parts_above_a_contact():
    model = terrane.model([plane(0, 0, 3)], box=((0, 0, 0), (10, 10, 8)))
    below, above = model.blocks["below plane"], model.blocks["above plane"]
    assert below.above_contact(1) == (200, 100, 2) and above.above_contact(1) == (500, 0, 7)
    assert below.above_contact(3) == (0, 0, 0) and above.above_contact(7.5) == (50, 100, 0.5)
    assert below.above_contact(-1e300) == (300, 0, 1e300) and above.above_contact(-1e12).volume == 500
    with pytest.raises(TypeError, match="contact"):
        below.above_contact("deep")


def test_a_map_is_written_and_its_nodes_are_taken_from_the_file(tmp_path):
    made = terrane.map_surface(plane(1, 0.125, 0), "height", step=2)
    for name in ("m.asc", "m.zmap", "m.irap", "m.grd"):
        made.save(tmp_path / name)
        read, = terrane.read(tmp_path / name)
        assert np.array_equal(np.sort(read.vertices[:, 2]), np.sort(made.values.ravel()))
        again = terrane.map_surface(plane(1, 0.125, 0), "height", like=tmp_path / name)
        assert again == made
    made.save(tmp_path / "m.dat", format="vti")
    assert b"ImageData" in (tmp_path / "m.dat").read_bytes()
    with pytest.raises(terrane.Error, match="grids are written as"):
        made.save(tmp_path / "m.vtp")


def test_errors():
    top = plane(0, 0, 0)
    for words, place in [({}, "step"), ({"step": 1, "like": "x.asc"}, "step"), ({"step": 0}, "step"),
                         ({"step": 1, "to": top}, "to")]:
        with pytest.raises(terrane.Error, match=place):
            terrane.map_surface(top, "height", **words)
    with pytest.raises(terrane.Error, match="needs a second surface"):
        terrane.map_surface(top, "thickness", step=1)
    with pytest.raises(terrane.Error, match="number=weight"):
        terrane.map_surface(top, "weight", step=1)
    with pytest.raises(terrane.Error, match="10\\^9"):
        terrane.map_surface(top, "height", step=1e-9)
    with pytest.raises(terrane.Error, match="cannot be read"):
        terrane.map_surface(top, "height", like="missing.asc")
    with pytest.raises(terrane.Error, match="no node"):
        terrane.map_surface([], "height", step=1)
    made = terrane.map_surface(iter([plane(0, 0, 1), plane(0, 0, 2)]), "height", step=5)
    assert np.all(made.values == 2) and made.sheets == 9
