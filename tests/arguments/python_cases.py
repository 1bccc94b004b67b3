# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the arguments of the Python package mean: a call of each function, and a value of each argument that changes it.

A function, method or argument that is not here makes python_arguments.py fail.
"""

import functools
import json
import os
import pathlib
import subprocess

import numpy as np

import terrane

BOX = ((0.2, 0.2, -2.0), (4.8, 4.8, 2.0))


def sheet(z, name, role, wave, n=6):
    """Return a horizon over a square."""
    x, y = (g.ravel() for g in np.meshgrid(np.linspace(0, 5, n), np.linspace(0, 5, n), indexing="ij"))
    i, j = (g.ravel() for g in np.meshgrid(np.arange(n - 1), np.arange(n - 1), indexing="ij"))
    a = i * n + j
    cells = np.concatenate([np.stack([a, a + n, a + n + 1], 1), np.stack([a, a + n + 1, a + 1], 1)])
    return terrane.Surface(np.stack([x, y, z + wave * np.sin(x) * np.sin(y)], 1), cells, name, role)


class Fixtures:
    """What calls are about; each is made when it is first asked for."""

    @functools.cached_property
    def surfaces(self):
        fault = terrane.Surface([[2.0, -1, -3], [2.0, 6, -3], [2.6, 6, 3], [2.6, -1, 3]], [[0, 1, 2], [0, 2, 3]], "F1", "fault")
        return [sheet(1.0, "top", "horizon", 0.2), sheet(-1.0, "base", "horizon", 0.1), fault]

    @functools.cached_property
    def short(self):
        """Horizons that do not reach the box, by less than one unit."""
        return [s.replace(vertices=s.vertices * [0.9, 0.9, 1] + [0.25, 0.25, 0]) for s in self.surfaces[:2]]

    @functools.cached_property
    def holed(self):
        """A surface with a hole, whose throw is that of a fault across."""
        flat = sheet(0.0, "holed", "horizon", 0.3, 15)
        middle = flat.vertices[flat.triangles].mean(axis=1)
        return flat.replace(triangles=flat.triangles[np.hypot(middle[:, 0] - 2.5, middle[:, 1] - 2.5) > 1])

    @functools.cached_property
    def crossing(self):
        """Two horizons that cross."""
        low = sheet(0.0, "low", "horizon", 0.0)
        return [low, low.replace(vertices=low.vertices * [1, 1, 0] + np.outer(low.vertices[:, 0] - 2, [0, 0, 0.3]), name="high")]

    @functools.cached_property
    def arrangement(self):
        return terrane.arrange(self.surfaces)

    @functools.cached_property
    def rounded(self):
        return terrane.round(self.arrangement)

    @functools.cached_property
    def model(self):
        return terrane.model(self.surfaces, box=BOX)

    @functools.cached_property
    def even(self):
        """The model with even triangles, which take few tetrahedra."""
        return self.model.improved(1.0)

    @functools.cached_property
    def cells(self):
        return terrane.tetrahedralize(self.even, optimise=False)

    @functools.cached_property
    def improved(self):
        return terrane.improve(self.model.mesh, 1.0)

    @functools.cached_property
    def filled(self):
        return terrane.fill(self.holed)

    @functools.cached_property
    def doubled(self):
        """A closed surface that goes round everything twice."""
        return [s.replace(name="body") for s in 2 * terrane.box(*BOX)]

    @functools.cached_property
    def layered(self):
        return terrane.layers(self.crossing, [("low", 1.0), ("high", 0.5)])

    @functools.cached_property
    def volumes(self):
        return terrane.volumes(self.model.mesh)

    @functools.cached_property
    def files(self):
        """A folder with surfaces, a project and a certificate."""
        folder = pathlib.Path("files").absolute()
        folder.mkdir()
        for s in self.surfaces:
            s.save(folder / (s.name + ".ts"))
        (folder / "points.xyz").write_text("".join(f"{x + x * y % 3 / 5} {y} {x * y}\n" for x in range(6) for y in range(6)))
        (folder / "survey.csv").write_text("md,inclination,azimuth\n0,0,0\n4,10,20\n")
        project = {"format": "terrane-project 1", "surfaces": [{"file": f"{s.name}.ts", "role": s.role} for s in self.surfaces],
                   "volume_of_interest": {"box": {"low": BOX[0], "high": BOX[1]}}, "folder": "built",
                   "outputs": {"blocks": "vtp"}, "uncertainty": [{"surface": "top", "shift": 0.1}]}
        (folder / "project.json").write_text(json.dumps(project))
        return folder

    @functools.cached_property
    def certificate(self):
        """A certificate, which the program writes; it does not know its inputs' folder."""
        names = ["top", "base", "F1"]
        subprocess.run([os.environ["TERRANE_PROGRAM"], "arrange", *(str(self.files / f"{n}.ts") for n in names), "-o",
                        "arranged.vtp", "--certificate", "arranged.json", "--quiet"], cwd=self.files, check=True)
        return str(self.files / "arranged.json")

    @functools.cached_property
    def built(self):
        return terrane.build(str(self.files / "project.json"))

    @functools.cached_property
    def ensemble(self):
        return terrane.ensemble(str(self.files / "project.json"), realisations=2, engine="serial")


