// The live page in a real browser: what a person does and what they see.
//
//   node --test tests/page/page.test.mjs

import assert from "node:assert/strict";
import { rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { after, before, test } from "node:test";

import { BLOCKS, Server, browse, different, drawn, folder, number, pixels, run, save, seen, show } from "./driver.mjs";

let browser;
before(async () => (browser = await browse()));
after(() => browser.close());

const open = (text, act, given) => show(browser, text, act, given);

test("saving the script changes the picture, and saving it unchanged does nothing", () =>
  open(BLOCKS, async ({ page, script }) => {
    const first = await drawn(page);
    const red = await pixels(page);
    save(script, BLOCKS.replace("#b0413e", "#2a6fb0"));
    const second = await drawn(page, first);
    const blue = await pixels(page);
    assert.ok(different(red, blue) > 1000, "a block of another colour covers thousands of pixels");
    save(script, BLOCKS.replace("#b0413e", "#2a6fb0"));
    writeFileSync(script, BLOCKS.replace("#b0413e", "#2a6fb0"));
    await page.waitForTimeout(400);
    assert.equal(await run(page), second);
    assert.match(await seen(page, "time").textContent(), /\d/);
  }));

test("an error stands over the last good model until it is mended", () =>
  open(BLOCKS, async ({ page, script }) => {
    const first = await drawn(page);
    const triangles = await number(page, "triangles");
    save(script, BLOCKS.replace("Slab(n), Block(n - 1)", "Slab(n, 7), Block(n - 1)"));
    const error = seen(page, "error");
    await error.waitFor({ state: "visible" });
    const text = await error.textContent();
    assert.match(text, /blocks\.lua:10/);
    assert.match(text, /Slab/);
    await seen(page, "stale").waitFor({ state: "visible" });
    assert.equal(await run(page), first);
    assert.equal(await number(page, "triangles"), triangles);
    save(script, BLOCKS.replace("default = 3", "default = 4"));
    await drawn(page, first);
    await error.waitFor({ state: "hidden" });
    await seen(page, "stale").waitFor({ state: "hidden" });
    assert.ok((await number(page, "triangles")) > triangles);
  }));

test("warnings stand folded over their model until they are mended", () =>
  open(`${BLOCKS}tower:derive()\n`, async ({ page, script }) => {
    const first = await drawn(page);
    const warnings = seen(page, "warnings");
    assert.match(await warnings.textContent(), /^1 warning/);
    const article = warnings.locator("article");
    assert.ok(await article.isHidden());
    await warnings.getByRole("button", { name: "Fold" }).click();
    assert.match(await article.textContent(), /blocks\.lua:16.*derived again/s);
    save(script, BLOCKS);
    await drawn(page, first);
    await warnings.waitFor({ state: "hidden" });
  }));

test("a rule that fails is told with its rule, module and step", () =>
  open(BLOCKS.replace("if n == 0", "if n == 1 then error('too low') end if n == 0"), async ({ page }) => {
    const error = seen(page, "error");
    await error.waitFor({ state: "visible" });
    const text = await error.textContent();
    for (const part of [/too low/, /blocks\.lua:9/, /Block\(n\)/, /Block\(1\)/, /3/]) assert.match(text, part);
  }));

test("parameters change the model, keep their values across saves, and go back", () =>
  open(BLOCKS, async ({ page, script }) => {
    let last = await drawn(page);
    const triangles = await number(page, "triangles");
    await seen(page, "param-count").fill("8");
    await seen(page, "param-count").press("Enter");
    last = await drawn(page, last);
    const many = await number(page, "triangles");
    assert.ok(many > triangles);
    save(script, BLOCKS.replace("default = 3", "default = 5"));
    last = await drawn(page, last);
    assert.equal(await number(page, "triangles"), many);
    assert.equal(await seen(page, "param-count").inputValue(), "8");
    assert.match(await page.locator("body").textContent(), /default is now 5/i);
    await seen(page, "param-count-slider").focus();
    await page.keyboard.press("ArrowRight");
    last = await drawn(page, last);
    assert.equal(await seen(page, "param-count").inputValue(), "9");
    await seen(page, "param-hollow").check();
    last = await drawn(page, last);
    await seen(page, "param-count-reset").click();
    last = await drawn(page, last);
    assert.equal(await seen(page, "param-count").inputValue(), "5");
    await seen(page, "reset-all").click();
    await drawn(page, last);
    assert.equal(await seen(page, "param-hollow").isChecked(), false);
  }));

test("the step slider shows the model after each step", () =>
  open(BLOCKS, async ({ page }) => {
    let last = await drawn(page);
    const whole = await number(page, "triangles");
    const slider = seen(page, "steps");
    assert.equal(await slider.getAttribute("max"), "4");
    await slider.focus();
    const counts = [];
    for (let step = 0; step < 3; step += 1) {
      await page.keyboard.press("ArrowLeft");
      last = await drawn(page, last);
      counts.push(await number(page, "triangles"));
    }
    assert.ok(counts[0] >= counts[1] && counts[1] > counts[2] && counts[0] <= whole, `${counts} of ${whole}`);
    await seen(page, "all-steps").click();
    await drawn(page, last);
    assert.equal(await number(page, "triangles"), whole);
  }));

test("a click on a known point tells the module, the line and the path of rules", () =>
  open(BLOCKS, async ({ page }) => {
    await drawn(page);
    // The middle of the second block's front: the blocks are 2 m high, and the second one is Slab(2).
    const [x, y] = await page.evaluate(() => window.burgeon.project([0, -2.04, 3]));
    await page.mouse.click(x, y);
    const card = seen(page, "picked");
    await card.waitFor({ state: "visible" });
    const text = await card.textContent();
    assert.match(text, /Slab/);
    assert.match(text, /blocks\.lua:12/);
    assert.match(text, /blocks\.lua:8/);
    assert.match(text, /Block\(3\).*Block\(2\).*Slab\(2\)/s);
    const before = await pixels(page);
    await page.keyboard.press("Escape");
    await card.waitFor({ state: "hidden" });
    await page.waitForTimeout(300);
    assert.ok(different(before, await pixels(page)) > 200, "the module's triangles were marked");
  }));

const HUTS = `local Hut, Stand = module("Hut", "n"), module("Stand", "n")
local placed = {}
for n = 1, 64 do
  -- Every other hut is drawn at the middle and placed; what rules can place is not shown by itself.
  local x, y = (n - 1) % 8 * 12, (n - 1) // 8 * 12
  local w, s = if n % 2 == 0 then 0 else x, if n % 2 == 0 then 0 else y
  local plan = { { w, s }, { w + 6, s }, { w + 6, s + 8 }, { w, s + 8 } }
  local hut = lsystem({ object = extruder({ shape = plan, smooth = false }) })
  hut:axiom(Hut(n))
  hut:interpret("Hut(n)", function(this, n)
    this:color("#b0413e"):caps(true):extrude(3 + n / 100)
  end)
  local derived = hut:derive()
  if n % 2 == 0 then
    placed[n] = derived
  end
end
local all = lsystem({ object = turtle() })
local stands = {}
for n = 2, 64, 2 do
  table.insert(stands, Stand(n))
end
all:axiom(stands)
all:interpret("Stand(n)", function(this, n)
  this:jump(vec((n - 1) % 8 * 12, (n - 1) // 8 * 12, 0)):place(placed[n])
end)
all:derive()
`;

test("many small parts are drawn as few meshes, and each is picked and marked by itself", () =>
  open(HUTS, async ({ page }) => {
    await drawn(page);
    await page.waitForTimeout(1500);
    assert.ok((await page.evaluate(() => window.burgeon.draws)) < 16);
    // The picture has a frame from here on, for the keyboard's sake.
    await page.keyboard.press("Escape");
    const plain = await pixels(page);
    const [width, height] = await page.evaluate(() => [innerWidth, innerHeight]);
    for (const n of [10, 19, 37, 64]) {
      const roof = [((n - 1) % 8) * 12 + 3, Math.floor((n - 1) / 8) * 12 + 4, 3 + n / 100];
      const [x, y] = await page.evaluate((at) => window.burgeon.project(at), roof);
      assert.ok(x > 0 && x < width && y > 0 && y < height, "the whole model is seen");
      await page.mouse.click(x, y);
      await page.waitForFunction((n) => document.querySelector('[data-testid="picked"]').textContent.includes(n), `Hut(${n})`);
      // The card would cover others.
      const covering = (visibility) => seen(page, "picked").evaluate((it, to) => (it.style.visibility = to), visibility);
      await covering("hidden");
      await page.waitForTimeout(800);
      const marked = await pixels(page);
      await covering("");
      await page.keyboard.press("Escape");
      await seen(page, "picked").waitFor({ state: "hidden" });
      await page.waitForTimeout(800);
      const bare = await pixels(page);
      const changed = different(bare, marked);
      assert.ok(changed > 100 && changed < bare.length / 4 / 20, `hut ${n} alone was marked: ${changed} pixels`);
      assert.ok(different(plain, bare) < 50, "nothing of the mark stays");
    }
  }));

test("a line of the script marks all that it made", () =>
  open(BLOCKS, async ({ page }) => {
    await drawn(page);
    const before = await pixels(page);
    const line = seen(page, "line");
    if (!(await line.isVisible())) await seen(page, "derivation").click();
    await line.fill("12");
    await line.press("Enter");
    await seen(page, "highlighted").waitFor({ state: "visible" });
    assert.match(await seen(page, "highlighted").textContent(), /3/);
    await page.waitForTimeout(300);
    assert.ok(different(before, await pixels(page)) > 2000);
  }));

test("the page finds the server again after a restart, and two pages show the same", () =>
  open(
    BLOCKS,
    async ({ page, script, server, context }) => {
      await drawn(page);
      const other = await context.newPage();
      await other.goto(server.address);
      const last = await drawn(other);
      await seen(other, "param-count").fill("6");
      await seen(other, "param-count").press("Enter");
      await drawn(other, last);
      await page.waitForFunction(() => document.querySelector("[data-testid=param-count]").value === "6");
      await other.reload();
      await drawn(other);
      await server.stop();
      const connection = (state) => page.locator(`[data-testid=connection][data-state=${state}]`).waitFor({ timeout: 20_000 });
      await connection("lost");
      const again = await Server.start(script, "--port", String(server.port), "--token", server.token);
      try {
        await connection("live");
        save(script, BLOCKS.replace("default = 3", "default = 2"));
        await page.waitForFunction(() => document.querySelector("[data-testid=param-count]").value === "2");
      } finally {
        await again.stop();
      }
    },
    { fails: true },
  ));

test("a script that is not there is waited for, and one that is broken at the start is told", async () => {
  await open(null, async ({ page, script }) => {
    await seen(page, "waiting").waitFor({ state: "visible" });
    save(script, "this is no Lua");
    await seen(page, "error").waitFor({ state: "visible" });
    save(script, BLOCKS);
    await drawn(page);
    await seen(page, "error").waitFor({ state: "hidden" });
    rmSync(script);
    await seen(page, "waiting").waitFor({ state: "visible" });
    assert.ok((await number(page, "triangles")) > 0, "the last model stays");
  });
});

test("variations are shown and a click adopts one; presets come back", () =>
  open(BLOCKS.replace("extrude(2)", "extrude(1 + random())"), async ({ page }) => {
    let last = await drawn(page);
    await seen(page, "vary").click();
    const cells = page.locator("[data-testid=variations-list] [role=option]");
    await cells.nth(3).locator("img").waitFor({ state: "visible", timeout: 30_000 });
    await cells.nth(2).click();
    last = await drawn(page, last);
    const seed = await seen(page, "seed").inputValue();
    assert.notEqual(seed, "0");
    await page.keyboard.press("Escape");
    await seen(page, "param-count").fill("7");
    await seen(page, "param-count").press("Enter");
    last = await drawn(page, last);
    await seen(page, "preset-save").click();
    await seen(page, "preset-name").fill("tall");
    await seen(page, "preset-name").press("Enter");
    await page.waitForFunction(() => [...document.querySelectorAll("[data-testid=presets] option")].some((it) => it.textContent === "tall"));
    await seen(page, "reset-all").click();
    last = await drawn(page, last);
    assert.equal(await seen(page, "param-count").inputValue(), "3");
    await seen(page, "presets").selectOption("tall");
    await drawn(page, last);
    assert.equal(await seen(page, "param-count").inputValue(), "7");
    assert.equal(await seen(page, "seed").inputValue(), seed);
  }));

test("exports are downloaded, and a screenshot is", () =>
  open(BLOCKS, async ({ page }) => {
    await drawn(page);
    for (const [format, begins] of [["glb", "glTF"], ["png", "\x89PNG"], ["obj", "PK"], ["svg", "<"]]) {
      const download = page.waitForEvent("download", { timeout: 120_000 });
      await seen(page, "export").click();
      await seen(page, `export-${format}`).click();
      const bytes = await readFile(await (await download).path());
      assert.equal(bytes.subarray(0, begins.length).toString("latin1"), begins, format);
    }
    const download = page.waitForEvent("download", { timeout: 120_000 });
    await seen(page, "screenshot").click();
    const bytes = await readFile(await (await download).path());
    assert.equal(bytes.subarray(1, 4).toString("latin1"), "PNG");
  }));

test("everything can be done from the keyboard, and ? tells how", () =>
  open(BLOCKS, async ({ page }) => {
    await drawn(page);
    await page.keyboard.press("?");
    await seen(page, "keys").waitFor({ state: "visible" });
    await page.keyboard.press("Escape");
    await seen(page, "keys").waitFor({ state: "hidden" });
    const reached = new Set();
    for (let presses = 0; presses < 60; presses += 1) {
      await page.keyboard.press("Tab");
      reached.add(await page.evaluate(() => document.activeElement?.dataset?.testid ?? ""));
    }
    for (const name of ["export", "theme", "help", "param-count", "seed", "dice", "play", "fit"]) {
      assert.ok(reached.has(name), `${name} is reached by Tab; reached: ${[...reached]}`);
    }
    const before = await pixels(page);
    await page.keyboard.press("5");
    await page.waitForTimeout(500);
    assert.ok(different(before, await pixels(page)) > 500, "a standard view is another picture");
  }));

test("what the status line tells fits into it at any width", () =>
  open(BLOCKS, async ({ page }) => {
    await drawn(page);
    for (const width of [1200, 1000, 800, 762, 420]) {
      await page.setViewportSize({ width, height: 700 });
      await page.waitForTimeout(100);
      const [end, ends] = await page.evaluate(() => {
        const status = document.querySelector(".status");
        const ends = [...status.children].map((child) => child.getBoundingClientRect().right);
        return [status.getBoundingClientRect().right, ends];
      });
      assert.ok(Math.max(...ends) <= end, `${width}: ${ends} in ${end}`);
    }
  }));

test("texture coordinates come only when they are shown, and triangles stay where they are", () =>
  open(BLOCKS, async ({ page, script }) => {
    const whole = [];
    page.on("response", (response) => {
      if (/model\//.test(response.url())) whole.push(response.url().endsWith(".uv.glb") && response.ok());
    });
    let last = await drawn(page);
    await seen(page, "mode-uv").check({ force: true });
    await page.waitForTimeout(500);
    save(script, BLOCKS.replace("default = 3", "default = 4"));
    last = await drawn(page, last);
    const [x, y] = await page.evaluate(() => window.burgeon.project([0, -2.04, 3]));
    await page.mouse.click(x, y);
    await seen(page, "picked").waitFor({ state: "visible" });
    assert.match(await seen(page, "picked").textContent(), /Slab\(3\)/);
    await seen(page, "mode-lit").check({ force: true });
    save(script, BLOCKS);
    await drawn(page, last);
    assert.deepEqual(whole.slice(-3), [true, true, false]);
  }));

test("a page of another site, a wrong token and a path that leads away are refused", () =>
  open(BLOCKS, async ({ page, server, context }) => {
    await drawn(page);
    const base = `http://127.0.0.1:${server.port}`;
    const status = async (path, headers) => (await context.request.get(base + path, { headers, maxRedirects: 0 })).status();
    assert.equal(await status("/"), 403);
    assert.equal(await status(`/${"0".repeat(32)}/`), 403);
    assert.equal(await status(`/${server.token}/`, { Host: "example.org" }), 403);
    assert.equal(await status(`/${server.token}/`, { Origin: "http://example.org" }), 403);
    for (const path of ["/%2e%2e/%2e%2e/etc/passwd", "/..%2f..%2fetc/passwd", "/model/../../Cargo.toml", "/none"]) {
      const answered = await status(`/${server.token}${path}`);
      assert.ok(answered === 404 || answered === 403, `${path}: ${answered}`);
    }
    const foreign = createServer((_, answer) => answer.setHeader("content-type", "text/html").end("<p>elsewhere"));
    await new Promise((done) => foreign.listen(0, "127.0.0.1", done));
    const elsewhere = await context.newPage();
    await elsewhere.goto(`http://127.0.0.1:${foreign.address().port}/`);
    const opened = await elsewhere.evaluate(
      (address) =>
        new Promise((done) => {
          const socket = new WebSocket(address);
          socket.onopen = () => done("open");
          socket.onerror = () => done("refused");
        }),
      `ws://127.0.0.1:${server.port}/${server.token}/socket`,
    );
    foreign.close();
    assert.equal(opened, "refused");
  }));

test("without WebGL the page says so and the rest works", async () => {
  const plain = await browse("--disable-3d-apis");
  const script = join(folder(), "blocks.lua");
  writeFileSync(script, BLOCKS);
  const server = await Server.start(script, "--port", "0");
  try {
    const page = await plain.newPage();
    await page.goto(server.address);
    await seen(page, "no-webgl").waitFor({ state: "visible" });
    await page.waitForFunction(() => /\d/.test(document.querySelector("[data-testid=triangles]").textContent));
    await seen(page, "param-count").fill("8");
    await seen(page, "param-count").press("Enter");
    save(script, "broken");
    await seen(page, "error").waitFor({ state: "visible" });
  } finally {
    await plain.close();
    await server.stop();
  }
});

test("a long run tells its progress and can be cancelled", () =>
  open(BLOCKS, async ({ page, script }) => {
    const first = await drawn(page);
    const slow = BLOCKS.replace("if n == 0", "local s = 0 for i = 1, 4e8 do s += i % 7 end if n == 0");
    save(script, slow);
    await seen(page, "cancel").waitFor({ state: "visible", timeout: 20_000 });
    await seen(page, "cancel").click();
    await seen(page, "working").waitFor({ state: "hidden", timeout: 20_000 });
    assert.equal(await run(page), first);
    save(script, slow + "-- again");
    await seen(page, "cancel").waitFor({ state: "visible", timeout: 20_000 });
    save(script, BLOCKS);
    await page.waitForFunction((first) => Number(document.documentElement.dataset.run) > first, first);
  }));
