// X3D files in x3dom: every shape is there, nothing is unknown to it, and something is seen.
//
//   node --test tests/page/x3d.test.mjs
//
// PLAYWRIGHT names the folder whose node_modules has playwright-core and x3dom; X3D a folder of .x3d files to look at
// in place of those that the scripts make, and SHOTS one for pictures of them.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { basename, dirname, join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";

import { browse, folder } from "./driver.mjs";

const root = resolve(fileURLToPath(import.meta.url), "../../..");
const burgeon = process.env.BURGEON ?? join(root, "target/release/burgeon");
const require = createRequire(join(resolve(process.env.PLAYWRIGHT ?? root), "package.json"));
const x3dom = readFileSync(join(dirname(require.resolve("x3dom/package.json")), "x3dom.js"));

/**
 * Scripts with models that are placed, with textures, and with features of data. Of the town only the middle:
 * the whole of it has 47,000 shapes, and without a graphics card the browser needs minutes for them.
 */
const SCRIPTS = [
  ["scripts/tower.lua"],
  ["scripts/herb.lua"],
  ["scripts/town.lua", "--set", "radius=50"],
  ["examples/village.lua"],
];

function written() {
  const given = process.env.X3D;
  if (given) return readdirSync(given).filter((name) => name.endsWith(".x3d")).map((name) => join(given, name));
  const made = folder();
  return SCRIPTS.map(([script, ...settings]) => {
    const path = join(made, `${basename(script, ".lua")}.x3d`);
    const data = join(root, "examples/data");
    execFileSync(burgeon, ["run", join(root, script), "--data", data, "-o", path, ...settings], { stdio: "pipe" });
    return path;
  });
}

const PAGE = (name) => `<!DOCTYPE html><html><head><meta charset="utf-8"><script src="/x3dom.js"></script></head>
<body style="margin:0;background:#9ab"><x3d id="view" width="800px" height="600px" showLog="false"><scene>
<inline nameSpaceName="model" mapDEFToID="true" url="/files/${encodeURIComponent(name)}" onload="window.loaded = true"></inline>
</scene></x3d></body></html>`;

let browser, server, address;
const paths = written();
before(async () => {
  browser = await browse("--use-gl=angle", "--ignore-gpu-blocklist");
  server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url, "http://localhost").pathname);
    const file = () => readFileSync(join(dirname(paths[0]), basename(path)));
    try {
      const [type, body] =
        path === "/x3dom.js"
          ? ["text/javascript", x3dom]
          : path.startsWith("/files/")
            ? [path.endsWith(".x3d") ? "model/x3d+xml" : path.endsWith(".png") ? "image/png" : "image/jpeg", file()]
            : path === "/favicon.ico"
              ? ["image/png", ""]
              : ["text/html", PAGE(path.slice(1))];
      response.writeHead(200, { "content-type": type }).end(body);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  address = `http://127.0.0.1:${server.address().port}`;
});
after(async () => {
  await browser.close();
  server.close();
});

/** How many shapes a file shows, those of prototypes and of what is used as often as they are seen. */
const expected = (text) => {
  const document = new DOMParser().parseFromString(text, "application/xml");
  if (document.querySelector("parsererror")) throw new Error("it is no XML");
  const named = new Map([...document.querySelectorAll("[DEF]")].map((node) => [node.getAttribute("DEF"), node]));
  const kinds = [...document.querySelectorAll("ProtoDeclare")];
  const prototypes = new Map(kinds.map((node) => [node.getAttribute("name"), node.querySelector("ProtoBody")]));
  const shapes = (node) => {
    const inside = (node) => [...node.children].reduce((sum, child) => sum + shapes(child), 0);
    if (node.tagName === "ProtoDeclare") return 0;
    if (node.tagName === "ProtoInstance") return inside(prototypes.get(node.getAttribute("name")));
    if (node.getAttribute("USE")) return shapes(named.get(node.getAttribute("USE")));
    return node.tagName === "Shape" ? 1 : inside(node);
  };
  return shapes(document.querySelector("Scene"));
};

/** How many shapes x3dom has in its scene. */
const shown = () => {
  const count = (node) =>
    (window.x3dom.isa(node, window.x3dom.nodeTypes.X3DShapeNode) ? 1 : 0) +
    (node._childNodes ?? []).reduce((sum, child) => sum + (child ? count(child) : 0), 0);
  return count(document.getElementById("view").runtime.canvas.doc._scene);
};

for (const path of paths) {
  test(`${basename(path)} is shown whole`, async () => {
    const page = await browser.newPage({ viewport: { width: 800, height: 600 } });
    const said = [];
    page.on("console", (message) => said.push(message.text()));
    page.on("pageerror", (error) => said.push(`Error: ${error}`));
    try {
      await page.goto(`${address}/${encodeURIComponent(basename(path))}`);
      const shapes = await page.evaluate(expected, readFileSync(path, "utf8"));
      await page.waitForFunction(() => window.loaded, null, { timeout: 120_000 });
      await page.waitForFunction(([count, shapes]) => eval(`(${count})`)() === shapes, [String(shown), shapes], { timeout: 60_000 });
      await page.evaluate(() => document.getElementById("view").runtime.showAll("negZ"));
      await page.waitForTimeout(1500);
      const picture = await page.screenshot();
      if (process.env.SHOTS) (await import("node:fs")).writeFileSync(join(process.env.SHOTS, `${basename(path)}.png`), picture);
      const bad = said.filter((text) => /unrecognised|error|unknown|invalid|not found/i.test(text));
      assert.deepEqual(bad, []);
      // A plain ground compresses to far less.
      if (shapes > 0) assert.ok(picture.length > 4000, `${picture.length} bytes of picture`);
      console.log(`${basename(path)}: ${shapes} shapes`);
    } catch (error) {
      error.message += `\n${said.slice(0, 20).join("\n")}`;
      throw error;
    } finally {
      await page.close();
    }
  });
}
