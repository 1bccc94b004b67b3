#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Compares a model that is arranged in tiles with the same one arranged as a whole.

    scripts/scale_digests.py [--terrane FILE] [--terrane-mpi FILE] [--processes 1,2,3,4,7] [--memory 4GiB] INPUT...
    scripts/scale_digests.py --write FOLDER [--million 20]

The digest of the exact result must be the same for all numbers of processes and, with --memory, for tiles one after
the other on disk, and `terrane convert` must make the bytes of the whole of them. A row for each says so, with the peak
of memory (of the largest process) and the seconds of processor time. The status is 1 if anything differs.
With --write, FOLDER gets a model of so many million triangles: ten waves and four slanted walls, as binary PLY.
"""
import argparse
import filecmp
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                   OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_btl_vader_single_copy_mechanism="none")
DIGEST = re.compile(r"sha256:[0-9a-f]{64}")


def write_grid(path, n, place):
    """Writes 2 n^2 triangles at place(u, v), u and v from 0 to 1."""
    import numpy as np  # pylint: disable=import-outside-toplevel
    u, v = np.meshgrid(*[np.linspace(0, 1, n + 1)] * 2, indexing="ij")
    vertices = np.column_stack(place(np, u.ravel(), v.ravel()))
    corner = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    triangles = np.empty(2 * n * n, dtype=[("count", "u1"), ("corners", "<i4", 3)])
    triangles["count"] = 3
    triangles["corners"][0::2] = np.column_stack((corner, corner + n + 1, corner + n + 2))
    triangles["corners"][1::2] = np.column_stack((corner, corner + n + 2, corner + 1))
    with open(path, "wb") as file:
        file.write((f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty double x\n"
                    f"property double y\nproperty double z\nelement face {len(triangles)}\n"
                    "property list uchar int vertex_indices\nend_header\n").encode())
        file.write(vertices.astype("<f8").tobytes())
        file.write(triangles.tobytes())


def write_model(folder, triangles):
    folder.mkdir(parents=True, exist_ok=True)
    for k in range(10):
        write_grid(folder / f"horizon{k}.ply", round((triangles * .09 / 2) ** .5), lambda np, u, v, k=k: (
            20000 * u, 20000 * v,
            -1000 - 300 * k + 200 * np.sin(5 * u + .3 * k) * np.cos(4 * v) + 40 * np.sin(23 * u * v + k)))
    for k in range(4):
        write_grid(folder / f"fault{k}.ply", round((triangles * .025 / 2) ** .5), lambda np, u, v, k=k: (
            3000 + 4000 * k + 600 * u + 300 * np.sin(3 * v), 20100 * v - 50, -4500 * u))


def measured(command):
    """Runs a command; returns what it says, its peak of memory in bytes, and its seconds of processor time."""
    child = subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                             text=True, env=ENVIRONMENT)
    with child.stdout:
        said = child.stdout.read()
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: status {child.returncode}\n{said}")
    return said, 1024 * usage.ru_maxrss, usage.ru_utime + usage.ru_stime


def digest_of(certificate):
    """The digest is at the end of a certificate, which may be gigabytes long."""
    with open(certificate, "rb") as file:
        file.seek(max(0, os.path.getsize(certificate) - 4096))
        return DIGEST.findall(file.read().decode(errors="replace"))[-1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--terrane", default=ROOT / "build/release/cli/terrane", type=Path)
    parser.add_argument("--terrane-mpi", default=ROOT / "build/release/cli/terrane-mpi", type=Path)
    parser.add_argument("--mpirun", default="mpirun")
    parser.add_argument("--processes", default="1,2,3,4,7", help="numbers of processes; may be empty")
    parser.add_argument("--memory", help="tiles on disk, in so much memory")
    parser.add_argument("--write", type=Path, metavar="FOLDER")
    parser.add_argument("--million", type=float, default=20)
    parser.add_argument("inputs", nargs="*")
    options = parser.parse_args()
    if options.write:
        write_model(options.write, 1e6 * options.million)
        return 0
    if not options.inputs:
        parser.error("no input")
    ways = {f"{n} processes": [options.mpirun, "-n", n, options.terrane_mpi, "arrange"]
            for n in options.processes.split(",") if n}
    differ = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        _, peak, seconds = measured([options.terrane, "arrange", *options.inputs, "-o", folder / "whole.vtp",
                                     "--certificate", folder / "whole.json"])
        right = digest_of(folder / "whole.json")
        (folder / "whole.json").unlink()
        print(f"whole, with a certificate: {right}, {peak / 1e9:.2f} GB, {seconds:.0f} s")
        if options.memory:
            ways[f"within {options.memory}"] = [options.terrane, "arrange", "--memory", options.memory]
        for k, (way, command) in enumerate(ways.items()):
            pieces, joined = folder / f"pieces{k}.pvtp", folder / "joined.vtp"
            said, peak, seconds = measured([*command, *options.inputs, "-o", pieces, "--digest"])
            measured([options.terrane, "convert", pieces, joined])
            same = right in said, filecmp.cmp(joined, folder / "whole.vtp", shallow=False)
            joined.unlink()
            differ += not all(same)
            print(f"{way}: digest {'same' if same[0] else 'DIFFERS'}, bytes {'same' if same[1] else 'DIFFER'}, "
                  f"{peak / 1e9:.2f} GB, {seconds:.0f} s", flush=True)
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
