#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Compares terrane-mpi with terrane: the digest, the bytes after convert, and what is left after failures.

    run_mpi.py --terrane FILE --terrane-mpi FILE --mpirun FILE --certified FOLDER [--all]

With --all, which takes minutes, all certified cases are compared in each number of processes, and each process is killed
at three times. Without, one case is in each number and some are in one, and each process is killed at one time.
"""
import argparse
import json
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

# Open MPI refuses to run as root and more processes than cores unless it is told to.
ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                   OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_mpi_yield_when_idle="1",
                   OMPI_MCA_btl_vader_single_copy_mechanism="none")

RANKS = (1, 2, 3, 4, 7)
# Crossing surfaces, coplanar overlaps, repeated and degenerate triangles, and doubles that need repair.
CASES = ("horizons_and_fault", "coplanar_grids", "duplicates", "degenerate", "fractures_20",
         "utm_millimetres", "negative_zero", "triple_point_inexact", "needle_tip", "turned_ridges", "turned_half",
         "close_angle_turned")
# Doubles that are repaired with few triangles near them, in the first process.
REPAIRED = ("needle_tip", "turned_ridges", "turned_half", "close_angle_turned")
# The input is moved, into a frame or to a grid, and arranged again.
MOVED = ("turned_half", "close_angle_turned", "turned_grids")


def run(command, **more):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          env=ENVIRONMENT, check=False, **more)


def inputs_of(folder: Path):
    return sorted(path for path in folder.iterdir() if path.name != "expected.json")


def names_in(folder: Path):
    return sorted(path.name for path in folder.iterdir())


def volumes_of(arguments, mesh: Path, work: Path):
    """What terrane volume finds in a mesh: all blocks together, and each."""
    folder = work / "volumes"
    stats = work / "volumes.json"
    done = run([arguments.terrane, "volume", mesh, "-o", folder, "--stats", stats])
    assert done.returncode == 0, (mesh, done.stderr)
    blocks = json.loads((folder / "model.json").read_text())["blocks"][1:]
    return {"all": json.loads(stats.read_text())["volumes"]["all"], "blocks": [b["volume"] for b in blocks],
            "names": [b["name"] for b in blocks]}


def check_case(arguments, folder: Path, work: Path, numbers):
    """The same digest, bytes and volumes for these numbers of processes."""
    files = inputs_of(folder)
    expected = json.loads((folder / "expected.json").read_text())
    whole = work / "whole.vtp"
    alone = run([arguments.terrane, "arrange", *files, "-o", whole])
    volumes = volumes_of(arguments, whole, work) if alone.returncode == 0 else None
    for ranks in numbers:
        pieces, joined, stats = (work / f"m{ranks}{end}" for end in (".pvtp", ".vtp", ".json"))
        done = run([arguments.mpirun, "-n", ranks, arguments.terrane_mpi, "arrange", *files, "-o", pieces,
                    "--digest", "--volumes", "--stats", stats])
        where = f"{folder.name} with {ranks} processes"
        assert done.returncode == alone.returncode, (where, done.returncode, done.stderr)
        if alone.returncode != 0:
            continue
        found = json.loads(stats.read_text())
        assert found["digest"] == expected["digest"], (where, found["digest"])
        assert found["tiles"] == ranks, where
        if folder.name in REPAIRED:
            assert found["rounding"]["gathered_triangles"] > 0, (where, found)
        assert found["rounding"]["in_tiles"], (where, found)
        assert found["rounding"]["arranged_again"] == (folder.name in MOVED), (where, found)
        assert found["volumes"] == volumes, (where, found["volumes"], volumes)
        converted = run([arguments.terrane, "convert", pieces, joined])
        assert converted.returncode == 0, (where, converted.stderr)
        assert joined.read_bytes() == whole.read_bytes(), f"{where}: other bytes"
        assert len(list((work / f"m{ranks}_pieces").iterdir())) == ranks, where


def check_failures(arguments, folder: Path, work: Path):
    """A process that fails ends all of them with one message and no file."""
    good = inputs_of(folder)
    before = names_in(work)

    def expect(status, sentence, command):
        done = run(command)
        lines = [line for line in done.stderr.splitlines() if line.startswith("terrane")]
        assert done.returncode == status, (done.returncode, done.stderr)
        assert len(lines) == 1 and sentence in lines[0], done.stderr
        assert names_in(work) == before, names_in(work)

    parallel = [arguments.mpirun, "-n", 3, arguments.terrane_mpi, "arrange"]
    expect(2, "missing.obj", [*parallel, *good, work / "missing.obj", "-o", work / "x.pvtp"])
    expect(2, ".pvtp", [*parallel, *good, "-o", work / "x.vtp"])
    expect(2, "no folder", [*parallel, *good, "-o", work / "nowhere" / "x.pvtp"])
    # One process runs out of memory: its limit is below what it needs to read the file.
    large = work / "large.obj"
    with large.open("w") as out:
        for i in range(700):
            for k in range(700):
                out.write(f"v {i} {k} {(i * k) % 7}\n")
        for i in range(699):
            for k in range(699):
                a = i * 700 + k + 1
                out.write(f"f {a} {a + 700} {a + 1}\nf {a + 700} {a + 701} {a + 1}\n")
    before = names_in(work)
    limited = ('if [ "$OMPI_COMM_WORLD_RANK" = 1 ]; then '
               'ulimit -v 280000; fi; exec "$@"')
    done = run([arguments.mpirun, "-n", 3, "sh", "-c", limited, "sh", arguments.terrane_mpi, "arrange", good[0],
                large, large, "-o", work / "x.pvtp"])
    assert done.returncode != 0, done.stdout
    assert "memory" in done.stderr, done.stderr
    assert names_in(work) == before, names_in(work)


def check_one_unlike_the_others(arguments, folder: Path, work: Path):
    """One process that was started otherwise, or fails where others don't, ends all with one message and no file."""
    good = inputs_of(folder)[0].read_text()
    for place in (work, work / "other"):
        place.mkdir(exist_ok=True)
        (place / "in.obj").write_text(good)
    (work / "other/less.obj").write_text(good[:-9])
    (work / "less.obj").write_text(good)
    changed = good[0] + "%" + good[2:]  # as long as the other
    (work / "other/changed.obj").write_text(changed)
    (work / "changed.obj").write_text(good)
    (work / "missing.obj").write_text(good)
    program = arguments.terrane_mpi
    before = names_in(work)

    def expect(sentence, one, inputs="in.obj", status=2):
        line = f"'{program}' arrange {inputs} -o x.pvtp"
        script = f'if [ "$OMPI_COMM_WORLD_RANK" = 1 ]; then {one.format(program=program, line=line)}; else exec {line}; fi'
        done = run([arguments.mpirun, "-n", 3, "sh", "-c", script], cwd=work)
        lines = [text for text in done.stderr.splitlines() if text.startswith("terrane")]
        assert done.returncode == status, (one, done.returncode, done.stderr)
        assert len(lines) == (1 if sentence else 0) and sentence in "".join(lines), (one, done.stderr)
        assert names_in(work) == before, (one, names_in(work))
        assert names_in(work / "other") == sorted(["in.obj", "less.obj", "changed.obj"]), names_in(work / "other")

    version = run([program, "--version"]).stdout.split()[1]
    otherwise = f"process 1 was started as terrane-mpi {version} "
    for words in ("arrange in.obj -o y.pvtp", "arrange in.obj -o x.pvtp --digest", "arrange in.obj -o x.pvtp --rounds 0",
                  "arrange", "--help", "--version", "manual", ""):
        expect((otherwise + words).strip(), "exec '{program}' " + words)
    file = "process 1 does not see the same file as process 0"
    for name in ("less.obj", "changed.obj", "missing.obj"):
        expect(f"{name}: {file}", "cd other; exec {line}", name)
    expect("cannot be written", "cd other; exec {line}")  # where the first process makes no folder
    expect("", "exec sh -c 'kill -9 $$'", status=137)
    expect("", "exit 5", status=5)
    if not os.access("/dev/full", os.W_OK):
        return
    full = run([arguments.mpirun, "-n", 2, "sh", "-c", f"exec '{program}' manual > /dev/full"], cwd=work)
    assert full.returncode == 2, (full.returncode, full.stderr)


