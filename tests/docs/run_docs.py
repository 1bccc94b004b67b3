#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs the console blocks of the documentation and compares what they print with what is shown.

run_docs.py --program build/release/cli/terrane [--update] [--keep FOLDER] [PAGE.md ...]

Without pages it runs README.md and all of docs/. tests/docs/README.md has the rules for pages. --update replaces
the output that a page shows where it differs from what the commands print.
"""
import argparse
import difflib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

from markdown_pages import PageError, blocks_of, commands_of, needs_of, numbers_not_shown

ROOT = pathlib.Path(__file__).resolve().parents[2]
SHELLS = {"sh", "bash", "shell", "zsh", "shell-session"}
ELISION = "..."


def line_matches(expected, actual):
    """Whether the line is the one shown, where '...' stands for anything."""
    pattern = ".*".join(re.escape(part) for part in expected.rstrip().split(ELISION))
    return re.fullmatch(pattern, actual.rstrip()) is not None


def lines_covered(expected, actual):
    """How many actual lines the expected ones can cover, as a set of numbers, after each of them.

    A line '...' stands for one line or more.
    """
    covered = [{0}]
    for line in expected:
        before = covered[-1]
        if line.strip() == ELISION:
            covered.append(set(range(min(before, default=len(actual)) + 1, len(actual) + 1)))
        else:
            covered.append({n + 1 for n in before if n < len(actual) and line_matches(line, actual[n])})
    return covered


def output_matches(expected, actual):
    """Whether the output is the one shown."""
    return len(actual) in lines_covered(expected, actual)[-1]


class Shell:
    """Runs commands one after the other, as a terminal does: the folder and $? carry over."""

    def __init__(self, program, folder, scratch, examples=()):
        self.folder, self.scratch, self.status = folder, scratch, 0
        binaries = scratch / "bin"
        binaries.mkdir()
        (binaries / "terrane").symlink_to(program)
        for example in examples:
            (binaries / example.name).symlink_to(example)
        self.environment = {"PATH": f"{binaries}:/usr/local/bin:/usr/bin:/bin",
                            "HOME": str(scratch), "LC_ALL": "C.UTF-8"}

    def run(self, command):
        """The lines that the command prints on both streams, in the order of a terminal."""
        after = self.scratch / "folder"
        script = f"(exit {self.status})\n{command}\nstatus=$?\npwd > {after}\nexit $status"
        done = subprocess.run(["stdbuf", "-oL", "bash", "--norc", "-c", script], cwd=self.folder,
                              env=self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, check=False)
        self.status = done.returncode
        if after.exists():
            self.folder = pathlib.Path(after.read_text().strip())
        return done.stdout.decode("utf-8", "replace").splitlines()


class Tally:
    """What was run and what went wrong."""

    def __init__(self):
        self.commands, self.blocks, self.skipped, self.failures = 0, 0, [], []

    def fail(self, place, text):
        self.failures.append(f"{place}: {text}")


def shown_difference(expected, actual):
    """The first line that the page shows wrongly, and what the command prints instead."""
    covered = lines_covered(expected, actual)
    wrong = next((i for i, line in enumerate(expected) if not covered[i + 1]), None)
    if wrong is None:
        return f"    {len(actual) - max(covered[-1])} more lines are printed after those shown"
    after = actual[max(covered[wrong]):] if expected[wrong - 1] != ELISION else actual[min(covered[wrong]):]
    nearest = difflib.get_close_matches(expected[wrong], after, 1, 0) or ["(nothing)"]
    return f"    shown:   {expected[wrong]}\n    printed: {nearest[0]}"


def run_block(block, page, shell, tally, changes):
    """Runs the commands of a block; appends (first line, line count, new output) to `changes`."""
    commands = commands_of(block, page)
    for index, command in enumerate(commands):
        place = f"{page}:{command.line}: $ {command.text}"
        actual = shell.run(command.text)
        tally.commands += 1
        if not output_matches(command.output, actual):
            changes.append((command.output_line, len(command.output), actual))
            tally.fail(place, "the output differs\n" + shown_difference(command.output, actual))
        asked = index + 1 < len(commands) and "$?" in commands[index + 1].text
        if shell.status != 0 and not asked:
            tally.fail(place, f"ends with status {shell.status}")


def write_file(block, page, shell):
    """Makes the file that a block shows, as the reader is told to."""
    path = (shell.folder / block.argument).resolve()
    if not path.is_relative_to(shell.scratch.resolve()):
        raise PageError(f"{page}:{block.line}: {block.argument} is outside of the page's folder")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(block.lines) + "\n")


def compare_with_source(block, path, page, tally, changes):
    """A block that shows a source must be that file, without the line that names the licence."""
    source = (path.parent / block.argument).resolve()
    if not source.is_file():
        raise PageError(f"{page}:{block.line}: there is no file {block.argument}")
    lines = source.read_text().splitlines()
    shown = lines[1:] if "SPDX-License-Identifier" in lines[0] else lines
    if block.lines != shown:
        changes.append((block.line + 1, len(block.lines), shown))
        tally.fail(f"{page}:{block.line}", f"the block is not {block.argument}")


def looks_like_commands(block):
    return block.language in SHELLS or (
        block.language != "console" and any(line.startswith(("$ ", "terrane ")) for line in block.lines))


def run_page(path, page, shell, tally):
    """Runs a page from top to bottom; the changes of output, see run_block."""
    changes = []
    for line, number in numbers_not_shown(path.read_text()):
        tally.fail(f"{page}:{line}", f"no block of the page shows {number}")
    for block in blocks_of(path.read_text(), page):
        if block.directive == "not run":
            if not block.argument:
                raise PageError(f"{page}:{block.line}: 'not run' needs a reason")
            tally.skipped.append(f"{page}:{block.line}: {block.argument}")
        elif block.directive == "file":
            write_file(block, page, shell)
        elif block.directive == "source":
            compare_with_source(block, path, page, tally, changes)
        elif block.language == "console":
            tally.blocks += 1
            run_block(block, page, shell, tally, changes)
        elif looks_like_commands(block):
            raise PageError(f"{page}:{block.line}: commands belong in a console block, which is run,"
                            " or after <!-- not run: REASON -->")
    return changes


def prepare(folder):
    """What a page finds: the data folders of the repository, at the places where they are there."""
    shutil.copytree(ROOT / "docs" / "data", folder / "docs" / "data")
    (folder / "tests").mkdir()
    (folder / "tests" / "data").symlink_to(ROOT / "tests" / "data")


def update(path, changes):
    lines = path.read_text().splitlines()
    for first, count, output in reversed(changes):
        lines[first - 1:first - 1 + count] = output
    path.write_text("\n".join(lines) + "\n")


def has_tetgen(program):
    """Whether the program finds TetGen's helper: it looks for that before it reads anything."""
    said = subprocess.run([program, "tetrahedralize", "no.ts", "-o", "no.vtu"], capture_output=True,
                          text=True, check=False).stderr
    return "helper program was not found" not in said


