// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Sliders and keys of the view.
import { button, coordinate, element } from "./text";
import type { Axis } from "./caps";
import type { View } from "./view";

/** Makes a slider with its label and value. */
function slider(label: string, range: { min: number; max: number; step: number; value: number },
  write: (value: number) => string, act: (value: number) => void): HTMLElement {
  const shown = element("output", {}, write(range.value));
  const input = element("input", { type: "range", ...range, "data-control": label });
  input.addEventListener("input", () => {
    shown.textContent = write(Number(input.value));
    act(Number(input.value));
  });
  return element("label", { class: "slider" }, element("span", {}, label), input, shown);
}

/** Makes the controls above the lists. */
export function controls(view: View): HTMLElement {
  const made = element("section", { class: "controls", "aria-label": "View" });
  const edges = element("input", { type: "checkbox", "data-control": "Edges" });
  edges.addEventListener("change", () => view.showEdges(edges.checked));
  if (view.items.some((item) => item.kind === "block"))
    made.append(slider("Explode", { min: 0, max: 1, step: 0.01, value: 0 }, (v) => `${Math.round(100 * v)} %`, (v) => view.explode(v)));
  made.append(slider("Stretch z", { min: 1, max: 20, step: 0.5, value: view.exaggeration }, (v) => `${v} ×`, (v) => view.exaggerate(v)));
  made.append(sectionControl(view), element("label", { class: "check" }, edges, "Edges of triangles"));
  return made;
}

function sectionControl(view: View): HTMLElement {
  const axis = element("select", { "aria-label": "Axis of the section", "data-control": "Section axis" },
    ...["off", "x", "y", "z"].map((name) => element("option", { value: name }, name === "off" ? "off" : `across ${name}`)));
  const place = element("input", { type: "range", min: 0, max: 1, step: 0.002, value: 0.5, "aria-label": "Place of the section", "data-control": "Section place", disabled: true });
  const shown = element("output", {}, "");
  let flipped = false;
  const act = () => {
    place.disabled = axis.value === "off";
    if (axis.value === "off") {
      shown.textContent = "";
      return view.cutAt(null);
    }
    const k = "xyz".indexOf(axis.value) as Axis;
    const share = Number(place.value);
    view.cutAt({ axis: k, share, flipped });
    const at = view.model.origin[k] + view.model.unit * view.model.half.getComponent(k) * (1 + 2 * view.exploded) * (2 * share - 1);
    shown.textContent = `${axis.value} ${coordinate(at, 2 * view.model.radius * view.model.unit)}`;
  };
  axis.addEventListener("change", () => { // what is kept shows its cut to us
    if (axis.value !== "off") flipped = view.viewpoint.isBehind("xyz".indexOf(axis.value) as Axis);
    act();
  });
  place.addEventListener("input", act);
  const flip = button("⇄", "Keep the other side", () => { flipped = !flipped; act(); }, { "data-control": "Section flip" });
  return element("div", { class: "slider section", role: "group", "aria-label": "Section" }, element("span", {}, "Section"), axis, place, flip, shown);
}

/** Lets keys turn, move and zoom the view while it has the focus. */
export function keys(stage: HTMLElement, view: View, escape: () => void): void {
  const actions: Record<string, (shift: boolean) => void> = {
    ArrowLeft: (shift) => shift ? view.viewpoint.pan(-1, 0) : view.viewpoint.turn(-6, 0),
    ArrowRight: (shift) => shift ? view.viewpoint.pan(1, 0) : view.viewpoint.turn(6, 0),
    ArrowUp: (shift) => shift ? view.viewpoint.pan(0, 1) : view.viewpoint.turn(0, 6),
    ArrowDown: (shift) => shift ? view.viewpoint.pan(0, -1) : view.viewpoint.turn(0, -6),
    "+": () => view.viewpoint.zoom(1.2), "=": () => view.viewpoint.zoom(1.2), "-": () => view.viewpoint.zoom(1 / 1.2),
    "1": () => view.look("perspective"), "2": () => view.look("top"), "3": () => view.look("north"),
    "4": () => view.look("east"), "0": () => view.look("perspective"), Escape: escape,
  };
  stage.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target !== stage) return;
    const action = actions[event.key];
    if (!action) return;
    action(event.shiftKey);
    event.preventDefault();
  });
}
