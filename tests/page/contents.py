#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Judges report pages without a browser: they are self-contained, names are data, bytes do not depend on threads.

    tests/page/contents.py build/release/cli/terrane [--without]

--without: the program was built without npm, which it must say, and write nothing.
"""
import base64
import gzip
import hashlib
import json
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = ROOT / "tests/data"
NAMES = ["<script>alert(1)</script>", "\"quoted\" 'both' & </script> <!--", "\u202eright to left \u05d0\u05d1", "long " * 2000]
flaws = []


def check(holds, what, *details):
    """Notes what does not hold."""
    if not holds:
        flaws.append(what + "".join(f": {str(d)[:300]}" for d in details))


def run(folder, *words, **environment):
    """Runs the program; returns its status and messages."""
    done = subprocess.run([PROGRAM, *map(str, words)], cwd=folder, capture_output=True, text=True, env={**os.environ, **environment})
    return done.returncode, done.stderr


def rows(content, title):
    """Returns the rows of a table."""
    return next(t["rows"] for t in content["tables"] if t["title"] == title)


def parts(page):
    """Returns the content, the arrays, what differs between runs, and the page without that."""
    data = re.search(r'<script type="application/octet-stream" id="terrane-data">([^<]*)</script>', page).group(1)
    times = re.search(r'<script type="application/json" id="terrane-run">([^<]*)</script>', page)
    packed = base64.b64decode(data, validate=True)
    check(packed[4:8] == b"\0\0\0\0", "the gzip header has no time")
    raw = gzip.decompress(packed)
    length = struct.unpack("<I", raw[:4])[0]
    return json.loads(raw[4:4 + length]), raw[4 + length:], json.loads(times.group(1)), page.replace(times.group(0), "")


def array(content, arrays, name):
    """Reads an array as the page does."""
    place = content["arrays"][name]
    at, count, stride = place["at"], place["count"], place["stride"]
    values = []
    for i in range(count):
        word = sum(arrays[at + plane * count + i] << 8 * plane for plane in range(4))
        step = (word >> 1) ^ (0xffffffff if word & 1 else 0)
        values.append((step + (values[i - stride] if i >= stride else 0)) & 0xffffffff)
    return values


def square(name, z, corners=((0, 0), (9, 0), (9, 9), (0, 9))):
    """A square as a GOCAD surface."""
    points = "".join(f"VRTX {i + 1} {x} {y} {z}\n" for i, (x, y) in enumerate(corners))
    return f"GOCAD TSurf 1\nHEADER {{\nname:{name}\n}}\nTFACE\n{points}TRGL 1 2 3\nTRGL 1 3 4\nEND\n"


def check_self_contained(page):
    """No address is loaded, and the policy allows the two elements of the page by their hashes."""
    check(not re.search(r'(?:src|href)\s*=\s*["\'](?!data:)', page[:page.index("<style>")]), "nothing is loaded in the head")
    style = page[page.index("<style>") + 7:page.index("</style>")]
    script = page[page.rindex("<script>") + 8:page.rindex("</script>")]
    check("@import" not in style and not re.search(r"url\((?!data:)", style), "the style loads nothing")
    policy = re.search(r'http-equiv="Content-Security-Policy" content="([^"]*)"', page).group(1)
    rules = dict((rule.split(" ", 1) + [""])[:2] for rule in policy.split("; "))
    check(rules["default-src"] == "'none'", "the policy allows nothing by default", policy)
    for kind, text in (("script-src", script), ("style-src", style)):
        found = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
        check(rules[kind] == f"'sha256-{found}'", f"the policy names the hash of the page's own {kind}", rules[kind], found)
    check(re.findall(r"<script[ >]", page) == ["<script ", "<script ", "<script>"], "there are three script elements")
    licences = {"three": "MIT", "uplot": "MIT"}
    for name, licence in licences.items():
        check(re.search(rf'name:"{name}",version:"[0-9.]+",licence:"{licence}"', script), f"the licence of {name} is in the page")


def check_names(folder):
    """Names that look like code, of other directions, and very long, are what the file says."""
    text = "".join(square(name, z) for z, name in enumerate(NAMES))
    (folder / "names.ts").write_text(text)
    status, said = run(folder, "check", "names.ts", "--report", "names.html")
    check(status == 0, "names are taken", said)
    page = (folder / "names.html").read_text()
    content, *_ = parts(page)
    check([s["name"] for s in content["surfaces"]] == [n.strip() for n in NAMES], "names are those of the file",
          [s["name"][:50] for s in content["surfaces"]])
    check("alert(1)" not in page, "no name is readable in the page's source")
    check(content["tables"] and content["title"] == "names.ts", "there are tables and a title")


def check_contents(folder):
    """Two crossing squares: the arrays hold the mesh, findings the contact, and tables the input's hash."""
    (folder / "two.ts").write_text(square("flat", 5) + square("steep", 0).replace("VRTX 3 9 9 0", "VRTX 3 9 9 10")
                                   .replace("VRTX 4 0 9 0", "VRTX 4 0 9 10"))
    status, said = run(folder, "check", "two.ts", "--report", "check.html")
    check(status == 1, "a refused model has status 1, with its page", status, said)
    content, arrays, *_ = parts((folder / "check.html").read_text())
    status, said = run(folder, "check", "two.ts", "--json")
    contacts = content["findings"]["counts"].get("improper contact", 0)
    listed = [f for f in content["findings"]["list"] if f["kind"] == "improper contact"]
    check(contacts == len(listed) > 0, "all contacts are findings", content["findings"]["counts"])
    check(all(abs(f["place"][2] - 5) < 1e-9 for f in listed), "they are where the squares cross")
    check(not content["verdict"]["good"], "the verdict says no")
    status, said = run(folder, "judge", "two.ts", "two.ts", "--report", "judge.html")
    judged, *_ = parts((folder / "judge.html").read_text())
    check(status == 1 and not judged["verdict"]["good"], "a mesh that fails has a page", status, said)
    check(judged["findings"]["counts"]["conforming"] == len([f for f in judged["findings"]["list"] if f["kind"] == "conforming"]) > 0
          and judged["statistics"]["conforming"]["verdict"] == "fails", "its flaws are findings", judged["findings"]["counts"])
    status, said = run(folder, "judge", "--soup", "two.ts", "--report", "soup.html")
    check(status == 1 and parts((folder / "soup.html").read_text())[0]["findings"]["counts"]["closed"] == 8, "triangles alone have a page", said)
    corners = array(content, arrays, "triangles")
    vertices = array(content, arrays, "vertices")
    check(len(corners) == 12 and max(corners) == 7, "all triangles are drawn")
    view = content["view"]
    points = {tuple(round(view["origin"][k] + vertices[3 * v + k] * view["step"], 5) for k in range(3)) for v in corners}
    check((9, 9, 10) in points and (0, 0, 5) in points and len(points) == 8, "they have the file's coordinates", points)
    digest = hashlib.sha256((folder / "two.ts").read_bytes()).hexdigest()
    check(any(digest in row for t in content["tables"] if t["title"] == "Input files" for row in t["rows"]), "the input's hash")


