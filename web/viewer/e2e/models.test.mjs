// Models of all kinds in the built page: several at once, without storeys, with owners; planes, search, walking.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { before, describe, it } from "node:test";
import { command, svt, svtJson } from "./harness.mjs";
import { withHouse } from "./visit.mjs";

const { at, visit, open } = withHouse("models");
const { inPage } = visit;
const file = (name) => ({ name, bytes: readFileSync(at(name)) });

describe("storeys", () => {
  it("are found from rooms where the model names none", async () => {
    // Units instead of storeys: the rooms are the same.
    const text = readFileSync(at("house.gml"), "utf8").replaceAll("bldg:Storey", "bldg:BuildingUnit");
    writeFileSync(at("nameless.gml"), text);
    await open();
    const named = await inPage("s.volume.info.storeys.map(({ floor }) => floor + s.volume.info.origin[2])");
    await visit.choose(file("nameless.gml"));
    await visit.until("s.volume.file === 'nameless.gml' && s.picture.report");
    assert.equal(await inPage("s.volume.index.classes.has('Storey')"), false);
    const found = await inPage("s.volume.info.storeys.map(({ floor }) => floor + s.volume.info.origin[2])");
    assert.equal(found.length, named.length);
    found.forEach((floor, i) => assert.ok(Math.abs(floor - named[i]) < 0.15, `level ${i} at ${floor}, storey at ${named[i]}`));
    await visit.tool("section");
    await visit.page
      .getByRole("button", { name: /Cut Level at [\d.]+ m at 1.1 m/ })
      .first()
      .click();
    assert.equal((await visit.state()).sections[0].axis, "z");
  });
});

describe("planes in faces", () => {
  before(() => open());

  it("are moved by a hair to the side that is kept, in the page and by the command, which both say so", async () => {
    // The plane of some face: the model's heights are round.
    const plane = await inPage(`(async () => {
      for (let n = 1; n < 120; ++n) {
        const at = Number((Math.ceil(s.volume.info.origin[2] / 0.05 + n) * 0.05 - s.volume.info.origin[2]).toFixed(4)), text = "z>" + at;
        const moved = await s.volume.engine.movedPlanes({ passes: [{ cut: text }] }).catch(() => []);
        if (moved.length) return { at, text, by: moved[0].by };
      }
      return null;
    })()`);
    assert.ok(plane, "some face lies across z");
    assert.ok(plane.by > 0.0002 && plane.by < 0.002, `${plane.by} m`);
    await inPage("s.view.set({ sections: [{ axis: 'z', at: v, flip: false, turn: 0, tilt: 90 }] })", plane.at);
    await visit.page.locator("#moved-plane").getByText(`${plane.text} lies in faces of the model`).waitFor();
    const picture = (cut) =>
      inPage("(async () => [...new Uint8Array(await s.volume.engine.picture({ size: [320, 180], passes: [{ cut: v }] }))].join())()", cut);
    const moved = await picture(plane.text);
    assert.equal(moved, await picture(`z>${(plane.at - plane.by).toFixed(6)}`), "as a plane a hair below");
    const told = spawnSync(command, ["render", at("house.svt"), "-o", at("p.png"), "--size", "320x180", "--section", plane.text], {
      encoding: "utf8",
    });
    assert.match(told.stderr, /lies in faces of the model; it is moved by [\d.]+ mm to the kept side/);
    const beside = spawnSync(
      command,
      ["render", at("house.svt"), "-o", at("q.png"), "--size", "320x180", "--section", `z>${(plane.at + 0.021).toFixed(4)}`],
      { encoding: "utf8" },
    );
    assert.doesNotMatch(beside.stderr, /lies in faces/);
    // Beside the face nothing is said.
    await inPage("s.view.set({ sections: [{ axis: 'z', at: v + 0.021, flip: false, turn: 0, tilt: 90 }] })", plane.at);
    await visit.eventually(async () => assert.equal(await visit.page.locator("#moved-plane").count(), 0));
  });
});

