# SPDX-License-Identifier: LGPL-3.0-or-later
"""Improving, filling, layers, tetrahedra, files, projects, verification: against the program's files."""

import json
import os
import pathlib

import numpy as np
import pytest

import terrane
from conftest import BOX, DATA, SANITIZED, run_program, sheet, stack, wall
from test_model import assert_same_folders
from test_results import holed, project

THREE = [DATA / "top.ts", DATA / "base.ts", DATA / "fault.ts"]


# Written bytes are the same in every build, so they are not compared again under the sanitizers.
compares_bytes = pytest.mark.skipif(SANITIZED, reason="it compares written bytes")


def same_bytes(a, b):
    return open(a, "rb").read() == open(b, "rb").read()


# --- Files


@pytest.mark.parametrize("ending", ["ts", "obj", "ply", "off", "stl", "vtp", "vtk", "msh"])
def test_surfaces_survive_files(ending):
    s = sheet(4, 5, name="top")
    s.save(f"x.{ending}")
    back, = terrane.read(f"x.{ending}")
    expected = s.vertices.astype("f4" if ending == "stl" else "f8")
    assert np.array_equal(back.vertices[back.triangles], expected[s.triangles])


@pytest.mark.parametrize("path", ["a.ts", ["a.ts"], "a.*", "[a].ts", ("a.ts",), b"a.ts"])
def test_ways_to_name_files(path):
    sheet(name="a").save("a.ts")
    assert [s.name for s in terrane.read(path)] == ["a"]


def test_patterns_are_in_order():
    for name in ("b", "a", "c"):
        sheet(name=name).save(name + ".ts")
    assert [s.name for s in terrane.read("*.ts")] == ["a", "b", "c"]
    assert [s.name for s in terrane.read(["c.ts", "[ab].ts"])] == ["c", "a", "b"]


def test_roles_and_format_of_files(tmp_path):
    sheet(name="a").save("a.ts")
    os.rename("a.ts", "a.data")
    assert terrane.read(tmp_path / "a.data", format="ts", roles={"a": "fault"})[0].role == "fault"
    with pytest.raises(terrane.Error, match="there are a"):
        terrane.read("a.data", format="ts", roles={"b": "fault"})


def test_points_and_depths():
    with open("p.xyz", "w") as file:
        file.writelines(f"{i} {j} {i + j}\n" for i in range(4) for j in range(4))
    up, = terrane.read("p.xyz")
    down, = terrane.read("p.xyz", depth=True)
    assert np.array_equal(up.vertices[:, 2], -down.vertices[:, 2]) and len(up.triangles) == 18


def test_options_that_no_file_uses_are_refused():
    with open("p.xyz", "w") as file:
        file.writelines(f"{i} {j} {i + j}\n" for i in range(4) for j in range(4))
    sheet(name="a").save("a.ts")
    assert len(terrane.read(["a.ts", "p.xyz"], depth=True, max_edge=9)) == 2
    for option in ({"depth": True}, {"max_edge": 9}):
        with pytest.raises(terrane.Error, match=f"{[*option][0]}: is for .*, and no file"):
            terrane.read("a.ts", **option)
    with pytest.raises(terrane.Error, match="ascii: is for STL files"):
        terrane.save([sheet()], "a.vtp", ascii=True)
    for call in (lambda: terrane.read("a.ts", unit="\ud800"), lambda: sheet().save("a.vtp", "\ud800")):
        with pytest.raises(ValueError, match="surrogates"):
            call()


def test_frames_are_kept():
    s, = terrane.read(DATA / "top.ts")
    assert s.frame.vertical_axis in (0, 1, 2)
    assert s.replace(name="x").frame == s.frame


# --- Improve


@compares_bytes
def test_improved_files_are_those_of_the_program():
    status, _, text = run_program("improve", *THREE, "-o", "program.vtp", "--edge-length", "100")
    assert status == 0, text
    terrane.improve(terrane.round(terrane.arrange(terrane.read(THREE))), 100).save("python.vtp")
    assert same_bytes("program.vtp", "python.vtp")


def test_improved(rounded):
    better = terrane.improve(rounded, 0.5, max_deviation=0.02)
    assert better.mesh.is_proven and better.report["sides_kept"]
    assert (better.bounds <= 0.02).all() and better.deviations.shape == (3, 2)
    assert len(better.near_of) == len(better.mesh.triangles)
    assert better.mesh.quality()["q"]["mean"] > rounded.mesh.quality()["q"]["mean"]
    assert [s.name for s in better.mesh.surfaces] == ["top", "base", "F1"]


