#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Compares docs/reference with the program and its sources, in both directions.

check_reference.py build/release/cli/terrane

- each option that `terrane COMMAND --help` prints, with its placeholder and its default
- each key of the JSON that the program writes, and of the schema of project files
- error codes, verification rules and names of formats
"""
import base64
import gzip
import json
import pathlib
import re
import subprocess
import sys
import tempfile

from json_keys import key_paths
from markdown_pages import host_slug

ROOT = pathlib.Path(__file__).resolve().parents[2]
REFERENCE = ROOT / "docs" / "reference"
OPTION_LINE = re.compile(r"^  (?=\S)((?:-\w,)?(?:--)?[\w-]+)((?: \S+)*?)(?: \.\.\.)?(?: REQUIRED)?"
                         r"(?:\s{2,}|(?<=\.\.\.) |$)(.*)$")
CODE = re.compile(r"`([^`]+)`")


class Findings(list):
    def compare(self, where, documented, true):
        """Adds a sentence for each name that only one side has."""
        self += [f"{where}: {name} is not documented" for name in sorted(true - documented)]
        self += [f"{where}: {name} is documented, but is not there"
                 for name in sorted(documented - true)]


def sections_of(text):
    """Headings of any level, as anchors, with the lines below each."""
    sections, lines, fenced = {}, [], False
    for line in text.splitlines():
        fenced ^= line.startswith("```")
        if line.startswith("#") and not fenced:
            lines = sections.setdefault(host_slug(line.lstrip("# ").replace("`", "")), [])
        else:
            lines.append(line)
    return sections


def cells_of(line):
    return [c.strip().replace("\\|", "|") for c in re.split(r"(?<!\\)\|", line.strip().strip("|"))]


def rows_of(lines, header=None):
    """The cells of the table rows among the lines; only of tables whose first header is `header`."""
    rows, first, previous = [], None, ""
    for line in lines:
        if not line.startswith("|"):
            first = None
        elif not previous.startswith("|"):
            first = cells_of(line)[0]
        elif not set(line) <= set("|-: "):
            if header in (None, first):
                rows.append(cells_of(line))
        previous = line
    return rows


# ---- Options

def option_key(text):
    """'-o, --output OUT' as ('-o,--output', 'OUT')."""
    flags, _, placeholder = text.replace(", ", ",").partition(" ")
    return flags, placeholder


def documented_options(sections, anchor, seen=()):
    """Options of a section and of the option groups to which it links: key to cells of the row."""
    options = {}
    lines = sections.get(anchor, [])
    for row in rows_of(lines):
        code = CODE.match(row[0])
        if code and len(row) == 3:
            options[option_key(code.group(1))] = row
    for group in re.findall(r"\(#([\w-]+-options)\)", "\n".join(lines)):
        if group not in seen:
            options.update(documented_options(sections, group, (*seen, group)))
    return options


def printed_options(program, command):
    """Options and positionals that --help prints: key to default, or None."""
    said = subprocess.run([program, *command, "--help"], capture_output=True, text=True, check=True)
    options, last = {}, None
    for line in said.stdout.split("\n\n\n")[0:2]:
        for row in line.splitlines():
            found = OPTION_LINE.match(row)
            if found and (found.group(1).startswith("-") or found.group(1).isupper()):
                last = (found.group(1), re.sub(r":(\{.*\}|POSITIVE)$", "", found.group(2).strip()))
                options[last] = found.group(3)
            elif last and row.startswith(" " * 30):
                options[last] += row.strip()
    options.pop(("-h,--help", ""), None)
    defaults = {key: re.search(r"\(default: (.*?)\)$", text) for key, text in options.items()}
    return {key: found and found.group(1) for key, found in defaults.items()}


def with_named_choices(true, documented):
    """Placeholders that are choices, upper|lower, become the page's word, if it lists them all."""
    renamed = {}
    for (flags, placeholder), default in true.items():
        if "|" in placeholder:
            for key, row in documented.items():
                choices = {c for c in placeholder.split("|") if c.islower()}
                if key[0] == flags and choices <= set(CODE.findall(row[1])):
                    placeholder = key[1]
        renamed[flags, placeholder] = default
    return renamed


