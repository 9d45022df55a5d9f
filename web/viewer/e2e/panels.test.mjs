// Panels and tools beside the picture: attributes, actions, context menus, the table of objects, findings.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { repository, serve, svt, svtJson, withModels } from "./harness.mjs";
import { scratch, Visit } from "./visit.mjs";

const { at, drop } = scratch("svt-panels-test-");
const visit = new Visit();
const { inPage, state, settled, stage, until, eventually } = visit;
let server;
const open = (options = {}, model = "house") => visit.open(`${server.url}?model=${model}`, options);
/** The id of the feature with a name. */
const idOf = (name) => inPage("s.volume.index.features.find((f) => f.name === v).id", name);
const choose = async (name) => {
  await inPage("s.selection.select([v])", await idOf(name));
  await until("s.selection.properties");
};

const axe = readFileSync(join(repository, "web/viewer/node_modules/axe-core/axe.min.js"), "utf8");
async function axeFindings() {
  await visit.page.evaluate(axe);
  const { violations } = await visit.page.evaluate(() => globalThis.axe.run(document, { resultTypes: ["violations"] }));
  return violations
    .filter(({ impact }) => ["serious", "critical"].includes(impact))
    .map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.flat().join(" ")).join(" | ")}`);
}

before(async () => {
  svt("sample", "house", "-o", at("house.ifc"));
  // A long name of a property, as programs write them.
  const ifc = readFileSync(at("house.ifc"), "utf8").replaceAll(
    "IFCPROPERTYSINGLEVALUE('material'",
    "IFCPROPERTYSINGLEVALUE('Building material / multilayered structure / profile / hatch of this component'",
  );
  writeFileSync(at("house.ifc"), ifc);
  svt("build", at("house.ifc"), "-o", at("house.svt"), "--spacing", "0.2");
  svt("sample", "tower", "--storeys", "3", "-o", at("tower.gml"));
  svt("build", at("tower.gml"), "-o", at("tower.svt"), "--spacing", "0.4");
  server = await serve(withModels(["house", "tower"].map((name) => ({ name, path: at(`${name}.svt`), title: name }))));
});
after(async () => {
  await visit.close();
  await server?.close();
  drop();
});

describe("attributes", () => {
  const list = () => visit.page.locator("svt-attributes");

  it("are in foldable groups; quantities stand beside measured values", async () => {
    await open();
    await choose("Entrance door");
    const group = (name) => list().locator(`details[data-group="${name}"]`);
    await group("Sample").waitFor();
    assert.equal(await group("material").locator("dd").innerText(), "timber");
    const [row] = svtJson("query", at("house.svt"), 'name="Entrance door"', "--with", "volume", "--json");
    const cells = await group("quantities").locator("tbody tr").first().locator("td").allInnerTexts();
    assert.ok(Math.abs(parseFloat(cells[0]) - row.attributes["BaseQuantities.NetVolume"]) < 1e-5, cells.join());
    assert.match(cells[0], / m³$/);
    assert.equal(cells[1], `${row.volume.toFixed(3)} m³`);
    const summary = group("material").locator("summary");
    await summary.focus();
    await visit.page.keyboard.press("Enter");
    await group("material").locator("dd").waitFor({ state: "hidden" });
    // It stays folded for the next object.
    await choose("Door living room");
    assert.equal(await group("material").locator("dd").isVisible(), false);
    await group("material").locator("summary").click();
    await group("material").locator("dd").waitFor();
  });

  it("have a filter, and long names wrap beside values that stay visible", async () => {
    await list().locator("#filter").fill("multilayered timber");
    assert.equal(await list().locator("dt").count(), 1);
    const box = await list().boundingBox();
    for (const part of ["dt", "dd"]) {
      const { x, width } = await list().locator(part).boundingBox();
      assert.ok(x >= box.x - 1 && x + width <= box.x + box.width + 1, part);
      assert.ok(width > 40, `${part} is ${width} wide`);
    }
    await list().locator("#filter").fill("no such thing");
    await list().getByText("No attribute matches.").waitFor();
    await list().locator("#filter").fill("");
  });

  it("name what the object touches, in buttons that select", async () => {
    await choose("Hidden beam");
    const { neighbours } = await inPage("s.selection.properties");
    assert.ok(neighbours.length > 1);
    const shown = await visit.page.locator("svt-properties ul li").allInnerTexts();
    for (const { name, id } of neighbours.filter(({ name }) => name)) {
      assert.ok(
        shown.some((text) => text.includes(name)),
        `${name}: ${shown}`,
      );
      assert.ok(!shown.some((text) => text.includes(id)), id);
    }
    const first = neighbours.find(({ name, id }) => name && id);
    await visit.page.locator("svt-properties").getByRole("button", { name: first.name }).first().click();
    assert.deepEqual((await state()).selection, [first.id]);
  });

  it("know where the object is, in buttons that select", async () => {
    await open({}, "tower");
    await inPage("s.selection.select([s.volume.index.features.find((f) => f.class === 'BuildingRoom').id])");
    const path = visit.page.getByRole("navigation", { name: "Where it is" });
    const kinds = await inPage("s.volume.index.features.filter((f) => /Storey|Unit/.test(f.class)).map((f) => [f.name || f.id, f.class])");
    const names = await path.getByRole("button").allInnerTexts();
    const classes = names.map((name) => kinds.find(([known]) => known === name)?.[1] ?? "Building");
    assert.deepEqual(classes.slice(0, 3), ["Building", "Storey", "BuildingUnit"], names.join(" > "));
    await path.getByRole("button").nth(1).click();
    assert.equal(await inPage("s.selection.only.class"), "Storey");
  });
});

describe("actions", () => {
  before(() => open());
  const palette = () => visit.page.getByRole("dialog", { name: "Actions" });
  const ask = async (words) => {
    await visit.page.keyboard.press("Control+k");
    await palette().locator("input:focus").waitFor();
    await visit.page.keyboard.type(words);
  };

  it("are found by Ctrl and K, and run by Enter", async () => {
    await ask("views top");
    assert.equal(await palette().getByRole("option").count(), 1);
    await visit.page.keyboard.press("Enter");
    await palette().waitFor({ state: "hidden" });
    await eventually(async () => {
      const { eye, target } = (await state()).camera;
      assert.ok(Math.hypot(eye[0] - target[0], eye[1] - target[1]) < 0.01 * (eye[2] - target[2]));
    });
  });

  it("include controls of the tools, and storeys", async () => {
    await ask("copy link");
    await visit.page.keyboard.press("Enter");
    await visit.message("Copied");
    await ask("cut ground floor");
    await visit.page.keyboard.press("Enter");
    await eventually(async () => assert.equal((await state()).sections[0]?.axis, "z"));
    await visit.page.keyboard.press("Control+z");
    await eventually(async () => assert.equal((await state()).sections.length, 0));
  });

  it("are offered only if they are possible, and Escape closes the list without another effect", async () => {
    await choose("Hidden beam");
    await ask("copy the id");
    await palette().getByRole("option", { name: "Copy the id" }).waitFor();
    await visit.page.keyboard.press("Escape");
    await palette().waitFor({ state: "hidden" });
    assert.equal((await state()).selection.length, 1);
    await inPage("s.selection.select([])");
    await ask("copy the id");
    await palette().getByText("No action matches.").first().waitFor();
    await visit.page.keyboard.press("Escape");
  });

  it("share their keys: each key has one action", async () => {
    const texts = await inPage("(await (async () => { const app = document.querySelector('svt-app'); app.openPalette(); return 1; })())");
    assert.equal(texts, 1);
    await palette().waitFor();
    const keys = (await palette().locator("kbd").allInnerTexts()).map((key) => key.trim());
    assert.deepEqual([...new Set(keys)].length, keys.length, keys.join());
    for (const key of ["X", "C", "V", "K", "M", "N", "B", "1", "7", "0", "G", "/", "?", "T"])
      assert.ok(keys.includes(key), `${key} in ${keys}`);
    await visit.page.keyboard.press("Escape");
  });
});

describe("context menus", () => {
  before(() => open());
  const menu = () => visit.page.getByRole("menu");
  const item = (name) => menu().getByRole("menuitem", { name });

  it("open by a right click on the picture, for the object there", async () => {
    await settled();
    const box = await stage();
    await visit.page.mouse.click(box.x + box.width / 2, box.y + box.height / 2, { button: "right" });
    await menu().waitFor();
    const pick = await inPage("s.volume.engine.pick(0.5, 0.5)");
    assert.deepEqual((await state()).selection, [pick.id]);
    await item(/^Copy the id/).click();
    await menu().waitFor({ state: "hidden" });
    assert.equal(await visit.page.evaluate(() => navigator.clipboard.readText()), pick.id);
  });

  it("do not open after a drag, and close by a click elsewhere", async () => {
    const box = await stage();
    const [x, y] = [box.x + box.width * 0.4, box.y + box.height * 0.4];
    await visit.page.mouse.move(x, y);
    await visit.page.mouse.down({ button: "right" });
    await visit.page.mouse.move(x + 60, y + 20, { steps: 4 });
    await visit.page.mouse.up({ button: "right" });
    await settled();
    assert.equal(await menu().isVisible(), false);
    await visit.page.mouse.click(x, y, { button: "right" });
    await menu().waitFor();
    const { selection } = await state();
    await visit.page.mouse.click(box.x + 8, box.y + 300);
    await menu().waitFor({ state: "hidden" });
    await visit.page.waitForTimeout(100);
    assert.deepEqual((await state()).selection, selection, "the click only closes the menu");
  });

  it("open by Shift and F10 in the picture and in the tree, and give the focus back", async () => {
    await choose("Entrance door");
    const tree = visit.page.getByRole("tree");
    await tree.focus();
    await visit.page.keyboard.press("Shift+F10");
    await menu().waitFor();
    assert.match(await menu().innerText(), /Entrance door/);
    await visit.page.keyboard.press("Escape");
    await menu().waitFor({ state: "hidden" });
    assert.equal(await tree.evaluate((element) => element === element.getRootNode().activeElement), true);
    await visit.page.locator("svt-picture .stage").focus();
    await visit.page.keyboard.press("Shift+F10");
    await menu().waitFor();
    await visit.page.keyboard.press("ArrowDown");
    await visit.page.keyboard.press("Enter");
    await menu().waitFor({ state: "hidden" });
    assert.ok(await inPage("s.view.isSelectionHidden"), "the second item hides");
    await visit.page.keyboard.press("h");
    assert.ok(!(await inPage("s.view.isSelectionHidden")));
  });

  it("select all of a type, and all of a storey", async () => {
    const row = visit.page.getByRole("treeitem", { name: /Entrance door/ });
    await row.click({ button: "right" });
    await item(/^Select all of this type \(IfcDoor\)/).click();
    const doors = svtJson("query", at("house.svt"), "ifcType=IfcDoor", "--json").map(({ id }) => id);
    assert.deepEqual((await state()).selection.toSorted(), doors.toSorted());
    await choose("Entrance door");
    await row.click({ button: "right" });
    await item(/^Select all of this storey \(Ground floor\)/).click();
    const { selection } = await state();
    const ground = svtJson("query", at("house.svt"), `under "${await idOf("Ground floor")}"`, "--json").map(({ id }) => id);
    assert.deepEqual(selection.toSorted(), ground.toSorted());
  });

  it("zoom to the object, and show only it", async () => {
    const row = visit.page.getByRole("treeitem", { name: /Entrance door/ });
    await choose("Entrance door");
    await row.click({ button: "right" });
    const id = await idOf("Entrance door");
    const { camera: before, hide } = await state();
    await item(/^Zoom to it/).click();
    const { low, high } = await inPage("s.volume.engine.properties(v).then(({ box }) => box)", id);
    await eventually(async () => {
      const { target } = (await state()).camera;
      assert.ok(
        target.every((x, i) => x >= low[i] - 0.1 && x <= high[i] + 0.1),
        `${target}, the door is from ${low} to ${high}`,
      );
    });
    assert.notDeepEqual((await state()).camera, before);
    await row.click({ button: "right" });
    await item(/^Only this/).click();
    assert.deepEqual((await state()).show, [`under "${id}"`]);
    await settled();
    await row.click({ button: "right" });
    await item(/^Show all/).click();
    assert.deepEqual((await state()).show, []);
    assert.deepEqual((await state()).hide, hide);
  });

  it("open by a long press", async () => {
    await open({ hasTouch: true, viewport: { width: 360, height: 740 } });
    await settled();
    const box = await stage();
    const touch = await visit.page.context().newCDPSession(visit.page);
    const point = { x: box.x + box.width / 2, y: box.y + box.height / 2, id: 0 };
    await touch.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [point] });
    await menu().waitFor();
    await touch.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
    await item(/^List everything behind a point/).waitFor();
    assert.deepEqual(await axeFindings(), []);
    await item(/^List everything behind a point/).click();
    await until("s.selection.along?.stretches.length > 1");
  });
});

describe("the table of objects", () => {
  before(() => open());
  const table = () => visit.page.getByRole("grid", { name: "Table of objects" });
  const column = async (n) => {
    const rows = await table().locator(".line").all();
    return Promise.all(rows.slice(0, 12).map((row) => row.locator("[role=gridcell]").nth(n).innerText()));
  };

  it("has attributes, is filtered and sorted, and selects", async () => {
    await visit.page.keyboard.press("t");
    await table().waitFor();
    const remove = visit.page.getByRole("button", { name: /^Remove the column/ });
    await eventually(async () => assert.equal(await remove.count(), 3));
    for (let n = 3; n > 0; --n) await remove.first().click();
    await visit.page.locator("#table-column").selectOption("BaseQuantities.NetVolume");
    await table()
      .getByRole("columnheader", { name: /BaseQuantities.NetVolume/ })
      .waitFor();
    await visit.page.locator("#table-class").selectOption("Door");
    const doors = svtJson("query", at("house.svt"), "class=Door", "--json");
    await visit.page.getByText(`${doors.length} of `).waitFor();
    const sort = table()
      .getByRole("button", { name: /NetVolume/ })
      .first();
    await sort.click();
    await sort.click();
    const last = (await table().getByRole("columnheader").count()) - 1;
    const expected = doors
      .map(({ attributes }) => attributes["BaseQuantities.NetVolume"])
      .filter((value) => value !== undefined)
      .toSorted((a, b) => b - a);
    const shown = (await column(last)).filter(Boolean).map(Number);
    assert.ok(expected.length > 2 && shown.length > 2);
    shown.forEach((value, n) => assert.ok(Math.abs(value - expected[n]) < 1e-5, `${shown} is not ${expected}`));
    await visit.page.fill("#table-filter", "entrance");
    await table().locator(".line").first().click();
    assert.deepEqual((await state()).selection, [await idOf("Entrance door")]);
    await visit.page.fill("#table-filter", "");
  });

  it("is worked by keyboard", async () => {
    await table().focus();
    await visit.page.keyboard.press("Home");
    await visit.page.keyboard.press("ArrowDown");
    await visit.page.keyboard.press("Enter");
    const second = await table().locator(".line").nth(1).locator("[role=gridcell]").nth(3).innerText();
    assert.deepEqual((await state()).selection, [second]);
  });

  it("is saved as CSV with all rows", async () => {
    await visit.page.locator("#table-class").selectOption("");
    const { name, bytes } = await visit.saved(() => visit.page.click("#table-save"));
    assert.equal(name, "objects.csv");
    const lines = bytes.toString().split("\r\n");
    const all = await inPage("s.volume.index.features.length");
    assert.equal(lines.length, all + 2);
    assert.match(lines[0], /^name,type,storey,id,/);
    assert.ok(lines.some((line) => line.startsWith("Entrance door,IfcDoor,Ground floor,")));
  });

  for (const [colorScheme, width] of /** @type {const} */ ([
    ["light", 1440],
    ["dark", 360],
  ]))
    it(`has no serious findings in ${colorScheme} at ${width} px, as the palette`, async () => {
      await open({ colorScheme, viewport: { width, height: 800 }, locale: "de-DE" });
      await visit.page.keyboard.press("t");
      await visit.page.getByRole("grid", { name: "Tabelle der Objekte" }).waitFor();
      await visit.page.waitForTimeout(300);
      const sides = await visit.page.evaluate(() => {
        const { shadowRoot } = document.querySelector("svt-app");
        return [shadowRoot.querySelector("main"), shadowRoot.querySelector("svt-table").shadowRoot.querySelector("header")].map(
          (e) => e.scrollWidth - e.clientWidth,
        );
      });
      assert.deepEqual(sides, [0, 0], "nothing reaches beyond the border");
      const found = await axeFindings();
      await visit.page.keyboard.press("Escape");
      await visit.page.click("#actions");
      await visit.page.getByRole("dialog", { name: "Aktionen" }).waitFor();
      found.push(...(await axeFindings()));
      await visit.page.keyboard.press("Escape");
      await choose("Entrance door");
      found.push(...(await axeFindings()));
      assert.deepEqual(found, []);
      assert.deepEqual(visit.problems, []);
    });

  it("bears 100,000 objects: the page holds only the rows in view", async () => {
    await open();
    await inPage(`(() => {
      const features = Array.from({ length: 100_000 }, (_, i) => ({
        id: "f" + i, class: "Class" + (i % 40), name: "Part " + i, parent: i === 0 ? "" : i % 100 === 1 ? "f0" : "f" + (i - ((i - 1) % 100)),
        depth: 0, first: i + 1, count: 1, color: "#808080", opacity: 1,
      }));
      s.model.take({ ...s.volume.info, features, attributes: [] }, s.view.state);
    })()`);
    await visit.page.keyboard.press("t");
    await table().waitFor();
    await visit.page.fill("#table-filter", "part 9999");
    await visit.page.getByText("19 of 100,000 objects").waitFor();
    await visit.page.fill("#table-filter", "");
    await table().focus();
    await visit.page.keyboard.press("End");
    await table().getByText("Part 99999", { exact: true }).waitFor();
    const rows = await table().locator(".line").count();
    assert.ok(rows < 80, `${rows} rows in the page`);
  });
});

describe("the tree", () => {
  it("has storeys first, and an icon for each kind", async () => {
    await open({}, "tower");
    const first = await inPage(`(() => {
      const { index } = s.volume;
      const tree = document.querySelector("svt-app").shadowRoot.querySelector("svt-tree");
      const parent = index.parent[index.features.findIndex((f) => /Storey/.test(f.class))];
      return tree.rows.shown.filter((i) => index.parent[i] === parent).map((i) => index.features[i].class);
    })()`);
    const others = first.findIndex((name) => !/Storey/.test(name));
    assert.ok(first.length > 3 && others >= 3, first.join());
    assert.ok(
      first.slice(others).every((name) => !/Storey/.test(name)),
      first.join(),
    );
    assert.ok((await visit.page.locator("svt-tree .kind svg path").count()) > 3);
  });
});

describe("messages", () => {
  const message = () => visit.page.locator("#message");

  it("leave the top of the picture free, go to the console, and end with the choice that caused them", async () => {
    for (const width of [1440, 390]) {
      await open({ viewport: { width, height: 800 } });
      await settled();
      await inPage("s.messages.refuse({ code: 'E123', message: 'This cannot be drawn.' }, 'A title', [])");
      await message().waitFor();
      const [picture, box] = [await stage(), await message().boundingBox()];
      assert.ok(box.y > picture.y + picture.height / 2, `${width}: the message is at ${box.y}`);
      assert.deepEqual(
        visit.problems.filter((text) => text.includes("svt:")),
        ["warning: svt: A title: E123: This cannot be drawn."],
      );
      await inPage("s.view.set({ camera: { ...s.view.state.camera } })");
      await visit.page.waitForTimeout(100);
      assert.ok(await message().isVisible(), "the camera is not the cause");
      await inPage("s.view.set({ look: 'paper' })");
      await message().waitFor({ state: "hidden" });
    }
  });

  it("end with the next action, unless they are about the model", async () => {
    await open();
    await settled();
    const actions = ["s.selection.select([s.volume.index.features[3].id])", "s.view.tool = 'look'", "s.view.set({ look: 'paper' })"];
    for (const action of actions) {
      await inPage("s.messages.fail({ code: 'E503', message: 'This plane cuts nothing.' })");
      await message().waitFor();
      await inPage("s.view.set({ camera: { ...s.view.state.camera } })");
      await settled();
      assert.ok(await message().isVisible(), "a turn is no answer");
      await inPage(`void (${action})`);
      await message().waitFor({ state: "hidden" });
    }
    await inPage("s.messages.fail({ code: 'E101', message: 'Not there.' }, 'The model was not opened')");
    await message().waitFor();
    for (const action of actions.slice(0, 2)) await inPage(`void (${action.replace("[3]", "[4]").replace("look", "lens")})`);
    await settled();
    assert.ok(await message().isVisible());
    await visit.page.getByRole("button", { name: "Dismiss" }).click();
    await message().waitFor({ state: "hidden" });
  });
});

describe("findings", () => {
  it("are grouped by code with their number, and select the object that they name", async () => {
    await open();
    const id = await idOf("Entrance door");
    await inPage("(s.volume.info = { ...s.volume.info, findings: v })", [
      `warning E110 DanglingReference: house.gml:12 (id '${id}'): the link leads nowhere`,
      "warning E110 DanglingReference: house.gml:15: another link leads nowhere",
      "note E134 ProductsRead: house.ifc: 141 of 141 products with a shape were read",
    ]);
    const group = visit.page.locator('svt-findings details[data-code="E110"]');
    await group.getByText("warning E110 DanglingReference: 2").click();
    await group
      .getByRole("button", { name: /the link leads nowhere/ })
      .first()
      .click();
    assert.deepEqual((await state()).selection, [id]);
  });
});
