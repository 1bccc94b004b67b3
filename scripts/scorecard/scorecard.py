#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Has `terrane judge` compare what engines make of the cases of a folder with what they should make.

    scripts/scorecard/scorecard.py tests/corpus --engines ENGINES.json --terrane PROGRAM -o card

It writes card.json (all results), card.md (the tables) and card.html (the same, and each case). An engine is a command
line in a JSON file (docs/how-to/judge.md). Each call is a process of its own, with limits of time and memory.
"""
import argparse
import array
import collections
import concurrent.futures
import fractions
import html
import json
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile

#: How a call ends, best first.
ENDS = ("right", "in doubt", "refused", "wrong", "crashed", "too slow")


def limited(command, seconds, memory, environment=None):
    """The status of a command and what it printed; None for the status if the time is over."""
    def limits():
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if memory:
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                          start_new_session=True, preexec_fn=limits, env=environment) as process:
        try:
            text, _ = process.communicate(timeout=seconds)
            return process.returncode, text
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            return None, process.communicate()[0]


class Card:
    """Engines, cases, and what is found."""

    def __init__(self, arguments):
        self.arguments = arguments
        self.engines = json.loads(arguments.engines.read_text(encoding="utf-8"))
        self.here = arguments.engines.resolve().parent
        self.folder = arguments.folder
        paths = sorted(self.folder.glob("*.json"))[arguments.first::arguments.every]
        self.cases = [c for c in (json.loads(p.read_text(encoding="utf-8")) for p in paths) if c.get("format") == "terrane-case 1"]
        self.sound = {}

    def judge(self, *words):
        """The properties that `terrane judge` names; none if the first file is no mesh."""
        _, text = limited([self.arguments.terrane, "judge", *map(str, words), "--json"], 600, 0)
        found = [json.loads(line) for line in text.splitlines() if line.startswith("{")]
        if found or text.startswith(f"terrane: {words[0]}"):
            return found
        return [{"property": "inputs", "verdict": "not judged", "sentence": text}]  # or the bound is too wide for them

    def lacks(self, name):
        """What an input is not: conforming, closed, manifold, oriented, solid (the union of itself) or single (precision)."""
        if name not in self.sound:
            path = self.folder / name
            found = self.judge("--soup", path)
            lacks = {p["property"] for p in found if p["verdict"] == "fails"}
            alone = self.judge(path, path, "--operation", "union")
            text = path.read_text().split()
            numbers = map(float, text[4:4 + 3 * int(text[1])])
            self.sound[name] = (lacks | (set() if alone and all(p["verdict"] != "fails" and p["property"] != "inputs" for p in alone) else {"solid"})
                                | ({"single"} if any(x != to_single(x) for x in numbers) else set()))
        return self.sound[name]

    def overlaps(self, case):
        """Whether triangles share an area: two have the same corners (the later one has no answers), or points of the
        arrangement that are not on a line."""
        points = [tuple(map(fractions.Fraction, p)) for p in case["points"]]
        count = sum(int((self.folder / name).read_text().split()[2]) for name in case["inputs"])
        on = {int(k): set(v) for k, v in case["points_on"].items()}

        def flat(shared):
            a, *others = (points[k] for k in shared)
            sides = [[x - y for x, y in zip(p, a)] for p in others]
            return all(u[i] * v[j] == u[j] * v[i] for u in sides[:1] for v in sides for i, j in ((0, 1), (1, 2), (0, 2)))
        return len(on) < count or any(len(on[i] & on[j]) > 2 and not flat(on[i] & on[j]) for i, j in case["contacts"])

    def tasks(self):
        for engine in self.engines:
            if self.arguments.only and engine["name"] not in self.arguments.only:
                continue
            for case in self.cases:
                for operation in engine["operations"]:
                    if operation == "arrangement" or "booleans" in case:
                        yield engine, case, operation

    def call(self, task):
        engine, case, operation = task
        needs = set(engine.get("needs", []))
        promised = not any(needs & self.lacks(name) for name in case["inputs"]) and not ("apart" in needs and self.overlaps(case))
        result = {"engine": engine["name"], "case": case["name"], "operation": operation, "promised": promised, "fails": []}
        with tempfile.TemporaryDirectory() as work:
            output = pathlib.Path(work) / "output.off"
            if self.arguments.keep:
                output = self.arguments.keep / f"{engine['name']}-{case['name']}-{operation}.off".replace(" ", "_").replace("/", "_")
                output.unlink(missing_ok=True)
            inputs = [str((self.folder / name).resolve()) for name in case["inputs"]]
            values = {"{here}": str(self.here), "{operation}": operation, "{output}": str(output), "{terrane}": self.arguments.terrane}
            command = []
            for word in engine["command"]:
                for key, value in values.items():
                    word = word.replace(key, value)
                command += inputs if word == "{inputs}" else [word]
            environment = os.environ | {"SCORECARD": "\n".join([operation, str(output), *inputs])}
            status, text = limited(command, self.arguments.seconds, self.arguments.memory * 2**20, environment)
            result["end"], result["says"] = self.end(status, output, text)
            if result["end"] is None:
                words = [] if operation == "arrangement" else ["--operation", operation]
                found = self.judge(output, *inputs, *words, "--spacings", engine.get("spacings", 16))
                result |= judged(found)
        return result

    @staticmethod
    def end(status, output, text):
        """How a call ended that left nothing to judge, and what it said last."""
        last = " ".join(text.split("\n")[-4:]).strip()[-200:]
        if status is None:
            return "too slow", ""
        if status < 0 or status >= 128:
            return "crashed", last
        if status != 0 or not output.exists():
            return "refused", last
        return None, ""

    def run(self):
        tasks = list(self.tasks())
        with concurrent.futures.ThreadPoolExecutor(self.arguments.jobs) as pool:
            results = []
            for k, result in enumerate(pool.map(self.call, tasks), 1):
                results.append(result)
                if k % 500 == 0 or k == len(tasks):
                    print(f"{k} of {len(tasks)} calls", file=sys.stderr)
        return results


def judged(found):
    """The end of a call whose output was judged: its properties that fail, and the first sentence."""
    if not found:
        return {"end": "wrong", "fails": ["format"], "says": "the output is no mesh"}
    fails = [p for p in found if p["verdict"] == "fails"]
    doubt = any(p["verdict"] == "not judged" for p in found)
    says = f"{fails[0]['property']}: {fails[0]['sentence']}" if fails else ""
    return {"end": "wrong" if fails else "in doubt" if doubt else "right", "fails": [p["property"] for p in fails], "says": says}


def to_single(x):
    """The nearest number of single precision."""
    try:
        return array.array("f", [x])[0]
    except OverflowError:
        return float("inf")


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows])


def tables(results):
    """The rows of both tables, engines by the share of right ones among the promised."""
    by_engine = collections.defaultdict(list)
    for r in results:
        by_engine[r["engine"]].append(r)

    def share(name):
        promised = [r for r in by_engine[name] if r["promised"]]
        return sum(r["end"] == "right" for r in promised) / max(1, len(promised))
    names = sorted(by_engine, key=lambda name: -share(name))
    ends, properties = [], []
    for name in names:
        promised = [r for r in by_engine[name] if r["promised"]]
        others = [r for r in by_engine[name] if not r["promised"]]
        counts = collections.Counter(r["end"] for r in promised)
        right = sum(r["end"] == "right" for r in others)
        ends.append([name, len(promised), *(counts[end] for end in ENDS), f"{right} of {len(others)}" if others else ""])
        properties.append([name, collections.Counter(p for r in promised for p in r["fails"])])
    judged_properties = [p for p in ("conforming", "distinct", "welded", "vertices", "curves", "coverage", "topology",
                                     "orientation", "volume", "format") if any(c[p] for _, c in properties)]
    return ((["Engine", "Calls", *(e.capitalize() for e in ENDS), "Right, not promised"], ends),
            (["Engine", *judged_properties], [[name, *(c[p] for p in judged_properties)] for name, c in properties]))


def markdown(results):
    return "\n\n".join(table(*t) for t in tables(results)) + "\n"


def page(results):
    """The tables, and one row per case and operation, as HTML."""
    def rows(head, body):
        cells = "".join(f"<th>{html.escape(str(h))}</th>" for h in head)
        lines = "".join("<tr>" + "".join(f"<td>{html.escape(str(c))}</td>" for c in row) + "</tr>" for row in body)
        return f"<table><tr>{cells}</tr>{lines}</table>"
    engines = list(dict.fromkeys(r["engine"] for r in results))
    grid = collections.defaultdict(dict)
    for r in results:
        grid[r["case"], r["operation"]][r["engine"]] = r
    lines = []
    for (case, operation), row in sorted(grid.items()):
        cells = "".join(
            f"<td class='{row[e]['end'].replace(' ', '-')}{'' if row[e]['promised'] else ' unpromised'}' "
            f"title='{html.escape(row[e]['says'], quote=True)}'>{row[e]['end']}</td>" if e in row else "<td></td>" for e in engines)
        lines.append(f"<tr><th>{html.escape(case)}</th><td>{operation}</td>{cells}</tr>")
    head = "".join(f"<th>{html.escape(e)}</th>" for e in ("case", "operation", *engines))
    return f"""<!doctype html><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>Score card</title>
