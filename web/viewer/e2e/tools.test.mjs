// The tools: sections, lens, focus, look, measure; drawings are checked against the `svt` command.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { before, describe, it } from "node:test";
import { join } from "node:path";
import { deflateSync } from "node:zlib";
import { repository, svt } from "./harness.mjs";
import { readPng, writePng } from "./png.mjs";
import { withHouse } from "./visit.mjs";

const { at, visit, open } = withHouse("tools");
const { inPage, state, settled, stage, eventually, tool, saved } = visit;

const axe = readFileSync(join(repository, "web/viewer/node_modules/axe-core/axe.min.js"), "utf8");

describe("tools", () => {
  before(() => open());

  it("cut with planes that are dragged, slid and flipped", async () => {
    await tool("section");
    await visit.page.click("#add-plane");
    const before = (await state()).sections[0];
    assert.equal(before.axis, "y");
    const handle = visit.page.locator("svt-picture .handle");
    await handle.focus();
    await visit.page.keyboard.press("ArrowUp");
    assert.ok(Math.abs((await state()).sections[0].at - before.at - 0.05) < 1e-9);
    await settled();
    const box = await handle.boundingBox();
    await visit.page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await visit.page.mouse.down();
    await visit.page.mouse.move(box.x + box.width / 2 - 40, box.y + box.height / 2 + 30, { steps: 5 });
    await visit.page.mouse.up();
    await eventually(async () => assert.notEqual((await state()).sections[0].at, before.at + 0.05));
    await visit.page.getByRole("button", { name: "Other side" }).click();
    assert.equal((await state()).sections[0].flip, false);
    await visit.page.getByRole("button", { name: "Other side" }).click();
    await visit.page.getByRole("button", { name: "Cut Ground floor at 1.1 m" }).click();
    assert.deepEqual(
      (await state()).sections.map((s) => s.axis),
      ["y", "z"],
    );
    assert.match((await inPage("s.view.composed([640, 360])")).passes[0].cut, /^y<[\d.]+ or z>[\d.]+$/);
    await visit.page.getByRole("button", { name: "Remove plane 1" }).click();
  });

  it("are typed in metres or in the model's coordinates, and new ones lie beside old ones", async () => {
    const { sections } = await state();
    await inPage("s.view.set({ sections: [] })");
    await tool("section");
    for (let n = 0; n < 5; ++n) await visit.page.click("#add-plane");
    const free = (await state()).sections.filter((section) => section.axis === "free").map((section) => section.at);
    assert.equal(new Set(free).size, free.length, `planes lie on each other: ${free}`);
    // A new plane goes through the middle of the selection.
    await inPage("s.view.set({ sections: [], selection: [s.volume.info.features.find((f) => f.class === 'BuildingRoom').id] })");
    await visit.until("s.selection.properties?.class === 'BuildingRoom'");
    await visit.page.click("#add-plane");
    const { low, high } = await inPage("s.selection.properties.box");
    assert.ok(Math.abs((await state()).sections[0].at - (low[1] + high[1]) / 2) < 0.01);
    await inPage("s.view.set({ selection: [] })");
    await inPage("s.view.set({ sections: [{ axis: 'z', at: 1, flip: false, turn: 0, tilt: 90 }] })");
    await visit.page.locator(".plane input.at").fill("2.5");
    await visit.page.locator(".plane input.at").press("Enter");
    assert.equal((await state()).sections[0].at, 2.5);
    const lower = await inPage("s.volume.info.origin[2]");
    const world = visit.page.locator(".plane input.world");
    assert.equal(Number(await world.inputValue()), Number((2.5 + lower).toFixed(2)));
    await world.fill((lower + 1.25).toFixed(2));
    await world.press("Enter");
    assert.ok(Math.abs((await state()).sections[0].at - 1.25) < 0.006);
    await visit.page.locator(".plane input.at").fill("999");
    await visit.page.locator(".plane input.at").press("Enter");
    assert.ok((await state()).sections[0].at < 20, "no further than the building");
    await inPage("s.view.set({ sections: v })", sections);
  });

  it("export drawings as the command makes them", async () => {
    const { at: height } = (await state()).sections[0];
    for (const format of ["SVG", "DXF", "GEOJSON", "CSV"]) {
      const { bytes } = await saved(() => visit.page.getByRole("button", { name: `Export as ${format}` }).click());
      const file = at(`plan.${format.toLowerCase()}`);
      svt(
        "section",
        at("house.svt"),
        ...(format === "CSV" ? ["-o", at("x.svg"), "--table", file] : ["-o", file]),
        "--plane",
        `z>${Number(height.toFixed(4))}`,
      );
      assert.deepEqual(bytes.toString("utf8"), readFileSync(file, "utf8"), format);
    }
    for (const part of ["beyond", "above", "dimensions"]) await visit.page.locator(`#draw-${part}`).check();
    const { bytes } = await saved(() => visit.page.getByRole("button", { name: "Export as SVG" }).click());
    svt(
      "section",
      at("house.svt"),
      "-o",
      at("whole.svg"),
      "--plane",
      `z>${Number(height.toFixed(4))}`,
      "--beyond",
      "--above",
      "--dimensions",
    );
    assert.equal(bytes.toString("utf8"), readFileSync(at("whole.svg"), "utf8"), "with what stands beyond");
    const picture = await saved(() => visit.page.getByRole("button", { name: "Export as PNG" }).click());
    assert.equal(picture.bytes.subarray(1, 4).toString("latin1"), "PNG");
    assert.ok(picture.bytes.readUInt32BE(16) > 1500, "300 pixels to the inch");
    await visit.page.getByRole("button", { name: "Remove plane 1" }).click();
  });

  it("export sheets as the command makes them", async () => {
    const { bytes, name } = await saved(() => visit.page.locator("#draw-sheets").click());
    assert.equal(name, "sheets.zip");
    writeFileSync(at("sheets.zip"), bytes);
    execFileSync("python3", ["-m", "zipfile", "-e", at("sheets.zip"), at("unzipped")]);
    svt("sheets", at("house.svt"), "--svg", at("sheets"));
    const names = readdirSync(at("sheets")).sort();
    assert.deepEqual(readdirSync(at("unzipped")).sort(), names);
    for (const sheet of names)
      assert.equal(readFileSync(at(`unzipped/${sheet}`), "utf8"), readFileSync(at(`sheets/${sheet}`), "utf8"), sheet);
  });

  it("move a lens with the mouse and pin it", async () => {
    await tool("lens");
    const box = await stage();
    await visit.page.mouse.move(box.x + box.width * 0.7, box.y + box.height * 0.5);
    let lens;
    await eventually(async () => {
      lens = (await state()).lens;
      assert.ok(Math.abs(lens.x - 0.7) < 0.01 && Math.abs(lens.y - 0.5) < 0.01);
    });
    assert.equal((await state()).effect, "lens");
    await visit.page.keyboard.down("Shift");
    await visit.page.mouse.wheel(0, 200);
    await visit.page.keyboard.up("Shift");
    await eventually(async () => assert.ok((await state()).lens.radius < lens.radius));
    await visit.page.mouse.click(box.x + box.width * 0.7, box.y + box.height * 0.5);
    await visit.page.mouse.move(box.x + box.width * 0.6, box.y + box.height * 0.6);
    ({ lens } = await eventually(async () => (assert.ok((await state()).lens.pinned), await state())));
    assert.ok(lens.pinned && Math.abs(lens.x - 0.7) < 0.01);
    const scene = await inPage("s.view.composed([640, 360])");
    assert.equal(scene.passes.length, 2);
    assert.match(scene.passes[1].keep, /^view\(/);
    await settled();
    await visit.page.locator("#lens-on").click();
  });

  it("highlight, cut away to the selection, and leave hulls", async () => {
    await inPage("s.selection.select(['house_hidden_beam'])");
    await tool("focus");
    await visit.page.getByRole("radio", { name: "Highlight" }).click();
    let scene = await inPage("s.view.composed([640, 360])");
    assert.deepEqual(scene.passes[1].show, ['under "house_hidden_beam"']);
    await settled();
    await visit.page.getByRole("radio", { name: "Cut away" }).click();
    scene = await inPage("s.view.composed([640, 360])");
    assert.match(scene.passes[0].cut, /cutaway\(/);
    await settled();
    await visit.page.fill("#focus-query", "class=Nonsense");
    await visit.page.keyboard.press("Enter");
    await visit.page.locator("svt-focus-tool .error").waitFor();
    await visit.page.getByRole("radio", { name: "Off" }).click();
    await visit.page.selectOption("#shell", "storey");
    assert.equal((await inPage("s.view.describe([640, 360])")).scene.passes[0].shell, "storey");
    await settled();
    assert.equal(await inPage("s.messages.message"), null);
    await visit.page.selectOption("#shell", "");
  });

  it("change look, lines, names and legend", async () => {
    await tool("look");
    await visit.page.getByRole("radio", { name: "Blueprint" }).click();
    await visit.page.selectOption("#wireframe", "dashed");
    await visit.page.locator("#names").check();
    await visit.page.locator("#legend").check();
    await visit.page.locator("svt-legend li").first().waitFor();
    const scene = await inPage("s.view.composed([640, 360])");
    assert.equal(scene.look, "blueprint");
    assert.deepEqual(scene.passes[0].lines, [{ hidden: "dashed" }]);
    assert.deepEqual(scene.names, ['id="house_hidden_beam"']);
    await settled();
    assert.equal(await inPage("s.messages.message"), null);
    await visit.page.getByRole("radio", { name: "Plain" }).click();
    await visit.page.selectOption("#wireframe", "off");
    await visit.page.locator("#names").uncheck();
    await visit.page.locator("#legend").uncheck();
  });

  it("colours by storey, with a legend and an arrow to the north", async () => {
    await visit.page.selectOption("#color-by", "storey");
    await visit.page.locator("#north-arrow").check();
    await settled();
    const scene = await inPage("s.view.composed([640, 360])");
    assert.equal(scene.colorBy, "storey");
    assert.equal(scene.northArrow, true);
    assert.equal(await inPage("s.messages.message"), null);
    await visit.page.selectOption("#color-by", "");
    await visit.page.locator("#north-arrow").uncheck();
    await settled();
    assert.equal((await inPage("s.view.composed([640, 360])")).colorBy, undefined);
  });

  it("measure between picked points", async () => {
    await tool("measure");
    const box = await stage();
    await settled();
    const places = [
      [0.45, 0.5],
      [0.5, 0.55],
      [0.55, 0.5],
    ];
    for (const [n, [x, y]] of places.entries()) {
      await visit.page.mouse.click(box.x + box.width * x, box.y + box.height * y);
      await visit.page.waitForFunction((count) => document.querySelector("svt-app").session.view.state.measured.length === count, n + 1);
    }
    const [a, b, c] = await inPage("s.view.state.measured");
    const apart = (p, q) => Math.hypot(...p.map((v, i) => v - q[i]));
    assert.equal(await visit.page.locator("#measured-length").innerText(), `${(apart(a, b) + apart(b, c)).toFixed(3)} m`);
    assert.match(await visit.page.locator("#measured-area").innerText(), /^\d+\.\d{3} m²$/);
    await eventually(async () => assert.match(visit.page.url(), /view=/));
    const { inflateRawSync } = await import("node:zlib");
    await eventually(async () =>
      assert.deepEqual(
        JSON.parse(
          String(inflateRawSync(Buffer.from(new URLSearchParams(new URL(visit.page.url()).hash.slice(1)).get("view"), "base64url"))),
        ).measured,
        [a, b, c],
      ),
    );
    // They stay until they are removed.
    await visit.page.reload();
    await visit.page.waitForFunction(() => document.querySelector("svt-app")?.session?.picture.report);
    await settled();
    assert.deepEqual((await state()).measured, [a, b, c]);
    await tool("measure");
    await visit.page.getByRole("button", { name: "Clear" }).click();
    assert.deepEqual((await state()).measured, []);
  });

  it("measure from corner to corner of the model", async () => {
    await inPage("s.view.set({ measured: [] })");
    await inPage("s.view.goTo('', 'front')");
    await settled();
    // Near the place where a corner of the outer wall is seen, a few pixels beside it.
    const box = await stage();
    const corner = await inPage(`(async () => {
      for (let y = 0.3; y < 0.9; y += 0.01)
        for (let x = 0.1; x < 0.9; x += 0.01) {
          const pick = await s.volume.engine.pick(x, y, 0.25);
          if (pick?.snapped?.to === "corner") return { x, y, point: pick.snapped.point, on: pick.point };
        }
      return null;
    })()`);
    assert.ok(corner, "some corner of the model is seen");
    const off = Math.hypot(...corner.point.map((v, i) => v - corner.on[i]));
    assert.ok(off <= 0.25 && off > 0);
    const click = (modifiers) => visit.page.mouse.click(box.x + box.width * corner.x, box.y + box.height * corner.y, modifiers);
    await visit.page.keyboard.down("Control");
    await click();
    await visit.page.keyboard.up("Control");
    await visit.page.waitForFunction(() => document.querySelector("svt-app").session.view.state.measured.length === 1);
    const plain = (await state()).measured[0];
    assert.ok(Math.hypot(...plain.map((v, i) => v - corner.on[i])) < 0.05, "with Ctrl the point is where the ray hits");
    await click();
    await visit.page.waitForFunction(() => document.querySelector("svt-app").session.view.state.measured.length === 2);
    const snapped = (await state()).measured[1];
    assert.ok(Math.hypot(...snapped.map((v, i) => v - corner.point[i])) < 0.001, "without Ctrl it is the corner");
    assert.equal(await inPage("s.volume.engine.pick(0.5, 0.5).then((p) => p?.snapped ?? null)"), null);
    await inPage("s.view.set({ measured: [] })");
  });

  it("colour a class and make it glass", async () => {
    await visit.page.getByRole("tab", { name: "Classes" }).click();
    await visit.page.getByRole("button", { name: "Colour and opacity of BuildingConstructiveElement" }).click();
    const slider = visit.page.getByRole("slider", { name: "Opacity of BuildingConstructiveElement" });
    await slider.focus();
    await visit.page.keyboard.press("Home");
    assert.deepEqual((await state()).styles, [{ select: "class=BuildingConstructiveElement", opacity: 0 }]);
    await settled();
    await visit.page.getByRole("button", { name: "As in the model" }).click();
    assert.deepEqual((await state()).styles, []);
    await visit.page.getByRole("tab", { name: "Structure" }).click();
  });
});

describe("four views", () => {
  const page = () => visit.page;
  const panes = () => page().locator("svt-section-panes");
  const at = () => inPage("[...document.querySelector('svt-app').shadowRoot.querySelector('svt-section-panes').at]");
  /** The cuts of all scenes that have been drawn since the last call, each once. */
  const drawn = () => page().evaluate(() => [...new Set(globalThis.cuts.splice(0))].map((cut) => cut[0]).sort());
  const quiet = async () => {
    await settled();
    await visit.until("document.querySelector('svt-app').shadowRoot.querySelector('svt-section-panes').isComplete");
  };
  const paneBox = (name) => panes().locator(`#${name}`).boundingBox();

  before(async () => {
    await open();
    await page().evaluate(() => {
      const { engine } = document.querySelector("svt-app").session.volume;
      const picture = engine.picture;
      globalThis.cuts = [];
      engine.picture = (scene) => (globalThis.cuts.push(scene.passes[0].cut), picture(scene));
    });
  });

  it("open by a button, with sections through the middle", async () => {
    await page().click("#four");
    await panes().locator("#side canvas").waitFor({ state: "attached" });
    await quiet();
    assert.deepEqual(await drawn(), ["x", "y", "z"]);
    const size = await inPage("s.volume.info.size");
    (await at()).forEach((v, i) => assert.ok(Math.abs(v - size[i] / 2) < 0.2, `${v} of ${size[i]}`));
    const [plan, front, side, whole, app] = [
      await paneBox("plan"),
      await paneBox("front"),
      await paneBox("side"),
      await stage(),
      await page().locator("svt-app .middle.four").boundingBox(),
    ];
    assert.deepEqual([whole.width, plan.width, front.width, side.width].map(Math.round), Array(4).fill(Math.round(app.width / 2)));
    assert.ok(plan.x >= whole.x + whole.width - 1 && front.y >= whole.y + whole.height - 1);
    // A plan through the middle of the house shows walls, and the paper around it.
    for (const name of ["plan", "front", "side"]) {
      const { length } = await panes().locator(`#${name} canvas`).screenshot();
      assert.ok(length > 3000, `${name}: ${length} bytes`);
    }
  });

  it("draw only sections that a click has moved", async () => {
    const before = await at();
    const plan = await paneBox("plan");
    await page().mouse.click(plan.x + plan.width * 0.4, plan.y + plan.height * 0.4);
    const after = await at();
    assert.ok(after[0] < before[0] && after[1] > before[1] && after[2] === before[2], `${before} -> ${after}`);
    await quiet();
    assert.deepEqual(await drawn(), ["x", "y"]);
    // The lines of the plan cross where the click was.
    const x = Number(await panes().locator("#plan line").first().getAttribute("x1"));
    assert.ok(Math.abs(x - 40) < 0.5, `at ${x}`);
    // The camera of the 3D view moves no section.
    const { camera } = await state();
    await page().keyboard.press("2");
    await eventually(async () => assert.notDeepEqual((await state()).camera, camera));
    await quiet();
    assert.deepEqual(await drawn(), []);
    // A click in the 3D view moves all.
    const picture = await stage();
    const pick = await inPage("s.volume.engine.pick(0.45, 0.6)");
    await page().mouse.click(picture.x + picture.width * 0.45, picture.y + picture.height * 0.6);
    await eventually(async () => (await at()).forEach((v, i) => assert.ok(Math.abs(v - pick.point[i]) < 0.05, `${v}, ${pick.point[i]}`)));
    await quiet();
    assert.deepEqual(await drawn(), ["x", "y", "z"]);
  });

  it("zoom by the wheel and pan by a drag, each for itself", async () => {
    const [before, front] = [await at(), await paneBox("front")];
    const middle = [front.x + front.width / 2, front.y + front.height / 2];
    const line = async () => Number(await panes().locator("#front line").first().getAttribute("x1"));
    const was = await line();
    await page().mouse.move(middle[0], middle[1]);
    await page().mouse.wheel(0, -400);
    await eventually(async () => assert.ok(Math.abs((await line()) - 50) > 1.2 * Math.abs(was - 50)));
    const near = await line();
    await page().mouse.down();
    await page().mouse.move(middle[0] + 60, middle[1], { steps: 4 });
    await page().mouse.up();
    await eventually(async () => assert.ok(Math.abs((await line()) - near - 6000 / front.width) < 0.5));
    assert.deepEqual(await at(), before, "no click");
    await quiet();
    assert.deepEqual(await drawn(), ["y"]);
    await page().keyboard.press("0");
    await eventually(async () => assert.ok(Math.abs((await line()) - was) < 0.1));
  });

  it("go by keys, hide what is hidden, and end with Escape", async () => {
    await page().keyboard.press("Escape");
    await panes().waitFor({ state: "detached" });
    await page().keyboard.press("j");
    await panes().locator("#front .stage").focus();
    await quiet();
    await drawn();
    const before = await at();
    await page().keyboard.press("ArrowRight");
    await page().keyboard.press("ArrowUp");
    await page().keyboard.press("PageUp");
    const after = await at();
    assert.ok(after[0] > before[0] && Math.abs(after[1] - before[1] + 0.1) < 1e-6 && after[2] > before[2], `${before} -> ${after}`);
    assert.match(await page().locator("#said").textContent(), /^x [\d.]+, y [\d.]+, z [\d.]+ m$/);
    await quiet();
    assert.deepEqual(await drawn(), ["x", "y", "z"]);
    await page().evaluate(axe);
    const { violations } = await page().evaluate(() => globalThis.axe.run(document, { resultTypes: ["violations"] }));
    assert.deepEqual(
      violations.map(({ id, nodes }) => [id, nodes.map(({ target }) => target)]),
      [],
    );
    await inPage("s.view.set({ hide: [...s.view.state.hide, 'id=house_slab_1'] })");
    await quiet();
    assert.deepEqual(await drawn(), ["x", "y", "z"]);
    assert.deepEqual(visit.problems, []);
    await page().click("#four");
    await panes().waitFor({ state: "detached" });
    await settled();
  });

  it("begin at the selection, and fit a phone in German", async () => {
    await open("?model=house", { viewport: { width: 390, height: 844 }, locale: "de-DE" });
    await inPage("s.selection.select(['house_hidden_beam'])");
    await visit.until("s.selection.properties?.id === 'house_hidden_beam'");
    await page().keyboard.press("j");
    await panes()
      .getByRole("heading", { name: /^Grundriss: z = \d+,\d\d m$/ })
      .waitFor();
    const { low, high } = await inPage("s.selection.properties.box");
    (await at()).forEach((v, i) => assert.ok(v >= low[i] && v <= high[i], `${v} in ${low[i]} ... ${high[i]}`));
    const [plan, dock] = [await paneBox("side"), await page().locator("svt-app .dock").boundingBox()];
    assert.ok(plan.y + plan.height <= dock.y + 1, "above the tools");
    assert.ok(await page().evaluate(() => document.documentElement.scrollWidth <= innerWidth), "nothing to scroll");
  });
});

describe("a basemap", () => {
  const kRed = [210, 60, 50],
    kGreen = [60, 170, 80],
    kBlue = [50, 90, 200],
    kYellow = [230, 200, 60];
  /** Quarters: north-west red, north-east green, south-west blue, south-east yellow. */
  const quarters = (x, y) => (y < 32 ? (x < 32 ? kRed : kGreen) : x < 32 ? kBlue : kYellow);
  /** 40 m around the middle of the house at 5.5, 6: 64 pixels of 0.625 m; the first one's centre. */
  const [west, north] = [500000 + 5.5 - 20, 5400000 + 6 + 20];
  const worldFile = [0.625, 0, 0, -0.625, west + 0.3125, north - 0.3125].join("\n");
  /** @type {[number, number, number[]][]} */
  const around = [
    [-9, 21, kRed],
    [20, 21, kGreen],
    [-9, -9, kBlue],
    [20, -9, kYellow],
  ];

  before(() => open());

  const show = async () => {
    await tool("look");
    if (!(await visit.page.locator("svt-basemap").count())) await visit.page.click("#basemap");
    await visit.page.locator("#basemap-show").waitFor();
  };
  const choose = (...files) =>
    visit.page
      .locator("#basemap-file")
      .setInputFiles(files.map(({ name, bytes }) => ({ name, mimeType: "application/octet-stream", buffer: Buffer.from(bytes) })));
  /** A view with room around the house. */
  const stepBack = () =>
    inPage(
      "(async () => { await s.view.goTo('', 'iso'); const { camera } = s.view.state; s.view.turn({ ...camera, eye: camera.target.map((t, i) => t + 3 * (camera.eye[i] - t)) }); })()",
    );
  const laid = () => eventually(async () => assert.ok(await inPage("s.view.ground !== null && s.picture.quality === 'fine'")));
  /** Where a point of the model's coordinates, on the ground, is in the picture: 0..1. */
  const seen = async (east, north) =>
    inPage(
      `(() => {
        const { camera } = s.view.state, { origin } = s.volume.info, sub = (a, b) => a.map((x, i) => x - b[i]), dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
        const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]], unit = (a) => a.map((x) => x / Math.hypot(...a));
        const forward = unit(sub(camera.target, camera.eye)), right = unit(cross(forward, [0, 0, 1])), up = cross(right, forward);
        const d = sub([v[0] - origin[0], v[1] - origin[1], s.view.ground.height - origin[2]], camera.eye), half = Math.tan((camera.fieldOfView * Math.PI) / 360) * dot(d, forward);
        return [(1 + dot(d, right) / (half * s.view.aspect)) / 2, (1 - dot(d, up) / half) / 2];
      })()`,
      [east, north],
    );
  const colorsAt = async (points) => {
    const { width, height, channels, data } = readPng(await visit.page.locator("svt-picture").screenshot());
    return Promise.all(
      points.map(async ([east, north]) => {
        const [x, y] = await seen(east, north);
        assert.ok(x > 0 && x < 1 && y > 0 && y < 1, `${east}, ${north} is in the picture`);
        const at = (Math.floor(y * height) * width + Math.floor(x * width)) * channels;
        return [...data.slice(at, at + 3)];
      }),
    );
  };
  const isNear = (found, wanted) => found.every((value, i) => Math.abs(value - wanted[i]) < 25);
  const isSeen = async () => {
    const colors = await colorsAt(around.map(([x, y]) => [500000 + x, 5400000 + y]));
    for (const [n, [x, y, wanted]] of around.entries()) assert.ok(isNear(colors[n], wanted), `at ${x}, ${y}: ${colors[n]}, not ${wanted}`);
  };
  /** A TIFF with tags of GeoTIFF: compressed by deflate with differences of neighbours. */
  const geoTiff = (epsg) => {
    const rows = Buffer.alloc(64 * 64 * 3);
    for (let y = 0; y < 64; ++y)
      for (let x = 63; x >= 0; --x) quarters(x, y).forEach((v, c) => (rows[(y * 64 + x) * 3 + c] = v - (x ? quarters(x - 1, y)[c] : 0)));
    const data = deflateSync(rows);
    const doubles = (...values) => Buffer.from(new Float64Array(values).buffer);
    const shorts = (...values) => Buffer.from(new Uint16Array(values).buffer);
    /** @type {[number, number, Buffer | null][]} */
    const fields = [
      [256, 3, shorts(64)],
      [257, 3, shorts(64)],
      [258, 3, shorts(8, 8, 8)],
      [259, 3, shorts(8)],
      [262, 3, shorts(2)],
      [273, 4, null],
      [277, 3, shorts(3)],
      [278, 3, shorts(64)],
      [279, 4, Buffer.from(new Uint32Array([data.length]).buffer)],
      [317, 3, shorts(2)],
      [33550, 12, doubles(0.625, 0.625, 0)],
      [33922, 12, doubles(0, 0, 0, west, north, 0)],
      [34735, 3, shorts(1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, epsg)],
    ];
    const head = Buffer.alloc(8 + 2 + fields.length * 12 + 4);
    head.set([0x49, 0x49, 42, 0, 8, 0, 0, 0]);
    head.writeUInt16LE(fields.length, 8);
    /** @type {Buffer[]} */
    const parts = [head];
    let end = head.length;
    const kSize = { 3: 2, 4: 4, 12: 8 };
    for (const [n, [tag, type, given]] of fields.entries()) {
      const at = 10 + 12 * n,
        body = given ?? Buffer.alloc(4);
      head.writeUInt16LE(tag, at);
      head.writeUInt16LE(type, at + 2);
      head.writeUInt32LE(body.length / kSize[type], at + 4);
      if (given && body.length <= 4) body.copy(head, at + 8);
      else head.writeUInt32LE(end, at + 8);
      if (!given) head.writeUInt32LE(0, at + 8);
      if (given && body.length > 4) {
        parts.push(body);
        end += body.length;
      }
    }
    const strip = fields.findIndex(([tag]) => tag === 273);
    head.writeUInt32LE(end, 10 + 12 * strip + 8);
    return Buffer.concat([...parts, data]);
  };

  it("is a picture with a world file, at its place, only on the screen", async () => {
    const picture = () =>
      inPage("(async () => [...new Uint8Array(await s.volume.engine.picture(await s.view.composed([320, 180])))].join())()");
    await show();
    await stepBack();
    const before = await picture();
    await choose({ name: "ground.png", bytes: writePng(64, 64, quarters) }, { name: "ground.pgw", bytes: worldFile });
    await laid();
    await isSeen();
    if (process.env.SVT_SHOTS) await visit.page.screenshot({ path: join(process.env.SVT_SHOTS, "basemap.png") });
    assert.equal(await visit.page.locator("#ground-source").innerText(), "ground.png");
    assert.equal((await inPage("s.view.composed([320, 180])")).transparent, undefined);
    assert.ok((await picture()) === before, "a saved picture does not have it");
  });

  it("hides what is below it, and is hidden from below", async () => {
    await inPage("s.view.lay(s.view.ground.at(s.volume.info.origin[2] + 2))");
    await settled();
    assert.equal(await inPage("s.view.describe(s.view.size, 1, true).scene.passes[0].keep"), "z>2");
    assert.equal(await inPage("s.messages.message"), null);
    await visit.page.keyboard.press("7");
    await settled();
    assert.equal(await visit.page.locator("svt-ground canvas").isVisible(), false);
    assert.equal(await inPage("s.view.describe(s.view.size, 1, true).scene.transparent"), undefined);
    await visit.page.click("#basemap-remove");
    assert.equal(await visit.page.locator("svt-ground").count(), 0);
    await visit.page.keyboard.press("1");
    await settled();
  });

  it("is a GeoTIFF, unless it has another reference system", async () => {
    await show();
    await stepBack();
    await choose({ name: "other.tif", bytes: geoTiff(31468) });
    await visit.message(/EPSG:31468/);
    await choose({ name: "ground.tif", bytes: geoTiff(25832) });
    await laid();
    await isSeen();
    await visit.page.click("#basemap-remove");
    for (const [name, bytes, reason] of [
      ["broken.tif", geoTiff(25832).subarray(0, 150), /damaged/],
      ["text.png", Buffer.from("no picture"), /This browser cannot read the picture text\.png/],
    ]) {
      await choose({ name, bytes });
      await visit.message(reason);
    }
    await choose({ name: "plain.png", bytes: writePng(64, 64, quarters) });
    await visit.page.locator("#basemap-note").getByText("does not state its place").waitFor();
    await visit.page.fill("#basemap-extent", "0 0 40 40");
    await visit.page.click("#basemap-show");
    await visit.message(/does not lie below the model/);
    await visit.page.fill("#basemap-extent", `${west} ${north - 40} ${west + 40} ${north}`);
    await visit.page.keyboard.press("Enter");
    await laid();
    await isSeen();
    await visit.page.fill("#basemap-extent", "");
    await visit.page.click("#basemap-remove");
  });

  it("has tiles of an address, which is asked only when Show is pressed, and names their source", async () => {
    const asked = [];
    await visit.page.route("**/tiles/**", (route) => {
      const [z, x, y] = /\/tiles\/(\d+)\/(\d+)\/(\d+)\.png/.exec(route.request().url()).slice(1).map(Number);
      asked.push([z, x, y]);
      return route.fulfill({ contentType: "image/png", body: writePng(8, 8, () => [40 * (x % 6), 40 * (y % 6), 120]) });
    });
    await show();
    await stepBack();
    await visit.page.fill("#basemap-address", "tiles/{z}/{x}/{y}.png");
    await visit.page.fill("#basemap-attribution", "Map of the test");
    await visit.page.waitForTimeout(300);
    assert.deepEqual(asked, []);
    await visit.page.click("#basemap-show");
    await laid();
    assert.ok(asked.length > 4 && asked.length <= 64, `${asked.length} tiles`);
    assert.equal(await visit.page.locator("#ground-source").innerText(), "Map of the test");
    const [[z]] = asked;
    const points = around.map(([x, y]) => [500000 + x, 5400000 + y]);
    const colors = await colorsAt(points);
    const degrees = await inPage("s.volume.engine.places(v)", points);
    for (const [n, [longitude, latitude]] of degrees.entries()) {
      const sine = Math.sin((latitude * Math.PI) / 180);
      const at = [(longitude + 180) / 360, 0.5 - Math.log((1 + sine) / (1 - sine)) / (4 * Math.PI)].map((share) => share * 2 ** z);
      // A pixel at the border of a tile has the colours of both.
      if (at.some((v) => Math.abs(v - Math.round(v)) < 0.05)) continue;
      const wanted = [40 * (Math.floor(at[0]) % 6), 40 * (Math.floor(at[1]) % 6), 120];
      assert.ok(isNear(colors[n], wanted), `at ${points[n]}: ${colors[n]}, not ${wanted}`);
    }
    await visit.page.evaluate(axe);
    const { violations } = await visit.page.evaluate(() =>
      globalThis.axe.run({ include: { fromShadowDom: ["svt-app", "svt-look-tool", "svt-basemap"] } }, { resultTypes: ["violations"] }),
    );
    const serious = violations.filter(({ impact }) => impact === "serious" || impact === "critical");
    assert.deepEqual(
      serious.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join()}`),
      [],
    );
    await visit.page.click("#basemap-remove");
  });

  it("states why nothing comes from an address", async () => {
    await show();
    await visit.page.fill("#basemap-address", "https://tile.example.org/{z}/{x}/{y}.png");
    await visit.page.click("#basemap-show");
    await visit.message(/may not fetch pictures from https:\/\/tile\.example\.org.*--allow-images/);
    await visit.page.fill("#basemap-address", "missing.png");
    await visit.page.click("#basemap-show");
    await visit.message(/does not have a picture at this address/);
    await visit.page.fill("#basemap-address", "https://example.org/{z}/{x}");
    await visit.page.click("#basemap-show");
    await eventually(async () => assert.ok(await inPage("s.messages.message")));
    assert.equal(await inPage("s.view.ground"), null);
    await visit.page.fill("#basemap-address", "");
    await inPage("(s.messages.message = null, s.view.turn(s.view.state.camera))");
  });
});
