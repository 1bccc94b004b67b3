#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Numbers for people are written by figure() alone: no other general format, in C++, TypeScript or Python.

General formats ("{:.3g}", toPrecision, toExponential) give exponents such as 1e+02. Fixed decimals are left to tables and
drawings.
"""
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
#: Folders, the endings of their files, and what these must not hold.
RULES = (
    (("algorithms", "capi", "cli", "io", "kernel"), (".cpp", ".hpp"), re.compile(r"\{\d*:[^{}\"]*[gG]\}|%[-+ #0-9.]*[gG]\b")),
    (("io/page/web/src",), (".ts",), re.compile(r"\.to(Precision|Exponential)\(")),
    (("python/terrane",), (".py",), re.compile(r"\{[^{}]*:[^{}\"' ]*[gG]\}")),
)
#: Places that may, with the reason: a file and the text of the line.
ALLOWED = {
    ("algorithms/core/fields.cpp", "{:g}"): "defaults and bounds of options, which users copy",
    ("cli/reports/fill_report.cpp", "{:.6g},{:.6g}"): "a CSV file",
    ("io/page/web/src/text.ts", "value.toExponential("): "figure() itself",
}


def findings(path, text, pattern):
    """Return the lines of a text that hold a general format and may not."""
    return [f"{path}:{number}: {line.strip()}" for number, line in enumerate(text.splitlines(), 1)
            if pattern.search(line) and not any(path == where and what in line for where, what in ALLOWED)]


class TheTree(unittest.TestCase):
    def test_no_file_has_a_format_of_its_own(self):
        found = []
        for folders, endings, pattern in RULES:
            for path in (p for folder in folders for p in sorted((ROOT / folder).rglob("*")) if p.suffix in endings):
                found += findings(str(path.relative_to(ROOT)), path.read_text(encoding="utf-8"), pattern)
        self.assertEqual(found, [])

    def test_each_exception_is_needed(self):
        for where, what in ALLOWED:
            self.assertIn(what, (ROOT / where).read_text(encoding="utf-8"), where)


class TheJudge(unittest.TestCase):
    def test_general_formats_are_found(self):
        cpp, script, python = (pattern for _, _, pattern in RULES)
        for text in ('fmt::format("{:.3g} m", d)', '"{1:>10.6g}"', 'snprintf(t, n, "%.17g", d)'):
            self.assertTrue(findings("cli/a.cpp", text, cpp), text)
        self.assertTrue(findings("io/page/web/src/a.ts", "value.toPrecision(6)", script))
        self.assertTrue(findings("python/terrane/a.py", 'f"{volume:.6g} m3"', python))

    def test_others_are_not(self):
        cpp, _, python = (pattern for _, _, pattern in RULES)
        for text in ('fmt::format("{:.2f} {:>9}", d, n)', '"{} %", figure(d)', '"100 % good"', 'a ? b : g}'):
            self.assertEqual(findings("cli/a.cpp", text, cpp), [], text)
        self.assertEqual(findings("python/terrane/a.py", 'f"{name}: {value:.2f}"', python), [])


if __name__ == "__main__":
    unittest.main()
