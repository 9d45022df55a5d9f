// The tree of features, search and queries.
import assert from "node:assert/strict";
import { before, describe, it } from "node:test";
import { svtJson } from "./harness.mjs";
import { withHouse } from "./visit.mjs";

const { at, visit, open } = withHouse("tree");
const { inPage, state, eventually } = visit;

describe("tree and query", () => {
  before(() => open());

  it("finds by name and selects", async () => {
    await visit.page.fill("#search", "hidden beam");
    await visit.page.getByRole("treeitem", { name: /Hidden beam/ }).click();
    assert.deepEqual((await state()).selection, ["house_hidden_beam"]);
    await visit.page.getByRole("heading", { name: "Hidden beam" }).waitFor();
    const [row] = svtJson("query", at("house.svt"), "id=house_hidden_beam", "--with", "volume,surface", "--json");
    // The volume of the mesh comes first. That of the voxels has half a voxel along the surface as its bound.
    const bound = (row.ownSurface.area * Math.max(...(await inPage("s.volume.info.spacing")))) / 2;
    await eventually(async () =>
      assert.equal(
        (await visit.page.locator("#volume").innerText()).replace(/\s+/g, " "),
        `${row.solidVolume.toFixed(3)} m³ ${row.voxelVolume.toFixed(3)} ± ${bound.toFixed(3)} m³ by voxels`,
      ),
    );
    assert.equal(await visit.page.locator("#floor-area").count(), 0);
    await inPage("s.selection.select(v)", ["house_kitchen"]);
    const kitchen = svtJson("query", at("house.svt"), "all", "--areas", "--json").find(({ id }) => id === "house_kitchen");
    assert.ok(kitchen.exact);
    await visit.page
      .locator("#floor-area")
      .getByText(`${kitchen.area.toFixed(2)} m²`, { exact: true })
      .waitFor();
    await visit.page.fill("#search", "");
  });

  it("finds by what attributes say, and in German", async () => {
    const names = async () => (await visit.page.getByRole("treeitem").allInnerTexts()).join("|");
    await visit.page.fill("#search", "concrete");
    const found = await inPage("s.volume.engine.findInAttributes('concrete')");
    assert.ok(found.length > 0);
    await eventually(async () =>
      assert.match(await visit.page.locator("svt-tree [role=status]").first().innerText(), new RegExp(`^${found.length} found`)),
    );
    await visit.page.fill("#search", "fenster");
    assert.match(await names(), /Window|window/);
    await visit.page.fill("#search", "");
  });

  it("hides what is chosen, and a class; rooms are hidden at first", async () => {
    const item = visit.page.getByRole("treeitem", { name: /Hidden beam/ });
    const rooms = async () => inPage("s.view.describe([64, 36]).scene.passes[0].styles");
    assert.deepEqual((await state()).hide, ["class=BuildingRoom"]);
    await item.locator("button.eye").click();
    assert.deepEqual((await state()).hide, ["class=BuildingRoom", 'id="house_hidden_beam"']);
    await item.locator("button.eye").click();
    assert.deepEqual((await state()).hide, ["class=BuildingRoom"]);
    assert.equal(await rooms(), undefined);
    await visit.page.getByRole("tab", { name: "Classes" }).click();
    await visit.page.getByRole("button", { name: "Hide: BuildingRoom" }).click();
    assert.deepEqual((await state()).hide, []);
    assert.deepEqual(
      (await rooms()).map((style) => style.select),
      ["class=BuildingRoom"],
    );
    await visit.page.getByRole("button", { name: "Hide: BuildingRoom" }).click();
    assert.deepEqual((await state()).hide, ["class=BuildingRoom"]);
    await visit.page.getByRole("tab", { name: "Structure" }).click();
    // Rooms have a switch of their own; the note and its button are for all others.
    const showAll = visit.page.locator("svt-tree").getByRole("button", { name: "Show all" });
    assert.equal(await showAll.count(), 0);
    await item.locator("button.eye").click();
    await visit.page.locator("svt-tree").getByText("1 hidden").waitFor();
    await showAll.click();
    assert.deepEqual((await state()).hide, ["class=BuildingRoom"]);
    const spaces = visit.page.getByRole("checkbox", { name: /^Rooms and other spaces: \d+$/ });
    assert.equal(await spaces.isChecked(), false);
    await spaces.check();
    assert.deepEqual((await state()).hide, []);
    await item.locator("button.eye").click();
    await showAll.click();
    assert.deepEqual((await state()).hide, [], "visible rooms stay visible");
    await visit.page.keyboard.press("Control+k");
    await visit.page.keyboard.type("hide rooms and other");
    await visit.page.keyboard.press("Enter");
    assert.deepEqual((await state()).hide, ["class=BuildingRoom"]);
    await spaces.check();
  });

  it("groups parts by the values of an attribute, which are selected and hidden together", async () => {
    await visit.page.getByRole("tab", { name: "Classes" }).click();
    const rows = svtJson("query", at("house.svt"), "loadBearing=true", "--json").map(({ id }) => id);
    assert.ok(rows.length > 1);
    await visit.page.selectOption("#group-by", "loadBearing");
    const group = visit.page.locator("svt-groups li", { has: visit.page.getByRole("button", { name: "true", exact: true }) });
    await group.getByText(String(rows.length), { exact: true }).waitFor();
    await group.getByRole("button", { name: "true", exact: true }).click();
    assert.deepEqual([...(await state()).selection].sort(), [...rows].sort());
    const before = (await state()).hide;
    await group.getByRole("button", { name: "Hide: true" }).click();
    const hidden = await inPage("s.volume.index.features.filter((f, i) => f.count > 0 && s.view.hidden[i]).map((f) => f.id)");
    assert.deepEqual(rows.filter((id) => !hidden.includes(id)).length, 0);
    await group.getByRole("button", { name: "Hide: true" }).click();
    assert.deepEqual((await state()).hide, before);
    await inPage("s.selection.select([])");
    await visit.page.selectOption("#group-by", "");
    await visit.page.getByRole("tab", { name: "Structure" }).click();
  });

  it("names classes in German, and finds parts of IFC by German words", async () => {
    const names = () => visit.page.locator("svt-groups li button.name").allInnerTexts();
    await visit.page.click("#language");
    await visit.page.locator("#tab-classes").click();
    const german = await names();
    for (const word of ["Raum", "Fenster", "Tür", "Bauteil"]) assert.ok(german.includes(word), `${word}: ${german}`);
    assert.equal(await visit.page.locator("svt-groups li button.name", { hasText: "Raum" }).getAttribute("title"), "BuildingRoom");
    await visit.page.locator("#tab-structure").click();
    await visit.page.click("#language");
    await visit.page.locator("#tab-classes").click();
    assert.ok((await names()).includes("BuildingRoom"));
    await visit.page.locator("#tab-structure").click();
  });

  it("asks queries, and shows what is wrong with them", async () => {
    await visit.page.fill("#query", "class=BuildingRoom and volume>");
    await visit.page.keyboard.press("Enter");
    await visit.page.locator("#query-answer.error").waitFor();
    assert.match(await visit.page.locator("#query-answer").innerText(), /column|expected|value/i);
    await visit.page.fill("#query", "class=BuildingRoom and volume>20");
    await visit.page.keyboard.press("Enter");
    const expected = svtJson("query", at("house.svt"), "class=BuildingRoom and volume>20", "--json").map((row) => row.id);
    await visit.page.getByText(`${expected.length} selected`).first().waitFor();
    assert.deepEqual((await state()).selection, expected);
  });

  it("bears 100,000 features: the page holds the rows in view alone", async () => {
    await inPage(`(async () => {
      const features = Array.from({ length: 100_000 }, (_, i) => ({
        id: "f" + i, class: "Class" + (i % 40), name: "Part " + i, parent: i === 0 ? "" : i % 100 === 1 ? "f0" : "f" + (i - ((i - 1) % 100)),
        depth: 0, first: i + 1, count: 1, color: "#808080", opacity: 1,
      }));
      s.model.take({ ...s.volume.info, features }, s.view.state);
      const tree = document.querySelector("svt-app").shadowRoot.querySelector("svt-tree");
      await tree.updateComplete;
      s.selection.select(["f99999"]);
      await tree.updateComplete;
      s.view.hide([99999], true);
      await tree.updateComplete;
    })()`);
    await visit.page.getByRole("treeitem", { name: "Part 99999" }).waitFor();
    const rows = await visit.page.locator("[role=treeitem]").count();
    assert.ok(rows < 80, `${rows} rows in the page`);
  });
});