def check_killed(arguments, work: Path):
    """A process that is killed at work ends all. Nothing is left, or all is there."""
    n = 120
    lines = [f"v {i} {k} {(i * k) % 7}" for i in range(n) for k in range(n)]
    lines += [f"v {i} {n / 2} {k / 9}" for i in range(n) for k in range(n)]
    for name, first in (("a", 1), ("b", 1 + n * n)):
        lines.append(f"o {name}")
        for i in range(n - 1):
            for k in range(n - 1):
                a = first + i * n + k
                lines += [f"f {a} {a + n} {a + 1}", f"f {a + n} {a + n + 1} {a + 1}"]
    (work / "in.obj").write_text("\n".join(lines) + "\n")
    killed = hidden = 0
    times = (0, 0.1, 0.4)
    for rank in (0, 1, 2):
        for seconds in times if arguments.all else (times[rank],):
            # It blocks SIGTERM, and not SIGSEGV, once MPI has started and all have agreed on what to do. Before,
            # mpirun itself can fail to end.
            script = (f'if [ "$OMPI_COMM_WORLD_RANK" = {rank} ]; then (until ! [ -e /proc/$$ ] || '
                      "grep -Eq '^SigBlk:.*[4-7][0-389ab][0-9a-f]{2}$' /proc/$$/status; do sleep 0.01; done; "
                      f"sleep {seconds}; kill -9 $$) & fi; "
                      f"exec '{arguments.terrane_mpi}' arrange in.obj -o x.pvtp")
            done = run([arguments.mpirun, "-n", 3, "sh", "-c", script], cwd=work)
            left = names_in(work)
            where = (rank, seconds, done.returncode, done.stderr, left)
            complete = ["in.obj", "x.pvtp", "x_pieces"]
            if done.returncode == 0:
                assert left == complete, where
                (work / "x.pvtp").unlink()
                shutil.rmtree(work / "x_pieces")
                continue
            killed += 1
            # The last process names the results; it may have been killed just then. The others are asked to end, and
            # mpirun kills them after a second, which is too short on a busy machine: then a hidden folder stays.
            assert [name for name in left if name[0] != "."] in (["in.obj"], complete) or rank == 2, where
            hidden += left not in (["in.obj"], complete)
            for name in left[:]:
                assert name in complete or name.startswith(".x"), where
                if name != "in.obj":
                    shutil.rmtree(work / name) if (work / name).is_dir() else (work / name).unlink()
    assert hidden <= 5, hidden
    print(f"{killed} runs were killed, {hidden} of them left a hidden folder")


