// The outline of the live page: search, go there, isolate and hide; groups and strips of parameters; the timeline's speed.
//
//   node --test tests/page/parts.test.mjs

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { BLOCKS, browse, drawn, run, save, seen, show } from "./driver.mjs";

let browser;
before(async () => (browser = await browse()));
after(() => browser.close());

const open = (text, act, given) => show(browser, text, act, given);
const shown = (page) => page.evaluate(() => window.burgeon.shown.triangles);

/** A tower of two symbols, and a system with a chain for each of three houses. */
const TOWN = `local Base, Top, House = module("Base"), module("Top"), module("House", "n")
local square = { { -2, -2 }, { 2, -2 }, { 2, 2 }, { -2, 2 } }
local tower = lsystem({ object = extruder({ shape = square, smooth = false }) })
tower:axiom(Base(), Top())
tower:interpret("Base", function(this) this:extrude(6) end)
tower:interpret("Top", function(this) this:scale(0.5):extrude(3) end)
tower:derive()
local houses = lsystem({ object = turtle() })
houses:axiom(source({ { id = "north" }, { id = "south" }, { id = "<i>west</i>" } }), function(feature)
  return turtle(), House(#feature.id)
end)
houses:interpret("House(n)", function(this, n) this:forward(n) end)
houses:derive()
`;

test("the outline lists systems, modules and features, and goes to them", () =>
  open(TOWN, async ({ page, complaints }) => {
    await drawn(page);
    assert.deepEqual(complaints, []);
    await page.locator("canvas#view").focus();
    await page.keyboard.press("t");
    await seen(page, "part-north").waitFor();
    const list = seen(page, "outline-list");
    assert.match(await list.innerText(), /System 1[\s\S]*Base[\s\S]*Top[\s\S]*System 2[\s\S]*House[\s\S]*north[\s\S]*<i>west<\/i>/);
    const before = await page.evaluate(() => window.burgeon.camera.distance);
    await seen(page, "part-Top").click();
    await page.waitForTimeout(700);
    const { distance, target } = await page.evaluate(() => window.burgeon.camera);
    assert.ok(distance < before * 0.8, `${distance} of ${before}`);
    assert.ok(Math.abs(target[1] - 7.5) < 0.3, `the middle of the top is 7.5 m high, not ${target[1]}`);
    await seen(page, "outline-search").fill("sou");
    await seen(page, "part-north").waitFor({ state: "detached" });
    assert.equal(await seen(page, "part-south").count(), 1);
    await seen(page, "outline-search").fill("nowhere");
    await list.getByText("Nothing has this name.").waitFor();
  }));

test("parts are isolated and hidden, also after a save, and all come back", () =>
  open(TOWN, async ({ page, script }) => {
    const first = await drawn(page);
    const whole = await shown(page);
    await page.locator("#outline summary").click();
    await seen(page, "hide-Top").click();
    await seen(page, "hidden-parts").waitFor({ state: "visible" });
    const without = await shown(page);
    assert.ok(without < whole);
    assert.match(await seen(page, "hidden-parts").innerText(), /Top hidden/);
    // What is hidden is not picked.
    const at = await page.evaluate(() => window.burgeon.project([0, -1, 7.5]));
    await page.mouse.click(...at);
    await page.waitForTimeout(300);
    assert.ok(!/Top/.test(await seen(page, "picked").textContent()));
    save(script, TOWN.replace("extrude(6)", "extrude(7)"));
    await drawn(page, first);
    await page.waitForFunction((without) => window.burgeon.shown.triangles === without, without);
    await seen(page, "isolate-Base").click();
    await page.waitForFunction((without) => window.burgeon.shown.triangles < without, without);
    const alone = await shown(page);
    const base = await page.evaluate(() => window.burgeon.project([0, -2, 3]));
    await page.mouse.click(...base);
    await seen(page, "picked").waitFor();
    assert.match(await seen(page, "picked").textContent(), /Base/);
    await page.keyboard.press("Escape");
    await page.keyboard.press("u");
    assert.equal(await shown(page), whole);
    assert.ok(await seen(page, "hidden-parts").isHidden());
    await seen(page, "isolate-System 1".replace("System ", "")).click();
    await page.waitForFunction((alone) => window.burgeon.shown.triangles > alone, alone);
    await seen(page, "show-all").click();
    assert.equal(await shown(page), whole);
    await seen(page, "hide-north").click();
    await page.waitForFunction((whole) => window.burgeon.shown.triangles < whole, whole);
  }));

