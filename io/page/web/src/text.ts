// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Numbers with units, and small helpers for elements. All text from files is set as text, never as
// HTML.

export class Quantities {
  constructor(private readonly unit: string) {}

  /** Writes a value of a measure with its unit: "length", "area", "volume", "angle", or none. */
  text(value: number | null, measure: string, digits = 4): string {
    if (value === null) return "–";
    if (isBeyond(value)) return figure(value, digits);
    if (measure === "count") return value.toLocaleString("en");
    if (measure === "angle") return `${figure(value, digits)}°`;
    const power = { length: 1, area: 2, volume: 3 }[measure] ?? 0;
    if (power === 0) return figure(value, digits);
    if (this.unit === "m" && Math.abs(value) >= [0, 1e4, 1e5, 1e8][power])
      return `${figure(value / 1000 ** power, digits)} km${sup(power)}`;
    return `${figure(value, digits)}${this.unit ? " " + this.unit + sup(power) : ""}`;
  }
  /** Returns the unit for an axis on which `most` is the largest value, and how many base units it has. */
  axis(label: string, measure: string, most: number): { label: string; factor: number } {
    const power = { length: 1, area: 2, volume: 3 }[measure] ?? 0;
    const large = power > 0 && this.unit === "m" && most >= [0, 1e4, 1e5, 1e8][power];
    return large ? { label: `${label} (km${sup(power)})`, factor: 1000 ** power } : { label: this.label(label, measure), factor: 1 };
  }
  /** Returns "length (m)", or the label alone where no unit is known. */
  label(label: string, measure: string): string {
    const power = { length: 1, height: 1, area: 2, volume: 3 }[measure] ?? 0;
    if (measure === "angle") return `${label} (°)`;
    return power > 0 && this.unit ? `${label} (${this.unit}${sup(power)})` : label;
  }
}

/** Writes a coordinate with the decimals that 6 significant digits of the model's extent need. */
export function coordinate(value: number | null, extent: number): string {
  if (value === null) return "?";
  const decimals = Math.max(0, Math.min(9, 5 - Math.floor(Math.log10(Math.max(extent, 1e-9)))));
  return String(Number(value.toFixed(decimals)));
}

function sup(power: number): string {
  return ["", "", "²", "³"][power];
}

/** Tells whether a value is no number, or beyond the largest one, which stands for all larger ones. */
function isBeyond(value: number): boolean {
  return !(Math.abs(value) < Number.MAX_VALUE);
}

/** Writes a number by the laws of algorithms/core/figure.hpp. */
export function figure(value: number | null, digits = 6): string {
  if (value === null || Number.isNaN(value)) return "?";
  if (isBeyond(value)) return value > 0 ? "> 1.8e308" : "< -1.8e308";
  if (value === 0) return "0";
  const [mantissa, exponent] = value.toExponential(Math.min(Math.max(digits, 1), 6) - 1).split("e"), power = Number(exponent);
  if (power < -4 || power >= 15) return `${Number(mantissa)}e${power}`;
  return Number(`${mantissa}e${power}`).toLocaleString("en", { maximumFractionDigits: 20, useGrouping: power >= 6 });
}

type Attributes = Record<string, string | number | boolean>;

/** Makes an element with attributes, and children that are elements or text. */
export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K, attributes: Attributes = {}, ...children: (Node | string)[]): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes))
    if (value !== false) made.setAttribute(key, value === true ? "" : String(value));
  made.append(...children);
  return made;
}

/** Makes a button that does something. */
export function button(text: string, label: string, act: () => void, attributes: Attributes = {}): HTMLButtonElement {
  const name = label.toLowerCase().includes(text.toLowerCase()) ? label : `${text}: ${label}`; // holds what is seen
  const made = element("button", { type: "button", title: label, "aria-label": name, ...attributes }, text);
  made.addEventListener("click", act);
  return made;
}

/** Shortens what no line can hold; the whole name is in the tooltip. */
export function shortened(name: string, most = 120): string {
  return name.length > most ? name.slice(0, most - 1) + "…" : name;
}

/** An element with a name from a file, in its own direction of writing. */
export function named(name: string, most = 120): HTMLElement {
  return element("bdi", { title: shortened(name, 2000), class: name.length > 40 ? "name long" : "name" }, shortened(name, most));
}

export function download(name: string, type: string, text: string): void {
  const address = URL.createObjectURL(new Blob([text], { type }));
  element("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}
