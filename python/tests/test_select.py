# SPDX-License-Identifier: LGPL-3.0-or-later
"""Regions by expressions and operators: volumes against arithmetic, errors, and the program's file."""

import os
import pathlib
import pickle
from fractions import Fraction

import numpy as np
import pytest

import terrane
from conftest import run_program

SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def cube(name, low, high):
    """Return a cube that faces outwards."""
    ends = (low, high)
    return terrane.Surface([(x, y, z) for x in ends for y in ends for z in ends],
                           [t for p, q, r, s in SIDES for t in ((p, q, r), (p, r, s))], name, "boundary")


def volume(surface):
    """Return the volume within closed triangles; positive if they face outwards."""
    p, q, r = np.asarray(surface.vertices)[np.asarray(surface.triangles).T]
    return np.einsum("ij,ij", p, np.cross(q, r)) / 6


A, B = cube("a", 0, 2), cube("b", 1, 4)


@pytest.mark.parametrize("expression, expected, pieces, cavities", [
    ("a | b", 34, 1, 0), ("a & b", 1, 1, 0), ("a - b", 7, 1, 0), ("b - a", 26, 1, 0), ("a ^ b", 33, 2, 1)])
def test_volumes_of_two_cubes(expression, expected, pieces, cavities):
    made = terrane.select([A, B], expression, fractions=True)
    assert made.volume == expected and made.exact_volume == Fraction(expected)
    assert (len(made.pieces), made.cavities) == (pieces, cavities)
    assert sum(piece.exact_volume for piece in made.pieces) == expected
    assert volume(made.mesh) == pytest.approx(expected)
    assert [np.count_nonzero(made.piece_of == k) for k in range(pieces)] == [p.triangles for p in made.pieces]
    by_operator = eval(expression, {"a": A, "b": B})
    assert by_operator.name == expression and by_operator.role == "boundary"
    assert volume(by_operator) == pytest.approx(expected)


def test_operators_take_surfaces_of_any_name():
    same, unnamed = A.replace(name="x (1)"), B.replace(name="")
    assert volume(same - A) == 0 and len((same - A).triangles) == 0
    assert volume(same - unnamed) == pytest.approx(7)
    assert ((A | B) - B).name == "(a | b) - b" and volume((A | B) - B) == pytest.approx(7)
    assert volume((A - A) | B) == pytest.approx(27)  # nothing has no place, and may be an operand
    with pytest.raises(TypeError):
        A - 1


def test_fractions_are_computed_on_request():
    made = terrane.select([A, B], "a")
    assert made.exact_volume is None and made.pieces[0].exact_volume is None


def test_rules():
    shells = [cube("a", 0, 4), cube("a", 1, 3)]
    assert terrane.select(shells, "a").volume == 64
    assert terrane.select(shells, "a", rule="odd").volume == 56
    with pytest.raises(terrane.Error, match="nonzero, positive, odd"):
        terrane.select(shells, "a", rule="even")


@pytest.mark.parametrize("expression, code, why", [
    ("a + b", "bad_option", "column 3"), ("a - c", "bad_option", "no surface is called c"),
    ("~a", "bad_option", "no end"), ("a - open", "not_closed", "not closed along 3 edges")])
def test_mistakes(expression, code, why):
    triangle = terrane.Surface([(9, 9, 9), (10, 9, 9), (9, 10, 9)], [(0, 1, 2)], "open")
    with pytest.raises(terrane.Error, match=why) as raised:
        terrane.select([A, B, triangle], expression)
    assert raised.value.code == code


