// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Bar plots by uPlot, each with a table of the same numbers for those who cannot see it.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import type { Plot } from "./data";
import { element, figure, type Quantities } from "./text";

const seriesColours = ["#7f8c99", "#2b7bba"]; // before, after: distinct in lightness

/** Draws all plots; call `redraw` after the theme or the width has changed. */
export class Plots {
  private readonly drawn: { plot: Plot; place: HTMLElement; chart: uPlot | null }[] = [];

  constructor(place: HTMLElement, plots: Plot[], private readonly quantities: Quantities) {
    if (plots.length === 0) place.append(element("p", {}, "Nothing was measured."));
    for (const plot of plots) {
      const chart = element("div", { class: "chart", role: "img", "aria-label": `${plot.title}. The table below has the numbers.` });
      place.append(element("figure", {}, element("figcaption", {}, plot.title), chart, this.numbers(plot)));
      this.drawn.push({ plot, place: chart, chart: null });
    }
  }

  /** Lists the values of a plot; of points at most the first 500. */
  private numbers(plot: Plot): HTMLElement {
    const body = element("tbody");
    if (plot.lines) {
      for (const line of plot.lines)
        for (let i = 0; i < Math.min(line.x.length, 500); ++i)
          body.append(element("tr", {}, element("td", {}, line.name), element("td", {}, figure(line.x[i], 6)), element("td", {}, figure(line.y[i], 6))));
      return this.hidden(plot, element("tr", {}, ...["", this.quantities.label(plot.x.label, plot.x.measure),
        this.quantities.label(plot.y.label, plot.y.measure)].map((t) => element("th", {}, t || "of"))), body);
    }
    const series = plot.series ?? [];
    const rows = series[0]?.values.length ?? 0;
    for (let i = 0; i < rows; ++i)
      body.append(element("tr", {}, element("td", {}, this.name(plot, i)),
        ...series.map((s) => element("td", {}, this.quantities.text(s.values[i], plot.y.measure)))));
    const head = element("tr", {}, element("th", {}, this.quantities.label(plot.x.label, plot.x.measure)),
      ...series.map((s) => element("th", {}, s.name)));
    return this.hidden(plot, head, body);
  }
  private hidden(plot: Plot, head: HTMLElement, body: HTMLElement): HTMLElement {
    return element("details", {}, element("summary", {}, "Numbers"),
      element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": plot.title }, element("table", {}, element("thead", {}, head), body)));
  }
  private name(plot: Plot, i: number): string {
    return plot.names ? plot.names[i] : `${figure(plot.bounds![i], 3)} – ${figure(plot.bounds![i + 1], 3)}`;
  }

  redraw(): void {
    for (const entry of this.drawn) {
      entry.chart?.destroy();
      entry.chart = null;
      const width = entry.place.clientWidth;
      if (width > 0) entry.chart = entry.plot.lines ? this.lines(entry.plot, entry.place, width) : this.bars(entry.plot, entry.place, width);
    }
  }

  /** Points and lines, such as a variogram. */
  private lines(plot: Plot, place: HTMLElement, width: number): uPlot {
    const style = getComputedStyle(document.documentElement);
    const ink = style.getPropertyValue("--ink").trim(), grid = { stroke: style.getPropertyValue("--line").trim(), width: 1 };
    const axis = { stroke: ink, grid, ticks: grid, font: "12px system-ui", labelFont: "12px system-ui" };
    const lines = plot.lines!;
    const all = uPlot.join(lines.map((line) => { // equal x are told apart by less than can be seen
      const step = (Math.max(...line.x) - Math.min(...line.x)) * 1e-9;
      return [line.x.map((x, i) => x + i * step), line.y];
    }));
    const write = (_: uPlot, values: number[]) => values.map(short);
    return new uPlot({
      width, height: 230, legend: { live: false }, cursor: { drag: { x: false, y: false } }, scales: { x: { time: false } },
      axes: [{ ...axis, label: this.quantities.label(plot.x.label, plot.x.measure), labelSize: 22, size: 28, values: write },
        { ...axis, label: this.quantities.label(plot.y.label, plot.y.measure), labelSize: 20, size: 58, values: write }],
      series: [{}, ...lines.map((line) => ({
        label: line.name, stroke: line.dots ? seriesColours[1] : ink, width: line.dots ? 0 : 1.5, spanGaps: true,
        paths: line.dots ? () => null : uPlot.paths.linear!(), points: { show: line.dots, size: 5, fill: seriesColours[1] },
      }))],
    }, all, place);
  }

  private bars(plot: Plot, place: HTMLElement, width: number): uPlot {
    const series = plot.series!;
    const style = getComputedStyle(document.documentElement);
    const ink = style.getPropertyValue("--ink").trim(), grid = style.getPropertyValue("--line").trim();
    const count = series[0].values.length;
    const y = this.quantities.axis(plot.y.label, plot.y.measure, Math.max(...series.flatMap((s) => s.values)));
    const axis = { stroke: ink, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid }, font: "12px system-ui", labelFont: "12px system-ui" };
    const at = Array.from({ length: count }, (_, i) => i + 0.5);
    const bars = (k: number) => uPlot.paths.bars!({
      size: [series.length > 1 ? 0.42 : 0.86], align: series.length > 1 ? (k === 0 ? -1 : 1) : 0,
    });
    const ends = plot.names ? at : Array.from({ length: count + 1 }, (_, i) => i);
    const wide = plot.names ? 10 + 8 * Math.max(...plot.names.map((name) => name.length)) : 52; // pixels of a label
    const most = Math.max(2, Math.floor((width - 70) / wide));
    const step = Math.ceil(ends.length / most);
    const label = (v: number) => plot.names ? plot.names[Math.round(v - 0.5)] : figure(plot.bounds![Math.round(v)], 3);
    return new uPlot({
      width, height: 210, legend: { show: series.length > 1, live: false }, cursor: { drag: { x: false, y: false } },
      scales: { x: { time: false, range: [0, count] }, y: { range: (_, __, top) => [0, top > 0 ? top * 1.06 : 1] } },
      axes: [
        { ...axis, label: this.quantities.label(plot.x.label, plot.x.measure), labelSize: 22, size: 28,
          splits: () => ends.filter((_, i) => i % step === 0), values: (_, list) => list.map(label), grid: { show: false } },
        { ...axis, label: y.label, labelSize: 20, size: 58,
          values: (_, list) => list.map((v) => short(v / y.factor)) },
      ],
      series: [{}, ...series.map((s, k) => ({
        label: s.name, fill: seriesColours[series.length > 1 ? k : 1], stroke: seriesColours[series.length > 1 ? k : 1],
        width: 0, paths: bars(k), points: { show: false },
      }))],
    }, [at, ...series.map((s) => s.values)], place);
  }
}

/** Writes a number for an axis: 12 k, 3.5 M, 2 G. */
function short(value: number): string {
  const size = Math.abs(value);
  if (size >= 1e9) return figure(value / 1e9, 3) + " G";
  if (size >= 1e6) return figure(value / 1e6, 3) + " M";
  if (size >= 1e4) return figure(value / 1e3, 3) + " k";
  return figure(value, 4);
}
