// SPDX-License-Identifier: LGPL-3.0-or-later
import type { Cell, Table } from "./data";
import { button, element, named, type Quantities } from "./text";

const mostRows = 1000; ///< rows that are shown; copying takes all

/** Makes a table that sorts by a click on a column and copies as text with tabs. */
export function tableOf(table: Table, quantities: Quantities, announce: (text: string) => void): HTMLElement {
  const body = element("tbody");
  let order = table.rows;
  const isNumeric = (c: number) => table.rows.some((r) => typeof r[c] === "number") && table.rows.every((r) => typeof r[c] !== "string");
  const cellOf = (value: Cell, c: number): HTMLElement => {
    if (typeof value === "number") return element("td", { class: "number" }, quantities.text(value, table.columns[c].measure === "number" ? "" : table.columns[c].measure, 6));
    if (value === null || value === "") return element("td", {}, "–");
    return element("td", {}, typeof value === "string" ? named(value, 1000) : String(value));
  };
  const fill = () => body.replaceChildren(...order.slice(0, mostRows).map((row) => element("tr", {}, ...row.map(cellOf))));
  const heads = table.columns.map((column, c) => {
    const head = element("th", { scope: "col", "aria-sort": "none", class: isNumeric(c) ? "number" : "" });
    head.append(button(column.title, `Sort by ${column.title}`, () => {
      const down = head.getAttribute("aria-sort") === "ascending";
      for (const other of heads) other.setAttribute("aria-sort", "none");
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
      order = [...table.rows].sort((a, b) => (down ? -1 : 1) * compare(a[c], b[c]));
      fill();
    }));
    return head;
  });
  fill();
  const copy = button("Copy", `Copy table ${table.title}`, () => {
    const lines = [table.columns.map((c) => quantities.label(c.title, c.measure)), ...order.map((row) => row.map((v) => v ?? ""))];
    copyText(lines.map((line) => line.map((v) => String(v).replace(/[\t\n\r]/g, " ")).join("\t")).join("\n"))
      .then(() => announce(`Copied ${table.rows.length} rows`), () => announce("The browser refused to copy"));
  });
  const more = table.rows.length > mostRows ? [element("p", { class: "note" }, `${mostRows} of ${table.rows.length} rows; Copy and JSON have all.`)] : [];
  return element("section", { class: "table" },
    element("h3", {}, table.title, element("span", { class: "count" }, ` ${table.rows.length}`), copy),
    element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": table.title },
      element("table", {}, element("thead", {}, element("tr", {}, ...heads)), body)), ...more);
}

function compare(a: Cell, b: Cell): number {
  if (typeof a === "number" && typeof b === "number") return a - b;
  if (a === null || b === null) return a === b ? 0 : a === null ? 1 : -1;
  return String(a).localeCompare(String(b), "en", { numeric: true });
}

async function copyText(text: string): Promise<void> {
  if (navigator.clipboard) return navigator.clipboard.writeText(text);
  const area = element("textarea", {});
  area.value = text;
  document.body.append(area);
  area.select();
  const copied = document.execCommand("copy");
  area.remove();
  if (!copied) throw new Error("refused");
}
