# SPDX-License-Identifier: LGPL-3.0-or-later
"""Derives the answers of a case from its triangles, by brute force in rational numbers, and compares them.

    python3 check_case.py CASE.json ...

A case (docs/reference/case.md) has OFF files and the answers about their arrangement. Nothing of Terrane is used. Each step looks
at all pairs: a case of 60 triangles takes seconds to minutes.
"""
import itertools
import json
import pathlib
import sys
from fractions import Fraction

AXES = ((1, 2), (2, 0), (0, 1))  # the two coordinates that are left when x, y or z is dropped


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return tuple(a[i] * b[j] - a[j] * b[i] for i, j in AXES)


def between(a, b, share):
    return tuple(x + share * (y - x) for x, y in zip(a, b))


def read_off(path):
    """The triangles of an OFF file, as triples of points; each number is the nearest double."""
    words = path.read_text().split()
    vertices, faces = int(words[1]), int(words[2])
    numbers, corners = words[4:4 + 3 * vertices], words[4 + 3 * vertices:]
    assert words[0] == "OFF" and len(corners) == 4 * faces, f"{path} is no OFF file of triangles"
    points = [tuple(Fraction(float(w)) for w in numbers[i:i + 3]) for i in range(0, 3 * vertices, 3)]
    return [tuple(points[int(w)] for w in corners[i + 1:i + 4]) for i in range(0, 4 * faces, 4)]


class Plane:
    """A triangle with its plane, and the projection in which its corners are counterclockwise if `turn` is 1."""

    def __init__(self, corners):
        self.corners = corners
        self.normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]))
        self.axis = max(range(3), key=lambda k: abs(self.normal[k]))
        self.turn = 1 if self.normal[self.axis] > 0 else -1

    def side(self, p):
        return dot(self.normal, minus(p, self.corners[0]))

    def flat(self, p):
        i, j = AXES[self.axis]
        return p[i], p[j]

    def edges(self):
        a, b, c = self.corners
        return (a, b), (b, c), (c, a)

    def holds(self, p):
        """Whether a point of the plane is in the closed triangle."""
        return all(self.turn * turn(self.flat(a), self.flat(b), self.flat(p)) >= 0 for a, b in self.edges())


