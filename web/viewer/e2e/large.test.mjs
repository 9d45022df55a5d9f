// A large model in the built page: coarse at once, fine later, within the memory that the page grants.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { before, describe, it } from "node:test";
import { svt } from "./harness.mjs";
import { withHouse } from "./visit.mjs";

const { at, visit, open } = withHouse("large");
const { inPage } = visit;
const file = (name) => ({ name, bytes: readFileSync(at(name)) });

describe("large models", () => {
  before(async () => {
    svt("sample", "district", "--columns", "6", "--rows", "6", "-o", at("district.gml"));
    await open();
  });

  it("are seen coarsely at once, can be used, and become fine where they are", async (t) => {
    const start = Date.now();
    await visit.choose(file("district.gml"));
    await visit.until("s.volume.file === 'district.gml' && s.picture.report");
    const first = Date.now() - start;
    const coarse = await inPage("[s.model.refining.isCoarse, s.volume.info.spacing[0], s.volume.info.features.length]");
    assert.equal(coarse[0], true, "a draft comes first");
    await visit.page.locator("#refining").getByText("Coarse for now").waitFor();
    // Meanwhile it is cut, picked and turned.
    await visit.until("s.view.state.camera");
    const picked = await inPage(
      "(async () => { for (let y = 0.3; y < 0.8; y += 0.1) { const pick = await s.volume.engine.pick(0.5, y); if (pick) return pick.id; } return null; })()",
    );
    assert.ok(picked, "the coarse picture is picked");
    await inPage(
      "(s.selection.select([v]), s.view.set({ sections: [{ axis: 'z', at: 2, flip: false, turn: 0, tilt: 90 }], measured: [[1, 1, 1]] }))",
      picked,
    );
    const world =
      "[...s.view.state.camera.eye.map((e, i) => e + s.volume.info.origin[i]), s.view.state.sections[0].at + s.volume.info.origin[2], s.view.state.measured[0][0] + s.volume.info.origin[0]]";
    const before = await inPage(world);
    await visit.until("!s.model.refining.isCoarse");
    t.diagnostic(
      `first picture after ${first} ms, fine after ${Date.now() - start} ms, at ${coarse[1]} m, then ${await inPage("s.volume.info.spacing[0]")} m`,
    );
    assert.ok((await inPage("s.volume.info.spacing[0]")) < coarse[1], "finer voxels");
    assert.equal(await inPage("s.volume.info.features.length"), coarse[2]);
    assert.deepEqual(await inPage("s.view.state.selection"), [picked]);
    (await inPage(world)).forEach((value, i) => assert.ok(Math.abs(value - before[i]) < 1e-6, `place ${i}: ${value}, was ${before[i]}`));
    await inPage("s.view.undo()");
    assert.deepEqual(await inPage("s.view.state.sections"), []);
    assert.equal(await visit.page.locator("#refining").count(), 0);
    await visit.settled();
    assert.equal(await inPage("s.messages.message"), null);
  });

  it("stay coarse when asked, say so, and become fine later", async () => {
    await visit.choose(file("district.gml"));
    await visit.until("s.model.refining.progress && s.picture.report");
    const spacing = await inPage("s.volume.info.spacing[0]");
    await visit.page.locator("#stay-coarse").dispatchEvent("click");
    await visit.message("The picture stays coarse");
    assert.equal(await inPage("s.volume.info.spacing[0]"), spacing);
    assert.ok((await inPage("s.volume.engine.select('class=BuildingRoom')")).length > 0, "what is open answers");
    await visit.page.locator("#refine").click();
    await visit.until("!s.model.refining.isCoarse");
    assert.ok((await inPage("s.volume.info.spacing[0]")) < spacing);
  });

  it("take no more memory than the page grants, and say what that means", async () => {
    const usual = await inPage("s.volume.info.spacing[0]");
    await open("?model=house&memory=60");
    await visit.choose(file("district.gml"));
    await visit.until("s.volume.file === 'district.gml' && !s.model.refining.isCoarse && s.picture.report");
    assert.ok((await inPage("s.volume.info.spacing[0]")) > usual, "coarser than without");
    await visit.page
      .getByText(/Voxels of .*because at .* MB/)
      .first()
      .waitFor();
  });

  it("have storeys as a list, each once", async () => {
    await visit.tool("section");
    const names = await visit.page.locator("#storeys option, svt-section-tool .chips button").allInnerTexts();
    assert.ok(names.length < 40, `${names.length} storeys`);
    assert.equal(new Set(names).size, names.length);
  });
});
