#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Lets Gappa check the proofs of the error bounds, kernel/proofs/*.g.

    gappa_bounds.py --constants PROGRAM [--gappa GAPPA] [--proofs FOLDER]

PROGRAM prints the constants as they are compiled, a name and a number on each line. They take the
place of @NAME@ in the proofs, so a proof is about the constants that the filters use. Besides, in a
proof a comment

    # least: NAME VALUE     says that it holds for VALUE in place of the constant, which is no smaller;
                            it must fail for 0.99 VALUE, and so for all that is less
    # uses: FILE NAME VALUE says that it takes a number from another proof, which holds for VALUE
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys

PLACE = re.compile(r"@(\w+)@")
LEAST = re.compile(r"^# least: (\w+) (\S+)$", re.MULTILINE)
USES = re.compile(r"^# uses: (\S+) (\w+) (\S+)$", re.MULTILINE)


def number(text):
    """The value of 7b-3, 0x8.1p-52 or 0.5."""
    if "b" in text and "x" not in text:
        mantissa, exponent = text.split("b")
        return int(mantissa) * 2.0 ** int(exponent)
    return float.fromhex(text) if "x" in text else float(text)


def constants_of(program):
    lines = subprocess.run([program], check=True, capture_output=True, text=True).stdout.split("\n")
    return dict(line.split() for line in lines if line)


class Proofs:
    """The proofs of a folder, with the constants in their places."""

    def __init__(self, gappa, folder, constants):
        self.gappa, self.constants, self.known = gappa, constants, {}
        self.texts = {path.name: path.read_text() for path in sorted(folder.glob("*.g"))}

    def refusal(self, name, **planted):
        """What Gappa says against a proof; empty if it accepts the proof without a warning."""
        values = {**self.constants, **planted}
        text = PLACE.sub(lambda place: values[place[1]], self.texts[name])
        if text not in self.known:
            self.known[text] = self.ask(text)
        return self.known[text]

    def ask(self, text):
        """What Gappa says against a text."""
        done = subprocess.run([self.gappa], input=text, capture_output=True, text=True, check=False)
        said = done.stderr.strip()
        return said or ("" if done.returncode == 0 else f"status {done.returncode}")

    def flaws(self, name):
        """What is wrong with one proof."""
        text = self.texts[name]
        unknown = {place for place in PLACE.findall(text) if place not in self.constants}
        if unknown:
            yield f"{name}: unknown constants: {', '.join(sorted(unknown))}"
            return
        if said := self.refusal(name):
            yield f"{name}: not proven: {said}"
        for constant, value in LEAST.findall(text):
            yield from self.flaws_of_least(name, constant, value)
        for other, constant, value in USES.findall(text):
            if said := self.refusal(other, **{constant: value}):
                yield f"{name}: {other} does not hold for {constant} {value}: {said}"

    def flaws_of_least(self, name, constant, value):
        """What is wrong with the claim that a proof just holds for a value."""
        used, least = number(self.constants[constant]), number(value)
        print(f"{name}: {constant} is {used:g}, proven down to {least:g}, {least / used:.4f} of it")
        if used < least:
            yield f"{name}: {constant} is {used:g}, but only {value} is proven"
        if said := self.refusal(name, **{constant: value}):
            yield f"{name}: not proven for {constant} {value}: {said}"
        if not self.refusal(name, **{constant: float_text(0.99 * least)}):
            yield f"{name}: proven for 0.99 times {constant} {value}, too"


def float_text(value):
    """A double in Gappa's notation, exactly."""
    mantissa, denominator = value.as_integer_ratio()
    return f"{mantissa}b{1 - denominator.bit_length()}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--gappa", default="gappa")
    parser.add_argument("--constants", required=True)
    root = pathlib.Path(__file__).resolve().parents[2]
    parser.add_argument("--proofs", type=pathlib.Path, default=root / "kernel" / "proofs")
    options = parser.parse_args()
    if not shutil.which(options.gappa):
        sys.exit(f"{options.gappa} is not installed, so nothing is proven")
    proofs = Proofs(options.gappa, options.proofs, constants_of(options.constants))
    flaws = [flaw for name in proofs.texts for flaw in proofs.flaws(name)]
    used = {place for text in proofs.texts.values() for place in PLACE.findall(text)}
    flaws += [f"no proof is about {name}" for name in proofs.constants if name not in used]
    if not proofs.texts:
        flaws.append(f"no proof in {options.proofs}")
    for flaw in flaws:
        print(flaw, file=sys.stderr)
    print(f"{len(proofs.texts)} proofs, {len(flaws)} flaws")
    return 1 if flaws else 0


if __name__ == "__main__":
    sys.exit(main())