def check_contact_lines(folder):
    """`terrane check --report` draws where triangles meet: segments, borders of overlaps, crosses at points."""
    first = "o a\nv 0 0 0\nv 4 0 0\nv 0 4 0\nf 1 2 3\no b\n"
    for name, other, count, length, low, high in (
            ("segment", ((1, -1, -1), (1, 5, -1), (1, 2, 3)), 1, 3, (1, 0, 0), (1, 3, 0)),
            ("end", ((1, 1, -1), (1, 1, 1), (9, 1, 0)), 1, 2, (1, 1, 0), (3, 1, 0)),
            ("overlap", ((1, 1, 0), (5, 1, 0), (1, 5, 0)), 3, 4 + 8 ** 0.5, (1, 1, 0), (3, 3, 0)),
            ("point", ((1, 1, 0), (1, 2, 4), (2, 1, 4)), 3, 0, None, None)):
        text = first + "".join("v {} {} {}\n".format(*p) for p in other) + "f 4 5 6\n"
        (folder / f"{name}.obj").write_text(text)
        status, said = run(folder, "check", f"{name}.obj", "--report", f"{name}.html")
        content, arrays, *_ = parts((folder / f"{name}.html").read_text())
        lines = [line for line in content["lines"] if line["kind"] == "improper contact"]
        check(status == 1 and len(lines) == 1 and lines[0]["count"] == count, f"contacts are drawn: {name}", status, content["lines"], said)
        if not lines:
            continue
        check(abs(lines[0]["length"] - length) < 1e-9, f"they have their length: {name}", lines[0]["length"], length)
        vertices, segments, view = array(content, arrays, "vertices"), array(content, arrays, "segments"), content["view"]
        ends = segments[2 * lines[0]["first"]:2 * (lines[0]["first"] + count)]
        points = [[view["origin"][k] + vertices[3 * v + k] * view["step"] for k in range(3)] for v in ends]
        if low:
            found = [[f(p[k] for p in points) for k in range(3)] for f in (min, max)]
            check(all(abs(a - b) < 1e-5 for p, q in zip(found, (low, high)) for a, b in zip(p, q)), f"they are where they are: {name}", found)
        else:
            middle = [sum(p[k] for p in points) / 6 for k in range(3)]
            check(all(abs(a - b) < 1e-5 for a, b in zip(middle, (1, 1, 0))), "a cross is round its point", points)


