// Fields of a volume: values of sensors over time, in the picture, at a place, and by component, as the command has them.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { after, before, describe, it } from "node:test";
import { serve, svt, svtJson, withModels } from "./harness.mjs";
import { scratch, Visit } from "./visit.mjs";

const { at, drop } = scratch("svt-fields-test-");
const visit = new Visit();
const { inPage, state, settled, stage, until, eventually, tool } = visit;
let server;
const open = (query = "?model=house", options = {}) => visit.open(server.url + query, options);
const field = () => visit.page.locator("svt-field");
const value = () => field().locator("#field-value").innerText();

before(async () => {
  svt("sample", "house", "-o", at("house.gml"));
  svt("build", at("house.gml"), "-o", at("house.svt"), "--spacing", "0.12", "--vectors", "edges,meshes");
  writeFileSync(at("places.csv"), "name,room\ns1,house_living\ns2,house_kitchen\n");
  writeFileSync(at("warm.csv"), "time,s1,s2\n0,20,23\n1800,21.5,25\n3600,23,\n");
  svt("field", "add", at("house.svt"), at("warm.csv"), "--places", at("places.csv"), "--unit", "Cel", "--name", "warm", "-q");
  svt("build", at("house.gml"), "-o", at("plain.svt"), "--spacing", "0.3", "--vectors", "edges,meshes");
  server = await serve(
    withModels([
      { name: "house", path: at("house.svt"), title: "Sample house" },
      { name: "plain", path: at("plain.svt"), title: "Without fields" },
    ]),
  );
});
after(async () => {
  await visit.close();
  await server?.close();
  drop();
});

/** Shows the field in a plan seen from above, by mouse. */
async function show() {
  await open();
  await inPage("s.view.set({ sections: [{ axis: 'z', at: 1.2, flip: false, turn: 0, tilt: 90 }] })");
  await inPage("s.view.goTo('', 'top')");
  await settled();
  await tool("look");
  await field().locator("#field").selectOption("warm");
  await until("s.picture.scale?.isRamp");
  await settled();
}

