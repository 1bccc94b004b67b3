#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tells lies in certificates of all kinds, and has `terrane verify` refute each.

    tests/oracles/forgeries.py --terrane build/release/cli/terrane [--seeds 10] [--first 1] [--share 1] [--keep DIR]
                              [NAME ...]

Each seed makes certificates of each kind about small random surfaces (all, or those with these NAMEs: SUBJECTS), and
tells each lie about each once, at a random place:

- in the claims. The certificate then names no output files, so that the claims themselves must be refuted, and one
  about the mesh of doubles states its true curves and regions, and the largest deviation that is accepted. A wrong
  digest alone does not count; a verdict that counts differences from the exact part does.
- in the text of the certificate.
- in one output file of each format, whose hash the certificate then has.
- in the names of files, and about what they hold.
- in the inputs, whose hashes the certificate then has.

Prints a table of subjects and lies with the rules that refute them (`text`: it is no certificate; `file`: a file was
not opened, or is not verified), the lies that are believed, and honest certificates that are not valid; status 1 if
there are any, or if a lie could not be told in any seed.
"""
import argparse
import copy
import hashlib
import json
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

import lies_about_blocks  # noqa: F401, as the next three: they add to LIES
import lies_about_changes  # noqa: F401
import lies_about_kinds  # noqa: F401
import lies_about_shapes  # noqa: F401
from forged_models import SUBJECTS, write_models
from lies import LIES, PARTS, curves_of, decimal, regions_of
from lies_about_files import INPUT_LIES, NAMING_LIES
from lies_about_formats import FILE_LIES
from lies_about_text import TEXT_LIES

BELIEVED = "believed"


def told(tell, *arguments):
    """What a lie returns; None where it has nothing to choose from."""
    try:
        return tell(*arguments)
    except IndexError:
        return None


class Forger:
    """One honest certificate, and what the verifier says about lies in it."""

    def __init__(self, terrane, subject, folder, share):
        self.terrane, self.subject, self.folder, self.share = terrane, subject, folder, share
        self.path = folder / subject.certificate
        self.text = self.path.read_text()
        self.honest = json.loads(self.text)
        self.forged = self.path.with_name("forged.json")

    def verdict(self, certificate):
        """Judges a certificate, or its text: returns the verdict, and the status."""
        text = certificate if isinstance(certificate, str) else json.dumps(certificate)
        self.forged.write_bytes(text.encode(errors="surrogateescape"))
        inputs = [self.folder / file for file in self.subject.inputs]
        done = subprocess.run([self.terrane, "verify", self.forged, *inputs, "--json"], capture_output=True, text=True,
                              check=False)
        assert done.returncode in (0, 1, 2), done.stderr
        return (json.loads(done.stdout) if done.stdout else None), done.returncode, done.stderr

    def rules(self, certificate):
        """The rules that a certificate breaks; a verdict that tells the difference is no worse."""
        said, status, error = self.verdict(certificate)
        if said is None:
            return "text" if self.forged.name in error else "file"
        broken = sorted({v["rule"] for v in said["violations"]}, key=lambda r: int(r[1:]))
        if any(said.get(key) for key in ("lost_meetings", "new_meetings", "turned_edges")):
            broken.append("counted")
        # The status says, too, when no output was verified.
        judged = json.loads(self.forged.read_bytes())
        return "/".join(broken) or (BELIEVED if status == 0 or not judged["outputs"] else "file")

    def leaves_out(self, rng):
        return rng.random() >= self.share

    def without_outputs(self):
        return {**copy.deepcopy(self.honest), "outputs": []}

    # Each of these yields the names of lies, and the rules that refute them; None where nothing was said.

    def claims(self, rng):
        honest = self.without_outputs()
        accepted = self.verdict(honest)[0]["max_deviation"]
        if honest["kind"] not in PARTS:
            assert regions_of(honest) == honest["rounded"]["regions"]
            assert curves_of(honest) == honest["rounded"]["intersection_edges"]
        for (kind, name), tell in LIES.items():
            if kind != honest["kind"] or self.leaves_out(rng):
                continue
            forged = copy.deepcopy(honest)
            told(tell, forged, rng)
            be_modest(forged, honest, accepted)
            if forged == honest:
                yield name, None
                continue
            rules = self.rules(forged)
            yield name, BELIEVED if rules == "R17" and not name.startswith("a_digest") else rules

    def texts(self, rng):
        honest = json.dumps(self.without_outputs(), separators=(",", ":"))
        for name, (tell, _) in TEXT_LIES.items():
            if self.leaves_out(rng):
                continue
            forged = told(tell, honest, rng)
            yield name, self.rules(forged) if forged not in (None, honest) else None

    def outputs(self, rng):
        for name, (tell, _, formats) in FILE_LIES.items():
            for format_name in sorted({o["format"] for o in self.honest["outputs"]}):
                if formats and format_name not in formats or self.leaves_out(rng):
                    continue
                forged = copy.deepcopy(self.honest)
                output = rng.choice([o for o in forged["outputs"] if o["format"] == format_name])
                yield f"{format_name}: {name}", self.with_file(forged, output, output["name"],
                                                              lambda data, tell=tell: told(tell, data, rng))

    def with_file(self, forged, stated, name, change):
        """Judges a certificate that has the hash of a file after a change."""
        file = self.path.parent / name
        honest = file.read_bytes()
        lie = change(honest)
        if lie in (None, honest):
            return None
        file.write_bytes(lie)
        stated["bytes"], stated["sha256"] = len(lie), hashlib.sha256(lie).hexdigest()
        rules = self.rules(forged)
        file.write_bytes(honest)
        return rules

    def names(self, rng):
        for name, (tell, _, _) in NAMING_LIES.items():
            if self.leaves_out(rng):
                continue
            forged = copy.deepcopy(self.honest)
            told(tell, forged, self.path.parent, rng)
            yield name, self.rules(forged) if forged != self.honest else None
            for made in self.path.parent.glob("lie*"):
                if made.is_dir() and not made.is_symlink():
                    shutil.rmtree(made)
                else:
                    made.unlink()

    def inputs(self, rng):
        for name, (tell, _, kinds) in INPUT_LIES.items():
            if self.leaves_out(rng):
                continue
            forged = self.without_outputs()
            if kinds and forged["kind"] not in kinds:
                continue
            is_layered = forged["kind"] == "layered"  # of which the first surface does not give way
            stated = forged["inputs"][0] if is_layered else rng.choice(forged["inputs"])

            def change(data, stated=stated, tell=tell):
                lines = data.decode().splitlines()
                stated["surfaces"][0]["triangles"] += tell(lines, rng)
                return "".join(line + "\n" for line in lines).encode()
            yield name, self.with_file(forged, stated, stated["name"], change)


def be_modest(forged, honest, accepted):
    """Where the mesh of doubles was changed, states its own curves and regions, no move, and as much deviation as is
    accepted. What is added to filled surfaces, or missing, is of the last one."""
    if "filled" in forged:
        ours, given = forged["filled"], len(honest["filled"]["triangles"])
        for key in ("vertices", "triangles"):
            ours["surfaces"][-1][key] += len(ours[key]) - sum(s[key] for s in ours["surfaces"])
        ours["deviation"] += [None] * (len(ours["vertices"]) - len(ours["deviation"]))
        holes = max(ours["invented"], default=0) + 1
        ours["invented"][given:] = [h or holes for h in ours["invented"][given:]]
    ours, before = forged.get("rounded"), honest.get("rounded")
    if ours and (ours["vertices"], ours["triangles"]) != (before["vertices"], before["triangles"]):
        ours["deviation"] = decimal(accepted * (1 - 2.0 ** -20))
        if ours["triangles"] != before["triangles"]:
            ours["max_move"] = None
            try:
                ours["intersection_edges"] = curves_of(forged)
                ours["regions"] = regions_of(forged)
            except IndexError:  # lists of other lengths, or indices of nothing
                pass


def judge_seed(terrane, seed, folder, table, options):
    rng = random.Random(seed)
    write_models(rng, folder)
    flaws = []
    for name, subject in SUBJECTS.items():
        if options.names and name not in options.names:
            continue
        made = subprocess.run([terrane, *subject.command], cwd=folder, capture_output=True, text=True, check=False)
        if made.returncode != 0:
            flaws.append(f"seed {seed}: {name} has no certificate: {made.stderr.strip()[:300]}")
            continue
        forger = Forger(terrane, subject, folder, options.share)
        if forger.honest["kind"] != name.split(",")[0] or forger.verdict(forger.text)[1] != 0:
            flaws.append(f"seed {seed}: {name} is of kind {forger.honest['kind']}, or honest and refuted")
            continue
        for way in (forger.claims, forger.texts, forger.outputs, forger.names, forger.inputs):
            for lie, rules in way(rng):
                all_rules = table.setdefault((name, f"{way.__name__}: {lie}"), [])
                all_rules += [rules] if rules else []
                if rules == BELIEVED:
                    flaws.append(f"seed {seed}: {name}: {lie} is believed")
                    if options.keep:
                        options.keep.mkdir(parents=True, exist_ok=True)
                        shutil.copyfile(forger.forged, options.keep / f"{seed}_{name}_{lie}.json".replace(": ", "_"))
    return flaws


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--terrane", required=True)
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--share", type=float, default=1)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("names", nargs="*", metavar="NAME")
    options = parser.parse_args()
    terrane, table, flaws = str(pathlib.Path(options.terrane).resolve()), {}, []
    for seed in range(options.first, options.first + options.seeds):
        with tempfile.TemporaryDirectory() as name:
            flaws += judge_seed(terrane, seed, pathlib.Path(name), table, options)
    for (subject, lie), rules in table.items():
        print(f"{subject:18} {lie:60} {' '.join(sorted(set(rules)))}")
    nobody = {lie for _, lie in table} - {lie for (_, lie), rules in table.items() if rules}
    if options.share == 1 and not options.names:
        flaws += [f"nobody could tell: {lie}" for lie in sorted(nobody)]
    for flaw in flaws:
        print(flaw)
    print(f"{sum(map(bool, table.values()))} lies about {len({subject for subject, _ in table})} subjects, told "
          f"{sum(map(len, table.values()))} times, {len(flaws)} flaws")
    return 1 if flaws else 0


if __name__ == "__main__":
    sys.exit(main())
