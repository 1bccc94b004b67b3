# SPDX-License-Identifier: LGPL-3.0-or-later
"""Which fault stops short of which: relations, gaps, and what closing them would change."""

import matplotlib.pyplot as plt

import drawing
import terrane
from shapes import plane


def main():
    faults = [plane((1000, 1000, -750), 0, 88, 4000, 3000, "main"),
              plane((400, 1300, -750), 90, 85, 1120, 3000, "splay"),      # ends some metres before the main fault
              plane((1500, 700, -750), 75, 80, 1150, 3000, "east"),       # crosses it a little
              plane((1600, 1600, -750), 60, 85, 300, 600, "isolated")]    # ends in the middle of nowhere
    box = ((0, 0, -1500), (2000, 2000, 0))
    model = terrane.model(faults, box=box)
    for r in model.relations:
        if "boundary" not in r.from_surface + r.to_surface:
            gap = f", {r.least:.1f} to {r.largest:.1f} m away" if r.kind == "ends near" else ""
            print(f"{r.from_surface} {r.kind} {r.to_surface} along {r.length:.0f} m{gap}")
    print("closing these would separate blocks:",
          {(leak.from_surface, leak.to_surface) for leak in model.leaks if leak.verdict == "separates"} or "none")
    sealed = terrane.model(faults, box=box, seal=80)
    print(f"{len(model.blocks)} blocks; {len(sealed.blocks)} with gaps of up to 80 m closed")

    figure = plt.figure(figsize=(10, 4.5))
    left = drawing.axes(figure, 121, "four faults")
    for fault, colour in zip(faults, drawing.COLOURS):
        drawing.add(left, fault.vertices, fault.triangles, colour, alpha=0.8)
    right = drawing.axes(figure, 122, f"{len(sealed.blocks)} blocks after sealing")
    drawing.add_blocks(right, sealed)
    for ax in (left, right):
        drawing.finish(ax)
    drawing.save(figure, "fault_relations.png")


if __name__ == "__main__":
    main()
