// Files that are opened in the page: bad ones, models, IFC, cancelled ones, kept ones.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { before, describe, it } from "node:test";
import { gzipSync } from "node:zlib";
import { dataDir, svt, svtJson } from "./harness.mjs";
import { withHouse } from "./visit.mjs";

const { at, visit, open } = withHouse("files");
const { inPage, state, settled, firstImage, eventually, tool, drop } = visit;

describe("files", () => {
  before(() => open());

  it("that are bad leave what is open, and say why", async () => {
    for (const { name, bytes, expected } of [
      { name: "broken.svt", bytes: readFileSync(at("house.svt")).subarray(0, 5000), expected: /E4\d\d/ },
      { name: "noise.gml", bytes: Buffer.from("this is no XML"), expected: /E1\d\d/ },
      { name: "picture.png", bytes: Buffer.from("x"), expected: /not a volume or building model.*\.ifc/ },
    ]) {
      await drop(name, bytes);
      await visit.page.locator("#message").waitFor();
      assert.match(await visit.page.locator("#message").innerText(), expected);
      assert.equal(await inPage("s.volume.info.name"), "Sample house");
      await visit.page.getByRole("button", { name: "Dismiss" }).click();
    }
    assert.ok((await inPage("(await s.volume.engine.select('class=BuildingRoom')).length")) > 0);
  });

  it("of models are built in the page", async () => {
    await drop("house.gml", readFileSync(at("house.gml")));
    await visit.page.waitForFunction(() => document.querySelector("svt-app").session.volume.file === "house.gml");
    await settled();
    assert.equal(
      await inPage("s.volume.info.features.length"),
      svtJson("info", at("house.gml"), "--json", "--tree").features.length + (await inPage("s.volume.index.firstScalars.length")),
    );
  });

  it("of IFC are built in the page, plain or compressed", async (t) => {
    svt("sample", "house", "--format", "ifc", "-o", at("house.ifc"));
    const files = [
      ["house.ifc", readFileSync(at("house.ifc"))],
      ["again.ifc.gz", gzipSync(readFileSync(at("house.ifc")))],
    ];
    const real = join(dataDir, "fzk_haus.ifc");
    if (existsSync(real)) files.push(["fzk_haus.ifc", readFileSync(real)]);
    for (const [name, bytes] of files) {
      const start = Date.now();
      await drop(name, bytes);
      await visit.page.waitForFunction(
        (wanted) =>
          document.querySelector("svt-app").session.volume.file === wanted && document.querySelector("svt-app").session.picture.report,
        name,
      );
      t.diagnostic(`${name}: from dropped to picture in ${Date.now() - start} ms`);
      const rooms = await inPage("(await s.volume.engine.select('ifcType=IfcSpace')).length");
      assert.ok(rooms > 3, `${name}: ${rooms} rooms`);
    }
  });

  it("that take long are cancelled, and what was open stays", async () => {
    svt("sample", "district", "--columns", "12", "--rows", "12", "-o", at("district.gml"));
    await open();
    await inPage("s.view.set({ hide: ['class=BuildingRoom'] })");
    const before = await inPage("[s.volume.info.name, s.view.state.hide]");
    for (const cancel of [() => visit.page.locator("#cancel").dispatchEvent("click"), () => visit.page.keyboard.press("Escape")]) {
      await drop("district.gml", readFileSync(at("district.gml")));
      await visit.page.locator("#cancel").waitFor();
      await visit.page.waitForTimeout(300);
      await cancel();
      await visit.page.locator("#message").getByText("district.gml was not opened: cancelled.").waitFor();
      assert.equal(await visit.page.locator("#cancel").count(), 0);
      assert.deepEqual(await inPage("[s.volume.info.name, s.view.state.hide]"), before);
      await settled();
      // The worker that was building is replaced, and the one after it opens again what was open.
      await eventually(async () => assert.ok((await inPage("(await s.volume.engine.select('class=BuildingRoom')).length")) > 0));
    }
    // Another file gives up the first, and is bad: what was open before is there all the same.
    await drop("district.gml", readFileSync(at("district.gml")));
    await visit.page.locator("#cancel").waitFor();
    await visit.page.waitForTimeout(300);
    await drop("noise.gml", Buffer.from("this is no XML"));
    await visit.page
      .locator("#message")
      .getByText(/E1\d\d/)
      .waitFor();
    await eventually(async () => assert.ok((await inPage("(await s.volume.engine.select('class=BuildingRoom')).length")) > 0));
    assert.deepEqual(await inPage("[s.volume.info.name, s.view.state.hide]"), before);
    assert.equal(visit.problems.length, 1, visit.problems.join("\n"));
    assert.match(visit.problems[0], /^error: svt: .*E103.*noise\.gml/);
  });

  it("are kept on request, and found by a reload and by links, which say what they need", async () => {
    await open();
    await drop("own.svt", readFileSync(at("house.svt")));
    await visit.page.waitForFunction(() => document.querySelector("svt-app").session.volume.file === "own.svt");
    await inPage("s.view.set({ hide: ['class=BuildingRoom'] })");
    await tool("share");
    await visit.page.click("#copy-link");
    await visit.page.locator("#message").getByText("The link does not contain").waitFor();
    await eventually(async () => assert.match(visit.page.url(), /[?&]file=own\.svt.*view=/));
    const link = visit.page.url();
    // Not kept: the link says what it needs, and shows the view once it has that.
    await visit.page.goto("about:blank");
    await visit.page.goto(link);
    await visit.page.locator("#message").getByText("own.svt, a file that is not part of it").waitFor();
    await firstImage();
    assert.equal(await inPage("s.volume.name"), "house");
    await drop("own.svt", readFileSync(at("house.svt")));
    await visit.page.waitForFunction(() => document.querySelector("svt-app").session.volume.file === "own.svt");
    assert.deepEqual((await state()).hide, ["class=BuildingRoom"]);
    // Kept: a reload finds it.
    await tool("share");
    await visit.page.check("#keep-file");
    await visit.page.waitForFunction(() => document.querySelector("svt-app").shadowRoot.querySelector("svt-share-tool").isFileKept);
    await eventually(async () => assert.match(visit.page.url(), /file=own\.svt.*view=/));
    await visit.page.reload();
    await firstImage();
    assert.deepEqual(await inPage("[s.volume.file, s.volume.isLocal, s.view.state.hide]"), ["own.svt", true, ["class=BuildingRoom"]]);
    await tool("share");
    await eventually(async () => assert.ok(await visit.page.isChecked("#keep-file")));
    await visit.page.uncheck("#keep-file");
    await visit.page.waitForFunction(() => !document.querySelector("svt-app").shadowRoot.querySelector("svt-share-tool").isFileKept);
    await visit.page.reload();
    await visit.page.locator("#message").getByText("own.svt, a file that is not part of it").waitFor();
  });
});