def check_same_bytes(folder):
    """Only the block of times differs between runs, with any number of threads."""
    model = DATA / "ringmesh/modelA1.ml"
    pages = []
    for threads in (1, 3):
        status, said = run(folder, "report", model, "-o", "same.html", "--threads", threads)
        check(status == 0, "a report is made", said)
        page = (folder / "same.html").read_text()
        content, _, times, rest = parts(page)
        check(times["threads"] == threads and times["seconds"]["total"] > 0 and times["peak_rss_mb"] > 0, "times and memory", times)
        check("seconds" not in content["statistics"], "times are nowhere else")
        pages.append(rest)
    check(pages[0] == pages[1], "the same bytes for any number of threads")
    check_self_contained(page)
    check(len(content["blocks"]) == 4 and all(b["volume"] > 0 for b in content["blocks"]), "blocks with volumes")
    titles = {t["title"] for t in content["tables"]}
    check(titles >= {"Blocks", "Neighbours", "Surfaces", "Input files", "Verdict"}, "tables", titles)
    triangles = sum(p["count"] for p in content["parts"])
    check(triangles == content["view"]["triangles"] == content["statistics"]["output"]["triangles"], "all triangles are in a part")


def check_commands(folder):
    """Each command that makes something writes its page, together with its other files or not at all."""
    model = DATA / "ringmesh/modelA1.ml"
    for words in (("arrange", model, "-o", "a.obj"), ("improve", model, "-o", "i.obj"), ("volume", model, "-o", "v")):
        (folder / "c.html").unlink(missing_ok=True)
        status, said = run(folder, *words, "--report", "c.html")
        check(status == 0 and (folder / "c.html").exists(), f"{words[0]} --report", status, said)
        if (folder / "c.html").exists():
            content, *_ = parts((folder / "c.html").read_text())
            check(content["command"] == words[0] and content["verdict"]["good"], "the page names its command", content["command"])
            series = {len(p["series"]) for p in content["plots"] if p["title"].startswith("Quality")}
            check(series == ({2} if words[0] == "improve" else {1}), "before and after", series)
    project = {"format": "terrane-project 1", "surfaces": [{"file": str(model)}], "outputs": {"surfaces": ["obj"], "blocks": "vtp"}}
    (folder / "p.json").write_text(json.dumps(project))
    status, said = run(folder, "build", "p.json", "-o", "built", "--report", "b.html")
    check(status == 0 and (folder / "b.html").exists() and (folder / "built").exists(), "build --report", status, said)
    (folder / "bad.obj").write_text("v 0 0\n")
    status, _ = run(folder, "report", "bad.obj", "-o", "bad.html")
    check(status == 2 and not (folder / "bad.html").exists(), "bad input leaves no page")
    status, said = run(folder, "arrange", model, "-o", "same.obj", "--report", "same.obj")
    check(status == 2 and "names the same file" in said, "two outputs are not one file", said)
    status, said = run(folder, "arrange", model, "-o", "x.obj", "--report", "none/x.html")
    check(status == 2 and not (folder / "x.obj").exists(), "a missing folder is found before the work", said)


