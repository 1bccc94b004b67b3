#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Makes docs/gallery: real models from end to end, with commands, numbers and pictures.

    xvfb-run -a scripts/gallery.py [--terrane PROGRAM] [--data FOLDER] [--folder out/gallery] [NAME...]

Runs the commands of each model in a folder of its own below out/gallery, takes the numbers from what they print, draws
the last mesh where the licence of the data allows a picture, and writes docs/gallery/index.md. FOLDER has the collection
of data (default: ../shared/data beside the repository); models that are not in this repository are left as they are on
the page if it is missing. NAME chooses among the models; the page is written only if all were made. Needs
python3-vtk9, python3-numpy and, without a display, xvfb.
"""
import argparse
import lzma
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tarfile
import textwrap
from dataclasses import dataclass

import numpy as np
import vtk

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import picture  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[1]
SIZE = (1100, 620)


@dataclass
class Model:
    """A model of the gallery. Files are relative to the repository ("tests/...") or to the collection of data. In
    commands, $IN stands for all of them. `shows` is what the picture has: "blocks" moved apart of a VTU file, or the
    "surfaces" of a VTP file; empty where no licence allows one."""
    name: str
    files: list
    source: str
    hard: str
    commands: list
    shows: str = ""
    heights: float = 1.0
    view: tuple = (0.35, -1.0, 0.5)


RINGMESH = "RINGMesh, courtesy of the Gocad consortium (BSD-3-Clause)"
SCEC_BOX = "--box=-40000,3310000,-45000,890000,4140000,-6000"
MODELS = [
    Model("modelA1", ["tests/data/ringmesh/modelA1.ml"], RINGMESH,
          "Three horizons in a box, given as 21 parts that share borders.",
          ["terrane volume $IN -o blocks",
           "terrane improve $IN -o better.vtp --edge-length 300",
           "terrane tetrahedralize better.vtp -o model.vtu --blocks-only --quality 1.4"], "blocks"),
    Model("modelA2", ["tests/data/ringmesh/modelA2.ml"], RINGMESH,
          "Three horizons and two faults with offsets; layers of 16 m between triangles of 400 m.",
          ["terrane volume $IN -o blocks",
           "terrane improve $IN -o better.vtp --edge-length 400 --box=-3000,-2500,-2500,9000,4500,1200",
           "terrane tetrahedralize better.vtp -o model.vtu --blocks-only --mesher gmsh"], "blocks"),
    Model("modelA4", ["ringmesh+RINGMesh/modelA4.ml.xz"], RINGMESH,
          "55 parts; four layers on each side of a fault; 48 903 triangles.",
          ["terrane volume $IN -o blocks",
           "terrane improve $IN -o better.vtp --edge-length 400",
           "terrane tetrahedralize better.vtp -o model.vtu --blocks-only --quality 1.4"], "blocks"),
    Model("faults and a topography", ["tests/data/arch-platform/faults.ts", "tests/data/arch-platform/mnt.ts"],
          "arch-platform (MIT)",
          "32 faults that cross each other and the topography in 3 382 pairs of triangles; coordinates in degrees and kilometres.",
          ["terrane arrange $IN -o model.vtp"], "surfaces", 1.6, (-0.28, -1.0, 0.42)),
    Model("joints at Nash Point",
          ["xaliphostes+arch-platform/public/models/NashPoint/all_joints_3D.ts"], "arch-platform (MIT)",
          "268 upright panels that end on each other, or nearly.",
          ["terrane arrange $IN -o model.vtp"], "surfaces", 1.0, (0.35, -0.8, 0.9)),
    Model("cut solids", ["tests/data/manifold/Havocglass8_left.obj", "tests/data/manifold/Havocglass8_right.obj"],
          "manifold (Apache-2.0)", "Two solids that a cut made: they lie in each other's faces.",
          ["terrane volume $IN -o blocks", "terrane arrange $IN -o model.vtp"], "surfaces"),
    Model("Drogon", ["equinor+xtgeo-testdata/surfaces/drogon/1/02_toptherys.gri",
                     "equinor+xtgeo-testdata/surfaces/drogon/1/03_topvolon.gri"],
          "Equinor, xtgeo-testdata (LGPL-3.0; not in this repository)",
          "Two horizons of 95 352 triangles each, to be kept five metres apart.",
          ["terrane layer $IN --layer 02_toptherys=1 --layer 03_topvolon=2 --min-thickness 5 -o model.vtp"]),
    Model("tindel", ["xaliphostes+xali-pytools/data/models/tindel.ts"],
          "xali-pytools (no licence is stated; not in this repository)", "Eleven faults that branch: 49 edges with more than two "
          "triangles.", ["terrane arrange $IN -o model.vtp", "terrane improve $IN -o better.vtp --edge-length 40"]),
    Model("community fault model of southern California", ["SCECcode+CFM_web/CFM7-native-dev.tar.xz"],
          "SCEC, CFM 7.0 (not in this repository)",
          "279 faults over 1 150 km with edges from .06 m; they cross themselves and each other in 12 930 pairs.",
          ["terrane arrange $IN -o model.vtp"]),
    Model("blocks of southern California", ["SCECcode+GFM_web/GFM2020-inputs-dev.tar.xz"],
          "SCEC, GFM 2020 (no licence is stated; not in this repository)",
          "20 boundaries of blocks and the Moho, each cut at the others by hand, with gaps of up to 10 m in "
          "900 km, and 48 000 triangles that occur twice.",
          [f"terrane volume $IN -o blocks {SCEC_BOX} --seal auto --min-volume auto",
           f"terrane improve $IN -o better.vtp {SCEC_BOX} --seal auto --min-volume auto --edge-length 6000",
           "terrane tetrahedralize better.vtp -o model.vtu --blocks-only"]),
]
# Files of an archive that belong to the model, as a shell names them.
PARTS = {"community fault model of southern California": ("preferred/native/*.ts",),
         "blocks of southern California": ("fault_boundaries/*.ts", "moho_extended_crop.ts")}
TOLD = re.compile(
    r"^\d+ surfaces?: .*|^\d+ closed blocks.*|^\d+ tetrahedra, .*|^dihedral angles.*|^\d+ of \d+ tetrahedra have.*|"
    r"^ *chosen distance: .*|^sealed by .*|^blocks below .*|^verified: .*|^quality .*|^  (before|after) .*|"
    r"^volumes: .*|^\d+ holes?.*|^doubles: no vertex.*|^made by .*|^\d+ layers?.*|^stack.*")


def inputs_of(model, data, folder):
    """Returns the input files, unpacked where they have to be; none if one is missing."""
    files = []
    for name in model.files:
        path = ROOT / name if name.startswith("tests/") else data / name
        if not path.exists():
            return []
        if name.endswith(".tar.xz"):
            with tarfile.open(path) as archive:
                archive.extractall(folder / "in")
            for pattern in PARTS[model.name]:
                files += sorted((folder / "in").glob(pattern))
        elif name.endswith(".xz"):
            files.append(folder / path.stem)
            files[-1].write_bytes(lzma.decompress(path.read_bytes()))
        else:
            files.append(path)
    return files


def as_typed(model):
    """The commands that unpack the files, and the names of the input files in a shell."""
    commands, names = "", []
    for name in (pathlib.Path(f).name for f in model.files):
        if name.endswith(".tar.xz"):
            commands += f"$ tar -xf {name}\n"
            names += PARTS[model.name]
        else:
            commands += f"$ xz -dk {name}\n" if name.endswith(".xz") else ""
            names.append(name.removesuffix(".xz"))
    return commands, " ".join(names)


def run(model, program, files, folder):
    """Runs the commands; returns what the page shows of them."""
    text, names = as_typed(model)
    for command in model.commands:
        words = command.split()
        at = words.index("$IN") if "$IN" in words else None
        called = [program, *words[1:]] if at is None else [program, *words[1:at], *files, *words[at + 1:]]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(called, cwd=folder, capture_output=True, text=True, check=False)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode != 0:
            sys.exit(f"gallery: {model.name}: {command}: status {done.returncode}\n{done.stderr}")
        used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        told = [line for line in done.stdout.splitlines() if TOLD.match(line)]
        text += f"$ {command.replace('$IN', names)}\n" + "".join(line + "\n" for line in told)
        text += f"({used:.1f} seconds of one processor)\n"
    return text


def draw(model, folder, target):
    """Draws the blocks or surfaces of a model."""
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*SIZE)
    renderer = picture.panel(window, 0.0, 1.0)
    if model.shows == "blocks":
        points, tetrahedra, block_of = picture.tetrahedra_of(str(folder / "model.vtu"))
        points = (points - points.mean(axis=0)) / np.ptp(points, axis=0).max() * (1, 1, model.heights)
        for r in range(1, block_of.max() + 1):
            block = tetrahedra[block_of == r]
            away = points[np.unique(block)].mean(axis=0) * (0.35, 0.2, 0.7)
            renderer.AddActor(picture.actor(picture.poly_data(points + away, picture.border_faces(block), 3),
                                            picture.MUTED[(5 * r) % len(picture.MUTED)], edges=0.8))
    else:
        points, triangles, surface = picture.surfaces_of(str(folder / "model.vtp"))
        points = (points - points.mean(axis=0)) / np.ptp(points, axis=0).max() * (1, 1, model.heights)
        for s in np.unique(surface):
            data = picture.poly_data(points, triangles[surface == s], 3)
            few = len(triangles) < 40000
            renderer.AddActor(picture.actor(data, picture.MUTED[(5 * s + 2) % len(picture.MUTED)],
                                            edges=0.8 if few else 0.0))
        curves = picture.crossing_edges(triangles)
        if len(curves):
            renderer.AddActor(picture.line_actor(points, curves, 2.0))
    picture.look(renderer, model.view, 1.3)
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    picture.write_png(image, str(target))


HEAD = """# Gallery

