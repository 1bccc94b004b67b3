#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""No name is declared where it gets in another one's way.

Judges the tree itself, then small trees that break one rule each: the judge must see all of them.
"""
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import declared_names  # noqa: E402


def problems_of(files):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = Path(folder) / "algorithms" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return declared_names.problems(Path(folder))


def within(space, line):
    return f"namespace {space} {{\n\n{line}\n\n}} // namespace {space}\n"


class TheTree(unittest.TestCase):
    def test_has_no_name_in_the_way_of_another(self):
        self.assertEqual(declared_names.problems(ROOT), [])

    def test_is_read(self):
        found = list(declared_names.declarations(ROOT / "algorithms/search/method.hpp"))
        self.assertEqual(found, [("terrane", "Search")])


class Trees(unittest.TestCase):
    def test_a_name_twice(self):
        text = within("terrane", "struct Sizes {\n    int a;\n};")
        found = problems_of({"a/a.hpp": text, "b/b.hpp": text})
        self.assertEqual(len(found), 1)
        self.assertIn("Sizes is declared twice", found[0])

    def test_a_name_outside_and_inside(self):
        for line in ("struct Sizes {", "using Sizes = int;", "constexpr int Sizes = 1;",
                     "enum class Sizes : char { a };", "template <class T>\nclass Sizes {"):
            found = problems_of({"a/a.hpp": within("terrane", "struct Sizes {};"),
                                 "b/b.hpp": within("terrane::b::detail", line)})
            self.assertEqual(len(found), 1, line)
            self.assertIn("terrane::b::detail", found[0])

    def test_a_detail_header_in_plain_terrane(self):
        found = problems_of({"a/detail/a.hpp": within("terrane", "struct Sizes {};")})
        self.assertEqual(len(found), 1)
        self.assertIn("plain terrane: Sizes", found[0])

    def test_a_constant_with_another_name(self):
        for line in ('double share = add("shares", 1);', 'std::array<int, 2> digits =\n add<int>({"digits_1", "digits_3"}, {1, 2});'):
            found = problems_of({"a/a.hpp": within("terrane", "struct Sizes {\n    " + line + "\n};")})
            self.assertEqual(len(found), 1, line)
            self.assertIn("by another name", found[0])

    def test_what_is_no_clash(self):
        own = within("terrane::a::detail", "struct Sizes {};")
        other = within("terrane::b::detail", "struct Sizes {};")
        hidden = "namespace terrane {\nnamespace {\n\nstruct Sizes {};\n\n} // namespace\n} // namespace terrane\n"
        member = within("terrane", "struct Store::Sizes {};")
        forward = within("terrane", "struct Only;")
        self.assertEqual(problems_of({"a/detail/a.hpp": own, "b/detail/b.hpp": other,
                                      "c/c.cpp": hidden, "c/d.cpp": member, "c/e.hpp": forward,
                                      "c/f.hpp": forward}), [])


if __name__ == "__main__":
    unittest.main()