def check_layers(folder):
    """The page of layers has their mesh and verdict."""
    words = ("layer", "two.ts", "--layer", "steep=2", "--layer", "flat=1", "-o", "l.obj", "--certificate", "l.json")
    status, said = run(folder, *words, "--report", "layer.html")
    check(status == 0, "layers are made", said)
    content, *_ = parts((folder / "layer.html").read_text())
    check(content["command"] == "layer" and content["verdict"]["good"] and "in order" in content["verdict"]["text"], "the verdict on layers", content["verdict"])
    shared = [p for p in content["parts"] if len(p["surfaces"]) == 2]
    check(len(shared) == 1 and shared[0]["count"] > 0, "where one layer replaced the other, triangles are of both", content["parts"])
    check(content["certificates"][0]["valid"] is True, "the certificate of layers is valid", content["certificates"])


def check_certificates(folder):
    """The page says what `terrane verify` says, or that there is no certificate."""
    model = DATA / "ringmesh/modelA1.ml"
    status, said = run(folder, "volume", model, "-o", "proved", "--certificate", "proved.json", "--report", "p.html", "--quiet")
    content, *_ = parts((folder / "p.html").read_text())
    verdict = subprocess.run([PROGRAM, "verify", "--folder", "/", "proved.json"], cwd=folder, capture_output=True, text=True).stdout
    lines = [row[1] for row in rows(content, "Verdict") if row[0] == "certificate proved.json"]
    check(status == 0 and lines and "\n".join(["proved.json: " + lines[0], *lines[1:], ""]) == verdict, "the verdict is that of terrane verify", lines, verdict, said)
    check(content["certificates"] == [{"file": "proved.json", "valid": True, "lines": lines}], "it is in the JSON", content["certificates"])
    check(lines and lines[0].startswith("valid: "), "it says valid", lines)
    check(rows(content, "Options") == [["--certificate", "proved.json"]], "options that change no result are not listed", rows(content, "Options"))
    run(folder, "arrange", "two.ts", "-o", "a.obj", "--report", "p.html")
    content, *_ = parts((folder / "p.html").read_text())
    check(content["certificates"] == [] and ["certificate", "None was asked for."] in rows(content, "Verdict"), "no certificate was asked for", rows(content, "Verdict"))
    far = square("far", 5, ((1e9, 0), (1e9 + 9, 0), (1e9 + 9, 9), (1e9, 9)))  # whose triangles have no area in float32
    (folder / "far.ts").write_text(far)
    check(run(folder, "improve", "far.ts", "-o", "far.obj", "--certificate", "far.json")[0] == 0, "a certificate of an earlier run")
    status, said = run(folder, "improve", "far.ts", "-o", "far.stl", "--certificate", "far.json", "--report", "far.html")
    content, *_ = parts((folder / "far.html").read_text())
    check(status == 1 and content["certificates"] == [{"file": "far.json", "valid": None, "lines": ["Not written, as nothing was."]}],
          "a certificate of an earlier run is not judged", status, content["certificates"])
    check(not content["verdict"]["good"] and "float32" in content["verdict"]["text"], "the verdict says why", content["verdict"])
    status, said = run(folder, "arrange", "two.ts", "-o", "a.obj", "--certificate", "-", "--report", "out.html", "--quiet")
    if status == 0:
        content, *_ = parts((folder / "out.html").read_text())
        check("standard output" in content["certificates"][0]["lines"][0], "one on standard output is not judged", content["certificates"])
    project = {"format": "terrane-project 1", "surfaces": [{"file": str(model)}],
               "outputs": {"surfaces": ["obj"], "blocks": "vtp", "certificate": True}}
    (folder / "q.json").write_text(json.dumps(project))
    status, said = run(folder, "build", "q.json", "-o", "certified", "--report", "q.html")
    content, *_ = parts((folder / "q.html").read_text())
    found = {pathlib.Path(c["file"]).name: c["valid"] for c in content["certificates"]}
    check(status == 0 and found == {"certificate.json": True, "certificate_blocks.json": True}, "those of a project", found, said, content["certificates"])