def run_all(options, tally):
    package = options.program.parents[1] / "python" / "terrane"
    known = {"tetgen": has_tetgen(options.program), "examples": bool(options.examples),
             "ensembles": any(package.glob("_core*.so"))}
    for path in options.pages:
        page = str(path.relative_to(ROOT)) if path.is_relative_to(ROOT) else str(path)
        try:
            missing = [x for x in needs_of(path.read_text()) if not known[x]]
            if missing:
                tally.skipped.append(f"{page}: there is no {missing[0]} in this build")
                continue
            if not any(b.language for b in blocks_of(path.read_text(), page)):
                continue
            scratch = pathlib.Path(tempfile.mkdtemp(dir=options.keep))
            folder = scratch / "terrane"
            folder.mkdir()
            prepare(folder)
            print(page, end=": ", flush=True)  # where a command hangs, this is the last line
            started = time.monotonic()
            before = tally.commands
            shell = Shell(options.program, folder, scratch, options.examples)
            changes = run_page(path, page, shell, tally)
            print(f"{tally.commands - before} commands, {time.monotonic() - started:.1f} s")
            if options.update:
                update(path, changes)
            if not options.keep:
                shutil.rmtree(scratch)
        except PageError as error:
            tally.failures.append(str(error))
        except KeyError as unknown:
            tally.fail(page, f"nobody knows what it needs: {unknown}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True, type=lambda p: pathlib.Path(p).resolve())
    parser.add_argument("--update", action="store_true", help="write the true output to the pages")
    parser.add_argument("--examples", nargs="*", default=[], metavar="PROGRAM",
                        type=lambda p: pathlib.Path(p).resolve(),
                        help="programs of docs/examples; put pages after another option")
    parser.add_argument("--keep", help="folder in which the pages' folders are made and kept")
    parser.add_argument("pages", nargs="*", type=lambda p: pathlib.Path(p).resolve())
    options = parser.parse_args()
    options.pages = options.pages or [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    if options.keep:
        os.makedirs(options.keep, exist_ok=True)
    tally = Tally()
    run_all(options, tally)
    for skipped in tally.skipped:
        print(f"skipped: {skipped}")
    for failure in tally.failures:
        print(f"FAILED: {failure}")
    print(f"{tally.commands} commands in {tally.blocks} blocks run, {len(tally.skipped)} skipped,"
          f" {len(tally.failures)} failed")
    return 0 if tally.commands > 0 and not tally.failures else 1


if __name__ == "__main__":
    sys.exit(main())
