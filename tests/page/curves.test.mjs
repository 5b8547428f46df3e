// Drawn functions, curves and surfaces in a real browser: points are dragged, added, removed, moved by keys, reset and saved.
//
//   node --test tests/page/curves.test.mjs

import assert from "node:assert/strict";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { after, before, test } from "node:test";

import { browse, drawn, seen, show } from "./driver.mjs";

const DRAWN = `local taper = param("taper", { default = ramp({ { 0, 1 }, { 0.5, 0.6 }, { 1, 0.4 } }, { kind = "linear" }) })
local leaf = param("leaf", { default = curve({ { 0, 0 }, { 1, 1 }, { 2, 0 } }) })
local arc = param("arc", { default = curve({ points = { { 0, 0 }, { 0, 1 }, { 1, 2 }, { 2, 2 } }, kind = "bezier" }) })
local way = param("way", { default = curve({ vec(0, 0, 0), vec(1, 0, 1), vec(1, 2, 3) }) })
local Part = module("Part", "x")
local stem = lsystem({ object = turtle() })
stem:axiom(Part(0), Part(0.5), Part(1))
stem:interpret("Part(x)", function(this, x)
  this:width(taper:at(x)):forward(leaf:length() + arc:length() + way:length())
end)
stem:derive()
`;

let browser;
before(async () => (browser = await browse()));
after(() => browser.close());

const open = (act) => show(browser, DRAWN, act);

/** The value that the server has. */
const value = (page, name) =>
  page.evaluate((name) => window.burgeon.model.params.find((param) => param.name === name).value, name);

/** Waits until the server has a value for which `is` holds. */
async function until(page, name, is) {
  let now;
  for (let i = 0; i < 200; i += 1) {
    now = await value(page, name);
    if (is(now)) return now;
    await page.waitForTimeout(50);
  }
  assert.fail(`${name} is ${JSON.stringify(now)}`);
}

const points = (page, name) => seen(page, `param-${name}-plot`).locator(".plot-point");

/** The middle of a point in the window. */
async function middle(page, name, index) {
  const handle = points(page, name).nth(index);
  await handle.scrollIntoViewIfNeeded();
  const { x, y, width, height } = await handle.locator("circle").first().boundingBox();
  return [x + width / 2, y + height / 2];
}

test("a dragged point changes the model while it moves, and a function keeps the order of its points", () =>
  open(async ({ page }) => {
    await drawn(page);
    assert.equal(await points(page, "taper").count(), 3);
    const [x, y] = await middle(page, "taper", 1);
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 10, y - 30, { steps: 4 });
    const during = await until(page, "taper", (now) => now[1][1] > 0.7 && now[1][0] > 0.5);
    assert.ok(during[1][1] < 1.1);
    await page.mouse.move(x + 500, y - 30, { steps: 4 });
    await page.mouse.up();
    const after = await until(page, "taper", (now) => now[1][0] > 0.9);
    assert.ok(after[1][0] < 1 && after.length === 3, JSON.stringify(after));
    await seen(page, "param-taper-reset").click();
    await until(page, "taper", (now) => now[1][0] === 0.5 && now[1][1] === 0.6);
    await seen(page, "param-taper-reset").waitFor({ state: "hidden" });
  }));

test("double clicks add points on the curve and remove points", () =>
  open(async ({ page }) => {
    await drawn(page);
    const [[ax, ay], [bx, by]] = [await middle(page, "taper", 0), await middle(page, "taper", 1)];
    await page.mouse.dblclick((ax + bx) / 2, (ay + by) / 2);
    const added = await until(page, "taper", (now) => now.length === 4);
    assert.ok(Math.abs(added[1][0] - 0.25) < 0.02 && Math.abs(added[1][1] - 0.8) < 0.02, JSON.stringify(added));
    await page.mouse.dblclick(...(await middle(page, "taper", 2)));
    const removed = await until(page, "taper", (now) => now.length === 3);
    assert.deepEqual(removed[2], [1, 0.4]);
    // A Bezier curve is divided without a change of its form.
    await points(page, "arc").nth(0).focus();
    await seen(page, "param-arc-add").click();
    const divided = await until(page, "arc", (now) => now.length === 7);
    assert.deepEqual(divided[3], [0.625, 1.375]);
    await page.keyboard.press("Delete");
    await until(page, "arc", (now) => now.length === 4);
  }));

const PETAL = `local petal = param("petal", { default = surface({
  { vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0) },
  { vec(-1, 0, 1), vec(-0.4, 0, 1), vec(0.4, 0, 1), vec(1, 0, 1) },
  { vec(-1, 0, 2), vec(-0.4, 0, 2), vec(0.4, 0, 2), vec(1, 0, 2) },
  { vec(0, 0, 3), vec(0, 0, 3), vec(0, 0, 3), vec(0, 0, 3) },
}) })
local Part = module("Part")
local flower = lsystem({ object = turtle() })
flower:axiom(Part())
flower:interpret("Part", function(this) this:surface(petal) end)
flower:derive()
`;

