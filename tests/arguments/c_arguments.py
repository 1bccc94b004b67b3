#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Calls each function of the C interface with each argument, and each member of each struct, at values that make no sense.

    tests/arguments/c_arguments.py --library LIBTERRANE_C.so [--share S] [--seconds S] [--seed N] [--only NAME]

The functions, their arguments, structs and members are those of the headers. (1) Each can be called: for a new type of
argument it must be said here what a good one is. (2) A value that makes no sense is an error, or it changes the result:
none is ignored; getters return nothing for it. No call crashes.

--share tries such a share of the values, drawn by --seed. --seconds goes on with random combinations for so long.
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

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / "capi"))
import check_abi  # noqa: E402
from trials import conclude, make_calls, parse, supervise  # noqa: E402

DATA = HERE.parent.parent / "docs" / "data"
NUMBERS = {"double": ctypes.c_double, "int": ctypes.c_int, "int32_t": ctypes.c_int32, "uint32_t": ctypes.c_uint32,
           "uint64_t": ctypes.c_uint64, "size_t": ctypes.c_size_t, "unsigned": ctypes.c_uint, "terrane_code": ctypes.c_int32,
           "terrane_role": ctypes.c_int32, "terrane_mesher": ctypes.c_int32, "terrane_structure_list": ctypes.c_int32}
#: Members and arguments that may be anything, and what may be null, with the reason.
FREE = {"user": "it is passed on", "name": "a name may be any text", "source": "it is only named in messages",
        "helper": "it is looked for where tetrahedra are made", "gmsh_helper": "likewise"}
MAY_BE_NULL = {"run", "error", "count", "length", "options", "search", "format", "unit", "variogram", "progress", "timing", "folder",
               "part_format", "helper", "gmsh_helper", "vertex_count", "triangle_count", "surface_count", "face_count",
               "region_count", "column", "improved", "rules", "size_of", "size_in", "split", "inputs", "edge_length_of", "merged",
               "surfaces_or_null", "holes", "layered", "layers", "growth", "volume_files", "model_folder", "tetrahedra", "model"}
#: Members without a default.
NEEDED = {"terrane_seal_options": {"distance": 0.2}, "terrane_simplify_options": {"resolution": 0.01}}
#: Limits, which a number may exceed so far that nothing reaches them.
LIMITS = {"limit", "max_area", "max_move", "max_rounds", "max_deviation", "max_change", "max_volume", "max_volume_change", "time_limit",
          "max_triangles", "max_edge", "gap_slope", "curve_length", "growth", "smallest", "thickness_share", "rings"}
LARGE = {"inf", "1e+308", "2147483647"}
#: Members that are of another function, which takes the same struct.
OTHERS = {("terrane_find_holes", member) for member in ("use_rbf", "mesh_size", "rings", "is_isotropic", "variogram", "smoothing")}
#: A negative number stands for the default.
DEFAULT_BELOW_0 = {"max_move", "max_deviation", "max_change", "smoothing"}


def struct_members(body):
    """(name, type, length of the array or 0) of the members of a struct."""
    for text in body.split(";"):
        found = re.match(r"\s*(.*?)(\w+)(?:\[(\d+)\])?\s*$", text, re.S)
        if found and found[1].strip():
            yield found[2], re.sub(r"\s+", " ", found[1]).strip(), int(found[3] or 0)


def read_structs():
    """Structs of the headers as ctypes has them."""
    found = {}
    for header in check_abi.HEADERS:
        for name, body in re.findall(r"^typedef struct (\w+) \{(.*?)^\} \1;", check_abi.bare(header), re.M | re.S):
            members = list(struct_members(body))
            fields = []
            for member, kind, length in members:
                one = ctypes.c_void_p if "*" in kind else NUMBERS.get(kind) or found[kind]
                fields.append((member, one * length if length else one))
            found[name] = type(name, (ctypes.Structure,), {"_fields_": fields, "members": members})
    return found


