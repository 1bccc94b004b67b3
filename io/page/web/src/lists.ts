// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The lists of surfaces, blocks and lines, with what shows, hides and colours them.
import type { Content } from "./data";
import { button, element, named, shortened, type Quantities } from "./text";
import type { Item, View } from "./view";
import { lineColours } from "./colours";

/** Makes the list of one kind of item. `choose` is called with an item whose name is clicked. */
export function itemList(title: string, items: Item[], view: View, quantities: Quantities,
  choose: (item: Item) => void): HTMLElement {
  const rows = items.map((item) => itemRow(item, view, quantities, choose));
  const all = (visible: boolean) => items.forEach((item, i) => {
    view.show(item, visible);
    rows[i].querySelector<HTMLInputElement>("input[type=checkbox]")!.checked = visible;
  });
  const opacity = element("input", { type: "range", min: 0.1, max: 1, step: 0.05, value: 1, "aria-label": `Opacity of all ${title.toLowerCase()}` });
  opacity.addEventListener("input", () => items.forEach((item, i) => {
    view.setOpacity(item, Number(opacity.value));
    rows[i].querySelector<HTMLInputElement>("input[type=range]")!.value = opacity.value;
  }));
  return element("section", { class: "list", "aria-label": title },
    element("h3", {}, title, element("span", { class: "count" }, ` ${items.reduce((sum, i) => sum + i.numbers.length, 0).toLocaleString("en")}`),
      element("span", { class: "tools" },
        button("All", `Show all ${title.toLowerCase()}`, () => all(true)),
        button("None", `Hide all ${title.toLowerCase()}`, () => all(false)), opacity)),
    element("ul", {}, ...rows));
}

function itemRow(item: Item, view: View, quantities: Quantities, choose: (item: Item) => void): HTMLElement {
  const isBlock = item.kind === "block" && item.numbers.length === 1;
  const label = isBlock ? `block ${item.numbers[0]}, ${shortened(item.name, 80)}` : shortened(item.name, 80);
  const shown = element("input", { type: "checkbox", "aria-label": `Show ${label}`, checked: item.visible });
  shown.addEventListener("change", () => view.show(item, shown.checked));
  const colour = element("input", { type: "color", value: `#${item.colour.getHexString()}`, "aria-label": `Colour of ${label}` });
  colour.addEventListener("input", () => view.recolour(item, colour.value));
  const opacity = element("input", { type: "range", min: 0.1, max: 1, step: 0.05, value: item.opacity, "aria-label": `Opacity of ${label}` });
  opacity.addEventListener("input", () => view.setOpacity(item, Number(opacity.value)));
  const name = button("", `Look at ${label}`, () => choose(item), { class: "choose" });
  if (isBlock) name.append(element("b", {}, `${item.numbers[0]} `));
  name.append(named(item.name));
  const size = item.kind === "block" ? quantities.text(item.volume, "volume", 3) : quantities.text(item.area, "area", 3);
  return element("li", {}, shown, colour, name, element("span", { class: "size" }, size), opacity);
}

/** Makes the list of kinds of lines. */
export function lineList(view: View, content: Content, quantities: Quantities): HTMLElement {
  const rows = view.lines.map(({ kind, wanted }) => {
    const shown = element("input", { type: "checkbox", checked: wanted });
    shown.addEventListener("change", () => view.showLines(kind, shown.checked));
    const length = content.lines.filter((l) => l.kind === kind).reduce((sum, l) => sum + l.length, 0);
    const key = element("span", { class: "key", "data-kind": kind });
    key.style.background = lineColours[kind] ?? "#111111";
    return element("li", {}, element("label", {}, shown, key, `${kind}s`), element("span", { class: "size" }, quantities.text(length, "length", 3)));
  });
  return element("section", { class: "list", "aria-label": "Lines" }, element("h3", {}, "Lines"), element("ul", {}, ...rows));
}
