# SPDX-License-Identifier: LGPL-3.0-or-later
"""The wheel, and what pip needs."""

import base64
import hashlib
import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import zipfile

import pytest

import terrane
from conftest import SANITIZED, SOURCE, run_python

PACKAGE = pathlib.Path(terrane.__file__).parent


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """A wheel of the package under test."""
    if SANITIZED:
        pytest.skip("an instrumented module is not packed")
    to = tmp_path_factory.mktemp("wheel")
    helpers = sorted((PACKAGE / "_libexec").glob("terrane-*")) if (PACKAGE / "_libexec").exists() else []
    done = subprocess.run([sys.executable, SOURCE / "python/make_wheel.py", "--package", PACKAGE, "--version",
                           terrane.__version__, "--source", SOURCE, "--to", to, "--helpers", *helpers],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return pathlib.Path(done.stdout.strip())


def test_record_lists_all_files_with_their_hashes(wheel):
    with zipfile.ZipFile(wheel) as archive:
        record = next(n for n in archive.namelist() if n.endswith("RECORD"))
        rows = [line.split(",") for line in archive.read(record).decode().splitlines()]
        assert sorted(row[0] for row in rows) == sorted(archive.namelist())
        for name, digest, size in rows:
            if name == record:
                continue
            data = archive.read(name)
            assert digest == "sha256=" + base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            assert int(size) == len(data)
        names = set(archive.namelist())
        assert {"terrane/py.typed", "terrane/_core.pyi", "terrane/__init__.py"} <= names
        assert any(n.startswith("terrane/_core.") and n.endswith(".so") for n in names)
        assert sum("licenses/" in n for n in names) == 3


def test_the_same_bytes_each_time(wheel, tmp_path):
    first = wheel.read_bytes()
    helpers = sorted((PACKAGE / "_libexec").glob("terrane-*"))
    subprocess.run([sys.executable, SOURCE / "python/make_wheel.py", "--package", PACKAGE, "--version",
                    terrane.__version__, "--source", SOURCE, "--to", tmp_path, "--helpers", *helpers], check=True,
                   stdout=subprocess.DEVNULL)
    assert (tmp_path / wheel.name).read_bytes() == first


def test_pip_installs_it_without_a_network(wheel, tmp_path):
    if importlib.util.find_spec("pip") is None:
        pytest.skip("pip is not installed")
    done = subprocess.run([sys.executable, "-m", "pip", "install", "--no-index", "--no-deps", "--target",
                           tmp_path / "site", wheel], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    code = """
import sys, terrane
assert terrane.__file__.startswith(sys.argv[1]), terrane.__file__
m = terrane.model(terrane.box((0, 0, 0), (1, 1, 1)))
print(len(m.blocks), "blocks")
if sys.argv[2] == "True":
    print(len(m.tetrahedra().tetrahedra) > 0)
"""
    env = {k: v for k, v in os.environ.items() if not k.startswith(("TERRANE_", "PYTHONPATH"))}
    has = (PACKAGE / "_libexec" / "terrane-tetgen").exists()
    out = run_python(code, tmp_path, has, env={**env, "PYTHONPATH": str(tmp_path / "site")}).stdout
    assert out == "1 blocks\n" + ("True\n" if has else "")


def test_versions_are_one():
    project = (SOURCE / "pyproject.toml").read_text()
    assert re.search(r'^version = "(.*)"', project, re.M).group(1) == terrane.__version__
    cmake = (SOURCE / "CMakeLists.txt").read_text()
    assert re.search(r"project\(terrane VERSION (\S+)", cmake).group(1) == terrane.__version__


def test_the_build_backend_needs_no_packages():
    spec = importlib.util.spec_from_file_location("backend", SOURCE / "python/build_backend/terrane_build.py")
    backend = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(backend)
    assert backend.get_requires_for_build_wheel() == []
    assert backend.SOURCE == str(SOURCE)
    assert 'requires = []' in (SOURCE / "pyproject.toml").read_text()


def test_the_module_exports_nothing_but_itself():
    if SANITIZED:
        pytest.skip("the sanitizer exports its own")
    from terrane import _core
    done = subprocess.run(["nm", "-D", "--defined-only", _core.__file__], capture_output=True, text=True)
    names = [line.split()[-1] for line in done.stdout.splitlines()]
    assert "PyInit__core" in names
    assert not [n for n in names if "terrane" in n], "symbols that another copy of the library would meet"
