#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Makes certificates of every kind on real models and tries to have forged output files accepted.

  scripts/certify_gallery.py [--terrane PROGRAM] [--data FOLDER] [--places N] [--scratch FOLDER] [KIND...]

For each model it runs the command without and with --certificate, verifies the certificate, then changes one byte of
a number in each output file, at N places one after the other (default 3), computes the hashes in the certificate
anew, and demands that `terrane verify` refuses each of these files. It prints a table in Markdown, with times of all
processors together; the status is 1 if a certificate was refused or a forged file accepted. FOLDER has the models
(default ../shared/data); those that are missing are left out and named. KIND chooses among the kinds (default: all).
"""
import argparse
import base64
import hashlib
import json
import lzma
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import zlib
from dataclasses import dataclass, field

RING, PYTOOLS = "ringmesh+RINGMesh", "xaliphostes+xali-pytools/data/models"
ARCH, CGAL = "xaliphostes+arch-platform/public/models", "debian+libcgal-demo/data/meshes"
DROGON = "equinor+xtgeo-testdata/surfaces/drogon/1"
MODELS = {
    "modelA1": f"{RING}/modelA1.ml",
    "modelA2": f"{RING}/modelA2.ml",
    "cube, not sealed": f"{RING}/not_sealed_cube.ml",
    "gom": f"{PYTOOLS}/gom.ts",
    "tindel": f"{PYTOOLS}/tindel.ts",
    "sphere": f"{PYTOOLS}/sphere.ts",
    "Tet faults": f"{ARCH}/Tet/faults.ts",
    "NashPoint joints": f"{ARCH}/NashPoint/all_joints_3D.ts",
    "mannequin-devil": f"{CGAL}/mannequin-devil.off",
    "elephant with holes": f"{CGAL}/elephant-with-holes.off",
    "shark with holes": f"{CGAL}/mech-holes-shark.off",
    "mesh with border": f"{CGAL}/mesh_with_border.off",
    "mask": f"{CGAL}/mask_cone.off",
    "patch": f"{CGAL}/patch-01.off",
    "double torus": f"{CGAL}/double-torus-3-holes.off",
    "three blobs": f"{CGAL}/blobby_3cc.off",
    "bull": f"{CGAL}/bull.off",
    "horizons": f"{CGAL}/horizons.off",
    "modelA4": f"{RING}/modelA4.ml.xz",
    "Drogon": [f"{DROGON}/02_toptherys.gri", f"{DROGON}/03_topvolon.gri"],
}


@dataclass
class Kind:
    """How to make a certificate of one kind: the words before and after the input files, the outputs, the models.
    Where these are a dictionary, it has the words behind those for all."""
    command: list
    outputs: list
    models: list | dict
    options: list = field(default_factory=list)


def stack(*names):
    """The options for horizons from the top down: the lowest is the hardest."""
    return [word for hardness, name in enumerate(names, 1) for word in ("--layer", f"{name}={hardness}")]


SURFACES = ["out.obj", "out.vtp", "out.ply"]
KINDS = {
    "arrangement": Kind(["arrange"], SURFACES,
                        ["modelA1", "modelA2", "gom", "tindel", "Tet faults", "NashPoint joints", "mannequin-devil"]),
    "volumes": Kind(["volume"], ["model"],
                    ["modelA1", "modelA2", "gom", "three blobs", "double torus", "bull"], ["--parts", "obj"]),
    "tetrahedra": Kind(["tetrahedralize"], ["out.vtu", "out.msh"],
                       ["modelA1", "cube, not sealed", "sphere", "three blobs", "double torus", "gom"]),
    "improved": Kind(["improve"], SURFACES,
                     ["modelA1", "tindel", "three blobs", "horizons", "double torus", "bull"]),
    "filled": Kind(["fill"], SURFACES,
                   ["elephant with holes", "shark with holes", "mesh with border", "mask", "patch"],
                   ["--method", "rbf"]),
    "cut": Kind(["arrange"], SURFACES, {
        "modelA1": ["--box", "-3000,-2000,-1500,8000,4000,0"],
        "modelA2": ["--rotated-box", "3000,1000,-800,8000,5000,1500,30,5,3"],
        "gom": ["--box", "560000,10000,-9000,600000,50000,-4000"],
        "tindel": ["--polygon", "-1000,-1000,4000,-500,2000,1500,3500,5500,-500,5000", "--between", "-2900,-1400"],
        "horizons": ["--within", f"{{data}}/{CGAL}/elephant.off"],
        "mannequin-devil": ["--box", "-8,-10,-12,9,11,13"]}),
    # What is out of order gives way, which is much of these models.
    "layered": Kind(["layer"], SURFACES, {
        "modelA1": stack("h3_model1", "h2_model1", "h1_model1"),
        "modelA2": stack("h3_model3", "h2_model3", "h1_model3"),
        "modelA4": stack("H3b_horizon", "H2b_horizon", "H1b_horizon"),
        "tindel": stack("Main_6", "Main_4", "Main_7"),
        "Drogon": stack("03_topvolon", "02_toptherys")}),
    "layered, thick": Kind(["layer"], SURFACES, {
        "modelA1": [*stack("h3_model1", "h2_model1", "h1_model1"), "--min-thickness", "50"],
        "modelA2": [*stack("h3_model3", "h2_model3", "h1_model3"), "--min-thickness", "30"],
        "modelA4": [*stack("H3b_horizon", "H2b_horizon", "H1b_horizon"), "--min-thickness", "20"],
        "tindel": [*stack("Main_6", "Main_4", "Main_7"), "--min-thickness", "40"],
        "Drogon": [*stack("02_toptherys", "03_topvolon"), "--min-thickness", "30"]}),
    "sealed": Kind(["arrange"], SURFACES, ["modelA1", "modelA2", "tindel", "gom"], ["--seal", "30"]),
    "sealed, small": Kind(["arrange"], SURFACES, ["cube, not sealed", "NashPoint joints"], ["--seal", "0.4"]),
    "sealed and cut": Kind(["arrange"], SURFACES, ["modelA1", "modelA2", "tindel"],
                           ["--seal", "30", "--extend", "300", "--box", "0,0,-3000,4000,4000,0"]),
    "sealed volumes": Kind(["volume"], ["model"], ["cube, not sealed"], ["--parts", "obj", "--seal", "0.4"]),
}


@dataclass
class Outcome:
    """What a run of the program took."""
    status: int
    seconds: float  # of all processors
    megabytes: float
    out: str
    err: str


def run(words, folder):
    """Runs the program in a folder."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        child = subprocess.Popen([str(w) for w in words], cwd=folder, stdout=out, stderr=err)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        texts = []
        for stream in (out, err):
            stream.seek(0)
            texts.append(stream.read().decode(errors="replace"))
    return Outcome(child.returncode, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, *texts)


