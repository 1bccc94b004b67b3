# SPDX-License-Identifier: LGPL-3.0-or-later
"""Builds wheels by CMake (PEP 517). It needs no package of Python, so that pip needs no network for it."""

import glob
import os
import shutil
import subprocess
import sys

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def get_requires_for_build_wheel(config_settings=None):
    """No packages: the compiler, CMake and pybind11's headers are the system's (scripts/setup.sh)."""
    return []


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Configure, build and pack; return the name of the wheel."""
    folder = os.path.join(SOURCE, "build", f"wheel-{sys.implementation.cache_tag}")
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DTERRANE_UNITY=ON", "-DTERRANE_TESTS=OFF", "-DTERRANE_PYTHON=ON",
               f"-DPython3_EXECUTABLE={sys.executable}"]
    if shutil.which("ninja"):
        options += ["-G", "Ninja"]
    for name, value in (config_settings or {}).items():
        if name.startswith("cmake."):  # pip install . --config-settings=cmake.TERRANE_GMSH=OFF
            options.append(f"-D{name[len('cmake.'):]}={value}")
    subprocess.run(["cmake", "-S", SOURCE, "-B", folder, *options], check=True)
    jobs = str(os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or os.cpu_count() or 1)
    made = subprocess.run(["cmake", "--build", folder, "--target", "wheel", "-j", jobs], check=False)
    if made.returncode != 0:
        raise SystemExit("terrane: the build failed; where it has no target wheel, CMake has said above what is "
                         "missing (python3-dev, pybind11-dev: scripts/setup.sh installs them)")
    wheels = sorted(glob.glob(os.path.join(folder, "wheel", "*.whl")), key=os.path.getmtime)
    return os.path.basename(shutil.copy(wheels[-1], wheel_directory))
