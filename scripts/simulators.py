#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs simulators of Debian on what Terrane writes, and compares them with closed forms.

usage: simulators.py [--terrane build/release/cli/terrane]

CalculiX (calculix-ccx): layers of different stiffness under a load; a linear field of displacements with a jump across a split
fault, with tetrahedra of 4 and of 10 nodes. GetDP (getdp) and FEniCSx (python3-dolfinx, python3-gmsh): steady flow through
layers of different conductivity. Exodus' own library (libexodusii5): names, counts, sets. Gmsh: MSH of second order. The
input files are those of docs/examples/simulators. What is not installed is named, and the exit status is 1.
"""
import argparse
import ctypes
import importlib.util
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
EXAMPLES = ROOT / "docs" / "examples" / "simulators"
PRINTED = 2e-6  # the share of the largest number by which a print of seven digits may be off


def run(*words, folder):
    done = subprocess.run([str(w) for w in words], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"simulators: {words[0]} failed:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


def judge(what, found, wanted, tolerance):
    off = abs(found - wanted) / abs(wanted)
    print(f"{what}: {found:.10g}, closed form {wanted:.10g}, relative difference {off:.1e}")
    if not off <= tolerance:
        sys.exit(f"simulators: {what} is wrong")


def build(terrane, folder):
    """Makes the models of the examples, and both with tetrahedra of second order."""
    for file in EXAMPLES.iterdir():
        shutil.copy(file, folder)
    for name, formats in (("model", ["msh"]), ("split", ["inp", "exo"])):
        project = json.loads((folder / f"{name}.json").read_text())
        project["folder"] = f"{name}2"
        project["tetrahedra"]["order"] = 2
        project["outputs"]["tetrahedra"] = formats
        (folder / f"{name}2.json").write_text(json.dumps(project))
        for made in (name, f"{name}2"):
            run(terrane, "build", f"{made}.json", folder=folder)


# ---- Flow

LAYERS = ((300, 1e-6), (300, 1e-9), (400, 1e-5))  # thickness, conductivity, from below
DISCHARGE = 10 / sum(d / k for d, k in LAYERS) * 1e6  # head of 10 m, through 1 km2


def getdp(folder):
    run("getdp", "getdp.pro", "-msh", "model/tetrahedra_22.msh", "-solve", "Flow", "-pos", "Flow", folder=folder)
    last = {p.stem: float(p.read_text().split()[-1]) for p in folder.glob("*.txt")}
    judge("GetDP: discharge", last["discharge"], DISCHARGE, 1e-10)
    judge("GetDP: head in the middle layer", last["head"], 10 - DISCHARGE / 1e6 * (300 / 1e-6 + 150 / 1e-9), 1e-10)
    for layer, (thickness, _) in zip(("low", "middle", "high"), LAYERS):
        judge(f"GetDP: volume, {layer}", last[f"volume_{layer}"], thickness * 1e6, 1e-10)


def fenicsx(folder):
    said = run("/usr/bin/python3", "fenicsx.py", "model/tetrahedra.msh", folder=folder).splitlines()
    lines = [line.split(" ", 2) for line in said if line.startswith(("discharge", "volume"))]
    judge("FEniCSx: discharge", float(lines[0][1]), DISCHARGE, 1e-8)
    volumes = {}
    for _, volume, name in lines[1:]:
        layer = name.split(": ")[1].rsplit(", ", 1)[0]
        volumes[layer] = volumes.get(layer, 0) + float(volume)
    for layer, (thickness, _) in zip(("below base", "below top, above base", "above top"), LAYERS):
        judge(f"FEniCSx: volume {layer}", volumes[layer], thickness * 1e6, 1e-10)


# ---- CalculiX

def stiffness(young, poisson):
    """Of a layer that cannot move sideways."""
    return young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson))


def displacements(path):
    """All displacements in a .dat file: {node: (x, y, z)}."""
    found = {}
    for line in path.read_text().splitlines():
        words = line.split()
        if len(words) == 4 and words[0].isdigit():
            found[int(words[0])] = tuple(map(float, words[1:]))
    return found


def settlement(folder):
    run("ccx", "calculix", folder=folder)
    moved = displacements(folder / "calculix.dat")
    layers = ((300, stiffness(2e10, .25)), (300, stiffness(4e9, .3)), (400, stiffness(1e9, .35)))
    sums = sorted({u[2] for u in moved.values()})
    judge("CalculiX: settlement of the top", sums[0], -1e6 * sum(d / m for d, m in layers), PRINTED)
    judge("CalculiX: settlement of the base", sums[-1], -1e6 * layers[0][0] / layers[0][1], PRINTED)


def read_inp(path):
    """Nodes, elements by element set, and node sets in their order."""
    nodes, blocks, sets, rows = {}, {}, {}, []
    for line in path.read_text().splitlines():
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            words = dict(w.strip().partition("=")[::2] for w in line.split(",")[1:])
            rows = [] # of keywords that are passed over
            if line.startswith("*ELEMENT"):
                rows = blocks.setdefault(words["ELSET"], [])
            elif line.startswith("*NSET"):
                rows = sets.setdefault(words["NSET"], [])
            elif line.startswith("*NODE"):
                rows = nodes
            continue
        numbers = line.split(",")
        if rows is nodes:
            nodes[int(numbers[0])] = tuple(map(float, numbers[1:4]))
        else:
            rows.append(numbers)
    elements = {name: [list(map(int, row))[1:] for row in rows] for name, rows in blocks.items()}
    return nodes, elements, {name: [int(n) for row in rows for n in row] for name, rows in sets.items()}


def linear(place):
    """A displacement with six different strains, and rotations."""
    x, y, z = place
    return (1e-3 * x + 4e-4 * y - 2e-4 * z, -3e-4 * x + 2e-3 * y + 5e-4 * z, 1e-4 * x - 6e-4 * y - 1.5e-3 * z)


JUMP = (.25, -.5, .125)  # of the eastern side


def patch_test(folder, name):
    """The field on the border of the box, and the jump between the two sides of the fault, must give the field inside."""
    nodes, blocks, sets = read_inp(folder / name / "tetrahedra.inp")
    east = {v for block, rows in blocks.items() if "EAST" in block for row in rows for v in row}
    wanted = {v: [u + (JUMP[k] if v in east else 0) for k, u in enumerate(linear(p))] for v, p in nodes.items()}
    border = {v for s, members in sets.items() if s.startswith("BOUNDARY") for v in members}
    pairs = list(zip(sets["FAULT_PAIRS_FRONT"], sets["FAULT_PAIRS_BACK"]))
    moved = max(nodes) + 1  # a node that carries the jump
    deck = [f"*INCLUDE, INPUT={name}/tetrahedra.inp", "*NODE", f"{moved}, 0, 0, 0", "*MATERIAL, NAME=ROCK", "*ELASTIC",
            "2e10, 0.25", *(f"*SOLID SECTION, ELSET={block}, MATERIAL=ROCK" for block in blocks)]
    for front, back in pairs:
        if front in border:
            continue
        sign = 1 if front in east else -1
        for k in (1, 2, 3):
            deck += ["*EQUATION", "3", f"{front}, {k}, 1., {back}, {k}, -1., {moved}, {k}, {-sign}."]
    deck += ["*NSET, NSET=EVERY", *map(str, sorted(nodes)), "*STEP", "*STATIC", "*BOUNDARY"]
    fixed = {**{v: wanted[v] for v in border}, moved: JUMP}
    deck += [f"{v}, {k + 1}, {k + 1}, {u:.12g}" for v, field in sorted(fixed.items()) for k, u in enumerate(field)]
    deck += ["*NODE PRINT, NSET=EVERY", "U", "*END STEP", ""]
    (folder / f"{name}.inp").write_text("\n".join(deck))
    run("ccx", name, folder=folder)
    found = displacements(folder / f"{name}.dat")
    free = [v for v in nodes if v not in border]
    of_cut = sum(front not in border for front, _ in pairs)
    largest = max(abs(u) for v in nodes for u in wanted[v])
    off = max(abs(a - b) for v in free for a, b in zip(found[v], wanted[v]))
    print(f"CalculiX, patch test, {name}: {len(free)} free nodes, {of_cut} pairs of nodes apart by the jump; largest "
          f"displacement {largest:.4g}, largest error {off:.1e}")
    if not free or of_cut == 0 or off > PRINTED * largest:
        sys.exit("simulators: the patch test fails")


def calculix(folder):
    settlement(folder)
    for name in ("split", "split2"):
        patch_test(folder, name)


# ---- Libraries

EXODUS = "libexoIIv2c.so.5"  # as Debian 12 calls it; the numbers below are those of its header, exodusII.h, of version 6.02
EXODUS_VERSION = 602
EXODUS_KINDS = (("blocks", 1, 8), ("node sets", 2, 9), ("side sets", 3, 11))  # kind of part, question for their number


def exodus(folder):
    """What the library of Exodus says of the files: it returns names in full where it is asked to."""
    library = ctypes.CDLL(EXODUS)
    library.ex_inquire_int.restype = ctypes.c_int64
    for name, kind in (("split", b"TETRA"), ("split2", b"TETRA10")):
        numbers, stored, version = ctypes.c_int(8), ctypes.c_int(0), ctypes.c_float()
        file = library.ex_open_int(str(folder / name / "tetrahedra.exo").encode(), 0, ctypes.byref(numbers),
                                   ctypes.byref(stored), ctypes.byref(version), EXODUS_VERSION)
        if file < 0 or stored.value != 8:
            sys.exit(f"simulators: Exodus does not open the file of {name}, or not with doubles: {file}, {stored.value}")
        library.ex_set_max_name_length(file, 256)
        said = [exodus_names(library, file, *part) for part in EXODUS_KINDS]
        elements = exodus_elements(library, file, kind)
        library.ex_close(file)
        print(f"Exodus II, {name}: {elements} elements {kind.decode()}; " + "; ".join(said))


def exodus_names(library, file, what, kind, question):
    count = library.ex_inquire_int(file, question)
    texts = [ctypes.create_string_buffer(257) for _ in range(count)]
    pointers = (ctypes.c_char_p * count)(*(ctypes.cast(t, ctypes.c_char_p) for t in texts))
    if count <= 0 or library.ex_get_names(file, kind, pointers) != 0:
        sys.exit(f"simulators: Exodus finds no names of {what}")
    names = [t.value.decode() for t in texts]
    if len(set(names)) != count or not all(names):
        sys.exit(f"simulators: names of {what}: {names}")
    return f"{count} {what}, the longest name has {max(map(len, names))} characters"


def exodus_elements(library, file, wanted):
    numbers = (ctypes.c_int * library.ex_inquire_int(file, 8))()
    library.ex_get_ids(file, 1, numbers)
    elements = 0
    for number in numbers:
        kind, counts = ctypes.create_string_buffer(33), [ctypes.c_int() for _ in range(5)]
        found = library.ex_get_block(file, 1, ctypes.c_int64(number), kind, *map(ctypes.byref, counts))
        if found != 0 or kind.value != wanted or counts[0].value == 0:
            sys.exit(f"simulators: block {number} has {counts[0].value} elements {kind.value}")
        elements += counts[0].value
    return elements


def gmsh(folder):
    said = run("gmsh", "model2/tetrahedra.msh", "-check", "-v", "4", folder=folder)
    if "Error" in said or "Warning" in said or "Done checking" not in said:
        sys.exit(f"simulators: Gmsh says: {said}")
    print("Gmsh: reads tetrahedra of 10 nodes and finds nothing wrong")


def has_library(name):
    try:
        return bool(ctypes.CDLL(name))
    except OSError:
        return False


def has_module(name):
    return importlib.util.find_spec(name) is not None


CLIENTS = {
    "calculix-ccx": (calculix, lambda: shutil.which("ccx")),
    "getdp": (getdp, lambda: shutil.which("getdp")),
    "python3-dolfinx and python3-gmsh": (fenicsx, lambda: has_module("dolfinx") and has_module("gmsh")),
    "libexodusii5": (exodus, lambda: has_library(EXODUS)),
    "gmsh": (gmsh, lambda: shutil.which("gmsh")),
}


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--terrane", default=ROOT / "build/release/cli/terrane")
    terrane = pathlib.Path(arguments.parse_args().terrane).resolve()
    missing = []
    with tempfile.TemporaryDirectory() as folder:
        build(terrane, pathlib.Path(folder))
        for package, (client, is_there) in CLIENTS.items():
            if is_there():
                client(pathlib.Path(folder))
            else:
                missing.append(package)
    if missing:
        sys.exit("simulators: not installed, and so not run: " + "; ".join(missing))


main()
