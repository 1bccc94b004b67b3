// SPDX-License-Identifier: LGPL-3.0-or-later
//
// node figures.mjs PACKAGES TEXT.ts FIGURES.json: report pages write numbers as the terminal does, by the same table.
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { join, resolve } from "node:path";

const [packages, source, table] = process.argv.slice(2).map((p) => resolve(p));
const { transformSync } = createRequire(join(packages, "package.json"))("esbuild");
const { code } = transformSync(readFileSync(source, "utf8"), { loader: "ts", format: "esm" });
const { coordinate, figure, Quantities } = await import(`data:text/javascript;base64,${Buffer.from(code).toString("base64")}`);

const flaws = [];
const check = (found, wanted) => {
  if (found !== wanted) flaws.push(`${found} instead of ${wanted}`);
};
for (const [value, digits, text] of JSON.parse(readFileSync(table, "utf8"))) check(figure(value, digits), text);
check(figure(NaN), "?");
check(figure(Infinity), "> 1.8e308");
check(coordinate(1 / 3, 1), "0.33333");
check(coordinate(5932123.4567, 12000), "5932123.5");
const metres = new Quantities("m"), feet = new Quantities("ft");
check(metres.text(12345.6, "length"), "12.35 km");
check(metres.text(12345678, "volume", 6), "12,345,700 m³");
check(metres.text(123456789, "volume", 6), "0.123457 km³");
check(feet.text(12345678, "area", 6), "12,345,700 ft²");
for (const flaw of flaws) console.error(flaw);
process.exit(flaws.length > 0 ? 1 : 0);
