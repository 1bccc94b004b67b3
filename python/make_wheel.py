#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Packs the package into a wheel (PEP 427), with the standard library alone.

usage: make_wheel.py --package FOLDER --version X --source FOLDER --to FOLDER [--helpers PROGRAM...]
"""

import argparse
import base64
import hashlib
import os
import platform
import re
import sys
import sysconfig
import zipfile

METADATA = """Metadata-Version: 2.1
Name: terrane
Version: {version}
Summary: Exact conforming meshes, blocks and tetrahedra of geological surfaces
License: LGPL-3.0-or-later
Requires-Python: >=3.9
Requires-Dist: numpy (>=1.21)
Provides-Extra: plot
Requires-Dist: pyvista ; extra == 'plot'
Provides-Extra: ensembles
Requires-Dist: distributed ; extra == 'ensembles'
Requires-Dist: h5py ; extra == 'ensembles'
Description-Content-Type: text/markdown

"""

WHEEL = """Wheel-Version: 1.0
Generator: terrane make_wheel
Root-Is-Purelib: false
Tag: {tag}
"""


# PyVista, from 0.48 on, finds these: mesh.terrane, and readers of files.
ENTRY_POINTS = "[pyvista.accessors]\nterrane = terrane.accessor\n\n[pyvista.readers]\n" + "".join(
    f"{extension} = terrane.accessor:read\n" for extension in (".ts", ".ml", ".gp", ".irap", ".gri", ".zmap", ".cps3"))


def tag():
    """Return the tag of this interpreter and machine."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    system = re.sub(r"[.-]", "_", sysconfig.get_platform())
    if platform.python_implementation() != "CPython":
        raise SystemExit("make_wheel: only CPython is supported")
    return f"{python}-{python}-{system}"


def files_of(options):
    """Return (name in the wheel, path, mode) of all files."""
    found = []
    for name in sorted(os.listdir(options.package)):
        path = os.path.join(options.package, name)
        if os.path.isfile(path) and not name.endswith(".pyc"):
            found.append((f"terrane/{name}", path, 0o755 if ".so" in name else 0o644))
    for helper in options.helpers:
        found.append((f"terrane/_libexec/{os.path.basename(helper)}", helper, 0o755))
    licences = os.path.join(options.source, "LICENSES")
    info = f"terrane-{options.version}.dist-info"
    for name in sorted(set(os.listdir(licences)) - {"MIT.txt"}):  # that of terrane::fuzzing, which is for C++
        found.append((f"{info}/licenses/{name}", os.path.join(licences, name), 0o644))
    return found, info


def main():
    parser = argparse.ArgumentParser()
    for option in ("--package", "--version", "--source", "--to"):
        parser.add_argument(option, required=True)
    parser.add_argument("--helpers", nargs="*", default=[])
    options = parser.parse_args()
    files, info = files_of(options)
    with open(os.path.join(options.source, "README.md"), encoding="utf-8") as readme:
        metadata = METADATA.format(version=options.version) + readme.read()
    os.makedirs(options.to, exist_ok=True)
    path = os.path.join(options.to, f"terrane-{options.version}-{tag()}.whl")
    records = []
    with zipfile.ZipFile(path + ".part", "w", zipfile.ZIP_DEFLATED) as wheel:
        def add(name, contents, mode=0o644):
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))  # the same bytes each time
            entry.external_attr = (0o100000 | mode) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, contents)
            digest = base64.urlsafe_b64encode(hashlib.sha256(contents).digest()).rstrip(b"=").decode()
            records.append(f"{name},sha256={digest},{len(contents)}")
        for name, source, mode in files:
            with open(source, "rb") as file:
                add(name, file.read(), mode)
        add(f"{info}/METADATA", metadata.encode())
        add(f"{info}/entry_points.txt", ENTRY_POINTS.encode())
        add(f"{info}/WHEEL", WHEEL.format(tag=tag()).encode())
        records.append(f"{info}/RECORD,,")
        add(f"{info}/RECORD", ("\n".join(records) + "\n").encode())
    os.replace(path + ".part", path)
    print(path)


if __name__ == "__main__":
    main()
