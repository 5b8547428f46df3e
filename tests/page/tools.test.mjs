// Undo and redo, measuring, cutting and the search of parameters on the live page, in a real browser.
//
//   node --test tests/page/tools.test.mjs

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { BLOCKS, browse, different, drawn, number, pixels, save, seen, show } from "./driver.mjs";

let browser;
before(async () => (browser = await browse()));
after(() => browser.close());

const open = (text, act, given) => show(browser, text, act, given);

/** Sets the number of blocks, and waits for the model. */
async function setCount(page, count, run) {
  await seen(page, "param-count").fill(String(count));
  await seen(page, "param-count").press("Enter");
  return drawn(page, run);
}

test("undo and redo go through values and seeds, by keys and by buttons", () =>
  open(BLOCKS, async ({ page }) => {
    let last = await drawn(page);
    const [undo, redo] = [seen(page, "undo"), seen(page, "redo")];
    assert.ok((await undo.isDisabled()) && (await redo.isDisabled()));
    const three = await number(page, "triangles");
    last = await setCount(page, 6, last);
    const six = await number(page, "triangles");
    assert.ok(six > three);
    await seen(page, "dice").click();
    last = await drawn(page, last);
    const seed = await seen(page, "seed").inputValue();
    await page.keyboard.press("Control+z");
    last = await drawn(page, last);
    assert.equal(await seen(page, "seed").inputValue(), "0");
    assert.equal(await number(page, "triangles"), six);
    // In a field whose number is sent, the key goes back in the model, not in the field.
    await seen(page, "param-count").focus();
    await page.keyboard.press("Control+z");
    last = await drawn(page, last);
    assert.equal(await number(page, "triangles"), three);
    assert.equal(await seen(page, "param-count").inputValue(), "3");
    assert.ok(await undo.isDisabled());
    await page.keyboard.press("Control+Shift+z");
    last = await drawn(page, last);
    assert.equal(await number(page, "triangles"), six);
    await redo.click();
    last = await drawn(page, last);
    assert.equal(await seen(page, "seed").inputValue(), seed);
    assert.ok(await redo.isDisabled());
    // A new change ends what could be made again.
    await undo.click();
    last = await drawn(page, last);
    await setCount(page, 2, last);
    assert.ok(await redo.isDisabled());
  }));

test("a parameter that is not in the script any more is left out of an undo", () =>
  open(BLOCKS, async ({ page, script }) => {
    let last = await drawn(page);
    last = await setCount(page, 5, last);
    await page.locator("#param-hollow").click();
    last = await drawn(page, last);
    save(script, BLOCKS.replace('local hollow = param("hollow", { default = false })', "local hollow = false"));
    last = await drawn(page, last);
    await page.locator("canvas#view").focus();
    const triangles = await number(page, "triangles");
    await page.keyboard.press("Control+z");
    await drawn(page, last);
    assert.equal(await seen(page, "param-count").inputValue(), "3");
    assert.ok(await seen(page, "undo").isDisabled());
    assert.ok((await number(page, "triangles")) < triangles);
  }));

test("two clicks measure a distance, and Escape ends it", () =>
  open(BLOCKS, async ({ page }) => {
    await drawn(page);
    await page.locator("canvas#view").focus();
    await page.keyboard.press("m");
    assert.equal(await seen(page, "measure").getAttribute("aria-pressed"), "true");
    // The corners of the tower, a little inside.
    for (const corner of [
      [1.9, -2.02, 0.2],
      [1.9, -2.02, 5.8],
    ]) {
      const [x, y] = await page.evaluate((point) => window.burgeon.project(point), corner);
      await page.mouse.click(x, y);
    }
    const text = await seen(page, "rule-text").textContent();
    const [, length] = /^([\d.]+) m/.exec(text);
    assert.ok(Math.abs(Number(length) - 5.6) < 0.15, text);
    assert.ok(await seen(page, "picked").isHidden(), "nothing is picked while one measures");
    await page.keyboard.press("Escape");
    assert.ok(await seen(page, "rule-text").isHidden());
    assert.equal(await seen(page, "measure").getAttribute("aria-pressed"), "false");
  }));

test("a cut shows the inside, tells its place, and ends without a trace", () =>
  open(BLOCKS, async ({ page }) => {
    await drawn(page);
    await page.locator("canvas#view").focus();
    await page.keyboard.press("f");
    await page.waitForTimeout(1500);
    const whole = await pixels(page);
    await page.keyboard.press("x");
    await page.waitForTimeout(800);
    assert.equal(await seen(page, "cut-text").textContent(), "z 3 m");
    assert.ok(different(whole, await pixels(page)) > 2000, "the upper half is gone");
    // Nothing is met where the upper half was.
    const above = await page.evaluate(() => window.burgeon.project([0, -2, 5]));
    await page.mouse.click(...above);
    assert.ok(await seen(page, "picked").isHidden());
    await page.keyboard.press("x");
    await page.mouse.move(5, 5);
    await page.waitForTimeout(1500);
    assert.ok(different(whole, await pixels(page)) < 50, "the picture is as before");
  }));

test("many parameters can be searched by names, descriptions and choices", () => {
  const many = Array.from({ length: 8 }, (_, i) => `param("size ${i}", { default = ${i}, doc = "Room ${i}" })\n`);
  return open(many.join("") + BLOCKS, async ({ page }) => {
    await drawn(page);
    const search = seen(page, "params-search");
    const shown = () => page.locator("#params .param:visible").count();
    assert.equal(await shown(), 12);
    await search.fill("room 3");
    assert.equal(await shown(), 1);
    await search.fill("fluted");
    assert.equal(await shown(), 1);
    await search.fill("nothing like this");
    assert.equal(await shown(), 0);
    assert.ok(await seen(page, "params-none").isVisible());
    await search.press("Escape");
    assert.equal(await shown(), 12);
  });
});

test("few parameters have no search", () =>
  open(BLOCKS, async ({ page }) => {
    await drawn(page);
    assert.ok(await seen(page, "params-search").isHidden());
  }));
