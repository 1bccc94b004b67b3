# SPDX-License-Identifier: LGPL-3.0-or-later
"""Docstrings, their examples, and types."""

import contextlib
import doctest
import importlib
import importlib.util
import inspect
import io
import os
import pathlib
import pkgutil
import re
import shutil
import subprocess
import sys

import pytest

import terrane
from conftest import HAS_TETGEN, SANITIZED

MODULES = [m.name for m in pkgutil.iter_modules(terrane.__path__) if m.name not in ("_core", "accessor")]  # which needs PyVista
PUBLIC = [(name, getattr(terrane, name)) for name in terrane.__all__]
FUNCTIONS = [(n, f) for n, f in PUBLIC if inspect.isfunction(f)]
CLASSES = [(n, c) for n, c in PUBLIC if inspect.isclass(c)]
MEMBERS = [(f"{n}.{k}", v) for n, c in CLASSES for k, v in vars(c).items() if not k.startswith("_")
           and (inspect.isfunction(v) or isinstance(v, property))]


def examples():
    """Return (name, example) of all docstrings."""
    finder = doctest.DocTestFinder(exclude_empty=True)
    for name in MODULES:
        module = importlib.import_module("terrane." + name)
        for test in finder.find(module):
            if test.examples:
                yield test


@pytest.mark.parametrize("test", examples(), ids=lambda t: t.name)
def test_examples(test, pyvista):
    """Each example runs on its own, as one pastes it into a new interpreter in an empty folder.

    PyVista is the stand-in of conftest.py: pictures are not drawn.
    """
    source = "".join(example.source for example in test.examples)
    if re.search(r"tetrahedra(lize)?\(", source) and not HAS_TETGEN:
        pytest.skip("no terrane-tetgen")
    if "to_meshio" in source:
        pytest.importorskip("meshio")
    test.globs = {"__name__": "__main__"}  # not the names of the module that the docstring is in
    out = []
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    runner.run(test, out=out.append)
    assert runner.failures == 0, "".join(out)
    assert not any(doctest.SKIP in example.options for example in test.examples), "an example that is not run"


@pytest.mark.parametrize("name, function", FUNCTIONS, ids=lambda v: v if isinstance(v, str) else "")
def test_functions_are_documented(name, function):
    text = inspect.getdoc(function)
    assert text and text.splitlines()[0].endswith((".", ":")), "a sentence first"
    assert ">>> " in text, "an example"
    for parameter in inspect.signature(function).parameters.values():
        if parameter.name not in ("threads", "progress") and "Parameters\n" in text:
            assert re.search(rf"\b{parameter.name}\b", text), parameter.name


@pytest.mark.parametrize("name, value", CLASSES + MEMBERS, ids=lambda v: v if isinstance(v, str) else "")
def test_classes_and_members_are_documented(name, value):
    text = inspect.getdoc(value)
    assert text, name
    assert ">>> " in text or isinstance(value, property), "an example"


def test_all_is_all():
    named = {n for n in vars(terrane) if not n.startswith("_")}
    modules = {n for n in named if inspect.ismodule(getattr(terrane, n))}
    assert named - modules == set(terrane.__all__)
    assert list(terrane.__all__) == sorted(terrane.__all__)


def test_codes_are_those_of_the_library():
    header = pathlib.Path(__file__).parents[2] / "algorithms/core/result.hpp"
    body = re.search(r"enum class ErrorCode \{(.*?)\};", header.read_text(), re.S).group(1)
    assert tuple(re.findall(r"^\s*(\w+),", body, re.M)) == terrane.ERROR_CODES


def test_the_reference_is_that_of_the_docstrings():
    root = pathlib.Path(__file__).parents[2]
    spec = importlib.util.spec_from_file_location("reference", root / "python/reference.py")
    reference = importlib.util.module_from_spec(spec)
    path = list(sys.path)
    spec.loader.exec_module(reference)
    sys.path[:] = path
    listed = [n for _, names in reference.GROUPS for n in names.split()]
    assert sorted(listed) == sorted(terrane.__all__)
    assert (root / "docs/reference/python.md").read_text() == reference.page()


def test_the_page_s_examples():
    """The examples of docs/how-to/python.md run, and the first one prints what the page says."""
    text = (pathlib.Path(__file__).parents[2] / "docs/how-to/python.md").read_text()
    blocks = re.findall(r"```(python|text)\n(.*?)```", text, re.S)
    values, printed = {}, ""
    for i, (kind, block) in enumerate(blocks):
        if not terrane.HAS_REPORTS:
            block = re.sub(r".*\.report\(.*\n", "", block)
        if kind == "text":
            assert printed == block
        elif "tetrahedra(" not in block or HAS_TETGEN:
            out = io.StringIO()
            with contextlib.redirect_stdout(out):
                exec(compile(block, f"block {i}", "exec"), values)
            printed = out.getvalue()
    assert len(blocks) >= 5


@pytest.mark.skipif(SANITIZED, reason="texts are the same in every build")
def test_types():
    """mypy --strict finds nothing wrong in the package, with the stubs of the module."""
    if shutil.which("mypy") is None:
        pytest.skip("mypy is not installed")
    folder = pathlib.Path(terrane.__file__).parent
    if not (folder / "_core.pyi").exists():
        pytest.skip("this build has no stubs")
    done = subprocess.run(["mypy", "--strict", "--no-warn-unused-ignores", "--cache-dir", os.devnull, "-p", "terrane"],
                          capture_output=True, text=True, cwd=folder.parent,
                          env={**os.environ, "MYPYPATH": str(folder.parent)})
    assert done.returncode == 0, done.stdout


@pytest.mark.skipif(SANITIZED, reason="texts are the same in every build")
def test_stubs_are_of_this_module():
    """Each name of the module is in the stubs."""
    from terrane import _core
    path = pathlib.Path(terrane.__file__).parent / "_core.pyi"
    if not path.exists():
        pytest.skip("this build has no stubs")
    text = path.read_text()
    for name in vars(_core):
        if not name.startswith("_"):
            assert re.search(rf"^(class|def) {name}\b|^{name}:", text, re.M), name


def test_types_of_users():
    """What a user writes is checked."""
    if shutil.which("mypy") is None or SANITIZED:
        pytest.skip("mypy is not installed")
    folder = pathlib.Path(terrane.__file__).parent
    if not (folder / "_core.pyi").exists():
        pytest.skip("this build has no stubs")
    with open("user.py", "w") as file:
        file.write("import terrane\nm = terrane.model([])\nx: float = m.blocks['a'].volume\n"
                   "y: str = m.blocks['a'].volume\nterrane.arrange([], speed=3)\n")
    done = subprocess.run(["mypy", "--cache-dir", os.devnull, "user.py"], capture_output=True, text=True,
                          env={**os.environ, "MYPYPATH": str(folder.parent)})
    lines = done.stdout.splitlines()
    assert [line.split(":")[1] for line in lines if ": error:" in line] == ["4", "5"], done.stdout
