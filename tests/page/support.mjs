// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What the tests of pages share: checks that are counted, what is drawn as numbers, and hands on the controls.

export const flaws = [];
export const count = { checks: 0 };
let where = "";

/** Names the page that the next checks are about. */
export function about(page) {
  where = page;
}
export function check(holds, what, ...details) {
  ++count.checks;
  if (!holds) flaws.push(`${where}: ${what}${details.length ? ": " + details.map((d) => JSON.stringify(d)).join(", ") : ""}`);
}
export const near = (a, b, tolerance) => Math.abs(a - b) <= tolerance;

export const state = (page) => page.evaluate(() => window.state());
/** Waits until the state is as it should be: what an input event leads to is drawn some time later. */
export async function until(page, holds) {
  while (!holds(await state(page))) await page.waitForTimeout(20);
  return true;
}
export const setRange = (page, control, value) => page.locator(`[data-control="${control}"]`).evaluate((input, v) => {
  input.value = v;
  input.dispatchEvent(new Event("input"));
}, value);
export const panel = (page, name) => page.getByRole("tab", { name }).click();

export const direction = ({ camera, target }) => {
  const arm = camera.map((c, k) => c - target[k]), length = Math.hypot(...arm);
  return arm.map((c) => c / length);
};
export const heading = (s) => Math.atan2(direction(s)[1], direction(s)[0]) * 180 / Math.PI;
export const reach = ({ camera, target }) => Math.hypot(...camera.map((c, k) => c - target[k]));
