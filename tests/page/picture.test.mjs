// The picture: surfaces, shadows, the ground and its labels.
//
//   node --test tests/page/picture.test.mjs

import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";

import { BLOCKS, browse, different, drawn, pixels, save, seen, show } from "./driver.mjs";

let browser;
before(async () => (browser = await browse()));
after(() => browser.close());

const open = (text, act, given) => show(browser, text, act, given);

/** What reaches as far below zero as above it. */
const PLANET = `local radius = param("radius", { default = 63710000, min = 1, max = 637100000, unit = "m" })
local Body = module("Body")
local planet = lsystem({ object = turtle({ width = 2402051 }) })
planet:axiom(Body())
planet:interpret("Body", function(this)
  this:pitch(180):forward(1200000 + radius * 0):pitch(180):forward(2402051)
end)
planet:derive()
`;

test("shading modes and themes are other pictures; the camera stays across saves", () =>
  open(BLOCKS, async ({ page, script }) => {
    const first = await drawn(page);
    const pictures = [];
    for (const mode of ["lit", "wire", "normals", "uv"]) {
      await seen(page, `mode-${mode}`).check({ force: true });
      await page.waitForTimeout(500);
      pictures.push(await pixels(page));
    }
    for (let a = 0; a < pictures.length; a += 1) {
      for (let b = a + 1; b < pictures.length; b += 1) {
        assert.ok(different(pictures[a], pictures[b]) > 1000, `modes ${a} and ${b}`);
      }
    }
    await seen(page, "mode-lit").check({ force: true });
    const box = await page.locator("canvas#view").boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 2 + 150, box.y + box.height / 2 + 20, { steps: 4 });
    await page.mouse.up();
    await page.waitForTimeout(400);
    const corner = () => page.evaluate(() => JSON.stringify(window.burgeon.project([2, 2, 0])));
    const where = await corner();
    save(script, BLOCKS.replace("default = 3", "default = 9"));
    await drawn(page, first);
    assert.equal(await corner(), where);
    const light = await pixels(page);
    await page.emulateMedia({ colorScheme: "dark" });
    await page.waitForTimeout(500);
    assert.ok(different(light, await pixels(page)) > 10_000);
  }));

test("a face has one shade though its corners belong to other faces too", () =>
  open(BLOCKS, async ({ page }) => {
    await drawn(page);
    const canvas = await page.locator("canvas#view").boundingBox();
    const places = [-1.5, 0, 1.5].flatMap((along) => [0.4, 1.6].map((height) => [along, height]));
    const faces = [([along, height]) => [along, -2.06, height], ([along, height]) => [2.06, along, height]];
    for (const [mode, most] of [["normals", 2], ["lit", 16]]) {
      await seen(page, `mode-${mode}`).check({ force: true });
      await page.waitForTimeout(700);
      const picture = await pixels(page);
      const shades = [];
      for (const face of faces) {
        const colors = [];
        for (const place of places) {
          const [x, y] = await page.evaluate((point) => window.burgeon.project(point), face(place));
          const at = (Math.floor(y - canvas.y) * Math.round(canvas.width) + Math.floor(x - canvas.x)) * 4;
          colors.push(picture.slice(at, at + 3));
        }
        for (const channel of [0, 1, 2]) {
          const values = colors.map((color) => color[channel]);
          assert.ok(Math.max(...values) - Math.min(...values) <= most, `${mode}: ${JSON.stringify(colors)}`);
        }
        shades.push(colors[0]);
      }
      assert.ok(shades[0].some((value, channel) => Math.abs(value - shades[1][channel]) > 24), `${mode}: ${shades}`);
    }
  }));

