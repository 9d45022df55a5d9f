// Choosing in the picture: the view cube, rectangles, ranges, planes through faces, section boxes, measuring on cuts, the sun.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { before, describe, it } from "node:test";
import { repository, svt } from "./harness.mjs";
import { withHouse } from "./visit.mjs";

const { at, visit, open } = withHouse("choosing");
const { inPage, state, settled, stage, eventually, tool } = visit;

const axe = readFileSync(join(repository, "web/viewer/node_modules/axe-core/axe.min.js"), "utf8");
/** Findings of axe on the page as it stands. */
async function findings() {
  await visit.page.evaluate(axe);
  const { violations } = await visit.page.evaluate(() => globalThis.axe.run(document, { resultTypes: ["violations"] }));
  return violations
    .filter((v) => ["serious", "critical"].includes(v.impact))
    .map((v) => `${v.id}: ${v.nodes.map((n) => n.target.flat().join(" "))}`);
}
/** Direction from the target to the eye. */
async function direction() {
  const { eye, target } = (await state()).camera;
  const away = eye.map((v, i) => v - target[i]);
  return away.map((v) => Math.round((100 * v) / Math.hypot(...away)) / 100 + 0);
}
const seenFrom = (wanted) => eventually(async () => assert.deepEqual(await direction(), wanted));
const drag = async (from, to) => {
  const box = await stage();
  await visit.page.mouse.move(box.x + box.width * from[0], box.y + box.height * from[1]);
  await visit.page.mouse.down();
  await visit.page.mouse.move(box.x + box.width * to[0], box.y + box.height * to[1], { steps: 4 });
  await visit.page.mouse.up();
};
/** The part of the picture that is not background: left, top, right, bottom as fractions. */
const outline = () =>
  inPage(`(async () => {
    const bitmap = await createImageBitmap(new Blob([await s.volume.engine.picture(await s.view.composed([320, Math.round(320 / s.view.aspect)], 1))]));
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    const context = canvas.getContext("2d");
    context.drawImage(bitmap, 0, 0);
    const { data, width, height } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    let [left, top, right, bottom] = [width, height, 0, 0];
    for (let y = 0; y < height; ++y) for (let x = 0; x < width; ++x)
      if ([0, 1, 2].some((k) => data[4 * (y * width + x) + k] !== data[k])) [left, top, right, bottom] = [Math.min(left, x), Math.min(top, y), Math.max(right, x + 1), Math.max(bottom, y + 1)];
    return [left / width, top / height, right / width, bottom / height];
  })()`);

describe("the view cube", () => {
  before(() => open());

  it("chooses faces, edges and corners, and follows the camera", async () => {
    const area = (towards) => visit.page.locator(`svt-view-cube path[data-direction="${towards}"]`).first();
    await area("1,0,0").click();
    await seenFrom([1, 0, 0]);
    await eventually(async () =>
      assert.deepEqual(await visit.page.locator("svt-view-cube g").evaluateAll((all) => all.map((g) => g.dataset.face)), ["right"]),
    );
    await visit.page.keyboard.press("1");
    await area("0,-1,1").click();
    await seenFrom([0, -0.71, 0.71]);
    await visit.page.keyboard.press("1");
    await area("1,1,1").click();
    await seenFrom([0.58, 0.58, 0.58]);
    const box = await visit.page.locator("svt-view-cube .cube").boundingBox();
    await visit.page.mouse.move(box.x + 48, box.y + 48);
    await visit.page.mouse.down();
    await visit.page.mouse.move(box.x + 70, box.y + 48, { steps: 3 });
    await visit.page.mouse.up();
    assert.notDeepEqual(await direction(), [0.58, 0.58, 0.58]);
  });

  it("is one stop of the keyboard", async () => {
    await visit.page.keyboard.press("2");
    await seenFrom([0, -1, 0]);
    await visit.page.locator("svt-view-cube .cube").focus();
    await visit.page.keyboard.press("ArrowRight");
    await seenFrom([0.71, -0.71, 0]);
    await visit.page.keyboard.press("ArrowUp");
    await seenFrom([0.58, -0.58, 0.58]);
    assert.equal(await inPage("s.messages.said"), "Front, Right, Top");
    await visit.page.keyboard.press("ArrowUp");
    await seenFrom([0, 0, 1]);
    await visit.page.keyboard.press("Home");
    await seenFrom([0.58, -0.58, 0.58]);
  });

  it("fits the outline from above, in parallel too", async () => {
    await visit.page.keyboard.press("6");
    await seenFrom([0, 0, 1]);
    await visit.page.locator("#cube-parallel").click();
    await eventually(async () => assert.equal((await state()).camera.parallel, true));
    assert.equal(await visit.page.locator("#cube-parallel").getAttribute("aria-pressed"), "true");
    await settled();
    const [left, top, right, bottom] = await outline();
    // Named views have a margin of 3 percent at each side.
    const most = Math.max(right - left, bottom - top);
    assert.ok(most > 0.91 && most <= 0.95, `the house takes ${most} of the picture`);
    await visit.page.keyboard.press("p");
    await eventually(async () => assert.equal((await state()).camera.parallel, false));
  });
});

