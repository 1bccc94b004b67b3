#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tests of the tests of the documentation: what must be found is found."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
sys.dont_write_bytecode = True

import check_guarantees
import check_licences
import check_links
import check_reference
import run_docs
from json_keys import key_paths
from markdown_pages import (PageError, anchors_of, blocks_of, commands_of, links_of, needs_of, numbers_not_shown,
                            site_slug)

PAGE = """# A page

<!-- needs: tetgen -->

<!-- file: model.json -->
```json
{"a": 1}
```

Some text.

```console
$ cat model.json
{"a": 1}
$ echo one \\
>   two
one two
```

<!-- not run: takes an hour -->
```console
$ sleep 3600
```
"""


class Blocks(unittest.TestCase):
    def test_blocks_have_language_line_and_directive(self):
        blocks = blocks_of(PAGE)
        self.assertEqual([(b.language, b.line, b.directive, b.argument) for b in blocks],
                         [("json", 6, "file", "model.json"), ("console", 12, "", ""),
                          ("console", 21, "not run", "takes an hour")])
        self.assertEqual(needs_of(PAGE), ["tetgen"])

    def test_commands_have_text_output_and_line(self):
        first, second = commands_of(blocks_of(PAGE)[1])
        self.assertEqual((first.text, first.line, first.output), ("cat model.json", 13, ['{"a": 1}']))
        self.assertEqual((second.text, second.output_line), ("echo one \\\n  two", 17))
        self.assertEqual(second.output, ["one two"])

    def test_a_directive_holds_for_the_next_block_only(self):
        blocks = blocks_of("<!-- not run: why -->\ntext\n```console\n$ true\n```\n")
        self.assertEqual(blocks[0].directive, "")

    def test_broken_pages_are_refused(self):
        for text in ("```console\n$ true\n", "  ```console\n  $ true\n  ```\n"):
            self.assertRaises(PageError, blocks_of, text)
        for text in ("```console\noutput first\n```\n", "```console\n```\n",
                     "```console\n$ echo \\\nnot continued\n```\n"):
            self.assertRaises(PageError, commands_of, blocks_of(text)[0])


class Outputs(unittest.TestCase):
    def test_lines(self):
        self.assertTrue(run_docs.line_matches("took ... s", "took 0.25 s"))
        self.assertTrue(run_docs.line_matches("(1.5)", "(1.5)  "))
        self.assertFalse(run_docs.line_matches("(1.5)", "(1x5)"))
        self.assertFalse(run_docs.line_matches("6 blocks", "16 blocks"))

    def test_elided_lines(self):
        actual = ["a", "b", "c", "b", "d"]
        for shown in (["a", "...", "d"], ["...", "b", "d"], ["a", "..."], actual):
            self.assertTrue(run_docs.output_matches(shown, actual), shown)
        for shown in (["a", "d"], ["a", "b", "c", "b", "...", "d"], actual + ["..."], ["..."] * 6, []):
            self.assertFalse(run_docs.output_matches(shown, actual), shown)
        self.assertTrue(run_docs.output_matches([], []))
        self.assertFalse(run_docs.output_matches(["..."], []))


