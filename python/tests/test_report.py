# SPDX-License-Identifier: LGPL-3.0-or-later
"""Report pages: the same content as the program's for the same surfaces."""

import base64
import gzip
import json
import os
import pickle
import re
import struct

import pytest

import terrane
from conftest import DATA, SANITIZED, run_program, sheet, stack

#: A box inside of the horizons.
CORNERS = ((0, 0, -1700), (2000, 1500, -700))
OPTION = "--box=0,0,-1700,2000,1500,-700"
FILES = [DATA / "top.ts", DATA / "base.ts", DATA / "fault.ts"]
#: What only the program knows, which reads files and measures times, and how the call was spelled.
PROGRAMS = {"command", "title", "statistics", "tables"}
needs_pages = pytest.mark.skipif(not terrane.HAS_REPORTS, reason="this build has no report pages")


def content_of(path):
    """Return the content and the arrays of a page."""
    text = open(path, encoding="utf-8").read()
    packed = re.search(r'id="terrane-data">([^<]*)<', text).group(1)
    raw = gzip.decompress(base64.b64decode(packed, validate=True))
    length = struct.unpack("<I", raw[:4])[0]
    return json.loads(raw[4:4 + length]), raw[4 + length:]


def table(content, title):
    return next(t["rows"] for t in content["tables"] if t["title"] == title)


def assert_same_pages(ours, theirs, command):
    """Compare a page of the package with one of the program."""
    (mine, my_arrays), (wanted, arrays) = content_of(ours), content_of(theirs)
    assert my_arrays == arrays, "geometry"
    assert mine["command"] == command
    assert any(surface["file"] for surface in wanted["surfaces"])
    for surface in wanted["surfaces"]:
        surface["file"] = None  # surfaces of Python come from no file
    for key in wanted.keys() - PROGRAMS:
        assert mine[key] == wanted[key], key
    assert mine.keys() == wanted.keys()
    ignored = {"Surfaces", "Input files", "Options", "Numbers of the run"}
    for tables in (mine, wanted):
        tables["tables"] = [t for t in tables["tables"] if t["title"] not in ignored]
    assert mine["tables"] == wanted["tables"]
    return mine


@needs_pages
def test_a_model_has_the_page_of_the_program():
    model = terrane.model(terrane.read(FILES), box=CORNERS)
    model.report("python.html", threads=2)
    status, _, said = run_program("report", *FILES, OPTION, "-o", "program.html")
    assert status == 0, said
    mine = assert_same_pages("python.html", "program.html", "Model.report")
    assert len(mine["blocks"]) == len(model.blocks) > 1
    assert mine["title"] == model.labels[0] + " and 2 more"
    assert mine["certificates"] == [] and ["certificate", "None was asked for."] in table(mine, "Verdict")


@needs_pages
def test_sealed_and_improved_models_have_their_findings_and_plots():
    surfaces = stack()
    short = surfaces[2].vertices.copy()
    short[:, 2] *= 0.31  # ends near the horizons
    surfaces[2] = surfaces[2].replace(vertices=short)
    model = terrane.model(surfaces, box=((0.2, 0.2, -2.0), (4.8, 4.8, 2.0)), seal=0.4)
    model.report("sealed.html")
    content, _ = content_of("sealed.html")
    closed = content["findings"]["counts"].get("closed gap", 0)
    assert closed == len(model.sealed["closed"]) > 0
    assert ["seal", "0.4"] in table(content, "Options")
    model.improved(0.5).report("improved.html")
    content, _ = content_of("improved.html")
    quality = next(p for p in content["plots"] if p["title"].startswith("Quality"))
    assert [s["name"] for s in quality["series"]] == ["before", "after"]
    assert sum(quality["series"][1]["values"]) == len(model.improved(0.5).mesh.triangles)


@needs_pages
def test_an_arrangement_has_the_page_of_the_program():
    terrane.arrange(terrane.read(FILES)).report("python.html")
    status, _, said = run_program("arrange", *FILES, "-o", "a.obj", "--report", "program.html")
    assert status == 0, said
    assert assert_same_pages("python.html", "program.html", "Arrangement.report")["blocks"] == []


