// Cameras, sun and sky, and the comparison of before and after on the live page, in a real browser.
//
//   node --test tests/page/look.test.mjs

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { BLOCKS, browse, different, drawn, pixels, save, seen, show } from "./driver.mjs";

let browser;
before(async () => (browser = await browse()));
after(() => browser.close());

const open = (text, act, given) => show(browser, text, act, given);
const camera = (page) => page.evaluate(() => window.burgeon.camera);

/** Waits until the camera is still where `test` wants it, for at most 5 s, and gives it. */
async function arrived(page, test) {
  let state = await camera(page);
  for (let attempt = 0; attempt < 50; attempt++) {
    await page.waitForTimeout(100);
    const last = JSON.stringify(state);
    state = await camera(page);
    if (JSON.stringify(state) === last && test(state)) return state;
  }
  assert.fail(JSON.stringify(state));
}

const CAMERAS = `${BLOCKS}camera({ name = "street", from = { 20, -30, 2 }, to = { 0, 0, 3 }, fov = 60 })
camera({ name = "map", view = "plan" })
camera({ name = "<b>side</b>", view = "orthographic", from = { 40, 0, 3 }, to = { 0, 0, 3 }, height = 12 })
`;

test("cameras of the script are in the menu of views, and show what they show in files", () =>
  open(CAMERAS, async ({ page, script }) => {
    const run = await drawn(page);
    const choose = async (id) => {
      await seen(page, "views").click();
      await seen(page, id).click();
    };
    await choose("camera-street");
    const street = await arrived(page, (it) => Math.abs(it.field - Math.PI / 3) < 1e-6 && !it.flat);
    assert.ok(Math.abs(street.distance - Math.hypot(20, 30, 1)) < 1e-3, street.distance);
    // The point in the middle of the picture is the camera's.
    const box = await page.locator("canvas#view").boundingBox();
    const [x, y] = await page.evaluate(() => window.burgeon.project([0, 0, 3]));
    assert.ok(Math.abs(x - box.x - box.width / 2) < 1 && Math.abs(y - box.y - box.height / 2) < 1);
    await choose("camera-map");
    await arrived(page, (it) => it.flat && Math.abs(it.elevation - Math.PI / 2) < 1e-3);
    const [south, north] = await page.evaluate(() => [window.burgeon.project([0, -2, 0]), window.burgeon.project([0, 2, 0])]);
    assert.ok(north[1] < south[1], "north is at the top of a plan");
    await choose("camera-<b>side</b>");
    await arrived(page, (it) => it.flat && Math.abs(it.distance * Math.tan(it.field / 2) * 2 - 12) < 0.05);
    await choose("view-eye");
    await arrived(page, (it) => !it.flat && Math.abs(it.elevation) < 0.4);
    await choose("view-plan");
    await arrived(page, (it) => it.flat);
    // Standard views have the usual lens again.
    await page.locator("canvas#view").focus();
    await page.keyboard.press("1");
    await arrived(page, (it) => Math.abs(it.field - (32 * Math.PI) / 180) < 1e-6);
    save(script, BLOCKS.replace("default = 3", "default = 4"));
    await drawn(page, run);
    assert.equal(await seen(page, "camera-street").count(), 0);
  }));

test("the menu of views is used with keys alone", () =>
  open(CAMERAS, async ({ page }) => {
    await drawn(page);
    await seen(page, "views").focus();
    await page.keyboard.press("ArrowDown");
    for (let i = 0; i < 9; i += 1) await page.keyboard.press("ArrowDown");
    assert.equal(await page.evaluate(() => document.activeElement.dataset.testid), "camera-street");
    await page.keyboard.press("Enter");
    await arrived(page, (it) => Math.abs(it.field - Math.PI / 3) < 1e-6);
  }));

test("the sun moves with the time of day, and is kept for the script", () =>
  open(BLOCKS, async ({ page }) => {
    await drawn(page);
    await page.waitForTimeout(900);
    const usual = await pixels(page);
    await page.locator("canvas#view").focus();
    await page.keyboard.press("j");
    await seen(page, "sky-hour").fill("18");
    assert.match(await seen(page, "sky-flag").textContent(), /^--sun 2[78]\d,1[89]$/);
    await page.keyboard.press("Escape");
    await page.waitForTimeout(900);
    const evening = await pixels(page);
    assert.ok(different(usual, evening) > 800, "an evening has other light");
    await page.reload();
    await drawn(page);
    await page.waitForTimeout(900);
    assert.ok(different(await pixels(page), evening) < 300, "the evening is still there");
    assert.equal(await seen(page, "sky").getAttribute("aria-pressed"), "true");
    await seen(page, "sky").click();
    await seen(page, "sky-reset").click();
    assert.equal(await seen(page, "sky-flag").textContent(), "");
    assert.equal(await seen(page, "sky").getAttribute("aria-pressed"), "false");
    await page.keyboard.press("Escape");
    await page.waitForTimeout(900);
    assert.ok(different(await pixels(page), usual) < 300, "it is as before");
  }));

