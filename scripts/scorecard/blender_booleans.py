# SPDX-License-Identifier: LGPL-3.0-or-later
"""Blender's Boolean modifier for the score card.

blender -b --factory-startup --python-exit-code 1 --python blender_booleans.py -- EXACT|FAST OPERATION OUTPUT.off A.off B.off
"""
import pathlib
import sys

import bpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import off  # noqa: E402

solver, operation, output, *inputs = sys.argv[sys.argv.index("--") + 1:]
bodies = []
for path in inputs:
    points, triangles = off.read(path)
    mesh = bpy.data.meshes.new("mesh")
    mesh.from_pydata(points, [], triangles)
    bodies.append(bpy.data.objects.new("body", mesh))
    bpy.context.collection.objects.link(bodies[-1])
for other in bodies[1:]:
    modifier = bodies[0].modifiers.new("boolean", "BOOLEAN")
    modifier.operation, modifier.solver, modifier.object = operation.upper().replace("INTERSECTION", "INTERSECT"), solver, other
made = bodies[0].evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
off.write(output, [v.co for v in made.vertices], [p.vertices for p in made.polygons])
