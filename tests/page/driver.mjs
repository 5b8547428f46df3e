// Starts `burgeon live` and a browser, and asks both what they show.
//
// BURGEON names the binary (target/release/burgeon if it is not given), CHROMIUM the browser, and PLAYWRIGHT the folder
// whose node_modules has playwright-core.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { mkdtempSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";

const root = resolve(fileURLToPath(import.meta.url), "../../..");
const binary = process.env.BURGEON ?? join(root, "target/release/burgeon");
const require = createRequire(join(resolve(process.env.PLAYWRIGHT ?? root), "package.json"));
const { chromium } = require("playwright-core");

/** A tower of blocks with parameters of several kinds. */
export const BLOCKS = `local count = param("count", { default = 3, min = 1, max = 12, step = 1, doc = "Blocks of the tower" })
local color = param("color", { default = "#b0413e" })
local hollow = param("hollow", { default = false })
local style = param("style", { default = "plain", choices = { "plain", "fluted" } })
local Block, Slab = module("Block", "n"), module("Slab", "n")
local tower = lsystem({ object = extruder({ shape = { { -2, -2 }, { 2, -2 }, { 2, 2 }, { -2, 2 } }, smooth = false }) })
tower:axiom(Block(count))
tower:rule("Block(n)", function(this, n)
  if n == 0 then return nil end
  return Slab(n), Block(n - 1)
end)
tower:interpret("Slab(n)", function(this, n)
  this:color(color):caps(not hollow):scale(1 + n * 0.01):extrude(2)
end)
tower:derive()
`;

/** Folders to remove at the end. */
const folders = [];
process.on("exit", () => folders.forEach((made) => rmSync(made, { recursive: true, force: true })));

/** A folder for scripts. */
export const folder = () => {
  const made = mkdtempSync(join(tmpdir(), "burgeon page "));
  folders.push(made);
  return made;
};

// Tokens that are kept are not those of the person who runs this.
process.env.XDG_RUNTIME_DIR = folder();

/** Saves as editors do: writes beside the file and renames. */
export function save(path, text) {
  writeFileSync(`${path}~`, text);
  renameSync(`${path}~`, path);
}

/** A running server; `address` is where its page is. */
export class Server {
  static async start(script, ...flags) {
    const server = new Server();
    server.child = spawn(binary, ["live", script, "--json", "--no-open", ...flags], { stdio: ["ignore", "pipe", "pipe"] });
    server.said = "";
    server.child.stderr.on("data", (text) => (server.said += text));
    const lines = createInterface({ input: server.child.stdout });
    const [line] = await Promise.race([
      once(lines, "line"),
      once(server.child, "exit").then(() => Promise.reject(new Error(`the server ended: ${server.said}`))),
    ]);
    Object.assign(server, JSON.parse(line));
    return server;
  }

  /** Bytes of memory that it holds at present. */
  async memory() {
    const { readFile } = await import("node:fs/promises");
    const status = await readFile(`/proc/${this.child.pid}/status`, "utf8");
    return Number(/VmRSS:\s+(\d+)/.exec(status)[1]) * 1024;
  }

  async stop() {
    if (this.child.signalCode !== null) throw new Error(`the server ended by ${this.child.signalCode}: ${this.said}`);
    if (this.child.exitCode !== null) return;
    const gone = once(this.child, "exit");
    this.child.kill("SIGINT");
    await gone;
  }
}

/** A browser without a graphics card or a display. */
export const browse = (...flags) =>
  chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: [
      "--no-sandbox",
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      ...flags,
    ],
  });

/** What can be seen of a page by its `data-testid`. */
export const seen = (page, name) => page.locator(`[data-testid="${name}"]`);

/** Waits until a model has been drawn whose run is later than `after`; gives its run. */
export async function drawn(page, after = 0) {
  const run = await page.waitForFunction(
    (after) => {
      const run = Number(document.documentElement.dataset.run ?? 0);
      return run > after && run;
    },
    after,
    { timeout: 60_000 },
  );
  return run.jsonValue();
}

/** The run whose model is shown at present. */
export const run = (page) => page.evaluate(() => Number(document.documentElement.dataset.run ?? 0));

/** The number that a readout shows. */
export async function number(page, name) {
  return Number((await seen(page, name).first().textContent()).replace(/[^\d.]/g, ""));
}

/** The colours of the picture: rows of red, green, blue and opacity, one byte each. */
export async function pixels(page) {
  const png = await page.locator("canvas#view").screenshot();
  const text = await page.evaluate(async (text) => {
    const image = new Image();
    image.src = `data:image/png;base64,${text}`;
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [image.width, image.height];
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    // A list of numbers would take a machine that is busy many seconds.
    const parts = [];
    for (let at = 0; at < data.length; at += 32_768) parts.push(String.fromCharCode(...data.subarray(at, at + 32_768)));
    return btoa(parts.join(""));
  }, png.toString("base64"));
  return Buffer.from(text, "base64");
}

/** How many pixels differ clearly between two pictures of the same size. */
export function different(a, b) {
  let count = 0;
  for (let at = 0; at < a.length; at += 4) {
    const far = [0, 1, 2].some((channel) => Math.abs(a[at + channel] - b[at + channel]) > 24);
    if (far) count += 1;
  }
  return count;
}

/** Warnings that tell of a mistake in what is drawn; that pixels are waited for is none. */
const GRAPHICS = /^(?!.*GPU stall).*(WebGL|THREE|texSub|texImage)/;

/** Opens a script's page and hands everything to `act`; the console must stay free of errors, and of warnings about what is
 *  drawn. */
export async function show(browser, text, act, { flags = [], fails = false } = {}) {
  const script = join(folder(), "blocks.lua");
  if (text !== null) writeFileSync(script, text);
  const server = await Server.start(script, "--port", "0", ...flags);
  const context = await browser.newContext({ viewport: { width: 1000, height: 700 } });
  const page = await context.newPage();
  const complaints = [];
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("console", (message) => {
    const bad = message.type() === "error" || (message.type() === "warning" && GRAPHICS.test(message.text()));
    if (bad) complaints.push(message.text());
  });
  try {
    await page.goto(server.address);
    await act({ page, script, server, context, complaints });
    if (!fails) assert.deepEqual(complaints, []);
  } finally {
    await context.close();
    await server.stop();
  }
}