def test_edge_lengths_by_surface(rounded):
    fine = terrane.improve(rounded, 1.0, edge_length_of={"F1": 0.25})
    coarse = terrane.improve(rounded, 1.0)
    def count(r):
        return int(r.mesh.surfaces_of.contain(2).sum())
    assert count(fine) > 3 * count(coarse)


@pytest.mark.parametrize("options, words", [({"edge_length": -1}, "edge_length"), ({"passes": 0}, "passes"),
                                            ({"edge_length_of": {"x": 1}}, "top, base, F1"), ({"colour": 1}, "colour"),
                                            ({"crease_angle": "wide"}, "crease_angle"), ({"max_triangles": 1}, "")])
def test_improve_refuses(rounded, options, words):
    with pytest.raises((terrane.Error, TypeError), match=words):
        terrane.improve(rounded, **{"edge_length": 0.1, **options})


# --- A resolution


EDGE = 2.0 if SANITIZED else 1.0  # the sanitizers take longer for each triangle


def two_levels(gap):
    """Two horizontal squares, `gap` apart, in a box: three blocks, the middle one 4 x 4 x gap."""
    flat = [terrane.Surface([[0, 0, z], [4, 0, z], [4, 4, z], [0, 4, z]], [[0, 1, 2], [0, 2, 3]], name, "horizon")
            for name, z in (("low", 0), ("high", gap))]
    return terrane.model(flat, box=((0, 0, -1), (4, 4, 2)))


def test_a_thin_block_stays_unless_it_may_go():
    whole = two_levels(0.125)
    kept = terrane.improve(whole.mesh, EDGE, resolution=0.3)
    assert len(kept.volumes.measures) == 1 + len(whole.blocks) # with the outside
    assert kept.resolution["length"] == 0.3 and len(kept.resolution["kept_blocks"]) == 1
    gone = terrane.improve(whole.mesh, EDGE, resolution=0.3, dissolve=True)
    assert len(gone.volumes.measures) == len(whole.blocks) and gone.resolution["kept_blocks"] == []
    assert [block["parts"] for block in gone.resolution["blocks"]] == [0]
    # Nothing is lost of the box, and no surface is farther from where it was than the resolution.
    assert gone.volumes.measures[1:].sum() == pytest.approx(48, rel=1e-12)
    names = [s.name for s in gone.mesh.surfaces]
    for name, height in (("low", 0), ("high", 0.125)):
        of_level = gone.mesh.triangles[gone.mesh.surfaces_of.contain(names.index(name))]
        assert len(of_level) > 8 and (np.abs(gone.mesh.vertices[of_level, 2] - height) <= 0.3).all()
    assert (np.array(gone.resolution["deviations"]) <= 0.3).all() and gone.resolution["max_move"] <= 0.3


def test_what_is_farther_apart_than_the_resolution_stays():
    whole = two_levels(0.5)
    better = terrane.improve(whole.mesh, EDGE, resolution=0.3, dissolve=True)
    assert len(better.volumes.measures) == 1 + len(whole.blocks)
    assert better.resolution["blocks"] == [] and better.resolution["kept_blocks"] == []
    assert terrane.improve(whole.mesh, EDGE).resolution is None


def test_a_model_is_improved_at_a_resolution():
    better = two_levels(0.125).improved(EDGE, resolution=0.3, dissolve=True)
    assert len(better.blocks) == 2 and better.is_improved
    assert better.volumes.measures[1:].sum() == pytest.approx(48, rel=1e-12)


@compares_bytes
def test_files_at_a_resolution_are_those_of_the_program():
    status, _, text = run_program("improve", *THREE, "-o", "program.vtp", "--edge-length", "100", "--resolution", "20")
    assert status == 0, text
    mesh = terrane.round(terrane.arrange(terrane.read(THREE)))
    terrane.improve(mesh, 100, resolution=20).save("python.vtp")
    assert same_bytes("program.vtp", "python.vtp")


@pytest.mark.parametrize("options, words", [({"resolution": -1}, "resolution"), ({"dissolve": True}, "dissolve"),
                                            ({"resolution": float("nan")}, "resolution")])
