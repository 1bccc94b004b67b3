// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The scale and the directions of north, east and up, drawn over the view.
import { element, type Quantities } from "./text";
import type { View } from "./view";

const svg = (tag: string, attributes: Record<string, string | number>) => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  return made;
};

/** Returns the largest of 1, 2, 5, 10, ... that is not above a length. */
function round(length: number): number {
  const decade = 10 ** Math.floor(Math.log10(length));
  return [5, 2, 1].map((step) => step * decade).find((l) => l <= length) ?? decade;
}

/** Makes scale and arrows, which follow the view from then on. */
export function overlay(view: View, quantities: Quantities): HTMLElement {
  const bar = element("div", { class: "bar" }), text = element("div", { class: "length" });
  const compass = svg("svg", { viewBox: "-40 -40 80 80", class: "compass", role: "img", "aria-label": "Directions of north, east and up" });
  const made = element("div", { class: "overlay" }, element("div", { class: "scale" }, text, bar), compass as unknown as HTMLElement);
  view.onFrame = () => {
    const pixels = 120, unit = view.viewpoint.unitsPerPixel();
    if (!Number.isFinite(unit) || unit <= 0) return;
    const input = unit * view.model.unit, length = round(pixels * input);
    bar.style.width = `${length / input}px`;
    const stretched = view.exaggeration !== 1 ? `, z × ${view.exaggeration}` : "";
    text.textContent = `${quantities.text(length, "length", 1)}${view.viewpoint.isPerspective ? " at the centre" : ""}${stretched}`;
    compass.replaceChildren();
    for (const axis of view.viewpoint.axes().sort((a, b) => a.z - b.z)) {
      const x = 26 * axis.x, y = -26 * axis.y;
      if (Math.hypot(x, y) < 3) continue;
      compass.append(svg("line", { x1: 0, y1: 0, x2: x, y2: y, class: axis.name === "N" ? "north" : "other" }));
      const label = svg("text", { x: 1.36 * x, y: 1.36 * y + 4, "text-anchor": "middle", class: axis.name === "N" ? "north" : "other" });
      label.textContent = axis.name;
      compass.append(label);
    }
  };
  return made;
}