describe("a field", () => {
  it("colours the picture as the command does, with a legend, and is in links", async () => {
    await show();
    assert.deepEqual((await state()).field, { name: "warm" });
    const scene = await inPage("s.view.composed([480, 300])");
    writeFileSync(at("s.scene.json"), JSON.stringify(scene));
    svt("render", at("house.svt"), "-o", at("p.png"), "--scene", at("s.scene.json"), "-q");
    const bytes = await inPage("s.volume.engine.picture(v).then((png) => Array.from(new Uint8Array(png)))", scene);
    assert.ok(Buffer.from(bytes).equals(readFileSync(at("p.png"))), "the picture of the command");
    assert.equal(await visit.page.locator("#color-title").innerText(), "warm (°C), 0 s");
    assert.deepEqual(await visit.page.locator("#color-scale li").allInnerTexts(), ["from 20.00 to 25.00", "no value"]);
    await visit.shot("field");
    await visit.page.waitForFunction(() => location.hash.includes("view="));
    await visit.page.reload();
    await visit.firstImage();
    assert.deepEqual((await state()).field, { name: "warm" });
    await until("s.picture.scale?.isRamp");
    assert.deepEqual(visit.problems, []);
  });

  it("goes through its times by keys and by itself", async () => {
    await show();
    const text = () => field().locator("#field-time-text").innerText();
    assert.equal(await text(), "0:00:00");
    await visit.page.getByRole("slider", { name: "Time of the field" }).focus();
    await visit.page.keyboard.press("ArrowRight");
    await eventually(async () => assert.equal(await text(), "0:30:00"));
    assert.equal((await state()).field.time, 1800);
    await field().locator("#field-play").click();
    await eventually(async () => assert.equal((await state()).field.time, 3600));
    await eventually(async () => assert.equal((await state()).field.time, 0));
    await field().locator("#field-play").click();
    const { time } = (await state()).field;
    await settled();
    await visit.page.waitForTimeout(600);
    assert.equal((await state()).field.time, time, "it has stopped");
  });

  it("has its value at a click, with its course, and unknown values are not 0", async () => {
    await show();
    const place = await inPage(`(async () => {
      const { box } = await s.volume.engine.properties("house_kitchen");
      return [0, 1, 2].map((i) => (box.low[i] + box.high[i]) / 2);
    })()`);
    // In a parallel view from above, the middle of the kitchen is at the target of the camera.
    await inPage("s.view.set({ camera: { ...s.view.state.camera, parallel: true, height: 6, eye: [v[0], v[1], 30], target: v } })", place);
    await settled();
    const { x, y, width, height } = await stage();
    await visit.page.mouse.click(x + width / 2, y + height / 2);
    await eventually(async () => assert.match(await value(), /: 23 °C$/));
    await field().locator("svg.series path").waitFor();
    await visit.page.getByRole("slider", { name: "Time of the field" }).focus();
    await visit.page.keyboard.press("ArrowRight");
    await eventually(async () => assert.match(await value(), /: 25 °C$/));
    await visit.page.keyboard.press("ArrowRight");
    await eventually(async () => assert.match(await value(), /no value here$/));
    // A link may name a time between two of the field; pictures are linear there.
    await inPage("s.view.set({ field: { name: 'warm', time: 900 } })");
    await eventually(async () => assert.match(await value(), /: 24 °C$/));
    assert.equal(await field().locator("#field-time-text").innerText(), "0:15:00");
    await inPage("s.view.set({ field: { name: 'warm', time: 2700 } })");
    await eventually(async () => assert.match(await value(), /no value here$/));
  });

  it("has its values by component, as the command states them", async () => {
    await show();
    await field().locator("#field-rows summary").click();
    const expected = svtJson("field", "stats", at("house.svt"), "warm", "--by", "class=BuildingRoom", "--json");
    const rows = field().locator("#field-rows tbody tr");
    await eventually(async () => assert.ok((await rows.count()) >= 2));
    const cells = await rows.locator("td").allInnerTexts();
    const mean = (name) => Number(cells[cells.indexOf(name) + 1]);
    const stated = expected.filter((row) => row.time === 0 && row.mean !== null);
    assert.ok(stated.length >= 2, JSON.stringify(expected).slice(0, 300));
    for (const row of stated) assert.ok(Math.abs(mean(row.name) - row.mean) < 1e-3, `${row.name}: ${cells}`);
    await rows.first().locator("button").click();
    assert.equal((await state()).selection.length, 1);
    // A label that is scrolled out of the tool counts as missing.
    const found = await visit.findings();
    assert.deepEqual(
      found.filter((text) => text.includes("svt-field") && !text.startsWith("label-title-only")),
      [],
    );
    await visit.shot("field-rows");
  });

  it("has lines, ends, colours and figures, and gives way to colours by a key", async () => {
    await show();
    await field().locator("#field-lines").fill("0.5");
    await field().locator("#field-lines").press("Enter");
    await field().locator("#field-low").fill("18");
    await field().locator("#field-low").press("Enter");
    await field().locator("#field-map").selectOption("inferno");
    assert.deepEqual((await state()).field, { name: "warm", isolines: 0.5, range: [18, 25], map: "inferno" });
    await settled();
    await visit.page.locator("svt-color-legend").getByText("lines every 0.5").waitFor();
    await field().locator("#field-per").selectOption("mean");
    assert.deepEqual((await state()).field, { name: "warm", range: [18, 25], map: "inferno", per: "mean" });
    assert.ok(await field().locator("#field-lines").isDisabled(), "lines need the values at places");
    await visit.page.locator("#color-title").getByText("mean of warm").waitFor();
    await field().locator("#field-high").fill("17");
    await field().locator("#field-high").press("Enter");
    assert.deepEqual((await state()).field.range, [18, 25], "an end below the other one is refused");
    await visit.page.selectOption("#color-by", "class");
    assert.equal((await state()).field, null);
    await visit.page.keyboard.press("Control+z");
    await eventually(async () => assert.equal((await state()).field?.name, "warm"));
    await settled();
    assert.equal(await inPage("s.messages.message"), null);
  });

  it("is not offered without one, and a link to a missing one is taken back with a reason", async () => {
    await open("?model=plain");
    await settled();
    await tool("look");
    assert.equal(await field().count(), 0);
    await inPage("s.view.set({ field: { name: 'warm' } })");
    await visit.message("the open model has no field 'warm'");
    assert.equal((await state()).field, null);
    await settled();
  });
});
