# SPDX-License-Identifier: LGPL-3.0-or-later
"""Random surfaces, and commands that make a certificate of each kind about them."""
import json
from dataclasses import dataclass, field


def sheet(rng, n, at, bumps):
    """A grid of n x n squares; at(u, v) is a point."""
    points = []
    for i in range(n + 1):
        for j in range(n + 1):
            x, y, z = at(i / n, j / n)
            points.append((x, y, z + rng.uniform(-bumps, bumps)))
    triangles = []
    for i in range(n):
        for j in range(n):
            a, b, c, d = i * (n + 1) + j, (i + 1) * (n + 1) + j, (i + 1) * (n + 1) + j + 1, i * (n + 1) + j + 1
            triangles += [(a, b, c), (a, c, d)] if rng.random() < 0.5 else [(a, b, d), (b, c, d)]
    return points, triangles


def cube(x, y, z, size):
    points = [(x + i * size, y + j * size, z + k * size) for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return points, [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))]


def write(file, surface):
    points, triangles = surface
    file.write_text("".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in points) +
                    "".join("f {} {} {}\n".format(*(v + 1 for v in t)) for t in triangles))


def write_models(rng, folder):
    def horizon(z, slope):
        return lambda u, v: (10 * u, 10 * v, z + slope * u)
    a, b = rng.uniform(-1, 1), rng.uniform(0.5, 2)
    write(folder / "top.obj", sheet(rng, 4, horizon(5, a), 0.2))
    write(folder / "base.obj", sheet(rng, 4, horizon(1, -a), 0.2))
    write(folder / "fault.obj", sheet(rng, 3, lambda u, v: (4 + b * v, -1 + 12 * u, -1 + 7 * v), 0.1))
    write(folder / "cross.obj", sheet(rng, 4, horizon(3, 4), 0.1))
    write(folder / "floor.obj", sheet(rng, 3, horizon(1, 0), 0.02))
    write(folder / "roof.obj", sheet(rng, 3, horizon(4, 0), 0.02))
    write(folder / "wall.obj", sheet(rng, 3, lambda u, v: (4 + b * v, 1 + 8 * u, 1.3 + 2.4 * v), 0))
    write(folder / "outer.obj", cube(0, 0, 0, 8.0 + b))
    write(folder / "inner.obj", cube(1 + b, 2, 1, 2.0))
    points, triangles = sheet(rng, 8, horizon(0, a), 0.1)
    gone = {(2, 2), (2, 3), (3, 2), (3, 3), (5, 5)}
    left = [t for t in triangles if (min(v // 9 for v in t), min(v % 9 for v in t)) not in gone]
    write(folder / "holes.obj", (points, left))
    (folder / "project.json").write_text(json.dumps(PROJECT))


@dataclass
class Subject:
    """A command that makes a certificate."""
    command: list
    certificate: str
    inputs: list = field(default_factory=list)  # that `verify` is given: those outside of the certificate's folder


def outputs(*formats):
    return [word for name in formats for word in ("-o", f"out.{name}")]


SURFACES = outputs("obj", "off", "ply", "stl", "ts", "vtp", "msh", "inp")
GRIDS = outputs("vtu", "msh", "inp")
OLDER = [*outputs("stl", "msh"), "--ascii", "--msh", "2.2"]
BOX = ["--box", "1,1,0,9,9,6"]
BUILT = ["outer.obj", "inner.obj", "cross.obj"]
KINDS = ("arrangement", "volumes", "tetrahedra", "improved", "filled", "layered", "cut", "sealed")

COMMANDS = {
    "arrangement": ["arrange", "top.obj", "base.obj", "fault.obj", "cross.obj", *SURFACES],
    "arrangement, older": ["arrange", "outer.obj", "inner.obj", "cross.obj", *OLDER],
    "volumes": ["volume", *BUILT, "-o", "out"],
    "volumes, obj": ["volume", *BUILT, "-o", "parts", "--parts", "obj"],
    "volumes, cut": ["volume", "top.obj", "cross.obj", "-o", "cut", *BOX],
    "tetrahedra": ["tetrahedralize", "outer.obj", "inner.obj", "top.obj", *GRIDS],
    "tetrahedra, split": ["tetrahedralize", "outer.obj", "top.obj", "--split", "top", *GRIDS],
    "tetrahedra, cut": ["tetrahedralize", "top.obj", "cross.obj", *outputs("msh"), "--msh", "2.2", *BOX],
    "improved": ["improve", "top.obj", "outer.obj", "inner.obj", *SURFACES],
    "improved, cut": ["improve", "top.obj", "cross.obj", *outputs("obj", "vtp"), *BOX],
    "filled": ["fill", "holes.obj", "top.obj", *SURFACES],
    "filled, fine": ["fill", "holes.obj", "--mesh-size", "0.4", *outputs("vtp")],
    "layered": ["layer", "--hard", "top.obj", "--soft", "cross.obj", "--keep", "lower", *SURFACES],
    "layered, thick": ["layer", "top.obj", "base.obj", "--layer", "top=2", "--layer", "base=1", "--min-thickness", "0.5",
                       *outputs("obj")],
    "cut": ["arrange", "top.obj", "fault.obj", *SURFACES, *BOX],
    "cut, rotated": ["arrange", "top.obj", "fault.obj", *outputs("obj"), "--rotated-box", "5,5,4,6,6,4,20,3,1"],
    "cut, within": ["arrange", "top.obj", "fault.obj", *outputs("obj"), "--within", "outer.obj"],
    "sealed": ["arrange", "floor.obj", "roof.obj", "wall.obj", *SURFACES, "--seal", "0.6"],
    "sealed, cut": ["arrange", "floor.obj", "roof.obj", "wall.obj", *outputs("obj"), "--seal", "0.6", *BOX],
}
# A subject is a kind, or a kind and what is special.
SUBJECTS = {name: Subject([*command, "--certificate", "certificate.json", "--quiet"], "certificate.json")
            for name, command in COMMANDS.items()}
SUBJECTS |= {
    f"{kind}, built": Subject(["build", "project.json", "-o", f"built_{kind}", "--quiet"],
                              f"built_{kind}/certificate{end}.json", BUILT)
    for kind, end in (("arrangement", ""), ("volumes", "_blocks"), ("tetrahedra", "_tetrahedra"))}

PROJECT = {
    "format": "terrane-project 1",
    "surfaces": [{"file": "outer.obj", "name": "Outer", "role": "boundary"}, {"file": "inner.obj"},
                 {"file": "cross.obj", "role": "horizon"}],
    "column": [{"unit": "shale", "surface": "cross", "age": 3}, {"unit": "chalk"}],
    "outputs": {"surfaces": ["obj", "vtp"], "blocks": "obj", "tetrahedra": ["vtu", "msh"], "certificate": True}}
