// The modules of a visit: one that draws comes first; the whole one follows, for models, drawings and sheets.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { describe, it } from "node:test";
import { svt } from "./harness.mjs";
import { withHouse } from "./visit.mjs";

const { at, visit, open } = withHouse("modules");
const { inPage, state, settled, eventually, tool, saved, drop } = visit;

/** Names of the modules that the page has asked for. */
function watched() {
  const asked = [];
  visit.page.on("request", (request) => {
    const name = /\/(svt\w*)-[^/]*\.wasm$/.exec(request.url())?.[1];
    if (name) asked.push(name.replace("_threads", ""));
  });
  return asked;
}

const kWhole = /\/svt(_threads)?-[^/]*\.(wasm|js)$/;
const exported = () => saved(() => visit.page.getByRole("button", { name: "Export as SVG" }).click());

async function cut() {
  await inPage("s.view.set({ sections: [{ axis: 'z', at: 1.2, flip: false, turn: 0, tilt: 90 }] })");
  await tool("section");
  await settled();
}

function expected() {
  svt("section", at("house.svt"), "-o", at("plan.svg"), "--plane", "z>1.2");
  return readFileSync(at("plan.svg"), "utf8");
}

describe("modules", () => {
  it("follow each other, and tools then need no connection", async () => {
    await open();
    const address = visit.page.url();
    await visit.page.goto("about:blank");
    const asked = watched();
    await visit.page.goto(address);
    await visit.firstImage();
    await eventually(async () => assert.deepEqual(asked, ["svt_view", "svt"]));
    await visit.page.waitForFunction(() => performance.getEntriesByName("svt-all-scripts").length > 0);
    await visit.page.waitForLoadState("networkidle");
    await visit.page.context().setOffline(true);
    await cut();
    const { bytes } = await exported();
    assert.ok(bytes.toString("utf8") === expected(), "as the command makes it");
    // Scripts that load late have come, too.
    await visit.page.keyboard.press("Control+k");
    await visit.page.locator("svt-palette input:focus").waitFor();
    await visit.page.keyboard.press("Escape");
    await visit.page.click("#table");
    await visit.page.locator("svt-table [role=row]").first().waitFor();
    await visit.page.click("#table");
    await tool("look");
    await visit.page.selectOption("#color-by", "class");
    await visit.page.locator("#color-scale li").first().waitFor();
    await visit.page.click("#basemap");
    await visit.page.locator("#basemap-show").waitFor();
    assert.equal(await inPage("s.messages.message"), null);
  });

  it("keep the model, its owners and the picked place when the whole one takes over", async () => {
    await open();
    const rooms = await inPage("s.volume.info.features.filter((f) => f.class === 'BuildingRoom').map((f) => f.id)");
    writeFileSync(at("owners.csv"), `feature,owner\n${rooms[0]},Ada\n`);
    await drop("owners.csv", readFileSync(at("owners.csv")));
    await visit.message("The owners are from owners.csv");
    const owned = () => inPage("s.volume.engine.select('owner=Ada and class=BuildingRoom')");
    assert.deepEqual(await owned(), [rooms[0]]);
    await inPage("s.view.set({ colorBy: '' })");
    await cut();
    const before = [await inPage("s.volume.engine.pick(0.5, 0.5)"), await state()];
    await exported();
    assert.deepEqual([await inPage("s.volume.engine.pick(0.5, 0.5)"), await state()], before);
    assert.deepEqual(await owned(), [rooms[0]]);
    assert.deepEqual(visit.problems, []);
  });

  it("are asked for again after a failure, which changes nothing else", async () => {
    await open();
    await visit.page.context().route(kWhole, (route) => route.abort());
    await visit.page.reload();
    await visit.firstImage();
    await cut();
    await visit.page.getByRole("button", { name: "Export as SVG" }).click();
    await visit.message("cannot be loaded");
    await drop("house.gml", readFileSync(at("house.gml")));
    await visit.message("cannot be loaded");
    assert.equal(await inPage("s.volume.file"), "house.svt");
    await inPage("s.view.set({ sections: [] })");
    await settled();
    await visit.page.context().unroute(kWhole);
    await drop("house.gml", readFileSync(at("house.gml")));
    await visit.until("s.volume.file === 'house.gml' && s.picture.report");
    await settled();
  });
});
