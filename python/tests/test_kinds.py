# SPDX-License-Identifier: LGPL-3.0-or-later
"""Each argument of each public function and method, given as a value of another kind."""

import inspect

import pytest

import terrane
from conftest import BOX, HAS_TETGEN, sheet, stack
from test_results import MAKE, holed, project

MESH = {"save": ("s.vtp",), "quality": (), "split": ()}
# Arguments with which a function, or a method of a result, works.
FUNCTIONS = {
    "Surface": ([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]), "IndexLists": ([0, 1], [5]), "arrange": (stack(),), "round": (MAKE["Arrangement"](),),
    "as_surface": (sheet(),), "as_surfaces": (stack(),), "box": ((0, 0, 0), (1, 1, 1)), "build": None, "check": (stack(),),
    "closed": (terrane.box((0, 0, 0), (1, 1, 1)),), "distance": (sheet(), sheet(z=1.0)), "extend": (stack(), terrane.box(*BOX), 1.0),
    "fill": (holed(),), "holes": (holed(),), "improve": (MAKE["RoundedMesh"](), 3.0), "layers": (stack(), {"top": 1, "base": 2}), "mesh": (stack(),),
    "model": (stack(), BOX), "polygon": ([[0, 0], [2, 0], [0, 2]], -1, 1), "read": None, "regions": (MAKE["RoundedMesh"](),),
    "rotated_box": ((0, 0, 0), (1, 1, 1)), "save": (stack(), "s.obj"), "seal": (stack(), 0.1), "structure": (MAKE["RoundedMesh"](),),
    "suggest_seal": (stack(),), "volume_of_interest": (stack(), BOX), "volumes": (MAKE["RoundedMesh"](),),
}
METHODS = {
    "Surface": {"save": ("s.obj",), "replace": ()}, "Mesh": MESH, "RoundedMesh": {"save": ("s.vtp",)}, "Layered": {"save": ("s.vtp",), "surfaces": ()},
    "Improved": {"save": ("s.vtp",)}, "Filled": {"save": ("s.ts",), "report": ("s.html",)}, "IndexLists": {"contain": (1,), "__getitem__": (0,)},
    "Arrangement": {"coordinates": (0,), "construction": (0,), "digest": (), "report": ("s.html",)},
    "Volumes": {"exact": (), "points": (), "locate": ([[1, 1, 1]],)},
    "Model": {"block_of": ([[1, 1, 1]],), "names_of": ([[1, 1, 1]],), "improved": (3.0,), "save": ("folder",), "report": ("s.html",)},
    "Built": {"save": ("built",)},
}
if HAS_TETGEN:
    METHODS["Model"]["tetrahedra"] = ()
    METHODS["Tetrahedra"] = {"save": ("s.vtu",), "of_block": (1,), "shape": (), "report": ("s.html",)}
    FUNCTIONS["tetrahedralize"] = (terrane.model(terrane.box((0, 0, 0), (1, 2, 3))),)
OTHERS = {"ensemble", "verify", "keep_freed_memory", "tetrahedralize"}  # other files; without arguments; without TetGen
KINDS = {"None": None, "dict": {"a": 1}, "str": "abc", "bytes": b"abc", "object": object(), "list": [None], "number": 10**400, "nested": [[[]]]}
# Texts that are one of all texts, and functions that get any options.
ANY_TEXT = {"name", "path", "folder", "project", "result", "helper", "gmsh_helper", "place"}


def arguments_of(function):
    """Return the names of the arguments of a function."""
    return [name for name, p in inspect.signature(function).parameters.items()
            if name != "self" and p.kind not in (p.VAR_KEYWORD, p.VAR_POSITIONAL)]


def calls():
    """Return (label, function, arguments, name of the argument) for each argument."""
    for name, given in FUNCTIONS.items():
        function = getattr(terrane, name)
        yield from ((f"{name}({argument})", None, name, given, argument) for argument in arguments_of(function))
    for kind, methods in METHODS.items():
        for name, given in methods.items():
            function = getattr(getattr(terrane, kind), name)
            yield from ((f"{kind}.{name}({argument})", kind, name, given, argument) for argument in arguments_of(function))


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """The results that have methods, made once."""
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(tmp_path_factory.mktemp("kinds"))
        yield {**{kind: MAKE[kind]() for kind in METHODS if kind != "Surface"}, "Surface": sheet()}


def test_all_functions_are_here():
    public = {n for n in terrane.__all__ if inspect.isfunction(getattr(terrane, n))}
    assert public - OTHERS == set(FUNCTIONS) - {"Surface", "IndexLists", "tetrahedralize"}


@pytest.mark.parametrize("kind, name, given, argument", [pytest.param(*c[1:], id=c[0]) for c in calls()])
def test_each_argument_of_another_kind(results, kind, name, given, argument):
    function = getattr(results[kind] if kind else terrane, name)
    if given is None:
        sheet().save("s.ts")
        given = ("s.ts",) if name == "read" else (project(),)
    position = arguments_of(function).index(argument)
    for label, value in KINDS.items():
        arguments, named = list(given), {}
        if position < len(arguments):
            arguments[position] = value
        else:
            named[argument] = value
        try:
            function(*arguments, **named)
        except (TypeError, ValueError, terrane.Error) as error:
            for words in ("incompatible function arguments", "Unable to cast", "another type than it must have"):
                assert words not in str(error), f"{label}: {error}"
        except IndexError:
            assert name == "__getitem__"
        else:
            assert label not in ("object", "number") and (label != "nested" or name == "read"), f"{label} is taken"
            if label in ("str", "bytes"):
                assert argument in ANY_TEXT, f"{label} is taken"


@pytest.mark.parametrize("order", [["top"], [("top",)], [("top", 1, 2)], "top", {"top"}])
def test_what_is_no_order_is_refused(order):
    with pytest.raises(TypeError, match="order"):
        terrane.layers(stack(), order)
