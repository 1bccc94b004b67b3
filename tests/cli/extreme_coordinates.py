#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs the commands on coordinates up to the largest doubles and down to the least, and reads all that they write.

    tests/cli/extreme_coordinates.py PROGRAM

No text has a number that is "nan" or "inf", and no JSON lacks a number (docs/reference/statistics.md lists where null has a meaning).
"""
import base64
import gzip
import json
import pathlib
import re
import subprocess
import sys
import tempfile

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
NO_NUMBER = re.compile(r"(?<![\w+/=])[-+]?(?:nan|inf|infinity)(?![\w+/=])", re.I)
# Places in statistics and pages that may be null, since there is nothing of this kind.
EMPTY = re.compile(r"\.(file|blocks|volumes|peak_rss_mb|least|place|into|valid|quality|expected_error|validated_error|cell|filled|"
                   r"models\[\]\.height|models\[\]\.deviation|bound_back_of_surfaces\[\]|measured_back\[\]|radius_edge\.\w+|rows\[\]\[\]|corners|fault_throw|width|throw)$")


def sheet(name, size, height, slope=0., without=()):
    """A square of 4 x 4 cells, of which some may be left out."""
    n = 4
    ends = [size * (2 * i / n - 1) for i in range(n + 1)]
    vertices = [(x, y, height * (1 + slope * i / n)) for i, x in enumerate(ends) for y in ends]
    cells = [(a, a + n + 1, a + n + 2, a + 1) for i in range(n) for j in range(n) if (i, j) not in without for a in [i * (n + 1) + j]]
    return name, vertices, cells


def models(large, small):
    fault = "F1", [(small, -large, -large), (small, large, -large), (small, large, large), (small, -large, large)], [(0, 1, 2, 3)]
    corners = [(x, y, z) for x in (-large, large) for y in (-large, large) for z in (-large, large)]
    box = "box", corners, [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    yield "triangle", [("g", [(large, 0, 0), (-large, 1, 0), (0, large, 1)], [(0, 1, 2)])]
    yield "stack", [sheet("base", large, -large / 2), sheet("top", large, large / 2, 0.25), fault]
    yield "crossing", [sheet("base", large, -large / 2), sheet("top", large, small, 0.25), fault]
    yield "box", [box, sheet("middle", large, large / 4)]
    yield "hole", [sheet("top", large, large / 2, without=((1, 2),))]


def obj(surfaces):
    text, first = "", 1
    for name, vertices, faces in surfaces:
        text += f"o {name}\n" + "".join("v {!r} {!r} {!r}\n".format(*v) for v in vertices)
        text += "".join("f " + " ".join(str(first + i) for i in f) + "\n" for f in faces)
        first += len(vertices)
    return text


def commands(large):
    box = "--box=" + ",".join(repr(sign * 0.9 * large) for sign in (-1, 1) for _ in range(3))
    yield "report m.obj -o out.html --stats s.json"
    yield f"report m.obj -o out.html --stats s.json {box}"
    yield "check m.obj --stats s.json --report out.html"
    yield "arrange m.obj -o out.vtp --stats s.json --report out.html"
    yield f"arrange m.obj -o out.vtp --stats s.json --seal {large / 10!r}"
    yield "volume m.obj -o out.obj --stats s.json --report out.html"
    yield f"volume m.obj -o out.obj --stats s.json {box}"
    yield "improve m.obj -o out.vtp --stats s.json --report out.html"
    yield "tetrahedralize m.obj -o out.vtu --stats s.json --report out.html"
    yield "fill m.obj -o out.ts --stats s.json --report out.html"
    yield "layer m.obj --layer top=1 --layer base=2 -o out.ts --stats s.json --report out.html"
    yield "convert m.obj -o out.vtp"
    yield "convert m.obj -o out.off"


def missing(json_, path=""):
    """The paths of numbers that are not there."""
    if json_ is None and not EMPTY.search(path):
        yield path
    for key, value in json_.items() if isinstance(json_, dict) else (("[]", v) for v in json_) if isinstance(json_, list) else ():
        yield from missing(value, f"{path}{'' if key == '[]' else '.'}{key}")


def contents_of(page):
    """The JSON that a page holds."""
    content, run = (re.search(f'id="terrane-{part}">([^<]*)<', page)[1] for part in ("data", "run"))
    unpacked = gzip.decompress(base64.b64decode(content))
    return [json.loads(unpacked[4:4 + int.from_bytes(unpacked[:4], "little")]), json.loads(run)]


def flaws_in(folder, printed):
    yield from (line for line in printed.splitlines() if NO_NUMBER.search(line) or "coordinate is not finite" in line)
    for path in sorted(p for p in folder.rglob("*") if p.is_file()):
        if path.name in ("m.obj", "model.json"):  # in which an infinite number is null
            continue
        text = path.read_text(errors="replace")
        if path.suffix in (".html", ".json"):
            if path.suffix == ".json" and re.search(r"Infinity|NaN", text):
                yield f"{path.name} is no JSON"
            for part in contents_of(text) if path.suffix == ".html" else [json.loads(text)]:
                yield from (f"{path.name}: nothing at {where}" for where in sorted(set(missing(part))))
        else:
            yield from (f"{path.name}: {line[:80]}" for line in text.splitlines() if len(line) < 1000 and NO_NUMBER.search(line))


def main():
    runs = findings = 0
    for large, small in ((1e308, 1e-320), (1e160, 1.), (1e-320, 1e-320)):
        for name, surfaces in models(large, small):
            for command in commands(large):
                with tempfile.TemporaryDirectory() as scratch:
                    folder = pathlib.Path(scratch)
                    (folder / "m.obj").write_text(obj(surfaces))
                    done = subprocess.run([PROGRAM, *command.split()], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True)
                    runs += 1
                    printed = (done.stdout + done.stderr).decode("utf-8", "replace")
                    wrong = list(flaws_in(folder, printed))
                    if done.returncode not in (0, 1, 2, 3):
                        wrong.append(f"status {done.returncode}")
                    findings += len(wrong)
                    for flaw in wrong:
                        print(f"extreme_coordinates: {name} of {large} and {small}: {command}: {flaw}", flush=True)
    print(f"extreme_coordinates: {runs} runs, {findings} findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
