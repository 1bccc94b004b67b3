// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Colours that the usual kinds of colour blindness tell apart: Paul Tol's scheme "light" for blocks
// and horizons, its variants for more than nine.
import { Color } from "three";

const light = ["#77aadd", "#ee8866", "#eedd88", "#44bb99", "#ffaabb", "#99ddff", "#bbcc33", "#aaaa00", "#cfd3d6"];

/** The colour of block or surface `index`; after nine, the same ones darker or lighter. */
export function colourOf(index: number): Color {
  const colour = new Color(light[index % light.length]);
  const round = Math.floor(index / light.length) % 4;
  return colour.offsetHSL(0.025 * round, -0.12, 0).lerp(new Color(round === 2 ? "#ffffff" : "#46515b"), [0, 0.3, 0.35, 0.5][round]);
}

/** The colour of a surface: faults are wine, boundaries grey. */
export function colourOfRole(role: string, index: number): Color {
  if (role === "fault") return new Color("#a8434f").offsetHSL(0.03 * ((index % 5) - 2), 0, 0.04 * (index % 3));
  if (role === "boundary") return new Color("#9aa3ad");
  return colourOf(index);
}

/** Kinds of lines, distinct in lightness as well. */
export const lineColours: Record<string, string> = {
  "improper contact": "#d4127c",
  "free border": "#cc3311",
  "boundary line": "#5b6b7a",
  "cutoff line": "#0b3d66",
  "branch line": "#7a1f6b",
  "intersection curve": "#111111",
};