describe("selecting many", () => {
  before(() => open());

  it("in a rectangle takes objects inside, or objects that it touches", async () => {
    await visit.page.keyboard.press("2");
    await settled();
    await visit.page.keyboard.press("r");
    await visit.page.locator("svt-aim").waitFor();
    assert.deepEqual(await findings(), []);
    await drag([0.2, 0.2], [0.7, 0.8]);
    await eventually(async () => assert.ok((await state()).selection.length > 1));
    const inside = (await state()).selection;
    assert.equal(await visit.page.locator("svt-aim").count(), 0);
    await visit.page.locator("#cube-rectangle").click();
    await drag([0.7, 0.8], [0.2, 0.2]);
    await eventually(async () => assert.ok((await state()).selection.length > inside.length));
    const touched = (await state()).selection;
    for (const id of inside) assert.ok(touched.includes(id), id);
    // Only what is visible from the front.
    assert.ok(!touched.includes("house_hidden_beam"));
    const all = new Set(await inPage("s.volume.engine.pick(0.45, 0.5).then((p) => [p.id])"));
    for (const id of all) assert.ok(touched.includes(id), id);
  });

  it("in a rectangle by keyboard, and not at all after Escape", async () => {
    await inPage("s.selection.select([])");
    await visit.page.keyboard.press("r");
    await visit.page.locator("svt-aim .layer:focus").waitFor();
    for (let n = 0; n < 8; ++n) await visit.page.keyboard.press("ArrowRight");
    await visit.page.keyboard.press("Enter");
    await eventually(async () => assert.ok((await state()).selection.length > 0));
    await visit.page.keyboard.press("r");
    await visit.page.locator("svt-aim .layer:focus").waitFor();
    await visit.page.keyboard.press("Escape");
    await visit.page.locator("svt-aim").waitFor({ state: "detached" });
  });

  it("rows of the tree with Shift", async () => {
    await inPage("document.querySelector('svt-app').shadowRoot.querySelector('svt-tree').shadowRoot.querySelector('.list').scrollTo(0, 0)");
    const row = (name) => visit.page.getByRole("treeitem", { name });
    await row("Ground slab").click();
    await row("Exterior wall north, ground").click({ modifiers: ["Shift"] });
    const range = (await state()).selection;
    assert.equal(range.length, 3);
    await row("Exterior wall south, ground").click({ modifiers: ["Shift"] });
    assert.deepEqual((await state()).selection, range.slice(0, 2), "from the same row");
    await visit.page.locator("svt-tree [role=tree]").focus();
    await visit.page.keyboard.press("Shift+ArrowDown");
    assert.deepEqual((await state()).selection, range);
  });
});

