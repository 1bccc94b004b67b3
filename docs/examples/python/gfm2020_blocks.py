# SPDX-License-Identifier: LGPL-3.0-or-later
"""The Geological Framework Model of southern California (GFM 2020, SCEC) to closed blocks.

    python3 gfm2020_blocks.py GFM2020-inputs-dev.tar.xz

The archive is not part of Terrane, as no licence is stated; it is in the repository SCECcode/GFM_web.
"""

import pathlib
import sys
import tarfile
import tempfile

import matplotlib.pyplot as plt

import drawing
import terrane

BOX = ((-40000, 3310000, -45000), (890000, 4140000, -6000))


def main(archive):
    with tempfile.TemporaryDirectory() as folder:
        with tarfile.open(archive) as files:
            files.extractall(folder)
        surfaces = terrane.read([f"{folder}/fault_boundaries/*.ts", f"{folder}/moho_extended_crop.ts"])
    model = terrane.model(surfaces, box=BOX, seal="auto", min_volume="auto")
    print(f"{len(surfaces)} surfaces, {sum(len(s.triangles) for s in surfaces)} triangles, {len(model.blocks)} blocks")
    largest = sorted(model.blocks.values(), key=lambda b: -b.volume)[:5]
    for block in largest:
        print(f"{block.volume / 1e9:.0f} km3: {block.name}")

    figure = plt.figure(figsize=(10, 5))
    left = drawing.axes(figure, 121, f"{len(surfaces)} surfaces", stretch=4)
    for i, s in enumerate(surfaces):
        drawing.add(left, s.vertices, s.triangles, drawing.COLOURS[i % len(drawing.COLOURS)], alpha=0.6, edges=0)
    right = drawing.axes(figure, 122, f"{len(model.blocks)} blocks, moved apart", stretch=4)
    drawing.add_blocks(right, model)
    for ax in (left, right):
        drawing.finish(ax)
    drawing.save(figure, "gfm2020_blocks.png")


if __name__ == "__main__":
    if len(sys.argv) != 2 or not pathlib.Path(sys.argv[1]).exists():
        sys.exit(__doc__)
    main(sys.argv[1])