def read_functions():
    """(type of the result, [(type, name)]) of the functions of the headers."""
    found = {}
    for name, text in check_abi.functions().items():
        result, inside = re.match(rf"(.*?)\b{name}\((.*)\)$", text).groups()
        given = []
        for part in [] if inside == "void" else inside.split(","):
            kind, own, length = re.match(r"\s*(.*?)(\w+)(\[\d+\])?$", part).groups()
            given.append((kind.strip() + ("*" if length else ""), own))
        found[name] = (result.strip(), given)
    return found


# Structs are needed before a member's type can name one: the headers are read until all are known.
check_abi.HEADERS.sort(key=lambda h: ["base.h", "surfaces.h", "arrangement.h", "mesh.h"].index(h.name)
                       if h.name in ("base.h", "surfaces.h", "arrangement.h", "mesh.h") else 9)
STRUCTS = read_structs()
FUNCTIONS = read_functions()
HANDLES = {m[1] for _, given in FUNCTIONS.values() for kind, _ in given
           if (m := re.match(r"(?:const )?(terrane_\w+)\s*\*+$", kind)) and m[1] not in STRUCTS and m[1] not in NUMBERS}


#: Members that are true for all numbers but 0.
FLAGS = {m for header in check_abi.HEADERS for m in re.findall(r"int32_t (\w+);\s*///<[^;]*?\bnot 0", header.read_text())}


