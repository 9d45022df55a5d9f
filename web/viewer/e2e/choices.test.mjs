// Choices that act on many features: flats and storeys, colours by value, comparisons; choices that cannot be drawn.
import assert from "node:assert/strict";
import { after, before, describe, it } from "node:test";
import { serve, svt, svtJson, withModels } from "./harness.mjs";
import { scratch, Visit } from "./visit.mjs";

const { at, drop } = scratch("svt-choices-test-");
const visit = new Visit();
const { inPage, state, settled, until, eventually } = visit;
const kFlat = "tower_S01_F1",
  kStorey = "tower_S01_storey";
let server;

/** Share of pixels that differ between two screenshots of the picture. */
const differs = async (a, b) =>
  inPage(
    `(async () => {
      const pixels = async (bytes) => {
        const bitmap = await createImageBitmap(new Blob([Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0))]));
        const canvas = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
        canvas.drawImage(bitmap, 0, 0);
        return canvas.getImageData(0, 0, bitmap.width, bitmap.height).data;
      };
      const [a, b] = [await pixels(v[0]), await pixels(v[1])];
      let n = 0;
      for (let i = 0; i < a.length; i += 4) n += Math.abs(a[i] - b[i]) + Math.abs(a[i + 1] - b[i + 1]) + Math.abs(a[i + 2] - b[i + 2]) > 24 ? 1 : 0;
      return n / (a.length / 4);
    })()`,
    [a.toString("base64"), b.toString("base64")],
  );
/** The picture of the current view as the command would draw it. */
const picture = async () =>
  Buffer.from(
    await inPage(
      `(async () => { const bytes = new Uint8Array(await s.volume.engine.picture(await s.view.composed([320, 240], 1))); let text = ""; for (const b of bytes) text += String.fromCharCode(b); return btoa(text); })()`,
    ),
    "base64",
  );
const panel = () => visit.page.locator("svt-properties");
const button = (name) => panel().getByRole("button", { name, exact: true });
const choose = (id) => inPage("s.selection.select([v])", id);
const reset = () =>
  inPage("(s.selection.select([]), s.view.set({ ...v, camera: s.view.state.camera }), (s.messages.message = null))", initial);
let initial;

before(async () => {
  svt("sample", "tower", "--storeys", "3", "-o", at("tower.gml"));
  svt("build", at("tower.gml"), "-o", at("tower.svt"), "--spacing", "0.25");
  svt("sample", "house", "-o", at("house.gml"));
  svt("build", at("house.gml"), "-o", at("house.svt"), "--spacing", "0.2", "--vectors", "edges,meshes");
  svt("sample", "district", "--columns", "2", "--rows", "2", "-o", at("district.gml"));
  svt("build", at("district.gml"), "-o", at("district.svt"), "--spacing", "0.5");
  const models = ["tower", "house", "district"].map((name) => ({ name, path: at(`${name}.svt`), title: name }));
  server = await serve(withModels(models));
  await visit.open(`${server.url}?model=tower`);
  await settled();
  initial = await state();
});
after(async () => {
  await visit.close();
  await server?.close();
  drop();
});