class Pages(unittest.TestCase):
    """Whole pages, with /bin/true in the place of the program."""

    def run_text(self, text, files=()):
        tally = run_docs.Tally()
        with tempfile.TemporaryDirectory() as name:
            scratch = pathlib.Path(name)
            for file, content in files:
                (scratch / file).write_text(content)
            page = scratch / "page.md"
            page.write_text(text)
            folder = scratch / "terrane"
            folder.mkdir()
            changes = run_docs.run_page(page, "page.md", run_docs.Shell("/bin/true", folder, scratch),
                                        tally)
            run_docs.update(page, changes)
            self.updated = page.read_text()
        return tally

    def test_a_true_page_passes(self):
        tally = self.run_text(PAGE)
        self.assertEqual((tally.commands, tally.blocks, tally.failures), (2, 1, []))
        self.assertEqual(tally.skipped, ["page.md:21: takes an hour"])

    def test_a_wrong_number_fails_and_is_updated(self):
        tally = self.run_text(PAGE.replace('{"a": 1}\n$', '{"a": 2}\n$'))
        self.assertEqual(len(tally.failures), 1)
        self.assertIn("page.md:13", tally.failures[0])
        self.assertEqual(self.updated, PAGE)

    def test_a_block_of_a_source_is_that_source(self):
        files = [("a.cpp", "// SPDX-License-Identifier: X\nint a;\n")]
        page = "<!-- source: a.cpp -->\n```cpp\nint a;\n```\n"
        self.assertEqual(self.run_text(page, files).failures, [])
        self.assertEqual(len(self.run_text(page.replace("int a", "int b"), files).failures), 1)
        self.assertEqual(self.updated, page)
        self.assertRaises(PageError, self.run_text, page)

    def test_a_missing_and_an_extra_line_fail(self):
        self.assertEqual(len(self.run_text(PAGE.replace("one two\n", "")).failures), 1)
        self.assertEqual(len(self.run_text(PAGE.replace("one two", "one two\nthree")).failures), 1)

    def test_a_status_fails_unless_it_is_asked_for(self):
        self.assertEqual(len(self.run_text("```console\n$ false\n```\n").failures), 1)
        self.assertEqual(self.run_text("```console\n$ false\n$ echo $?\n1\n```\n").failures, [])
        self.assertEqual(len(self.run_text("```console\n$ true\n$ echo $?\n1\n```\n").failures), 1)

    def test_the_folder_carries_over(self):
        text = "```console\n$ mkdir a && cd a\n```\n\n```console\n$ basename $PWD\na\n```\n"
        self.assertEqual(self.run_text(text).failures, [])

    def test_both_streams_are_in_order(self):
        text = "```console\n$ python3 -c 'print(1)'; echo 2 >&2; echo 3\n1\n2\n3\n```\n"
        self.assertEqual(self.run_text(text).failures, [])

    def test_commands_outside_of_console_blocks_are_refused(self):
        for text in ("```sh\nls\n```\n", "```\n$ ls\n```\n", "```text\nterrane check a.obj\n```\n",
                     "<!-- not run: -->\n```console\n$ true\n```\n",
                     "<!-- file: ../../x -->\n```json\n{}\n```\n"):
            self.assertRaises(PageError, self.run_text, text)


class Links(unittest.TestCase):
    def test_links_are_found_outside_of_code(self):
        text = ("[a](b.md) and ![i](c.png \"t\") `[no](no.md)`\n```text\n[no](no.md)\n```\n"
                "[x]: d.md\n<img src=\"e.png\"> [![i](f.png)](g.md)\n")
        self.assertEqual([t for _, t in links_of(text)], ["b.md", "c.png", "d.md", "e.png", "g.md"])

    def test_anchors_agree_between_hosts_and_site(self):
        self.assertEqual(anchors_of("# The `--box` option\n\n## Two words, a comma\n"),
                         {"two-words-a-comma"})
        self.assertEqual(site_slug("Exit status"), "exit-status")

    def test_each_kind_of_flaw(self):
        with tempfile.TemporaryDirectory() as name:
            root = pathlib.Path(name)
            (root / "docs").mkdir()
            (root / "README.md").write_text("[ok](docs/a.md#one-two) [no](docs/b.md)\n[out](../x.md)\n")
            (root / "docs" / "a.md").write_text(
                "# One two\n[up](../README.md) [no](#three) [ok](#one-two) [net](https://x.org/y)\n" + 121 * "w" + "\n" +
                "|" + 121 * "w" + "\n```text\n" + 121 * "w" + "\n```\n")
            pages, links, others, flaws = check_links.check(root.resolve())
        self.assertEqual((pages, links, others, len(flaws)), (2, 6, 1, 5), flaws)


