// The page of a tileset in a real browser: the first view, picking, what is missing, progress, and joining again.
//
//   node --test tests/page/tileset.test.mjs

import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { cpSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";

import { BLOCKS, Server, browse, different, drawn, folder, pixels, seen, show } from "./driver.mjs";

const root = resolve(fileURLToPath(import.meta.url), "../../..");
const binary = process.env.BURGEON ?? join(root, "target/release/burgeon");
const quarter = JSON.parse(readFileSync(join(root, "examples/data/quarter/buildings.geojson"), "utf8"));

const HOUSES = `local Walls, Roof = module("Walls", "height"), module("Roof", "height")
local houses = lsystem({ object = footprint })
houses:axiom(source("buildings.geojson"), function(feature)
  if feature.name == "b12" then error("houses of this kind are not supported") end
  return footprint(feature.geometry), Walls(3 * feature.floors)
end)
houses:rule("Walls(height)", function(this, height) return Walls(height), Roof(random(1, 3)) end)
houses:interpret("Walls(height)", function(this, height) this:walls({ height = height, color = "#d8c7a8" }) end)
houses:interpret("Roof(height)", function(this, height) this:roof({ kind = "hip", height = height, color = "#8a4b3a" }) end)
houses:derive(1)
`;

let browser, made, open, place;

const name = ({ level, x, y }) => `${level}/${x}/${y}`;

/** Runs `burgeon tiles`, where a failed tile is no failure of the test. */
function tiles(...flags) {
  const { status, stderr } = spawnSync(binary, ["tiles", ...flags], { cwd: place, encoding: "utf8" });
  assert.ok(status === 0 || status === 1, stderr);
}

before(async () => {
  browser = await browse();
  place = folder();
  writeFileSync(join(place, "houses.lua"), HOUSES);
  tiles("plan", "houses.lua", "--data", join(root, "examples/data/quarter"), "-o", "out", "--metadata", "*",
    "--geoid-height", "49.5", "--target-features", "12");
  tiles("make", "out");
  const { tiles: planned } = JSON.parse(readFileSync(join(place, "out/plan.json"), "utf8"));
  // The manifests, by level, column and row.
  const manifests = new Map(
    readdirSync(join(place, "out/tiles"), { recursive: true })
      .filter((path) => path.endsWith(".json"))
      .map((path) => [JSON.parse(readFileSync(join(place, "out/tiles", path), "utf8")), path])
      .map(([manifest, path]) => [name(manifest.tile), { manifest, path: path.slice(0, -5) }]),
  );
  const good = planned.filter((tile) => !manifests.get(name(tile)).manifest.error);
  made = good.map(({ features }) => features);
  // The largest good tile is made again later.
  open = good.reduce((a, b) => (b.features > a.features ? b : a));
  for (const extension of ["glb", "json"]) rmSync(join(place, `out/tiles/${manifests.get(name(open)).path}.${extension}`));
  tiles("join", "out");
});
after(() => browser.close());

/** Opens the page of a copy of the tileset; the console must stay free of errors. */
async function visit(act, context = {}) {
  const copy = join(folder(), "houses of a quarter");
  cpSync(join(place, "out"), copy, { recursive: true });
  const server = await Server.start(copy, "--port", "0");
  const visitor = await browser.newContext({ viewport: { width: 1100, height: 750 }, ...context });
  const page = await visitor.newPage();
  const [complaints, asked] = [[], []];
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("console", (message) => message.type() === "error" && complaints.push(message.text()));
  page.on("request", (request) => asked.push(request.url()));
  try {
    await page.goto(server.address);
    await settled(page);
    await act({ page, server, copy, asked });
    assert.deepEqual(complaints, []);
  } finally {
    await visitor.close();
    await server.stop();
  }
}

/** Waits until all tiles of the present view are shown, of a revision other than `old`. */
async function settled(page, old = null) {
  await page.waitForFunction((old) => {
    const { settled } = document.documentElement.dataset;
    return settled && settled !== old && !window.burgeon.counts.loading;
  }, old, { timeout: 60_000 });
}

const counts = (page) => page.evaluate(() => window.burgeon.counts);
const number = async (page, name) => Number((await seen(page, name).textContent()).replace(/\D/g, ""));

/** The middle of a feature's corners: longitude and latitude (degrees). */
function middle({ geometry }) {
  const ring = geometry.coordinates[0].slice(1);
  return [0, 1].map((axis) => ring.reduce((sum, point) => sum + point[axis], 0) / ring.length);
}

/** The pixel of a place, `height` (m) above the ellipsoid. */
const pixel = (page, [longitude, latitude], height) =>
  page.evaluate(([x, y, z]) => window.burgeon.project(x, y, z), [longitude, latitude, height]);

/** Flies until the camera rests. */
async function rests(page) {
  let last = "";
  for (let i = 0; i < 100; i += 1) {
    const now = JSON.stringify(await page.evaluate(() => window.burgeon.camera));
    if (now === last) return;
    last = now;
    await page.waitForTimeout(300);
  }
  assert.fail("the camera does not rest");
}

test("all tiles are shown at first, with the north at the top and nothing cut off", () =>
  visit(async ({ page, asked }) => {
    const { shown, of, failed } = await counts(page);
    assert.equal(of, made.length - 1);
    assert.deepEqual([shown, failed], [of, 0]);
    assert.equal(await number(page, "fact-tiles"), of);
    const { x, y, width, height } = await page.locator("canvas#view").boundingBox();
    for (const feature of quarter.features) {
      const [left, top] = await pixel(page, middle(feature), 49.5);
      assert.ok(left > x && left < x + width && top > y && top < y + height, `${feature.id}`);
    }
    const [, north] = await pixel(page, [5.724, 45.1865], 49.5);
    const [west, south] = await pixel(page, [5.723, 45.1855], 49.5);
    const [east] = await pixel(page, [5.725, 45.1855], 49.5);
    assert.ok(north < south && west < east);
    assert.equal(asked.some((url) => url.endsWith("viewer.js")), false);
  }));

test("a picked feature shows its id and its attributes", () =>
  visit(async ({ page }) => {
    await page.keyboard.press("5");
    await rests(page);
    await settled(page);
    const areas = quarter.features.filter(({ properties }) => properties.name !== "b12");
    let found = 0;
    for (const feature of areas.slice(0, 12)) {
      const at = await pixel(page, middle(feature), 49.5 + 3 * feature.properties.floors);
      await page.mouse.click(...at);
      const card = seen(page, "picked");
      if (!(await card.isVisible()) || (await card.evaluate((it) => it.classList.contains("missing")))) continue;
      const id = await seen(page, "feature-id").textContent();
      // A court has nothing in its middle, and a feature of the tile that was not made is missing.
      if (id !== String(feature.id)) continue;
      const text = await card.textContent();
      assert.ok(text.includes(feature.properties.name) && text.includes(`floors${feature.properties.floors}`), text);
      found += 1;
    }
    assert.ok(found >= 4, `${found} features`);
    await page.keyboard.press("Escape");
    assert.equal(await seen(page, "picked").isVisible(), false);
  }));

test("what is missing is marked, listed with its cause, and flown to", () =>
  visit(async ({ page, copy }) => {
    const rows = readFileSync(join(copy, "missing.csv"), "utf8").trim().split("\n").slice(1);
    const total = rows.reduce((sum, row) => sum + Number(row.split(",")[2]), 0);
    assert.ok(total > open.features);
    assert.equal(await number(page, "missing-count"), total);
    const causes = await seen(page, "cause").locator("summary").allTextContents();
    assert.equal(causes.length, 2);
    assert.ok(causes.some((text) => text.includes("houses of this kind are not supported")), causes.join());
    assert.ok(causes.some((text) => text.includes("has not been made")), causes.join());
    for (const cause of await seen(page, "cause").all())
      if (!(await cause.evaluate((it) => it.open))) await cause.locator("summary").click();
    const before = await page.evaluate(() => window.burgeon.camera.distance);
    await seen(page, "missing-item").filter({ hasText: /^1?\d$/ }).first().click();
    assert.match(await seen(page, "cause-text").textContent(), /not supported/);
    await rests(page);
    assert.ok((await page.evaluate(() => window.burgeon.camera.distance)) <= before);
    const { x, y, width, height } = await page.locator("canvas#view").boundingBox();
    await page.keyboard.press("Escape");
    await page.mouse.click(x + width / 2, y + height / 2);
    assert.match(await seen(page, "cause-text").textContent(), /not supported/);
  }));

test("the progress is told, and a tileset that is joined again is shown in the same view", () =>
  visit(async ({ page, copy }) => {
    const failed = 1;
    const text = () => seen(page, "making-text").textContent();
    assert.match(await text(), new RegExp(`^${made.length - 1} of ${made.length + failed} tiles made · 1 failed`));
    await page.keyboard.press("ArrowLeft");
    await rests(page);
    const [before, camera] = await page.evaluate(() => [window.burgeon.revision, window.burgeon.camera]);
    rmSync(join(place, "again"), { recursive: true, force: true });
    // The plan names its script relative to its own folder.
    cpSync(copy, join(place, "again"), { recursive: true });
    tiles("make", "again");
    cpSync(join(place, "again"), copy, { recursive: true });
    tiles("join", copy);
    await settled(page, before);
    assert.equal((await counts(page)).of, made.length);
    assert.deepEqual(await page.evaluate(() => window.burgeon.camera), camera);
    await page.waitForFunction(() => /^\d+ tiles made · 1 failed$/.test(document.querySelector("#making-text").textContent));
    await page.waitForFunction(
      (open) => document.querySelectorAll("[data-testid=cause]").length === 1,
      open.features,
    );
  }));

test("the tileset and the panel fit into a narrow page in both themes", async () => {
  const pictures = [];
  for (const colorScheme of ["light", "dark"])
    await visit(
      async ({ page }) => {
        await page.waitForTimeout(1500);
        pictures.push(await pixels(page));
        await page.locator("canvas#view").evaluate((canvas) => (canvas.style.opacity = "0"));
        const empty = await pixels(page);
        await page.locator("canvas#view").evaluate((canvas) => (canvas.style.opacity = ""));
        assert.ok(different(pictures.at(-1), empty) > 2000, colorScheme);
        for (const name of ["making", "missing", "fact-tiles"]) {
          const box = await seen(page, name).boundingBox();
          assert.ok(box.x >= 0 && box.x + box.width <= 390, `${name} ${JSON.stringify(box)}`);
        }
      },
      { viewport: { width: 390, height: 760 }, colorScheme },
    );
  assert.ok(different(...pictures) > 10_000);
});

test("the page of a script does not load the renderer of tilesets", () =>
  show(browser, BLOCKS, async ({ page, server }) => {
    await drawn(page);
    const loaded = await page.evaluate(() => performance.getEntriesByType("resource").map(({ name }) => name));
    assert.ok(loaded.some((name) => name.endsWith("viewer.js")), loaded.join());
    assert.equal(loaded.some((name) => name.includes("tileset")), false);
    assert.equal((await fetch(`${server.address}tileset.js`)).status, 404);
  }));

test("a folder without a tileset is refused with the remedy", () => {
  const empty = folder();
  const refused = (path) => {
    try {
      execFileSync(binary, ["live", path, "--no-open", "--port", "0"], { encoding: "utf8", stdio: "pipe" });
    } catch ({ status, stderr }) {
      assert.equal(status, 1);
      return stderr;
    }
    return assert.fail("it is served");
  };
  assert.match(refused(empty), /no tileset in this folder[^]*burgeon tiles plan/);
  cpSync(join(place, "out/plan.json"), join(empty, "plan.json"));
  assert.match(refused(empty), /burgeon tiles join /);
});
