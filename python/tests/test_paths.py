# SPDX-License-Identifier: LGPL-3.0-or-later
"""Paths of all functions that take one."""

import os
import pathlib

import pytest

import terrane
from conftest import BOX, DATA, stack

PROJECT = {"format": "terrane-project 1", "surfaces": [{"file": str(DATA / "top.ts")}], "outputs": {"surfaces": ["obj"]}}


def holed():
    """Return a surface with a hole."""
    v = [(x, y, 0.1 * x) for x in range(5) for y in range(5)]
    cells = [5 * x + y for x in range(4) for y in range(4) if (x, y) != (2, 2)]
    return terrane.Surface(v, [t for a in cells for t in ((a, a + 5, a + 6), (a, a + 6, a + 1))], "holed")


# What is called with a path that ends in the extension.
TAKES_PATH = {
    "read": ("ts", terrane.read),
    "read of several": ("ts", lambda p: terrane.read([DATA / "top.ts", p])),
    "save": ("ts", lambda p: terrane.save(stack(), p)),
    "Surface.save": ("obj", lambda p: stack()[0].save(p)),
    "Mesh.save": ("vtp", lambda p: terrane.mesh(stack()).save(p)),
    "RoundedMesh.save": ("vtp", lambda p: terrane.round(terrane.arrange(stack())).save(p)),
    "Layered.save": ("vtp", lambda p: terrane.layers(stack()[:1], {"top": 1}).save(p)),
    "Filled.save": ("ts", lambda p: terrane.fill(holed()).save(p)),
    "Model.save": ("", lambda p: terrane.model(stack(), box=BOX).save(p)),
    "build": ("json", terrane.build),
    "build in a folder": ("", lambda p: terrane.build(PROJECT, folder=p)),
    "Built.save": ("", lambda p: terrane.build(PROJECT).save(p)),
    "verify": ("json", lambda p: terrane.verify(p if isinstance(p, pathlib.Path) else os.fsdecode(p))),
}
if terrane.HAS_REPORTS:
    TAKES_PATH.update({
        "Arrangement.report": ("html", lambda p: terrane.arrange(stack()).report(p)),
        "Model.report": ("html", lambda p: terrane.model(stack(), box=BOX).report(p)),
        "Filled.report": ("html", lambda p: terrane.fill(holed()).report(p)),
    })


@pytest.mark.parametrize("kind", [str, pathlib.Path, os.fsencode])
@pytest.mark.parametrize("function", TAKES_PATH)
def test_nul_in_a_path_is_refused_as_open_does(function, kind):
    """The system would take the part before it for the path."""
    extension, call = TAKES_PATH[function]
    open("a", "w").write("untouched")
    before = sorted(os.listdir("."))
    with pytest.raises(ValueError, match="embedded null"):
        call(kind("a\0b." + extension))
    assert sorted(os.listdir(".")) == before and open("a").read() == "untouched"


@pytest.mark.tetgen
@pytest.mark.parametrize("call", [lambda p: terrane.model(terrane.box((0, 0, 0), (1, 1, 1))).tetrahedra().save(p),
                                  lambda p: terrane.model(terrane.box((0, 0, 0), (1, 1, 1))).tetrahedra(helper=p)])
def test_nul_in_a_path_of_tetrahedra_is_refused(call):
    with pytest.raises(ValueError, match="embedded null"):
        call("a\0b.vtu")


@pytest.mark.parametrize("path", [None, 3, {}, object()])
@pytest.mark.parametrize("function", TAKES_PATH)
def test_what_is_no_path_is_refused(function, path):
    if path in (None, {}) and function in ("Built.save", "build", "build in a folder"):
        return  # None is no folder at all, {} a project
    with pytest.raises((TypeError, terrane.Error)) as raised:
        TAKES_PATH[function][1](path)
    assert "incompatible function arguments" not in str(raised.value)


def test_bytes_are_paths():
    terrane.save(stack(), b"all.obj")
    assert len(terrane.read(b"all.obj")) == len(terrane.read(pathlib.Path("all.obj"))) == len(stack())
