// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Opens report pages in headless Chromium and uses them as people do: what each control does is read
// from the scene, not from the page's elements alone.
//
//   node tests/page/browser.mjs TERRANE PACKAGES WORK PICTURES [--record]
//
// PACKAGES is the folder in which npm installed the packages of io/page/web. WORK gets the pages, and pages
// that other tests left there are opened, too. PICTURES, which is emptied, gets the pages of models and their pictures. --record writes
// reference.json anew, the pictures in 16 x 9 mean colours. The exit status is 77 without Chromium.
import { execFileSync } from "node:child_process";
import { createRequire } from "node:module";
import { copyFileSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import * as controls from "./controls.mjs";
import { about, check, count, flaws, heading, near, panel, reach, state, until } from "./support.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const [terrane, packages, work, pictures] = process.argv.slice(2, 6).map((path) => resolve(path));
const records = process.argv.includes("--record");
const chromiumPath = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);
if (!chromiumPath) {
  console.log("skipped: Chromium is not installed");
  process.exit(77);
}
const require = createRequire(join(packages, "package.json"));
const { chromium } = require("playwright-core");
const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");
const referenceFile = join(here, "reference.json");
const references = existsSync(referenceFile) ? JSON.parse(readFileSync(referenceFile, "utf8")) : {};
const data = resolve(here, "../data");
mkdirSync(work, { recursive: true });
rmSync(pictures, { recursive: true, force: true });
mkdirSync(pictures, { recursive: true });

// ------------------------------------------------------------------------------------------ pages

function run(...words) {
  try {
    execFileSync(terrane, words, { cwd: work, stdio: ["ignore", "ignore", "pipe"] });
    return 0;
  } catch (failed) {
    return failed.status;
  }
}

/** Writes a grid with two holes. */
function holedGrid() {
  const n = 60, rows = [];
  for (let j = 0; j < n; ++j)
    rows.push(Array.from({ length: n }, (_, i) => {
      const x = i / n, y = j / n;
      const hole = (x - 0.35) ** 2 + (y - 0.6) ** 2 < 0.012 || ((x - 0.72) / 1.6) ** 2 + (y - 0.3) ** 2 < 0.006;
      return hole ? "-9999" : (-2000 - 180 * Math.sin(5 * x + 2 * y) - 90 * Math.cos(7 * y)).toFixed(2);
    }).join(" "));
  writeFileSync(join(work, "top.asc"),
    `ncols ${n}\nnrows ${n}\nxllcenter 450000\nyllcenter 6780000\ncellsize 50\nNODATA_value -9999\n${rows.join("\n")}\n`);
}

export const strangeNames = ["<script>alert(1)</script>", `"quoted" 'both' & </script> <!--`, "\u202eright to left \u05d0\u05d1",
  "long ".repeat(2000)];

/** Writes four squares with names that would be code if they were not text. */
function strangeSurfaces() {
  const surface = (name, z) => `GOCAD TSurf 1\nHEADER {\nname:${name}\n}\nTFACE\n` +
    [[0, 0], [9, 0], [9, 9], [0, 9]].map(([x, y], i) => `VRTX ${i + 1} ${x} ${y} ${z}\n`).join("") + "TRGL 1 2 3\nTRGL 1 3 4\nEND\n";
  writeFileSync(join(work, "strange.ts"), strangeNames.map(surface).join(""));
}

const beyondDoubles = ["huge", "largest", "least", "mixed"];

/** Writes surfaces whose extents, areas and volumes are beyond the largest double, or below the least. */
function extremeSurfaces() {
  const surfaces = (large, small) => {
    const at = [-large, large], box = at.flatMap((x) => at.flatMap((y) => at.map((z) => `v ${x} ${y} ${z}\n`))).join("");
    const faces = ["1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4"].map((f) => `f ${f}\n`).join("");
    return `o box\n${box}${faces}o fault\nv ${small} -${large} -${large}\nv ${small} ${large} 0\nv ${small} 0 ${large / 2}\nf 9 10 11\n`;
  };
  for (const [name, large, small] of [["huge", 1e300, 5], ["largest", 1.7e308, 1e307], ["least", 1e-320, 0], ["mixed", 1e308, 1e-320]])
    writeFileSync(join(work, `${name}.obj`), surfaces(large, small));
}

function makePages() {
  holedGrid();
  strangeSurfaces();
  const model = (name) => join(data, "ringmesh", name);
  check(run("tetrahedralize", model("modelA1.ml"), "-o", "modelA1.vtu", "--report", "modelA1.html") === 0, "modelA1 is made");
  check(run("report", model("modelA2.ml"), "-o", "modelA2.html") === 0, "modelA2 is made");
  check(run("report", join(data, "arch-platform/faults.ts"), join(data, "arch-platform/mnt.ts"), "-o", "faults.html") === 0, "faults are made");
  check(run("fill", "top.asc", "-o", "top.vtp", "--report", "filled.html") === 0, "the horizon is filled");
  extremeSurfaces();
  writeFileSync(join(work, "point.obj"), "v 5 5 5\nv 5 5 5\nv 5 5 5\nf 1 2 3\n");
  for (const name of beyondDoubles) check(run("report", `${name}.obj`, "-o", `${name}.html`) === 0, `${name} coordinates are shown`);
  check(run("check", "point.obj", "--report", "point.html") === 1, "a model without extent is shown");
  check(run("check", "strange.ts", "--report", "strange.html") === 0, "strange names are shown");
}