describe("planes", () => {
  before(() => open());

  it("go through the face that is clicked", async () => {
    await visit.page.keyboard.press("2");
    await seenFrom([0, -1, 0]);
    await settled();
    const wall = await inPage(
      "(async () => { for (let y = 0.55; y < 0.9; y += 0.02) for (let x = 0.3; x < 0.7; x += 0.02) { const p = await s.volume.engine.pick(x, y); if (/^Exterior wall south/.test(p?.name)) return { x, y, at: p.point[1] }; } })()",
    );
    await tool("section");
    await visit.page.click("#plane-by-face");
    await visit.page.locator("svt-aim").waitFor();
    const box = await stage();
    await visit.page.mouse.click(box.x + box.width * wall.x, box.y + box.height * wall.y);
    await eventually(async () => assert.equal((await state()).sections.length, 1));
    const [plane] = (await state()).sections;
    assert.equal(plane.axis, "y");
    assert.equal(plane.flip, true, "everything in front of the face is removed");
    assert.ok(Math.abs(plane.at - wall.at) < 0.01, `${plane.at}, the face is at ${wall.at}`);
    // A slanted face, in voxels that are steps: the roof has 45 degrees or so, and faces the front.
    await inPage("s.view.set({ sections: [] })");
    await visit.page.keyboard.press("1");
    await settled();
    const roof = await inPage(
      "(async () => { for (let y = 0.3; y < 0.6; y += 0.02) for (let x = 0.35; x < 0.6; x += 0.02) { const p = await s.volume.engine.pick(x, y); if (/^Roof slab south/.test(p?.name)) return { x, y }; } })()",
    );
    await visit.page.click("#plane-by-face");
    await visit.page.mouse.click(box.x + box.width * roof.x, box.y + box.height * roof.y);
    await eventually(async () => assert.equal((await state()).sections.length, 1));
    const [slanted] = (await state()).sections;
    assert.equal(slanted.axis, "free");
    assert.ok(Math.abs(slanted.turn + 90) < 4 && slanted.tilt > 35 && slanted.tilt < 65, `${slanted.turn}, ${slanted.tilt}`);
  });

  it("say so where there is no face, and take the middle by keyboard", async () => {
    await inPage("s.view.set({ sections: [] })");
    await visit.page.click("#plane-by-face");
    const box = await stage();
    await visit.page.mouse.click(box.x + box.width * 0.97, box.y + box.height * 0.5);
    await visit.message("Click a face of the model.");
    await visit.page.locator("#plane-by-face").focus();
    await visit.page.keyboard.press("Enter");
    await visit.page.locator("svt-aim .layer:focus").waitFor();
    await visit.page.keyboard.press("Enter");
    await eventually(async () => assert.equal((await state()).sections.length, 1));
    await visit.page.locator("#message").waitFor({ state: "detached" });
  });

  it("are a box around the selection", async () => {
    await inPage("s.selection.select(['house_hidden_beam'])");
    await eventually(async () => assert.ok(await inPage("s.selection.properties")));
    await visit.page.click("#section-box");
    const { box } = await inPage("s.selection.properties");
    const planes = (await state()).sections;
    assert.equal(planes.length, 6);
    for (const [i, axis] of ["x", "y", "z"].entries()) {
      const low = planes.find((plane) => plane.axis === axis && plane.flip),
        high = planes.find((plane) => plane.axis === axis && !plane.flip);
      assert.ok(low.at <= box.low[i] && low.at > box.low[i] - 0.4, `${axis} from ${low.at}`);
      assert.ok(high.at >= box.high[i] && high.at < box.high[i] + 0.4, `${axis} to ${high.at}`);
    }
    const slider = visit.page.getByRole("slider", { name: "z to" });
    await slider.focus();
    await visit.page.keyboard.press("ArrowLeft");
    assert.ok(
      (await state()).sections.find((plane) => plane.axis === "z" && !plane.flip).at <
        planes.find((plane) => plane.axis === "z" && !plane.flip).at,
    );
    await settled();
    assert.deepEqual(await findings(), []);
    await visit.page.click("#section-box");
    assert.deepEqual((await state()).sections, []);
  });

  it("have their tool beside the picture, which does not cover it", async () => {
    const card = await visit.page.locator("#card").boundingBox();
    const picture = await stage();
    assert.ok(card.x >= picture.x + picture.width, "the tool is at the right of the picture");
    await visit.page.getByRole("button", { name: "Show or hide: Selection" }).click();
    assert.ok(await visit.page.locator("#card").isVisible(), "also without the selection");
    await visit.page.getByRole("button", { name: "Show or hide: Selection" }).click();
  });

  it("have their tool and the selection beside the picture in narrower windows, too, with and without the tree", async () => {
    const viewport = visit.page.viewportSize();
    const overlap = async () => {
      const picture = await stage();
      const boxes = await visit.page
        .locator("#card, aside, nav")
        .evaluateAll((parts) => parts.map((part) => ({ name: part.id || part.ariaLabel, ...part.getBoundingClientRect().toJSON() })));
      assert.ok(picture.width > 300, `the picture is ${picture.width} wide`);
      return boxes.filter((box) => box.right > picture.x + 1 && box.left < picture.x + picture.width - 1).map(({ name }) => name);
    };
    await inPage("s.selection.select(['house_hidden_beam'])");
    for (const width of [768, 1024, 1179]) {
      await visit.page.setViewportSize({ width, height: 768 });
      for (const isTree of [true, false]) {
        await eventually(async () => assert.deepEqual(await overlap(), []));
        for (const part of isTree ? ["#card", "svt-properties", "svt-tree .list"] : ["#card", "svt-properties"]) {
          const box = await visit.page.locator(part).boundingBox();
          assert.ok(box.height > 100, `${part} at ${width}: ${box.height}`);
        }
        await visit.shot(`middle-${width}-${isTree ? "tree" : "alone"}`);
        await visit.page.getByRole("button", { name: "Show or hide: Parts" }).click();
      }
    }
    await visit.page.setViewportSize(viewport);
    await inPage("s.selection.select([])");
  });
});