def check_options(program, findings):
    sections = sections_of((REFERENCE / "commands.md").read_text())
    said = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
    listed = said.split("Subcommands:\n")[1].split("\n\n")[0]
    commands = {line.split()[0] for line in listed.splitlines()}
    findings.compare("commands.md", {a[8:] for a in sections if a.startswith("terrane-")}, commands)
    count = 0
    for command in sorted(commands):
        documented = documented_options(sections, "terrane-" + command)
        true = with_named_choices(printed_options(program, [command]), documented)
        where = f"commands.md, {command}"
        findings.compare(where, {" ".join(k).strip() for k in documented},
                         {" ".join(k).strip() for k in true})
        for key, default in true.items():
            if default and key in documented and default not in documented[key][2].replace("`", ""):
                findings.append(f"{where}: the default of {key[0]} is {default}")
        count += len(true)
    return count


# ---- JSON keys

def documented_keys(page, headings=None):
    """Key paths in the first cells of the tables whose header is Key."""
    keys = set()
    for anchor, lines in sections_of((REFERENCE / page).read_text()).items():
        if headings is None or headings(anchor):
            for row in rows_of(lines, "Key"):
                keys |= set(CODE.findall(row[0]))
    return keys


def fits(pattern, path):
    """Whether a documented path, in which * stands for one name, is this one."""
    return re.fullmatch(re.escape(pattern).replace(r"\*", r"[^.\[\]]+"), path) is not None


def compare_keys(where, documented, true, findings, optional=frozenset()):
    for path in sorted(true):
        if not any(fits(pattern, path) for pattern in documented):
            findings.append(f"{where}: {path} is not documented")
    for pattern in sorted(documented - optional):
        if not any(fits(pattern, path) for path in true):
            findings.append(f"{where}: {pattern} is documented, but nothing writes it")


PROJECT = {
    "format": "terrane-project 1", "folder": "built",
    "surfaces": [{"file": "top.ts"}, {"file": "base.ts"}, {"file": "fault.ts"},
                 {"file": "seabed.asc", "depth": True}],
    "fill": [{"surface": "seabed"}],
    "layers": {"order": [{"surface": "seabed", "hardness": 1}]},
    "volume_of_interest": {"box": {"low": [0, 0, -1700], "high": [2000, 1500, -700]}},
    "seal": 20, "seal_of": {"top/fault": 10}, "min_volume": "auto", "extend": 30, "improve": {}, "outputs": {"surfaces": ["vtp"]}}