def changed_digit(data, at):
    """Replaces the digit at a place by another one."""
    return data[:at] + (b"5" if data[at:at + 1] != b"5" else b"6") + data[at + 1:]


def place_in(places, share):
    return places[min(int(share * len(places)), len(places) - 1)]


def numbers_in(text):
    """Unpacks blocks of numbers; returns the text itself if it is damaged, or not packed."""
    try:
        packed = base64.b64decode(text + b"=" * (-len(text) % 4))
        numbers = b""
        while packed:
            block = zlib.decompressobj()
            numbers += block.decompress(packed) + block.flush()
            if not block.eof:
                return text
            packed = block.unused_data
        return numbers
    except (ValueError, zlib.error):
        return text


def forged_vtk(data, share):
    """Changes one byte of packed numbers so that these change: of a run of zeros there are many packed forms."""
    found = place_in(list(re.finditer(rb"[A-Za-z0-9+/]{40,}", data)), share)
    right = numbers_in(found.group())
    for at in range((found.start() + found.end()) // 2, found.end()):
        wrong = data[:at] + (b"B" if data[at:at + 1] != b"B" else b"C") + data[at + 1:]
        if numbers_in(wrong[found.start():found.end()]) != right:
            return wrong
    raise ValueError("no byte of these numbers matters")


def forged(name, data, share):
    """Changes one byte of a number, at about this share of the file."""
    if name.endswith(".ply"):
        start = data.index(b"end_header\n") + len(b"end_header\n")
        at = start + int(share * (len(data) - start - 1))
        return data[:at] + bytes([data[at] ^ 1]) + data[at + 1:]
    if name.endswith((".vtp", ".vtu")):  # numbers are compressed and in base64
        return forged_vtk(data, share)
    pattern = {".obj": rb"(?m)^[vf] [^\n]*?(\d)[^\d\n]*$", ".json": rb'"volume_written":-?(\d)|"volumes":\[(\d)'}
    if name.endswith(".msh"):
        pattern[".msh"] = rb"(?m)^-?[\d.e-]+ -?[\d.e-]+ -?\d*?(\d)[\d.e-]*$"
    found = place_in(list(re.finditer(pattern[pathlib.Path(name).suffix], data)), share)
    return changed_digit(data, found.start(next(g for g in range(1, found.re.groups + 1) if found.group(g))))


def accepted_forgeries(terrane, folder, inputs, share):
    """Changes each output file and returns those that the verifier accepts, and the number of all."""
    text = (folder / "certificate.json").read_text()
    certificate = json.loads(text)
    right = {}
    for output in certificate["outputs"]:
        path = folder / output["name"]
        right[path] = path.read_bytes()
        wrong = forged(output["name"], right[path], share)
        assert len(wrong) == len(right[path]) and wrong != right[path]
        path.write_bytes(wrong)
        text = text.replace(output["sha256"], hashlib.sha256(wrong).hexdigest())
    (folder / "forged.json").write_text(text)
    verdict = run([terrane, "verify", "--json", "forged.json", *inputs], folder)
    for path, data in right.items():
        path.write_bytes(data)
    outputs = json.loads(verdict.out)["outputs"]
    return [o["name"] for o in outputs if o["state"] != "refuted"], len(certificate["outputs"])


def memory_text(megabytes):
    """Linux counts the memory of this script, from which the program is started, as the least."""
    own = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return f"{megabytes:.0f} MB" if megabytes > 1.05 * own else f"at most {megabytes:.0f} MB"


def triangles_of(certificate):
    return sum(s["triangles"] for i in certificate["inputs"] for s in i["surfaces"])


def unpacked(source, folder):
    """Returns the file, or what it becomes in the folder if it is packed."""
    if source.suffix != ".xz":
        return source
    target = folder / source.stem
    target.write_bytes(lzma.decompress(source.read_bytes()))
    return target


def files_of(options, model):
    names = MODELS[model] if isinstance(MODELS[model], list) else [MODELS[model]]
    return [(options.data / name).resolve() for name in names]


def judge(options, name, kind, model):
    """Judges one model; returns the cells of its row, and what is wrong."""
    with tempfile.TemporaryDirectory(dir=options.scratch) as scratch:
        folder = pathlib.Path(scratch)
        own = kind.models[model] if isinstance(kind.models, dict) else []
        sources = [unpacked(source, folder) for source in files_of(options, model)]
        own = [word.replace("{data}", str(options.data.resolve())) for word in own]
        base = [options.terrane, *kind.command, *sources, *kind.options, *own]
        inputs = sources + [word for word in own if word.startswith("/")]
        outputs = [word for output in kind.outputs for word in ("-o", output)]
        plain_folder = folder / "plain"
        plain_folder.mkdir()
        plain = run(base + outputs, plain_folder)
        made = run(base + outputs + ["--certificate", "certificate.json"], folder)
        if made.status not in (0, 1) or not (folder / "certificate.json").exists():
            return None, f"{name}, {model}: no certificate: {made.err.strip().splitlines()[-1:]}"
        verified = run([options.terrane, "verify", "--json", "certificate.json", *inputs], folder)
        triangles = triangles_of(json.loads((folder / "certificate.json").read_text()))
        refused = tried = 0
        wrong = "" if verified.status == 0 else f"{name}, {model}: refused: {verified.out[-400:]}{verified.err}"
        for place in range(options.places if verified.status == 0 else 0):
            accepted, count = accepted_forgeries(options.terrane, folder, inputs, (place + 0.5) / options.places)
            refused += count - len(accepted)
            tried += count
            for file in accepted:
                wrong += f"{name}, {model}: accepted: a forged {file}\n"
        return [name, model, f"{triangles:,}".replace(",", " "), f"{plain.seconds:.2f} s", f"{made.seconds:.2f} s",
                f"{verified.seconds:.2f} s", memory_text(verified.megabytes), f"{refused} of {tried}"], wrong


def main():
    home = pathlib.Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kinds", nargs="*", choices=[*KINDS, []], metavar="KIND")
    parser.add_argument("--terrane", type=pathlib.Path, default=home / "build/release/cli/terrane")
    parser.add_argument("--data", type=pathlib.Path, default=home.parent / "shared/data")
    parser.add_argument("--places", type=int, default=3)
    parser.add_argument("--scratch", type=pathlib.Path)
    options = parser.parse_args()
    options.terrane = options.terrane.resolve()
    print("| kind | model | triangles | made | made with certificate | verified | memory of verify | forged files refused |")
    print("|---|---|--:|--:|--:|--:|--:|--:|", flush=True)
    flaws = []
    for name in options.kinds or KINDS:
        for model in KINDS[name].models:
            missing = [source for source in files_of(options, model) if not source.exists()]
            if missing:
                print(f"certify_gallery: {missing[0]} is missing", file=sys.stderr)
                continue
            row, wrong = judge(options, name, KINDS[name], model)
            if row:
                print("| " + " | ".join(row) + " |", flush=True)
            if wrong:
                flaws.append(wrong)
    for wrong in flaws:
        print("certify_gallery: " + wrong, file=sys.stderr)
    return 1 if flaws else 0


if __name__ == "__main__":
    sys.exit(main())
