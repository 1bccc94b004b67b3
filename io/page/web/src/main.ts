// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Puts the page together: the view with its controls on one side, tabs on the other.
import "./page.css";
import { readReport, type Content, type Finding, type Report, type RunInfo, type Table } from "./data";
import { itemList, lineList } from "./lists";
import { Plots } from "./plots";
import { tableOf } from "./tables";
import { button, coordinate, download, element, figure, named, Quantities, shortened } from "./text";
import { View, type Item, type Pick, type ViewName } from "./view";
import { overlay } from "./overlay";
import { controls, keys } from "./controls";

declare const TERRANE_LICENCES: { name: string; version: string; licence: string; text: string }[];

class Page {
  readonly view: View;
  readonly ready: Promise<void>;
  readonly picks: Pick[] = [];
  private readonly content: Content;
  private readonly quantities: Quantities;
  private readonly status = element("div", { class: "status", role: "status", "aria-live": "polite" });
  private readonly picked = element("div", { class: "picked", hidden: true });
  private readonly plots: Plots;
  private readonly tabs: { name: string; tab: HTMLButtonElement; panel: HTMLElement }[] = [];

  constructor(readonly report: Report) {
    this.content = report.content;
    this.quantities = new Quantities(this.content.unit);
    document.title = shortened(`${this.content.title || "Report"}: Terrane`, 120);
    this.setTheme(matchMedia("(prefers-color-scheme: dark)").matches);
    const stage = element("div", { class: "stage", tabindex: 0, role: "application",
      "aria-label": "Model. Arrow keys turn, Shift and arrow keys move, plus and minus zoom, 1 to 4 choose a view, 0 shows all." });
    const aside = element("aside", { "aria-label": "Contents" });
    document.body.append(this.header(), element("main", {}, stage, aside), this.status);
    this.view = new View(stage, report);
    this.view.renderer.domElement.setAttribute("aria-hidden", "true");
    stage.append(this.picked, overlay(this.view, this.quantities), this.viewButtons());
    keys(stage, this.view, () => this.clearPicks());
    this.listen(stage);
    const bar = element("div", { role: "tablist", "aria-label": "Contents" });
    aside.append(bar);
    this.addTab(bar, aside, "Model", this.modelPanel());
    this.addTab(bar, aside, "Findings", this.findingsPanel(), this.found());
    const plots = element("div");
    this.plots = new Plots(plots, this.content.plots, this.quantities);
    this.addTab(bar, aside, "Plots", plots);
    this.addTab(bar, aside, "Tables", this.tablesPanel());
    this.addTab(bar, aside, "About", this.aboutPanel());
    this.openTab(0);
    addEventListener("resize", () => this.plots.redraw());
    addEventListener("beforeprint", () => this.beforePrint());
    addEventListener("afterprint", () => this.setTheme(this.wasDark));
    this.ready = new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => resolve())));
  }

  // ---------------------------------------------------------------------------------------- frame

  private header(): HTMLElement {
    const { title, command, verdict } = this.content;
    const theme = button("◐", "Light or dark", () => this.setTheme(document.documentElement.dataset.theme !== "dark"));
    const head = element("header", {}, element("h1", {}, named(title || "Report"), element("span", {}, `terrane ${command}`)));
    if (verdict.text) head.append(element("p", { class: verdict.good ? "good" : "bad" }, verdict.good ? "✓ " : "✗ ", verdict.text));
    head.append(element("div", { class: "tools" },
      button("JSON", "Download all numbers as JSON", () => this.saveJson()),
      button("Print", "Print", () => print()), theme));
    return head;
  }

  private wasDark = false;
  setTheme(dark: boolean): void {
    document.documentElement.dataset.theme = dark ? "dark" : "light";
    this.view?.setTheme();
    this.plots?.redraw();
  }
  private beforePrint(): void {
    this.wasDark = document.documentElement.dataset.theme === "dark";
    this.setTheme(false);
    this.view.drawNow();
    for (const { panel } of this.tabs) panel.hidden = false;
    this.plots.redraw();
    addEventListener("afterprint", () => this.openTab(this.opened), { once: true });
  }

  private opened = 0;
  private addTab(bar: HTMLElement, aside: HTMLElement, name: string, panel: HTMLElement, count?: number): void {
    const i = this.tabs.length;
    const tab = element("button", { type: "button", role: "tab", id: `tab-${i}`, "aria-controls": `panel-${i}` }, name);
    if (count) tab.append(element("span", { class: "badge" }, String(count)));
    tab.addEventListener("click", () => this.openTab(i));
    tab.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (!step) return;
      this.openTab((i + step + this.tabs.length) % this.tabs.length);
      this.tabs[this.opened].tab.focus();
    });
    bar.append(tab);
    panel.id = `panel-${i}`;
    for (const [key, value] of Object.entries({ role: "tabpanel", "aria-labelledby": `tab-${i}`, tabindex: "0", "data-name": name }))
      panel.setAttribute(key, value);
    panel.classList.add("panel");
    aside.append(panel);
    this.tabs.push({ name, tab, panel });
  }
  openTab(number: number): void {
    this.opened = number;
    this.tabs.forEach(({ tab, panel }, i) => {
      tab.setAttribute("aria-selected", String(i === number));
      tab.tabIndex = i === number ? 0 : -1;
      panel.hidden = i !== number;
    });
    if (this.tabs[number].name === "Plots") this.plots.redraw();
  }

  private announce(text: string): void {
    this.status.textContent = text;
    setTimeout(() => { if (this.status.textContent === text) this.status.textContent = ""; }, 4000);
  }

  // ---------------------------------------------------------------------------------------- panels

  private modelPanel(): HTMLElement {
    const { view, content } = this;
    const panel = element("div", {}, controls(view));
    const of = (kind: Item["kind"]) => view.items.filter((item) => item.kind === kind);
    const choose = (item: Item) => this.choose(item);
    if (of("block").length) panel.append(itemList("Blocks", of("block"), view, this.quantities, choose));
    if (of("surface").length) panel.append(itemList("Surfaces", of("surface"), view, this.quantities, choose));
    if (view.lines.length) panel.append(lineList(view, content, this.quantities));
    const { triangles, drawn, cell, tetrahedra_left_out: left } = content.view;
    if (cell > 0)
      panel.append(element("p", { class: "note", id: "decimated" },
        `For view only, ${drawn.toLocaleString("en")} of ${triangles.toLocaleString("en")} triangles are drawn: vertices within ` +
        `${this.quantities.text(cell, "length", 3)} were joined. All numbers are those of the whole model.`));
    if (left > 0)
      panel.append(element("p", { class: "note" }, `${left.toLocaleString("en")} tetrahedra are too many to draw; sections show the blocks.`));
    return panel;
  }

  private choose(item: Item): void {
    if (!item.visible) this.announce(`${shortened(item.name, 60)} is hidden`);
    const { model } = this.view;
    this.view.flyTo(model.toInput(item.centre.clone().add(this.view.offsetOf(item))), model.unit * item.reach * Math.max(1, this.view.exaggeration ** 0.5));
    this.view.mark([]);
  }

  /** The number of findings, without the worst triangles and tetrahedra, which every mesh has. */
  private found(): number {
    return Object.entries(this.content.findings.counts).reduce((sum, [kind, count]) => sum + (kind.startsWith("worst") ? 0 : count), 0);
  }
  private findingsPanel(): HTMLElement {
    const { list, counts } = this.content.findings;
    const panel = element("div");
    if (this.found() === 0) panel.append(element("p", {}, "Nothing was found that is wrong or worth a look."));
    for (const [kind, count] of Object.entries(counts)) {
      const of = list.filter((f) => f.kind === kind);
      const rows = of.map((finding) => {
        const row = button("", `Fly to ${kind}`, () => this.flyTo(finding), { class: "finding" });
        row.removeAttribute("aria-label");
        row.append(element("span", { class: "size" }, this.sizeOf(finding)), named(finding.text, 1000));
        return element("li", {}, row);
      });
      const more = count > of.length ? [element("p", { class: "note" }, `The ${of.length} largest of ${count} are listed.`)] : [];
      panel.append(element("details", { open: of[0] === list[0] || of.length <= 50 },
        element("summary", {}, plural(kind, count), element("span", { class: "count" }, ` ${count.toLocaleString("en")}`)), element("ol", {}, ...rows), ...more));
    }
    return panel;
  }
  private sizeOf(finding: Finding): string {
    return finding.measure === "1 - q" ? `q ${figure(1 - finding.size, 2)}` : this.quantities.text(finding.size, finding.measure, 3);
  }
  flyTo(finding: Finding): void {
    this.view.flyTo(finding.place, finding.extent);
    const extent = 2 * this.view.model.radius * this.view.model.unit;
    this.announce(`${finding.kind} at ${finding.place.map((c) => coordinate(c, extent)).join(", ")}`);
  }

  private tablesPanel(): HTMLElement {
    const panel = element("div");
    const announce = (text: string) => this.announce(text);
    for (const table of [...this.content.tables, ...runTables(this.report.run)])
      if (table.rows.length) panel.append(tableOf(table, this.quantities, announce));
    return panel;
  }

  private aboutPanel(): HTMLElement {
    const panel = element("div", {},
      element("p", {}, `This page was written by terrane ${this.content.terrane} (LGPL-3.0-or-later). It asks no network for anything. ` +
        "Coordinates are those of the input; shapes are drawn in single precision."),
      element("p", {}, "Mouse: drag turns, right button moves, wheel zooms, click picks; a second click measures the distance. Keys: " +
        "arrows turn, Shift and arrows move, + and − zoom, 1 to 4 choose a view, 0 shows all, Escape ends measuring."),
      element("h3", {}, "Licences of the parts of this page"));
    for (const { name, version, licence, text } of TERRANE_LICENCES)
      panel.append(element("details", {}, element("summary", {}, `${name} ${version}: ${licence}`), element("pre", { tabindex: 0 }, text)));
    return panel;
  }

  saveJson(): void {
    const { arrays: _, ...numbers } = this.content;
    download(`${(this.content.title || "report").replace(/[^\w.-]+/g, "_").slice(0, 80)}.json`, "application/json",
      JSON.stringify({ ...numbers, run: this.report.run }, null, 1));
  }

  // ---------------------------------------------------------------------------------------- picking

  private viewButtons(): HTMLElement {
    const names: [ViewName, string, string][] = [["perspective", "3D", "Perspective"], ["top", "Top", "From above"],
      ["north", "N", "To the north"], ["east", "E", "To the east"]];
    return element("div", { class: "views", role: "group", "aria-label": "Views" },
      ...names.map(([name, text, label]) => button(text, label, () => this.view.look(name))),
      button("+", "Zoom in", () => this.view.viewpoint.zoom(1.25)), button("−", "Zoom out", () => this.view.viewpoint.zoom(0.8)));
  }

  /** Tells a click, which picks, from a drag. */
  private listen(stage: HTMLElement): void {
    let down: { x: number; y: number } | null = null;
    const canvas = this.view.renderer.domElement;
    canvas.addEventListener("pointerdown", (event) => { down = { x: event.clientX, y: event.clientY }; });
    canvas.addEventListener("pointerup", (event) => {
      if (!down || event.button !== 0 || Math.hypot(event.clientX - down.x, event.clientY - down.y) > 4) return;
      const box = stage.getBoundingClientRect();
      this.pick(event.clientX - box.left, event.clientY - box.top);
    });
  }

  pick(x: number, y: number): Pick | null {
    const hit = this.view.pick(x, y);
    if (!hit) {
      this.clearPicks();
      return null;
    }
    if (this.picks.length === 2) this.picks.length = 0;
    this.picks.push(hit);
    this.view.mark(this.picks.map((p) => p.place));
    this.showPicks();
    return hit;
  }
  clearPicks(): void {
    this.picks.length = 0;
    this.view.mark([]);
    this.picked.hidden = true;
  }
  /** The distance between the last two picks, in the input's unit; null with fewer. */
  distance(): number | null {
    if (this.picks.length < 2) return null;
    const [a, b] = this.picks;
    return Math.hypot(...a.place.map((c, k) => b.place[k] - c));
  }
  private showPicks(): void {
    const hit = this.picks[this.picks.length - 1], { item } = hit;
    const extent = 2 * this.view.model.radius * this.view.model.unit;
    const rows: [string, Node | string][] = [];
    if (item.kind === "block") {
      const title = item.numbers.length === 1 ? `Block ${item.numbers[0]}` : "Blocks";
      rows.push([title, named(item.name)], ["Volume", this.quantities.text(item.volume, "volume", 6)]);
      if (hit.tetrahedron >= 0) rows.push(["Tetrahedron", String(hit.tetrahedron)]);
    } else {
      rows.push(["Surface", named(item.name)], ["Area", this.quantities.text(item.area, "area", 6)]);
    }
    hit.place.forEach((c, k) => rows.push(["xyz"[k], `${coordinate(c, extent)}${this.content.unit ? " " + this.content.unit : ""}`]));
    const distance = this.distance();
    if (distance !== null) rows.push(["Distance", this.quantities.text(distance, "length", 6)]);
    this.picked.replaceChildren(button("×", "Close", () => this.clearPicks(), { class: "close" }),
      element("dl", {}, ...rows.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)])));
    this.picked.hidden = false;
  }
}

function plural(kind: string, count: number): string {
  const text = kind[0].toUpperCase() + kind.slice(1);
  if (count === 1) return text;
  if (text.startsWith("Leak between")) return text.replace("Leak", "Leaks");
  if (text.startsWith("Free border near")) return text.replace("border", "borders");
  if (text.startsWith("Triangle without")) return text.replace("Triangle", "Triangles");
  return text.endsWith("tetrahedron") ? text.replace(/on$/, "a") : text + "s";
}

function runTables(run: RunInfo): Table[] {
  return [
    { title: "Times", columns: [{ title: "stage", measure: "text" }, { title: "seconds", measure: "number" }],
      rows: Object.entries(run.seconds) },
    { title: "Memory and threads", columns: [{ title: "what", measure: "text" }, { title: "value", measure: "number" }],
      rows: [["peak memory, MiB", run.peak_rss_mb], ["threads (0: all cores)", run.threads]] },
  ];
}

readReport().then((report) => {
  const page = new Page(report);
  Object.assign(window, { terrane: page });
}).catch((error: unknown) => {
  document.body.append(element("p", { class: "failure", role: "alert" },
    `This report cannot be shown: ${error instanceof Error ? error.message : String(error)}`));
  throw error;
});
