#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Writes docs/reference/python.md from the docstrings of the package; a test compares the two.

usage: PYTHONPATH=build/release/python python/reference.py > docs/reference/python.md
"""

import inspect
import sys
import textwrap

sys.path.pop(0)  # the sources beside this file have no extension module

import terrane  # noqa: E402

GROUPS = [
    ("Input", "Surface Frame ROLES as_surface as_surfaces read save mesh"),
    ("Stages", "arrange round check regions volumes structure volume_of_interest box rotated_box polygon closed extend "
               "seal suggest_seal improve distance holes fill layers select map_surface model section log_well read_wells tetrahedralize verify judge build ensemble"),
    ("Models", "Model Block Blocks PartAbove Interface Leak Relation Juxtaposition"),
    ("Results", "Arrangement RoundedMesh RoundingReport Mesh CheckReport Contact Regions Region Volumes Structure "
                "Corner Line Patch InterfaceParts BlockParts VolumeOfInterest SurfaceCut OpenBorder Sealed "
                "SealChange ClosedGap OpenGap SealAdvice SealTrial Improved BorderLoop Filled FilledHole FillReport "
                "Layered LayerReport OutOfOrder Selected SelectedPiece Map Section SectionPolygon SectionLine WellPath WellLog WellInterval WellMarker BlocksInCells Tetrahedra BlockVolume Violation Verdict VerifiedFile RuleViolation MeshJudgement "
                "JudgedProperty PropertyFlaw "
                "Built Ensemble BlockOutcome Juxtaposed Failure"),
    ("Small things", "IndexLists SurfaceInfo NO_INDEX HAS_REPORTS keep_freed_memory Error OutOfMemory Doubt ERROR_CODES"),
]
CONSTANTS = {"ROLES": "The roles that a surface can have: {}.", "ERROR_CODES": "The codes of `Error.code`: {}.",
             "HAS_REPORTS": "Whether this build can write report pages.",
             "NO_INDEX": "The index that means none, as in the corners of a closed line: {}."}

HEAD = """# Python package

This page lists what `import terrane` gives, by the first sentences of the docstrings; `help(terrane.model)` shows all
of one. `python/reference.py` writes it, and a test compares. [Use Terrane in Python](../how-to/python.md) shows how to
begin.

All stages take `threads` (all cores unless given; no result depends on it) and `progress` (a function of the name of
the stage and the share of it that is done, or a bar of tqdm). They run without the GIL and stop at a
KeyboardInterrupt. Arrays of results are read-only views of the library's memory, which they keep alive. Coordinates,
lengths, areas and volumes are in the unit of the input, angles in degrees. Results can be pickled, copied and
compared; a pickle of an arrangement or of a model holds its surfaces, and the rest is made again when it is read, bit
for bit the same.

Memory: a `Surface` has a copy of its arrays, 24 bytes per vertex and 12 per triangle, which was checked when it was
made and which nobody can change. While a stage runs it has one more.
"""


def first_paragraph(value):
    """Return the first paragraph of a docstring, for a table."""
    text = inspect.getdoc(value).split("\n\n")[0].replace("\n", " ")
    return text.replace("|", "\\|").replace("``", "`")


def row(name):
    """Return the row of a name."""
    value = getattr(terrane, name)
    if name in CONSTANTS:
        said = ", ".join(f"`{v}`" for v in value) if isinstance(value, tuple) else f"`{value}`"
        return f"| `{name}` | {CONSTANTS[name].format(said)} |"
    if inspect.isfunction(value):
        names = [p for p in inspect.signature(value).parameters if p not in ("threads", "progress")]
        return f"| `{name}({', '.join(names)})` | {first_paragraph(value)} |"
    return f"| `{name}` | {first_paragraph(value)} |"


def item(name, fields):
    """Return an item of a list, in lines of at most 120 columns."""
    return textwrap.fill(f"- `{name}`: {', '.join(f'`{f}`' for f in fields)}", 120, subsequent_indent="  ")


def members(name):
    """Return a sentence with the attributes and methods of a result."""
    cls = getattr(terrane, name)
    fields = getattr(cls, "_fields", None)
    if fields is not None:
        return item(name, fields)
    found = []
    ours = [base for base in cls.__mro__ if base.__module__.startswith("terrane.")]
    for base in [*reversed(ours), *(base for base in cls.__mro__[:-1] if base not in ours)]:
        slots = getattr(base, "__slots__", ())
        for key in [*slots, *vars(base)]:
            value = vars(base).get(key)
            if not key.startswith("_") and key not in [f.rstrip("()") for f in found]:
                found.append(f"{key}()" if inspect.isfunction(value) else key)
    if not found:  # attributes that only the docstring lists
        section = inspect.getdoc(cls).split("Attributes\n----------\n")[1].split("\n\n")[0]
        found = [k for line in section.splitlines() if not line.startswith(" ") for k in line.split(" : ")[0].split(", ")]
    return item(name, sorted(found, key=lambda key: key.endswith("()")))


def page():
    """Return the page."""
    lines = [HEAD]
    for title, names in GROUPS:
        lines += [f"## {title}", "", "| Name | Meaning |", "|---|---|", *map(row, names.split()), ""]
    lines += ["## Attributes and methods", ""]
    for _, names in GROUPS:
        lines += [members(n) for n in names.split() if inspect.isclass(getattr(terrane, n))
                  and not issubclass(getattr(terrane, n), Exception)]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    print(page(), end="")
