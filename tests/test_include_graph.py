#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The include graph of the source tree has arrows in one direction only.

Judges the tree itself, then small trees that break one rule each: the judge must see all of them.
"""
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import include_graph  # noqa: E402


class TheTree(unittest.TestCase):
    def test_has_arrows_in_one_direction(self):
        arrows, problems = include_graph.judge(ROOT)
        self.assertEqual(problems, [])
        self.assertEqual(include_graph.cycle_in(arrows), [])
        self.assertGreater(len(arrows), 100)

    def test_has_no_empty_folder_in_the_order(self):
        folders = {include_graph.folder_of(path) for path in include_graph.sources(ROOT)}
        self.assertEqual(folders, set(include_graph.ORDER))

    def test_has_folders_without_circles(self):
        for folder in ("algorithms/rounding", "algorithms/quality", "algorithms/verify"):
            arrows = include_graph.arrows_within(ROOT, folder)
            self.assertEqual(include_graph.cycle_in(arrows), [], folder)
            self.assertGreater(len(arrows), 50)

    def test_has_imports_in_one_direction(self):
        self.assertEqual(include_graph.judge_modules(ROOT / "python/terrane"), [])
        self.assertGreater(len(include_graph.MODULES), 30)

    def test_has_each_public_header_in_one_tier(self):
        public = include_graph.public_headers(ROOT)
        self.assertGreater(len(public), 40)
        self.assertEqual(len(public), len(set(public)))


class Damage(unittest.TestCase):
    ORDER = ["kernel", "algorithms/mesh", "algorithms/check", "io"]
    SOUND = {
        "kernel/point.hpp": "",
        "algorithms/mesh/mesh.hpp": "#include <terrane/kernel/point.hpp>\n",
        "algorithms/mesh/detail/fan.hpp": "",
        "algorithms/mesh/mesh.cpp": "#include <terrane/algorithms/mesh/detail/fan.hpp>\n",
        "algorithms/check/check.hpp": "#include <terrane/algorithms/mesh/mesh.hpp>\n",
        "io/obj.cpp": "# include \"terrane/algorithms/check/check.hpp\"\n",
    }

    def judge(self, **changes):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in {**self.SOUND, **changes.get("files", {})}.items():
                path = Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            arrows, problems = include_graph.judge(Path(folder), changes.get("order", self.ORDER))
            return problems, include_graph.cycle_in(arrows)

    def test_sound_tree_passes(self):
        self.assertEqual(self.judge(), ([], []))

    def test_arrow_that_points_back(self):
        problems, cycle = self.judge(files={
            "algorithms/mesh/edges.cpp": "#include <terrane/algorithms/check/check.hpp>\n"})
        self.assertEqual(len(problems), 1)
        self.assertIn("points back", problems[0])
        self.assertEqual(cycle, ["algorithms/check", "algorithms/mesh", "algorithms/check"])

    def test_circle_within_a_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "io/detail").mkdir(parents=True)
            (Path(folder) / "io/obj.cpp").write_text("#include <terrane/io/detail/lines.hpp>\n")
            (Path(folder) / "io/obj.hpp").write_text("")
            (Path(folder) / "io/detail/lines.hpp").write_text("#include <terrane/io/obj.hpp>\n")
            arrows = include_graph.arrows_within(Path(folder), "io")
            self.assertEqual(include_graph.cycle_in(arrows), ["io/detail/lines", "io/obj", "io/detail/lines"])

    def test_kernel_knows_nothing(self):
        problems, _ = self.judge(files={
            "kernel/sign.hpp": "#include <terrane/algorithms/mesh/mesh.hpp>\n"})
        self.assertEqual(len(problems), 1)

    def test_detail_from_outside(self):
        problems, _ = self.judge(files={
            "io/off.cpp": "#include <terrane/algorithms/mesh/detail/fan.hpp>\n"})
        self.assertEqual(len(problems), 1)
        self.assertIn("private to algorithms/mesh", problems[0])

    def test_file_in_no_known_folder(self):
        for name in ("algorithms/loose.cpp", "algorithms/mesh/deep/loose.cpp"):
            problems, _ = self.judge(files={name: ""})
            self.assertEqual(len(problems), 1, name)
            self.assertIn("no known folder", problems[0])

    def test_include_of_what_is_not_there(self):
        problems, _ = self.judge(files={
            "io/off.cpp": "#include <terrane/algorithms/mesh/lost.hpp>\n"})
        self.assertEqual(len(problems), 1)
        self.assertIn("does not exist", problems[0])

    def judge_modules(self, **files):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in {"low": "import os\n", "high": "from . import core\nfrom .low import f\n", **files}.items():
                (Path(folder) / f"{name}.py").write_text(text)
            return include_graph.judge_modules(Path(folder), ["low", "high"])

    def test_sound_package_passes(self):
        self.assertEqual(self.judge_modules(), [])

    def test_import_that_points_back(self):
        for text in ("from .high import g\n", "from . import high\n", "from .low import f\n"):
            problems = self.judge_modules(low=text)
            self.assertEqual(len(problems), 1, text)
            self.assertIn("low.py:1: imports", problems[0])

    def test_import_inside_a_function(self):
        self.assertIn("high.py:2: imports a module of ours below its top",
                      self.judge_modules(high="def f():\n    from .low import f\n"))

    def test_module_in_no_list(self):
        self.assertEqual(len(self.judge_modules(other="")), 1)

    def test_cycle_that_an_order_would_allow(self):
        arrows = {("a", "b"): set(), ("b", "c"): set(), ("c", "a"): set(), ("d", "a"): set()}
        self.assertEqual(include_graph.cycle_in(arrows), ["a", "b", "c", "a"])


if __name__ == "__main__":
    unittest.main()
