#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks that each function of the library that returns a Result or Status has a stage of failing_allocations.

    functions_with_stages.py FAILING_ALLOCATIONS

A stage is named after its function, or after a function that WITHIN says to call it. A new reader, writer or stage
fails this test until it has a stage in tests/memory. Headers in folders `detail` and `helper` do not count.
"""
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
DECLARED = re.compile(r"^\s*(?:\[\[nodiscard\]\] )?(?:static )?(?:Result<.*>|Status|MaybeError)\s+(\w+)\(", re.M)
# A function: a stage that calls it, as a user of the library would.
WITHIN = {
    "add_holes": "Page::add_holes",
    "add_check": "Page::add_check",
    "add_judged": "Page::add_judged",
    "add_file": "Page::add_file",
    "file_row": "Page::add_file",
    "check_pages": "Page::html",
    "html": "Page::html",
    "arrange_exactly_within": "arrange_within",
    "arranging_of": "build",
    "cell_centres": "parse_surfaces, grdecl",
    "check_folds": "make_prisms",
    "check_edge_length": "fill_by_kriging",
    "check_sides": "fill_by_kriging",
    "check_improvable": "build",
    "check_new_folder": "check_pvtp",
    "count_work": "arrange_in_tiles",
    "create": "write_model_folder",
    "cut_sections": "to_cut_certificate",
    "delaunay": "connect_points",
    "find_sides": "select",
    "find_unmeasured": "select",
    "find_windings": "select",
    "improve_tetrahedra": "fill_blocks",
    "make_tetrahedra": "tetrahedralize",
    "parse_column": "read_column",
    "parse_expression": "select",
    "parse_project": "read_project",
    "prepare": "Realisations::prepare",
    "publish": "write_model_folder",
    "read_corner_points": "parse_surfaces, grdecl",
    "read_file": "read_surfaces",
    "read_gocad_file": "read_model",
    "read_gocad_model": "read_model",
    "read_model3d": "read_model",
    "read_msh_tetrahedra": "read_tetrahedra",
    "read_tsurf": "read_model",
    "read_vtk_tetrahedra": "read_tetrahedra",
    "read_vtu_tetrahedra": "read_tetrahedra",
    "read_shape_outline": "read_outline",
    "relay": "arrange_in_tiles",
    "step": "arrange_in_tiles",
    "validate_options": "fill_by_rbf",
    "visit": "arrange_in_tiles",
    "select_parsed": "select",
    "section_files": "write_section, svg",
    "section_shapes": "write_section, shp",
    "size_of_file": "judge",
    "simplify_for": "simplify_to",
    "surface_of_grid": "parse_surfaces, asc",
    "surfaces_of": "parse_surfaces, asc",
    "surfaces_of_corner_points": "parse_surfaces, grdecl",
    "to_esri": "format_grid, asc",
    "to_exodus": "write_tetrahedra, exo",
    "to_irap": "format_grid, irap",
    "to_plines": "format_mesh, pl",
    "to_pylith": "write_tetrahedra, pylith",
    "to_universal": "format_mesh, unv",
    "to_stl": "format_mesh, stl",
    "to_surfer": "format_grid, grd",
    "to_vti": "format_grid, vti",
    "to_vtp": "format_mesh, vtp",
    "to_vtu": "write_tetrahedra, vtu",
    "to_zmap": "format_grid, zmap",
    "triangulate_inside": "fill_closed_line",
    "upright": "format_grid, asc",
    "validate": "check",
    "validate_areas": "improve",
    "validate_indices": "improve",
    "validate_mesh": "improve",
    "write_file": "write_mesh",
    "write_file_at_once": "write_mesh",
    "write_model_files": "write_model_folder",
    "write_tetrahedra_files": "write_tetrahedra",
}
# Parts of readers of grids, of tiles, of PieceJoiner and of flat holes; they return errors to those.
PARTS = {"add", "check_steps", "count", "deliver", "filled", "finish", "integer", "load", "make_room", "number", "of", "save",
         "step_of", "take_messages", "triangulate"}
# Readers of one format each: parse_surfaces, with the name of the format.
FORMATS = {
    "cps3": "cps3", "dxf": "dxf", "esri": "asc", "gocad": "ts", "gocad_points": "vs", "grdecl": "grdecl", "irap": "irap", "landxml": "landxml", "leapfrog": "leapfrog",
    "msh": "msh", "obj": "obj", "off": "off", "ply": "ply", "points": "xyz", "sticks": "sticks", "stl": "stl",
    "surfer": "grd", "vtk": "vtk", "vtp": "vtp", "vts": "vts", "vtu": "vtu", "zmap": "zmap",
}


def declared():
    """All functions, with the header of each."""
    found = {}
    for folder in ("algorithms", "io"):
        for header in sorted((ROOT / folder).rglob("*.hpp")):
            if {"detail", "helper"} & set(header.parts) or header.is_relative_to(ROOT / "io/text"):
                continue
            for name in DECLARED.findall(header.read_text(encoding="utf-8")):
                found.setdefault(name, str(header.relative_to(ROOT)))
    return found


def main():
    stages = subprocess.run([sys.argv[1], "list"], capture_output=True, text=True, check=True).stdout.splitlines()
    for name, extension in FORMATS.items():
        WITHIN[f"read_{name}"] = f"parse_surfaces, {extension}"
    functions = declared()
    flaws = []
    for name, header in functions.items():
        wanted = WITHIN.get(name, name)
        if name not in PARTS and not any(s == wanted or s.startswith(wanted + ", ") for s in stages):
            flaws.append(f"{header}: {name} has no stage {wanted!r} in tests/memory")
    flaws += [f"{name} is declared nowhere" for name in sorted(PARTS | set(WITHIN)) if name not in functions]
    print("\n".join(flaws) or f"{len(functions)} functions have stages, of {len(stages)}")
    return 1 if flaws or len(functions) < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