def write_json_files(program, folder):
    """Runs commands that write all keys there are; the files by the page that lists their keys."""
    model = ["top.ts", "base.ts", "fault.ts"]
    box = ["--box", "0,0,-1700,2000,1500,-700"]

    def run(*words, out=None):
        done = subprocess.run([program, *words], cwd=folder, capture_output=True, check=False)
        if done.returncode not in (0, 1):
            raise SystemExit(f"terrane {' '.join(words)}: {done.stderr.decode()}")
        if out:
            (folder / out).write_bytes(done.stdout)

    (folder / "project.json").write_text(json.dumps(PROJECT))
    (folder / "twice.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 2 0\nv 0 0 9\nv 3 3 3\n"
                                      "g a\nf 1 2 3\nf 1 2 3\nf 1 2 2\nf 1 2 4\nf 1 2 5\nf 1 2 6\n"
                                      "g b\nf 1 2 3\n")
    run("build", "project.json")
    run("improve", *model, *box, "-o", "i.vtp", "--stats", "improve.json")
    (folder / "column.json").write_text('{"column": [{"unit": "A", "surface": "top", "age": 1}]}')
    run("volume", *model, *box, "-o", "open", "--column", "column.json", "--contact", "-1000", "--stats", "open.json")
    run("volume", *model, *box, "-o", "sealed", "--seal", "200", "--seal", "top/fault=10",
        "--stats", "sealed_statistics.json")
    run("volume", "units.obj", "-o", "joined", "--tolerance", "0.2", "--stats", "joined_statistics.json")
    run("volume", *model, *box, "--suggest-seal", "--stats", "suggest.json")
    run("volume", *model, *box, "-o", "merged", "--seal", "auto", "--min-volume", "4e8", "--stats", "merged.json")
    run("arrange", *model, "-o", "tiles.vtp", "--memory", "1GiB", "--digest", "--volumes", "--stats", "in_tiles.json")
    run("improve", *model, *box, "-o", "n.vtp", "--edge-length", "100", "--resolution", "20", "--stats", "resolution.json")
    run("fill", "fold.ts", "-o", "f.vtp", "--stats", "fill.json")
    run("fill", "fold.ts", "-o", "r.vtp", "--method", "rbf", "--stats", "rbf.json")
    run("select", "west - body", "units.obj", "body.ts", "-o", "rest.vtp", "--fractions", "--stats", "select.json")
    run("map", "depth", "top.ts", "--step", "100", "-o", "depth.asc", "--stats", "map.json")
    run("section", *model, *box, "-o", "s.svg", "--level", "-1000", "--stats", "section.json")
    run("grid", *model, *box, "-o", "g.csv", "--cells", "4,4,4", "--stats", "grid.json")
    (folder / "small.obj").write_text("v 0 0 -1900\nv 900 0 -1900\nv 900 900 -1900\nv 0 900 0\nf 1 2 3\nf 1 3 4\n")
    run("prisms", "top.ts", "small.obj", "-o", "p.vtu", "--stats", "prisms.json")
    run("pillars", "top.ts", "base.ts", "-o", "g.grdecl", "--step", "100", "--stats", "pillars.json")
    run("well", *model, *box, "--path", "wells.csv", "-o", "log.csv", "--stats", "well.json")
    run("select", "fault & inside(west)", "units.obj", "fault.ts", "-o", "rest.vtp", "--stats", "select_part.json")
    run("info", "top.ts", "fault.ts", "--json", out="info.json")
    run("check", "twice.obj", "--json", out="check.json")
    run("arrange", *model, "-o", "a.vtp", "--certificate", "certificate.json", "--stats", "arrange.json")
    run("arrange", *model, "-o", "a.stl", "--stats", "stl.json")
    run("verify", "certificate.json", "--json", out="valid.json")
    run("volume", *model, "-o", "certified", "--certificate", "volumes.json")
    run("verify", "volumes.json", "--json", out="blocks.json")
    certificates = ["certificate.json", "volumes.json"]
    if has_tetgen(program):
        run("tetrahedralize", *model, "-o", "c.vtu", "--certificate", "tetrahedra-certificate.json")
        certificates.append("tetrahedra-certificate.json")
    run("improve", *model, "-o", "m.vtp", "--certificate", "improved.json")
    run("verify", "improved.json", "--json", out="valid_improved.json")
    run("fill", "fold.ts", "-o", "g.vtp", "--certificate", "filled.json")
    run("layer", "--hard", "salt.ts", "--soft", "shale.ts", "--keep", "upper", "-o", "l.vtp",
        "--certificate", "layered.json")
    run("layer", "salt.ts", "shale.ts", "--layer", "shale=1", "--layer", "salt=2", "--min-thickness",
        "5", "-o", "thick.vtp", "--certificate", "thick.json")
    run("arrange", *model, "-o", "v.vtp", "--box", "0,0,-1700,2000,1500,-700", "--certificate", "cut.json")
    run("arrange", *model, "-o", "s.vtp", "--box", "0,0,-1700,2000,1500,-700", "--seal", "20",
        "--certificate", "sealed.json")
    certificates += ["improved.json", "filled.json", "layered.json", "thick.json", "cut.json", "sealed.json"]
    with (folder / "top.ts").open("a") as changed:
        changed.write("\n")
    run("verify", "certificate.json", "--json", out="refuted.json")
    statistics = ["built/statistics.json", "improve.json", "suggest.json", "merged.json", "sealed_statistics.json", "joined_statistics.json", "fill.json", "rbf.json", "select.json", "select_part.json", "map.json", "section.json", "well.json", "grid.json", "prisms.json", "pillars.json",
                  "in_tiles.json", "resolution.json", "open.json", "arrange.json", "stl.json"]
    if has_tetgen(program):
        run("tetrahedralize", *model, *box, "-o", "t.vtu", "--stats", "tetrahedra.json")
        (folder / "refined.json").write_text(json.dumps({
            "format": "terrane-project 1", "folder": "refined", "surfaces": [{"file": name} for name in model], "seal": 20,
            "volume_of_interest": PROJECT["volume_of_interest"], "improve": {"edge_length": 200}, "tetrahedra": {"refine_bad": 1},
            "outputs": {"tetrahedra": ["mesh"]}}))
        run("build", "refined.json")
        statistics += ["tetrahedra.json", "refined/statistics.json"]
    if has_pages(program):
        run("volume", *model, *box, "-o", "reported", "--certificate", "reported.json", "--report", "report.html",
            "--stats", "reported_statistics.json")
        statistics.append("reported_statistics.json")
        run("fill", "--depth", "seabed.asc", "-o", "p.vtp", "--report", "filled.html")
        unpack_page(folder / "report.html"), unpack_page(folder / "filled.html")
    return {"report.md": sorted(str(p) for p in folder.glob("*.content.json")),
            "report.md, run": sorted(str(p) for p in folder.glob("*.run.json")), "statistics.md": statistics, "model.md": ["open/model.json", "sealed/model.json"],
            "certificate-format.md": certificates, "check": ["check.json"], "info": ["info.json"],
            "verdict": ["valid.json", "blocks.json", "valid_improved.json", "refuted.json"]}


