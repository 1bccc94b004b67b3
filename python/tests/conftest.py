# SPDX-License-Identifier: LGPL-3.0-or-later
"""Models and helpers for the tests of the Python package."""

import os
import pathlib
import subprocess
import sys
import types

import numpy as np
import pytest
from hypothesis import settings

import terrane

# What is found must not depend on the day; TERRANE_HYPOTHESIS=random looks further.
settings.register_profile("fixed", derandomize=True, database=None)
settings.register_profile("random", derandomize=False, database=None)
settings.load_profile(os.environ.get("TERRANE_HYPOTHESIS", "fixed"))

SOURCE = pathlib.Path(__file__).resolve().parents[2]
DATA = SOURCE / "docs" / "data"
PROGRAM = os.environ.get("TERRANE_PROGRAM", "")
SANITIZED = bool(os.environ.get("TERRANE_SANITIZED"))
if SANITIZED:  # it is for this interpreter alone: the program and the helpers have a sanitizer of their own
    PRELOADED = {"LD_PRELOAD": os.environ.pop("LD_PRELOAD", "")}
else:
    PRELOADED = {}
HAS_TETGEN = os.path.exists(os.environ.get("TERRANE_TETGEN", ""))


def pytest_configure(config):
    config.addinivalue_line("markers", "tetgen: needs the helper program of TetGen")


def pytest_collection_modifyitems(items):
    for item in items:
        if "tetgen" in item.keywords and not HAS_TETGEN:
            item.add_marker(pytest.mark.skip(reason="this build has no terrane-tetgen"))


@pytest.fixture(autouse=True)
def in_temporary_folder(tmp_path, monkeypatch):
    """Each test runs in a folder of its own."""
    monkeypatch.chdir(tmp_path)


def run_program(*arguments):
    """Run `terrane` and return (status, standard output, standard error)."""
    if not PROGRAM:
        pytest.skip("the program is not built")
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def environment_of_python():
    """Return the environment for another interpreter like this one."""
    return {**os.environ, **PRELOADED}


def run_python(code, *arguments, check=True, **options):
    """Run code in another interpreter like this one."""
    options["env"] = {**os.environ, **options.get("env", {}), **PRELOADED}
    done = subprocess.run([sys.executable, "-c", code, *map(str, arguments)], capture_output=True,
                          text=True, **options)
    if check:
        assert done.returncode == 0, done.stderr
    return done


def sheet(nx=6, ny=6, z=0.0, name="sheet", role="unknown", slope=(0.0, 0.0), low=(0.0, 0.0), size=(5.0, 5.0),
          wave=0.0):
    """Return a surface over a rectangle, z = z + slope . (x, y) + wave sin sin."""
    x = np.linspace(low[0], low[0] + size[0], nx)
    y = np.linspace(low[1], low[1] + size[1], ny)
    gx, gy = (g.ravel() for g in np.meshgrid(x, y, indexing="ij"))
    gz = z + slope[0] * gx + slope[1] * gy + wave * np.sin(gx) * np.sin(gy)
    i, j = (g.ravel() for g in np.meshgrid(np.arange(nx - 1), np.arange(ny - 1), indexing="ij"))
    a = i * ny + j
    triangles = np.concatenate([np.stack([a, a + ny, a + ny + 1], 1), np.stack([a, a + ny + 1, a + 1], 1)])
    return terrane.Surface(np.stack([gx, gy, gz], 1), triangles.astype(np.uint32), name, role)


def wall(x=2.3, tilt=0.0, name="F1", role="fault", low=-3.0, high=3.0, y=(-1.0, 6.0)):
    """Return a fault: a rectangle at x, tilted."""
    v = [[x - tilt, y[0], low], [x - tilt, y[1], low], [x + tilt, y[1], high], [x + tilt, y[0], high]]
    return terrane.Surface(v, [[0, 1, 2], [0, 2, 3]], name, role)


def stack():
    """Return two horizons and a fault that cross."""
    return [sheet(z=1.0, name="top", role="horizon", wave=0.2), sheet(z=-1.0, name="base", role="horizon", wave=0.1),
            wall(tilt=0.3)]


BOX = ((0.2, 0.2, -2.0), (4.8, 4.8, 2.0))


@pytest.fixture(scope="session")
def arrangement():
    """The arrangement of `stack`."""
    return terrane.arrange(stack())


@pytest.fixture(scope="session")
def rounded(arrangement):
    """The mesh of doubles of `stack`."""
    return terrane.round(arrangement)


@pytest.fixture(scope="session")
def model():
    """The blocks of `stack` in a box."""
    return terrane.model(stack(), box=BOX)


# --- PyVista, by a package that has what we use of it


class FakeData(dict):
    def __setitem__(self, name, values):
        super().__setitem__(name, np.asarray(values))


class FakePolyData:
    def __init__(self, points, faces):
        self.points, self.faces, self.n_points = np.asarray(points), np.asarray(faces), len(points)
        self.cell_data, self.point_data, self.field_data = FakeData(), FakeData(), FakeData()
        self.shown = None

    def plot(self, **options):
        self.shown = options
        return options


class FakeGrid(FakePolyData):
    def __init__(self, cells, kinds, points):
        super().__init__(points, cells)
        self.kinds = kinds


class FakeBlocks(dict):
    def plot(self, **options):
        return options


@pytest.fixture
def pyvista(monkeypatch):
    """A stand-in for PyVista, which Debian has not."""
    module = types.ModuleType("pyvista")
    module.PolyData, module.UnstructuredGrid, module.MultiBlock = FakePolyData, FakeGrid, FakeBlocks
    monkeypatch.setitem(sys.modules, "pyvista", module)
    return module
