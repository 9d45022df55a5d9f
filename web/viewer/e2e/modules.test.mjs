// The modules of a visit: one that draws comes first; the whole one follows, for models, drawings and sheets. The module of reports
// measures quantities: rows, sums, selection and files, against `svt quantities`.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { describe, it } from "node:test";
import { svt } from "./harness.mjs";
import { withHouse } from "./visit.mjs";

const { at, visit, address, open } = withHouse("modules");
const { inPage, state, settled, eventually, tool, saved, drop, until } = visit;

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
const kFont = /\.ttf$/;
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
    // The page has faces once the whole module and the font are there.
    await until("s.view.hasFaces");
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
    // Quantities and a comparison, with a module of their own, and the model that the page has kept.
    await visit.page.click("#quantities");
    await visit.page.locator("svt-quantities #quantities-notes").waitFor();
    await visit.page.click("#quantities");
    await visit.page.click("#compare");
    await visit.page.locator("svt-changes").waitFor();
    await visit.page.click("#compare");
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

  it("draw on without the font of names, and ask for it again", async () => {
    await visit.begin();
    await visit.page.context().route(kFont, (route) => route.abort());
    await visit.page.goto(address());
    await visit.firstImage();
    await until("s.view.hasFaces");
    await tool("look");
    await visit.page.selectOption("#color-by", "class");
    await visit.page.locator("#color-scale li").first().waitFor();
    await settled();
    assert.equal(await inPage("s.messages.message"), null, "the legend of the page needs no font");
    await inPage("s.view.set({ selection: [s.volume.info.features.find(({ count }) => count > 0).id] })");
    await settled();
    // Not check(): the choice is taken back at once.
    await visit.page.locator("#names").click();
    await visit.message("the font of names cannot be loaded");
    assert.equal((await state()).names, false);
    assert.equal((await state()).colorBy, "class");
    assert.ok(await inPage("s.view.hasFaces"));
    await settled();
    await visit.page.context().unroute(kFont);
    await visit.page.locator("#names").check();
    await settled();
    assert.equal((await state()).names, true);
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

describe("quantities", () => {
  const own = () => visit.page.locator("svt-quantities");
  const rows = () => own().locator("[role=row].line");
  const measured = () => own().locator("#quantities-notes").waitFor();
  const show = async () => {
    await visit.page.click("#quantities");
    await measured();
  };
  function expected(input, ending, ...options) {
    svt("quantities", at(input), "-q", "-o", at(`expected.${ending}`), ...options);
    return readFileSync(at(`expected.${ending}`));
  }
  const savedAs = async (ending) => saved(() => own().locator(`#quantities-save-${ending}`).click());

  it("are measured from the open volume, with the files of the command", async () => {
    await open();
    await show();
    const json = JSON.parse(expected("house.svt", "json").toString());
    assert.equal(await own().locator("#quantities-count").innerText(), `${json.rows.length} of ${json.rows.length}`);
    const csv = await savedAs("csv");
    assert.equal(csv.name, "house_quantities.csv");
    assert.ok(csv.bytes.equals(expected("house.svt", "csv")), "rows as CSV");
    await own().locator("#quantities-exterior").check();
    await own().locator("#quantities-formwork").fill("class=BuildingConstructiveElement");
    await own().locator("#quantities-run").click();
    await own().getByRole("columnheader", { name: "Exterior, north-east" }).waitFor();
    const options = ["--exterior", "--formwork", "class=BuildingConstructiveElement"];
    assert.ok((await savedAs("csv")).bytes.equals(expected("house.svt", "csv", ...options)), "areas as CSV");
    await own().locator("#quantities-by-0").selectOption("class");
    await own().locator("#quantities-by-1").selectOption("storey");
    // The table of objects has storeys, too.
    await own().locator("#quantities-sums[aria-checked=true]").waitFor();
    await own().getByRole("columnheader", { name: "Storey" }).waitFor();
    const sums = await savedAs("csv");
    assert.equal(sums.name, "house_sums.csv");
    assert.ok(sums.bytes.equals(expected("house.svt", "csv", ...options, "--by", "class,storey")), "sums as CSV");
    assert.ok((await savedAs("json")).bytes.equals(expected("house.svt", "json", ...options, "--by", "class,storey")), "all as JSON");
    await settled();
    await visit.shot("quantities-sums");
    assert.deepEqual(visit.problems, []);
  });

  it("are measured from a dropped model, and again from the next one", async () => {
    await open();
    await show();
    await visit.drop("own.gml", readFileSync(at("house.gml")));
    await until("s.volume.file === 'own.gml'");
    await own().getByRole("heading", { name: "Quantities: own.gml" }).waitFor();
    await measured();
    const csv = await savedAs("csv");
    assert.equal(csv.name, "own_quantities.csv");
    assert.ok(csv.bytes.equals(expected("house.gml", "csv")));
  });

  it("are sorted and filtered; a row selects its object, a sum all of its objects, and the picture a row", async () => {
    await open();
    await show();
    const json = JSON.parse(expected("house.svt", "json", "--by", "class").toString());
    const largest = json.rows.reduce((a, b) => (b.netVolume > a.netVolume ? b : a));
    const sort = own().getByRole("columnheader", { name: "Net volume m³" }).getByRole("button");
    await sort.click();
    await sort.click();
    await rows().first().click();
    await until(`s.view.state.selection.includes(${JSON.stringify(largest.id)})`);
    assert.equal(await rows().first().getAttribute("aria-selected"), "true");
    const unknown = json.rows.find(({ grossVolume }) => grossVolume === null);
    await own().locator("#quantities-filter").fill(unknown.id);
    const cells = await rows().first().locator("[role=gridcell]").allInnerTexts();
    const titles = await own().locator("[role=columnheader]").allInnerTexts();
    assert.equal(cells[titles.indexOf("Gross volume m³")], "–", "unknown, not 0");
    await own().locator("#quantities-filter").fill("nowhere at all");
    assert.equal(await rows().count(), 0);
    await own().locator("#quantities-filter").fill("");
    // Selected elsewhere: its row comes into view.
    const last = json.rows.at(-1).id;
    await inPage("s.selection.select([v])", last);
    await own().locator(`.line[aria-selected=true] [title="${last}"]`).waitFor();
    await own().locator("#quantities-by-0").selectOption("class");
    await own().getByRole("grid", { name: "Sums" }).waitFor();
    await rows().first().click();
    const first = json.sums[0].by.class;
    const ids = json.rows.flatMap((row) => (row.class === first ? [row.id] : []));
    await eventually(async () => assert.deepEqual([...(await state()).selection].sort(), ids.sort()));
    assert.match(await own().locator(".foot").innerText(), new RegExp(`All ${json.rows.length} objects`));
  });

  it("work by keyboard alone, and end with the panel", async () => {
    await open();
    // The worker that waits for a first call does the work; no other one follows.
    await visit.page.waitForFunction(() => performance.getEntriesByName("svt-all-scripts").length > 0);
    await visit.page.keyboard.press("Control+k");
    await visit.page.locator("svt-palette input:focus").waitFor();
    await visit.page.keyboard.type("quantities");
    await visit.page.keyboard.press("Enter");
    await measured();
    await own().locator("#quantities-table").focus();
    await visit.page.keyboard.press("ArrowDown");
    await visit.page.keyboard.press("Enter");
    await until("s.view.state.selection.length === 1");
    assert.equal(await own().locator(".line.active").getAttribute("aria-rowindex"), "3");
    assert.ok(visit.page.workers().some((worker) => /reports_worker/.test(worker.url())));
    await own().locator("#quantities-close").press("Enter");
    await own().waitFor({ state: "detached" });
    await eventually(async () => assert.ok(!visit.page.workers().some((worker) => /reports_worker/.test(worker.url()))));
    assert.equal(await inPage("document.querySelector('svt-app').shadowRoot.activeElement.id"), "quantities");
  });

  it("give reasons: a wrong query, nothing selected, a comparison, a module that does not come", async () => {
    await open();
    await visit.page.context().route(/svt_reports-/, (route) => route.abort());
    await visit.page.reload();
    await visit.firstImage();
    await visit.page.click("#quantities");
    await visit.message("cannot be loaded");
    await visit.page.context().unroute(/svt_reports-/);
    await own().locator("#quantities-run").click();
    await measured();
    const count = await own().locator("#quantities-count").innerText();
    await own().locator("#quantities-where").fill("class=");
    await own().locator("#quantities-run").click();
    await visit.message("(E901)");
    assert.equal(await own().locator("#quantities-count").innerText(), count, "the last figures stay");
    await own().locator("#quantities-where").fill("class=Nothing");
    await own().locator("#quantities-where").press("Enter");
    await own().getByText("no objects are measured").waitFor();
    assert.equal(await rows().count(), 0);
    await open("?old=house&new=house");
    await visit.page.locator("svt-changes #changes-summary").waitFor();
    await until("s.volume.compared !== null");
    await visit.page.click("#quantities");
    await own().getByText("The open volume has two states.").waitFor();
    assert.equal(await own().locator("#quantities-run").count(), 0);
  });

  it("are stopped on request", async () => {
    await open();
    let release = () => {};
    const held = new Promise((done) => (release = () => done(null)));
    await visit.page.context().route(/svt_reports-.*wasm/, async (route) => (await held, route.continue().catch(() => {})));
    await visit.page.reload();
    await visit.firstImage();
    await visit.page.click("#quantities");
    await own().locator("#quantities-cancel").click();
    await own().getByText("Stopped.").waitFor();
    release();
    assert.equal(await own().locator("#measuring").count(), 0);
    await own().locator("#quantities-run").click();
    await measured();
  });

  for (const { colorScheme, width, height, locale } of [
    { colorScheme: "light", width: 1440, height: 900, locale: "en-US" },
    { colorScheme: "dark", width: 1440, height: 900, locale: "de-DE" },
    { colorScheme: "dark", width: 390, height: 844, locale: "de-DE" },
  ])
    it(`are accessible in ${colorScheme} at ${width} px`, async () => {
      await open("?model=house", { colorScheme, viewport: { width, height }, locale, hasTouch: width < 700 });
      await inPage("document.querySelector('svt-app').openQuantities()");
      await measured();
      await own().locator("#quantities-by-0").selectOption("storey");
      await own().locator("#quantities-objects").click();
      await rows().first().click();
      await settled();
      await visit.shot(`quantities-${colorScheme}-${width}`);
      const found = await visit.findings();
      for (const summary of await own().locator("summary").all()) await summary.click();
      await own().locator("#quantities-sums").click();
      await visit.shot(`quantities-notes-${colorScheme}-${width}`);
      found.push(...(await visit.findings()));
      assert.deepEqual(found, []);
      if (width < 700) assert.deepEqual(await visit.tooSmall("svt-quantities"), []);
    });
});