def unpack_page(page):
    """Writes the two documents of a report page beside it; statistics.md lists what is in `statistics`."""
    data = re.search(r'id="terrane-data">([^<]*)<', page.read_text()).group(1)
    raw = gzip.decompress(base64.b64decode(data))
    content = json.loads(raw[4:4 + int.from_bytes(raw[:4], "little")])
    content["statistics"] = {}
    page.with_suffix(".content.json").write_text(json.dumps(content))
    run = json.loads(re.search(r'id="terrane-run">([^<]*)<', page.read_text()).group(1))
    run["seconds"] = {}
    page.with_suffix(".run.json").write_text(json.dumps(run))


def has_pages(program):
    """Whether the program was built with npm, and makes report pages."""
    said = subprocess.run([program, "report", "none.ts", "-o", "none.html"], capture_output=True, text=True, check=False)
    return "built without" not in said.stderr


def check_json(program, findings):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for file in (ROOT / "docs" / "data").iterdir():
            if file.suffix in (".ts", ".asc", ".obj", ".csv"):
                (folder / file.name).write_bytes(file.read_bytes())
        written = write_json_files(program, folder)
        true = {page: set().union(*(key_paths(json.loads((folder / f).read_text())) for f in files))
                for page, files in written.items()}
    pages = {"statistics.md": documented_keys("statistics.md", lambda a: a not in ("findings-of-check", "contents-of-files")),
             "model.md": documented_keys("model.md"),
             "certificate-format.md": documented_keys("certificate-format.md", lambda a: a != "verdict-of-verify"),
             "check": documented_keys("statistics.md", lambda a: a == "findings-of-check"),
             "info": documented_keys("statistics.md", lambda a: a == "contents-of-files"),
             "verdict": documented_keys("certificate-format.md", lambda a: a == "verdict-of-verify")}
    if has_pages(program):
        pages["report.md"] = documented_keys("report.md", lambda a: a == "keys-of-terrane-data")
        pages["report.md, run"] = documented_keys("report.md", lambda a: a == "keys-of-terrane-run")
    else:
        print("skipped: keys of reports: the program was built without npm")
    optional = {"seconds.cells"}  # there is no corner-point grid among the pages' data
    if not has_pages(program):
        optional |= {"seconds.page", "seconds.verify"}
    if not has_tetgen(program):
        print("skipped: keys of tetrahedra: the program does not find TetGen's helper")
        optional |= {k for k in pages["statistics.md"] if k.startswith(("tetrahedra", "constants.tetrahedralize", "constants.optimise"))
                    or k in ("seconds.tetrahedralize", "seconds.check", "seconds.split", "seconds.optimise")}
        optional |= {k for k in pages["certificate-format.md"] if k.startswith("tetrahedra")}
    # The model of the pages has no block, and no contact of blocks, that a resolution changes.
    optional |= {k for k in pages["statistics.md"] if k.startswith(("tolerance.left[]", "resolution.blocks[]", "resolution.contacts[]"))}
    for page, documented in pages.items():
        compare_keys(page, documented, true[page], findings, frozenset(optional))
    return sum(len(paths) for paths in true.values())


# ---- The schema of project files

def schema_paths(schema, prefix=""):
    """Path of each key that the schema allows, with its default or None."""
    paths = {}
    if "items" in schema and schema["items"].get("type") == "object":
        paths.update(schema_paths(schema["items"], prefix + "[]"))
    inner = dict(schema.get("properties", {}))
    if isinstance(schema.get("additionalProperties"), dict):
        inner["*"] = schema["additionalProperties"]
    for key, value in inner.items():
        path = f"{prefix}.{key}" if prefix else key
        paths[path] = value.get("default")
        paths.update(schema_paths(value, path))
    return paths


