#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Each rule of the verifier earns its place.

There is a forgery that it alone refuses: a test expects the verdict "R43" and no other rule. Without the rule
that forgery would be accepted, and the test would fail. Each rule is in the table of certificate.md, and the
table has no others."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
ENUMERATOR = re.compile(r"^    (R\d+)_\w+(?: = \d+)?,", re.MULTILINE)
IN_TABLE = re.compile(r"^\| (R\d+) \|", re.MULTILINE)
EXPECTED = re.compile(r'"(R\d+) ?"')


def texts(folder, pattern):
    return "\n".join(path.read_text() for path in sorted((ROOT / folder).rglob(pattern)))


def main():
    rules = set(ENUMERATOR.findall((ROOT / "algorithms/verify/verdict.hpp").read_text()))
    documented = set(IN_TABLE.findall((ROOT / "docs/reference/certificate.md").read_text()))
    expected = set(EXPECTED.findall(texts("tests", "test_*.cpp")))
    flaws = [f"{rule} is not in the table of certificate.md" for rule in rules - documented]
    flaws += [f"{rule} of certificate.md is no rule" for rule in documented - rules]
    flaws += [f"no test has a forgery that {rule} alone refuses" for rule in rules - expected]
    if len(rules) < 40:
        flaws.append(f"only {len(rules)} rules were found in verdict.hpp")
    for flaw in sorted(flaws):
        print(flaw)
    print(f"{len(rules)} rules, {len(flaws)} flaws")
    return 1 if flaws else 0


if __name__ == "__main__":
    sys.exit(main())
