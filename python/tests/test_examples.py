# SPDX-License-Identifier: LGPL-3.0-or-later
"""The examples of docs/examples/python: they run, print what the page shows, and make their figures."""

import os
import re
import subprocess
import sys

import pytest

import terrane
from conftest import HAS_TETGEN, SANITIZED, SOURCE

FOLDER = SOURCE / "docs/examples/python"
PAGE = SOURCE / "docs/how-to/python-examples.md"
EXAMPLES = ["first_model", "faulted_stack", "holes_filled", "fault_relations", "points_to_units", "two_scenarios"]
ARCHIVE = os.environ.get("TERRANE_GFM2020", "")  # tests/models/gfm2020.py makes the same model for each commit


def run(name, *arguments):
    """Run an example in this folder; return what it prints."""
    pytest.importorskip("matplotlib")
    done = subprocess.run([sys.executable, str(FOLDER / f"{name}.py"), *map(str, arguments)], capture_output=True,
                          text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def shown(name):
    """Return what the page shows behind an example."""
    found = re.search(rf"examples/python/{name}\.py.*?```text\n(.*?)```", PAGE.read_text(), re.S)
    assert found, f"{name} is not on the page"
    return found.group(1)


@pytest.mark.skipif(SANITIZED, reason="the examples run code that other tests run")
@pytest.mark.parametrize("name", EXAMPLES)
def test_example(name):
    if name == "faulted_stack" and not HAS_TETGEN:
        pytest.skip("no terrane-tetgen")
    assert run(name) == shown(name)
    assert os.path.getsize(f"{name}.png") > 20_000
    assert (SOURCE / f"docs/examples/python/{name}.png").exists(), "the figure of the page"


@pytest.mark.skipif(SANITIZED or not ARCHIVE, reason="TERRANE_GFM2020 does not name the archive")
def test_gfm2020():
    assert run("gfm2020_blocks", ARCHIVE) == shown("gfm2020_blocks")


def test_all_examples_are_known():
    scripts = {p.stem for p in FOLDER.glob("*.py")} - {"drawing", "shapes", "check_case"}
    assert scripts == {*EXAMPLES, "gfm2020_blocks"}


@pytest.mark.skipif(SANITIZED, reason="the examples run code that other tests run")
def test_gfm2020_without_data_says_where_it_is():
    done = subprocess.run([sys.executable, str(FOLDER / "gfm2020_blocks.py")], capture_output=True, text=True)
    assert done.returncode != 0 and "SCECcode/GFM_web" in done.stderr
