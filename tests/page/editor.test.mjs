// The pane with the script on the live page, in a real browser.
//
//   node --test tests/page/editor.test.mjs

import assert from "node:assert/strict";
import { chmodSync, readFileSync, statSync } from "node:fs";
import { after, before, test } from "node:test";

import { BLOCKS, browse, drawn, number, save, seen, show } from "./driver.mjs";

let browser;
before(async () => (browser = await browse()));
after(() => browser.close());

/** Opens a script's page with the pane, and hands over its lines and its text. */
const open = (text, act) =>
  show(browser, text, async (given) => {
    const { page } = given;
    const run = await drawn(page);
    await seen(page, "edit").click();
    const content = page.locator("#pane-code .cm-content");
    await content.waitFor();
    await act({ ...given, run, content });
  });

test("a script is edited and saved in the page, and the model follows", () =>
  open(BLOCKS, async ({ page, script, run, content }) => {
    assert.match(await content.textContent(), /local count = param/);
    const before = await number(page, "triangles");
    await page.locator("#pane-code .cm-line").first().click();
    await page.keyboard.press("End");
    await page.keyboard.type("\ncount = 7 -- mx");
    assert.equal(await seen(page, "pane-state").textContent(), "not saved");
    assert.equal(readFileSync(script, "utf8"), BLOCKS, "nothing is written before it is saved");
    // A key of the page is a letter in the pane.
    assert.equal(await seen(page, "measure").getAttribute("aria-pressed"), "false");
    await page.keyboard.press("Control+s");
    const next = await drawn(page, run);
    assert.equal(readFileSync(script, "utf8"), BLOCKS.replace("\n", "\ncount = 7 -- mx\n"));
    assert.equal(await seen(page, "pane-state").textContent(), "saved");
    assert.ok((await number(page, "triangles")) > before);
    // Undo in the pane is of the text.
    await page.keyboard.press("Control+z");
    await page.keyboard.press("Control+s");
    await drawn(page, next);
    assert.equal(readFileSync(script, "utf8"), BLOCKS);
  }));

test("a save keeps the file's mode, and the pane says so before a slow run ends", () =>
  open(BLOCKS, async ({ page, script, run }) => {
    chmodSync(script, 0o640);
    await page.locator("#pane-code .cm-line").first().click();
    await page.keyboard.press("End");
    await page.keyboard.type("\nlocal sum = 0\nfor i = 1, 400000000 do sum += i % 7 end\n");
    await page.keyboard.press("Control+s");
    await page.waitForFunction(() => document.querySelector("#pane-state").textContent === "saved");
    assert.equal(await page.evaluate(() => Number(document.documentElement.dataset.run)), run, "the run has not ended");
    assert.equal(statSync(script).mode & 0o777, 0o640);
    assert.match(readFileSync(script, "utf8"), /sum \+= i % 7/);
  }));

test("a script that changed on disk is not overwritten before it is asked", () =>
  open(BLOCKS, async ({ page, script, run, content }) => {
    await page.locator("#pane-code .cm-line").first().click();
    await page.keyboard.type("--mine ");
    const theirs = BLOCKS.replace("default = 3", "default = 5");
    save(script, theirs);
    await drawn(page, run);
    await seen(page, "pane-ask").waitFor();
    assert.match(await seen(page, "pane-ask").textContent(), /has changed on disk/);
    assert.equal(readFileSync(script, "utf8"), theirs);
    await seen(page, "pane-take").click();
    assert.match(await content.textContent(), /default = 5/);
    assert.doesNotMatch(await content.textContent(), /--mine/);
    // Without edits, the text follows the file.
    save(script, BLOCKS.replace("default = 3", "default = 7"));
    await page.waitForFunction(() =>
      document.querySelector("#pane-code").shadowRoot.querySelector(".cm-content").textContent.includes("default = 7"),
    );
  }));

test("an error is marked in its line", () =>
  open(BLOCKS, async ({ page }) => {
    await page.locator("#pane-code .cm-line").nth(6).click();
    await page.keyboard.press("End");
    await page.keyboard.type("\nnonsense(1)");
    await page.keyboard.press("Control+s");
    await seen(page, "error").waitFor();
    await page.locator("#pane-code .cm-lint-marker-error").first().waitFor();
  }));

test("names of the scripting API are completed", () =>
  open(BLOCKS, async ({ page }) => {
    await page.locator("#pane-code .cm-line").nth(6).click();
    await page.keyboard.press("End");
    await page.keyboard.type("\nlocal t = turt");
    const list = page.locator("#pane-code .cm-tooltip-autocomplete");
    await list.getByText("turtle", { exact: true }).waitFor();
  }));

test("text that is not saved is not lost when the pane is closed", () =>
  open(BLOCKS, async ({ page }) => {
    await page.locator("#pane-code .cm-line").first().click();
    await page.keyboard.type("--x ");
    await seen(page, "edit").click();
    await seen(page, "pane-ask").waitFor();
    assert.ok(await seen(page, "script-pane").isVisible());
    await seen(page, "pane-cancel").click();
    assert.ok(await seen(page, "script-pane").isVisible());
    await seen(page, "edit").click();
    await seen(page, "pane-discard").click();
    assert.ok(await seen(page, "script-pane").isHidden());
  }));
