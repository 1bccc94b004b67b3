# SPDX-License-Identifier: LGPL-3.0-or-later
"""Ensembles: the same whoever computes them, kept and gone on with, matched, and right."""

import csv
import json
import os
import pathlib
import pickle
import re
import signal
import statistics
import subprocess
import sys
import time

import numpy as np
import pytest

import terrane
from conftest import BOX, PROGRAM, SANITIZED, run_program, run_python, sheet, stack, wall
from terrane import _ensemble, _ensemble_blocks, _ensemble_form, _ensemble_kept, _ensemble_work
from terrane._run import cores

NORMAL = statistics.NormalDist()


needs_own_interpreter = pytest.mark.skipif(SANITIZED, reason="its processes would need the sanitizer's library first")


def write_stack():
    """Write the two horizons and the fault of `stack`, and a project that moves them."""
    for surface in stack():
        surface.save(surface.name + ".ts")
    project = {
        "format": "terrane-project 1",
        "surfaces": [{"file": f"{s.name}.ts", "role": s.role} for s in stack()],
        "volume_of_interest": {"box": {"low": BOX[0], "high": BOX[1]}},
        "outputs": {"blocks": "vtp"},
        "uncertainty": [{"surface": "top", "field": {"range": 3, "sd": 0.1}, "shift": 0.1},
                        {"surface": "base", "field": {"model": "spherical", "range": 2, "sd": 0.05}},
                        {"surface": "F1", "shift": 0.2, "dip": 1, "throw": 0.1}]}
    pathlib.Path("p.json").write_text(json.dumps(project))
    return project


def files_of(made):
    return made._model, made._records


def test_bytes_do_not_depend_on_order_or_what_was_made_before():
    write_stack()
    made = terrane.ensemble("p.json", realisations=6, engine="serial", contacts=0.5)
    assert not made.failures and len(made.blocks) == 6
    task = made._task
    _ensemble_work._prepared.clear()
    for number in (5, 2):
        assert _ensemble_work.run_one(task, number)[0] == made._records[number - 1]
    assert terrane.ensemble("p.json", realisations=3, engine="serial", contacts=0.5)._records == made._records[:3]
    assert terrane.ensemble("p.json", realisations=3, engine="serial", contacts=0.5, threads=2)._records \
        == made._records[:3]
    assert terrane.ensemble("p.json", realisations=3, engine="serial", contacts=0.5, seed=2)._records[0] \
        != made._records[0]
    assert pickle.loads(pickle.dumps(made)) == made


def wait_until_it_listens(process, number):
    """Wait until a program answers this signal itself, now or once its interpreter has started."""
    while process.poll() is None:
        status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
        masks = re.findall(r"^Sig(?:Blk|Cgt):\s+(\w+)", status, flags=re.M)
        if any(int(mask, 16) >> (number - 1) & 1 for mask in masks):
            return
        time.sleep(0.001)


def wait_for_realisations(folder, count):
    """Wait until a command that writes the folder has finished so many realisations."""
    while len(list(pathlib.Path(".").glob(f"{folder}.realisations/*/*.npz"))) < count:
        time.sleep(0.01)


def test_a_stopped_call_goes_on_from_what_is_kept(monkeypatch):
    write_stack()
    wanted = files_of(terrane.ensemble("p.json", realisations=8, engine="serial"))

    def stop(stage, share):
        if share >= 0.5:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        terrane.ensemble("p.json", realisations=8, engine="serial", keep="kept", progress=stop)
    kept = sorted(pathlib.Path("kept").glob("*/*"))
    assert [p.name for p in kept] == [f"{i:06d}.npz" for i in (1, 2, 3, 4)]
    kept[1].write_bytes(kept[1].read_bytes()[:100])  # broken by the machine going down
    kept[2].write_bytes(kept[3].read_bytes())  # another realisation
    made = []
    true = _ensemble_work.run_one
    monkeypatch.setattr(_ensemble_work, "run_one", lambda task, number: made.append(number) or true(task, number))
    assert files_of(terrane.ensemble("p.json", realisations=8, engine="serial", keep="kept")) == wanted
    assert made == [2, 3, 5, 6, 7, 8]
    made.clear()
    terrane.ensemble("p.json", realisations=2, engine="serial", keep="kept", seed=5)
    assert made == [1, 2]  # nothing of another seed
    made.clear()
    sheet(z=1.2, name="top", role="horizon").save("top.ts")
    terrane.ensemble("p.json", realisations=2, engine="serial", keep="kept")
    assert made == [1, 2]  # nor of other surfaces


