#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Prints the table of docs/explanation/scale.md for a model, from counters of terrane-mpi.

    scripts/scale_table.py --terrane-mpi FILE [--mpirun mpirun] [--processes 1,2,4,8] INPUT...
"""
import argparse
import json
import os
import subprocess
import tempfile
from pathlib import Path


def counters(arguments, processes):
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                       OMPI_MCA_rmaps_base_oversubscribe="1")
    with tempfile.TemporaryDirectory() as folder:
        stats = Path(folder) / "stats.json"
        subprocess.run([arguments.mpirun, "-n", str(processes), arguments.terrane_mpi, "arrange", *arguments.inputs,
                        "-o", str(Path(folder) / "m.pvtp"), "--stats", str(stats)],
                       check=True, stdout=subprocess.DEVNULL, env=environment)
        return json.loads(stats.read_text())


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--terrane-mpi", required=True)
    parser.add_argument("--mpirun", default="mpirun")
    parser.add_argument("--processes", default="1,2,4,8")
    parser.add_argument("inputs", nargs="+")
    arguments = parser.parse_args()
    print("| Tiles | Faces, most | Faces, all | Triangles, most | Pairs, all | Predicates, most | Messages, most "
          "| MB sent, most | MB sent, all | MB held, most |")
    print("|---" * 10 + "|")
    for processes in map(int, arguments.processes.split(",")):
        found = counters(arguments, processes)
        most, whole = found["most_in_a_tile"], found["all_tiles"]
        numbers = [f"{n:,}".replace(",", " ") for n in (
            most["faces"], whole["faces"], most["triangles"], whole["candidates"], most["predicates"], most["messages"])]
        sizes = [f"{n / 1e6:.1f}" for n in (most["bytes"], whole["bytes"], most["memory"])]
        print("| " + " | ".join([str(processes), *numbers, *sizes]) + " |")


if __name__ == "__main__":
    main()