test("labels of the axes stand neither over the model nor over the picture's edge", () =>
  open(
    `local Part = module("Part")
local wall = lsystem({ object = extruder({ smooth = false }) })
wall:axiom(Part())
wall:interpret("Part", function(this)
  this:jump({ 0, 0, 0 }):color("#d02010"):rectangle(60, 6):extrude(4)
end)
wall:derive()
`,
    async ({ page }) => {
      await drawn(page);
      const box = await page.locator("canvas#view").boundingBox();
      const labels = () =>
        page.evaluate(() =>
          [...document.querySelectorAll("#ticks span")]
            .filter((it) => it.checkVisibility())
            .map((it) => it.getBoundingClientRect())
            .map(({ left, right, top, bottom }) => ({ left, right, top, bottom })),
        );
      let seenAtAll = 0;
      await page.keyboard.press("1");
      await page.waitForTimeout(400);
      for (let turn = 0; turn < 8; turn += 1) await page.keyboard.press("ArrowLeft");
      for (let turn = 0; turn < 4; turn += 1) await page.keyboard.press("ArrowUp");
      // At last one end of the wall is behind the camera.
      for (const steps of [0, 2, 4, 6, 2, 2]) {
        for (let step = 0; step < steps; step += 1) await page.keyboard.press("+");
        await page.waitForTimeout(600);
        const all = await labels();
        const picture = await pixels(page);
        seenAtAll += all.length;
        for (const { left, right, top, bottom } of all) {
          const where = `${steps}: ${[left, right, top, bottom].map(Math.round)}`;
          assert.ok(left >= box.x && right <= box.x + box.width && top >= box.y && bottom <= box.y + box.height, where);
          for (const x of [left, (left + right) / 2, right - 1]) {
            const at = (Math.floor((top + bottom) / 2 - box.y) * Math.round(box.width) + Math.floor(x - box.x)) * 4;
            const [red, green] = picture.subarray(at, at + 2);
            assert.ok(red < green * 2, `${where} stands over the wall`);
          }
        }
      }
      assert.ok(seenAtAll > 5, String(seenAtAll));
    },
  ));

test("a picture that has gone is not drawn any more, nor by shadows", () => {
  const walls = (texture) =>
    BLOCKS.replace("this:color(color)", texture ? `this:material({ texture = "${texture}", texture_size = { 1, 1 } })` : "this:color(color)");
  return open(BLOCKS, async ({ page, script }) => {
    let last = await drawn(page);
    const pictures = await page.evaluate(() =>
      ["#804020", "#208040"].map((color) => {
        const canvas = document.createElement("canvas");
        [canvas.width, canvas.height] = [64, 64];
        const context = canvas.getContext("2d");
        context.fillStyle = color;
        context.fillRect(0, 0, 64, 64);
        return canvas.toDataURL("image/jpeg").split(",")[1];
      }),
    );
    for (const [i, name] of ["a.jpg", "b.jpg"].entries()) writeFileSync(join(script, "..", name), Buffer.from(pictures[i], "base64"));
    // What throws the first shadows has a picture.
    save(script, walls("a.jpg"));
    await drawn(page, last);
    await page.reload();
    last = await drawn(page);
    for (const [more, texture] of ["b.jpg", null, null, "a.jpg", null, null].entries()) {
      save(script, walls(texture).replace("default = 3", `default = ${4 + more}`));
      last = await drawn(page, last);
      // The finer frame, which has shadows.
      await page.waitForTimeout(1000);
    }
  });
});

test("a normal map that leans up is lighter than one that leans down, and a flat one lies between", () => {
  const walls = (name) => BLOCKS.replace("this:color(color)", `this:material({ color = color, normal = "${name}.png" })`);
  return open(BLOCKS, async ({ page, script }) => {
    let last = await drawn(page);
    const maps = { up: [128, 218, 218], flat: [128, 128, 255], down: [128, 38, 218] };
    for (const [name, color] of Object.entries(maps)) {
      const url = await page.evaluate((color) => {
        const canvas = document.createElement("canvas");
        [canvas.width, canvas.height] = [16, 16];
        const context = canvas.getContext("2d");
        context.fillStyle = `rgb(${color})`;
        context.fillRect(0, 0, 16, 16);
        return canvas.toDataURL("image/png").split(",")[1];
      }, color);
      writeFileSync(join(script, "..", `${name}.png`), Buffer.from(url, "base64"));
    }
    const light = {};
    let before = null;
    for (const name of Object.keys(maps)) {
      save(script, walls(name));
      last = await drawn(page, last);
      // The finer frame, which has normal maps.
      await page.waitForTimeout(1000);
      const picture = await pixels(page);
      if (before) assert.ok(different(picture, before) > 2000, `${name}: ${different(picture, before)} pixels`);
      before = picture;
      light[name] = picture.reduce((sum, value) => sum + value, 0) / picture.length;
    }
    assert.ok(light.up > light.flat + 0.3 && light.flat > light.down + 0.3, JSON.stringify(light));
  });
});