def test_a_resolution_refuses(rounded, options, words):
    with pytest.raises(terrane.Error, match=words):
        terrane.improve(rounded, 0.5, **options)


def test_distance():
    flat = sheet()
    assert terrane.distance(flat, flat) == 0
    assert terrane.distance(flat, sheet(z=2)) == pytest.approx(2)
    assert terrane.distance(flat, terrane.Surface([], [])) == np.inf


# --- Holes


@compares_bytes
@pytest.mark.parametrize("method, options", [("kriging", {}), ("rbf", {}), ("kriging", {"model": "gaussian"}),
                                             ("kriging", {"isotropic": True, "rings": 3}),
                                             ("rbf", {"smoothing": "auto"})])
def test_filled_files_are_those_of_the_program(method, options):
    holed().save("holed.ts")
    arguments = [a for k, v in options.items() for a in ([f"--{k}"] if v is True else [f"--{k}", str(v)])]
    status, _, text = run_program("fill", "holed.ts", "-o", "program.ts", "--method", method, *arguments)
    assert status == 0, text
    given, = terrane.read("holed.ts")
    terrane.fill(given, method=method, **options).save("python.ts")
    assert same_bytes("program.ts", "python.ts")


def test_filled():
    s = holed()
    found = terrane.holes(s)
    assert [h.kind for h in found] == ["hole"] and len(terrane.holes(s, outer=True)) == 2
    filled = terrane.fill(s)
    assert np.array_equal(filled.surface.vertices[:filled.given_vertices], s.vertices)
    assert np.array_equal(filled.surface.triangles[:filled.given_triangles], s.triangles)
    assert (filled.hole_of[:filled.given_triangles] == 0).all() and (filled.hole_of[filled.given_triangles:] == 1).all()
    assert filled.expected_error[filled.given_vertices:].max() > 0
    assert filled.holes[0].report.expected_error > 0 and not terrane.holes(filled.surface)
    true = 0.1 * np.sin(filled.surface.vertices[:, 0]) * np.sin(filled.surface.vertices[:, 1])
    assert np.abs(filled.surface.vertices[:, 2] - true).max() < 0.05


def test_holes_that_stay_open():
    s = holed()
    assert terrane.fill(s, max_area=0.1).surface == s.replace()
    assert terrane.fill(s, holes=[]).surface == s


@pytest.mark.parametrize("options, words", [({"method": "spline"}, "kriging nor rbf"), ({"model": "cubic"}, "spherical"),
                                            ({"smoothing": 1.0}, "rbf"), ({"holes": [2]}, "1 holes"), ({"rings": 0}, "rings"),
                                            ({"method": "rbf", "smoothing": "much"}, "much"), ({"mesh_size": -1}, "mesh_size")])
def test_fill_refuses(options, words):
    with pytest.raises(terrane.Error, match=words):
        terrane.fill(holed(), **options)


# --- Layers


@compares_bytes
@pytest.mark.parametrize("thickness", [0, 5])
def test_layered_files_are_those_of_the_program(thickness):
    files = [DATA / "salt.ts", DATA / "shale.ts"]
    surfaces = terrane.read(files)
    names = [s.name for s in surfaces]
    extra = ["--min-thickness", str(thickness)] if thickness else []
    status, _, text = run_program("layer", *files, "--layer", f"{names[1]}=1", "--layer", f"{names[0]}=2", "-o",
                                  "program.vtp", *extra)
    assert status == 0, text
    terrane.layers(surfaces, {names[1]: 1, names[0]: 2}, min_thickness=thickness).save("python.vtp")
    assert same_bytes("program.vtp", "python.vtp")


def test_layers_are_in_order():
    crossing = [sheet(z=0.0, name="top", slope=(0.3, 0)), sheet(z=0.5, name="base")]
    done = terrane.layers(crossing, [("top", 1), ("base", 2)])
    assert done.is_stack and done.reports[0].dropped > 0 and done.reports[1].dropped == 0
    top, base = done.surfaces()
    assert top.vertices[:, 2].min() >= 0.5


@pytest.mark.parametrize("order", [{"nobody": 1}, {}, {"top": np.nan}, [("top", 1), ("top", 2)]])
def test_layers_refuse(order):
    with pytest.raises(terrane.Error):
        terrane.layers(stack(), order)


