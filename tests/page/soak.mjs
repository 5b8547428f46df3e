// Saves a script hundreds of times at random moments, some of them broken, and looks at what is left:
//
//   node tests/page/soak.mjs [SAVES]
//
// At the end the page must show the last script's model, and the server and the page must not have grown.

import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";

import { Server, browse, drawn, folder, number, save, seen } from "./driver.mjs";

const saves = Number(process.argv[2] ?? 500);
const WARM = Math.min(100, Math.floor(saves / 4));
/// Number of saves between two samples of the memory, and number of samples at each end that are compared.
const EACH = Math.max(1, Math.floor(saves / 25));
const SAMPLES = 6;
const median = (numbers) => numbers.toSorted((a, b) => a - b)[Math.floor(numbers.length / 2)];

// A small linear congruential generator, so that every soak is the same.
let state = 20_261_121;
const random = (below) => {
  state = (state * 1_103_515_245 + 12_345) % 2_147_483_648;
  return Math.floor((state / 2_147_483_648) * below);
};

const script = (count) => `local Block, Slab = module("Block", "n"), module("Slab")
local tower = lsystem({ object = extruder({ sides = 64, smooth = false }) })
tower:axiom(Block(${count}))
tower:rule("Block(n)", function(this, n)
  if n == 0 then return nil end
  return Slab(), Block(n - 1)
end)
tower:interpret("Slab", function(this)
  this:scale(1):extrude(1):roll(3)
end)
tower:derive()
`;
const TRIANGLES = 4 * 64 - 4;
const wrong = ["syntax error here", script(3).replace("Slab()", "Slab(1)"), script(3).slice(0, 120), "", script(3).replace("n - 1", "nil")];

const path = join(folder(), "soak.lua");
writeFileSync(path, script(3));
const server = await Server.start(path, "--port", "0");
const browser = await browse();
try {
  const page = await browser.newPage({ viewport: { width: 500, height: 400 } });
  const complaints = [];
  page.on("pageerror", (error) => complaints.push(String(error)));
  await page.goto(server.address);
  await drawn(page);
  const settled = async (count) => {
    save(path, script(count));
    const shown = (wanted) => Number(document.querySelector("[data-testid=triangles]").textContent.replace(/\D/g, "")) === wanted;
    await page.waitForFunction(shown, count * TRIANGLES, { timeout: 30_000 });
    await seen(page, "error").waitFor({ state: "hidden" });
    await page.waitForFunction(() => document.querySelector("[data-testid=working]")?.checkVisibility() !== true);
  };
  await settled(7);
  // Memory varies by a tenth from moment to moment, as the allocator returns pages, so the medians of several moments count.
  const samples = [];
  for (let index = 1; index <= saves; index += 1) {
    const broken = random(4) === 0;
    const text = broken ? wrong[random(wrong.length)] : script(1 + random(40));
    if (random(3) === 0) writeFileSync(path, text);
    else save(path, text);
    await new Promise((done) => setTimeout(done, random(160)));
    if (index >= WARM && (index - WARM) % EACH === 0) {
      await settled(7);
      samples.push(await server.memory());
    }
    if (index % 100 === 0) console.log(`${index} saves, the server holds ${((await server.memory()) / 1e6).toFixed(1)} MB`);
  }
  await settled(7);
  samples.push(await server.memory());
  const growth = median(samples.slice(-SAMPLES)) / median(samples.slice(0, SAMPLES)) - 1;
  assert.equal(await number(page, "triangles"), 7 * TRIANGLES);
  assert.deepEqual(complaints, []);
  const held = await page.evaluate(() => window.burgeon.memory);
  console.log(`the page holds ${JSON.stringify(held)}`);
  console.log(`after ${saves} saves the server's memory has grown by ${(growth * 100).toFixed(1)} %`);
  assert.ok(growth < 0.1, "the server's memory must not grow by a tenth");
} finally {
  await browser.close();
  await server.stop();
}