Real models, from the files as they came to the result. `scripts/gallery.py` ran these commands, copied the lines that
say how it went, and drew the pictures. Where the licence of the data allows no copy there is no picture.

"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--terrane", default=ROOT / "build/release/cli/terrane", type=pathlib.Path)
    parser.add_argument("--data", default=ROOT.parent / "shared/data", type=pathlib.Path)
    parser.add_argument("--folder", default=ROOT / "out/gallery", type=pathlib.Path)
    parser.add_argument("names", nargs="*")
    options = parser.parse_args()
    page, complete = HEAD, not options.names
    for model in MODELS:
        if options.names and model.name not in options.names:
            continue
        slug = model.name.replace(" ", "-")
        folder = options.folder / slug
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        files = inputs_of(model, options.data, folder)
        if not files:
            print(f"gallery: {model.name} is left out: its data are not there")
            complete = False
            continue
        told = run(model, options.terrane.resolve(), files, folder)
        about = textwrap.fill(f"{model.source}. {model.hard}", 120)
        page += f"## {model.name[0].upper()}{model.name[1:]}\n\n{about}\n\n"
        if model.shows:
            draw(model, folder, ROOT / f"docs/gallery/{slug}.png")
            page += f"![{model.name}]({slug}.png)\n\n"
        page += f"<!-- not run: scripts/gallery.py did -->\n```console\n{told}```\n\n"
        print(f"gallery: {model.name}", flush=True)
    if complete:
        (ROOT / "docs/gallery/index.md").write_text(page.rstrip() + "\n")
        print("gallery: wrote docs/gallery/index.md")


if __name__ == "__main__":
    main()
