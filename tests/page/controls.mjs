// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Each function uses a control of a page and judges the scene.
import { readFileSync } from "node:fs";
import { check, direction, heading, near, panel, reach, setRange, state, until } from "./support.mjs";

export async function tryExplode(page) {
  await setRange(page, "Explode", 0.5);
  const after = await state(page);
  for (const item of after.items)
    check(item.at.every((c, k) => near(c, item.kind === "block" ? item.centre[k] / 2 : 0, 1e-6 * Math.abs(c) + 1e-9)), "blocks move apart by their centres", item);
  check(after.lines.every(([, shown]) => !shown), "lines are hidden then");
  await setRange(page, "Explode", 0);
  check((await state(page)).items.every((item) => item.at.every((c) => c === 0)), "blocks come back");
}

/** The areas of a block's sections along an axis add up to its volume: this judges each cap. */
export async function trySection(page, hasTetrahedra) {
  for (const axis of ["x", "y", "z"]) {
    await page.locator('[data-control="Section axis"]').selectOption(axis);
    const { items } = await state(page);
    const k = "xyz".indexOf(axis);
    check(items.every((i) => i.planes.length === 1 && Math.abs(i.planes[0][k]) === 1), "all is cut by one plane across " + axis);
    const sums = await page.evaluate(([k, count]) => {
      const { view, report } = window.terrane;
      const sum = {}, height = 2 * view.model.half.getComponent(k);
      for (let i = 0; i < count; ++i) {
        view.cutAt({ axis: k, share: (i + 0.5) / count, flipped: false });
        for (const item of view.items.filter((i) => i.kind === "block"))
          sum[item.numbers[0]] = (sum[item.numbers[0]] ?? 0) + item.cut.area * height / count;
      }
      return report.content.blocks.map((b) => [b.volume, sum[b.number] ?? 0, view.items.find((i) => i.kind === "block" && i.numbers[0] === b.number)?.tetrahedra.length ?? 0]);
    }, [k, axis === "z" ? 100 : 25]);
    for (const [volume, sum, tetrahedra] of sums) {
      check(near(sum, volume, 0.02 * volume), "sections add up to the volume across " + axis, volume, sum);
      check(tetrahedra > 0 === hasTetrahedra, "sections are of tetrahedra where there are some");
    }
  }
  await setRange(page, "Section place", 0.25);
  const before = (await state(page)).items[0].planes[0];
  await page.locator('[data-control="Section flip"]').click();
  const after = (await state(page)).items[0].planes[0];
  check(before.every((c, i) => near(c, -after[i], 1e-9 * Math.abs(c))), "the other side is kept", before, after);
  await page.locator('[data-control="Section axis"]').selectOption("off");
  check((await state(page)).items.every((i) => i.planes.length === 0 && i.cap === 0), "the section is off");
}

export async function tryList(page) {
  const row = page.locator(".list li").first();
  await row.locator("input[type=checkbox]").uncheck();
  check(!(await state(page)).items.find((i) => i.kind === "block").visible, "a block is hidden");
  await row.locator("input[type=checkbox]").check();
  await row.locator("input[type=color]").evaluate((input) => { input.value = "#123456"; input.dispatchEvent(new Event("input")); });
  await row.locator("input[type=range]").evaluate((input) => { input.value = 0.5; input.dispatchEvent(new Event("input")); });
  const block = (await state(page)).items.find((i) => i.kind === "block");
  check(block.visible && block.colour === "123456" && block.opacity === 0.5, "a block has another colour and opacity", block);
  await page.getByRole("button", { name: "Hide all blocks" }).click();
  check((await state(page)).items.every((i) => i.kind !== "block" || !i.visible), "all blocks are hidden");
  await page.getByRole("button", { name: "Show all surfaces" }).click();
  check((await state(page)).items.every((i) => i.visible === (i.kind === "surface")), "all surfaces are shown");
  await page.getByRole("button", { name: "Show all blocks" }).click();
  const line = page.locator("section[aria-label=Lines] input").first();
  await line.uncheck();
  check(!(await state(page)).lines[0][1], "lines are hidden");
  await line.check();
  await page.locator('[data-control="Edges"]').check();
  check((await state(page)).items.every((i) => i.edges), "edges are shown");
  await page.locator('[data-control="Edges"]').uncheck();
  check((await state(page)).items.every((i) => !i.edges), "edges are hidden");
}