#: How a call runs, not what it returns: only nonsense is tried.
HOW = {"threads", "progress"}

#: name: (required arguments, {optional argument: a value that changes the result, or (value, what it needs besides)}).
#: Arguments are functions of the fixtures.
FUNCTIONS = {
    "arrange": (lambda f: dict(surfaces=f.surfaces), {"search": None}),
    "round": (lambda f: dict(arrangement=f.arrangement), {"max_rounds": None, "max_move": None}),
    "check": (lambda f: dict(surfaces=f.surfaces), {}),
    "regions": (lambda f: dict(mesh=f.rounded), {}),
    "volumes": (lambda f: dict(source=f.model.mesh), {}),
    "structure": (lambda f: dict(mesh=f.model.mesh), {"volumes_of_mesh": None}),
    "mesh": (lambda f: dict(surfaces=f.surfaces), {}),
    "volume_of_interest": (lambda f: dict(surfaces=f.surfaces, boundary=terrane.box(*BOX)), {}),
    "box": (lambda f: dict(low=(0, 0, 0), high=(1, 1, 1)), {}),
    "rotated_box": (lambda f: dict(place=(0, 0, 0), lengths=(1, 2, 3)),
                    {"azimuth": 10, "plunge": 10, "roll": 10, "is_corner": True}),
    "polygon": (lambda f: dict(corners=[(0, 0), (1, 0), (0, 1)], low=0, high=1), {}),
    "closed": (lambda f: dict(surfaces=terrane.box(*BOX)), {}),
    "extend": (lambda f: dict(surfaces=f.short, boundary=terrane.box((0, 0, -2), (5, 5, 2)), limit=2), {}),
    "seal": (lambda f: dict(surfaces=f.short, distance=0.3), {"distance_of": None}),
    "suggest_seal": (lambda f: dict(surfaces=f.short, box=BOX), {}),
    "improve": (lambda f: dict(mesh=f.model.mesh), {
        "edge_length": 2, "max_deviation": 1e-3, "edge_length_of": {"top": 0.3}, "passes": 1, "resolution": 0.2,
        "dissolve": None, "curve_length": 0.4, "turn": None, "layers_in_gaps": None, "smallest": None,
        "growth": None, "crease_angle": None, "curve_angle": None, "thickness_share": None, "least_quality": None,
        "max_volume_change": None, "max_triangles": None}),
    "distance": (lambda f: dict(from_surface=f.surfaces[0], to_surface=f.surfaces[1]), {}),
    "holes": (lambda f: dict(surface=f.holed), {"gap_slope": None, "outer": True}),
    "fill": (lambda f: dict(surface=f.holed), {
        "method": None, "holes": [], "model": "spherical", "max_area": 0.1, "mesh_size": 0.2, "rings": None, "gap_slope": None,
        "isotropic": None, "bridge_faults": None, "smoothing": (0.5, {"method": "rbf"})}),
    "layers": (lambda f: dict(surfaces=f.crossing, order=[("low", 1.0), ("high", 0.5)]), {"min_thickness": 0.1, "max_move": None}),
    "select": (lambda f: dict(surfaces=f.doubled, expression="body"), {
        "rule": "odd", "fractions": True, "max_move": None}),
    "map_surface": (lambda f: dict(surfaces=f.surfaces, number="height", step=0.5), {
        "number": "dip", "to": lambda f: (f.surfaces[1], {"number": "thickness"}), "step": 0.25, "like": None}),
    "section": (lambda f: dict(model=f.model, level=0), {
        "plane": ([(1, 1, 0), (0, 1, 0)], {"level": None}), "fence": ([(0, 1), (2, 1)], {"level": None}),
        "level": 0.25, "by": ("base", {"level": None})}),
    "log_well": (lambda f: dict(model=f.model, points=[(1, 1, 3), (1, 1, -2)]), {"depths": [0, 7], "name": "A"}),
    "read_wells": (lambda f: dict(path=str(f.files / "survey.csv"), heads=(1, 1, 3)), {"heads": {"survey": (1, 1, 2)}}),
    "model": (lambda f: dict(surfaces=f.surfaces, box=BOX), {
        "seal": None, "tolerance": None, "extend": None, "min_volume": 15.0,
        "column": [{"unit": "upper", "surface": "top"}, {"unit": "middle", "surface": "base"}, {"unit": "lower"}], "max_rounds": None,
        "max_move": None}),
    "tetrahedralize": (lambda f: dict(model=f.even), {
        "edge_length": 1.0, "size_of": {"top": 0.4}, "size_in": {1: 0.5}, "quality": 1.8, "max_volume": 0.2, "split": ["F1"],
        "split_surfaces": None, "optimise": False, "outside": True,
        "around": ((( -3, -3, -4), (8, 8, 4)), {"outside": True}), "margin": (0.5, {"outside": True}), "mesher": None,
        "time_limit": None, "helper": None, "gmsh_helper": None}),
    "verify": (lambda f: dict(result=f.certificate), {
        "inputs": lambda f: [str(f.files / f"{n}.ts") for n in ("base", "top", "F1")], "max_deviation": 0, "max_change": None,
        "folder": None, "time": None, "memory": None}),
    "judge": (lambda f: dict(output=f.crossing), {
        "inputs": lambda f: f.crossing, "operation": None, "spacings": None, "most_flaws": 2}),
    "build": (lambda f: dict(project=str(f.files / "project.json")), {"folder": None}),
    "ensemble": (lambda f: dict(project=str(f.files / "project.json"), realisations=2, engine="serial"), {
        "folder": None, "seed": 2, "contacts": 0.5, "grid": 7, "workers": None, "scheduler": None, "retries": None,
        "keep": None}),
    "read": (lambda f: dict(path=str(f.files / "points.xyz")), {
        "format": None, "depth": True, "max_edge": 1.5, "unit": None, "columns": [1, 3, 2], "roles": {"points": "fault"}}),
    "save": (lambda f: dict(surfaces=f.surfaces, path="saved.stl"), {"format": "obj", "ascii": True}),
    "as_surface": (lambda f: dict(value=f.surfaces[0]), {"name": "other", "role": "fault"}),
    "as_surfaces": (lambda f: dict(value=f.surfaces), {"place": None}),
    "keep_freed_memory": (lambda f: {}, {}),
}