def holed():
    """Return a wavy sheet with a hole."""
    surface = sheet(nx=24, ny=24, name="top", role="horizon", wave=0.4)
    middle = surface.vertices[surface.triangles].mean(axis=1)[:, :2]
    return surface.replace(triangles=surface.triangles[((middle - 2.5) ** 2).sum(axis=1) > 0.6])


@needs_pages
@pytest.mark.parametrize("method", ["kriging", "rbf"])
def test_a_filled_surface_has_the_page_of_the_program(method):
    terrane.save([holed()], "holed.ts")
    filled = terrane.fill(terrane.read("holed.ts")[0], method=method)
    filled.report("python.html")
    status, _, said = run_program("fill", "holed.ts", "-o", "f.ts", "--method", method, "--report", "program.html")
    assert status == 0, said
    content = assert_same_pages("python.html", "program.html", "Filled.report")
    plot = next(p for p in content["plots"] if p["title"].startswith("Cross-validation"))
    points = plot["lines"][0]
    assert len(points["x"]) > 10
    squares = [(x - y) ** 2 for x, y in zip(points["x"], points["y"])]
    rms = (sum(squares) / len(squares)) ** 0.5
    assert rms == pytest.approx(filled.holes[0].report.validated_error, rel=1e-6), "of blocks as of all data"
    with pytest.raises(terrane.Error, match="pickle") as raised:
        pickle.loads(pickle.dumps(filled)).report("again.html")
    assert raised.value.code == "unsupported" and not os.path.exists("again.html")


@needs_pages
@pytest.mark.tetgen
def test_tetrahedra_have_the_page_of_the_program():
    # Other tests run the optimisation under the sanitizers, where it takes ten seconds.
    cells = terrane.model(terrane.read(FILES), box=CORNERS).tetrahedra(optimise=not SANITIZED)
    cells.report("python.html")
    words = ["--no-optimise"] if SANITIZED else []
    status, _, said = run_program("tetrahedralize", *FILES, OPTION, *words, "-o", "t.vtu", "--report", "program.html")
    assert status == 0, said
    (mine, arrays), (wanted, others) = content_of("python.html"), content_of("program.html")
    assert arrays == others
    assert mine["arrays"]["tetrahedra"]["count"] == 4 * int((cells.block_of > 0).sum())
    worst = [f for f in mine["findings"]["list"] if f["kind"] == "worst tetrahedron"]
    assert worst == [f for f in wanted["findings"]["list"] if f["kind"] == "worst tetrahedron"] != []
    with pytest.raises(terrane.Error, match="model"):
        pickle.loads(pickle.dumps(cells)).report("again.html")


@needs_pages
def test_places_that_cannot_be_written(model, arrangement):
    for result in (model, arrangement):
        with pytest.raises(terrane.Error) as raised:
            result.report("none/page.html")
        assert raised.value.code == "cannot_open" and "none" in str(raised.value)
    open("page.html", "w").close()
    model.report("page.html")
    first = open("page.html", "rb").read()
    model.report("page.html", threads=1)
    assert len(first) > 100_000


@needs_pages
def test_a_page_depends_on_no_threads(model):
    model.report("one.html", threads=1)
    model.report("three.html", threads=3)
    assert content_of("one.html") == content_of("three.html")
    run = re.search(r'id="terrane-run">([^<]*)<', open("three.html", encoding="utf-8").read()).group(1)
    assert json.loads(run) == {"seconds": {}, "peak_rss_mb": None, "threads": 3}


@pytest.mark.skipif(terrane.HAS_REPORTS, reason="this build has report pages")
def test_a_build_without_pages_says_so(model, arrangement):
    for result in (model, arrangement, terrane.fill(holed())):
        with pytest.raises(terrane.Error, match="built without report pages: ") as raised:
            result.report("page.html")
        assert raised.value.code == "unsupported" and not os.path.exists("page.html")
