# SPDX-License-Identifier: LGPL-3.0-or-later
"""FreeCAD's Mesh module for the score card: OPERATION, output and inputs are in SCORECARD, as its program reads the arguments."""
import os
import pathlib
import sys

import Mesh

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import off  # noqa: E402


def mesh_of(path):
    points, triangles = off.read(path)
    return Mesh.Mesh([[points[k] for k in t] for t in triangles])


operation, output, *inputs = os.environ["SCORECARD"].split("\n")
body = mesh_of(inputs[0])
for path in inputs[1:]:
    body = getattr(body, {"union": "unite", "intersection": "intersect"}.get(operation, operation))(mesh_of(path))
points, triangles = body.Topology
off.write(output, points, triangles)