class Library:
    """The library with its functions typed, and a handle of each type."""

    def __init__(self, path):
        self.c = ctypes.CDLL(path)
        self.kept, self.bases = [], {}
        for name, (result, given) in FUNCTIONS.items():
            call = getattr(self.c, name)
            call.restype = (None if result == "void" else ctypes.c_char_p if result == "const char*" else ctypes.c_void_p
                            if "*" in result else NUMBERS[result])
            call.argtypes = [ctypes.c_void_p if "*" in kind or kind in ("terrane_progress", "terrane_timing") else NUMBERS[kind]
                             for kind, _ in given]

    def make(self, name, *given):
        """Call a function whose last arguments are out and error; return what it makes."""
        out, error = ctypes.c_void_p(), ctypes.c_void_p()
        code = getattr(self.c, name)(*given, ctypes.addressof(out), ctypes.addressof(error))
        assert code == 0, (name, self.c.terrane_error_message(error))
        return out.value

    def options(self, name):
        """A struct of options with their defaults."""
        made = STRUCTS[name]()
        init = getattr(self.c, name + "_init", None)
        if init is not None:
            more = [0] if name == "terrane_fill_task" else []
            assert init(ctypes.addressof(made), ctypes.sizeof(made), *more) == 0
        for member, value in NEEDED.get(name, {}).items():
            setattr(made, member, value)
        self.kept.append(made)
        return made

    def array(self, kind, values):
        made = (kind * len(values))(*values)
        self.kept.append(made)
        return ctypes.addressof(made)

    def text(self, value):
        made = ctypes.create_string_buffer(value if isinstance(value, bytes) else value.encode())
        self.kept.append(made)
        return ctypes.addressof(made)

    def add(self, surfaces, name, vertices, triangles):
        error = ctypes.c_void_p()
        assert self.c.terrane_surfaces_add(
            surfaces, self.text(name), 1, self.array(ctypes.c_double, [x for v in vertices for x in v]), len(vertices),
            self.array(ctypes.c_uint32, [i for t in triangles for i in t]), len(triangles), ctypes.addressof(error)) == 0

    @functools.cached_property
    def boxed(self):
        return self.boxed_surfaces()

    def boxed_surfaces(self):
        """Two horizons and a fault in a box, whose faces are 3 to 8."""
        made = self.make("terrane_surfaces_new")
        for name, z in (("top", 1.0), ("base", -1.0)):
            self.add(made, name, [(0, 0, z), (10, 0, z), (10, 10, z), (0, 10, z)], [(0, 1, 2), (0, 2, 3)])
        self.add(made, "F1", [(5, -1, -9), (6, 11, -9), (5, 11, 9), (4, -1, 9)], [(0, 1, 2), (0, 2, 3)])
        box = self.make("terrane_box_boundary", self.array(ctypes.c_double, [0, 0, -4]), self.array(ctypes.c_double, [10, 10, 4]))
        assert self.c.terrane_surfaces_append(made, box, None) == 0
        return made

    @functools.cached_property
    def holed(self):
        """A grid of squares without the middle one."""
        made = self.make("terrane_surfaces_new")
        cells = [(a, a + 1, a + 7, a, a + 7, a + 6) for a in (6 * j + i for j in range(5) for i in range(5)) if a != 14]
        self.add(made, "holed", [(i, j, 0.1 * i * j) for j in range(6) for i in range(6)],
                 [t for c in cells for t in (c[:3], c[3:])])
        return made

    @functools.lru_cache(maxsize=None)
    def handle(self, kind):
        """A handle of a type."""
        return self.fresh(kind)

    def fresh(self, kind):
        """A handle that nobody else uses."""
        faces = self.array(ctypes.c_uint32, range(3, 9))
        h = self.handle
        options = {kind: ctypes.addressof(self.options(f"terrane_{kind}_options")) for kind in ("seal", "simplify")}
        layers = (STRUCTS["terrane_layer"] * 2)((0, 0, 1.0), (1, 0, 0.5))
        self.kept.append(layers)
        how = {
            "terrane_surfaces": lambda: self.boxed_surfaces(),
            "terrane_run": lambda: self.make("terrane_run_new"),
            "terrane_error": lambda: self.failure(),
            "terrane_check_report": lambda: self.make("terrane_check", self.boxed, None),
            "terrane_arrangement": lambda: self.make("terrane_arrange", self.boxed, None, None),
            "terrane_cut": lambda: self.make("terrane_cut_to_volume", h("terrane_arrangement"), faces, 6, None),
            "terrane_mesh": lambda: self.make("terrane_round", self.c.terrane_cut_arrangement(h("terrane_cut")), None, None),
            "terrane_regions": lambda: self.make("terrane_find_regions", h("terrane_mesh"), None),
            "terrane_improved": lambda: self.make("terrane_improve", h("terrane_mesh"), None, None),
            "terrane_simplified": lambda: self.make("terrane_simplify", h("terrane_mesh"), options["simplify"], None),
            "terrane_sealed": lambda: self.make("terrane_seal", self.boxed, options["seal"], None),
            "terrane_extended": lambda: self.make("terrane_extend_to_boundary", self.boxed, faces, 6, 1.0, None),
            "terrane_volumes": lambda: self.make("terrane_find_volumes", h("terrane_mesh"), None),
            "terrane_structure": lambda: self.make("terrane_build_structure", h("terrane_volumes")),
            "terrane_model": lambda: self.make("terrane_make_model", self.c.terrane_cut_arrangement(h("terrane_cut")),
                                               h("terrane_mesh"), None, None, None),
            "terrane_holes": lambda: self.make("terrane_find_holes", self.holed, ctypes.addressof(self.task), 1, None),
            "terrane_layered": lambda: self.make("terrane_stack_layers", self.boxed, ctypes.addressof(layers), 2, None, None),
            "terrane_tetrahedra": lambda: self.make("terrane_tetrahedralize", h("terrane_model"), None, None),
            "terrane_verdict": lambda: self.make_verdict(),
            "terrane_built": lambda: self.make("terrane_build", self.text(PROJECT), self.text(str(DATA)), None, None),
        }
        return how[kind]()

    @functools.cached_property
    def task(self):
        return self.options("terrane_fill_task")

    def make_verdict(self):
        """A verdict with a violation: two meshes that cross."""
        crossing = self.make("terrane_mesh_from_surfaces", self.boxed)
        return self.make("terrane_verify_mesh", crossing)

    def project_file(self):
        path = pathlib.Path("project.json").absolute()
        path.write_text(PROJECT.replace("top.ts", str(DATA / "top.ts")))
        return str(path)

    def certified(self):
        """What a certificate is about: a file, its surfaces, and the rounded mesh that was written."""
        surfaces, error = self.make("terrane_surfaces_new"), ctypes.c_void_p()
        path = self.text(str(DATA / "top.ts"))
        assert self.c.terrane_surfaces_read(surfaces, path, None, ctypes.addressof(error)) == 0
        arrangement = self.make("terrane_arrange", surfaces, None, None)
        rounded = self.make("terrane_round", arrangement, None, None)
        assert self.c.terrane_mesh_write(rounded, self.text("result.vtp"), None, ctypes.addressof(error)) == 0
        made = self.options("terrane_certified")
        made.inputs = self.array(STRUCTS["terrane_input_file"], [(path, 1)])
        made.outputs = self.array(STRUCTS["terrane_output_file"], [(self.text("result.vtp"), None)])
        made.input_count = made.output_count = 1
        made.surfaces, made.arrangement, made.rounded = surfaces, arrangement, rounded
        return made

    @functools.lru_cache(maxsize=None)
    def certificate(self):
        made, error = self.certified(), ctypes.c_void_p()
        code = self.c.terrane_write_certificate(self.text("stated.json"), ctypes.addressof(made), None, ctypes.addressof(error))
        assert code == 0, self.c.terrane_error_message(error)
        return "stated.json"

    def read(self, name, pointer, outs):
        """What a getter's pointer leads to: an array with its count, or a part of a handle."""
        base = re.sub(r"^const |\*.*$", "", FUNCTIONS[name][0]).strip()
        if base in HANDLES:
            return base
        count = next((o.value for k, o in outs if k == "size_t*"), 0)
        size = ctypes.sizeof(STRUCTS.get(base) or NUMBERS[base])
        return hashlib.sha256(ctypes.string_at(pointer, count * size)).hexdigest()

    def text_of(self, kind, made):
        """What an argument for results holds."""
        if kind == "terrane_error**":
            self.c.terrane_error_free(made)
            return ""
        if kind == "char**":
            text = ctypes.string_at(made.value) if made.value else b""
            self.c.terrane_text_free(made)
            return hashlib.sha256(text).hexdigest()
        if kind == "terrane_lists" and made.values:
            return f"{made.count} {hashlib.sha256(ctypes.string_at(made.offsets, 4 * made.count + 4)).hexdigest()}"
        if isinstance(made, ctypes.c_void_p):
            return self.text_of_handle(kind.rstrip("*"), made.value)
        return bytes(made).hex()

    def text_of_handle(self, kind, pointer):
        """What all getters of a new handle return, which is freed."""
        if not pointer:
            return ""
        texts = []
        for name, (result, given) in FUNCTIONS.items():
            kinds = [k for k, _ in given]
            if not kinds or kinds[0] != f"const {kind}*" or set(kinds[1:]) - {"size_t", "size_t*", "terrane_lists*"}:
                continue
            for index in (0, 1, 2):
                outs = [(k, ctypes.c_size_t() if k == "size_t*" else STRUCTS["terrane_lists"]()) for k in kinds[1:] if "*" in k]
                places = iter(outs)
                got = getattr(self.c, name)(pointer, *(index if k == "size_t" else ctypes.addressof(next(places)[1])
                                                       for k in kinds[1:]))
                texts.append(self.read(name, got, outs) if got and "*" in result and result != "const char*" else str(got))
                texts += [self.text_of("terrane_lists", o) for k, o in outs if k != "size_t*"]
                if "size_t" not in kinds:
                    break
        free = "terrane_" + kind.removeprefix("terrane_").removesuffix("_report") + "_free"
        getattr(self.c, free)(pointer)
        return hashlib.sha256(" ".join(texts).encode()).hexdigest()

    def failure(self):
        out, error = ctypes.c_void_p(), ctypes.c_void_p()
        self.c.terrane_arrange(None, None, None, ctypes.addressof(out), ctypes.addressof(error))
        return error.value