test("haze, a background and a sky without light change the picture", () =>
  open(BLOCKS, async ({ page }) => {
    await drawn(page);
    await page.waitForTimeout(900);
    let last = await pixels(page);
    await seen(page, "sky").click();
    const changes = async (act, least) => {
      await act();
      await page.waitForTimeout(900);
      const next = await pixels(page);
      assert.ok(different(last, next) > least, `${different(last, next)} pixels`);
      last = next;
    };
    await changes(() => seen(page, "sky-haze").fill("1"), 500);
    await changes(() => seen(page, "sky-light").uncheck(), 300);
    await changes(() => seen(page, "sky-background").selectOption("color"), 100_000);
    await changes(() => seen(page, "sky-color").fill("#202830"), 100_000);
    await changes(() => seen(page, "sky-background").selectOption("sky"), 100_000);
  }));

test("a picture from here has the sun, the haze and the sky of the page", () =>
  open(BLOCKS, async ({ page }) => {
    await drawn(page);
    const address = async () => {
      await page.locator("#export").click();
      const found = await seen(page, "export-png").getAttribute("href");
      await page.keyboard.press("Escape");
      return found;
    };
    assert.doesNotMatch(await address(), /sun|haze|sky/);
    await seen(page, "sky").click();
    await seen(page, "sky-hour").fill("18");
    await seen(page, "sky-haze").fill("0.5");
    await seen(page, "sky-background").selectOption("sky");
    await page.keyboard.press("Escape");
    const lit = await address();
    assert.match(lit, /&sun_azimuth=2[78]\d&sun_elevation=1[89]&haze=[\d.]+&sky=1$/);
    // The server takes it.
    const status = await page.evaluate(async (href) => (await fetch(href)).status, lit.replace(/(width|height)=\d+/g, "$1=60"));
    assert.equal(status, 200);
  }));

test("what is kept of a sky is checked before it is used", () =>
  open(BLOCKS, async ({ page, script }) => {
    await drawn(page);
    for (const kept of ["{", "null", '{"sun":[1e9,-4],"haze":"x","background":"url(x)","color":"red","hour":99}', "[]"]) {
      await page.evaluate(([key, kept]) => localStorage.setItem(key, kept), [`burgeon-sky ${script}`, kept]);
      await page.reload();
      await drawn(page);
      assert.equal(await seen(page, "sky").getAttribute("aria-pressed"), "false", kept);
    }
  }));

test("the model before a save is seen while a key is held, and beside the present one", () =>
  open(BLOCKS, async ({ page, script }) => {
    const first = await drawn(page);
    await page.locator("canvas#view").focus();
    assert.ok(await seen(page, "compare").isHidden());
    await page.keyboard.press("d");
    assert.match(await seen(page, "toast").textContent(), /save a change/);
    await seen(page, "toast").waitFor({ state: "hidden" });
    const red = await pixels(page);
    save(script, BLOCKS.replace("#b0413e", "#2a6fb0"));
    const second = await drawn(page, first);
    await page.waitForTimeout(900);
    const blue = await pixels(page);
    await page.keyboard.down("b");
    await page.waitForTimeout(700);
    assert.match(await seen(page, "compare-labels").innerText(), /before the save/i);
    // The picture differs by its label alone.
    const held = await pixels(page);
    assert.ok(different(held, red) < 4500 && different(held, blue) > 6000, `${different(held, red)} and ${different(held, blue)}`);
    await page.keyboard.up("b");
    await page.waitForTimeout(900);
    assert.ok(different(await pixels(page), blue) < 300, "and then the blue one again");
    // A value changes the present model alone.
    await seen(page, "param-count").fill("5");
    await seen(page, "param-count").press("Enter");
    await drawn(page, second);
    await seen(page, "compare").click();
    await page.waitForTimeout(900);
    const both = await pixels(page);
    const [width, height] = await page.evaluate(() => {
      const { width, height } = document.querySelector("canvas#view").getBoundingClientRect();
      return [width, height];
    });
    const counts = { red: [0, 0], blue: [0, 0] };
    for (let y = 0; y < height; y += 1)
      for (let x = 0; x < width; x += 1) {
        const at = (y * width + x) * 4;
        const [r, , b] = both.subarray(at, at + 3);
        if (r > b + 60) counts.red[x < width / 2 ? 0 : 1] += 1;
        if (b > r + 60) counts.blue[x < width / 2 ? 0 : 1] += 1;
      }
    assert.ok(counts.red[0] > 1000 && counts.blue[1] > 1000, JSON.stringify(counts));
    assert.ok(counts.blue[0] < 100, JSON.stringify(counts));
    // A click on the present model picks in it; the other one is not known any more.
    const [x, y] = await page.evaluate(() => window.burgeon.project([0, -2.02, 1]));
    assert.ok(x > width / 2);
    await page.mouse.click(x, y);
    await seen(page, "picked").waitFor();
    assert.match(await seen(page, "picked").textContent(), /Slab/);
    await page.keyboard.press("Escape");
    await page.mouse.click(x - width / 2, y);
    await page.waitForTimeout(300);
    assert.ok(await seen(page, "picked").isHidden());
    await page.keyboard.press("Escape");
    assert.equal(await page.evaluate(() => window.burgeon.shown.seen), "now");
  }));