def check_project(findings):
    schema = json.loads((ROOT / "io" / "project.schema.json").read_text())
    true = schema_paths(schema)
    findings.compare("project.md", documented_keys("project.md"), set(true))
    sections = sections_of((REFERENCE / "project.md").read_text())
    rows = [row for lines in sections.values() for row in rows_of(lines) if len(row) == 3]
    for row in rows:
        for key in CODE.findall(row[0]):
            default = true.get(key)
            if default is not None and str(default).lower() not in row[2].replace("`", ""):
                findings.append(f"project.md: the default of {key} is {json.dumps(default)}")
    return len(true)


# ---- Names that the sources list

def source(name, folders=("algorithms", "io")):
    found = [p for top in folders for p in (ROOT / top).rglob(name)]
    if len(found) != 1:
        raise SystemExit(f"there are {len(found)} files {name}")
    return found[0].read_text()


def enumerators(text, name):
    body = re.search(rf"enum class {name}\b[^{{]*{{(.*?)}};", text, re.S).group(1)
    return re.findall(r"^\s*(\w+)", re.sub(r"//.*", "", body), re.M)


def first_cells(page, anchor):
    return {code for row in rows_of(sections_of((REFERENCE / page).read_text())[anchor])
            for code in CODE.findall(row[0]) or [row[0]]}


def statuses(codes):
    """The exit status of each error code, from the switch that maps them."""
    text = source("console.cpp", ("cli",))
    body = re.search(r"ExitStatus status_of\(ErrorCode code\) \{(.*?)\n\}", text, re.S).group(1)
    number = {"negative": "1", "bad_input": "2", "internal": "3"}
    other = re.search(r"default:\s*return ExitStatus::(\w+)", body).group(1)
    found = dict.fromkeys(codes, number[other])
    for cases, status in re.findall(r"((?:case ErrorCode::\w+:\s*)+)return ExitStatus::(\w+)", body):
        found.update(dict.fromkeys(re.findall(r"::(\w+)", cases), number[status]))
    return found


def check_names(findings):
    codes = set(enumerators(source("result.hpp"), "ErrorCode"))
    rows = rows_of(sections_of((REFERENCE / "errors.md").read_text())["kinds-of-errors"], "Code")
    documented = {row[0].strip("`"): row[2] for row in rows}
    findings.compare("errors.md", set(documented), codes)
    findings += [f"errors.md: the status of {code} is {status}"
                 for code, status in statuses(codes).items() if documented.get(code, status) != status]
    rules = {r.split("_")[0] for r in enumerators(source("verdict.hpp"), "Rule")}
    findings.compare("certificate.md, rules", first_cells("certificate.md", "rules"), rules)
    listed = set(re.findall(r'{"(\w+)", Format::\w+}', source("formats.cpp")))
    table = rows_of(sections_of((REFERENCE / "formats.md").read_text())["file-formats"])
    documented = {code.lstrip(".") for row in table for code in CODE.findall(row[1])}
    findings.compare("formats.md", documented, listed)
    return len(codes) + len(rules) + len(listed)


def check_headers(findings):
    """The stages, headers and functions that library.md lists."""
    table = rows_of(sections_of((ROOT / "docs" / "how-to" / "library.md").read_text())["stages-and-their-headers"])
    for stage, headers, functions in table:
        texts = []
        for name in CODE.findall(headers):
            header = ROOT / (name.removeprefix("terrane/") if name.startswith("terrane/") else f"algorithms/{name}")
            if header.is_file():
                texts.append(header.read_text())
            else:
                findings.append(f"library.md: {stage}: there is no header {name}")
        findings += [f"library.md: {stage}: no header of it declares {function}" for function in CODE.findall(functions)
                     if not any(re.search(rf"\b{function}\(", text) for text in texts)]
    return len(table)


def has_tetgen(program):
    """Whether the program finds TetGen's helper: it looks for that before it reads anything."""
    said = subprocess.run([program, "tetrahedralize", "no.ts", "-o", "no.vtu"], capture_output=True,
                          text=True, check=False).stderr
    return "helper program was not found" not in said


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    findings = Findings()
    options = check_options(program, findings)
    keys = check_json(program, findings)
    project = check_project(findings)
    names = check_names(findings) + check_headers(findings)
    for finding in findings:
        print(finding)
    print(f"{options} options, {keys} keys of JSON, {project} keys of projects, {names} names,"
          f" {len(findings)} findings")
    return 0 if not findings and min(options, keys, project, names) > 10 else 1


if __name__ == "__main__":
    sys.exit(main())