describe("measuring", () => {
  before(() => open());

  it("states the parts of a stretch, keeps right angles, and snaps to cuts", async () => {
    await inPage("s.view.set({ sections: [{ axis: 'z', at: 1.3, flip: false, turn: 45, tilt: 0 }] })");
    await inPage("s.view.goTo('', 'top')");
    await settled();
    await tool("measure");
    svt("section", at("house.svt"), "-o", at("cut.geojson"), "--plane", "z>1.3");
    const { features } = JSON.parse(readFileSync(at("cut.geojson"), "utf8"));
    const { origin } = await inPage("s.volume.info");
    const corners = features
      .flatMap(({ geometry }) => JSON.stringify(geometry.coordinates ?? []).match(/\[-?[\d.]+,-?[\d.]+,-?[\d.]+\]/g) ?? [])
      .map((text) => JSON.parse(text).map((v, i) => v - origin[i]));
    const box = await stage();
    // A place on the cut a few pixels from a corner of its outline.
    const near = await inPage(
      `(async () => {
        const { project } = await (async () => ({ project: (c, a, p) => { const [dx, dy] = [p[0] - c.eye[0], p[1] - c.eye[1]]; const half = Math.tan(c.fieldOfView * Math.PI / 360) * (c.eye[2] - p[2]); return { x: (dx / (half * a) + 1) / 2, y: (1 - dy / half) / 2 }; } }))();
        for (const corner of v) {
          const place = project(s.view.state.camera, s.view.aspect, corner);
          for (const [dx, dy] of [[4, 4], [-4, 4], [4, -4], [-4, -4]]) {
            const [x, y] = [place.x + dx / ${box.width}, place.y + dy / ${box.height}];
            const pick = x > 0.2 && x < 0.9 && y > 0.1 && y < 0.85 ? await s.volume.engine.pick(x, y) : null;
            if (pick && Math.abs(pick.point[2] - 1.3) < 0.02) return { x, y };
          }
        }
      })()`,
      corners,
    );
    assert.ok(near, "some corner of the cut is seen");
    await visit.page.mouse.click(box.x + box.width * near.x, box.y + box.height * near.y);
    await eventually(async () => assert.equal((await state()).measured.length, 1));
    const [first] = (await state()).measured;
    assert.ok(
      Math.min(...corners.map((corner) => Math.hypot(...corner.map((v, i) => v - first[i])))) < 0.002,
      `${first} is a corner of the cut`,
    );
    assert.match(await inPage("s.messages.said"), /of the cut$/);
    await visit.page.locator("#square").check();
    await visit.page.mouse.click(box.x + box.width * 0.6, box.y + box.height * 0.55);
    await eventually(async () => assert.equal((await state()).measured.length, 2));
    const [a, b] = (await state()).measured;
    assert.equal(a.filter((v, i) => Math.abs(v - b[i]) > 1e-9).length, 1, "along one axis");
    const shown = await Promise.all(["x", "y", "z"].map((axis) => visit.page.locator(`#measured-d${axis}`).innerText()));
    shown.forEach((text, i) => assert.ok(Math.abs(Number(text.replace("−", "-").replace(" m", "")) - (b[i] - a[i])) < 0.001, text));
    assert.deepEqual(await findings(), []);
  });
});

