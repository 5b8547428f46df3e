// From a save to the picture: the median of many saves, of a model below 100,000 triangles, and of one of a million.
//
//   cargo build --release && node benches/page.mjs [SAVES] [pane]
//
// The clock starts before the file is written and stops when the page has drawn the new model. The server's part, from
// the file's event to the model's bytes, is what the page is told. The last table is about saves in the editor of the page:
// least and median of the whole and of its parts. `write` is the time until the page is told that the file is written,
// `server` that from the file's event to the model's bytes, and `rest` the write before that, the messages and waits of the page.

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

import { Server, browse, drawn, folder } from "../tests/page/driver.mjs";

const saves = Number(process.argv[2] ?? 21);
const tower = readFileSync(fileURLToPath(new URL("../scripts/tower.lua", import.meta.url)), "utf8");

// One cylinder of many segments.
const million = `local A = module("A", "n")
local s = lsystem({ object = turtle({ sides = 10 }) })
s:axiom(A(50000))
s:interpret("A(n)", function(this, n)
  for i = 1, n do
    this:turn(0.5):forward(0.1)
  end
end)
s:derive(0)
`;

const median = (times) => times.toSorted((a, b) => a - b)[Math.floor(times.length / 2)];

async function measure(name, text, flags) {
  const path = join(folder(), "script.lua");
  writeFileSync(path, text);
  const server = await Server.start(path, "--port", "0", ...flags);
  const browser = await browse();
  try {
    const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
    await page.goto(server.address);
    let run = await drawn(page);
    await page.evaluate(() => {
      window.drawnAt = {};
      window.addEventListener("burgeon:drawn", (event) => (window.drawnAt[event.detail.run] = Date.now()));
    });
    const whole = [];
    const parts = { script: [], rewriting: [], interpretation: [], scene: [], encode: [], total: [] };
    let triangles = 0;
    for (let save = 0; save < saves; save += 1) {
      await new Promise((done) => setTimeout(done, 1200));
      const begin = Date.now();
      writeFileSync(path, `${text}-- ${save}\n`);
      run = await drawn(page, run);
      whole.push((await page.evaluate((run) => window.drawnAt[run], run)) - begin);
      const model = await page.evaluate(() => window.burgeon.model);
      triangles = model.triangles;
      for (const part of Object.keys(parts)) parts[part].push(model.times[part]);
    }
    const shown = Object.entries(parts).map(([part, times]) => `${part} ${median(times).toFixed(1)}`);
    console.log(`| ${name} | ${triangles} | ${median(whole).toFixed(0)} ms | ${shown.at(-1).replace("total ", "")} ms | ${shown.slice(0, -1).join(", ")} |`);
  } finally {
    await browser.close();
    await server.stop();
  }
}

// From Ctrl+S in the page's editor to the picture, by the clock of the page, and where the time goes.
async function measurePane(name, text) {
  const path = join(folder(), "script.lua");
  writeFileSync(path, text);
  const server = await Server.start(path, "--port", "0");
  const browser = await browse();
  try {
    const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
    await page.goto(server.address);
    let run = await drawn(page);
    await page.evaluate(() => {
      window.paneSaves = {};
      let [begin, written] = [0, 0];
      addEventListener("keydown", (event) => event.ctrlKey && event.key === "s" && (begin = performance.now()), true);
      addEventListener("burgeon:written", () => (written = performance.now()));
      addEventListener("burgeon:drawn", ({ detail }) => {
        window.paneSaves[detail.run] = { ...detail, whole: performance.now() - begin, write: written - begin };
      });
    });
    await page.locator('[data-testid="edit"]').click();
    await page.locator("#pane-code .cm-line").first().click();
    await page.keyboard.press("End");
    const parts = { whole: [], write: [], server: [], load: [], draw: [], rest: [] };
    for (let save = 0; save < saves; save += 1) {
      await page.keyboard.type(` ${save % 10}`);
      await new Promise((done) => setTimeout(done, 1200));
      await page.keyboard.press("Control+s");
      run = await drawn(page, run);
      const [took, model] = await page.evaluate((run) => [window.paneSaves[run], window.burgeon.model], run);
      const found = { write: took.write, server: model.times.total, load: took.load, draw: took.draw };
      // The server counts from the first sign of the write, so `write` is not a summand.
      const rest = took.whole - found.server - found.load - found.draw;
      for (const [part, time] of Object.entries({ whole: took.whole, ...found, rest })) parts[part].push(time);
    }
    console.log(`\n| ${name}, from Ctrl+S in the editor of the page | ${Object.keys(parts).join(" | ")} |`);
    console.log(`| --- |${" --- |".repeat(Object.keys(parts).length)}`);
    for (const [title, of] of [
      ["least (ms)", (times) => Math.min(...times)],
      ["median (ms)", median],
    ])
      console.log(`| ${title} | ${Object.values(parts).map((times) => of(times).toFixed(1)).join(" | ")} |`);
  } finally {
    await browser.close();
    await server.stop();
  }
}

if (process.argv[3] !== "pane") {
  console.log("| script | triangles | save to picture | save to bytes | of that (ms) |");
  console.log("| --- | --- | --- | --- | --- |");
  await measure("tower.lua", tower, []);
  await measure("tower.lua with finer pillars", tower, ["--set", "detail=2", "--set", "floors=18"]);
  await measure("a bent tube", million, []);
}
await measurePane("tower.lua", tower);