def turn(a, b, c):
    """Twice the area of a flat triangle, positive if it is counterclockwise."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def on_segment(p, a, b):
    """Whether p is on the closed segment a b."""
    d, e = minus(b, a), minus(p, a)
    return cross(d, e) == (0, 0, 0) and 0 <= dot(d, e) <= dot(d, d)


def common_points(s, t):
    """Points that two triangles share: enough of them that their convex hull is what they share."""
    found = set()
    for one, other in ((s, t), (t, s)):
        for a, b in one.edges():
            u, v = other.side(a), other.side(b)
            if u == 0 and other.holds(a):
                found.add(a)
            if u * v < 0:
                p = between(a, b, u / (u - v))
                if other.holds(p):
                    found.add(p)
            if u == v == 0:
                found.update(p for e in other.edges() for p in crossing((a, b), e))
    return found


def crossing(e, f):
    """Points that two segments of one plane share: none, one, or the ends of what they share."""
    found = {p for p, (a, b) in ((e[0], f), (e[1], f), (f[0], e), (f[1], e)) if on_segment(p, a, b)}
    d, g, h = minus(e[1], e[0]), minus(f[1], f[0]), minus(f[0], e[0])
    n = cross(d, g)
    if n != (0, 0, 0) and dot(n, h) == 0:
        share, other = dot(cross(h, g), n) / Fraction(dot(n, n)), dot(cross(h, d), n) / Fraction(dot(n, n))
        if 0 <= share <= 1 and 0 <= other <= 1:
            found.add(between(e[0], e[1], share))
    return found


def is_proper(s, t, shared):
    """Whether two triangles share no more than corners and an edge of both."""
    return shared <= set(s.corners) & set(t.corners) and len(shared) < 3


def segments_of(points):
    """The segment between the first and the last of points on a line, if there are two."""
    return [(min(points), max(points))] if len(points) > 1 else []


class Arrangement:
    """The edges and faces into which triangles divide each other."""

    def __init__(self, triangles):
        """triangles: distinct planes with area."""
        self.planes = triangles
        self.lines = [set(map(tuple, map(sorted, t.edges()))) for t in triangles]
        self.points_on = [set(t.corners) for t in triangles]
        self.contacts = []
        for (i, s), (j, t) in itertools.combinations(enumerate(triangles), 2):
            shared = common_points(s, t)
            if not shared:
                continue
            self.points_on[i] |= shared
            self.points_on[j] |= shared
            if not is_proper(s, t, shared):
                self.contacts.append([i, j])
            self.draw(i, j, shared)
        self.close()
        self.edges_of = [self.divided(i) for i in range(len(triangles))]
        self.find_faces()

    def draw(self, i, j, shared):
        """Draws what two triangles share into both."""
        s, t = self.planes[i], self.planes[j]
        if cross(s.normal, t.normal) != (0, 0, 0):
            lines = segments_of(shared)
        else:
            lines = [pair for e in s.edges() + t.edges() for pair in segments_of(
                {p for p in shared if on_segment(p, *e)})]
        for line in lines:
            self.lines[i].add(line)
            self.lines[j].add(line)

    def close(self):
        """Adds the crossings of lines in a triangle to all triangles that have them."""
        for i, lines in enumerate(self.lines):
            for e, f in itertools.combinations(lines, 2):
                self.points_on[i] |= crossing(e, f)
        self.points = set().union(*self.points_on)
        for i, plane in enumerate(self.planes):
            self.points_on[i] |= {p for p in self.points - self.points_on[i] if plane.side(p) == 0 and plane.holds(p)}

    def divided(self, i):
        """The edges in a triangle: its lines, divided at all points."""
        edges = set()
        for a, b in self.lines[i]:
            on = sorted(p for p in self.points_on[i] if on_segment(p, a, b))
            edges.update(itertools.pairwise(on))
        return edges

    def find_faces(self):
        """Finds the faces of each triangle; a face of several triangles is one, with all of them as parents."""
        self.faces = {}  # boundary edges -> (loops, parents)
        for i, plane in enumerate(self.planes):
            for loops in faces_in(plane, self.edges_of[i]):
                boundary = frozenset(tuple(sorted(e)) for loop in loops for e in zip(loop, loop[1:] + loop[:1]))
                self.faces.setdefault(boundary, (loops, plane, []))[2].append(i)

    def curves(self, inputs_of):
        """Edges of more than two faces, or of two that differ in the number of parents in some input."""
        around = {}
        for loops, _, parents in self.faces.values():
            for a, b in (e for loop in loops for e in zip(loop, loop[1:] + loop[:1])):  # twice where it ends inside
                around.setdefault((min(a, b), max(a, b)), []).append(sorted(n for i in parents for n in inputs_of[i]))
        return sorted(e for e, n in around.items() if len(n) > 2 or (len(n) == 2 and n[0] != n[1]))


def faces_in(plane, edges):
    """The faces of a triangle between edges, each a list of loops: the outer one counterclockwise in its plane, then holes."""
    around = {}
    for a, b in edges:
        around.setdefault(a, []).append(b)
        around.setdefault(b, []).append(a)
    for a, ends in around.items():
        ends.sort(key=lambda b: angle_key(plane, a, b))
    outer, holes, seen = [], [], set()
    for a, b in [*edges, *((b, a) for a, b in edges)]:
        if (a, b) in seen:
            continue
        loop, step = [], (a, b)
        while step not in seen:
            seen.add(step)
            loop.append(step[0])
            ends = around[step[1]]
            step = (step[1], ends[ends.index(step[0]) - 1])  # the next one clockwise: the face is on the left
        area = sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(map(plane.flat, loop), map(plane.flat, loop[1:] + loop[:1])))
        (outer if area * plane.turn > 0 else holes).append(loop)
    faces = [[loop] for loop in outer]
    for hole in holes:
        inside = [f for f in faces if hole[0] not in f[0] and winds_round(plane, f[0], hole[0]) and not set(hole) & set(f[0])]
        if inside:  # else it is the outside of the triangle
            min(inside, key=lambda f: loop_area(plane, f[0])).append(hole)
    return faces


def angle_key(plane, a, b):
    """Orders directions counterclockwise in the plane."""
    (x, y), (u, v) = plane.flat(a), plane.flat(b)
    return direction_key(u - x, plane.turn * (v - y))


def direction_key(x, y):
    """Orders directions counterclockwise, exactly: quarter, then the tangent in it."""
    quarter = 0 if x > 0 and y >= 0 else 1 if x <= 0 and y > 0 else 2 if x < 0 else 3
    x, y = ((x, y), (y, -x), (-x, -y), (-y, x))[quarter]
    return quarter, Fraction(y) / x


def loop_area(plane, loop):
    flat = [plane.flat(p) for p in loop]
    return abs(sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(flat, flat[1:] + flat[:1])))


def winds_round(plane, loop, p):
    """Whether a loop goes round a point that is not on it: crossings of a ray."""
    (x, y), inside = plane.flat(p), False
    flat = [plane.flat(q) for q in loop]
    for (a, b), (c, d) in zip(flat, flat[1:] + flat[:1]):
        if (b > y) != (d > y) and a + (c - a) * Fraction(y - b) / (d - b) > x:
            inside = not inside
    return inside


def inner_point(plane, loops):
    """A point inside of a face: half way between two crossings of a line that meets no corner."""
    ys = sorted({plane.flat(p)[1] for loop in loops for p in loop})
    y = (ys[0] + ys[1]) / 2
    xs = sorted(a + (c - a) * (y - b) / (d - b) for loop in loops
                for (a, b), (c, d) in zip(map(plane.flat, loop), map(plane.flat, loop[1:] + loop[:1])) if (b > y) != (d > y))
    flat = ((xs[0] + xs[1]) / 2, y)
    i, j = AXES[plane.axis]
    k, p = plane.axis, [0, 0, 0]
    p[i], p[j] = flat
    n, o = plane.normal, plane.corners[0]
    p[k] = o[k] - (n[i] * (p[i] - o[i]) + n[j] * (p[j] - o[j])) / n[k]
    return tuple(p)


class Blocks:
    """Connected parts of space. Side 2 f is in front of face f, 2 f + 1 behind it, and 2 n is the outside."""

    def __init__(self, arrangement):
        self.faces = list(arrangement.faces.items())
        self.parent = list(range(2 * len(self.faces) + 1))
        self.middles = [inner_point(plane, loops) for _, (loops, plane, _) in self.faces]
        self.join_round_edges()
        for f in range(len(self.faces)):
            self.join_along_line(f)

    def find(self, s):
        while self.parent[s] != s:
            s = self.parent[s]
        return s

    def join(self, s, t):
        self.parent[self.find(s)] = self.find(t)

    def join_round_edges(self):
        around = {}
        for f, (boundary, (loops, plane, _)) in enumerate(self.faces):
            for loop in loops:
                for a, b in zip(loop, loop[1:] + loop[:1]):
                    low, high = min(a, b), max(a, b)
                    inwards = cross(plane.normal, minus(b, a))  # into the face, which is to the left
                    ahead = 2 * f if a == low else 2 * f + 1  # the side that faces growing angles
                    around.setdefault((low, high), []).append((inwards, ahead))
        for (low, high), sides in around.items():
            first = sides[0][0]
            second = cross(minus(high, low), first)  # y is longer by the length of the edge, for all sides alike
            sides.sort(key=lambda side: direction_key(dot(side[0], first), dot(side[0], second)))
            for (_, ahead), (_, following) in zip(sides, sides[1:] + sides[:1]):
                self.join(ahead, following ^ 1)

    def hits(self, origin, direction):
        """(parameter, face, whether it is met from its front) along a line; None if it meets an edge."""
        found = []
        for f, (boundary, (loops, plane, _)) in enumerate(self.faces):
            down = dot(plane.normal, direction)
            if down == 0:
                if plane.side(origin) == 0:
                    return None
                continue
            t = -plane.side(origin) / Fraction(down)
            p = between(origin, tuple(o + d for o, d in zip(origin, direction)), t)
            if any(on_segment(p, a, b) for a, b in boundary):
                return None
            if sum(winds_round(plane, loop, p) for loop in loops) % 2 == 1:
                found.append((t, f, down < 0))
        return sorted(found)

    def line_through(self, f):
        for n in itertools.count(1):
            direction = (Fraction(n), Fraction(3 * n + 1, 7), Fraction(5, n + 1))
            hits = self.hits(self.middles[f], direction)
            if hits is not None:
                return direction, hits

    def join_along_line(self, f):
        before = 2 * len(self.faces)
        for _, face, from_front in self.line_through(f)[1]:
            self.join(before, 2 * face + (0 if from_front else 1))
            before = 2 * face + (1 if from_front else 0)
        self.join(before, 2 * len(self.faces))

    def volumes(self):
        """The volumes of all blocks, ascending."""
        sums = {}
        for f in range(len(self.faces)):
            six = self.cone(f)
            for side, sign in ((2 * f + 1, 1), (2 * f, -1)):
                block = self.find(side)
                sums[block] = sums.get(block, 0) + sign * six
        sums.pop(self.find(2 * len(self.faces)), None)
        return sorted(Fraction(v) / 6 for v in sums.values())

    def cone(self, f):
        """Six times the volume from the origin to a face, positive if the face looks away from it."""
        _, (loops, plane, _) = self.faces[f]
        return sum(dot(plane.corners[0], cross(a, b)) for loop in loops for a, b in zip(loop, loop[1:] + loop[:1]))

    def booleans(self, copies, operands):
        """Volumes of the solids whose winding numbers of the operands are not 0 in any, all, the first alone, an odd number."""
        rules = {"union": any, "intersection": all, "difference": lambda w: w[0] and not any(w[1:]),
                 "symmetric-difference": lambda w: sum(map(bool, w)) % 2 == 1}
        sums = dict.fromkeys(rules, 0)
        for f in range(len(self.faces)):
            direction, hits = self.line_through(f)
            windings = [0] * operands
            for _, face, from_front in hits:
                before = list(windings)
                for plane, operand in itertools.chain.from_iterable(copies[parent] for parent in self.faces[face][1][2]):
                    windings[operand] += 1 if dot(plane.normal, direction) < 0 else -1
                if face == f:
                    front, behind = (before, list(windings)) if from_front else (list(windings), before)
            assert not any(windings), "an operand is not closed"
            for name, rule in rules.items():
                sums[name] += (bool(rule(behind)) - bool(rule(front))) * self.cone(f)
        return {name: str(Fraction(v) / 6) for name, v in sums.items()}


def derived(case, folder):
    """The answers, as the case states them."""
    files = [read_off(folder / name) for name in case["inputs"]]
    triangles = [t for file in files for t in file]
    file_of = [n for n, file in enumerate(files) for _ in file]
    alike = {}  # triangles with area and the same corners; of these, the first has answers, and solids need all
    for n, plane in enumerate(map(Plane, triangles)):
        if plane.normal != (0, 0, 0):
            alike.setdefault(frozenset(triangles[n]), []).append((n, plane))
    numbers, planes = zip(*(same[0] for same in alike.values()))
    copies = [[(plane, file_of[n]) for n, plane in same] for same in alike.values()]
    inputs_of = [{file_of[n] for n, _ in same} for same in alike.values()]
    made = Arrangement(planes)
    points = sorted(made.points)
    number = {p: i for i, p in enumerate(points)}
    text = [[str(x) for x in p] for p in points]
    blocks = Blocks(made)
    answers = {"points": text,
               "points_on": {str(n): sorted(number[p] for p in on) for n, on in zip(numbers, made.points_on)},
               "contacts": [[numbers[i], numbers[j]] for i, j in made.contacts],
               "curves": sorted([number[a], number[b]] for a, b in made.curves(inputs_of)),
               "blocks": [str(v) for v in blocks.volumes()]}
    if "booleans" in case:
        answers["booleans"] = blocks.booleans(copies, len(files))
    return answers


def main(paths):
    wrong = 0
    for path in map(pathlib.Path, paths):
        case = json.loads(path.read_text())
        assert case["format"] == "terrane-case 1", f"{path} is no case"
        answers = derived(case, path.parent)
        different = [key for key, value in answers.items() if case[key] != value]
        wrong += bool(different)
        print(f"{path}: {'differs in ' + ', '.join(different) if different else 'all answers agree'}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