test("the points of a surface are dragged in its widest view, and those at its tip move together", () =>
  show(browser, PETAL, async ({ page }) => {
    await drawn(page);
    assert.equal(await points(page, "petal").count(), 16);
    assert.ok(await seen(page, "param-petal-view-front").isChecked());
    assert.equal(await seen(page, "param-petal-add").count(), 0);
    const [x, y] = await middle(page, "petal", 6);
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 20, y, { steps: 4 });
    await page.mouse.up();
    const one = await until(page, "petal", (now) => now[6][0] > 0.45);
    assert.deepEqual([one[6][1], one[6][2], one[5]], [0, 1, [-0.4, 0, 1]]);
    await points(page, "petal").nth(15).focus();
    await page.keyboard.press("Shift+ArrowUp");
    const tip = await until(page, "petal", (now) => now[15][2] > 3);
    assert.ok([12, 13, 14].every((index) => tip[index][2] === tip[15][2]), JSON.stringify(tip));
    await page.keyboard.press("Alt+ArrowRight");
    const apart = await until(page, "petal", (now) => now[15][0] > 0);
    assert.ok([12, 13, 14].every((index) => apart[index][0] === 0), JSON.stringify(apart));
    // The number of points stays.
    await page.keyboard.press("Delete");
    await page.keyboard.press("Insert");
    await page.waitForTimeout(300);
    assert.equal((await value(page, "petal")).length, 16);
  }));

test("keys choose, move, add and remove points, and undo", () =>
  open(async ({ page }) => {
    await drawn(page);
    await points(page, "leaf").nth(0).focus();
    await page.keyboard.press("PageDown");
    assert.equal(await page.evaluate(() => document.activeElement.getAttribute("aria-label")), "Point 2 of 3: x 1, y 1");
    await page.keyboard.press("ArrowUp");
    const up = await until(page, "leaf", (now) => now[1][1] > 1);
    assert.equal(up[1][0], 1);
    await page.keyboard.press("Insert");
    await until(page, "leaf", (now) => now.length === 4);
    await page.keyboard.press("Delete");
    await until(page, "leaf", (now) => now.length === 3);
    await page.keyboard.press("Control+z");
    await until(page, "leaf", (now) => now.length === 4);
    await page.keyboard.press("Control+z");
    await page.keyboard.press("Control+z");
    await until(page, "leaf", (now) => now.length === 3 && now[1][1] === 1);
  }));

test("points that are no curve are refused, and the last good ones come back", () =>
  open(async ({ page }) => {
    await drawn(page);
    await points(page, "leaf").nth(1).focus();
    await seen(page, "param-leaf-x").fill("0");
    await seen(page, "param-leaf-x").press("Enter");
    await until(page, "leaf", (now) => now[1][0] === 0);
    await seen(page, "param-leaf-y").fill("0");
    await seen(page, "param-leaf-y").press("Enter");
    await seen(page, "toast").waitFor({ state: "visible" });
    assert.match(await seen(page, "toast").textContent(), /point 2 is equal to point 1/);
    assert.deepEqual((await value(page, "leaf"))[1], [0, 1]);
    await points(page, "leaf").nth(1).focus();
    assert.equal(await seen(page, "param-leaf-y").inputValue(), "1");
  }));

test("a curve in space is moved in two of its coordinates at a time", () =>
  open(async ({ page }) => {
    await drawn(page);
    await seen(page, "param-way-view-front").locator("xpath=..").click();
    const [x, y] = await middle(page, "way", 1);
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x - 30, y - 40, { steps: 3 });
    await page.mouse.up();
    const moved = await until(page, "way", (now) => now[1][2] > 1.1);
    assert.ok(moved[1][0] < 1 && moved[1][1] === 0, JSON.stringify(moved));
  }));

test("a drawing is saved beside the script, followed when the file changes, and removed with the script's own values", () =>
  open(async ({ page, script }) => {
    const file = script.replace(/lua$/, "curves.json");
    let run = await drawn(page);
    const save = seen(page, "param-taper-save");
    assert.equal(await save.isDisabled(), true);
    await points(page, "taper").nth(2).focus();
    await seen(page, "param-taper-y").fill("0.9");
    await seen(page, "param-taper-y").press("Enter");
    await until(page, "taper", (now) => now[2][1] === 0.9);
    await save.click();
    await page.waitForFunction(() => /Saved in .*curves\.json/.test(document.querySelector("#toast").textContent));
    assert.deepEqual(JSON.parse(readFileSync(file, "utf8")), { taper: [[0, 1], [0.5, 0.6], [1, 0.9]] });
    await page.waitForFunction(() => document.querySelector("[data-testid=param-taper-save]").disabled);
    writeFileSync(file, '{ "taper": [[0, 0.2], [1, 0.7]] }\n');
    await until(page, "taper", (now) => now.length === 2);
    assert.equal(await points(page, "taper").count(), 2);
    await seen(page, "param-taper-script").click();
    await until(page, "taper", (now) => now.length === 3 && now[2][1] === 0.4);
    await save.click();
    for (let i = 0; i < 100 && existsSync(file); i += 1) await page.waitForTimeout(50);
    assert.equal(existsSync(file), false);
  }));

test("the plots fit into a narrow page in both themes", () =>
  open(async ({ page }) => {
    await drawn(page);
    for (const [colorScheme, width] of [["light", 340], ["dark", 1000]]) {
      await page.emulateMedia({ colorScheme });
      await page.setViewportSize({ width, height: 700 });
      for (const name of ["taper", "leaf", "arc", "way"]) {
        const plot = seen(page, `param-${name}-plot`);
        await plot.scrollIntoViewIfNeeded();
        const box = await plot.boundingBox();
        assert.ok(box.x >= 0 && box.x + box.width <= width && box.height > 150, JSON.stringify(box));
      }
    }
  }));
