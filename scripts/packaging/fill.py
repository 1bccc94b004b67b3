#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Fills the recipes for conda-forge, vcpkg and Conan with the address and the hashes of a release.

    fill.py --url ADDRESS --archive FILE --home ADDRESS --maintainer NAME --out FOLDER

ADDRESS of --url is where the archive FILE can be fetched. The version is that of CMakeLists.txt. FOLDER gets the
folders conda, vcpkg and conan.
"""
import argparse
import hashlib
import re
import shutil
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
RECIPES = ("conda", "vcpkg", "conan")


def version():
    """The version that CMakeLists.txt states."""
    return re.search(r"^project\(terrane VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(), re.M)[1]


def values_of(options):
    """What stands for each name between @."""
    contents = options.archive.read_bytes()
    return {"VERSION": version(), "URL": options.url, "HOME": options.home, "MAINTAINER": options.maintainer,
            "SHA256": hashlib.sha256(contents).hexdigest(), "SHA512": hashlib.sha512(contents).hexdigest()}


def fill(values, out):
    """Writes the recipes; exits where one has a name that has no value."""
    for recipe in RECIPES:
        shutil.rmtree(out / recipe, ignore_errors=True)
        shutil.copytree(HERE / recipe, out / recipe, ignore=shutil.ignore_patterns("__pycache__"))
        for path in sorted((out / recipe).rglob("*")):
            if not path.is_file():
                continue
            text = path.read_text()
            for name, value in values.items():
                text = text.replace(f"@{name}@", value)
            if left := re.search(r"@[A-Z]\w*@", text):
                sys.exit(f"fill: {path.relative_to(out)}: {left[0]} has no value")
            path.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--url", required=True)
    parser.add_argument("--archive", type=Path, required=True)
    parser.add_argument("--home", required=True)
    parser.add_argument("--maintainer", required=True)
    parser.add_argument("--out", type=Path, required=True)
    options = parser.parse_args()
    fill(values_of(options), options.out)
    print(f"wrote {', '.join(str(options.out / r) for r in RECIPES)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
