// What the page tells besides the model: how things stand, what is asked first, what is offered.
//
//   node --test tests/page/notes.test.mjs

import assert from "node:assert/strict";
import { rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:net";
import { dirname, join } from "node:path";
import { after, before, test } from "node:test";

import { BLOCKS, Server, browse, drawn, folder, number, save, seen, show } from "./driver.mjs";

let browser;
before(async () => (browser = await browse()));
after(() => browser.close());

const open = (text, act, given) => show(browser, text, act, given);
const visible = (page, name) => seen(page, name).waitFor({ state: "visible", timeout: 20_000 });
const hidden = (page, name) => seen(page, name).waitFor({ state: "hidden", timeout: 20_000 });

/** A script that runs until it is stopped, and tells its progress. */
const ENDLESS = BLOCKS.replace("if n == 0 then return nil end", "if n > -1 then return Block(n) end").replace(
  "tower:derive()",
  "tower:derive(1e8)",
);

/** Has no end where `count` is 6, and fails where it is 7. */
const HEAVY = BLOCKS.replace("if n == 0", 'if n == 7 then error("too many") end if n == 6 then return Block(n) end if n == 0').replace(
  "local color",
  'local tiny = param("tiny", { default = 1 })\nlocal color',
);

/** A port that is likely to stay free for a moment. */
async function freePort() {
  const server = createServer();
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  const { port } = server.address();
  await new Promise((done) => server.close(done));
  return String(port);
}

/** The rectangle of what can be seen, or null. */
const place = (page, selector) =>
  page.evaluate((selector) => {
    const element = document.querySelector(selector);
    if (!element?.checkVisibility()) return null;
    const { left, right, top, bottom } = element.getBoundingClientRect();
    return { left, right, top, bottom };
  }, selector);

const apart = (a, b) => a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;

test("a page finds the next server of its port, shows what that one shows, and is told of a new address", async () => {
  const scripts = ["blocks.lua", "other.lua"].map((name) => join(folder(), name));
  writeFileSync(scripts[0], BLOCKS);
  writeFileSync(scripts[1], BLOCKS.replace("default = 3", "default = 5"));
  const port = await freePort();
  const connection = (page, state) =>
    page.locator(`[data-testid=connection][data-state=${state}]`).waitFor({ timeout: 20_000 });
  const page = await browser.newPage();
  const asked = [];
  page.on("request", (request) => asked.push(request.url()));
  let server = await Server.start(scripts[0], "--port", port);
  try {
    const { address, token } = server;
    await page.goto(address);
    await drawn(page);
    await server.stop();
    await connection(page, "lost");
    server = await Server.start(scripts[0], "--port", port);
    assert.equal(server.address, address);
    await connection(page, "live");
    await server.stop();
    await connection(page, "lost");
    server = await Server.start(scripts[1], "--port", port);
    await page.waitForFunction(() => document.querySelector("[data-testid=script]").textContent === "other.lua");
    await page.waitForFunction(() => document.querySelector("[data-testid=param-count]")?.value === "5");
    await server.stop();
    await connection(page, "lost");
    rmSync(join(process.env.XDG_RUNTIME_DIR, "burgeon"), { recursive: true });
    asked.length = 0;
    server = await Server.start(scripts[0], "--port", port);
    await connection(page, "moved");
    await visible(page, "moved");
    // Whoever listens there now is not told the old one.
    await page.waitForTimeout(1500);
    assert.ok(asked.length > 0 && !asked.some((url) => url.includes(token)), asked.join("\n"));
    await page.goto(server.address);
    await drawn(page);
  } finally {
    await page.close();
    await server.stop();
  }
});

test("a line is looked for in the script, and one that is not there leaves no mark of another", () =>
  open(`require("aaa")\n${BLOCKS}`, async ({ page, script }) => {
    writeFileSync(join(dirname(script), "aaa.lua"), "return {}\n");
    await drawn(page);
    await seen(page, "derivation").locator("summary").click();
    const line = seen(page, "line");
    const says = async (text, answer) => {
      await line.fill(text);
      await line.press("Enter");
      await page.waitForFunction(
        (answer) => new RegExp(answer).test(document.querySelector("[data-testid=highlighted]").textContent),
        answer,
        { timeout: 20_000 },
      );
    };
    await says("13", "blocks.lua:13.*3 modules");
    await says("900", "unknown line 900");
    // It is told once, beside the field.
    assert.ok(await seen(page, "toast").isHidden());
    await says("99999999999999999999", "no line 99999999999999999999");
    await says("blocks.lua:13", "3 modules");
    await says("aaa.lua:7", "1 line");
    await says("none.lua:1", "not a file of the script");
    await says("what", "write a line as");
    await says("1", "nothing in the model");
    await visible(page, "toast");
    await says("what", "write a line as");
    assert.ok(await seen(page, "toast").isHidden(), "an older line stands beside the newer one");
  }));

test("a message of millions of letters is shown in part, with the lines that it is about", () =>
  open(BLOCKS, async ({ page, script }) => {
    await drawn(page);
    save(script, `${BLOCKS}error(string.rep("wide ", 4e6))\n`);
    const begin = Date.now();
    await visible(page, "error");
    const text = await seen(page, "error").textContent();
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    assert.ok(Date.now() - begin < 10_000, `${Date.now() - begin} ms`);
    assert.ok(text.length < 50_000 && /characters in all/.test(text), String(text.length));
    assert.match(await page.locator(".excerpt .here").textContent(), /16error\(string\.rep/);
    assert.match(await page.locator(".excerpt").textContent(), /tower:derive\(\)/);
  }));

test("a cancelled run leaves the model marked as stale, with a way to run again", () =>
  open(BLOCKS, async ({ page, script }) => {
    const first = await drawn(page);
    save(script, ENDLESS);
    await visible(page, "cancel");
    await page.waitForFunction(() => /step/.test(document.querySelector("[data-testid=progress]").textContent));
    const progress = await seen(page, "progress").textContent();
    assert.equal(progress.match(/step/g)?.length ?? 0, 1, progress);
    assert.equal(progress.match(/ modules,/g)?.length ?? 0, 1, progress);
    await seen(page, "cancel").click();
    await visible(page, "cancelled");
    await visible(page, "stale");
    await hidden(page, "working");
    await seen(page, "run-again").click();
    await visible(page, "cancel");
    await hidden(page, "cancelled");
    save(script, BLOCKS.replace("default = 3", "default = 4"));
    await drawn(page, first);
    await hidden(page, "stale");
    await hidden(page, "cancelled");
  }));

test("a value that is cancelled goes back to the picture's, and one that fails is seen to be in force", () =>
  open(HEAVY, async ({ page }) => {
    const first = await drawn(page);
    const count = seen(page, "param-count");
    const put = async (name, value) => {
      await seen(page, name).fill(value);
      await seen(page, name).press("Enter");
    };
    await put("param-count", "6");
    await visible(page, "cancel");
    await seen(page, "cancel").click();
    await hidden(page, "working");
    await page.waitForFunction(() => document.querySelector("[data-testid=param-count]").value === "3");
    await hidden(page, "cancelled");
    await hidden(page, "stale");
    await hidden(page, "reset-all");
    await put("param-tiny", "2");
    await drawn(page, first);
    assert.equal(await count.inputValue(), "3");
    await put("param-count", "7");
    await visible(page, "error");
    await visible(page, "param-count-reset");
    await visible(page, "reset-all");
    await page.reload();
    await visible(page, "error");
    await visible(page, "param-count-reset");
    assert.equal(await count.inputValue(), "7");
  }));

test("a number goes to the nearest step, and what the server does not take is put back and told", () =>
  open(BLOCKS, async ({ page }) => {
    await page.routeWebSocket(/socket/, (socket) => {
      const server = socket.connectToServer();
      socket.onMessage((message) => server.send(message.replace('"count":"9"', '"count":"9.5"')));
    });
    await page.reload();
    let last = await drawn(page);
    const put = async (value) => {
      await seen(page, "param-count").fill(value);
      await seen(page, "param-count").press("Enter");
    };
    await put("4.4");
    last = await drawn(page, last);
    assert.equal(await seen(page, "param-count").inputValue(), "4");
    await put("9");
    await visible(page, "toast");
    assert.match(await seen(page, "toast").textContent(), /between two steps/);
    assert.equal(await seen(page, "param-count").inputValue(), "4");
    assert.equal(await seen(page, "param-count-slider").inputValue(), "4");
    await put("5");
    await drawn(page, last);
    assert.equal(await seen(page, "param-count").inputValue(), "5");
  }));

test("without a graphics card the page keeps still while a script runs", () =>
  open(BLOCKS, async ({ page, script }) => {
    await drawn(page);
    save(script, ENDLESS);
    await visible(page, "cancel");
    await page.waitForTimeout(1000);
    const { moving, texts, seconds } = await page.evaluate(async () => {
      const all = [];
      const begin = performance.now();
      const watch = new MutationObserver((records) => all.push(...records));
      watch.observe(document.body, { subtree: true, childList: true, attributes: true, characterData: true });
      const moving = [];
      for (let i = 0; i < 20; i += 1) {
        moving.push(document.getAnimations().length);
        await new Promise((done) => setTimeout(done, 100));
      }
      watch.disconnect();
      const texts = all.filter(({ target }) => target.id === "working-text").length;
      return { moving: Math.max(...moving), texts, seconds: (performance.now() - begin) / 1000 };
    });
    assert.equal(moving, 0);
    assert.ok(texts > 0 && texts / seconds < 4, `${texts} in ${seconds} s`);
  }));

test("texts keep their lines, fit, and stand in the order in which they are needed", () => {
  const word = "w".repeat(300);
  const text = BLOCKS.replace("Blocks of the tower", word);
  return open(text, async ({ page, script, server }) => {
    await drawn(page);
    const help = page.locator(".help").first();
    const [wide, inner] = await help.evaluate((it) => [it.scrollWidth, it.clientWidth]);
    assert.ok(wide <= inner, `${wide} in ${inner}`);
    save(script, `${text}local here = "${"long ".repeat(60)}" .. nothing.at.all\n`);
    await visible(page, "error");
    const { right, ...edge } = await place(page, ".error-list");
    const code = await page.locator(".excerpt .here code").boundingBox();
    assert.ok(code.x >= edge.left && code.x + code.width <= right, JSON.stringify([code, right]));
    save(script, `${text}error("one\\ntwo\\nthree")\n`);
    await page.waitForFunction(() => /three/.test(document.querySelector(".error-message")?.textContent));
    const lines = await page.locator(".error-message").evaluate((it) => {
      const height = parseFloat(getComputedStyle(it).lineHeight) || 20;
      return it.getBoundingClientRect().height / height;
    });
    assert.ok(lines > 2.5, `${lines} lines`);
    await page.setViewportSize({ width: 390, height: 844 });
    await server.stop();
    await page.locator("[data-testid=connection][data-state=lost]").waitFor({ timeout: 20_000 });
    const [all, shown] = await seen(page, "connection").evaluate((it) => [it.scrollWidth, it.clientWidth]);
    assert.ok(all <= shown, `${all} in ${shown}`);
  }, { fails: true });
});

test("an error's remedy stands before the lines that it is about", () =>
  open(BLOCKS.replace("extrude(2)", "extrud(2)"), async ({ page }) => {
    await visible(page, "error");
    const [remedy, lines] = [await place(page, ".error-help"), await place(page, ".excerpt")];
    assert.ok(remedy.bottom <= lines.top, JSON.stringify([remedy, lines]));
  }));

test("the menu of exports is opened by a key with its first item, and tells what each format is", () =>
  open(BLOCKS, async ({ page }) => {
    await drawn(page);
    await page.keyboard.press("e");
    const focused = () => page.evaluate(() => document.activeElement.dataset.testid ?? "");
    assert.match(await focused(), /^export-/);
    for (const about of await page.locator("#exports a span").allTextContents()) assert.notEqual(about, "");
    await page.keyboard.press("Escape");
    assert.equal(await focused(), "export");
  }));

test("a model without steps has no timeline, and variations stay within the bounds of their parameter", () =>
  open(BLOCKS, async ({ page, script }) => {
    const first = await drawn(page);
    await page.locator("#timeline").waitFor({ state: "visible" });
    await seen(page, "vary").click();
    await seen(page, "variations-of").selectOption("count");
    await seen(page, "variations-4").check({ force: true });
    await seen(page, "variations-from").fill("-50");
    await seen(page, "variations-from").press("Enter");
    assert.equal(await seen(page, "variations-from").inputValue(), "1");
    await page.keyboard.press("Escape");
    save(script, BLOCKS.replace("tower:derive()", "tower:derive(0)").replace("tower:axiom(Block(count))", "tower:axiom(Slab(count))"));
    await drawn(page, first);
    await page.locator("#timeline").waitFor({ state: "hidden" });
  }));

test("how long a model has been stale is known after the page is loaded again", () =>
  open(BLOCKS, async ({ page, script }) => {
    await drawn(page);
    save(script, "broken");
    await visible(page, "stale");
    await page.waitForTimeout(3000);
    await page.reload();
    await visible(page, "stale");
    const age = Number((await seen(page, "stale").textContent()).match(/(\d+) s/)[1]);
    assert.ok(age >= 2, String(age));
  }));

test("notes, tools and cards leave each other room at any width", () =>
  open(BLOCKS, async ({ page, script }) => {
    const first = await drawn(page);
    const widths = [1440, 1100, 900, 600, 390];
    const within = ({ left, right }, width) => left >= 0 && right <= width;
    save(script, ENDLESS);
    await visible(page, "cancel");
    for (const width of widths) {
      await page.setViewportSize({ width, height: 844 });
      await page.waitForTimeout(250);
      const [pill, bar] = [await place(page, "[data-testid=working]"), await place(page, ".tools")];
      assert.ok(apart(pill, bar) && within(pill, width), `${width}: ${JSON.stringify([pill, bar])}`);
    }
    save(script, BLOCKS);
    await drawn(page, first);
    await page.evaluate(() => window.burgeon.project([0, -2.04, 3])).then(([x, y]) => page.mouse.click(x, y));
    await visible(page, "picked");
    save(script, BLOCKS.replace("Slab(n), Block(n - 1)", "Slab(n, 7), Block(n - 1)"));
    await visible(page, "error");
    for (const width of widths) {
      await page.setViewportSize({ width, height: 844 });
      await page.waitForTimeout(250);
      const [error, card, bar] = [
        await place(page, "[data-testid=error]"),
        await place(page, "[data-testid=picked]"),
        await place(page, ".tools"),
      ];
      assert.ok(apart(error, card) && apart(error, bar) && apart(card, bar), `${width}: ${JSON.stringify([error, card, bar])}`);
      assert.ok(error.bottom - error.top > 90 && card.bottom - card.top > 90, `${width}: ${JSON.stringify([error, card])}`);
      assert.ok(within(error, width) && within(card, width), `${width}`);
    }
  }));

test("a preset is replaced or deleted only after a question, and its name goes with its values", () =>
  open(BLOCKS, async ({ page }) => {
    let last = await drawn(page);
    const names = (wanted) =>
      page.waitForFunction(
        (wanted) => [...document.querySelectorAll("[data-testid=presets] option")].slice(1).map((it) => it.value).join() === wanted,
        wanted,
      );
    const chosen = (wanted) =>
      page.waitForFunction((wanted) => document.querySelector("[data-testid=presets]").value === wanted, wanted);
    const keep = async (name) => {
      await seen(page, "preset-save").click();
      await seen(page, "preset-name").fill(name);
      await seen(page, "preset-name").press("Enter");
    };
    const count = async (value) => {
      await seen(page, "param-count").fill(value);
      await seen(page, "param-count").press("Enter");
      last = await drawn(page, last);
    };
    await count("5");
    await keep("mine");
    await names("mine");
    await chosen("mine");
    await count("7");
    await chosen("");
    await keep("mine");
    await visible(page, "preset-ask");
    assert.match(await seen(page, "preset-ask").textContent(), /Replace.*mine/);
    await page.keyboard.press("Escape");
    await hidden(page, "preset-ask");
    await seen(page, "presets").selectOption("mine");
    last = await drawn(page, last);
    assert.equal(await seen(page, "param-count").inputValue(), "5");
    await seen(page, "reset-all").click();
    last = await drawn(page, last);
    await chosen("");
    await count("9");
    await keep("mine");
    await seen(page, "preset-yes").click();
    await chosen("mine");
    await seen(page, "preset-delete").click();
    await visible(page, "preset-ask");
    await seen(page, "preset-no").click();
    await names("mine");
    await seen(page, "preset-delete").click();
    await seen(page, "preset-yes").click();
    await names("");
  }));

test("features that are simplified are told beside the warnings, and cover nothing", () =>
  open(
    `local A = module("A")
local s = lsystem({ object = footprint })
s:axiom(source({ { id = "hourglass", rings = { { 0, 0 }, { 8, 8 }, { 8, 0 }, { 0, 8 } } } }), function(f)
  return footprint(f.rings, { height = 3 }), A()
end)
s:interpret("A", function(this) this:walls():roof({ kind = "flat" }) end)
s:derive()
`,
    async ({ page }) => {
      await drawn(page);
      const warnings = seen(page, "warnings");
      assert.match(await warnings.textContent(), /^1 note/);
      await warnings.getByRole("button", { name: "Fold" }).click();
      assert.match(await warnings.locator("article").textContent(), /1 of 1 feature simplified.*burgeon run .*blocks\.lua --report/s);
      assert.ok(await seen(page, "toast").isHidden());
    },
  ));

test("an empty model says why, and one that grows out of the view is offered to be fitted", () =>
  open(BLOCKS.replace("tower:axiom(Block(count))", "tower:axiom(Block(0))"), async ({ page, script }) => {
    let last = await drawn(page);
    await visible(page, "nothing");
    assert.match(await seen(page, "nothing").textContent(), /the chain is empty/);
    save(script, BLOCKS);
    last = await drawn(page, last);
    await hidden(page, "nothing");
    await hidden(page, "offer-fit");
    save(script, BLOCKS.replace("extrude(2)", "extrude(30)"));
    last = await drawn(page, last);
    await visible(page, "offer-fit");
    assert.match(await seen(page, "offer-fit").textContent(), /out of view/);
    await seen(page, "offer-fit").getByRole("button").click();
    await hidden(page, "offer-fit");
    save(script, BLOCKS.replace("extrude(2)", "extrude(29)"));
    last = await drawn(page, last);
    await hidden(page, "offer-fit");
    save(script, BLOCKS.replace("extrude(2)", "extrude(0.001)").replace("{ { -2, -2 }, { 2, -2 }, { 2, 2 }, { -2, 2 } }", "{ { -0.1, -0.1 }, { 0.1, -0.1 }, { 0.1, 0.1 } }"));
    last = await drawn(page, last);
    await visible(page, "offer-fit");
    assert.match(await seen(page, "offer-fit").textContent(), /very small/);
    await page.keyboard.press("f");
    await hidden(page, "offer-fit");
    assert.ok((await number(page, "triangles")) > 0);
  }));