@pytest.mark.parametrize("order", [["top"], [("top",)], [("top", 1, 2)], "top", {"top"}])
def test_what_is_no_order_of_layers_is_refused(order):
    with pytest.raises(TypeError, match="order"):
        terrane.layers(stack(), order)


def test_overturned_layers_are_refused():
    with pytest.raises(terrane.Error) as raised:
        terrane.layers([wall(name="top"), sheet(name="base")], {"top": 1, "base": 2})
    assert raised.value.code == "unsupported"


# --- Tetrahedra


@compares_bytes
@pytest.mark.tetgen
@pytest.mark.parametrize("options, arguments", [
    ({}, []), ({"edge_length": 2.5}, ["--edge-length", "2.5"]), ({"split": ["F1"]}, ["--split", "F1"]),
    ({"size_in": {"above top, east of F1": 2.0}}, ["--size-in", "above top, east of F1=2"]),
    ({"size_of": {"F1": 2.0}}, ["--size-of", "F1=2"]), ({"quality": 2.0}, ["--quality", "2"]),
    ({"mesher": "gmsh"}, ["--mesher", "gmsh"]), ({"optimise": False}, ["--no-optimise"])])
def test_tetrahedra_are_those_of_the_program(options, arguments):
    files = [s.name + ".ts" for s in stack()]
    for s in stack():
        s.save(s.name + ".ts")
    corners = ",".join(str(x) for corner in BOX for x in corner)
    status, _, text = run_program("tetrahedralize", *files, "-o", "program.vtu", "-o", "program.msh", "--box", corners,
                                  *arguments)
    model = terrane.model(terrane.read(files), box=BOX)
    if status == 1:  # what the checks refuse is refused here, too, in the same words
        with pytest.raises(terrane.Error) as raised:
            model.tetrahedra(improve=False, **options)
        assert raised.value.sentence.split("; ")[0] in text
        return
    assert status == 0, text
    cells = model.tetrahedra(improve=False, **options)
    cells.save("python.vtu")
    cells.save("python.msh")
    assert same_bytes("program.vtu", "python.vtu") and same_bytes("program.msh", "python.msh")


@pytest.mark.tetgen
def test_tetrahedra(model):
    cells = model.tetrahedra()
    assert cells.violations == [] and cells.mesher == "TetGen"
    v = cells.vertices[cells.tetrahedra]
    volumes = np.linalg.det(v[:, 1:] - v[:, :1]) / 6
    assert (volumes > 0).all()
    for block in model.blocks.values():
        assert volumes[cells.block_of == block.number].sum() == pytest.approx(block.volume)
        assert len(cells.of_block(block.name)) == (cells.block_of == block.number).sum()
    assert cells.block_names[1:] == list(model.blocks)
    assert set(np.unique(cells.face_triangle)) == set(range(len(model.mesh.triangles)))
    assert cells.shape()["dihedral"][0] > 0 and len(cells.volumes) == 7
    thick = volumes > 1e-9  # the middle of a sliver, rounded, may be outside of it
    assert thick.sum() > 500
    assert np.array_equal(model.block_of(v.mean(axis=1)[thick]), cells.block_of[thick])


@pytest.mark.tetgen
def test_tetrahedra_for_simulators(model):
    cells = model.tetrahedra()
    assert cells.save("a.exo") == ["a.exo"]
    files = cells.save("flow.vtu", "ogs")
    assert files[0] == "flow.vtu" and len(files) > 6
    assert sorted(files) == sorted(str(p) for p in pathlib.Path(".").glob("flow*.vtu"))
    assert len(cells.save("b.vtu", order=2)) == 1
    with pytest.raises(terrane.Error, match="order: 3 is not from 1 to 2") as raised:
        cells.save("c.vtu", order=3)
    assert raised.value.code == "bad_option"
    with pytest.raises(terrane.Error, match="second order"):
        cells.save("c.vtm", "geos", order=2)
    assert not pathlib.Path("c.vtu").exists() and not pathlib.Path("c.vtm").exists()


