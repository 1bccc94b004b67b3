# SPDX-License-Identifier: LGPL-3.0-or-later
"""The C interface as ctypes has it, from its headers, and a handle of each type."""

import ctypes
import functools
import hashlib
import pathlib
import shutil
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / "capi"))
import check_abi  # noqa: E402

DATA = HERE.parent.parent / "docs" / "data"
NUMBERS = {"double": ctypes.c_double, "int": ctypes.c_int, "int32_t": ctypes.c_int32, "uint32_t": ctypes.c_uint32,
           "uint64_t": ctypes.c_uint64, "size_t": ctypes.c_size_t, "unsigned": ctypes.c_uint, "terrane_code": ctypes.c_int32,
           "terrane_role": ctypes.c_int32, "terrane_mesher": ctypes.c_int32, "terrane_structure_list": ctypes.c_int32,
           "terrane_operation": ctypes.c_int32, "terrane_property_verdict": ctypes.c_int32,
           "terrane_inside_rule": ctypes.c_int32}
#: Members without a default.
NEEDED = {"terrane_seal_options": {"distance": 0.2}, "terrane_simplify_options": {"resolution": 0.5}}


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
            "terrane_selected": lambda: self.make("terrane_select", self.boxed, self.text("top & east(F1)"), None, None),
            "terrane_tetrahedra": lambda: self.make("terrane_tetrahedralize", h("terrane_model"), None, None),
            "terrane_verdict": lambda: self.make_verdict(),
            "terrane_mesh_judgement": lambda: self.make("terrane_judge", self.boxed, self.boxed, None, None),
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

    def improved_simplified(self):
        return self.make("terrane_improve", self.c.terrane_simplified_mesh(self.handle("terrane_simplified")), None, None)

    def project_file(self):
        path = pathlib.Path("project.json").absolute()
        path.write_text(PROJECT.replace("top.ts", str(DATA / "top.ts")))
        return str(path)

    def certified(self):
        """What a certificate is about: a file, its surfaces, and the rounded mesh that was written."""
        surfaces, error = self.make("terrane_surfaces_new"), ctypes.c_void_p()
        shutil.copy(DATA / "top.ts", "top.ts")  # a certificate is about files in its folder
        path = self.text("top.ts")
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
