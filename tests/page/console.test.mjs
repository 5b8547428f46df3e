// The console of the live page, and the carets in the script pane, in a real browser.
//
//   node --test tests/page/console.test.mjs

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { BLOCKS, browse, drawn, save, seen, show } from "./driver.mjs";

let browser;
before(async () => (browser = await browse()));
after(() => browser.close());

const open = (text, act, given) => show(browser, text, act, given);

/** Opens the console by its key. */
async function openConsole(page) {
  await page.locator("canvas#view").focus();
  await page.keyboard.press("k");
  await seen(page, "console").waitFor({ state: "visible" });
}

test("prints and warnings stand in the console with their lines, and a line opens in the script", () =>
  open(`${BLOCKS}print("hello", { 1, 2, a = "b" }, Block)\nfor i = 1, 3 do print("again") end\nwarn("no streets", "try another seed")\n`, async ({ page }) => {
    await drawn(page);
    assert.match(await seen(page, "console-toggle").textContent(), /^1 warning, 4 prints$/);
    await openConsole(page);
    const prints = seen(page, "console-print");
    assert.equal(await prints.count(), 2);
    assert.match(await prints.first().textContent(), /hello\t\{ 1, 2, a = "b" \}\tmodule Block\(n\)/);
    assert.match(await prints.nth(1).textContent(), /again× 3blocks\.lua:17/);
    assert.match(await seen(page, "console-warning").textContent(), /no streets\ntry another seed.*blocks\.lua:18/s);
    await prints.nth(1).getByRole("button").click();
    const line = page.locator("#pane-code .cm-activeLine");
    await line.waitFor();
    assert.match(await line.textContent(), /print\("again"\)/);
    // Another line of the same file is gone to without a new read.
    await prints.first().getByRole("button").click();
    await page.waitForFunction(() => /hello/.test(document.querySelector("#pane-code").shadowRoot.querySelector(".cm-activeLine")?.textContent));
  }));

test("the filter leaves what has its words, and clear empties the console until the next run", () =>
  open(`${BLOCKS}print("red one")\nprint("blue two")\nwarn("red three")\n`, async ({ page, script }) => {
    const first = await drawn(page);
    await openConsole(page);
    await seen(page, "console-filter").fill("RED");
    assert.equal(await seen(page, "console-print").count(), 1);
    assert.match(await seen(page, "console-list").textContent(), /1 hidden by the filter/);
    await seen(page, "console-prints").uncheck();
    assert.equal(await seen(page, "console-print").count(), 0);
    assert.equal(await seen(page, "console-warning").count(), 1);
    await seen(page, "console-prints").check();
    await seen(page, "console-filter").fill("");
    await seen(page, "console-clear").click();
    assert.equal(await seen(page, "console-print").count(), 0);
    assert.equal(await seen(page, "console-toggle").textContent(), "Console");
    save(script, `${BLOCKS}print("green")\n`);
    await drawn(page, first);
    await seen(page, "console-print").waitFor();
    assert.match(await seen(page, "console-print").textContent(), /green/);
    await seen(page, "console-filter").focus();
    await page.keyboard.press("Escape");
    await seen(page, "console").waitFor({ state: "hidden" });
  }));

test("of very many prints the first and the last come, with the number of the others", () =>
  open(`for i = 1, 200000 do print("number", i) end\n${BLOCKS}`, async ({ page, server }) => {
    await drawn(page);
    await openConsole(page);
    assert.equal(await seen(page, "console-print").count(), 500);
    assert.match(await seen(page, "console-left-out").textContent(), /^199,500 prints left out/);
    assert.match(await seen(page, "console-print").first().textContent(), /number\t1blocks\.lua:1/);
    assert.match(await seen(page, "console-print").last().textContent(), /number\t200000/);
    assert.match(server.said, /number\t200000\n/, "the terminal has all of them");
    // A page that comes later sees them too.
    await page.reload();
    await drawn(page);
    assert.match(await seen(page, "console-toggle").textContent(), /^200,000 prints$/);
  }));

test("what is printed is text, and no markup or control character acts", () =>
  open(`print("<img src=x onerror=alert(1)>\\27[31m", ("x"):rep(5000), "\\xff")\n${BLOCKS}`, async ({ page }) => {
    await drawn(page);
    await openConsole(page);
    const text = await seen(page, "console-print").textContent();
    assert.match(text, /<img src=x onerror=alert\(1\)>/);
    assert.match(text, /… \(\d+ bytes more\)/);
    assert.equal(await seen(page, "console-print").locator("img").count(), 0);
  }));

test("prints of a run that fails come with its error", () =>
  open(BLOCKS.replace("if n == 0", "print('at', n) if n == 1 then error('too low') end if n == 0"), async ({ page }) => {
    await seen(page, "error").waitFor();
    await openConsole(page);
    assert.match(await seen(page, "console-print").first().textContent(), /at\t3blocks\.lua:9/);
    assert.match(await seen(page, "console-error").textContent(), /too low.*blocks\.lua:9/s);
    assert.match(await seen(page, "console-toggle").textContent(), /^1 error, 3 prints$/);
  }));

test("an error has carets under its part of the line in the script pane, which go with the first edit of the line", () =>
  open(BLOCKS, async ({ page, script }) => {
    await drawn(page);
    await seen(page, "edit").click();
    await page.locator("#pane-code .cm-content").waitFor();
    save(script, BLOCKS.replace("Slab(n), Block(n - 1)", "Slabb(n), Block(n - 1)"));
    const carets = page.locator("#pane-code .carets");
    await carets.waitFor();
    // The pane shows the saved text a moment before or after the error.
    await page.locator("#pane-code .cm-line", { hasText: "Slabb" }).waitFor();
    assert.match(await carets.textContent(), /^ +\^{5} .*Slabb/);
    const [own, code] = await page.evaluate(() => {
      const root = document.querySelector("#pane-code").shadowRoot;
      const left = (element, text) => {
        const walker = document.createTreeWalker(element, NodeFilter.SHOW_TEXT);
        for (let node = walker.nextNode(); node; node = walker.nextNode()) {
          const at = node.data.indexOf(text);
          if (at < 0) continue;
          const range = document.createRange();
          range.setStart(node, at);
          range.setEnd(node, at + 1);
          return range.getBoundingClientRect().left;
        }
        return NaN;
      };
      const line = [...root.querySelectorAll(".cm-line")].find((it) => it.textContent.includes("Slabb"));
      return [left(root.querySelector(".carets"), "^"), left(line, "Slabb")];
    });
    assert.ok(Math.abs(own - code) < 1.5, `carets at ${own}, the name at ${code}`);
    await page.locator("#pane-code .cm-line", { hasText: "Slabb" }).click();
    await page.keyboard.press("End");
    await page.keyboard.type(" ");
    await carets.waitFor({ state: "detached" });
  }));