describe("flats and storeys act as their members", () => {
  it("have the volume of all their parts", async () => {
    await choose(kFlat);
    await until("s.selection.properties");
    const { totalVolume } = svtJson("query", at("tower.svt"), `id=${kFlat}`, "--json")[0];
    assert.equal(await panel().locator("#total-volume").innerText(), `${totalVolume.toFixed(3)} m³`);
    assert.doesNotMatch((await panel().locator("dl").allInnerTexts()).join(" "), /\b0\.0\d\d m³/);
    // The surface is that of all parts together, whose common faces do not count; the extent holds them all.
    const { totalSurface, box } = await inPage("s.selection.properties");
    const parts = await inPage(
      "Promise.all(v.map((id) => s.volume.engine.properties(id)))",
      await inPage("s.volume.engine.select(v)", `under ${kFlat}`),
    );
    const solids = parts.filter((part) => part.surface > 0);
    assert.ok(solids.length > 10);
    const sum = solids.reduce((all, part) => all + part.surface, 0);
    assert.ok(totalSurface > 50 && totalSurface < sum, `${totalSurface}, its parts have ${sum}`);
    for (const axis of [0, 1, 2]) {
      assert.equal(box.low[axis], Math.min(...solids.map((part) => part.box.low[axis])));
      assert.equal(box.high[axis], Math.max(...solids.map((part) => part.box.high[axis])));
    }
  });

  it("are hidden and shown with all of them, in one short query", async () => {
    await choose(kFlat);
    const all = await inPage("s.volume.engine.select(v)", `under ${kFlat}`);
    assert.ok(all.length > 40);
    await inPage("s.view.set({ hide: [] })");
    await button("Hide").click();
    assert.deepEqual((await state()).hide, [`under "${kFlat}"`]);
    const hidden = await inPage("s.volume.index.features.filter((_, i) => s.view.hidden[i]).map(({ id }) => id)");
    assert.deepEqual(hidden.sort(), all.sort());
    await visit.page.locator(`svt-tree [role=treeitem][aria-selected=true] .eye.none`).waitFor();
    await button("Show").click();
    assert.deepEqual((await state()).hide, []);
    await reset();
  });

  it("are highlighted, and shown without the others, although rooms are hidden at first", async () => {
    await choose(kFlat);
    const whole = await picture();
    for (const name of ["Highlight", "Cut away to it", "Only this"]) {
      await button(name).click();
      const colored = await picture();
      await inPage("s.view.set({ styles: [{ select: v, color: '#ff00ff' }] })", `under ${kFlat}`);
      const share = await differs(colored, await picture());
      assert.ok(share > 0.01, `${name}: the flat covers ${share} of the picture`);
      assert.ok((await differs(whole, colored)) > 0.02, name);
      await inPage("s.view.set({ styles: [] })");
      await button(name).click();
    }
    assert.ok((await differs(whole, await picture())) === 0, "as before");
  });

  it("are cut away to and coloured as a whole", async () => {
    await choose(kStorey);
    await button("Cut away to it").click();
    await settled();
    assert.equal((await state()).effect, "cutaway");
    assert.equal(await inPage("s.messages.message"), null);
    assert.equal(
      await inPage(
        "document.querySelector('svt-app').shadowRoot.querySelector('svt-properties').shadowRoot.querySelector('svt-style-editor').query",
      ),
      `under "${kStorey}"`,
    );
    // So does the editor of its row in the tree.
    await visit.page.locator("svt-tree [role=tree]").focus();
    await visit.page.keyboard.press("c");
    const inTree = "document.querySelector('svt-app').shadowRoot.querySelector('svt-tree').shadowRoot.querySelector('svt-style-editor')";
    await visit.until(`${inTree}?.query === 'under "${kStorey}"'`);
    await visit.page.keyboard.press("c");
    await reset();
  });
});

describe("two selected features", () => {
  it("are compared in a table, with differences", async () => {
    await inPage("s.selection.select(v)", [kFlat, "tower_S01_F3"]);
    const table = visit.page.locator("#comparison");
    await table.waitFor();
    const rows = await table.locator("tr").evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent.trim())));
    const [a, b] = [kFlat, "tower_S01_F3"].map((id) => svtJson("query", at("tower.svt"), `id=${id}`, "--json")[0]);
    const volume = rows.find(([name]) => name === "Volume");
    assert.deepEqual(volume.slice(1), [
      `${a.totalVolume.toFixed(3)} m³`,
      `${b.totalVolume.toFixed(3)} m³`,
      `${(b.totalVolume - a.totalVolume).toFixed(3)} m³`,
    ]);
    const area = rows.find(([name]) => name === "floorArea");
    assert.match(area[3], /^[-+]?\d+\.\d\d m2$/);
    await visit.page.click("#language");
    await table.getByText("Differenz").waitFor();
    await visit.page.click("#language");
    await reset();
  });
});

describe("colours by value", () => {
  it("are a list with kinds and counts, and make rooms solid", async () => {
    await visit.tool("look");
    const options = await visit.page.locator("#color-by option").allInnerTexts();
    assert.ok(
      options.some((text) => /^floorArea: number, \d+ with a value$/.test(text)),
      options.join("; "),
    );
    assert.ok(
      options.some((text) => /^Floor area of rooms: number, \d+ with a value$/.test(text)),
      options.join("; "),
    );
    for (const key of ["area", "volume", "floorArea"]) {
      await visit.page.selectOption("#color-by", key);
      await settled();
      assert.equal((await state()).colorBy, key);
      assert.equal(await inPage("s.messages.message"), null, key);
      assert.ok(await inPage("s.volume.index.classes.get('BuildingRoom').every((i) => !s.view.hidden[i])"), `${key}: rooms are shown`);
      await until("s.picture.scale");
    }
    await visit.page.selectOption("#color-by", "");
    const { hide, show, styles } = await state();
    assert.deepEqual([hide.toSorted(), show, styles], [initial.hide.toSorted(), [], []]);
    await reset();
  });
});

