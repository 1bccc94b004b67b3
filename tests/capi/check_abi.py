#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks that the C interface is the one that programs were compiled with.

    check_abi.py --library LIBTERRANE_C.so --include FOLDER --compiler CC... [--write]

(1) The library exports the functions that the headers declare, and nothing else.
(2) Their declarations, the sizes of structs, the places of their members and the values of constants are
    those of abi.txt, beside this file. What is only added needs no new TERRANE_ABI_VERSION, but a line there;
    --write writes the file anew.
(3) Each function is called in the tests (*.c, beside this file).
(4) The headers compile as C11 and as C++20 with each compiler, each header alone, without a warning.
"""
import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
HEADERS = [ROOT / "terrane.h", *sorted((ROOT / "capi").glob("*.h"))]
LICENCE = "# SPDX-License-Identifier: LGPL-3.0-or-later\n"
STRICT = ["-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]


def bare(header):
    """The text of a header without comments."""
    return re.sub(r"//[^\n]*", "", header.read_text())


def functions():
    """Declarations of functions by name, in one line each."""
    found = {}
    for header in HEADERS:
        for text in re.findall(r"^TERRANE_API ([^;]*);", bare(header), re.M):
            text = re.sub(r"\( ", "(", re.sub(r"\s+", " ", text))
            found[re.search(r"(\w+)\(", text)[1]] = text
    return found


def structs():
    """Members of structs by name of the struct, in order."""
    found = {}
    for header in HEADERS:
        for name, body in re.findall(r"^typedef struct (\w+) \{(.*?)^\} \1;", bare(header), re.M | re.S):
            members = [m for m in body.split(";") if m.strip()]
            found[name] = [re.search(r"(\w+)(\[\d+\])?\s*$", m)[1] for m in members]
    return found


def constants():
    """Names of constants in enums."""
    found = ["TERRANE_ABI_VERSION", "TERRANE_NONE"]
    for header in HEADERS:
        for body in re.findall(r"^enum \{(.*?)^\};", bare(header), re.M | re.S):
            found += re.findall(r"(\w+) =", body)
    return found


def run(command, **more):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, **more)
    if done.returncode != 0:
        sys.exit(f"{' '.join(str(c) for c in command)}: status {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def layout(compiler, include, folder):
    """Lines about constants and structs, as a program prints them that is compiled from the headers."""
    lines = ["#include <inttypes.h>", "#include <stdio.h>", "#include <terrane/terrane.h>", "int main(void) {"]
    for name in constants():
        lines.append(f'    printf("{name} = %" PRId64 "\\n", (int64_t){name});')
    for name, members in structs().items():
        lines.append(f'    printf("{name}: %zu bytes\\n", sizeof({name}));')
        for m in members:
            lines.append(f'    printf("    {m} at %zu, %zu\\n", offsetof({name}, {m}), sizeof((({name}*)0)->{m}));')
    source = folder / "layout.c"
    source.write_text("\n".join(lines + ["    return 0;", "}", ""]))
    run([compiler, *STRICT, f"-I{include}", source, "-o", folder / "layout"])
    return run([folder / "layout"])


def exported(library):
    """Names of functions and data that the library exports."""
    lines = run(["nm", "--dynamic", "--defined-only", library]).splitlines()
    return {re.sub(r"@.*", "", line.split()[-1]) for line in lines if line.split()[-2] != "A"}


def called():
    """Names that are called in the tests."""
    return set(re.findall(r"\b(terrane_\w+)\(", "".join(p.read_text() for p in HERE.glob("*.c"))))


def check_headers(compilers, include, folder):
    for compiler in compilers:
        for header in HEADERS:
            source = folder / "alone.c"
            source.write_text(f"#include <terrane/{header.relative_to(ROOT)}>\nint main(void) {{ return 0; }}\n")
            run([compiler, *STRICT, f"-I{include}", "-fsyntax-only", source])
            run([compiler, "-x", "c++", "-std=c++20", *STRICT[1:], f"-I{include}", "-fsyntax-only", source])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--library", required=True)
    parser.add_argument("--include", required=True)
    parser.add_argument("--compiler", action="append", required=True)
    parser.add_argument("--write", action="store_true", help="write abi.txt anew")
    options = parser.parse_args()
    declared = functions()
    flaws = []
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        check_headers(options.compiler, options.include, folder)
        texts = {layout(c, options.include, folder) for c in options.compiler}
    if len(texts) > 1:
        flaws.append("the compilers do not agree about sizes")
    now = LICENCE + "\n".join(sorted(declared.values())) + "\n" + min(texts)
    stated = HERE / "abi.txt"
    if options.write:
        stated.write_text(now)
    before = stated.read_text().splitlines()
    flaws += [f"changed or gone: {line}" for line in before if line not in now.splitlines()]
    flaws += [f"not in abi.txt: {line}" for line in now.splitlines() if line not in before]
    if not flaws and now.splitlines() != before:
        flaws.append("lines of abi.txt are in another order")
    there = exported(options.library)
    flaws += [f"declared, but not exported: {name}" for name in sorted(declared.keys() - there)]
    flaws += [f"exported, but not declared: {name}" for name in sorted(there - declared.keys())]
    flaws += [f"no test calls it: {name}" for name in sorted(declared.keys() - called())]
    if len(declared) < 100 or len(structs()) < 20 or len(constants()) < 30:
        flaws.append("too little was found in the headers")
    for flaw in flaws:
        print(f"check_abi: {flaw}", file=sys.stderr)
    return 1 if flaws else 0


if __name__ == "__main__":
    sys.exit(main())