test("what is picked is isolated, hidden and framed by keys and by buttons", () =>
  open(BLOCKS, async ({ page }) => {
    const last = await drawn(page);
    const whole = await shown(page);
    const pick = async () => {
      const at = await page.evaluate(() => window.burgeon.project([0, -2.02, 1]));
      await page.mouse.click(...at);
      await seen(page, "picked-hide").waitFor();
    };
    await pick();
    await page.keyboard.press("h");
    const without = await shown(page);
    assert.ok(without < whole && without > 0);
    await seen(page, "show-all").click();
    await pick();
    await seen(page, "picked-isolate").click();
    assert.ok(Math.abs((await shown(page)) - (whole - without)) < 1e-9);
    // Another model has other modules: all of it is seen.
    await seen(page, "param-count").fill("4");
    await seen(page, "param-count").press("Enter");
    await drawn(page, last);
    assert.ok((await shown(page)) > whole);
    assert.ok(await seen(page, "hidden-parts").isHidden());
  }));

const GROUPED = BLOCKS.replace('doc = "Blocks of the tower"', 'group = "Shape", doc = "Blocks of the tower"')
  .replace("default = false }", 'default = false, group = "Shape" }')
  .replace('choices = { "plain", "fluted" }', 'choices = { "plain", "fluted" }, group = "Look & feel"');

test("parameters stand in their groups, which fold, and a search opens them", () =>
  open(GROUPED, async ({ page, script }) => {
    const first = await drawn(page);
    const texts = await page.locator("#params").innerText();
    assert.match(texts, /^color[\s\S]*Shape[\s\S]*count[\s\S]*hollow[\s\S]*Look & feel[\s\S]*style/);
    const shape = seen(page, "group-Shape");
    await shape.locator("summary").click();
    assert.ok(await seen(page, "param-count").isHidden());
    save(script, `${GROUPED}${Array.from({ length: 8 }, (_, i) => `param("more${i}", { default = ${i}, group = "More" })\n`).join("")}`);
    const second = await drawn(page, first);
    assert.ok(await seen(page, "param-count").isHidden(), "a folded group stays folded");
    await seen(page, "params-search").fill("blocks of");
    assert.ok(await seen(page, "param-count").isVisible());
    assert.ok(await seen(page, "group-More").isHidden());
    await seen(page, "params-search").fill("");
    assert.ok(await seen(page, "param-count").isHidden());
    save(script, BLOCKS);
    await drawn(page, second);
    assert.equal(await shape.count(), 0);
    assert.ok(await seen(page, "param-count").isVisible());
  }));

test("a strip of pictures shows what a slider does, and a click takes a value", () =>
  open(BLOCKS, async ({ page }) => {
    const first = await drawn(page);
    await seen(page, "param-count").hover();
    await seen(page, "param-count-strip").click();
    const pictures = seen(page, "param-count-strip-list").locator("button:enabled");
    await page.waitForFunction(() => document.querySelectorAll("[data-testid=param-count-strip-list] img").length === 4);
    assert.deepEqual(await pictures.allInnerTexts(), ["1", "5", "8", "12"]);
    const loaded = await page.evaluate(() =>
      [...document.querySelectorAll("[data-testid=param-count-strip-list] img")].every((it) => it.complete && it.naturalWidth > 0),
    );
    assert.ok(loaded);
    await pictures.nth(2).click();
    await drawn(page, first);
    assert.equal(await seen(page, "param-count").inputValue(), "8");
    assert.equal(await pictures.nth(2).getAttribute("aria-pressed"), "true");
    // One strip is open at a time.
    await seen(page, "param-hollow-strip").focus();
    await page.keyboard.press("Enter");
    await seen(page, "param-count-strip-list").waitFor({ state: "hidden" });
    await page.waitForFunction(() => document.querySelectorAll("[data-testid=param-hollow-strip-list] img").length === 2);
  }));

test("at full speed the next step is asked for while the one before is drawn, and each step is drawn", () =>
  open(BLOCKS.replace("default = 3", "default = 9"), async ({ page }) => {
    await drawn(page);
    await page.evaluate(() => {
      window.events = [];
      const { send } = WebSocket.prototype;
      WebSocket.prototype.send = function (text) {
        const { type, steps } = JSON.parse(text);
        if (type === "steps") window.events.push(`ask ${steps}`);
        return send.call(this, text);
      };
      addEventListener("burgeon:drawn", () => window.events.push(`drawn ${window.burgeon.model.steps}`));
    });
    const play = async () => {
      await page.evaluate(() => (window.events.length = 0));
      await seen(page, "play").click();
      await page.waitForFunction(() => window.events.at(-1) === "drawn 10" && document.querySelector("#all-steps").disabled);
      return page.evaluate(() => window.events);
    };
    const slow = await play();
    assert.ok(slow.indexOf("ask 4") > slow.indexOf("drawn 3"), slow.join());
    for (const text of ["2×", "4×", "max"]) {
      await seen(page, "speed").click();
      assert.equal(await seen(page, "speed").textContent(), text);
    }
    const fast = await play();
    for (let step = 1; step < 9; step += 1) {
      assert.ok(fast.includes(`drawn ${step}`), fast.join());
      assert.ok(fast.indexOf(`ask ${step + 1}`) < fast.indexOf(`drawn ${step}`), fast.join());
    }
    await seen(page, "speed").click();
    assert.equal(await seen(page, "speed").textContent(), "1×");
  }));