#: Objects and what their methods take, as above; "" stands for the constructor. A method without arguments is not here.
METHODS = {
    "Surface": (lambda f: f.surfaces[0], {
        "": (lambda f: dict(vertices=f.surfaces[0].vertices, triangles=f.surfaces[0].triangles),
             {"name": "a", "role": "fault", "frame": None,
              "point_data": lambda f: {"z": f.surfaces[0].vertices[:, 2]},
              "cell_data": lambda f: {"first": f.surfaces[0].triangles[:, 0]}}),
        "replace": (lambda f: {}, {"vertices": lambda f: f.surfaces[0].vertices + 1, "name": "other", "role": "fault",
                                   "triangles": lambda f: f.surfaces[0].triangles[:4], "frame": None}),
        "save": (lambda f: dict(path="s.obj"), {"format": "off"})}),
    "IndexLists": (lambda f: f.arrangement.parents_of, {
        "": (lambda f: dict(offsets=[0, 2, 3], values=[5, 7, 6]), {}), "contain": (lambda f: dict(index=3), {})}),
    "Arrangement": (lambda f: f.arrangement, {
        "coordinates": (lambda f: dict(vertex=3), {}), "construction": (lambda f: dict(vertex=3), {}),
        "digest": (lambda f: {}, {}), "report": (lambda f: dict(path="a.html"), {})}),
    "RoundedMesh": (lambda f: f.rounded, {
        "save": (lambda f: dict(path="r.vtp"), {"format": "obj", "keep_unverified": None, "ascii": None, "compress": False})}),
    "Mesh": (lambda f: f.model.mesh, {
        "save": (lambda f: dict(path="m.vtp"), {"format": "obj", "ascii": None, "compress": False}),
        "quality": (lambda f: {}, {}),
        "split": (lambda f: {}, {"surfaces": lambda f: [s.replace(point_data={"z": s.vertices[:, 2]})
                                                        for s in f.surfaces]})}),
    "Volumes": (lambda f: f.volumes, {
        "exact": (lambda f: {}, {}), "points": (lambda f: {}, {}), "locate": (lambda f: dict(points=[(1, 1, 0)]), {})}),
    "Filled": (lambda f: f.filled, {"save": (lambda f: dict(path="f.obj"), {"format": "off"}),
                                    "report": (lambda f: dict(path="f.html"), {})}),
    "Selected": (lambda f: terrane.select(f.doubled, "body"), {
        "save": (lambda f: dict(path="b.vtp"), {"format": "obj", "compress": False, "ascii": None})}),
    "Map": (lambda f: terrane.map_surface(f.surfaces, "height", step=0.5), {
        "save": (lambda f: dict(path="m.irap"), {"format": "vti"})}),
    "Section": (lambda f: terrane.section(f.model, level=0), {
        "save": (lambda f: dict(path="s.svg"), {"title": "a title", "exaggeration": 2.0})}),
    "BlocksInCells": (lambda f: f.model.grid(cells=(2, 2, 2)), {
        "save": (lambda f: dict(path="g.vti"), {}), "fraction": (lambda f: dict(block=1), {})}),
    "WellLog": (lambda f: terrane.log_well(f.model, [(1, 1, 3), (1, 1, -2)]), {
        "save": (lambda f: dict(path="w.las"), {"step": 0.5})}),
    "Layered": (lambda f: f.layered, {"save": (lambda f: dict(path="l.vtp"), {"format": "obj", "compress": False, "ascii": None})}),
    "Model": (lambda f: f.model, {
        "block_of": (lambda f: dict(points=[(1, 1, 0)]), {}), "names_of": (lambda f: dict(points=[(1, 1, 0)]), {}),
        "improved": (lambda f: {}, {"edge_length": 2, "passes": 1, "max_deviation": 1e-3}),
        "tetrahedra": (lambda f: {}, {"edge_length": 2, "improve": None, "quality": 1.8}),
        "where": (lambda f: dict(expression="block(1)"), {
            "others": lambda f: (f.doubled, {"expression": "block(1) | body"}), "rule": None, "fractions": True,
            "max_move": None}),
        "map_thickness": (lambda f: dict(blocks=[1], step=0.5), {"step": 0.25, "like": None}),
        "grid": (lambda f: dict(step=0.5), {
            "step": 0.25, "cells": ((2, 2, 2), {"step": None}), "x": [-1, 0, 1], "y": [-1, 0, 1], "z": [-1, 0, 1]}),
        "save": (lambda f: dict(folder="m"), {"format": "obj"}), "report": (lambda f: dict(path="m.html"), {})}),
    "Block": (lambda f: f.model.blocks[1], {"above_contact": (lambda f: dict(contact=0.5), {})}),
    "Blocks": (lambda f: f.model.blocks, {"get": (lambda f: dict(key=1), {"default": None})}),
    "Tetrahedra": (lambda f: f.cells, {
        "of_block": (lambda f: dict(block=1), {}), "report": (lambda f: dict(path="t.html"), {}),
        "save": (lambda f: dict(path="t.vtu"), {"format": "msh", "compress": False, "order": 2})}),
    "Built": (lambda f: f.built, {"save": (lambda f: {}, {"folder": "other"})}),
    "Improved": (lambda f: f.improved, {"save": (lambda f: dict(path="i.vtp"), {"format": "obj", "compress": False, "ascii": None})}),
    "Ensemble": (lambda f: f.ensemble, {
        "realisation": (lambda f: dict(number=1), {}), "save": (lambda f: dict(folder="e"), {"report": False}),
        "write_project": (lambda f: dict(number=1, folder="w"), {})}),
    "Error": (lambda f: terrane.Error("internal", "a"), {"": (lambda f: dict(code="internal", sentence="a"), {"place": "b"})}),
}

#: Classes that functions return, made of the module's own objects: their constructors are nobody's.
RETURNED = {"Arrangement", "RoundedMesh", "Mesh", "Regions", "CheckReport", "Volumes", "Structure", "Filled", "Layered", "Selected", "Map", "Section", "WellLog", "BlocksInCells", "Model",
            "Block", "Blocks", "Interface", "Tetrahedra", "Built", "Improved", "Sealed", "VolumeOfInterest", "Ensemble",
            "OutOfMemory", "Doubt"}
