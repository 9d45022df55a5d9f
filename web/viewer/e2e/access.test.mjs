// The page by keyboard, for screen readers, in German and in the dark, within its policy.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, it } from "node:test";
import { repository } from "./harness.mjs";
import { withHouse } from "./visit.mjs";

const { visit, open } = withHouse("access");
const { inPage, state, settled, tool } = visit;

describe("access", () => {
  const axe = readFileSync(join(repository, "web/viewer/node_modules/axe-core/axe.min.js"), "utf8");
  // Of the page as it stands: a split panel that was just made has no width before the next frame, and says so to axe.
  async function findings() {
    await visit.page.waitForFunction(() =>
      [...document.querySelectorAll("svt-app")].every((app) =>
        [...app.renderRoot.querySelectorAll("wa-split-panel")].every(
          (/** @type {any} */ panel) => Number.isFinite(panel.position) && !panel.isUpdatePending,
        ),
      ),
    );
    // Evaluated by the debugger, since the page's policy allows no foreign script.
    await visit.page.evaluate(axe);
    const { violations } = await visit.page.evaluate(() => globalThis.axe.run(document, { resultTypes: ["violations"] }));
    return violations
      .filter((v) => ["serious", "critical"].includes(v.impact))
      .map((v) => `${v.id}: ${v.nodes.map((n) => n.target.flat().join(" ")).join(" | ")}`);
  }

  it("works by keyboard alone", async () => {
    await open();
    await visit.page.keyboard.press("?");
    await visit.page.getByRole("dialog").waitFor();
    await visit.page.keyboard.press("Escape");
    await visit.page.getByRole("dialog").waitFor({ state: "hidden" });
    await visit.page.keyboard.press("/");
    await visit.page.keyboard.type("hidden beam");
    await visit.page.keyboard.press("Enter");
    await visit.page.waitForFunction(() => document.querySelector("svt-app").session.view.state.selection[0] === "house_hidden_beam");
    await visit.page.keyboard.press(" ");
    assert.deepEqual((await state()).hide, ["class=BuildingRoom", 'id="house_hidden_beam"']);
    await visit.page.keyboard.press(" ");
    await visit.page.keyboard.press("x");
    await visit.page.locator("#card").waitFor();
    await visit.page.locator("#add-plane").focus();
    await visit.page.keyboard.press("Enter");
    assert.equal((await state()).sections.length, 1);
    await visit.page.keyboard.press("Escape");
    await visit.page.evaluate(() => {
      if (document.activeElement instanceof HTMLElement) document.activeElement.blur();
      window.focus();
    });
    let isPicture = false;
    for (let n = 0; n < 60 && !isPicture; ++n) {
      await visit.page.keyboard.press("Tab");
      isPicture = await visit.page.evaluate(() => {
        let active = document.activeElement;
        while (active?.shadowRoot?.activeElement) active = active.shadowRoot.activeElement;
        return active?.classList.contains("stage") ?? false;
      });
    }
    assert.ok(isPicture, "Tab reaches the picture");
    const before = (await state()).camera.eye;
    await visit.page.keyboard.press("ArrowLeft");
    assert.notDeepEqual((await state()).camera.eye, before);
    await visit.page.keyboard.press("Enter");
    await visit.page.waitForFunction(() => document.querySelector("svt-app").session.view.state.selection[0] !== "house_hidden_beam");
  });

  it("moves along the tools by arrow keys, ends what Escape closes, and leaves walking by 0", async () => {
    await open();
    await visit.page.locator("#tool-section").focus();
    await visit.page.keyboard.press("ArrowRight");
    const focused = () => visit.page.evaluate(() => document.querySelector("svt-app").shadowRoot.activeElement?.id);
    assert.equal(await focused(), "tool-lens");
    await visit.page.keyboard.press("End");
    assert.equal(await focused(), "tool-share");
    await visit.page.keyboard.press("ArrowRight");
    assert.equal(await focused(), "tool-section");
    assert.equal(await visit.page.locator("#tool-section").getAttribute("tabindex"), "0");
    assert.equal(await visit.page.locator("#tool-lens").getAttribute("tabindex"), "-1");
    await visit.page.keyboard.press("c");
    assert.equal((await state()).effect, "lens");
    await visit.page.keyboard.press("Escape");
    assert.equal((await state()).effect, "none");
    await visit.page.keyboard.press("g");
    assert.equal(await inPage("s.view.isWalking"), true);
    await visit.page.keyboard.press("0");
    assert.equal(await inPage("s.view.isWalking"), false);
  });

  for (const { colorScheme, width, height } of [
    { colorScheme: "light", width: 1440, height: 900 },
    { colorScheme: "dark", width: 1440, height: 900 },
    { colorScheme: "light", width: 360, height: 740 },
    { colorScheme: "dark", width: 360, height: 740 },
  ])
    it(`has no serious findings in ${colorScheme} at ${width} px`, async () => {
      await open("?model=house", { colorScheme, viewport: { width, height }, locale: "de-DE" });
      await inPage("s.selection.select(['house_hidden_beam'])");
      await visit.page.waitForTimeout(300);
      const found = await findings();
      const tools = width < 700 ? ["section", "share"] : ["section", "lens", "focus", "look", "measure", "views", "share"];
      for (const name of tools) {
        await tool(name);
        await visit.page.waitForTimeout(100);
        found.push(...(await findings()).map((finding) => `${name}: ${finding}`));
        await visit.page.click(`#tool-${name}`);
      }
      if (width < 700) {
        await visit.page.getByRole("button", { name: "Zeigen oder verbergen: Teile" }).click();
        found.push(...(await findings()).map((finding) => `parts: ${finding}`));
      }
      // The row of a hidden object, selected and not; then the mode in which taps add.
      for (const state of ["s.view.hideSelected(true)", "s.selection.select([])", "s.selection.isMore = true"]) {
        await inPage(state);
        await visit.page.waitForTimeout(100);
        assert.ok((await visit.page.locator(".item.gone .name").count()) > 0, state);
        found.push(...(await findings()).map((finding) => `${state}: ${finding}`));
      }
      assert.deepEqual(found, []);
    });

  it("speaks German, and is dark, when asked", async () => {
    await open();
    await visit.page.click("#language");
    await visit.page.getByRole("tab", { name: "Aufbau" }).waitFor();
    assert.equal(await visit.page.evaluate(() => document.documentElement.lang), "de");
    await visit.page.click("#theme");
    assert.equal((await state()).look, "dark");
  });

  it("keeps its policy: nothing inline, nothing from elsewhere, no errors", async () => {
    await open();
    await tool("section");
    await visit.page.click("#add-plane");
    await inPage("s.selection.select(['house_hidden_beam'])");
    await visit.page.keyboard.press("?");
    await settled();
    assert.deepEqual(visit.problems, []);
  });
});
