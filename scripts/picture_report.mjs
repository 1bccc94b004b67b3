// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Draws docs/report.png: modelA2 with better triangles and even tetrahedra, its page with blocks apart and a section.
//
//   node scripts/picture_report.mjs [TERRANE [PACKAGES [TARGET.png]]]
//
// PACKAGES is the folder into which the build installed npm's packages. Needs Chromium.
import { execFileSync } from "node:child_process";
import { createRequire } from "node:module";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const root = dirname(dirname(fileURLToPath(import.meta.url)));
const [terrane, packages, target] = ["build/release/cli/terrane", "build/release/page", "docs/report.png"]
  .map((path, i) => resolve(process.argv[2 + i] ?? join(root, path)));
const { chromium } = createRequire(join(packages, "package.json"))("playwright-core");
const folder = mkdtempSync(join(tmpdir(), "terrane-picture-"));
const page = join(folder, "page.html");
writeFileSync(join(folder, "project.json"), JSON.stringify({
  format: "terrane-project 1",
  surfaces: [{ file: join(root, "tests/data/ringmesh/modelA2.ml") }],
  improve: { edge_length: 500 },
  tetrahedra: { edge_length: 500 },
  outputs: { tetrahedra: ["vtu"] },
}));
execFileSync(terrane, ["build", join(folder, "project.json"), "-o", join(folder, "results"), "--report", page], { stdio: "ignore" });

const browser = await chromium.launch({ executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });
const shown = await browser.newPage({ viewport: { width: 1440, height: 810 }, colorScheme: "light" });
await shown.goto("file://" + page);
await shown.waitForFunction(() => window.terrane);
await shown.evaluate(() => {
  const set = (name, value, event = "input") => {
    const control = document.querySelector(`[data-control="${name}"]`);
    control.value = value;
    control.dispatchEvent(new Event(event));
  };
  const { view } = window.terrane;
  set("Explode", 0.22);
  view.look("perspective");
  set("Section axis", "y", "change");
  set("Section place", 0.3);
  view.viewpoint.turn(8, 4);
  view.viewpoint.zoom(1.12);
});
await shown.waitForTimeout(1500); // the view rests, and is drawn in full
await shown.screenshot({ path: target });
await browser.close();
rmSync(folder, { recursive: true });