describe("the selection", () => {
  const swatch = () =>
    inPage(
      "document.querySelector('svt-app').shadowRoot.querySelector('svt-properties').shadowRoot.querySelector('svt-style-editor').shadowRoot.querySelector('input[type=color]').value",
    );

  it("has its own colour in the panel", async () => {
    const [wall, slab] = ["tower_S01_wall_south", "tower_S01_slab"];
    const colorOf = (id) => inPage("s.volume.index.features[s.volume.index.byId.get(v)].color", id);
    assert.notEqual(await colorOf(wall), await colorOf(slab));
    for (const id of [wall, slab, wall]) {
      await choose(id);
      await eventually(async () => assert.equal(await swatch(), await colorOf(id)));
    }
    await reset();
  });

  it("is tinted on the screen, all of several, and nowhere else", async () => {
    await settled();
    const shot = () => visit.page.locator("svt-picture").screenshot();
    // The outline does not count.
    await inPage(
      "(() => { const sheet = new CSSStyleSheet(); sheet.replaceSync('svg.over { display: none }'); const root = document.querySelector('svt-app').shadowRoot.querySelector('svt-picture').shadowRoot; root.adoptedStyleSheets = [...root.adoptedStyleSheets, sheet]; })()",
    );
    const [before, saved, scene] = [await shot(), await picture(), await inPage("s.view.composed([320, 240])")];
    const shares = [];
    for (const ids of [["tower_S00_wall_east"], ["tower_S00_wall_east", "tower_S01_wall_east", "tower_S02_wall_east"]]) {
      await inPage("s.selection.select(v)", ids);
      await until("s.picture.quality === null || s.picture.quality !== 'fine'");
      await settled();
      shares.push(await differs(before, await shot()));
      assert.deepEqual(await picture(), saved);
      assert.deepEqual(await inPage("s.view.composed([320, 240])"), scene);
    }
    assert.ok(shares[0] > 0.005 && shares[1] > 2 * shares[0], `${shares}`);
    await reset();
  });

  it("of a class or a query stays a query when it is hidden, shown or part of the address", async () => {
    await visit.page.locator("svt-tree #tab-classes").click();
    await visit.page.locator("svt-tree .classes").getByRole("button", { name: "BuildingRoom", exact: true }).click();
    const n = await inPage("s.view.state.selection.length");
    await button("Only this").click();
    assert.deepEqual((await state()).show, ["class=BuildingRoom"]);
    assert.equal(await visit.page.locator("svt-tree #shown span").innerText(), `Shown: ${n} rooms`);
    await visit.page.locator("svt-tree #shown").getByRole("button", { name: "Show all" }).click();
    assert.deepEqual((await state()).hide, initial.hide);
    const query = "voxels>100 and not class=BuildingRoom";
    await visit.page.fill("svt-tree #query", query);
    await visit.page.locator("svt-tree #query").press("Enter");
    await until(`s.view.state.selectedBy === '${query}'`);
    const large = await inPage("s.view.state.selection");
    assert.ok(large.length > 100);
    await button("Hide").click();
    assert.ok((await state()).hide.includes(query));
    const hidden = await inPage("s.volume.index.features.filter((f, i) => f.count && s.view.hidden[i] && !f.isSpace).map(({ id }) => id)");
    assert.deepEqual(hidden.sort(), large.sort());
    await inPage("s.address.write()");
    const address = visit.page.url();
    assert.ok(address.length < 2000, `${address.length} characters`);
    await visit.page.goto("about:blank");
    await visit.page.goto(address);
    await visit.firstImage();
    await until(
      `s.view.state.selection.length === ${large.length} && s.view.hidden.some((h, i) => h && !s.volume.index.features[i].isSpace)`,
    );
    await reset();
  });
});

describe("walking", () => {
  it("takes the keyboard at once, and gives the field of view back", async () => {
    const { fieldOfView } = (await state()).camera;
    await visit.tool("views");
    await visit.page.locator("#walk").check();
    await until("s.view.state.camera.fieldOfView === 65");
    const { eye } = (await state()).camera;
    await visit.page.keyboard.down("w");
    await until(`s.view.state.camera.eye[0] !== ${eye[0]} || s.view.state.camera.eye[1] !== ${eye[1]}`);
    await visit.page.keyboard.up("w");
    await visit.page.keyboard.press("0");
    await until(`!s.view.isWalking && s.view.state.camera.fieldOfView === ${fieldOfView}`);
    await inPage("s.view.tool = null");
    await reset();
  });
});