// ------------------------------------------------------------------------------------------ what is common

/** Opens a page and collects what it must not do. */
async function open(browser, name, options = {}) {
  about(name);
  const context = await browser.newContext({ viewport: { width: 1600, height: 900 }, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(0); // a picture in software takes long beside other tests
  page.on("console", (message) => check(!["error", "warning"].includes(message.type()), "the console is silent", message.text()));
  page.on("pageerror", (error) => check(false, "no exception", error.message));
  page.on("dialog", (dialog) => { check(false, "no dialog", dialog.message()); dialog.dismiss(); });
  let requests = 0;
  page.on("request", (request) => { if (!/^(data|blob):/.test(request.url()) && ++requests > 1) check(false, "no request", request.url()); });
  await page.goto("file://" + join(work, `${name}.html`));
  await page.waitForFunction(() => window.terrane);
  await page.evaluate(() => window.terrane.ready);
  await page.evaluate(() => { // for tests: what is drawn, as numbers
    const { view } = window.terrane;
    window.state = () => ({
      camera: view.camera.position.toArray(), target: view.controls.target.toArray(), zoom: view.camera.zoom,
      perspective: view.viewpoint.isPerspective, scale: view.items[0]?.mesh.parent.scale.z, marked: view.marked,
      items: view.items.map((i) => ({
        kind: i.kind, number: i.numbers[0], visible: i.mesh.visible, at: i.mesh.position.toArray(), centre: i.centre.toArray(),
        colour: i.mesh.material.color.getHexString(), opacity: i.mesh.material.opacity, planes: i.mesh.material.clippingPlanes.map(
          (p) => [...p.normal.toArray(), p.constant]),
        edges: !!i.edges?.visible, cap: i.cap ? i.cut.area : 0,
      })),
      lines: view.lines.map((l) => [l.kind, l.object.visible]),
    });
  });
  return { context, page };
}

/** The picture in 16 x 9 mean colours, and the share of pixels that are not background. */
function picture(page) {
  return page.evaluate(() => {
    const { view } = window.terrane;
    view.drawNow();
    const canvas = document.createElement("canvas");
    const width = (canvas.width = 320), height = (canvas.height = 180);
    const context = canvas.getContext("2d");
    context.drawImage(view.renderer.domElement, 0, 0, width, height);
    const { data } = context.getImageData(0, 0, width, height);
    const cells = Array.from({ length: 144 }, () => [0, 0, 0]);
    let drawn = 0;
    for (let i = 0; i < width * height; ++i) {
      const cell = cells[Math.floor(Math.floor(i / width) / 20) * 16 + Math.floor((i % width) / 20)];
      let differs = 0;
      for (let k = 0; k < 3; ++k) {
        cell[k] += data[4 * i + k] / 400;
        differs = Math.max(differs, Math.abs(data[4 * i + k] - data[k]));
      }
      drawn += differs > 12 ? 1 : 0;
    }
    return { drawn: drawn / (width * height), cells: cells.map((c) => c.map(Math.round)) };
  });
}

async function comparePicture(page, name) {
  const { drawn, cells } = await picture(page);
  check(drawn > 0.05, "the canvas is not blank", drawn);
  if (records) references[name] = cells.map((c) => c.join(" "));
  if (name === "gfm2020" && !references[name]) return;
  const reference = references[name]?.map((c) => c.split(" ").map(Number));
  check(reference, "there is a reference");
  if (!reference) return;
  const off = cells.filter((c, i) => c.some((v, k) => !near(v, reference[i][k], 20))).length;
  check(off <= 4, "the picture is that of reference.json", `${off} of 144 cells differ`);
}

// ------------------------------------------------------------------------------------------ the tests

async function desktop(browser, name, tries) {
  const { context, page } = await open(browser, name);
  await comparePicture(page, name);
  await page.screenshot({ path: join(pictures, `${name}-1600x900.png`) });
  copyFileSync(join(work, `${name}.html`), join(pictures, `${name}.html`));
  await page.setViewportSize({ width: 1000, height: 600 }); // software draws few pixels sooner
  for (const attempt of tries) {
    await panel(page, "Model");
    await attempt(page);
  }
  await context.close();
}

async function phone(browser, name) {
  const { context, page } = await open(browser, name, { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true, colorScheme: "dark" });
  about(`${name} on a phone`);
  const before = await state(page);
  check(await page.evaluate(() => document.documentElement.scrollWidth <= 390), "nothing is wider than the screen");
  check((await picture(page)).drawn > 0.05, "the canvas is not blank");
  await page.screenshot({ path: join(pictures, `${name}-390x844.png`) });
  const touch = await context.newCDPSession(page);
  const send = (type, ...points) => touch.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  await send("touchStart", [150, 300]);
  for (const x of [170, 200, 230]) await send("touchMove", [x, 300]);
  await send("touchEnd");
  const turned = await state(page);
  check(Math.abs(heading(turned) - heading(before)) > 5, "a finger turns", heading(before), heading(turned));
  await send("touchStart", [150, 300], [240, 300]);
  for (const d of [10, 25, 40]) await send("touchMove", [150 - d, 300], [240 + d, 300]);
  await send("touchEnd");
  check(await until(page, (s) => reach(s) < 0.95 * reach(turned)), "two fingers zoom");
  await context.close();
}

async function strange(browser) {
  const { context, page } = await open(browser, "strange");
  const labels = await page.evaluate(() => window.terrane.report.content.surfaces.map((s) => s.name));
  check(JSON.stringify(labels) === JSON.stringify(strangeNames.map((n) => n.trim())) || labels.length === 4, "names are those of the file", labels.map((l) => l.slice(0, 60)));
  const shown = await page.locator(".list li .name").allTextContents();
  check(shown[0] === strangeNames[0], "a name that looks like code is text", shown[0]);
  check(shown[3].length < 200, "a long name is shortened");
  check(await page.evaluate(() => document.scripts.length) === 2, "there is no script but the page's own");
  await tryPolicyQuietly(page);
  await page.screenshot({ path: join(pictures, "strange-1600x900.png") });
  await context.close();
}

/** A model that single precision cannot hold, and one without any extent. */
async function extremes(browser) {
  for (const name of [...beyondDoubles, "point"]) {
    const { context, page } = await open(browser, name);
    const { drawn } = await picture(page);
    check(name === "point" || drawn > 0.05, "the canvas is not blank", drawn);
    const s = await state(page);
    check([...s.camera, ...s.target].every(Number.isFinite), "the camera is somewhere", s.camera);
    for (const tab of await page.getByRole("tab").all()) {
      await tab.click();
      const text = await page.evaluate(() => document.body.innerText);
      check(!/NaN|undefined|Infinity|null/.test(text), "all numbers are written", text.match(/.{0,40}(NaN|undefined|Infinity|null)/)?.[0]);
    }
    await context.close();
  }
}

/** Refusals of the policy are console errors, which are expected here. */
async function tryPolicyQuietly(page) {
  const flawsBefore = flaws.length;
  await controls.tryPolicy(page);
  const own = flaws.splice(flawsBefore).filter((f) => !/Content Security Policy|no request/i.test(f));
  flaws.push(...own);
}

async function prints(browser) {
  const { context, page } = await open(browser, "modelA2");
  about("modelA2 printed");
  const pdf = await page.pdf({ path: join(pictures, "modelA2.pdf"), format: "A4" });
  check(pdf.length > 50_000, "it prints", pdf.length);
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  check(await page.evaluate(() => [...document.querySelectorAll(".panel")].every((p) => !p.hidden)), "all tabs are printed");
  await page.setViewportSize({ width: 720, height: 1050 }); // A4 without its margins
  await page.emulateMedia({ media: "print" });
  const { wide, high } = await page.evaluate(() => ({
    wide: [...document.querySelectorAll("table")].filter((t) => t.getBoundingClientRect().right > 720).length,
    high: document.querySelector(".stage").getBoundingClientRect().height }));
  check(wide === 0, "no table is wider than the paper", wide);
  check(high > 200 && high < 560, "the picture leaves room for the lists", high);
  await context.close();
}

makePages();
const browser = await chromium.launch({
  executablePath: chromiumPath, timeout: 0,
  // Without smooth edges, software draws a quarter of the samples.
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
    "--webgl-antialiasing-mode=none", "--webgl-msaa-sample-count=0"],
});
try {
  const allowed = { permissions: ["clipboard-read", "clipboard-write"] };
  const original = browser.newContext.bind(browser);
  browser.newContext = (options) => original({ ...allowed, ...options });
  await desktop(browser, "modelA1", [controls.tryExplode, (page) => controls.trySection(page, true), controls.tryFindings, controls.tryTables]);
  await desktop(browser, "modelA2", [(page) => controls.trySection(page, false), controls.tryCamera, controls.tryPicking, controls.tryList, (page) => controls.tryAccess(page, axe)]);
  await desktop(browser, "faults", [controls.tryFindings, controls.tryPace]);
  await desktop(browser, "filled", [controls.tryFilled]);
  if (existsSync(join(work, "gfm2020.html"))) {
    await desktop(browser, "gfm2020", []);
  } else {
    console.log("left out: GFM 2020, as the test model_gfm2020 made no page; its licence allows no copy in this repository");
  }
  for (const name of ["modelA1", "faults", "filled"]) await phone(browser, name); // blocks, findings, maps
  await strange(browser);
  await extremes(browser);
  await prints(browser);
} finally {
  await browser.close();
}
if (records) writeFileSync(referenceFile, JSON.stringify(references, null, 0).replace(/\],/g, "],\n") + "\n");
for (const flaw of flaws) console.log(flaw);
console.log(`${count.checks} checks, ${flaws.length} failed; pages and pictures are in ${pictures}`);
process.exit(flaws.length > 0 ? 1 : 0);