@pytest.mark.parametrize("options, threads", [({"engine": "serial"}, 1), ({"engine": "serial", "threads": 3}, 3),
                                              pytest.param({"workers": 2}, min(2, cores()),
                                                           marks=needs_own_interpreter)])
def test_the_model_as_given_is_built_once_before_the_workers_start(monkeypatch, options, threads):
    write_stack()
    wanted = files_of(terrane.ensemble("p.json", realisations=2, engine="serial"))
    made = []

    def counted(task, number):
        made.append((number, task.threads))
        return _ensemble_work.built(task, number)

    monkeypatch.setattr(_ensemble, "built", counted)
    assert files_of(terrane.ensemble("p.json", realisations=2, **options)) == wanted
    assert made == [(0, threads)]


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


@pytest.mark.skipif(SANITIZED, reason="the program's interpreter would need the sanitizer's library first")
def test_the_program_is_interrupted_and_goes_on():
    write_stack()
    options = ["--realisations", "60", "--engine", "serial", "--contact", "-0.5"]
    status, out, err = run_program("ensemble", "p.json", "-o", "whole", *options)
    assert (status, err) == (0, ""), err
    assert out.startswith("60 realisations, seed 1: all built\n")
    running = subprocess.Popen([PROGRAM, "ensemble", "p.json", "-o", "run", *options], stderr=subprocess.PIPE, text=True)
    wait_for_realisations("run", 5)
    running.send_signal(signal.SIGINT)
    assert running.communicate()[1] == (
        "terrane: interrupted, finished realisations are kept in run.realisations; the same command goes on from "
        "there\n")
    assert running.returncode == 2 and not os.path.exists("run")
    status, out, err = run_program("ensemble", "p.json", "-o", "run", *options)
    assert (status, err) == (0, "")
    assert "computed 60 of" not in out
    assert not os.path.exists("run.realisations")
    names = sorted(p.relative_to("whole") for p in pathlib.Path("whole").rglob("*") if p.is_file())
    assert names == sorted(p.relative_to("run") for p in pathlib.Path("run").rglob("*") if p.is_file())
    for name in names:
        if name.suffix != ".h5":  # whose layout on disk is the library's affair
            assert (pathlib.Path("whole") / name).read_bytes() == (pathlib.Path("run") / name).read_bytes(), name
    assert len(rows_of("run/blocks.csv")) == 60 * 6


def workers_here():
    """Return the workers of ensembles that run in this folder."""
    found = []
    for path in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if b"_ensemble_workers" in (path / "cmdline").read_bytes() and os.readlink(path / "cwd") == os.getcwd():
                found.append(path.name)
        except OSError:
            continue
    return found