def check_quiet(folder):
    """`terrane report` and `terrane view` obey --quiet, as all commands do."""
    done = subprocess.run([PROGRAM, "report", "two.ts", "-o", "quiet.html", "--quiet"], cwd=folder, capture_output=True, text=True)
    check(done.returncode == 0 and done.stdout == done.stderr == "", "--quiet shows nothing", done.stdout, done.stderr)
    check((folder / "quiet.html").is_file(), "the page is there")


def opener(folder, name):
    """Writes a program that notes what it is asked to open."""
    script = folder / name
    script.write_text(f'#!/bin/sh\nprintf "%s\\n" "$1" > "{folder}/asked.tmp"\nmv "{folder}/asked.tmp" "{folder}/asked-{name}"\n')
    script.chmod(0o755)
    return script


def asked(folder, name):
    """Returns what the opener was asked to open; the program does not wait for it."""
    note = folder / f"asked-{name}"
    while not note.exists():
        time.sleep(0.05)
    path = note.read_text().strip()
    note.unlink()
    return path


def check_view(folder):
    """`terrane view` opens the page of surfaces, or a page, by BROWSER or xdg-open."""
    tools, temporary = folder / "tools", folder / "temporary"
    tools.mkdir()
    temporary.mkdir()
    opener(tools, "xdg-open"), opener(tools, "mine")
    usual = {"PATH": f"{tools}:{os.environ['PATH']}", "TMPDIR": str(temporary), "BROWSER": ""}
    status, said = run(folder, "view", "two.ts", **usual)
    page = pathlib.Path(asked(tools, "xdg-open"))
    check(status == 0 and page.name == "two.html" and page.parent.parent == temporary, "xdg-open gets a page in a new folder", page, said)
    check(page.is_file() and parts(page.read_text())[0]["command"] == "view", "the page is there when it is opened")
    status, said = run(folder, "view", "two.ts", **{**usual, "BROWSER": str(tools / "mine")})
    second = pathlib.Path(asked(tools, "mine"))
    check(status == 0 and second.is_file() and second.parent != page.parent, "BROWSER goes first, and each page has a folder", second, said)
    check(not (tools / "asked-xdg-open").exists(), "only one program is asked")
    for number, command in enumerate(("no-such-browser:{} %s", "{} %s --no-other &", "{}  %s:xdg-open")):
        status, said = run(folder, "view", "layer.html", **{**usual, "BROWSER": command.format(tools / "mine")})
        check(status == 0 and asked(tools, "mine") == "layer.html", "BROWSER may name commands with %s", number, said)
    check(not (tools / "asked-xdg-open").exists(), "only one program is asked")
    status, said = run(folder, "view", "layer.html", **usual)
    check(status == 0 and asked(tools, "xdg-open") == "layer.html", "a page is opened as it is", said)
    before = sorted(temporary.iterdir())
    check(run(folder, "view", "bad.obj", **usual)[0] == 2 and sorted(temporary.iterdir()) == before, "bad input leaves no folder")
    check(run(folder, "view", "none.html", **usual)[0] == 2, "a page that is not there is not opened")
    for words, wanted in ((("layer.html",), 2), (("two.ts",), 0)):
        status, said = run(folder, "view", *words, **{**usual, "BROWSER": "no-such-browser"})
        check(status == wanted and "no-such-browser" in said and "set BROWSER" in said, "a missing browser is named", status, said)


def check_without(folder):
    """A build without the page says so, and writes nothing."""
    (folder / "one.ts").write_text(square("one", 1))
    for words in (("report", "one.ts", "-o", "page.html"), ("arrange", "one.ts", "-o", "one.obj", "--report", "page.html")):
        status, said = run(folder, *words)
        check(status == 2 and re.search("built without report pages: (TERRANE_REPORT is off|.*npm)", said), "the program says that it makes no pages", status, said)
        check(not (folder / "page.html").exists() and not (folder / "one.obj").exists(), "nothing is written")


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        tests = (check_without,) if "--without" in sys.argv else (check_names, check_contents, check_contact_lines, check_same_bytes, check_commands,
                                                                       check_layers, check_certificates, check_quiet, check_view)
        for test in tests:
            test(folder)
    print("\n".join(flaws) or "pages are what they must be")
    return 1 if flaws else 0


if __name__ == "__main__":
    PROGRAM = pathlib.Path(sys.argv[1]).resolve()
    sys.exit(main())