export async function tryCamera(page) {
  for (const [name, wanted] of [["From above", [0, 0, 1]], ["To the north", [0, -1, 0]], ["To the east", [-1, 0, 0]]]) {
    await page.getByRole("button", { name }).click();
    const s = await state(page);
    check(direction(s).every((c, k) => near(c, wanted[k], 1e-3)) && !s.perspective, name, direction(s));
  }
  await page.getByRole("button", { name: "Perspective" }).click();
  let before = await state(page);
  check(before.perspective, "perspective");
  await page.locator(".stage").focus();
  await page.keyboard.press("ArrowRight");
  let after = await state(page);
  check(near(heading(after) - heading(before), 6, 0.01), "an arrow key turns by 6 degrees", heading(before), heading(after));
  await page.keyboard.press("+");
  check(near(reach(await state(page)), reach(after) / 1.2, 1e-6 * reach(after)), "plus zooms");
  before = await state(page);
  await page.keyboard.press("Shift+ArrowUp");
  after = await state(page);
  check(reach({ camera: before.target, target: after.target }) > 0, "Shift and an arrow move the target");
  await page.keyboard.press("0");
  before = await state(page);
  await page.mouse.move(300, 350);
  await page.mouse.down();
  await page.mouse.move(400, 320, { steps: 4 });
  await page.mouse.up();
  after = await state(page);
  check(Math.abs(heading(after) - heading(before)) > 5 && after.marked === 0, "dragging turns, and picks nothing");
  await page.mouse.wheel(0, -300);
  check(await until(page, (s) => reach(s) < reach(after)), "the wheel zooms");
  before = await state(page);
  await page.mouse.move(300, 350);
  await page.mouse.down({ button: "right" });
  await page.mouse.move(360, 350, { steps: 3 });
  await page.mouse.up({ button: "right" });
  check(reach({ camera: before.target, target: (await state(page)).target }) > 0, "the right button moves the target");
  await page.keyboard.press("0");
}

export async function tryPicking(page) {
  await setRange(page, "Stretch z", 3);
  check((await state(page)).scale === 3, "heights are stretched");
  await page.mouse.click(290, 330);
  await page.mouse.click(340, 350);
  const found = await page.evaluate(() => {
    const { view, picks, report } = window.terrane;
    const { origin, half } = view.model;
    return { count: picks.length, distance: window.terrane.distance(), places: picks.map((p) => p.place), name: picks[1]?.item.name,
      inside: picks.every((p) => p.place.every((c, k) => Math.abs(c - origin[k]) <= half.getComponent(k) * 1.0001)),
      text: document.querySelector(".picked").textContent, unit: report.content.unit };
  });
  check(found.count === 2 && found.inside, "two places are picked, in the model's coordinates", found);
  if (found.count === 2) {
    const [a, b] = found.places;
    check(near(found.distance, Math.hypot(...a.map((c, k) => c - b[k])), 1e-9 * found.distance) && found.distance > 0, "the distance is that of the places");
    check(found.text.includes("Distance") && found.text.includes(found.name) && /Volume|Area/.test(found.text), "the name, a measure and the distance are shown", found.text);
    check((await state(page)).marked === 2, "both are marked");
  }
  await page.keyboard.press("Escape");
  await setRange(page, "Stretch z", 1);
}

