#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Reads back what `terrane well` writes, by the descriptions of CSV and LAS 2.0, and what it reads.

    tests/cli/well_files.py TERRANE DATA

Logs of a slanting well through level planes are known: they are compared in both formats. The same path as a table, a survey and
a LAS file has the same log.
"""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

PLANES = {"upper": 6.0, "lower": 3.0}
BOX = "--box=0,0,0,9,9,9"


def check(condition, what):
    if not condition:
        sys.exit(f"well_files.py: {what}")


def read_las(text):
    """Parameters, curves and rows of an unwrapped LAS 2.0 file: MNEM.UNIT VALUE : DESCRIPTION."""
    section, headers, curves, rows = None, {}, [], []
    for line in text.splitlines():
        if not line.strip() or line.startswith("#"):
            continue
        if line.startswith("~"):
            section = line[1].upper()
            check(section in "VWCPOA", f"section {line}")
            continue
        if section == "A":
            rows.append([float(word) for word in line.split()])
            continue
        mnemonic, _, rest = line.partition(".")
        unit, _, rest = rest.partition(" ")
        value, colon, _ = rest.rpartition(":")
        check(colon, f"no colon: {line}")
        if section == "C":
            curves.append((mnemonic.strip(), unit))
        else:
            headers[section, mnemonic.strip()] = value.strip()
    for needed in ("STRT", "STOP", "STEP", "NULL", "COMP", "WELL", "FLD", "LOC", "PROV", "SRVC", "DATE", "UWI"):
        check(("W", needed) in headers, f"{needed} is missing")
    check(headers["V", "VERS"] == "2.0" and headers["V", "WRAP"] == "NO", "version and wrap")
    check(curves[0][0] == "DEPT", "the first curve is DEPT")
    check(all(len(row) == len(curves) for row in rows), "a value per curve")
    check(float(headers["W", "STRT"]) == rows[0][0] and float(headers["W", "STOP"]) == rows[-1][0], "STRT and STOP")
    check(all(a[0] < b[0] for a, b in zip(rows, rows[1:])), "depths ascend")
    return headers, curves, rows


def plane(name, z):
    return f"o {name}\nv -1 -1 {z}\nv 10 -1 {z}\nv 10 10 {z}\nv -1 10 {z}\nf 1 2 3\nf 1 3 4\n"


class Folder:
    def __init__(self, program):
        self.program, self.path = program, pathlib.Path(tempfile.mkdtemp())
        for name, z in PLANES.items():
            (self.path / f"{name}.obj").write_text(plane(name, z))
        (self.path / "column.json").write_text(json.dumps({"column": [
            {"unit": "sand", "surface": "upper"}, {"unit": "shale, grey", "surface": "lower"}, {"unit": "salt"}]}))

    def run(self, *arguments, status=0):
        done = subprocess.run([self.program, "well", "upper.obj", "lower.obj", BOX, *arguments], cwd=self.path,
                              capture_output=True, text=True)
        check(done.returncode == status, f"{arguments}: {done.returncode}\n{done.stdout}{done.stderr}")
        return done.stdout + done.stderr

    def write(self, name, text):
        (self.path / name).write_text(text)

    def csv(self, name):
        with (self.path / name).open(newline="") as file:
            return list(csv.DictReader(file))

    def las(self, name):
        return read_las((self.path / name).read_text())


def test_logs(folder):
    """A well that leaves the top at depth 5, and falls 0.8 per unit of depth."""
    folder.write("w.csv", 'name,x,y,z\n"A, 1",1,1,13\n"A, 1",7,9,-1\nfar,50,50,9\nfar,50,50,0\n')
    said = folder.run("--path", "w.csv", "-o", "log.csv", "-o", "log.las", "--column", "column.json", "--stats", "s.json")
    length = math.hypot(6, 8, 14)
    rows = folder.csv("log.csv")
    blocks = [row for row in rows if row["well"] == "A, 1" and row["kind"] == "block"]
    check([b["unit"] for b in blocks] == ["", "sand", "shale, grey", "salt", ""], "units in order")
    check(float(blocks[0]["from"]) == 0 and abs(float(blocks[-1]["to"]) - length) < 1e-12, "the whole path")
    for above, below in zip(blocks, blocks[1:]):
        check(above["to"] == below["from"] and above["x_to"] == below["x"] and above["z_to"] == below["z"], "no gap")
    for block, (high, low) in zip(blocks, [(13, 9), (9, 6), (6, 3), (3, 0), (0, -1)]):
        for depth, z, end in ((block["from"], high, block["z"]), (block["to"], low, block["z_to"])):
            check(float(end) == z and abs(float(depth) - (13 - z) / 14 * length) < 1e-12, f"depth of {z}")
    markers = [(row["surface"], float(row["z"])) for row in rows if row["well"] == "A, 1" and row["kind"] == "marker"]
    check(markers == [("boundary top", 9), ("upper", 6), ("lower", 3), ("boundary bottom", 0)], str(markers))
    check([row["block"] for row in rows if row["well"] == "far"] == ["outside"], "a well beside the model")
    depths = [float(row["from"]) for row in rows if row["well"] == "A, 1"]
    check(depths == sorted(depths), "rows by depth")

    headers, curves, las = folder.las("log_A_1.las")
    check([c[0] for c in curves] == ["DEPT", "BLOCK", "UNIT"] and headers["W", "WELL"] == "A, 1", "curves and well")
    check([row[0] for row in las] == [float(b["from"]) for b in blocks] + [float(blocks[-1]["to"])], "depths of the LAS")
    check([headers["P", f"B{int(row[1])}"] for row in las[:-1]] == [b["block"] for b in blocks], "blocks of the LAS")
    units = [headers["P", f"U{int(row[2])}"] if row[2] != float(headers["W", "NULL"]) else "" for row in las[:-1]]
    check(units == [b["unit"] for b in blocks], "units of the LAS")
    check(las[-1][1:] == las[-2][1:], "the last number holds to the end")

    statistics = json.loads((folder.path / "s.json").read_text())["wells"]
    check(statistics[0]["markers"] == 4 and [b["name"] for b in statistics[0]["blocks"]][0] == "outside", "statistics")
    check(abs(sum(b["length"] for b in statistics[0]["blocks"]) - length) < 1e-12, "lengths sum to that of the path")
    check("well A, 1: 17.2" in said, said)

    folder.run("--path", "w.csv", "-o", "stepped.las", "--step", "0.5")
    _, _, stepped = folder.las("stepped_A_1.las")
    check([row[0] for row in stepped] == [k / 2 for k in range(int(length * 2) + 1)], "depths are multiples of the step")
    for depth, block, _ in stepped:
        check(block == [row[1] for row in las if row[0] <= depth][-1], f"block at {depth}")


def test_in_surfaces(folder):
    folder.write("run.csv", "x;y;z;md\n2;2;8;100\n2;2;6;110\n4;2;6;120\n4;2;5;130\n")
    folder.run("--path", "run.csv", "-o", "run.csv.csv", "-o", "run.las")
    rows = folder.csv("run.csv.csv")
    upon = [row for row in rows if row["kind"] == "surface"]
    check(len(upon) == 1 and (upon[0]["from"], upon[0]["to"], upon[0]["surface"]) == ("110", "120", "upper"), str(upon))
    check(len(upon[0]["block"].split(" | ")) == 2 and {row["well"] for row in rows} == {"run"}, "both blocks")
    headers, _, las = folder.las("run.las")
    check([row[0] for row in las] == [100, 110, 120, 130] and las[1][1] == -999.25, str(las))


def test_same_path_in_all_forms(folder):
    """A well that falls straight at 30 degrees to the east."""
    steps = [0, 2, 7, 12]
    place = {md: (1 + md / 2, 4.0, 9.5 - md * math.sqrt(3) / 2) for md in steps}
    head = "Date. :\nWELL. W : name\nNULL. -999.25 :\nX.M 1 :\nY.M 4 :\n"
    start = "~Version\nVERS. 2.0 : LAS\nWRAP. {} :\n~Well\n" + head
    survey = "".join(f"{md} 30 77 90\n" for md in steps)
    forms = {
        "table.csv": "well,x,y,z,md\n" + "".join(f"W,{x!r},{y!r},{z!r},{md}\n" for md, (x, y, z) in place.items()),
        "survey.csv": "name\tMD (m)\tincl\tazi\n" + "".join(f"W\t{md}\t30\t90\n" for md in steps),
        "survey.las": start.format("NO") + "~Parameter\nEREF.M 9.5 : \n~Curve\nDEPT.M :\nINCL.DEG :\nGR. :\nAZIM.DEG :\n~A\n" + survey,
        "wrapped.las": start.format("YES") + "~P\nEKB.M 9.5 : \n~C\nDEPT.M :\nINCL.DEG :\nGR. :\nAZIM.DEG :\n~A\n"
                       + survey.replace(" 77", "\n77"),
        "upwards.las": start.format("NO") + "~C\nDEPT.M :\nX.M :\nY.M :\nZ.M : up\n~A\n3.5 -999.25 0 0\n"
                       + "".join(f"{md} {x!r} {y!r} {z!r}\n" for md, (x, y, z) in reversed(place.items())),
    }
    logs = {}
    for name, text in forms.items():
        folder.write(name, text)
        more = ["--head", "W=1,4,9.5"] if name == "survey.csv" else []
        folder.run("--path", name, "-o", "one.csv", *more)
        logs[name] = folder.csv("one.csv")
    first = logs["table.csv"]
    check(len(first) > 5, "the well meets the model")
    for name, log in logs.items():
        check(len(log) == len(first), f"{name} has {len(log)} rows")
        for mine, other in zip(log, first):
            check(mine["block"] == other["block"] and mine["well"] == "W", name)
            for key in ("from", "to", "x", "y", "z", "x_to", "y_to", "z_to"):
                check(abs(float(mine[key]) - float(other[key])) < 1e-9, f"{name}: {key} {mine[key]} {other[key]}")


def test_refusals(folder):
    def refused(what, *arguments, text=None, status=2):
        if text is not None:
            folder.write("bad.txt", text)
            arguments = ("--path", "bad.txt", *arguments)
        said = folder.run(*arguments, "-o", "never.csv", status=status)
        check(what in said, f"{what!r} is not in: {said}")
        check(not (folder.path / "never.csv").exists(), "nothing is written")

    survey = "md,inclination,azimuth\n0,0,0\n9,0,0\n"
    refused("its head is not stated", text=survey)
    refused("--head", text=survey)
    refused("there is no well Q", "--head", "Q=1,2,3", text="x,y,z\n1,1,9\n1,1,0\n")
    refused("needs X,Y,Z", "--head", "1,2", text=survey)
    refused("the heading of a table of wells", text="a,b,c\n1,2,3\n")
    refused("bad.txt:3", text="x,y,z\n1,2,3\n1,2,q\n")
    refused("bad.txt:2: the row has 2 cells", text="x,y,z\n1,2\n")
    refused("different units", text="x (m),y (m),z (ft)\n1,2,3\n")
    refused("there is no well", text="x,y,z\n")
    refused("two different points", text="x,y,z\n1,2,3\n1,2,3\n")
    refused("depths ascend", "--head", "1,2,3", text="md,incl,azim\n5,0,0\n3,0,0\n")
    refused('LAS "1.20" is not read', text="~V\nVERS. 1.20 :\nWRAP. NO :\n~C\nDEPT.M :\n~A\n1\n")
    refused("no curves X, Y and Z", text="~V\nVERS. 2.0 :\nWRAP. NO :\n~C\nDEPT.M :\nGR. :\n~A\n1 2\n")
    refused("the row has 3 values for 4 curves",
            text="~V\nVERS. 2.0 :\nWRAP. NO :\n~C\nDEPT.M :\nX. :\nY. :\nZ. :\n~A\n1 2 3\n")
    refused("the first curve is no depth", text="~V\nVERS. 2.0 :\n~C\nTIME.S :\nX. :\nY. :\nZ. :\n~A\n1 2 3 4\n")
    refused("no well meets the model", text="x,y,z\n50,50,9\n50,50,0\n", status=1)
    refused("logs of wells are .csv or .las", "-o", "log.svg", text="x,y,z\n1,1,9\n1,1,0\n")
    refused("--step: is for .las files", "--step", "1", text="x,y,z\n1,1,9\n1,1,0\n")
    folder.write("a.csv", "well,x,y,z\nA,1,1,9\nA,1,1,0\n")
    refused("two wells: A", "--path", "a.csv", "--path", "a.csv")
    refused("can't be opened", "--path", "none.csv")
    folder.write("o_A.las", "")
    folder.write("o_B.las", "~V\nVERS. 2.0 :\nWRAP. NO :\n~W\nWELL. B :\n~C\nDEPT.M :\nX. :\nY. :\nZ. :\n~A\n0 1 1 9\n9 1 1 0\n")
    said = folder.run("--path", "a.csv", "--path", "o_B.las", "-o", "o.las", status=2)
    check("o_B.las" in said and (folder.path / "o_A.las").read_text() == "", said)


def main():
    program = pathlib.Path(sys.argv[1]).absolute()
    folder = Folder(program)
    for test in (test_logs, test_in_surfaces, test_same_path_in_all_forms, test_refusals):
        test(folder)


main()
