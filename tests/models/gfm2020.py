#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Finds the blocks of the Geological Framework Model of southern California without a distance.

    tests/models/gfm2020.py build/release/cli/terrane [FOLDER [PAGE.html]]

The 20 boundaries of blocks and the Moho of GFM 2020 (SCEC; no licence is stated, so that the files are not in this
repository) are cut by a box of 930 x 830 km from -45 to -6 km and sealed by `--seal auto`; slivers are merged. The
volumes of the blocks must be those below, which agree with the model that SCEC made by hand where its boundaries are
among the files; docs/how-to/python-examples.md shows the largest. FOLDER has the collection of data (default: ../shared/data beside the repository); PAGE.html gets the report page. The exit status is
77 if the model is not there.
"""
import json
import pathlib
import subprocess
import sys
import tarfile
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
ARCHIVE = "SCECcode+GFM_web/GFM2020-inputs-dev.tar.xz"
BOX = "--box=-40000,3310000,-45000,890000,4140000,-6000"
VOLUMES = (  # in cubic metres, the largest first
    1.67207066e+16, 3.15648196e+15, 1.04635041e+15, 1.03729972e+15, 1.01057097e+15, 8.95345925e+14,
    7.9837488e+14, 7.69877987e+14, 7.33446483e+14, 7.06871492e+14, 5.55612599e+14, 5.21411474e+14,
    4.8474985e+14, 3.4861579e+14, 3.43128341e+14, 2.60839517e+14, 2.59360232e+14, 1.74233586e+14,
    1.29144085e+14, 6.52519502e+13, 4.64862239e+13, 2.55363234e+13, 1.13600639e+13, 1.43175864e+12,
    9.5420472e+11, 6.08841432e+11, 3.87048648e+10, 9.90282877e+09, 75419794.9, 58516188.5)


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    archive = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 and sys.argv[2] else ROOT.parent / "shared/data") / ARCHIVE
    if not archive.exists():
        print(f"skipped: there is no {archive}")
        return 77
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        with tarfile.open(archive) as files:
            files.extractall(folder)
        inputs = sorted((folder / "fault_boundaries").glob("*.ts")) + [folder / "moho_extended_crop.ts"]
        page = ["--report", sys.argv[3]] if len(sys.argv) > 3 else []
        subprocess.run([program, "volume", *inputs, BOX, "-o", folder / "model", "--seal", "auto",
                        "--min-volume", "auto", "--stats", folder / "stats.json", *page], check=True,
                       stdout=subprocess.DEVNULL)
        model = json.loads((folder / "model/model.json").read_text())
        stats = json.loads((folder / "stats.json").read_text())
    volumes = sorted((block["volume"] for block in model["blocks"][1:]), reverse=True)
    wrong = [f"{found:.9g} instead of {right:.9g}" for found, right in zip(volumes, VOLUMES)
             if abs(found - right) > 1e-6 * right]
    shown = (ROOT / "docs/how-to/python-examples.md").read_text()
    for block in sorted(model["blocks"][1:], key=lambda b: -b["volume"])[:5]:
        line = f"{block['volume'] / 1e9:.0f} km3: {block['name']}\n"
        if line not in shown:
            wrong.append(f"docs/how-to/python-examples.md does not show {line}")
    if len(volumes) != len(VOLUMES):
        wrong.append(f"{len(volumes)} blocks instead of {len(VOLUMES)}")
    if stats["seal"]["distance"] != 10:
        wrong.append(f"sealed by {stats['seal']['distance']} instead of 10")
    print("\n".join(wrong) or f"{len(volumes)} blocks, {len(stats['small_blocks']['merged'])} merged")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