describe("the sun", () => {
  before(() => open());

  it("shines at a day and an hour, and is in links and commands", async () => {
    await tool("look");
    await visit.page.locator("#sun").check();
    await eventually(async () => assert.match((await state()).sun?.time ?? "", /-06-21 15:00$/));
    const slider = visit.page.locator("#sun-hour");
    await slider.waitFor();
    await settled();
    assert.equal(await inPage("s.messages.message"), null);
    await inPage(
      "(document.querySelector('svt-app').shadowRoot.querySelector('svt-look-tool').shadowRoot.querySelector('svt-sun-choice').shadowRoot.querySelector('#sun-hour').focus())",
    );
    await visit.page.keyboard.press("ArrowRight");
    await eventually(async () => assert.match((await state()).sun.time, /-06-21 15:15$/));
    await visit.page.getByRole("slider", { name: "Day", exact: true }).focus();
    await visit.page.keyboard.press("ArrowRight");
    await eventually(async () => assert.match((await state()).sun.time, /-06-22 15:15$/));
    await visit.page.keyboard.press("ArrowLeft");
    await eventually(async () => assert.match((await state()).sun.time, /-06-21 15:15$/));
    const scene = await inPage("s.view.composed([320, 200])");
    assert.match(scene.sun.time, /15:15$/);
    await eventually(async () => assert.match(visit.page.url(), /view=/));
    await visit.page.waitForTimeout(700);
    await visit.page.reload();
    await visit.firstImage();
    await eventually(async () => assert.match((await state()).sun?.time ?? "", /15:15$/));
    await tool("look");
    assert.deepEqual(await findings(), []);
    await visit.page.locator("#sun").uncheck();
    assert.equal((await state()).sun, null);
  });

  it("asks for the place that the model does not state", async () => {
    const text = readFileSync(at("house.gml"), "utf8").replace(/srsName="[^"]*"/g, "");
    await visit.drop("nowhere.gml", Buffer.from(text));
    await eventually(async () => assert.equal(await inPage("s.volume.file"), "nowhere.gml"));
    await settled();
    await tool("look");
    await visit.page.locator("#sun").check();
    await visit.page.getByText("The model does not state its place on earth.").waitFor();
    assert.equal((await state()).sun, null);
    await visit.page.locator("#latitude").fill("95");
    await visit.page.locator("#latitude").press("Enter");
    assert.equal(await visit.page.locator("#latitude").inputValue(), "");
    await visit.page.locator("#latitude").fill("52.5");
    await visit.page.locator("#longitude").fill("13.4");
    await visit.page.locator("#longitude").press("Enter");
    await eventually(async () => assert.deepEqual((await state()).sun?.place, [52.5, 13.4]));
    await settled();
    assert.equal(await inPage("s.messages.message"), null);
  });
});

