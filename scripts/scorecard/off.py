# SPDX-License-Identifier: LGPL-3.0-or-later
"""OFF files of triangles for the engines that are called from Python."""


def read(path):
    """The points and the triangles of a file."""
    with open(path, encoding="ascii") as file:
        words = file.read().split()
    vertices, faces = int(words[1]), int(words[2])
    rest = words[4 + 3 * vertices:]
    points = [tuple(map(float, words[4 + 3 * k:7 + 3 * k])) for k in range(vertices)]
    return points, [tuple(map(int, rest[4 * k + 1:4 * k + 4])) for k in range(faces)]


def write(path, points, faces):
    """Writes faces of any number of corners; points that are equal become one."""
    numbers = {}
    places = [numbers.setdefault(tuple(float(x) + 0 for x in p), len(numbers)) for p in points]
    with open(path, "w", encoding="ascii") as file:
        file.write(f"OFF\n{len(numbers)} {len(faces)} 0\n")
        file.writelines("%r %r %r\n" % p for p in numbers)
        file.writelines(" ".join(map(str, [len(face), *(places[k] for k in face)])) + "\n" for face in faces)