def check_quiet(arguments, folder: Path, work: Path):
    line = [arguments.mpirun, "-n", 2, arguments.terrane_mpi, "arrange", *inputs_of(folder), "-o"]
    assert "wrote" in run([*line, work / "loud.pvtp"]).stdout
    done = run([*line, work / "quiet.pvtp", "--quiet"])
    assert (done.returncode, done.stdout, done.stderr) == (0, "", ""), done
    assert (work / "quiet.pvtp").exists()


def check_pieces(arguments, folder: Path, work: Path):
    """Names of pieces are data: none leaves the folder, and what does not fit is refused."""
    pieces = work / "p.pvtp"
    done = run([arguments.mpirun, "-n", 2, arguments.terrane_mpi, "arrange", *inputs_of(folder), "-o", pieces])
    assert done.returncode == 0, done.stderr
    again = run([arguments.mpirun, "-n", 2, arguments.terrane_mpi, "arrange", *inputs_of(folder), "-o", pieces])
    assert again.returncode == 2 and "not empty" in again.stderr, again.stderr
    text = pieces.read_text()
    outside = work / "outside"
    outside.mkdir()
    (outside / "p_0.vtp").write_bytes((work / "p_pieces" / "p_0.vtp").read_bytes())
    inner = work / "inner"
    inner.mkdir()
    (inner / "link").symlink_to(outside)
    for source in ("../outside/p_0.vtp", str(outside / "p_0.vtp"), "link/p_0.vtp", "missing.vtp", ""):
        (inner / "q.pvtp").write_text(text.replace("p_pieces/p_0.vtp", source))
        refused = run([arguments.terrane, "convert", inner / "q.pvtp", inner / "q.vtp"])
        assert refused.returncode == 2, (source, refused.stdout, refused.stderr)
        assert not (inner / "q.vtp").exists(), source
    (work / "p_pieces" / "p_1.vtp").write_bytes((work / "p_pieces" / "p_0.vtp").read_bytes())
    refused = run([arguments.terrane, "convert", pieces, inner / "q.vtp"])
    assert refused.returncode == 2, refused.stderr


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("--terrane", "--terrane-mpi", "--mpirun", "--certified"):
        parser.add_argument(name, required=True, type=Path)
    parser.add_argument("--all", action="store_true")
    arguments = parser.parse_args()
    arguments.terrane_mpi = arguments.terrane_mpi.resolve()  # some processes start in another folder
    cases = sorted(path.parent.name for path in arguments.certified.glob("*/expected.json")) if arguments.all else CASES
    for number, name in enumerate(cases):
        with tempfile.TemporaryDirectory() as work:
            check_case(arguments, arguments.certified / name, Path(work), RANKS if arguments.all or number == 0 else ((2, 7)[number % 2],))
    for check in (check_failures, check_one_unlike_the_others, check_quiet, check_pieces):
        with tempfile.TemporaryDirectory() as work:
            check(arguments, arguments.certified / "horizons_and_fault", Path(work))
    with tempfile.TemporaryDirectory() as work:
        check_killed(arguments, Path(work))
    print(f"{len(cases)} cases: as in one process")


if __name__ == "__main__":
    main()
