#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Calls each function of the C interface with each argument, and each member of each struct, at values that make no sense.

    tests/arguments/c_arguments.py --library LIBTERRANE_C.so [--share S] [--seconds S] [--seed N] [--only NAME]

The functions, their arguments, structs and members are those of the headers. (1) Each can be called: for a new type of
argument it must be said here what a good one is. (2) A value that makes no sense is an error, or it changes the result:
none is ignored; getters return nothing for it. No call crashes.

--share tries such a share of the values, drawn by --seed, and always null and what is no handle. --seconds goes on with random combinations for so long.
"""

import ctypes
import functools
import hashlib
import math
import os
import pathlib
import random
import re
import sys

from c_library import DATA, FUNCTIONS, HANDLES, NUMBERS, PROJECT, STRUCTS, Library, check_abi
from trials import conclude, make_calls, parse, supervise

#: Members and arguments that may be anything, and what may be null, with the reason.
FREE = {"user": "it is passed on", "hardness": "the order counts alone", "name": "a name may be any text", "source": "it is only named in messages",
        "helper": "it is looked for where tetrahedra are made", "gmsh_helper": "likewise"}
MAY_BE_NULL = {"left", "run", "error", "count", "length", "options", "search", "format", "unit", "variogram", "progress", "timing", "folder",
               "part_format", "helper", "gmsh_helper", "columns", "vertex_count", "triangle_count", "surface_count", "face_count",
               "block_count", "column", "improved", "rules", "size_of", "size_in", "split", "inputs", "edge_length_of", "merged",
               "surfaces_or_null", "holes", "layered", "layers", "growth", "volume_files", "model_folder", "tetrahedra", "model"}
#: Limits, which a number may exceed so far that nothing reaches them.
LIMITS = {"spacings", "most_flaws", "limit", "time", "memory", "tolerance", "max_area", "max_move", "max_rounds", "max_deviation", "max_change", "max_volume", "max_volume_change", "time_limit",
          "max_triangles", "max_edge", "gap_slope", "curve_length", "growth", "smallest", "thickness_share", "rings"}
LARGE = {"inf", "1e+308", "2147483647"}
#: Members that are of another function, which takes the same struct.
OTHERS = {("terrane_find_holes", member) for member in ("use_rbf", "mesh_size", "rings", "is_isotropic", "variogram", "smoothing")}
OTHERS.add(("terrane_simplify", "edge_length"))  # edges that are longer stay
#: A negative number stands for the default.
DEFAULT_BELOW_0 = {"max_move", "max_deviation", "max_change", "smoothing"}
#: Members that are true for all numbers but 0.
FLAGS = {m for header in check_abi.HEADERS for m in re.findall(r"int32_t (\w+);\s*///<[^;]*?\bnot 0", header.read_text())}

TWO_TETRAHEDRA = [(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4), (4, 4, 4)]


def faces_of_two_tetrahedra(lib):
    surfaces = lib.make("terrane_surfaces_new")
    lib.add(surfaces, "hull", TWO_TETRAHEDRA, [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 4), (1, 4, 3), (2, 3, 4)])
    lib.add(surfaces, "wall", TWO_TETRAHEDRA, [(1, 2, 3)])
    return surfaces


#: Good values of arguments that their types do not decide, by "function.argument" or by the name alone.
GOOD = {
    "terrane_surfaces_add.surfaces": lambda lib: lib.make("terrane_surfaces_new"),
    "terrane_judge_tetrahedra.vertices": lambda lib: lib.array(ctypes.c_double, [x for v in TWO_TETRAHEDRA for x in v]),
    "terrane_judge_tetrahedra.vertex_count": lambda lib: 5, "terrane_judge_tetrahedra.tetrahedron_count": lambda lib: 2,
    "terrane_judge_tetrahedra.tetrahedra": lambda lib: lib.array(ctypes.c_uint32, [0, 1, 2, 3, 1, 2, 3, 4]),
    "terrane_judge_tetrahedra.labels": lambda lib: lib.array(ctypes.c_uint32, [7, 9]),
    "terrane_judge_tetrahedra.inputs": lambda lib: faces_of_two_tetrahedra(lib),
    "terrane_surfaces_add.vertices": lambda lib: lib.array(ctypes.c_double, [0, 0, 0, 1, 0, 0, 0, 1, 0]),
    "terrane_surfaces_add.vertex_count": lambda lib: 3,
    "terrane_surfaces_add.triangles": lambda lib: lib.array(ctypes.c_uint32, [0, 1, 2]),
    "terrane_surfaces_add.triangle_count": lambda lib: 1,
    "terrane_surfaces_parse.contents": lambda lib: lib.text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
    "terrane_surfaces_parse.size": lambda lib: 32,
    "terrane_surfaces_parse.source": lambda lib: lib.text("one.obj"),
    "terrane_surfaces_doubts.blocks": lambda lib: 1,
    "terrane_surfaces_read.path": lambda lib: lib.text(str(DATA / "top.ts")),
    "terrane_surfaces_write.path": lambda lib: lib.text("written.stl"),
    "terrane_mesh_write.path": lambda lib: lib.text("written.vtp"),
    "terrane_tetrahedra_write.path": lambda lib: lib.text("written.vtu"),
    "terrane_model_write.folder": lambda lib: lib.text("written"),
    "terrane_build_file.path": lambda lib: lib.text(lib.project_file()),
    "terrane_build.folder": lambda lib: lib.text(str(DATA)),
    "terrane_build.surfaces": lambda lib: None,
    "terrane_verify_certificate.path": lambda lib: lib.text(lib.certificate()),
    "terrane_write_certificate.path": lambda lib: lib.text("certificate.json"),
    "terrane_polygon_boundary.corners": lambda lib: lib.array(ctypes.c_double, [0, 0, 4, 0, 0, 4]),
    "terrane_closed_boundary.surfaces": lambda lib: lib.make("terrane_box_boundary", lib.array(ctypes.c_double, [0, 0, 0]),
                                                             lib.array(ctypes.c_double, [1, 1, 1])),
    "terrane_find_holes.surfaces": lambda lib: lib.holed, "terrane_fill.surfaces": lambda lib: lib.holed,
    "terrane_cut_to_volume.arrangement": lambda lib: lib.handle("terrane_arrangement"),
    "terrane_make_model.arrangement": lambda lib: lib.c.terrane_cut_arrangement(lib.handle("terrane_cut")),
    "terrane_simplified_keeps_resolution.improved": lambda lib: lib.improved_simplified(), "terrane_make_model.improved": lambda lib: None, "terrane_choose_seal.edge_length": lambda lib: 0.0,
    "terrane_join_within.tolerance": lambda lib: 0.01,
    "terrane_box_boundary.low": lambda lib: lib.array(ctypes.c_double, [0, 0, 0]),
    "terrane_box_boundary.high": lambda lib: lib.array(ctypes.c_double, [1, 1, 1]),
    "terrane_volumes_exact.volume": lambda lib: 1,
    "expression": lambda lib: lib.text("top & east(F1)"), "terrane_selected_exact_volume.piece": lambda lib: 0xffffffff,
    "terrane_error_free.error": lambda lib: lib.failure(),
    "terrane_code_name.code": lambda lib: 3,
    "json": lambda lib: lib.text(PROJECT), "format": lambda lib: None, "part_format": lambda lib: lib.text("obj"),
    "name": lambda lib: lib.text("name"), "corner_count": lambda lib: 3, "low": lambda lib: 0.0, "high": lambda lib: 2.0,
    "boundary": lambda lib: lib.array(ctypes.c_uint32, range(3, 9)), "boundary_count": lambda lib: 6, "limit": lambda lib: 1.0,
    "points": lambda lib: lib.array(ctypes.c_double, [1, 1, 0]), "point_count": lambda lib: 1, "least": lambda lib: 1.0,
    "layers": lambda lib: (STRUCTS["terrane_layer"] * 2)((0, 0, 1.0), (1, 0, 0.5)), "layer_count": lambda lib: 2,
    "tasks": lambda lib: (STRUCTS["terrane_fill_task"] * 1)(lib.options("terrane_fill_task")), "task_count": lambda lib: 1, "edge_length": lambda lib: 1.0,
    "box": lambda lib: (STRUCTS["terrane_rotated_box"] * 1)(((0, 0, 0), (1, 2, 3), 10, 5, 2, 0, 0)),
    "text": lambda lib: None, "threads": lambda lib: 2, "progress": lambda lib: None, "timing": lambda lib: None,
    "user": lambda lib: None,
}
INDEX = {"surface", "hole", "task", "block", "violation", "vertex", "which", "kind", "reason", "axis", "role", "volume", "code", "number",
         "flaw_number"}


class Call:
    """A call with good arguments, of which some may be changed; what comes out is kept to be read."""

    def __init__(self, lib, name):
        self.lib, self.name = lib, name
        self.result, self.given = FUNCTIONS[name]
        self.outs, self.sizes, self.structs = [], {}, {}
        self.values = {own: self._good(kind, own) for kind, own in self.given}
        self.first = next(iter(self.values.values()), None)
        if name == "terrane_surfaces_parse":
            self.structs["options"].format = lib.text("obj")
        for struct in self.structs.values():
            if "struct_size" in self.values:
                self.values["struct_size"] = ctypes.sizeof(struct)

    def _out(self, kind, made):
        self.outs.append((kind, made))
        return ctypes.addressof(made)

    def _good(self, kind, own):
        chosen = GOOD.get(f"{self.name}.{own}") or GOOD.get(own)
        base = re.sub(r"^const |\*.*$", "", kind).strip()
        if own in ("error", "out") or kind in ("char**",) or re.fullmatch(r"terrane_\w+\*\*", kind):
            return self._out(kind, ctypes.c_void_p())
        if base in HANDLES and not chosen:
            if self.name.endswith(("_free", "_set_threads", "_set_progress", "_set_timing", "_request_stop", "_reset")) or \
                    not kind.startswith("const"):
                return self.lib.fresh(base)  # it is changed
            return self.lib.handle(base)
        if base in STRUCTS and chosen:
            made = chosen(self.lib)
            self.lib.kept.append(made)
            self.structs[own] = made[0]
            return ctypes.addressof(made)
        if base in STRUCTS:
            init = self.name.endswith("_init")
            made = self.lib.options(base) if (kind.startswith("const") and not init) else STRUCTS[base]()
            if base == "terrane_certified" and not init:
                made = self.lib.certified()
            self.structs[own] = made
            return self._out(base, made) if not kind.startswith("const") else ctypes.addressof(made)
        if chosen:
            return chosen(self.lib)
        if kind in ("size_t*", "uint32_t*", "double*", "int32_t*") and not kind.startswith("const"):
            return self._out(kind, NUMBERS[kind[:-1]]())
        if kind == "char*" and own == "buffer":
            return self._out(kind, ctypes.create_string_buffer(64))
        if own == "size":
            return 64
        if own in INDEX or own == "struct_size":
            return 0
        raise AssertionError(f"{self.name}: nobody knows a good value of {kind} {own}")

    def run(self):
        """A text that differs where results do, and whether the call refused its arguments or gave nothing."""
        before = set(pathlib.Path(".").rglob("*"))
        result = getattr(self.lib.c, self.name)(*self.values.values())
        if self.result == "terrane_code" and self.name != "terrane_error_code":
            refused = result != 0
        else:
            refused = result in (None, 0, b"", b"unknown") or isinstance(result, float) and math.isnan(result)
        texts = [str(result) if not isinstance(result, int) or "*" not in self.result else self.lib.read(self.name, result, self.outs)]
        for kind, made in self.outs:
            texts.append(self.lib.text_of(kind, made))
        if self.given and self.given[0][0] == "terrane_surfaces*" and not self.name.endswith("_free"):  # it was changed
            texts.append(self.lib.text_of_handle("terrane_surfaces", self.first))
        for path in sorted(set(pathlib.Path(".").rglob("*")) - before, reverse=True):  # what is inside comes first
            texts.append(f"{path} {hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else ''}")
            path.rmdir() if path.is_dir() else path.unlink()
        return " ".join(texts), refused


def nonsense_of(kind, own):
    """(label, function that puts a bad value into a call) of an argument."""
    base = re.sub(r"^const |\*.*$", "", kind).strip()

    def put(value):
        def change(c):
            c.values[own] = value(c) if callable(value) else value
        return change

    if base in HANDLES and "**" not in kind:
        other = "terrane_run" if base != "terrane_run" else "terrane_surfaces"
        yield "null", put(None)
        yield "another type", put(lambda c: c.lib.handle(other))
        yield "an error", put(lambda c: c.lib.handle("terrane_error" if base != "terrane_error" else "terrane_mesh"))
        yield "no handle", put(lambda c: c.lib.array(ctypes.c_uint64, [1, 2, 3, 4]))
    elif base in STRUCTS and kind.startswith("const"):
        yield "null", put(None)
        yield from nonsense_of_struct(base, own)
    elif "*" in kind or kind in ("terrane_progress", "terrane_timing"):
        if kind not in ("terrane_progress", "terrane_timing", "void*"):
            yield "null", put(None)
        if kind == "const double*":
            for label, bad in (("nan", math.nan), ("inf", math.inf), ("huge", 1e308)):
                yield label, put(lambda c, bad=bad: c.lib.array(ctypes.c_double, [bad] * 15))
        if kind == "const uint32_t*":
            yield "no such index", put(lambda c: c.lib.array(ctypes.c_uint32, [0xffffffff] * 9))
        if kind == "const char*":
            for label, bad in (("nonsense", b"nonsense\x01"), ("empty", b""), ("no UTF-8", b"\xff\xfe"), ("long", b"x" * 70000)):
                yield label, put(lambda c, bad=bad: c.lib.text(bad))
    elif kind == "double":
        for bad in (math.nan, math.inf, -math.inf, -1.0, 1e308):
            yield str(bad), put(bad)
    elif own in INDEX:
        for bad in (77, -1, -2**31) if NUMBERS[kind] is not ctypes.c_size_t else (77, 2**64 - 1, 2**32):
            yield str(bad), put(bad)
    elif own == "struct_size":
        for bad in (0, 2**63, 4096):
            yield str(bad), put(bad)
    elif own in ("corner_count", "vertex_count", "triangle_count", "boundary_count", "point_count", "layer_count", "task_count",
                 "tetrahedron_count"):
        pointer = {"vertex_count": "vertices", "triangle_count": "triangles", "tetrahedron_count": "tetrahedra", "point_count": "points", "boundary_count": "boundary",
                   "layer_count": "layers", "task_count": "tasks", "corner_count": "corners"}[own]
        yield "0", put(0)
        for bad in (5, 2**61, 2**64 - 1):
            def without(c, bad=bad):
                c.values[own], c.values[pointer] = bad, None
            yield f"{bad} of null", without


#: Arrays whose name is not that of their count with an s.
ARRAY_OF = {f"{name}_count": name for name in ("growth", "edge_length_of", "size_of", "size_in", "split")} | {"unit_count": "column"}


def of_null(put, count):
    """Puts a count; an array of the struct that is there, whose length it is, becomes null."""
    def change(c):
        put(count)(c)
        put(count, array=True)(c)
    return change


def nonsense_of_struct(base, own, inside=()):
    """The same for the members of a struct of options."""
    for member, kind, length in STRUCTS[base].members:
        place = (*inside, member)

        def put(value, place=place, length=length, array=False):
            def change(c):
                struct = functools.reduce(getattr, place[:-1], c.structs[own])
                if array:
                    name = ARRAY_OF.get(place[-1], place[-1].removesuffix("_count") + "s")
                    if hasattr(struct, name):
                        setattr(struct, name, None)
                    return
                made = value(c) if callable(value) else value
                if length:
                    getattr(struct, place[-1])[0] = made
                else:
                    setattr(struct, place[-1], made)
            return change

        label = ".".join(place)
        if kind == "double":
            for bad in (math.nan, math.inf, -math.inf, -1.5, 1e308):
                yield f"{label}: {bad}", put(bad)
        elif kind in STRUCTS:
            yield from nonsense_of_struct(kind, own, place)
        elif "*" in kind:
            if kind == "const char*":
                for bad in (b"nonsense", b"", b"\xff"):
                    yield f"{label}: {bad}", put(lambda c, bad=bad: c.lib.text(bad))
            elif kind.removeprefix("const ").rstrip("*") in HANDLES:
                yield f"{label}: null", put(None)
                yield f"{label}: no handle", put(lambda c: c.lib.array(ctypes.c_uint64, [1, 2, 3, 4]))
                yield f"{label}: another type", put(lambda c: c.lib.handle("terrane_run"))
        elif member == "struct_size":
            for bad in (0, 7, 4096, 2**63):
                yield f"{label}: {bad}", put(bad)
        elif member.endswith("_count"):
            for bad in (5, 2**61, 2**64 - 1):
                yield f"{label}: {bad}", of_null(put, bad)
        elif kind in NUMBERS and kind not in ("size_t",):
            if member not in FLAGS:
                yield f"{label}: -7", put(-7)
                yield f"{label}: {2**31 - 1}", put(2**31 - 1)


def usual(call, own, label):
    """Whether such a value may mean what no value means."""
    member = label.split(":")[0].split(".")[-1] if ":" in label else own
    bad = label.split(": ")[-1]
    if member in FREE or (call.name, member) in OTHERS or bad == "null" and member in MAY_BE_NULL or bad == "null" and own == "options":
        return True
    if bad in ("b''",) and member in MAY_BE_NULL:
        return True
    if (member, bad) == ("smoothing", "nan"):
        return True  # none
    far = bad in LARGE or bad == "-7" and member in ("max_rounds", "rings")  # which have no sign
    return member in LIMITS and far or member in DEFAULT_BELOW_0 and bad.startswith("-")


def try_one(lib, name, own, label):
    """What is wrong about one call; a good one, if no argument is named."""
    if own == "" or name not in lib.bases:
        call = Call(lib, name)
        lib.bases[name] = call.run()
    base, refused = lib.bases[name]
    if own == "":
        return "good arguments are refused" if refused and call.result == "terrane_code" and name != "terrane_error_code" else None
    changed = Call(lib, name)
    good = changed.values[own]
    kinds = dict((o, k) for k, o in changed.given)
    dict(nonsense_of(kinds[own], own))[label](changed)
    found, refused_now = changed.run()
    if refused_now or found != base or usual(changed, own, label) or label == "null" and good is None:
        return None
    return "it is ignored"


def work_list(options):
    draw = random.Random(options.seed)
    work = []
    for name in sorted(FUNCTIONS):
        if options.only and not name.startswith(options.only):
            continue
        work.append((name, "", ""))
        for kind, own in FUNCTIONS[name][1]:
            work += [(name, own, label) for label, _ in nonsense_of(kind, own)
                     if draw.random() < options.share or label in ("null", "no handle")]
    return work


def child(options):
    """Make the calls."""
    lib = Library(options.library)
    work = work_list(options)
    draw = random.Random(options.seed + options.begin)
    return make_calls(options, work, lambda: draw.choice(work), lambda *call: try_one(lib, *call))


def main():
    parser = parse(__doc__, 0.1)
    parser.add_argument("--library", required=True)
    options = parser.parse_args()
    if options.begin >= 0:
        return child(options)
    library = os.path.abspath(options.library)
    return conclude(*supervise(__file__, options, [f"--library={library}"]))


if __name__ == "__main__":
    sys.exit(main())