@pytest.mark.skipif(SANITIZED, reason="the program's interpreter would need the sanitizer's library first")
@pytest.mark.parametrize("engine", ["serial", "processes"])
def test_an_interrupt_at_any_time_ends_the_program_with_one_line(engine):
    """While the interpreter starts, its packages are imported, workers start, and realisations are computed."""
    write_stack()
    for k, number in enumerate([signal.SIGINT, signal.SIGTERM, signal.SIGHUP] * 2):
        running = subprocess.Popen([PROGRAM, "ensemble", "p.json", "-o", f"run{k}", "--engine", engine,
                                    "--realisations", "5000"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        wait_until_it_listens(running, number)
        time.sleep(0.4 * k)
        running.send_signal(number)
        if k >= 3:  # the user insists
            running.send_signal(number)
        out, err = running.communicate()
        assert (out, running.returncode) == ("", 2), (k, out, err)
        assert re.fullmatch("terrane: interrupted(, nothing written|, finished realisations are kept .*)?\n", err), (k, err)
        assert not os.path.exists(f"run{k}")
        while workers_here():  # killed ones need a moment
            time.sleep(0.01)


#: Runs the command, and sends it signals when it calls some of its functions. A "+" after the name of a function sends
#: two signals at once. A "!" drops the exception that the signal raises, as Python does in __del__.
SIGNALLED = """
import os, signal, sys
from terrane import _ensemble_command as command, _ensemble_output as output

def signalled(real, how):
    def at(*given, **named):
        if "+" in how:
            signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGTERM})
            os.kill(os.getpid(), signal.SIGTERM)
        try:
            os.kill(os.getpid(), signal.SIGINT)
            signal.pthread_sigmask(signal.SIG_SETMASK, ())
        except KeyboardInterrupt:
            if "!" not in how:
                raise
        return real(*given, **named)
    return at

for place in sys.argv[1].split(","):
    name = place.rstrip("+!")
    for module in (command, output):
        if hasattr(module, name):
            setattr(module, name, signalled(getattr(module, name), place[len(name):]))
sys.exit(command.main(sys.argv[2:]))
"""


@pytest.mark.parametrize("options, places, written", [
    *(("--realisations=2", places, False) for places in (
        "discard", "ensemble", "_write_all!", "_write_hdf5", "summary+", "_write_hdf5,_fail+", "_write_hdf5!,_fail+",
        "summary+,_fail+")),
    pytest.param("--realisations=2 --engine=processes", "ensemble,_fail+", False, marks=needs_own_interpreter),
    *(("--realisations=2", places, True) for places in ("remove+", "_print")),
    *(("--only=1", places, False) for places in ("run_one", "_write_project+", "_write_project!,_fail+")),
    ("--only=1", "_print+", True)])
def test_an_interrupt_while_it_writes_leaves_all_or_nothing(options, places, written):
    write_stack()
    before = set(os.listdir())
    done = run_python(SIGNALLED, places, "p.json", "--output=run", "--engine=serial", *options.split(), check=False)
    if written:
        assert (done.returncode, done.stderr) == (0, "")
        assert os.path.exists("run/project.json" if "only" in options else "run/percentiles.csv")
        assert set(os.listdir()) == {*before, "run"}
    else:
        assert (done.returncode, done.stdout) == (2, "")
        assert re.fullmatch("terrane: interrupted, (nothing written|finished realisations are kept .*)\n", done.stderr)
        assert set(os.listdir()) - {"run.realisations"} == before


@pytest.mark.skipif(SANITIZED, reason="the program's interpreter would need the sanitizer's library first")
def test_one_realisation_alone_is_that_of_the_ensemble():
    write_stack()
    made = terrane.ensemble("p.json", realisations=4, engine="serial")
    status, out, err = run_program("ensemble", "p.json", "-o", "four", "--only", "4")
    assert (status, err) == (0, "")
    assert run_program("build", "four/project.json", "-o", "model")[0] == 0
    blocks = json.loads(pathlib.Path("model/model/model.json").read_text())["blocks"]
    volumes = made.table["volume"][made.table["realisation"] == 4]
    found = {b["name"]: b["volume"] for b in blocks if b["name"] != "outside"}
    assert sorted(found.values()) == sorted(volumes)
    with pytest.raises(terrane.Error, match="no empty folder"):
        made.write_project(4, "four")


@pytest.mark.skipif(SANITIZED, reason="the program's interpreter would need the sanitizer's library first")
def test_mistakes_have_a_status_and_a_message():
    project = write_stack()
    for change, words in [({"uncertainty": None}, "p.json: uncertainty: is missing"),
                          ({"uncertainty": [{"surface": "tpo", "shift": 1}]}, "did you mean top?"),
                          ({"uncertainty": [{"surface": "top"}]}, "at least one of the keys field, shift"),
                          ({"uncertainty": [{"surface": "top", "field": {"range": 1}}]}, "one of the keys sd and map"),
                          ({"uncertainty": [{"surface": "top", "field": {"range": 1, "map": "no.asc"}}]}, "no.asc")]:
        changed = {k: v for k, v in {**project, **change}.items() if v is not None}
        pathlib.Path("p.json").write_text(json.dumps(changed))
        status, out, err = run_program("ensemble", "p.json", "-o", "run", "--engine", "serial")
        assert (status, out) == (2, "") and words in err, err
        assert not os.path.exists("run")
    pathlib.Path("p.json").write_text(json.dumps(project))
    status, out, err = run_program("ensemble", "p.json", "--engine", "serial")
    assert status == 2 and "the key folder is missing" in err
    for options, words in [(["--engine", "serial", "--scheduler", "tcp://x:1"], "engine: goes with no scheduler, whose workers compute"),
                           (["--engine", "serial", "--workers", "2"], "workers: is for the engine processes, not serial"),
                           (["--only", "3", "--realisations", "5"], "--realisations: is for all versions, not for --only")]:
        status, out, err = run_program("ensemble", "p.json", "-o", "run", *options)
        assert (status, out) == (2, "") and words in err, err
    os.environ["TERRANE_PYTHON"] = "/no/python"
    try:
        status, out, err = run_program("ensemble", "p.json", "-o", "run")
    finally:
        del os.environ["TERRANE_PYTHON"]
    assert status == 2 and "/no/python: cannot be run" in err
    for options, words in [({"engine": "slurm"}, "none of processes, mpi, serial"),
                           ({"engine": "serial", "scheduler": "tls://x:1"}, "'serial'"),
                           ({"engine": "serial", "workers": 2}, "workers: is for the engine processes"),
                           ({"scheduler": "tls://x:1", "workers": 2}, "workers: is for the engine processes"),
                           ({"workers": 0}, "workers: 0 is not from 1")]:
        with pytest.raises(terrane.Error, match=words):
            terrane.ensemble("p.json", **options)


def test_failures_are_named_and_can_be_reproduced(monkeypatch):
    write_stack()
    true = _ensemble_work.built

    def built(task, number):
        if number == 2:
            raise terrane.Error("improper_contact", "the rounded mesh is not conforming")
        return true(task, number)

    monkeypatch.setattr(_ensemble_work, "built", built)
    made = terrane.ensemble("p.json", realisations=3, engine="serial")
    assert made.failures == [terrane.Failure(2, "improper_contact", "the rounded mesh is not conforming")]
    assert all(b.measures["volume"]["count"] == 2 for b in made.blocks.values())
    made.save("run")
    assert pathlib.Path("run/failures/000002/reason.txt").read_text() == "the rounded mesh is not conforming\n"
    assert len(terrane.build("run/failures/000002/project.json").model.blocks) == 6
    assert "1 failed, see below" in pathlib.Path("run/report.html").read_text()
    assert [r["status"] for r in rows_of("run/realisations.csv")] == ["done", "failed", "done"]


def test_passing_errors_are_tried_again(monkeypatch):
    write_stack()
    tries = []
    true = _ensemble_work.built

    def built(task, number):
        if number == 1 and len(tries) < 2:
            tries.append(number)
            raise terrane.OutOfMemory("out_of_memory", "not enough memory")
        return true(task, number)

    monkeypatch.setattr(_ensemble_work, "built", built)
    assert not terrane.ensemble("p.json", realisations=1, engine="serial", retries=2).failures
    tries.clear()
    made = terrane.ensemble("p.json", realisations=1, engine="serial", retries=1)
    assert [f.code for f in made.failures] == ["out_of_memory"]


def block(name, sides, volume=1.0, middle=(0, 0, 0)):
    return {"name": name, "sides": dict.fromkeys(sides.split(), 1.0), "middle": middle, "volume": volume, "area": 1.0,
            "low": 0.0, "high": 1.0, "thickness": [1.0, 1.0, 1.0], "above": [], "height": []}


MODEL = [block("west", "top+ base- F+"), block("east", "top+ base- F-"), block("below", "base+")]


@pytest.mark.parametrize("blocks, states, volumes, new", [
    ([block("a", "top+ base- F+", 2), block("b", "top+ base- F-", 3), block("c", "base+", 4)],
     ["whole"] * 3, [2, 3, 4], []),
    ([block("a", "top+ base- F+ G+", 2), block("b", "top+ base- F-", 3), block("c", "base+", 4)],  # touches G as well
     ["whole"] * 3, [2, 3, 4], []),
    ([block("a", "top+ base- F+", 2), block("a2", "top+ base- F+", 1), block("b", "top+ base- F-", 3),
      block("c", "base+", 4)], ["split", "whole", "whole"], [3, 3, 4], []),
    ([block("b", "top+ base- F-", 3), block("c", "base+", 4)], ["vanished", "whole", "whole"], [0, 3, 4], []),
    ([block("ab", "top+ base- F+ F-", 5), block("c", "base+", 4)], ["merged", "merged", "whole"], [None, None, 4], []),
    ([block("all", "top+ base- base+ F+ F-", 9)], ["merged"] * 3, [None] * 3, []),
    ([block("a", "top+ base- F+", 2), block("b", "top+ base- F-", 3), block("c", "base+", 4), block("n", "G+ H-")],
     ["whole"] * 3, [2, 3, 4], ["n"]),
])
def test_blocks_are_matched_by_what_bounds_them(blocks, states, volumes, new):
    for order in (blocks, blocks[::-1]):
        found = _ensemble_blocks.match(MODEL, order, ())
        assert [b.state for b in found.blocks] == states
        for matched, volume in zip(found.blocks, volumes):
            assert matched.values["volume"] == volume if volume is not None else np.isnan(matched.values["volume"])
        assert [n for n in found.new if n != "all"] == new


def test_equal_blocks_are_matched_by_place():
    model = [block("a", "top+", middle=(0, 0, 0)), block("b", "top+", middle=(10, 0, 0))]
    found = _ensemble_blocks.match(model, [block("y", "top+", 2, (9, 0, 0)), block("x", "top+", 1, (1, 0, 0))], ())
    assert [b.values["volume"] for b in found.blocks] == [1, 2]


def test_p90_is_exceeded_with_a_probability_of_90_percent():
    values = _ensemble_blocks.percentiles([float(i) for i in range(101)] + [float("nan")])
    assert (values["p90"], values["p50"], values["p10"], values["count"]) == (10, 50, 90, 101)


def dome(radius, height, n=32):
    """Return the paraboloid z = height (1 - r^2 / radius^2) over a square of 2.5 radii."""
    flat = sheet(n, n, low=(-1.25 * radius, -1.25 * radius), size=(2.5 * radius, 2.5 * radius))
    v = np.array(flat.vertices)
    v[:, 2] = height * (1 - (v[:, 0] ** 2 + v[:, 1] ** 2) / radius ** 2)
    return terrane.Surface(v, flat.triangles, "dome", "horizon")


def probability_bounds(share, count):
    """Return probabilities between which a quantile of this share lies, but once in 30 000 times."""
    far = 4.2 * (share * (1 - share) / count) ** 0.5
    return share - far, share + far


def check_dome(count, engine="serial"):
    """Check the percentiles of a dome's volume above a contact, whose distribution is known in closed form.

    With the height h of the apex above the contact, the volume is pi R^2 h^2 / (2 H): it grows with h, and h is normal.
    """
    radius, height, sd = 1000.0, 100.0, 15.0
    dome(radius, height).save("dome.ts")
    project = {"format": "terrane-project 1", "surfaces": [{"file": "dome.ts"}], "outputs": {"blocks": "vtp"},
               "volume_of_interest": {"box": {"low": [-1200, -1200, -400], "high": [1200, 1200, 400]}},
               "uncertainty": [{"surface": "dome", "shift": sd}]}
    made = terrane.ensemble(project, realisations=count, engine=engine, contacts=0.0, grid=10)
    volume = made.blocks["below dome"].measures["volume_above"]
    column = made.blocks["below dome"].measures["column"]

    def true_volume(probability):
        apex = height + sd * NORMAL.inv_cdf(probability)
        return np.pi * radius ** 2 * apex ** 2 / (2 * height)

    facets = 0.006  # the triangles are below the paraboloid
    for name, share in (("p90", 0.1), ("p50", 0.5), ("p10", 0.9)):
        low, high = probability_bounds(share, count)
        assert true_volume(low) * (1 - facets) < volume[name] < true_volume(high) * (1 + facets), name
        assert height + sd * NORMAL.inv_cdf(low) - 0.5 < column[name] < height + sd * NORMAL.inv_cdf(high) + 0.5
    shifts = made.table["column"][made.table["block"] == "below dome"]
    sd_map = made.depth_sd["dome"]
    assert np.allclose(sd_map, shifts.std(ddof=1))  # a shift is the same everywhere
    return made


@pytest.mark.skipif(SANITIZED, reason="it judges numbers, which are the same in every build")
def test_the_volume_of_a_dome_has_its_distribution():
    made = check_dome(int(os.environ.get("TERRANE_DOME_REALISATIONS", "250")))
    volume = made.blocks["below dome"].measures["volume_above"]
    print({name: volume[name] / (np.pi * 1000.0 ** 2 * (100 + 15 * NORMAL.inv_cdf(share)) ** 2 / 200)
           for name, share in (("p90", 0.1), ("p50", 0.5), ("p10", 0.9))})


def test_maps_and_tables_say_the_same():
    write_stack()
    made = terrane.ensemble("p.json", realisations=12, engine="serial", grid=8)
    assert set(made.depth_sd) == {"top", "base", "F1"}
    for name, share in made.probability.items():
        assert share.min() >= 0 and share.max() <= 1 and share.shape == (8, 8), name
        assert np.allclose(share * 12, np.round(share * 12))
    assert made.probability["below base, west of F1"][:, 0].tolist() == [1] * 8
    totals = [made.table["volume"][made.table["realisation"] == n].sum() for n in range(1, 13)]
    assert np.allclose(totals, 4.6 * 4.6 * 4)
    across = [j for j in made.juxtaposed if j.surface == "F1"]
    assert {j.blocks for j in across if j.probability == 1} >= {
        ("above top, east of F1", "above top, west of F1"), ("below base, east of F1", "below base, west of F1")}
    made.save("run")
    assert rows_of("run/percentiles.csv")[0]["block"] == list(made.blocks)[0]
    summary = json.loads(pathlib.Path("run/ensemble.json").read_text())
    assert summary["blocks"]["below base, west of F1"]["whole"] == 12
    points = terrane.read("run/maps/depth_mean_top.csv")
    assert points[0].vertices[:, 2].min() > 0.5
    h5py = pytest.importorskip("h5py")
    with h5py.File("run/ensemble.h5") as file:
        assert np.array_equal(file["blocks/volume"][:], made.table["volume"])
        assert file["blocks/block"].asstr()[0] == made.table["block"][0]
        assert file["maps/depth_sd/000"].attrs["name"] in made.depth_sd


def test_fill_s_errors_move_what_was_filled():
    flat = sheet(21, 21, z=0.0, name="top", role="horizon", size=(10, 10), wave=0.4)
    middle = flat.vertices[flat.triangles].mean(axis=1)
    hole = np.hypot(middle[:, 0] - 5, middle[:, 1] - 5) > 2
    terrane.Surface(flat.vertices, flat.triangles[hole], "top", "horizon").save("top.ts")
    project = {"format": "terrane-project 1", "surfaces": [{"file": "top.ts"}], "outputs": {"blocks": "vtp"},
               "fill": [{"surface": "top"}],
               "volume_of_interest": {"box": {"low": [1, 1, -2], "high": [9, 9, 2]}},
               "uncertainty": [{"surface": "top", "field": {"range": 2, "sd": "kriging"}}]}
    made = terrane.ensemble(project, realisations=10, engine="serial", grid=16)
    deviation = made.depth_sd["top"]
    assert np.nanmax(deviation[[0, -1]]) < 1e-12  # measured
    filled = terrane.fill(terrane.read("top.ts")[0])
    at = np.hypot(filled.surface.vertices[:, 0] - 5, filled.surface.vertices[:, 1] - 5) < 1
    expected = filled.expected_error[at]
    assert expected.min() > 0
    assert expected.min() / 4 < deviation[7:9, 7:9].min() < deviation[7:9, 7:9].max() < 4 * expected.max()


def test_walls_and_floors_are_not_moved():
    box = terrane.box((0, 0, 0), (1, 1, 1))
    terrane.save(box, "box.ts")
    wall().save("F1.ts")
    project = {"format": "terrane-project 1", "surfaces": [{"file": "box.ts", "role": "boundary"}],
               "outputs": {"blocks": "vtp"}, "uncertainty": [{"surface": box[0].name, "shift": 1}]}
    with pytest.raises(terrane.Error, match="is a boundary, which stays"):
        terrane.ensemble(project, realisations=1, engine="serial")


def test_kept_needs_a_folder_that_can_be_made():
    pathlib.Path("file").write_text("")
    task = _ensemble_work.Task(b"", "", "", 1, (), (0, 0, 1, 1), (1, 1), 1, "key", "")
    with pytest.raises(terrane.Error, match="cannot be made"):
        _ensemble_kept.Kept("file/inside", task)


def test_names_on_the_terminal_are_harmless():
    """What could move the cursor, choose a colour, or turn the text round is written as its code."""
    from terrane._ensemble_command import _visible
    turning = "\u061c\u200e\u200f\u2028\u2029\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069"
    for c in "\x00\x07\x08\r\x1b\x7f\x80\x9b\x9f" + turning:
        assert _visible(f"a{c}b") == f"a\\u{ord(c):04x}b"
    assert _visible("砂é\u200d\tA\n") == "砂é\u200d\tA\n"


def forged(record, change):
    """Return the file of a record after a change of its values or maps."""
    values = json.loads(json.dumps(record.values))
    maps = {"heights": np.array(record.heights), "present": np.array(record.present)}
    change(values, maps)
    return _ensemble_work.packed(_ensemble_work.Record(values, **maps))


def set_at(*path, to):
    """Return a change that sets a value in the depth of a record."""
    def change(values, maps):
        for key in path[:-1]:
            values = values[key]
        values[path[-1]] = to
    return change


def test_kept_files_that_no_realisation_has_are_made_again():
    """Values that are no numbers, negative sizes, names that are none, and maps of other sizes."""
    write_stack()
    made = terrane.ensemble("p.json", realisations=1, engine="serial", contacts=0.5, grid=8, keep="kept")
    path = next(pathlib.Path("kept").glob("*/000001.npz"))
    record = _ensemble_form.checked(path.read_bytes(), made._task, 1)
    nan, inf = float("nan"), float("inf")
    changes = [set_at("blocks", 0, key, to=v) for key, v in [
        ("volume", nan), ("volume", inf), ("volume", -1.0), ("volume", "1"), ("volume", None), ("volume", True), ("area", nan),
        ("low", nan), ("high", inf), ("middle", [0, 0]), ("middle", [0, 0, nan]), ("thickness", [1, nan, 1]), ("above", []),
        ("above", [nan]), ("height", [1, 1]), ("name", 5), ("sides", {"top": 1.0}), ("sides", {"": 1.0}), ("sides", []), ("more", 1)]]
    changes += [set_at(*path, to=v) for path, v in [
        (("number",), 2), (("status",), "whole"), (("status",), "failed"), (("blocks",), []), (("surfaces",), ["top"]),
        (("surfaces", 0), 7), (("interfaces", 0, 1), 6), (("interfaces", 0, 1), -2), (("interfaces", 0, 3), nan),
        (("quality", "least_angle"), nan), (("quality", "mean_angle"), -1.0), (("verdict", "leaks"), -1),
        (("verdict", "max_move"), inf), (("areas", "top"), nan), (("more",), 1)]]
    changes += [lambda v, m: v.pop("quality"), lambda v, m: v["blocks"][0].pop("volume"),
                lambda v, m: m.update(heights=m["heights"][:, :-1]), lambda v, m: m.update(heights=m["heights"] * inf),
                lambda v, m: m.update(heights=m["heights"].astype(np.float32)), lambda v, m: m.update(present=m["present"][1:]),
                lambda v, m: m.update(present=m["present"][..., :-8])]
    assert forged(record, lambda v, m: None) == path.read_bytes()
    for number, change in enumerate(changes):
        path.write_bytes(forged(record, change))
        assert terrane.ensemble("p.json", realisations=1, engine="serial", contacts=0.5, grid=8, keep="kept") == made, number
    with pytest.raises(ValueError, match="heights is too large"):  # small on disk: it is not even read
        _ensemble_form.checked(forged(record, lambda v, m: m.update(heights=np.zeros((100, 100, 100)))), made._task, 1)
    failed = {"status": "failed", "code": "internal", "reason": "a", "blocks": [], "interfaces": [], "surfaces": [],
              "boundaries": [], "number": 1}
    assert _ensemble_form.checked(_ensemble_work.packed(_ensemble_work.Record(failed, np.zeros((0, 1, 1)), np.zeros(
        (0, 1, 1), dtype=bool))), made._task, 1).values == failed


def test_the_report_allows_nothing_but_its_own_style():
    import base64
    import hashlib
    write_stack()
    terrane.ensemble("p.json", realisations=3, engine="serial", contacts=0.5, grid=8).save("run")
    page = pathlib.Path("run/report.html").read_text()
    style = re.search(r"<style>(.*)</style>", page, re.S).group(1)
    digest = base64.b64encode(hashlib.sha256(style.encode()).digest()).decode()
    policy = re.search(r'http-equiv="Content-Security-Policy" content="([^"]*)"', page).group(1)
    assert policy == (f"default-src 'none'; script-src 'none'; style-src 'sha256-{digest}'; img-src data: blob:; "
                      "base-uri 'none'; form-action 'none'")
    assert page.index("Content-Security-Policy") < page.index("<style>")
    assert not re.search(r"\sstyle=|<script|\son\w+=|(?:src|href)=\"(?!data:)", page)
    assert page.count("<image ") == 3 + 6  # the maps