describe("search and colours", () => {
  before(async () => {
    svt("sample", "house", "--format", "ifc", "-o", at("house.ifc"));
    svt("build", at("house.ifc"), "-o", at("ifc.svt"), "--spacing", "0.12");
    await open();
    await visit.choose(file("ifc.svt"));
    await visit.until("s.volume.file === 'ifc.svt' && s.picture.report");
  });

  it("finds types by words of the language", async () => {
    const expected = async (type) => await inPage(`(await s.volume.engine.select('class=${type}')).length`);
    for (const [word, type] of [
      ["window", "IfcWindow"],
      ["Fenster", "IfcWindow"],
      ["IfcWindow", "IfcWindow"],
      ["Wand", "IfcWall"],
      ["Tür", "IfcDoor"],
    ]) {
      await visit.page.fill("#search", word);
      const wanted = await expected(type);
      assert.ok(wanted > 0, type);
      await visit.eventually(async () => {
        const said = await visit.page.locator("svt-tree [role=status]").first().innerText();
        assert.ok(Number(/^\d+/.exec(said)?.[0]) >= wanted, `${word}: ${said}, expected ${wanted}`);
      });
      const ids = await inPage(`s.volume.engine.select('class=${type}')`);
      const found = await inPage(
        "[...document.querySelector('svt-app').shadowRoot.querySelector('svt-tree').rows.shown].map((i) => s.volume.index.features[i].id)",
      );
      for (const id of ids) assert.ok(found.includes(id), `${word} does not find ${id}`);
    }
    await visit.page.fill("#search", "");
  });

  it("offers the attributes of the model for colours, with a legend in the picture", async () => {
    await visit.tool("look");
    const offered = await visit.page.locator("#color-by option").evaluateAll((options) => options.map((option) => option.value));
    assert.ok(offered.includes("ifcType"), offered.join());
    const picture = () =>
      inPage("(async () => [...new Uint8Array(await s.volume.engine.picture(await s.view.composed([480, 270])))].join())()");
    const plain = await picture();
    await visit.page.selectOption("#color-by", "ifcType");
    await visit.settled();
    assert.equal(await inPage("s.messages.message"), null);
    assert.notEqual(await picture(), plain);
    const legend = visit.page.getByRole("list", { name: "Legend: ifcType" });
    await legend.waitFor();
    const rows = await legend.getByRole("listitem").allTextContents();
    assert.ok(
      rows.some((row) => /^IfcWall\w*: \d+$/.test(row)),
      `the legend as text: ${rows.join("; ")}`,
    );
    const swatches = await legend.locator(".swatch").evaluateAll((all) => all.map((e) => getComputedStyle(e).backgroundColor));
    assert.ok(new Set(swatches).size > 3 && swatches.every((color) => /^rgb\(/.test(color)), `colours: ${swatches}`);
    // The picture on the screen has no second legend.
    assert.equal(await inPage("s.view.describe(s.view.size, 1, true).scene.legend"), false);
    await inPage("s.view.set({ colorBy: 'volume' })");
    await visit.page
      .getByRole("list", { name: /^Legend: volume/ })
      .getByText(/^from [\d.,]+ to [\d.,]+$/)
      .waitFor();
    // Hidden components do not change the colours of others.
    const keys = async () =>
      legend
        .locator("li")
        .evaluateAll((all) =>
          all.map((e) => [e.innerText.replace(/: \d+$/, ""), getComputedStyle(e.querySelector(".swatch")).backgroundColor]),
        );
    await inPage("s.view.set({ colorBy: 'ifcType' })");
    await legend.waitFor();
    const before = await keys();
    const [first] = before[0];
    await inPage("s.view.set({ hide: [...s.view.state.hide, `class=${v}`] })", first);
    await visit.eventually(async () => assert.deepEqual(await keys(), before.slice(1)));
    await inPage("s.view.set({ colorBy: '' })");
    await legend.waitFor({ state: "detached" });
  });
});

describe("tables and several models", () => {
  before(() => open());

  it("a table that is dropped gives owners, colours and queries, and is named by the command", async () => {
    const rooms = await inPage("s.volume.engine.select('class=BuildingRoom')");
    const table = `feature,owner\n${rooms.map((id, n) => `${id},${n % 2 ? "Ada" : "Bob"}`).join("\n")}\n`;
    await visit.choose({ name: "parcels.csv", bytes: Buffer.from(table) });
    await visit.message("The owners are from parcels.csv");
    assert.equal((await visit.state()).colorBy, "owner");
    assert.deepEqual(
      (await inPage("s.volume.engine.select('owner=Ada and class=BuildingRoom')")).sort(),
      rooms.filter((_, n) => n % 2).sort(),
    );
    await visit.settled();
    await visit.page.getByRole("button", { name: "Dismiss" }).click();
    await visit.tool("share");
    await visit.page.click("#copy-command");
    await visit.eventually(async () =>
      assert.match(await visit.page.evaluate(() => navigator.clipboard.readText()), /--color-by owner .*--owners parcels\.csv$/),
    );
    // Another table takes its place; a bad one says where.
    await visit.choose({ name: "other.csv", bytes: Buffer.from(`feature,owner\n${rooms[0]},Cleo\n`) });
    await visit.message("The owners are from other.csv");
    assert.deepEqual(await inPage("s.volume.engine.select('owner=Ada').catch(() => [])"), []);
    await visit.eventually(async () => {
      const legend = (await visit.page.locator("#color-scale li").allInnerTexts()).join();
      assert.ok(legend.includes("Cleo") && !/Ada|Bob/.test(legend), `the legend of the second table: ${legend}`);
    });
    // Rows of unknown features have no effect, and are named.
    const some = `feature,owner\n${rooms[0]},Dora\nno such thing,Ada\n`;
    await visit.choose({ name: "some.csv", bytes: Buffer.from(some) });
    await visit.message("Line 3: 'no such thing'");
    assert.equal(await visit.page.locator("#message.bad").count(), 0);
    assert.deepEqual(await inPage("s.volume.engine.select('owner=Dora and class=BuildingRoom')"), [rooms[0]]);
    await visit.settled();
    await visit.choose({ name: "bad.csv", bytes: Buffer.from("feature,owner\nno such thing,Ada\n") });
    await visit.page
      .locator("#message.bad")
      .getByText(/bad\.csv:2/)
      .waitFor();
  });

  it("volumes are drawn together, picked as one, and named by the command", async () => {
    svt("sample", "tower", "-o", at("tower.gml"));
    svt("build", at("house.gml"), "-o", at("a.svt"), "--spacing", "0.12", "--vectors", "none");
    // Another building beside it, of another spacing.
    svt("build", at("tower.gml"), "-o", at("part.svt"), "--spacing", "0.2", "--vectors", "none");
    await visit.choose(file("a.svt"), file("part.svt"));
    await visit.until("s.volume.file === 'a.svt' && s.picture.report");
    assert.equal(await inPage("s.volume.info.details"), 1);
    const [bytes, scene] = await inPage(
      "(async () => { const scene = await s.view.composed([320, 180]); return [btoa(Array.from(new Uint8Array(await s.volume.engine.picture(scene)), (b) => String.fromCharCode(b)).join('')), scene]; })()",
    );
    writeFileSync(at("two.scene.json"), JSON.stringify(scene));
    svt("render", at("a.svt"), "--with", at("part.svt"), "--scene", at("two.scene.json"), "-o", at("two.png"));
    assert.ok(Buffer.from(bytes, "base64").equals(readFileSync(at("two.png"))), "as svt render --with");
    const seen = await inPage(`(async () => {
      const ids = new Set();
      for (let y = 0.05; y < 1; y += 0.05) for (let x = 0.05; x < 1; x += 0.05) ids.add((await s.volume.engine.pick(x, y))?.id ?? "");
      return [...ids];
    })()`);
    assert.ok(
      seen.some((id) => id.startsWith("house_")) && seen.some((id) => id.startsWith("tower_")),
      `objects of both are picked: ${seen.join(" ")}`,
    );
    await visit.tool("share");
    await visit.page.click("#copy-command");
    await visit.eventually(async () =>
      assert.match(await visit.page.evaluate(() => navigator.clipboard.readText()), /^svt render a\.svt .*--with part\.svt$/),
    );
  });

  it("models become one", async () => {
    await visit.choose(file("house.gml"), { name: "again.gml", bytes: readFileSync(at("house.gml")) });
    await visit.until("s.volume.otherFiles.join() === 'again.gml' && s.picture.report");
    const rooms = (await inPage("s.volume.engine.select('class=BuildingRoom')")).length;
    assert.equal(rooms, 2 * svtJson("query", at("house.svt"), "class=BuildingRoom", "--json").length);
    await visit.page.click("#copy-command");
    await visit.eventually(async () =>
      assert.match(
        await visit.page.evaluate(() => navigator.clipboard.readText()),
        /^svt build house\.gml again\.gml -o model\.svt .* && svt render model\.svt /,
      ),
    );
  });
});

describe("walking", () => {
  before(() => open());

  it("begins in the air of a room, is stopped by walls, glides along them, and 0 ends it", async () => {
    await visit.settled();
    await visit.page.locator("svt-picture .stage").focus();
    await visit.page.keyboard.press("g");
    await visit.until(
      "s.view.isWalking && Math.abs(s.view.state.camera.eye[2] - s.view.state.camera.target[2]) < 1e-6 && s.view.state.camera.fieldOfView === 65",
    );
    const eye = (await visit.state()).camera.eye;
    const boxes = await inPage(
      "(async () => { const all = []; for (const id of await s.volume.engine.select('class=BuildingRoom')) all.push((await s.volume.engine.properties(id)).box); return all; })()",
    );
    const isIn = (p, slack) => boxes.some(({ low, high }) => p.every((v, i) => v > low[i] - slack && v < high[i] + slack));
    assert.ok(isIn(eye, 0), `stands at ${eye}, in no room`);
    // In all directions a wall, or a door and then the open, ends the way: never inside of a wall.
    const size = await inPage("s.volume.box.high");
    let stopped = 0;
    for (let n = 0; n < 8; ++n) {
      const [dx, dy] = [Math.cos((n * Math.PI) / 4), Math.sin((n * Math.PI) / 4)];
      const end = await inPage("s.volume.engine.step(v[0], v[1])", [eye, [5 * dx, 5 * dy, 0]]);
      const went = Math.hypot(end[0] - eye[0], end[1] - eye[1]);
      assert.ok(went <= 5 + 1e-6);
      if (went < 4.9) ++stopped;
      // A step from where one stands is free somewhere: one is in no wall.
      const back = await inPage("s.volume.engine.step(v[0], v[1])", [end, [-0.3 * dx, -0.3 * dy, 0]]);
      assert.ok(Math.hypot(back[0] - end[0], back[1] - end[1]) > 0.05, `stuck at ${end}`);
    }
    assert.ok(stopped >= 4, `${stopped} of 8 ways end at something within 5 m; the house is ${size}`);
    await visit.page.locator("svt-picture .stage").focus();
    await visit.page.keyboard.down("w");
    await visit.eventually(async () => assert.notDeepEqual((await visit.state()).camera.eye, eye));
    await visit.page.keyboard.up("w");
    await visit.page.keyboard.press("0");
    await visit.until("!s.view.isWalking");
  });
});