class Reference(unittest.TestCase):
    TABLES = ["text", "| Key | Meaning |", "|---|---|", "| `a`, `b[].c` | x |", "| `d` | y \\| z |", "",
              "| List | Meaning |", "|---|---|", "| `e` | x |"]

    def test_rows_of_tables(self):
        rows = check_reference.rows_of(self.TABLES)
        self.assertEqual(rows, [["`a`, `b[].c`", "x"], ["`d`", "y | z"], ["`e`", "x"]])
        self.assertEqual(len(check_reference.rows_of(self.TABLES, "Key")), 2)

    def test_paths_of_keys(self):
        self.assertEqual(key_paths({"a": [{"b": 1}, {"c": {"d": []}}]}),
                         {"a", "a[].b", "a[].c", "a[].c.d"})
        self.assertTrue(check_reference.fits("q.*.min", "q.before.min"))
        self.assertFalse(check_reference.fits("q.*", "q.before.min"))
        self.assertEqual(check_reference.schema_paths(
            {"properties": {"a": {"items": {"type": "object", "properties": {"b": {"default": 1}}}},
                            "c": {"additionalProperties": {"type": "number"}}}}),
                         {"a": None, "a[].b": 1, "c": None, "c.*": None})

    def test_both_directions_of_keys(self):
        findings = []
        check_reference.compare_keys("page", {"a", "b.*"}, {"a", "c"}, findings)
        self.assertEqual(len(findings), 2, findings)

    def test_lines_of_help(self):
        for line, flags, placeholder, text in (
                ("  --box BOX                   Cut (default: x)", "--box", " BOX", "Cut (default: x)"),
                ("  -o,--output OUT ... REQUIRED", "-o,--output", " OUT", ""),
                ("  --edge-length-of NAME=L ... The same", "--edge-length-of", " NAME=L", "The same"),
                ("  --json                      All", "--json", "", "All")):
            self.assertEqual(check_reference.OPTION_LINE.match(line).groups(), (flags, placeholder, text))


class Numbers(unittest.TestCase):
    def test_a_bold_number_must_be_shown(self):
        page = "It is **1 234** of **0.5** m, not `**7**`.\n\n```text\n1234 triangles, %s m.\n```\n"
        self.assertEqual(numbers_not_shown(page % "0.5"), [])
        self.assertEqual(numbers_not_shown(page % "10.5"), [(1, "0.5")])


class DataFiles(unittest.TestCase):
    def test_the_data_of_the_pages_are_what_the_script_makes(self):
        data = run_docs.ROOT / "docs" / "data"
        sys.path.insert(0, str(data))
        import make_data
        for name, text in make_data.files().items():
            self.assertEqual((data / name).read_text(), text, name)


class Guarantees(unittest.TestCase):
    def test_a_test_that_is_not_there_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "docs" / "explanation").mkdir(parents=True)
            (root / "tests").mkdir()
            (root / "tests" / "test_a.cpp").write_text('TEST_CASE(\n    "a: long "\n    "name") {}\n')
            page = root / "docs" / "explanation" / "guarantees.md"
            page.write_text("## G1 It works\n\n- Tests: `a: long name`,\n  `a: ...`.\n- Limits: `x`.\n")
            readme = root / "README.md"
            readme.write_text("| | what | tests |\n|---|---|---|\n| G1 | works | `a: long name` |\n")
            self.assertEqual(check_guarantees.check(root), (3, []))
            page.write_text("## G1 It works\n\n- Tests: `b: ...`.\n")
            self.assertIn("b: ...", check_guarantees.check(root)[1][0])
            readme.write_text("| G2 | works | nothing |\n" + "\n" * 159)
            self.assertEqual(len(check_guarantees.check(root)[1]), 3)
            readme.write_text(readme.read_text() + "\n")
            self.assertIn("160 lines", check_guarantees.check(root)[1][0])


class Licences(unittest.TestCase):
    def test_each_flaw_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "LICENSES").mkdir()
            for identifier, title in check_licences.TITLES.items():
                (root / "LICENSES" / f"{identifier}.txt").write_text(title + "\n")
            (root / "LICENSE").write_text("GNU LESSER GENERAL PUBLIC LICENSE\n")
            (root / "kernel").mkdir()
            source = root / "kernel" / "sign.hpp"
            source.write_text("// SPDX-License-Identifier: LGPL-3.0-or-later\n")
            self.assertEqual(check_licences.check(root), (1, []))
            source.write_text("// SPDX-License-Identifier: MIT\n")
            self.assertIn("MIT", check_licences.check(root)[1][0])
            source.write_text("// nothing\n")
            self.assertIn("no licence", check_licences.check(root)[1][0])
            (root / "LICENSES" / "AGPL-3.0-or-later.txt").unlink()
            (root / "LICENSE").unlink()
            self.assertEqual(len(check_licences.check(root)[1]), 3)


if __name__ == "__main__":
    unittest.main()