export async function tryFindings(page) {
  await panel(page, "Findings");
  const finding = await page.evaluate(() => window.terrane.report.content.findings.list[0]);
  await page.locator(".finding").first().click();
  const s = await state(page);
  const origin = await page.evaluate(() => window.terrane.view.model.origin);
  check(s.target.every((c, k) => near(c, finding.place[k] - origin[k], 1e-6 * reach(s) + 1e-3)), "a click flies to a finding", s.target, finding.place);
  check(s.marked === 1, "it is marked");
  const sorted = await page.evaluate(() => {
    const { list } = window.terrane.report.content.findings;
    return list.every((f, i) => i === 0 || f.kind !== list[i - 1].kind || f.measure === "angle" || f.size <= list[i - 1].size);
  });
  check(sorted, "findings of a kind come by their size");
  const counts = await page.evaluate(() => window.terrane.report.content.findings.counts);
  const wrong = Object.entries(counts).filter(([kind]) => !/^worst /.test(kind)).reduce((sum, [, count]) => sum + count, 0);
  const badge = await page.getByRole("tab", { name: "Findings" }).locator(".badge").allTextContents();
  check(badge.join() === (wrong ? String(wrong) : ""), "the tab counts what is wrong, not the worst of sound triangles", ...badge);
  check((await page.getByText("Nothing was found that is wrong").count() > 0) === (wrong === 0), "the page says so where nothing is wrong");
  const rows = await page.locator(".finding").allTextContents();
  const worst = rows.filter((text) => /smallest angle|dihedral angle/.test(text));
  const twice = worst.filter((text) => text.match(text.includes("dihedral") ? /°|degrees/g : /\bq /g)?.length !== 1);
  check(worst.length > 0, "the worst triangles are listed");
  check(twice.length === 0, "a finding states its q or angle once", ...twice.slice(0, 3));
}

export async function tryTables(page) {
  await panel(page, "Tables");
  const table = page.locator("section.table", { hasText: "Blocks" }).first();
  const column = () => table.locator("tbody tr td:nth-child(1)").allTextContents();
  await table.getByRole("button", { name: "Sort by volume" }).click();
  const up = await column();
  await table.getByRole("button", { name: "Sort by volume" }).click();
  const down = await column();
  const volumes = await page.evaluate(() => window.terrane.report.content.blocks.map((b) => [b.number, b.volume]));
  const wanted = volumes.sort((a, b) => a[1] - b[1]).map(([n]) => String(n));
  check(up.join() === wanted.join() && down.join() === wanted.reverse().join(), "a table sorts by volume, both ways", up, wanted);
  await table.getByRole("button", { name: "Copy" }).click();
  const copied = await page.evaluate(() => navigator.clipboard.readText());
  check(copied.split("\n").length === volumes.length + 1 && copied.includes("\t"), "a table is copied", copied.slice(0, 80));
  const waiting = page.waitForEvent("download");
  await page.getByRole("button", { name: "Download all numbers as JSON" }).click();
  const saved = JSON.parse(readFileSync(await (await waiting).path(), "utf8"));
  check(saved.format === "terrane-report" && saved.blocks.length === volumes.length && saved.run.seconds.total > 0, "JSON is downloaded", Object.keys(saved));
}

