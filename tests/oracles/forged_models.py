# SPDX-License-Identifier: LGPL-3.0-or-later
"""Random surfaces, and commands that make a certificate of each kind about them."""

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
    points, triangles = sheet(rng, 6, horizon(0, a), 0.1)
    left = [t for t in triangles if (min(v // 7 for v in t), min(v % 7 for v in t)) not in ((2, 2), (4, 4))]
    write(folder / "holes.obj", (points, left))


COMMANDS = {
    "arrangement": ["arrange", "top.obj", "base.obj", "fault.obj", "cross.obj", "-o", "out.obj"],
    "volumes": ["volume", "outer.obj", "inner.obj", "cross.obj", "-o", "out"],
    "tetrahedra": ["tetrahedralize", "outer.obj", "inner.obj", "top.obj", "-o", "out.vtu"],
    "improved": ["improve", "top.obj", "outer.obj", "inner.obj", "-o", "out.obj"],
    "filled": ["fill", "holes.obj", "top.obj", "-o", "out.obj"],
    "layered": ["layer", "--hard", "top.obj", "--soft", "cross.obj", "--keep", "lower", "-o", "out.obj"],
    "cut": ["arrange", "top.obj", "fault.obj", "-o", "out.obj", "--box", "1,1,0,9,9,6"],
    "sealed": ["arrange", "floor.obj", "roof.obj", "wall.obj", "-o", "out.obj", "--seal", "0.6"],
}