<style>
body {{ font: 14px/1.4 system-ui, sans-serif; margin: 2em; }}
table {{ border-collapse: collapse; margin-bottom: 2em; }}
th, td {{ border: 1px solid #ccc; padding: .2em .6em; text-align: left; }}
.right {{ background: #cfe8cf; }} .in-doubt {{ background: #eef2c8; }} .refused {{ background: #fbe3b8; }}
.wrong, .crashed, .too-slow {{ background: #f3c0bb; }} .unpromised {{ opacity: .45; }}
</style>
<h1>Score card</h1>
{"".join(rows(*t) for t in tables(results))}
<p>What is pale was not promised. The first flaw is told where the pointer rests.</p>
<table><tr>{head}</tr>
{chr(10).join(lines)}
</table>
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, help="cases: docs/reference/case.md")
    parser.add_argument("--engines", type=pathlib.Path, default=pathlib.Path(__file__).with_name("engines.json"))
    parser.add_argument("--terrane", default="terrane", help="the program that judges")
    parser.add_argument("--only", action="append", metavar="ENGINE", help="this engine alone; may be repeated")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="every Nth case")
    parser.add_argument("--first", type=int, default=0, metavar="N", help="from this case on, counted from 0")
    parser.add_argument("--seconds", type=float, default=30, help="limit of time of a call")
    parser.add_argument("--memory", type=int, default=0, metavar="MIB", help="limit of memory of a call; 0 for none")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--keep", type=pathlib.Path, metavar="FOLDER", help="keep the outputs there")
    parser.add_argument("--from", dest="known", type=pathlib.Path, metavar="CARD.json", help="write the tables of these results")
    parser.add_argument("--strict", action="store_true", help="status 1 if a promised result is not right or in doubt")
    parser.add_argument("-o", "--output", required=True, help="name of the files, without an ending")
    arguments = parser.parse_args()
    if arguments.keep:
        arguments.keep.mkdir(parents=True, exist_ok=True)
    results = json.loads(arguments.known.read_text()) if arguments.known else Card(arguments).run()
    for ending, text in ((".json", json.dumps(results, indent=0)), (".md", markdown(results)), (".html", page(results))):
        pathlib.Path(arguments.output + ending).write_text(text, encoding="utf-8")
    print(markdown(results))
    bad = not results or any(r["promised"] and r["end"] not in ("right", "in doubt") for r in results)
    sys.exit(1 if arguments.strict and bad else 0)


if __name__ == "__main__":
    main()