/** Where pictures take long, they are simpler while the view moves, and whole once it rests. */
export async function tryPace(page) {
  const drawn = () => page.evaluate(() => {
    const { view } = window.terrane;
    return { level: view.pace.level, width: view.renderer.domElement.width, wide: view.lines.filter((l) => l.object.visible).length,
      thin: view.lines.filter((l) => l.thin.visible).length,
      triangles: view.items.reduce((sum, i) => sum + (i.visible ? i.mesh.geometry.index.count / 3 : 0), 0) };
  });
  await page.evaluate(() => {
    const { pace } = window.terrane.view;
    pace.stop();
    pace.learned = 0;
    pace.drawn = () => {}; // times are stated by this test, not measured
  });
  const all = await drawn();
  check(all.level === 0 && all.thin === 0 && all.wide > 0 && all.triangles > 20_000, "all is drawn at rest", all);
  await page.evaluate(() => {
    const { pace, viewpoint } = window.terrane.view;
    pace.judge(20, 0, 1e6);
    viewpoint.turn(2, 0);
  });
  check(JSON.stringify(await drawn()) === JSON.stringify(all), "a quick picture changes nothing");
  const moving = await page.evaluate(() => {
    const { pace, viewpoint } = window.terrane.view;
    const levels = [];
    pace.judge(5000, 0, 1e6);
    for (let i = 0; i < 4; ++i) {
      viewpoint.turn(2, 0);
      levels.push(pace.level);
      pace.judge(5000, pace.level, 30_000);
    }
    return levels;
  });
  check(moving.join() === "2,3,3,3", "slow pictures become simpler step by step", moving);
  const simple = await page.evaluate(() => window.terrane.view.viewpoint.turn(2, 0)).then(drawn);
  check(simple.triangles > 1000 && simple.triangles < 15_000 && near(simple.width, all.width / 2, 1), "they have fewer triangles and pixels", simple, all);
  check(simple.wide === 0 && simple.thin === all.wide, "and thin lines", simple);
  await page.waitForFunction(() => window.terrane.view.pace.level === 0);
  check(JSON.stringify(await drawn()) === JSON.stringify(all), "all is drawn again at rest");
  const again = await page.evaluate(() => window.terrane.view.viewpoint.turn(2, 0)).then(drawn);
  check(JSON.stringify(again) === JSON.stringify(simple), "the first picture of the next turn is simple, too", again, simple);
  const back = await page.evaluate(() => {
    const { pace } = window.terrane.view;
    return [1, 2, 3].map(() => (pace.judge(2, pace.learned, 8000), pace.learned));
  });
  check(back.join() === "2,1,0", "quick pictures become richer", back);
}

async function judgeAccess(page, axe, what) {
  await page.evaluate(axe);
  const violations = await page.evaluate(async () => (await window.axe.run(document, {
    resultTypes: ["violations"], runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "best-practice"],
  })).violations.filter((v) => ["serious", "critical"].includes(v.impact))
    .map((v) => `${v.id}: ${v.nodes.slice(0, 2).map((n) => n.html.slice(0, 120)).join(" | ")}`));
  check(violations.length === 0, `axe finds nothing serious in ${what}`, ...violations);
}

/** Opens each tab for axe, whose script is given, in light and dark. */
export async function tryAccess(page, axe) {
  for (const tab of ["Model", "Findings", "Plots", "Tables", "About"]) {
    await panel(page, tab);
    await judgeAccess(page, axe, tab);
  }
  await page.getByRole("button", { name: "Light or dark" }).click();
  check(await page.evaluate(() => document.documentElement.dataset.theme) === "dark", "the theme changes");
  await panel(page, "Plots");
  await judgeAccess(page, axe, "Plots, dark");
  await panel(page, "Model");
  await judgeAccess(page, axe, "Model, dark");
}

/** What was filled is an item of its own, and its variogram is drawn. */
export async function tryFilled(page) {
  const filled = await page.evaluate(() => window.terrane.view.items.map((i) => [i.name, i.geometry.index.count]));
  const sizes = await page.locator("section[aria-label=Surfaces] .size").allTextContents();
  const [given, interpolated] = sizes.map((text) => Number(text.replace(/[^\d.]/g, "")));
  check(interpolated > 0 && given > interpolated, "each has the area of its own", sizes);
  check(filled.length === 2 && filled[1][0] === "top: filled" && filled[1][1] > 0, "what was filled is apart", filled);
  const plots = await page.evaluate(() => window.terrane.report.content.plots.filter((p) => p.lines).map((p) => [p.title, p.lines.map((l) => [l.name, l.x.length])]));
  check(plots.length === 4 && plots.every(([, lines]) => lines.every(([, count]) => count > 1)), "each hole has a variogram and a cross-validation", plots);
  await panel(page, "Plots");
  check(await page.locator(".chart canvas").count() === await page.evaluate(() => window.terrane.report.content.plots.length), "all plots are drawn");
}

/** The policy allows no request and no other script. */
export async function tryPolicy(page) {
  const { ran, fetched } = await page.evaluate(async () => {
    const script = document.createElement("script");
    script.textContent = "window.intruder = true";
    document.body.append(script);
    script.remove();
    const fetched = await fetch("https://example.invalid/").then(() => true, () => false);
    return { ran: window.intruder === true, fetched };
  });
  check(!ran && !fetched, "the page runs no other script and fetches nothing");
}