describe("bookmarks", () => {
  before(() => open());

  it("are walked through, with comments and a status", async () => {
    await tool("share");
    await visit.page.click("#keep-view");
    await eventually(async () => assert.equal(await visit.page.locator("svt-bookmark-list li").count(), 1));
    await inPage("s.view.goTo('', 'back')");
    await visit.page.click("#keep-view");
    await eventually(async () => assert.equal(await visit.page.locator("svt-bookmark-list li").count(), 2));
    await visit.page.click("#next-view");
    await seenFrom([0.58, -0.58, 0.58]);
    await visit.page.click("#next-view");
    await seenFrom([0, 1, 0]);
    assert.equal(await visit.page.locator("svt-bookmark-list li[aria-current=true] input").first().inputValue(), "View 2");
    await visit.page.click("#previous-view");
    await seenFrom([0.58, -0.58, 0.58]);
    await visit.page.getByRole("button", { name: "Comment and status of View 1" }).click();
    await visit.page.getByRole("textbox", { name: "Comment", exact: true }).fill("Look at the eaves");
    await visit.page.getByRole("combobox", { name: "Status", exact: true }).selectOption("Closed");
    assert.deepEqual(await findings(), []);
    await visit.page.reload();
    await visit.firstImage();
    await tool("share");
    await visit.page.getByRole("button", { name: "Comment and status of View 1" }).click();
    assert.equal(await visit.page.getByRole("textbox", { name: "Comment", exact: true }).inputValue(), "Look at the eaves");
    assert.equal(await visit.page.getByRole("combobox", { name: "Status", exact: true }).inputValue(), "Closed");
  });
});

describe("on a phone", () => {
  before(() => open("?model=house", { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true }));

  it("cube, rectangle and planes take fingers, beside an open tool", async () => {
    await visit.page.locator('svt-view-cube path[data-direction="0,-1,0"]').first().tap();
    await seenFrom([0, -1, 0]);
    for (const id of ["fit", "parallel", "rectangle"]) {
      const { width, height } = await visit.page.locator(`#cube-${id}`).boundingBox();
      assert.ok(width >= 44 && height >= 44, id);
    }
    await tool("section");
    await settled();
    await visit.page.locator("#cube-rectangle").tap();
    // The layer has no size until its script has come.
    await eventually(async () => {
      const [layer, picture] = [await visit.page.locator("svt-aim").boundingBox(), await stage()];
      for (const side of ["x", "y", "width", "height"]) assert.ok(Math.abs(layer[side] - picture[side]) < 1, `${side} of the layer`);
    });
    assert.deepEqual(await findings(), []);
    const picture = await stage();
    const finger = async (kind, x, y) =>
      visit.page.evaluate(
        ([type, clientX, clientY]) => {
          const target = document.querySelector("svt-app").shadowRoot.querySelector("svt-aim").shadowRoot.querySelector(".layer");
          target.setPointerCapture = () => {};
          target.dispatchEvent(new PointerEvent(type, { clientX, clientY, pointerId: 5, pointerType: "touch", bubbles: true, button: 0 }));
        },
        [kind, picture.x + picture.width * x, picture.y + picture.height * y],
      );
    await finger("pointerdown", 0.9, 0.9);
    await finger("pointermove", 0.2, 0.4);
    await finger("pointerup", 0.2, 0.4);
    await eventually(async () => assert.ok((await state()).selection.length > 1));
  });
});
