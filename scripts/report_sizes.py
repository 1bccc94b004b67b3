#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Measures report pages: size, time to write, time to the first picture, pictures per second while turning.

    scripts/report_sizes.py [--terrane build/release/cli/terrane] [--packages build/release/page] [COUNT...]

COUNT is a number of triangles (default: 100000 2000000 20000000) of one wavy grid, which `terrane convert --report` turns
into a page. Chromium draws it at 1600 x 900, in software (SwiftShader): any graphics card is faster. Prints a table in
Markdown. The largest takes some 10 GB of memory and some minutes.
"""
import argparse
import math
import pathlib
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent

MEASURE = """
import { createRequire } from "node:module";
const require = createRequire(process.argv[2] + "/package.json");
const { chromium } = require("playwright-core");
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });
const page = await browser.newPage({ viewport: { width: 1600, height: 900 } });
page.setDefaultTimeout(600000);
const start = Date.now();
await page.goto("file://" + process.argv[3]);
await page.waitForFunction(() => window.terrane?.view.frames > 0);
const first = (Date.now() - start) / 1000;
const turning = await page.evaluate(() => new Promise((resolve) => {
  const { view } = window.terrane, gl = view.renderer.getContext(), pixel = new Uint8Array(4);
  const warm = performance.now() + 3000;
  let start = 0, frames = 0;
  const step = () => {
    const now = performance.now();
    if (!start && now > warm) [start, frames] = [now, view.frames];
    if (start && now - start > 6000) return resolve(1000 * (view.frames - frames) / (now - start));
    view.viewpoint.turn(3, 0);
    requestAnimationFrame(() => {
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel); // waits for the picture
      step();
    });
  };
  step();
}));
const { drawn } = await page.evaluate(() => window.terrane.report.content.view);
console.log([first, turning, drawn].join(" "));
await browser.close();
"""


def write_grid(path, triangles):
    """Writes a wavy grid of about so many triangles as ESRI ASCII."""
    n = round(math.sqrt(triangles / 2)) + 1
    with open(path, "w") as out:
        out.write(f"ncols {n}\nnrows {n}\nxllcenter 450000\nyllcenter 6780000\ncellsize 25\nNODATA_value -9999\n")
        columns = [(180 * math.sin(31 * i / n), 5 * i / n) for i in range(n)]
        for j in range(n):
            row = 90 * math.cos(23 * j / n)
            out.write(" ".join(f"{a + row * math.sin(b + 7 * j / n) - 2000:.2f}" for a, b in columns) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--terrane", default=ROOT / "build/release/cli/terrane")
    parser.add_argument("--packages", default=ROOT / "build/release/page")
    parser.add_argument("counts", metavar="COUNT", nargs="*", type=int, default=[100_000, 2_000_000, 20_000_000])
    given = parser.parse_args()
    print("| triangles | drawn | page, MB | MB per 100 000 | written in, s | first picture, s | pictures per second |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "measure.mjs").write_text(MEASURE)
        page = folder / "page.html"
        for count in given.counts or [100_000, 2_000_000, 20_000_000]:
            write_grid(folder / "grid.asc", count)
            start = time.monotonic()
            subprocess.run([given.terrane, "convert", folder / "grid.asc", folder / "grid.ply", "--report", page], check=True,
                           stdout=subprocess.DEVNULL)
            seconds = time.monotonic() - start
            said = subprocess.run(["node", folder / "measure.mjs", pathlib.Path(given.packages).resolve(), page], check=True,
                                  capture_output=True, text=True).stdout.split()
            size = page.stat().st_size / 1e6
            print(f"| {count} | {said[2]} | {size:.1f} | {size * 1e5 / count:.3f} | {seconds:.1f} | {float(said[0]):.1f} | "
                  f"{float(said[1]):.1f} |", flush=True)


if __name__ == "__main__":
    main()
