#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tells lies in certificates of all kinds, and has `terrane verify` refute each.

    tests/oracles/forgeries.py --terrane build/release/cli/terrane [--seeds 10] [--first 1] [--keep FOLDER]

Each seed makes a certificate of each kind about small random surfaces, and tells each lie about each once, at a random
place. A lie leaves out the output files, so that the certificate itself must be refuted, and a lie about the mesh of
doubles states its true regions and the largest deviation that is accepted. A wrong digest alone does not count; a
verdict that counts differences from the exact part does. Prints the lies that are believed, and honest certificates
that are refuted; status 1 if there are any, or if a lie could not be told in any seed.
"""
import argparse
import copy
import json
import pathlib
import random
import subprocess
import sys
import tempfile

import lies_about_kinds  # noqa: F401, adds to LIES
from forged_models import COMMANDS, write_models
from lies import LIES, PARTS, decimal, regions_of


def verdict(terrane, folder, certificate):
    (folder / "forged.json").write_text(json.dumps(certificate))
    done = subprocess.run([terrane, "verify", "forged.json", "--json"], cwd=folder, capture_output=True, text=True,
                          check=False)
    if not done.stdout:
        sys.exit(f"forgeries: this is no certificate: {done.stderr}")
    return json.loads(done.stdout)


def be_modest(forged, honest, accepted):
    """Where the mesh of doubles was changed, states its own regions, no move and as much deviation as is accepted."""
    ours, before = forged.get("rounded"), honest.get("rounded")
    if ours and (ours["vertices"], ours["triangles"]) != (before["vertices"], before["triangles"]):
        ours["deviation"] = decimal(accepted * (1 - 2.0 ** -20))
        if ours["triangles"] != before["triangles"]:
            ours["max_move"], ours["regions"] = None, regions_of(forged)


def judge_seed(terrane, seed, folder, told, kept):
    rng = random.Random(seed)
    write_models(rng, folder)
    flaws = []
    for kind, command in COMMANDS.items():
        made = subprocess.run([terrane, *command, "--certificate", f"{kind}.json"], cwd=folder, capture_output=True,
                              text=True, check=False)
        if made.returncode != 0:
            flaws.append(f"seed {seed}: {kind} has no certificate: {made.stderr.strip()[:300]}")
            continue
        honest = json.loads((folder / f"{kind}.json").read_text())
        if honest["kind"] != kind:
            flaws.append(f"seed {seed}: {kind} is of kind {honest['kind']}")
            continue
        honest["outputs"] = []
        if not (said := verdict(terrane, folder, honest))["valid"]:
            flaws.append(f"seed {seed}: {kind} is honest and refuted: {said['violations'][0]}")
            continue
        accepted = said["max_deviation"]
        assert kind in PARTS or regions_of(honest) == honest["rounded"]["regions"]
        for (of, name), tell in LIES.items():
            if of != kind:
                continue
            forged = copy.deepcopy(honest)
            if tell(forged, rng) is None and forged == honest:
                continue
            be_modest(forged, honest, accepted)
            said = verdict(terrane, folder, forged)
            if {v["rule"] for v in said["violations"]} == {"R17"} and not name.startswith("a_digest"):
                said["valid"] = True
            if any(said.get(key) for key in ("lost_meetings", "new_meetings", "turned_edges")):
                said["valid"], said["violations"] = False, [{"rule": "counted"}]  # the verdict tells the difference
            rules = told.setdefault((kind, name), [])
            rules.append("/".join(sorted({v["rule"] for v in said["violations"]})) if not said["valid"] else "believed")
            if said["valid"]:
                flaws.append(f"seed {seed}: {kind}: {name} is believed")
                if kept:
                    kept.mkdir(parents=True, exist_ok=True)
                    (kept / f"{seed}_{kind}_{name}.json").write_text(json.dumps(forged))
    return flaws


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--terrane", required=True)
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--rules", action="store_true", help="print which rules refute each lie")
    options = parser.parse_args()
    terrane, told, flaws = str(pathlib.Path(options.terrane).resolve()), {}, []
    for seed in range(options.first, options.first + options.seeds):
        with tempfile.TemporaryDirectory() as name:
            flaws += judge_seed(terrane, seed, pathlib.Path(name), told, options.keep)
    flaws += [f"nobody could tell {kind}: {name}" for kind, name in LIES if (kind, name) not in told]
    if options.rules:
        for (kind, name), rules in told.items():
            print(f"{kind:12} {name:50} {' '.join(sorted(set(rules)))}")
    for flaw in flaws:
        print(flaw)
    print(f"{sum(map(len, told.values()))} lies, {len(flaws)} flaws")
    return 1 if flaws else 0


if __name__ == "__main__":
    sys.exit(main())