@pytest.mark.tetgen
def test_shapes_are_improved():
    model = terrane.model(terrane.box((0, 0, 0), (1, 2, 3))).improved(0.5)
    before, after = model.tetrahedra(optimise=False), model.tetrahedra()
    assert before.optimised is None
    report = after.optimised
    assert report["passes"] > 0 and report["after"]["quality"] > report["before"]["quality"]
    assert report["before"]["least_angle"] == pytest.approx(before.shape()["dihedral"][0])
    assert report["after"]["least_angle"] == pytest.approx(after.shape()["dihedral"][0])
    assert report["after"]["largest_angle"] == pytest.approx(after.shape()["dihedral"][2])


@pytest.mark.tetgen
def test_a_check_of_tetrahedra_is_not_pickled(model):
    import copy
    import pickle
    cells = model.tetrahedra()
    assert cells.is_checked and copy.copy(cells).is_checked
    restored = pickle.loads(pickle.dumps(cells))
    assert restored == cells and not restored.is_checked
    for what in ("violations", "volumes"):
        with pytest.raises(terrane.Error, match="not checked"):
            getattr(restored, what)


@pytest.mark.tetgen
def test_outside_and_around(model):
    cells = model.tetrahedra(outside=True, around=((-5, -5, -5), (10, 10, 10)))
    assert (cells.block_of == 0).any() and cells.vertices.max() == 10


@pytest.mark.tetgen
@pytest.mark.parametrize("options, words", [
    ({"edge_length": -1}, "edge_length"), ({"split": ["nobody"]}, "nobody"), ({"size_in": {"nobody": 1}}, "no block"),
    ({"size_of": {"nobody": 1}}, "nobody"), ({"mesher": "netgen"}, "tetgen"), ({"quality": 0.5}, ""),
    ({"around": ((0, 0, 0), (1, 1, 1))}, ""), ({"time_limit": 0}, "time_limit")])
def test_tetrahedra_refuse(model, options, words):
    with pytest.raises(terrane.Error, match=words):
        model.tetrahedra(**options)


def test_tetrahedra_need_a_model():
    with pytest.raises(TypeError, match="Model"):
        terrane.tetrahedralize(terrane.mesh(stack()))


@pytest.mark.tetgen
def test_a_missing_helper_is_named(model):
    with pytest.raises(terrane.Error) as raised:
        model.tetrahedra(helper="/no/such/program", mesher="tetgen")
    assert raised.value.code == "cannot_open" and "/no/such/program" in str(raised.value)


# --- Projects


@compares_bytes
def test_built_folder_is_that_of_the_program():
    json.dump(project(), open("project.json", "w"))
    status, _, text = run_program("build", "project.json", "-o", "program")
    assert status == 0, text
    terrane.build("project.json").save("python")
    for name in ("statistics.json", "log.txt"):
        os.remove("program/" + name)
    assert_same_folders("program", "python")
    terrane.build(project()).save("dict")
    assert_same_folders("program", "dict")


@compares_bytes
@pytest.mark.tetgen
def test_built_tetrahedra_are_those_of_the_program():
    wanted = {**project(), "improve": {"edge_length": 1.0}, "tetrahedra": {"split": ["fault"]},
              "outputs": {"tetrahedra": ["vtu", "msh"]}, "folder": "mine"}
    json.dump(wanted, open("project.json", "w"))
    status, _, text = run_program("build", "project.json", "-o", "program")
    assert status == 0, text
    built = terrane.build("project.json")
    assert built.tetrahedra.violations == [] and built.folder.endswith("mine")
    built.save()
    for name in ("tetrahedra.vtu", "tetrahedra.msh"):
        assert same_bytes("program/" + name, "mine/" + name)


@pytest.mark.parametrize("change, words", [({"colour": 1}, "colour"), ({"format": "x"}, "format"), ({"surfaces": []}, "surfaces"),
                                           ({"seal": -1}, "seal"),
                                           ({"outputs": {"certificate": True, "surfaces": ["vtp"]},
                                             "surfaces": [{"file": "top.ts", "objects": ["top"]}]}, "whole files")])
def test_projects_that_are_refused(change, words):
    with pytest.raises(terrane.Error, match=words):
        terrane.build({**project(), **change})


def test_certificates_of_a_project_hold():
    wanted = {**project(), "outputs": {"certificate": True, "surfaces": ["vtp"], "blocks": "vtp"}}
    terrane.build(wanted).save("certified")
    for name in ("certificate.json", "certificate_blocks.json"):
        assert not terrane.verify("certified/" + name, folder=".").violations