describe("a choice that cannot be drawn", () => {
  const follows = async () => {
    await inPage("s.view.turn({ ...s.view.state.camera, eye: s.view.state.camera.eye.map((e) => e + 0.01) })");
    await until("s.picture.camera && s.picture.camera === s.view.state.camera");
  };

  it("is taken back, says so, and can be repaired", async () => {
    await inPage("s.view.set({ colorBy: 'area' })");
    await visit.message("This cannot be drawn");
    await until("s.view.state.colorBy === ''");
    await follows();
    await visit.page.locator("#message").getByRole("button", { name: "Make rooms solid" }).click();
    await settled();
    assert.equal((await state()).colorBy, "area");
    assert.equal(await inPage("s.messages.message"), null);
    await reset();
    await inPage("s.view.set({ show: ['under nothing here at all'] })");
    await visit.message("This cannot be drawn");
    await until("s.view.state.show.length === 0");
    await follows();
    await inPage("s.view.undo()");
    assert.deepEqual((await state()).show, [], "no step leads back to it");
    await reset();
  });

  it("never freezes the picture, whatever 200 choices come", async (t) => {
    visit.problems.length = 0;
    // A small picture, so that hundreds of them take little time.
    await visit.page.setViewportSize({ width: 860, height: 320 });
    for (const [n, model] of ["tower", "house", "district"].entries()) {
      if (n > 0) {
        await visit.page.locator("header select").selectOption(model);
        await until(`s.volume.name === '${model}' && s.view.state.camera && s.picture.report`);
      }
      let seed = 17 + n;
      const random = (most) => ((seed = (seed * 1103515245 + 12345) % 2147483648), Math.floor((seed / 2147483648) * most));
      const ids = await inPage("s.volume.index.features.map(({ id }) => id)");
      const classes = await inPage("[...s.volume.index.classes.keys()]");
      const keys = [
        "class",
        "storey",
        "volume",
        "area",
        "name",
        "owner",
        "floorArea",
        "nothing",
        "",
        ...(await inPage("s.volume.info.attributes")),
      ];
      const pick = (list) => list[random(list.length)];
      const actions = [
        () => ["s.selection.select([v])", pick(ids)],
        () => ["s.selection.select([v], true)", pick(ids)],
        () => [
          "s.selection.select(s.volume.index.classes.get(v).map((i) => s.volume.index.features[i].id), false, 'class=' + v)",
          pick(classes),
        ],
        () => ["s.view.hideSelected(v)", random(2) === 0],
        () => ["s.view.state.selection.length && s.view.showOnlySelected()"],
        () => ["s.view.showOthers()"],
        () => ["s.view.set({ effect: v, focus: { ...s.view.state.focus, query: '' } })", pick(["none", "lens", "highlight", "cutaway"])],
        () => ["s.view.set({ focus: { ...s.view.state.focus, query: v } })", pick(["", `id="${pick(ids)}"`, "name=gone", "(("])],
        () => ["s.view.set({ colorBy: v })", pick(keys)],
        () => ["s.view.set({ styles: [{ select: v, opacity: 0.4, color: '#336699' }] })", `class=${pick(classes)}`],
        () => ["s.view.set({ styles: [], hide: [], show: [] })"],
        () => ["s.view.set({ shell: v })", pick([null, "component", "room", "unit", "storey", "building"])],
        () => ["s.view.set({ sections: v ? [{ axis: 'z', at: v, flip: false, turn: 0, tilt: 90 }] : [] })", random(4)],
        () => ["s.view.set({ regions: v })", pick([[], ["z>1"], ["nonsense"], ["ball(1,2,3,4)"]])],
        () => ["s.view.set({ names: v })", random(2) === 0],
        () => ["s.view.set({ wireframe: v })", pick([null, "faint", "dashed"])],
        () => ["s.view.undo()"],
        () => ["s.view.redo()"],
        () => ["s.view.goToSelected()"],
      ];
      const done = [];
      for (let step = 0; step < 200; ++step) {
        const [body, value] = pick(actions)();
        done.push(`${body} ${JSON.stringify(value)}`);
        await inPage(`void (${body})`, value);
        try {
          await follows();
        } catch (error) {
          throw new Error(`${model}, step ${step}: ${done.slice(-8).join("; ")}`, { cause: error });
        }
      }
      t.diagnostic(`${model}: 200 choices`);
    }
    await visit.page.setViewportSize({ width: 1200, height: 640 });
    assert.deepEqual(
      visit.problems.filter((text) => text.startsWith("error")),
      [],
    );
  });
});
