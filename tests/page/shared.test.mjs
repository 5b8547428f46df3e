// The shared page of a model, opened as a file, without a server and without a network.
//
//   node --test tests/page/shared.test.mjs
//
// PLAYWRIGHT names the folder whose node_modules has playwright-core; SHOTS a folder for pictures in both themes.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";

import { browse, folder } from "./driver.mjs";

const root = resolve(fileURLToPath(import.meta.url), "../../..");
const burgeon = process.env.BURGEON ?? join(root, "target/release/burgeon");
const made = folder();

/** Writes the page of a script and returns its path. */
function page(script, name, ...settings) {
  const path = join(made, name);
  execFileSync(burgeon, ["run", script, "-o", path, ...settings], { stdio: "pipe" });
  return path;
}

const NASTY = `-- "quotes" 'and' </script><!--<script> & 🌱
local kind = param("kind", { default = "</script><b>🌱", doc = "\\"x\\"" })
local A = module("A")
local s = lsystem({ object = extruder({ sides = 4 }) })
s:axiom(source({ { id = "a \\"b\\" </script> 🌱" } }), function(feature) return extruder({ sides = 4 }), A() end)
s:interpret("A", function(this) this:scale(2):extrude(3) end)
s:derive(1)
`;

let browser;
before(async () => {
  browser = await browse("--use-gl=angle", "--ignore-gpu-blocklist");
});
after(() => browser.close());

/** Opens a file without a network; fails at its end if the page has asked for anything or has failed. */
async function open(path, scheme = "light", act) {
  const context = await browser.newContext({
    viewport: { width: 1280, height: 800 },
    colorScheme: scheme,
    offline: true,
    acceptDownloads: true,
  });
  const tab = await context.newPage();
  const [asked, failed] = [[], []];
  tab.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url()) || (request.url().startsWith("file:") && asked.length)) asked.push(request.url());
  });
  tab.on("websocket", (socket) => asked.push(socket.url()));
  tab.on("pageerror", (error) => failed.push(error.message));
  tab.on("console", (message) => message.type() === "error" && failed.push(message.text()));
  await tab.goto(pathToFileURL(path).href);
  await tab.waitForFunction(() => document.documentElement.dataset.drawn === "yes", undefined, { timeout: 60_000 });
  await act(tab);
  assert.deepEqual(asked, []);
  assert.deepEqual(failed, []);
  await context.close();
}

test("a shared tower has less than 2 MB and shows itself, its script and its values", async () => {
  const script = join(root, "scripts/tower.lua");
  const path = page(script, "tower.html", "--set", "floors=30", "--seed", "7");
  assert.ok(statSync(path).size < 2_000_000);
  for (const scheme of ["light", "dark"]) {
    await open(path, scheme, async (tab) => {
      assert.equal(await tab.title(), "tower · burgeon");
      assert.match(await tab.textContent("[data-testid=value-floors]"), /^30 default 24/);
      assert.equal(await tab.textContent("[data-testid=seed]"), "7");
      assert.equal((await tab.textContent("[data-testid=code]")).trimEnd(), readFileSync(script, "utf8").trimEnd());
      const at = await tab.evaluate(() => {
        const { low, high } = burgeon.facts.bounds;
        return burgeon.project(low.map((it, i) => (it + high[i]) / 2));
      });
      await tab.mouse.click(...at);
      await tab.waitForSelector("[data-testid=picked]:not([hidden])");
      assert.match(await tab.textContent("[data-testid=picked]"), /x .* z .* m/);
      if (process.env.SHOTS) await tab.screenshot({ path: join(process.env.SHOTS, `shared-${scheme}.png`) });
      await tab.keyboard.press("Escape");
      assert.ok(await tab.isHidden("[data-testid=picked]"));
      await tab.keyboard.press("l");
      assert.equal(await tab.evaluate(() => document.documentElement.dataset.theme), scheme === "dark" ? "light" : "dark");
    });
  }
});

test("texts with quotes, tags and emoji are shown as they are", async () => {
  const folder = mkdtempSync(join(made, "nasty-"));
  const script = join(folder, "a 'b' 🌱.lua");
  writeFileSync(script, NASTY);
  const path = page(script, "a 'b' & 🌱.html");
  await open(path, "light", async (tab) => {
    assert.equal((await tab.textContent("[data-testid=code]")).trimEnd(), NASTY.trimEnd());
    assert.equal(await tab.textContent("[data-testid=value-kind]"), "</script><b>🌱");
    assert.equal(await tab.textContent("[data-testid=file-name]"), "a 'b' 🌱.lua");
    assert.equal(await tab.textContent("[data-testid=script]"), "a 'b' & 🌱");
    const at = await tab.evaluate(() => burgeon.project([0, 0, 1.5]));
    await tab.mouse.click(...at);
    await tab.waitForSelector("[data-testid=picked]:not([hidden])");
    assert.equal(await tab.textContent("[data-testid=picked-name]"), 'a "b" </script> 🌱');
    const [saved] = await Promise.all([tab.waitForEvent("download"), tab.click("[data-testid=save-script]")]);
    assert.equal(readFileSync(await saved.path(), "utf8"), NASTY);
  });
});

test("a page without a recipe says so, and textures and instances are seen", async () => {
  const path = page(join(root, "scripts/house.lua"), "house.html", "--no-recipe");
  await open(path, "light", async (tab) => {
    assert.ok(await tab.isVisible("[data-testid=no-recipe]"));
    assert.ok(await tab.isHidden("[data-testid=recipe]"));
    if (process.env.SHOTS) await tab.screenshot({ path: join(process.env.SHOTS, "shared-house.png") });
  });
});
