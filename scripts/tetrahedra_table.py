#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Makes tetrahedra of real models by Terrane and by its peers, and prints a table of their shapes.

usage: tetrahedra_table.py [--terrane PROGRAM] [--remesh PROGRAM] [--data FOLDER] [--seconds S] [--page FILE] [MODEL...]

Each model's triangles are improved by Terrane, and then all meshers get the same ones: Terrane itself (`build` with
`tetrahedra.move_vertices` off), TetGen (Debian: tetgen), Gmsh's HXT (python3-gmsh), and CGAL's tetrahedral remeshing of what
Terrane's mesher made before its shapes are improved, with borders fixed (tests/bench, terrane_bench_remesh). More rows of Terrane
are with all defaults, so that vertices of surfaces move; with smaller triangles where tetrahedra were bad (tetrahedra.refine_bad);
and with a resolution. All figures are measured from the files, by NumPy; times are processor seconds of one thread: of Terrane's
whole run from the input files, of the others from the improved triangles.

A mesher has S processor seconds (default 300). What is not installed, and models whose data are not in FOLDER (default: ../shared/data
beside the repository), are left out with a word. --page puts the table between its two marks in a page. The
exit status is 1 if a mesh of Terrane is inverted, does not fill its box, or has divided a triangle.
"""
import argparse
import dataclasses
import importlib.util
import json
import lzma
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import tarfile
import tempfile

import numpy

import tetrahedra_measures as measures

ROOT = pathlib.Path(__file__).resolve().parents[1]
MODELS = ROOT / "tests" / "data"
BOX = json.loads((MODELS / "projects" / "modelA2.json").read_text())["volume_of_interest"]["box"]
BEGIN, END = "<!-- made by scripts/tetrahedra_table.py -->", "<!-- end of the table -->"


@dataclasses.dataclass
class Model:
    name: str
    files: tuple  # below tests/data, or below the folder of data
    edge_length: float
    in_box: bool
    rounds: int  # of tetrahedra.refine_bad, for a row of its own; 0: none
    goals: dict = dataclasses.field(default_factory=dict)  # of Terrane with surfaces fixed
    part: str = ""  # of an archive: files whose path contains it
    resolution: float = 0  # of improve, for a row of its own, with as many rounds; 0: none
    resolved: dict = dataclasses.field(default_factory=dict)  # goals of that row
    blocks: int = 0  # that it must have; 0: any


ROUNDS = 2
VALID = {"least": 1, "share": 1}
ALL_MODELS = (
    Model("A1", ("ringmesh/modelA1.ml",), 400, True, ROUNDS, {"share": .1, "greatest": 166}),
    Model("A2", ("ringmesh/modelA2.ml",), 400, True, ROUNDS, {"share": .3, "greatest": 166},
          resolution=60, resolved={"least": 8, "share": .1, "mean_ratio": .2}, blocks=10),
    Model("A4", ("ringmesh+RINGMesh/modelA4.ml.xz",), 400, True, ROUNDS, {"share": .4, "greatest": 172}),
    Model("faults + topography", ("arch-platform/faults.ts", "arch-platform/mnt.ts"), .02, False, 0, resolution=.006, resolved=VALID),
    Model("CFM CRFA", ("SCECcode+CFM_web/CFM7-native-dev.tar.xz",), 1500, False, 0, part="/native/CRFA-", resolution=150, resolved=VALID),
)


# ---- Programs

class Failed(Exception):
    pass


def run(words, folder, seconds):
    """Runs a program within a limit of processor time. Returns its processor seconds, with those of what it starts."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)

    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (int(seconds), int(seconds) + 5))

    done = subprocess.run([str(w) for w in words], cwd=folder, capture_output=True, text=True, errors="replace", check=False,
                          preexec_fn=limit)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if done.returncode == -signal.SIGXCPU or (used >= seconds - 1 and done.returncode != 0):
        raise Failed(f"no mesh in {seconds:g} s")
    if done.returncode != 0:
        said = (done.stderr or done.stdout).strip().splitlines()
        raise Failed(f"status {done.returncode}: {said[-1][:150] if said else 'no word'}")
    return used