def test_sides_of_open_surfaces():
    plane = terrane.Surface([(-9, -9, 1), (9, -9, 1), (9, 9, 1), (-9, 9, 1)], [(0, 1, 2), (0, 2, 3)], "plane")
    made = terrane.select([A, plane], "a & below(plane)", fractions=True)
    assert made.exact_volume == 4 and not made.is_surface
    part = terrane.select([A, plane], "plane & inside(a)")
    assert part.is_surface and part.regions == 1 and len(part.pieces) == 0 and len(part.piece_of) == 0
    assert repr(part).startswith("<Selected: surface, 1 region, ") and pickle.loads(pickle.dumps(part)) == part
    p, q, r = np.asarray(part.mesh.vertices)[np.asarray(part.mesh.triangles).T]
    assert np.cross(q - p, r - p).sum(axis=0) / 2 == pytest.approx((0, 0, 4))
    with pytest.raises(terrane.Error, match="not closed along 4 edges") as raised:
        terrane.select([A, plane], "a & plane")
    assert raised.value.code == "not_closed"


def test_names_that_are_no_utf8():
    name = os.fsdecode(b"a\xff")
    assert terrane.select([A.replace(name=name)], f'"{name}"').volume == 8


def test_results_are_values():
    made = terrane.select([A, B], "a ^ b", fractions=True)
    assert pickle.loads(pickle.dumps(made)) == made != terrane.select([A, B], "a - b")


def test_file_is_that_of_the_program():
    terrane.save([A, B], "in.ts")
    status, _, text = run_program("select", "b - a", "in.ts", "-o", "program.vtp")
    assert status == 0, text
    terrane.select(terrane.read("in.ts"), "b - a").save("python.vtp")
    assert pathlib.Path("python.vtp").read_bytes() == pathlib.Path("program.vtp").read_bytes()


def test_program_carries_values():
    for number, surface in enumerate((A, B)):
        surface.replace(cell_data={"rock": [number] * 12}).save(f"{surface.name}.vtp")
    status, _, text = run_program("select", "a - b", "a.vtp", "b.vtp", "-o", "out.vtp")
    assert status == 0, text
    assert {s.name: set(s.cell_data["rock"]) for s in terrane.read("out.vtp")} == {"a": {0}, "b": {1}}


def test_nothing_is_written_where_nothing_is_selected(tmp_path):
    with pytest.raises(terrane.Error, match="nothing is selected"):
        terrane.select([A, B], "a - a").save(tmp_path / "none.obj")
    assert not list(tmp_path.iterdir())


def test_operators_name_the_surface_that_is_open():
    flat = terrane.Surface([(0, 0, 1), (9, 0, 1), (0, 9, 1)], [[0, 1, 2]], "flat")
    for combine in (lambda: A - flat, lambda: flat & A):
        with pytest.raises(terrane.Error) as caught:
            combine()
        assert caught.value.place == "flat" and caught.value.code == "not_closed"


def test_regions_of_a_model():
    def level(name, z):
        return terrane.Surface([(-1, -1, z), (9, -1, z), (9, 9, z), (-1, 9, z)], [(0, 1, 2), (0, 2, 3)], name, "horizon")

    model = terrane.model([level("upper", 5), level("lower", 2)], box=((0, 0, 0), (8, 8, 8)),
                          column=[{"unit": "sand", "surface": "upper", "age": 10}, {"unit": "shale", "surface": "lower", "age": 20},
                                  {"unit": "salt", "age": 30}])
    contact = level("contact", 3)
    for expression, volume in (("unit(sand)", 192), ('block("shale")', 192), ("block(1) | block(2) | block(3)", 512),
                               ("volume < 150", 128), ("age > 15 & ~unit(salt)", 192), ("unit(shale) & above(contact)", 128),
                               ("volume > 1 - above(lower)", 128)):
        made = model.where(expression, others=contact if "contact" in expression else ())
        assert made.volume == volume and made.rounding.clean, expression
    made = model.where("unit(shale) & above(contact)", others=[contact])
    assert [s.name for s in made.mesh.surfaces][-1] == "contact"
    assert made.mesh.parents_of.values.max() < len(model.mesh.triangles) + 2
    for expression, sentence in (("unit(snad)", "did you mean sand"), ("block(7)", "no block is called 7"),
                                 ("~unit(sand)", "has no end"), ("volume < x", "a number")):
        with pytest.raises(terrane.Error, match=sentence):
            model.where(expression)
    with pytest.raises(terrane.Error, match="those of a model"):
        terrane.select([level("upper", 5)], "block(1)")
