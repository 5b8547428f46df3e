// What stands over the picture on the live page does not overlap, on a phone and with twenty cards; and the page is fast.
//
//   node --test tests/page/layout.test.mjs

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { BLOCKS, browse, drawn, save, seen, show } from "./driver.mjs";

let browser;
before(async () => (browser = await browse()));
after(() => browser.close());

const open = (text, act, given) => show(browser, text, act, given);

/** Twenty warnings, each a card, and as many parameters and prints. */
const MUCH = `${BLOCKS}${Array.from(
  { length: 20 },
  (_, i) =>
    `param("number ${i}", { default = ${i}, min = 0, max = 90, group = "Group ${i % 4}" })\nwarn("warning ${i} of this script", "help ${i}")\nprint("text ${i}")\ncamera({ name = "camera ${i}", view = "plan" })\n`,
).join("")}`;

/** The pairs of visible things over the picture that overlap, and what reaches out of the window. */
const faults = (page) =>
  page.evaluate(() => {
    const names = [".tools", ".axes", ".timeline", ".card", ".notes > *", ".top", ".status", ".panel", ".console", ".script-pane", ".toast"];
    const boxes = names
      .flatMap((name) => [...document.querySelectorAll(name)].map((element) => ({ name: `${name}#${element.id}`, element })))
      .filter(({ element }) => element.checkVisibility())
      .map(({ name, element }) => ({ name, box: element.getBoundingClientRect() }))
      .filter(({ box }) => box.width > 0 && box.height > 0);
    const found = [];
    for (const [i, a] of boxes.entries()) {
      if (a.box.left < -0.5 || a.box.right > innerWidth + 0.5 || a.box.bottom > innerHeight + 0.5) found.push(`${a.name} reaches out`);
      for (const b of boxes.slice(i + 1)) {
        const wide = Math.min(a.box.right, b.box.right) - Math.max(a.box.left, b.box.left);
        const tall = Math.min(a.box.bottom, b.box.bottom) - Math.max(a.box.top, b.box.top);
        if (wide > 1 && tall > 1) found.push(`${a.name} and ${b.name}`);
      }
    }
    if (document.documentElement.scrollWidth > innerWidth) found.push("the page scrolls sideways");
    // Buttons of the head and of the tools beside each other.
    for (const bar of [".actions", ".tools", ".status"]) {
      const own = [...document.querySelector(bar).children].filter((it) => it.checkVisibility()).map((it) => it.getBoundingClientRect());
      for (const [i, a] of own.entries())
        for (const b of own.slice(i + 1)) if (a.right - b.left > 1 && b.right - a.left > 1) found.push(`within ${bar}`);
      const frame = document.querySelector(bar).getBoundingClientRect();
      if (own.some((it) => it.right > frame.right + 1)) found.push(`out of ${bar}`);
    }
    return found;
  });

for (const [width, height] of [
  [390, 844],
  [820, 720],
  [1280, 800],
])
  test(`nothing overlaps with twenty cards in ${width} x ${height}`, () =>
    open(MUCH, async ({ page, script }) => {
      await page.setViewportSize({ width, height });
      const first = await drawn(page);
      // With a model before, the button of the comparison is there too.
      save(script, MUCH.replace("default = 3", "default = 4"));
      await drawn(page, first);
      await page.waitForTimeout(400);
      assert.deepEqual(await faults(page), []);
      await seen(page, "warnings").getByRole("button", { name: "Fold" }).click();
      assert.equal(await seen(page, "warnings").locator("article").count(), 20);
      assert.deepEqual(await faults(page), []);
      const at = await page.evaluate(() => window.burgeon.project([0, -2.02, 1]));
      await seen(page, "warnings").getByRole("button", { name: "Fold" }).click();
      await page.mouse.click(...at);
      await seen(page, "picked").waitFor();
      assert.deepEqual(await faults(page), []);
      await seen(page, "warnings").getByRole("button", { name: "Fold" }).click();
      assert.deepEqual(await faults(page), []);
      await seen(page, "console-toggle").click();
      await page.keyboard.press("Escape");
      await seen(page, "edit").click();
      await page.locator("#pane-code .cm-content").waitFor();
      assert.deepEqual(await faults(page), []);
      // Menus stay within the window.
      for (const id of ["views", "sky", "export"]) {
        await seen(page, id).click();
        const menu = page.locator(`#${id} + .menu`);
        const box = await menu.boundingBox();
        assert.ok(box.x >= 0 && box.x + box.width <= width + 0.5 && box.y + box.height <= height + 0.5, `${id}: ${JSON.stringify(box)}`);
        await page.keyboard.press("Escape");
      }
    }));

test("every control has a name for screen readers, and all are reached with the Tab key", () =>
  open(MUCH, async ({ page }) => {
    await drawn(page);
    await page.locator("#outline summary").click();
    await seen(page, "console-toggle").click();
    const nameless = await page.evaluate(() =>
      [...document.querySelectorAll("button, input, select, [tabindex='0']")]
        .filter((it) => it.checkVisibility())
        .filter((it) => !(it.getAttribute("aria-label") || it.labels?.length || it.textContent.trim() || it.getAttribute("aria-labelledby")))
        .map((it) => it.outerHTML.slice(0, 120)),
    );
    assert.deepEqual(nameless, []);
    const reached = new Set();
    await page.locator("body").press("Tab");
    for (let i = 0; i < 400 && !reached.has("END"); i += 1) {
      const id = await page.evaluate(() => document.activeElement?.dataset?.testid ?? document.activeElement?.id ?? "");
      reached.add(id);
      await page.keyboard.press("Tab");
    }
    for (const id of ["sky", "views", "console-filter", "console-clear", "console-toggle", "outline-search", "part-Slab", "hide-Slab", "isolate-1", "speed", "param-number 3-strip"])
      assert.ok(reached.has(id), `${id} is not reached`);
  }));