test("a dirt map darkens the colour, also in the plain frames and on top of a texture", () => {
  const walls = (fields) => BLOCKS.replace("this:color(color)", `this:material({ color = "#ffffff", ${fields} })`);
  return open(BLOCKS, async ({ page, script }) => {
    let last = await drawn(page);
    for (const [name, color] of Object.entries({ light: "#e0e0e0", half: "#808080" })) {
      const url = await page.evaluate((color) => {
        const canvas = document.createElement("canvas");
        [canvas.width, canvas.height] = [16, 16];
        const context = canvas.getContext("2d");
        context.fillStyle = color;
        context.fillRect(0, 0, 16, 16);
        return canvas.toDataURL("image/png").split(",")[1];
      }, color);
      writeFileSync(join(script, "..", `${name}.png`), Buffer.from(url, "base64"));
    }
    const light = [];
    for (const fields of ['roughness = 0.8', 'dirt = "half.png"', 'texture = "light.png"', 'texture = "light.png", dirt = "half.png"']) {
      save(script, walls(fields));
      last = await drawn(page, last);
      await page.waitForTimeout(1000);
      const picture = await pixels(page);
      light.push(picture.reduce((sum, value) => sum + value, 0) / picture.length);
    }
    assert.ok(light[0] > light[1] + 0.3 && light[2] > light[3] + 0.3, JSON.stringify(light));
  });
});

test("a planet stands free, its size is in kilometres, and its radius is seen whole", () =>
  open(
    PLANET,
    async ({ page, script }) => {
      const first = await drawn(page);
      assert.match(await seen(page, "size").textContent(), /^[\d,.]+ × [\d,.]+ × [\d,.]+ km$/);
      assert.equal(await seen(page, "grid").getAttribute("aria-pressed"), "false");
      const [wide, inner] = await seen(page, "param-radius").evaluate((it) => [it.scrollWidth, it.clientWidth]);
      assert.ok(wide <= inner, `${wide} in ${inner}`);
      await seen(page, "grid").click();
      assert.equal(await seen(page, "grid").getAttribute("aria-pressed"), "true");
      await seen(page, "grid").click();
      await page.reload();
      await drawn(page);
      save(script, BLOCKS);
      await page.waitForFunction(() => / m$/.test(document.querySelector("[data-testid=size]").textContent));
      assert.equal(await seen(page, "grid").getAttribute("aria-pressed"), "true");
      assert.ok(first > 0);
    },
  ));

test("a slab with a base below zero has a ground, and what is a body or far from zero has none", () => {
  const block = (low, wide, tall) => `local Part = module("Part")
local block = lsystem({ object = extruder({ smooth = false }) })
block:axiom(Part())
block:interpret("Part", function(this)
  this:jump({ 0, 0, ${low} }):rectangle(${wide}, ${wide}):extrude(${tall})
end)
block:derive()
`;
  const blocks = [
    [0, 4, 6, true],
    [3, 6, 4, true],
    [-23.5, 660, 69, true],
    [-5, 100, 5, true],
    [-30, 10, 140, true],
    [-1, 2, 2, false],
    [100, 3, 4, false],
    [1_198_000, 151_000, 3000, false],
    [500_000, 2_000_000, 700_000, false],
  ];
  return open(block(...blocks[0]), async ({ page, script }) => {
    let last = await drawn(page);
    for (const [low, wide, tall, stands] of blocks) {
      save(script, `${block(low, wide, tall)}-- ${low}`);
      last = await drawn(page, last);
      assert.equal(await seen(page, "grid").getAttribute("aria-pressed"), String(stands), `${wide} x ${tall} m at ${low} m`);
    }
  });
});
