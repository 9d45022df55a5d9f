// What is kept of a view: pictures, links, commands, scenes, bookmarks, undo; checked against the `svt` command.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { before, describe, it } from "node:test";
import { svt } from "./harness.mjs";
import { readPng } from "./png.mjs";
import { withHouse } from "./visit.mjs";

const { at, visit, open } = withHouse("keeping");
const { inPage, state, settled, firstImage, stage, eventually, tool, saved } = visit;

describe("keeping", () => {
  before(async () => {
    await open();
    await inPage(
      `s.view.set({ hide: ["class=BuildingRoom"], look: "paper", sections: [{ axis: "y", at: 5, flip: true, turn: 0, tilt: 0 }], selection: ["house_hidden_beam"], effect: "highlight" })`,
    );
    await settled();
  });

  it("saves the picture that the command draws of the same scene, byte for byte", async () => {
    await tool("share");
    await visit.page.getByLabel("Width").fill("480");
    await visit.page.getByLabel("Height").fill("270");
    await visit.page.keyboard.press("Tab");
    const { bytes } = await saved(() => visit.page.click("#save-picture"));
    writeFileSync(at("view.scene.json"), JSON.stringify(await inPage("s.view.composed([480, 270])")));
    svt("render", at("house.svt"), "--scene", at("view.scene.json"), "-o", at("view.png"));
    assert.ok(bytes.equals(readFileSync(at("view.png"))));
  });

  it("gives a command that draws the same", async () => {
    await visit.page.click("#copy-command");
    await visit.page.locator("#message").waitFor();
    const command = await visit.page.evaluate(() => navigator.clipboard.readText());
    // Whoever gets it may not have the model: it comes with the command.
    const [fetching, drawing] = command.split(" && ");
    assert.match(fetching, /^curl -fLo house\.svt http:\/\/[^ ]+\/house\.svt$/);
    assert.match(drawing, /^svt render house\.svt -o view\.png --size 480x270 /);
    const words = [...drawing.matchAll(/'((?:[^'])*)'|(\S+)/g)].map((m) => m[1] ?? m[2]).slice(1);
    words[1] = at("house.svt");
    words[3] = at("by-command.png");
    svt(...words);
    assert.ok(readFileSync(at("by-command.png")).equals(readFileSync(at("view.png"))));
  });

  it("gives code that shows the view in another page", async () => {
    await visit.page.click("#copy-embedding");
    const source = await eventually(async () => {
      const code = await visit.page.evaluate(() => navigator.clipboard.readText());
      return /^<iframe .*src="([^"]+)"/.exec(code)?.[1] ?? assert.fail(code);
    });
    const shown = source.replaceAll("&amp;", "&");
    const second = await visit.page.context().newPage();
    await second.goto(shown);
    await second.waitForFunction(() => document.querySelector("svt-app")?.session?.picture.report);
    assert.equal(await second.evaluate(() => document.querySelector("svt-app").session.view.state.look), "paper");
    await second.close();
    await visit.page.bringToFront();
    await visit.page.getByRole("button", { name: "Dismiss" }).click();
  });

  it("gives a link that opens the same view", async () => {
    await visit.page.click("#copy-link");
    const link = await eventually(async () => {
      const text = await visit.page.evaluate(() => navigator.clipboard.readText());
      assert.match(text, /^http.*&view=/);
      return text;
    });
    const wanted = await state();
    const { inflateRawSync } = await import("node:zlib");
    const scene = inflateRawSync(Buffer.from(new URLSearchParams(new URL(link).hash.slice(1)).get("scene"), "base64url"));
    writeFileSync(at("link.scene.json"), scene);
    svt("render", at("house.svt"), "--scene", at("link.scene.json"), "-o", at("link.png"));
    const second = await visit.page.context().newPage();
    await second.goto(link);
    await second.waitForFunction(() => document.querySelector("svt-app").session.picture.quality === "fine");
    const opened = await second.evaluate(() => document.querySelector("svt-app").session.view.state);
    assert.deepEqual(opened, wanted);
    const base64 = await second.evaluate(async (text) => {
      const s = document.querySelector("svt-app").session;
      const bytes = new Uint8Array(await s.volume.engine.picture(await s.view.composed(JSON.parse(text).size)));
      return btoa(Array.from(bytes, (b) => String.fromCharCode(b)).join(""));
    }, scene.toString());
    assert.ok(Buffer.from(base64, "base64").equals(readFileSync(at("link.png"))));
    await second.close();
  });

  it("keeps views, and gives them back as scenes", async () => {
    await visit.page.click("#keep-view");
    const kept = await state();
    await inPage(`s.view.set({ look: "dark", sections: [], effect: "none" })`);
    await visit.page.getByRole("button", { name: "View 1", exact: true }).click();
    await eventually(async () => assert.deepEqual(await state(), kept));
    const { bytes } = await saved(() => visit.page.getByRole("button", { name: "View 1 as scene JSON" }).click());
    writeFileSync(at("kept.scene.json"), bytes);
    svt("render", at("house.svt"), "--scene", at("kept.scene.json"), "-o", at("kept.png"), "--size", "160x90");
    await visit.page.getByRole("button", { name: "Remove View 1" }).click();
  });

  it("keeps views with pictures and names, in an order, and passes them on as a file", async () => {
    const list = visit.page.locator("svt-bookmark-list li");
    await visit.page.click("#keep-view");
    await eventually(async () => assert.equal(await list.count(), 1));
    await inPage(`s.view.set({ look: "paper" })`);
    await settled();
    await visit.page.click("#keep-view");
    await eventually(async () => assert.equal(await list.count(), 2));
    const picture = await list.nth(1).locator("img").getAttribute("src");
    const small = readPng(Buffer.from(picture.split(",")[1], "base64"));
    assert.deepEqual([small.width, small.height], [112, 70]);
    assert.ok(new Set(small.data).size > 20, "the picture shows something");
    await list.nth(1).locator("input").fill("On paper");
    await list.nth(1).locator("input").press("Enter");
    await visit.page.getByRole("button", { name: "On paper one place up" }).click();
    const names = () => list.locator("input").evaluateAll((inputs) => inputs.map((input) => input.value));
    assert.deepEqual(await names(), ["On paper", "View 1"]);
    const { name, bytes } = await saved(() => visit.page.click("#export-views"));
    assert.equal(name, "views.json");
    await visit.page.getByRole("button", { name: "Remove On paper" }).click();
    await visit.page.getByRole("button", { name: "Remove View 1" }).click();
    await visit.page.locator("#views-file").setInputFiles({ name: "views.json", mimeType: "application/json", buffer: bytes });
    await visit.page.locator("#message").getByText("2 bookmarks added").waitFor();
    assert.deepEqual(await names(), ["On paper", "View 1"]);
    await visit.page.locator("#views-file").setInputFiles({ name: "other.json", mimeType: "application/json", buffer: Buffer.from("{}") });
    await visit.page.locator("#message").getByText("other.json contains no bookmarks.").waitFor();
    await visit.page.reload();
    await firstImage();
    await tool("share");
    assert.deepEqual(await names(), ["On paper", "View 1"]);
    await visit.page.getByRole("button", { name: "On paper", exact: true }).click();
    await eventually(async () => assert.equal((await state()).look, "paper"));
    await inPage(`s.view.set({ look: "plain" })`);
  });

  it("takes back and repeats what changed the picture", async () => {
    await open();
    // The first view is fitted once more when the picture has its size.
    await settled();
    assert.ok(await visit.page.locator("#undo").isDisabled());
    await inPage("s.selection.select(['house_hidden_beam'])");
    assert.ok(await visit.page.locator("#undo").isDisabled(), "a selection is no step");
    await visit.page.keyboard.press("h");
    await visit.page.keyboard.press("x");
    await visit.page.click("#add-plane");
    await visit.page.keyboard.press("Escape");
    const cut = (await state()).sections;
    assert.equal(await visit.page.locator("#undo").getAttribute("title"), "Undo: Section");
    await visit.page.keyboard.press("Control+z");
    assert.deepEqual((await state()).sections, []);
    await visit.page.click("#undo");
    assert.deepEqual((await state()).hide, ["class=BuildingRoom"]);
    assert.ok(await visit.page.locator("#undo").isDisabled());
    await visit.page.keyboard.press("Control+y");
    assert.deepEqual((await state()).hide, ["class=BuildingRoom", 'id="house_hidden_beam"']);
    assert.equal(await visit.page.locator("#redo").getAttribute("title"), "Redo: Section");
    await visit.page.keyboard.press("Control+Shift+z");
    assert.deepEqual((await state()).sections, cut);
    const eye = (await state()).camera.eye;
    const box = await stage();
    await visit.page.mouse.move(box.x + 200, box.y + 200);
    await visit.page.mouse.down();
    for (let n = 0; n < 10; ++n) await visit.page.mouse.move(box.x + 200 + 12 * n, box.y + 200);
    await visit.page.mouse.up();
    assert.notDeepEqual((await state()).camera.eye, eye);
    await visit.page.keyboard.press("Control+z");
    assert.deepEqual((await state()).camera.eye, eye, "a drag is one step");
    assert.deepEqual((await state()).sections, cut);
  });

  it("shows the scene as JSON, takes it changed, and says what is wrong", async () => {
    await tool("share");
    await visit.page.click("#show-scene");
    const text = await visit.page.locator("#scene-json").inputValue();
    const scene = JSON.parse(text);
    await visit.page.fill("#scene-json", "{");
    await visit.page.click("#apply-scene");
    await visit.page.getByText("This is not JSON").waitFor();
    await visit.page.fill("#scene-json", JSON.stringify({ ...scene, passes: [{ cut: 4 }] }));
    await visit.page.click("#apply-scene");
    await visit.page.getByText(/passes\/0\/cut/).waitFor();
    await visit.page.fill("#scene-json", JSON.stringify({ ...scene, passes: [{ cut: "ball(6,3,3,3)" }] }));
    await visit.page.click("#apply-scene");
    await visit.page.getByRole("button", { name: "Back to the tools" }).waitFor();
    assert.deepEqual((await inPage("s.view.describe([640, 360])")).scene.passes, [{ cut: "ball(6,3,3,3)" }]);
    await visit.page.getByRole("button", { name: "Back to the tools" }).click();
    assert.equal((await state()).custom, null);
  });
});
