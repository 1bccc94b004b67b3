# SPDX-License-Identifier: LGPL-3.0-or-later
"""Whether the names and numbers in docs/examples/simulators are those of the files that the models there give."""
import os
import pathlib
import re
import shutil
import subprocess
import xml.etree.ElementTree

from simulator_model import check
from simulator_readers import Exodus, Grid, Msh, comment_list, multi_block

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "docs" / "examples" / "simulators"


def contained(what, names, known):
    names = set(names)
    check(names, f"{what} names nothing")
    check(names <= set(known), f"{what} names {sorted(names - set(known))}; there are {sorted(known)}")


def opengeosys(folder):
    project = xml.etree.ElementTree.parse(EXAMPLES / "opengeosys.prj").getroot()
    meshes = [mesh.text for mesh in project.find("meshes")]
    contained("opengeosys.prj", meshes, os.listdir(folder / "model"))
    contained("opengeosys.prj", [m.text + ".vtu" for m in project.iter("mesh") if not m.text.endswith(".vtu")], meshes)
    media = [int(i) for medium in project.iter("medium") for i in medium.get("id").split(",")]
    materials = comment_list(str(folder / "model" / meshes[0]))["MaterialIDs"]
    check(sorted(media) == sorted(materials), f"opengeosys.prj has media {media} for {materials}")
    check(set(Grid(str(folder / "model" / meshes[0])).cell_data("MaterialIDs")) == set(media), "opengeosys.prj: MaterialIDs")


def words(text):
    return text.strip("{} ").replace(",", " ").split()


def geos(folder):
    root = xml.etree.ElementTree.parse(EXAMPLES / "geos.xml").getroot()
    mesh = root.find("Mesh/VTKMesh")
    blocks = multi_block(str(folder / mesh.get("file")))
    contained("geos.xml", [mesh.get("mainBlockName"), *words(mesh.get("faceBlocks"))], blocks)
    main = blocks[mesh.get("mainBlockName")]
    for name in words(mesh.get("nodesetNames")):
        check(main.point_data(name).max() == 1, f"geos.xml: nobody is in the set {name}")
    regions = main.cell_data(mesh.get("regionAttribute"))[:len(main.cells[4])]
    cells = [b for region in root.iter("CellElementRegion") for b in words(region.get("cellBlocks"))]
    check(sorted(cells) == sorted(f"{r}_tetrahedra" for r in set(regions.tolist())), f"geos.xml: cell blocks {cells}")


def pflotran(folder):
    text = (EXAMPLES / "pflotran.in").read_text()
    files = re.findall(r"(?:FILE|UNSTRUCTURED) (\S+\.\w+)", text)
    check(len(files) == 9 and all((folder / file).is_file() for file in files), f"pflotran.in: files {files}")
    contained("pflotran.in", re.findall(r"^  REGION (\S+)", text, re.M), re.findall(r"^REGION (\S+)", text, re.M))


def pylith(folder):
    text = (EXAMPLES / "pylith.cfg").read_text()
    groups = Msh(str(folder / "model" / "tetrahedra_pylith.msh")).groups
    labels = re.findall(r"^label = (\S+)\nlabel_value = (\d+)", text, re.M)
    for label, value in labels:
        check(groups.get(label) == (int(value), 2), f"pylith.cfg: {label} is {groups.get(label)}, not {value}")
    check(len(labels) == 6, f"pylith.cfg: labels {labels}")
    materials = re.findall(r"^\w+\.label_value = (\d+)", text, re.M)
    check({f"material-id:{m}" for m in materials} == {g for g, (_, d) in groups.items() if d == 3}, "pylith.cfg: materials")


def moose(folder):
    text = (EXAMPLES / "moose.i").read_text()
    exodus = Exodus(str(folder / "model" / "tetrahedra.exo"))
    blocks = [name for line in re.findall(r"block = '(.*)'", text) for name in line.split()]
    check(sorted(blocks) == sorted(exodus.blocks), f"moose.i: blocks {blocks}")
    contained("moose.i", re.findall(r"boundary = (\S+)", text), exodus.side_sets)


def getdp(folder):
    text = (EXAMPLES / "getdp.pro").read_text()
    groups = Msh(str(folder / "model" / "tetrahedra_22.msh")).groups
    name_of = {number: name for name, (number, _) in groups.items()}
    check(len(name_of) == len(groups) == 15, f"MSH 2.2: numbers of groups are not unique: {groups}")
    check(groups == Msh(str(folder / "model" / "tetrahedra.msh")).groups, "MSH 4.1 has other groups than MSH 2.2")
    for number, comment in re.findall(r"= Region\[(\d+)\]; +// (.*)", text):
        check(name_of.get(int(number)) == comment, f"getdp.pro: {number} is {name_of.get(int(number))}, not {comment}")
    blocks = [int(n) for line in re.findall(r"Region\[\{([\d, ]+)\}\]", text) for n in line.split(",")]
    check(sorted(blocks) == sorted(n for n, d in groups.values() if d == 3), f"getdp.pro: blocks {blocks}")


def calculix(folder):
    text = (EXAMPLES / "calculix.inp").read_text()
    mesh = (folder / re.search("INPUT=(.*)", text).group(1)).read_text()
    contained("calculix.inp", re.findall("ELSET=([^,\n]+)", text), re.findall("ELSET=([^,\n]+)", mesh))
    contained("calculix.inp", re.findall(r"^(BOUNDARY_\w+), \d", text, re.M) + re.findall("NSET=(.*)", text),
              re.findall("NSET=([^,\n]+)", mesh))
    contained("calculix.inp", re.findall(r"^(\w+), P,", text, re.M), re.findall("TYPE=ELEMENT, NAME=(.*)", mesh))


def check_examples(program, folder):
    folder = pathlib.Path(folder) / "examples"
    shutil.copytree(EXAMPLES, folder)
    for project in ("model.json", "split.json"):
        made = subprocess.run([program, "build", project], cwd=folder, capture_output=True, text=True, check=False)
        check(made.returncode == 0, f"terrane build {project}: {made.stdout[-500:]}{made.stderr}")
    for example in (opengeosys, geos, pflotran, pylith, moose, getdp, calculix):
        example(folder)