def inputs_of(model, data, folder):
    """The files of a model, unpacked where they have to be; none if one is missing."""
    files = []
    for name in model.files:
        path = MODELS / name if (MODELS / name).exists() else data / name
        if not path.exists():
            return []
        if name.endswith(".tar.xz"):
            with tarfile.open(path) as archive:
                for member in archive.getmembers():
                    if model.part in member.name and member.isfile():
                        files.append(folder / pathlib.Path(member.name).name)
                        files[-1].write_bytes(archive.extractfile(member).read())
        elif name.endswith(".xz"):
            files.append(folder / path.stem)
            files[-1].write_bytes(lzma.decompress(path.read_bytes()))
        else:
            files.append(path)
    return sorted(files)


class Meshers:
    """All meshers on one model, in one folder."""

    def __init__(self, model, options, folder):
        self.model, self.options, self.folder = model, options, folder
        self.files = inputs_of(model, options.data, folder)

    def terrane(self, name, improve, tetrahedra):
        """Builds a model. Returns its triangles, its tetrahedra and the seconds."""
        project = {"format": "terrane-project 1", "folder": name, "surfaces": [{"file": str(f)} for f in self.files],
                   "improve": {"edge_length": self.model.edge_length, **improve}, "tetrahedra": tetrahedra,
                   "outputs": {"surfaces": ["obj"], "tetrahedra": ["mesh"]}}
        if self.model.in_box:
            project["volume_of_interest"] = {"box": BOX}
        (self.folder / f"{name}.json").write_text(json.dumps(project))
        used = run([self.options.terrane, "build", f"{name}.json", "--threads", "1"], self.folder, self.options.seconds)
        return (measures.read_obj(self.folder / name / "surfaces.obj"),
                measures.read_medit(self.folder / name / "tetrahedra.mesh"), used)

    def start(self):
        """The run with surfaces fixed. The others get its triangles, and the box around them if it is none of them."""
        self.surfaces, mesh, used = self.terrane("fixed", {}, {"move_vertices": False})
        low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
        self.volume = float((high - low).prod())
        points, triangles, _ = self.surfaces
        self.sides = sides_of(mesh, measures.nodes_at(mesh, points)[triangles])
        self.points, self.facets, self.triangles = points, [list(map(int, t)) for t in triangles], triangles
        if not self.model.in_box:
            self.add_box(low, high, int(mesh.blocks.min()))
        return self.surfaces, mesh, used

    def add_box(self, low, high, outside):
        first = len(self.points)
        ends = (low, high)
        corners = [[ends[i & 1][0], ends[i >> 1 & 1][1], ends[i >> 2][2]] for i in range(8)]
        self.points = numpy.vstack([self.points, corners])
        for a, b, c, d in ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)):
            self.facets += [[first + a, first + b, first + c], [first + a, first + c, first + d]]
        self.sides = numpy.vstack([self.sides, [[outside, -1]] * 12])

    def tetgen(self, switches):
        if not shutil.which("tetgen"):
            return None
        rows = [f"{len(self.points)} 3 0 0"]
        rows += [f"{i} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(self.points.tolist())]
        rows.append(f"{len(self.facets)} 0")
        rows += [line for facet in self.facets for line in ("1", f"3 {facet[0]} {facet[1]} {facet[2]}")]
        (self.folder / "peers.poly").write_text("\n".join([*rows, "0", "0", ""]))
        used = run(["tetgen", switches, "peers.poly"], self.folder, self.options.seconds)
        return self.surfaces, measures.read_tetgen(self.folder / "peers.1"), used

    def gmsh(self):
        if importlib.util.find_spec("gmsh") is None:
            return None
        numpy.savez(self.folder / "gmsh.npz", points=self.points, facets=self.facets, sides=self.sides)
        used = run([sys.executable, __file__, "--gmsh", self.folder], self.folder, self.options.seconds)
        made = numpy.load(self.folder / "made.npz")
        return self.surfaces, measures.Tetrahedra(made["points"], made["corners"], made["blocks"]), used

    def cgal(self):
        if not self.options.remesh.exists():
            return None
        surfaces, mesh, _ = self.terrane("unimproved", {}, {"optimise": False})
        measures.write_medit(mesh, self.folder / "unimproved.mesh")
        used = run([self.options.remesh, "unimproved.mesh", "cgal.mesh", self.model.edge_length], self.folder,
                   self.options.seconds)
        return surfaces, measures.read_medit(self.folder / "cgal.mesh"), used


def sides_of(mesh, triangles):
    """The blocks on both sides of each triangle; -1 where there is none."""
    blocks = {}
    for columns in measures.FACES:
        for face, block in zip(numpy.sort(mesh.corners[:, list(columns)], axis=1).tolist(), mesh.blocks.tolist()):
            blocks.setdefault(tuple(face), []).append(block)
    found = [sorted(blocks.get(tuple(face), []))[:2] for face in numpy.sort(triangles, axis=1).tolist()]
    return numpy.array([(list(reversed(f)) + [-1, -1])[:2] for f in found])


def run_gmsh(folder):
    """A process of its own: one volume per block, bounded by the triangles between it and others."""
    import gmsh
    given = numpy.load(folder / "gmsh.npz")
    points, facets, sides = given["points"], given["facets"], given["sides"]
    gmsh.initialize()
    dangling = sides[:, 0] == sides[:, 1]
    for key, value in {"General.Terminal": 0, "General.NumThreads": 1, "Mesh.RandomSeed": 1,
                       "Mesh.AngleToleranceFacetOverlap": 1e-30, "Mesh.Algorithm3D": 1 if dangling.any() else 10,
                       "Mesh.MeshSizeFromPoints": 0, "Mesh.Optimize": 1}.items():
        gmsh.option.setNumber(key, value)
    gmsh.model.add("peers")
    pairs = sorted(set(map(tuple, sides.tolist())))
    for number, _ in enumerate(pairs, 1):
        gmsh.model.addDiscreteEntity(2, number)
    gmsh.model.mesh.addNodes(2, 1, range(1, len(points) + 1), points.ravel())
    around, within = {}, {}
    for number, pair in enumerate(pairs, 1):
        gmsh.model.mesh.addElementsByType(number, 2, [], (facets[(sides == pair).all(axis=1)] + 1).ravel())
        if pair[0] == pair[1]:
            within.setdefault(pair[0], []).append(number)
        else:
            for block in pair:
                around.setdefault(block, []).append(number)
    around.pop(-1, None)
    for volume, block in enumerate(sorted(around), 1):
        gmsh.model.geo.addSurfaceLoop(around[block], volume)
        gmsh.model.geo.addVolume([volume], volume)
    gmsh.model.geo.synchronize()
    for volume, block in enumerate(sorted(around), 1):
        if block in within:
            gmsh.model.mesh.embed(2, within[block], 3, volume)
    gmsh.model.mesh.generate(3)
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    index = numpy.zeros(int(tags.max()) + 1, int)
    index[tags.astype(int)] = numpy.arange(len(tags))
    corners, blocks = [], []
    for _, volume in gmsh.model.getEntities(3):
        _, nodes = gmsh.model.mesh.getElementsByType(4, volume)
        corners.append(index[nodes.astype(int)].reshape(-1, 4).astype(int)) # an empty list is one of floats
        blocks += [volume] * len(corners[-1])
    if not blocks:
        sys.exit("Gmsh made no tetrahedra")
    numpy.savez(folder / "made.npz", points=coordinates.reshape(-1, 3), corners=numpy.vstack(corners), blocks=blocks)


# ---- Rows

HEAD = ("| model | mesher | tetrahedra | least angle | below 10° | apart from sharp input | greatest angle | least mean ratio | triangles | s |",
        "|---|---|---|---|---|---|---|---|---|---|")


def told(mesh, figures, surfaces, used):
    points, triangles, groups = surfaces
    apart, least, _ = measures.bad_apart(mesh, points, triangles, groups)
    kept = "kept" if figures["divided"] == 0 else f"{figures['divided']} split"
    least = "" if least is None else f", down to {least:.2g}°"
    return (f"{figures['tetrahedra']} | {figures['least']:.2g} | {figures['bad']}, {figures['share']:.2g} % | {apart}{least} | "
            f"{figures['greatest']:.1f} | {figures['mean_ratio']:.2g} | {kept} | {used:.1f}")


def row(model, mesher, make, volume=None):
    """Prints a row. Returns its figures; none if there is no mesh."""
    try:
        made = make()
        if made is not None and len(made[1].corners) == 0:
            raise Failed("a file without tetrahedra")
    except Failed as failure:
        print(f"| {model} | {mesher} | none: {failure} | | | | | | | |", flush=True)
        return None
    if made is None:
        print(f"{mesher} is not installed: left out", file=sys.stderr)
        return None
    surfaces, mesh, used = made
    if volume is None:
        volume = float((mesh.points.max(axis=0) - mesh.points.min(axis=0)).prod())
    figures = measures.judge(mesh, surfaces[0], surfaces[1], volume)
    figures["seconds"] = used
    figures["blocks"] = len(numpy.unique(mesh.blocks))
    line = f"| {model} | {mesher} | {told(mesh, figures, surfaces, used)} |"
    if figures["inverted"] or figures["unfilled"] > 1e-9:
        line += f" {figures['inverted']} inverted, {figures['unfilled']:.1g} of the volume wrong"
    print(line, flush=True)
    return figures


def forced(meshers, wedge):
    """What the triangles force, in a sentence."""
    points, triangles, _ = meshers.surfaces
    sharp = measures.wedges_below(points, triangles, measures.BAD)
    said = f"{meshers.model.name}: {len(sharp)} wedges between triangles are sharper than {measures.BAD}°"
    if wedge is not None:
        place = ", ".join(f"{x:.0f}" for x in points[list(wedge.corners[:2])].mean(axis=0))
        said += (f". At ({place}) two triangles meet at {wedge.angle:.1f}°: their tetrahedron has {wedge.least:.1f}° to "
                 f"{wedge.greatest:.1f}°, and a mesh without it has an angle of at most {wedge.angle / 2:.1f}°")
    return said + "."


def rows_of(model, options, notes):
    """Prints all rows of a model. Returns whether Terrane's meshes are sound."""
    with tempfile.TemporaryDirectory() as name:
        meshers = Meshers(model, options, pathlib.Path(name))
        if not meshers.files:
            print(f"{model.name}: the data are not there", file=sys.stderr)
            return True
        own = [row(model.name, "Terrane, surfaces fixed", meshers.start)]
        if own[0] is None:
            return False
        own.append(row(model.name, "Terrane", lambda: meshers.terrane("default", {}, {})))
        refined = {"refine_bad": model.rounds} if model.rounds else {}
        said = f", refine_bad {model.rounds}" if model.rounds else ""
        if refined:
            own.append(row(model.name, f"Terrane{said}", lambda: meshers.terrane("refined", {}, refined)))
        if model.resolution:
            own.append(row(model.name, f"Terrane, resolution {model.resolution:g}{said}",
                           lambda: meshers.terrane("resolved", {"resolution": model.resolution}, refined)))
        peers = {"TetGen -pAYq1.4O9/7": lambda: meshers.tetgen("-pAYq1.4O9/7"),
                 "TetGen -pAYq1.2/18O9/7": lambda: meshers.tetgen("-pAYq1.2/18O9/7"), "Gmsh": meshers.gmsh,
                 "CGAL remeshing": meshers.cgal}
        found = {peer: row(model.name, peer, make, meshers.volume) for peer, make in peers.items()}
        wedge = measures.least_forced(*meshers.surfaces[:2], measures.BAD)
        notes.append(forced(meshers, wedge))
        notes.extend(missed(model, own[0], found["Gmsh"], wedge))
        if model.resolution:
            notes.extend(missed_at_resolution(model, own[-1]))
        return all(f and not f["inverted"] and f["unfilled"] < 1e-9 and not f["divided"] for f in own)


def missed(model, own, gmsh, wedge):
    """What of the goals the row of Terrane with surfaces fixed misses."""
    found = []
    for key, goal in model.goals.items():
        if own[key] <= goal:
            continue
        found.append(f"{model.name}: {key} is {own[key]:.2f}, the goal {goal:g}.")
        if key == "greatest" and wedge is not None and own[key] <= wedge.greatest + 1e-6:
            found[-1] += " It is that of the tetrahedron of both triangles named above."
    if model.goals and gmsh and own["tetrahedra"] > 2 * gmsh["tetrahedra"]:
        found.append(f"{model.name}: more than twice the tetrahedra of Gmsh.")
    if model.goals and own["seconds"] > 10:
        found.append(f"{model.name}: {own['seconds']:.1f} s, the goal is 10.")
    return found


def missed_at_resolution(model, own):
    """What of the goals the row of a resolution misses."""
    if own is None:
        return [f"{model.name}: no mesh at the resolution {model.resolution:g}."]
    found = [f"{model.name} at the resolution {model.resolution:g}: {key} is {own[key]:.2f}, the goal {goal:g}."
             for key, goal in model.resolved.items() if (own[key] > goal if key == "share" else own[key] < goal)]
    if model.blocks and own["blocks"] != model.blocks:
        found.append(f"{model.name} at the resolution {model.resolution:g}: {own['blocks']} blocks, not {model.blocks}.")
    return found


class Page:
    """Standard output, and a copy."""

    def __init__(self):
        self.lines, self.out = [], sys.stdout

    def write(self, text):
        self.lines.append(text)
        self.out.write(text)

    def flush(self):
        self.out.flush()


def put_into(page, text):
    whole = page.read_text()
    first, last = whole.index(BEGIN) + len(BEGIN), whole.index(END)
    page.write_text(f"{whole[:first]}\n\n{text.strip()}\n\n{whole[last:]}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--terrane", default=ROOT / "build/release/cli/terrane", type=pathlib.Path)
    parser.add_argument("--remesh", default=ROOT / "build/bench/tests/bench/terrane_bench_remesh", type=pathlib.Path)
    parser.add_argument("--data", default=ROOT.parent / "shared/data", type=pathlib.Path)
    parser.add_argument("--seconds", default=300, type=float)
    parser.add_argument("--page", type=pathlib.Path)
    parser.add_argument("--gmsh", type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("models", nargs="*")
    options = parser.parse_args()
    if options.gmsh:
        return run_gmsh(options.gmsh)
    options.terrane, options.remesh = options.terrane.resolve(), options.remesh.resolve()
    known = {model.name: model for model in ALL_MODELS}
    if any(name not in known for name in options.models):
        sys.exit(f"the models are {', '.join(known)}")
    sys.stdout = page = Page()
    print("\n".join(HEAD))
    notes = []
    sound = [rows_of(model, options, notes) for model in ALL_MODELS if not options.models or model.name in options.models]
    print("\n" + "\n".join(f"- {note}" for note in notes))
    if options.page:
        put_into(options.page, "".join(page.lines))
    return 0 if all(sound) else 1


if __name__ == "__main__":
    sys.exit(main())