PROJECT = ('{"format": "terrane-project 1", "surfaces": [{"file": "top.ts"}], "outputs": {"blocks": "vtp"}, '
           '"volume_of_interest": {"box": {"low": [0, 0, -1700], "high": [2000, 1500, -700]}}}')

#: Good values of arguments that their types do not decide, by "function.argument" or by the name alone.
GOOD = {
    "terrane_surfaces_add.vertices": lambda lib: lib.array(ctypes.c_double, [0, 0, 0, 1, 0, 0, 0, 1, 0]),
    "terrane_surfaces_add.vertex_count": lambda lib: 3,
    "terrane_surfaces_add.triangles": lambda lib: lib.array(ctypes.c_uint32, [0, 1, 2]),
    "terrane_surfaces_add.triangle_count": lambda lib: 1,
    "terrane_surfaces_parse.contents": lambda lib: lib.text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
    "terrane_surfaces_parse.size": lambda lib: 32,
    "terrane_surfaces_parse.source": lambda lib: lib.text("one.obj"),
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
    "terrane_make_model.improved": lambda lib: None, "terrane_choose_seal.edge_length": lambda lib: 0.0,
    "terrane_box_boundary.low": lambda lib: lib.array(ctypes.c_double, [0, 0, 0]),
    "terrane_box_boundary.high": lambda lib: lib.array(ctypes.c_double, [1, 1, 1]),
    "terrane_volumes_exact.volume": lambda lib: 1,
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
INDEX = {"surface", "hole", "task", "block", "region", "violation", "vertex", "which", "kind", "reason", "axis", "role", "volume", "code"}


class Call:
    """A call with good arguments, of which some may be changed; what comes out is kept to be read."""

    def __init__(self, lib, name):
        self.lib, self.name = lib, name
        self.result, self.given = FUNCTIONS[name]
        self.outs, self.sizes, self.structs = [], {}, {}
        self.values = {own: self._good(kind, own) for kind, own in self.given}
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
                yield label, put(lambda c, bad=bad: c.lib.array(ctypes.c_double, [bad] * 9))
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
    elif own in ("corner_count", "vertex_count", "triangle_count", "boundary_count", "point_count", "layer_count", "task_count"):
        pointer = {"vertex_count": "vertices", "triangle_count": "triangles", "point_count": "points", "boundary_count": "boundary",
                   "layer_count": "layers", "task_count": "tasks", "corner_count": "corners"}[own]
        yield "0", put(0)
        for bad in (5, 2**61, 2**64 - 1):
            def without(c, bad=bad):
                c.values[own], c.values[pointer] = bad, None
            yield f"{bad} of null", without


def nonsense_of_struct(base, own, inside=()):
    """The same for the members of a struct of options."""
    for member, kind, length in STRUCTS[base].members:
        place = (*inside, member)

        def put(value, place=place, length=length):
            def change(c):
                struct = functools.reduce(getattr, place[:-1], c.structs[own])
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
            for bad in (5, 2**61, 2**64 - 1):  # of an array that is null
                yield f"{label}: {bad}", put(bad)
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
            work += [(name, own, label) for label, _ in nonsense_of(kind, own) if draw.random() < options.share]
    return work


def child(options):
    """Make the calls."""
    lib = Library(options.library)
    work = work_list(options)
    draw = random.Random(options.seed + options.begin)
    return make_calls(options, work, lambda: draw.choice(work), lambda *call: try_one(lib, *call))


def main():
    parser = parse(__doc__, 1.0)
    parser.add_argument("--library", required=True)
    options = parser.parse_args()
    if options.begin >= 0:
        return child(options)
    library = os.path.abspath(options.library)
    return conclude(*supervise(__file__, options, [f"--library={library}"]))


if __name__ == "__main__":
    sys.exit(main())