def test_errors_of_projects_name_their_key():
    with pytest.raises(terrane.Error) as raised:
        terrane.build({**project(), "seal": "much"})
    assert raised.value.place == "project: seal"


def test_a_project_without_folder_is_not_saved():
    with pytest.raises(terrane.Error, match="folder"):
        terrane.build(project()).save()


# --- Verification


@pytest.fixture
def certificate():
    """A certificate with its files."""
    status, _, text = run_program("arrange", *THREE, "-o", "model.vtp", "--certificate", "c.json")
    assert status == 0, text
    return "c.json"


def test_certificates_are_verified(certificate):
    verdict = terrane.verify(certificate, folder="/")
    assert verdict and verdict.outputs[0].check == "inflated" and verdict.deviation < 1e-6
    assert verdict.digest == terrane.arrange(terrane.read(THREE)).digest()
    assert "verified" in repr(verdict)


def test_forged_outputs_are_found(certificate):
    data = bytearray(open("model.vtp", "rb").read())
    data[len(data) // 2] ^= 1
    open("model.vtp", "wb").write(data)
    verdict = terrane.verify(certificate, folder="/")
    assert not verdict and verdict.outputs[0].violations[0].rule.startswith("R21")


def test_forged_certificates_are_found(certificate):
    claims = json.load(open(certificate))
    claims["exact"]["triangles"][0], claims["exact"]["triangles"][1] = claims["exact"]["triangles"][1], claims["exact"]["triangles"][0]
    json.dump(claims, open(certificate, "w"))
    verdict = terrane.verify(certificate, folder="/")
    assert not verdict and verdict.violations and "refuted" in repr(verdict)


def test_missing_outputs_are_not_verified(certificate):
    os.remove("model.vtp")
    verdict = terrane.verify(certificate, folder="/")
    assert not verdict and verdict.outputs[0].check.startswith("missing") and not verdict.violations


def test_inputs_of_certificates(certificate):
    assert terrane.verify(certificate, inputs=THREE)
    assert terrane.verify(certificate, inputs=[THREE[1], THREE[0], THREE[2]]).violations
    with pytest.raises(terrane.Error, match="3 files, not 1"):
        terrane.verify(certificate, inputs=THREE[:1])


@pytest.mark.parametrize("options", [{"inputs": ["other.ts"]}, {"inputs": 0}, {"max_deviation": 1e-300}, {"max_deviation": "x"},
                                     {"max_change": "x"}, {"max_change": 1.0}])
def test_verify_refuses_what_it_would_ignore(options, arrangement, rounded):
    for result in (arrangement, rounded, rounded.mesh):
        with pytest.raises(TypeError, match=f"{[*options][0]} is for certificates, not for {type(result).__name__}"):
            terrane.verify(result, **options)


def test_verify_finds_what_is_no_mesh():
    assert terrane.verify(terrane.mesh(stack())).violations


def test_verify_judges_an_arrangement_by_its_inputs():
    given = [sheet(3, 3), wall()]
    a = terrane.arrange(given)
    assert terrane.verify(a)
    moved = np.array(given[0].vertices)
    moved[4] += 0.1
    assert not terrane.verify(terrane.Arrangement(a._core, ("arrange", [given[0].replace(vertices=moved), given[1]], "auto")))


@pytest.mark.parametrize("value", [3, None, [], {}])
def test_verify_refuses(value):
    with pytest.raises(TypeError):
        terrane.verify(value)


@pytest.mark.tetgen
def test_edge_lengths_improve_the_model_first(model):
    better = model.improved(0.8)
    assert better.is_improved and not model.is_improved
    assert list(better.blocks) == list(model.blocks)
    for name in model.blocks:
        assert better.blocks[name].volume == pytest.approx(model.blocks[name].volume, rel=0.05)
    cells = model.tetrahedra(edge_length=0.8)
    assert cells == better.tetrahedra(edge_length=0.8)
    assert cells.shape()["dihedral"][0] > model.tetrahedra().shape()["dihedral"][0]


def test_improved_models_are_pickled(model):
    import pickle
    better = model.improved(0.8)
    assert pickle.loads(pickle.dumps(better)) == better != model


def test_a_model_of_a_project_is_improved_by_the_project():
    with pytest.raises(terrane.Error) as raised:
        terrane.build(project()).model.improved(0.8)
    assert raised.value.code == "unsupported"
