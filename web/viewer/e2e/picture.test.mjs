// The picture: picking, turning, touching, moving; what is picked is checked against the `svt` command.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { before, describe, it } from "node:test";
import { svt } from "./harness.mjs";
import { readPng } from "./png.mjs";
import { withHouse } from "./visit.mjs";

const { at, visit, open } = withHouse("picture");
const { inPage, state, settled, stage, eventually, tool } = visit;

describe("picture", () => {
  before(() => open());

  it("picks what the command sees there", async () => {
    // Panels that arrive late may change the picture's size meanwhile: then the scene of the command is another one.
    await eventually(async () => {
      await settled();
      const [scene, [width, height]] = await inPage("[await s.view.composed(s.view.size), s.view.size]");
      writeFileSync(at("pick.scene.json"), JSON.stringify(scene));
      svt("render", at("house.svt"), "-o", at("pick.png"), "--scene", at("pick.scene.json"), "--labels", at("labels.png"));
      const labels = readPng(readFileSync(at("labels.png")));
      assert.deepEqual([labels.width, labels.height], [width, height]);
      let checked = 0;
      for (let n = 0; n < 60; ++n) {
        const x = Math.floor(((n * 0.618) % 1) * (width - 4)) + 2,
          y = Math.floor(((n * 0.382 + 0.1) % 1) * (height - 4)) + 2;
        const around = [-1, 0, 1].flatMap((dy) => [-1, 0, 1].map((dx) => labels.data[(y + dy) * width + x + dx]));
        if (around.some((label) => label !== around[0])) continue;
        const pick = await inPage("s.volume.engine.pick(v[0], v[1])", [(x + 0.5) / width, (y + 0.5) / height]);
        assert.equal(pick?.scalar ?? 0, around[0], `at ${x}, ${y} of ${width} x ${height}`);
        ++checked;
      }
      assert.ok(checked > 20, `only ${checked} places`);
    });
  });

  it("picks what the eye takes: behind air and glass that is hardly seen, and the glass where nothing is behind it", async () => {
    const shown = await state();
    const scene = async (change) => (await inPage("s.view.set(v)", change), settled());
    // Cut open, the air of the rooms stands before furniture and walls.
    await scene({ hide: [], sections: [{ axis: "y", at: 5, flip: true, turn: 0, tilt: 0 }] });
    const seen = await inPage(`(async () => {
      const rooms = new Set(await s.volume.engine.select("class=BuildingRoom"));
      let first = 0, picked = 0;
      for (let y = 0.35; y < 0.75; y += 0.02)
        for (let x = 0.3; x < 0.7; x += 0.02) {
          const pick = await s.volume.engine.pick(x, y);
          if (!pick) continue;
          ++picked;
          if (rooms.has(pick.id)) ++first;
        }
      return { first, picked };
    })()`);
    assert.ok(seen.picked > 100, JSON.stringify(seen));
    assert.equal(seen.first, 0, JSON.stringify(seen));
    // Alone, the same air is what there is.
    await scene({ show: ["class=BuildingRoom"], sections: [] });
    await inPage("s.view.goTo('', 'front')");
    await settled();
    const alone = await inPage("s.volume.engine.pick(0.5, 0.55)");
    assert.equal(alone.class, "BuildingRoom");
    await scene({ ...shown, selection: [] });
  });

  it("selects by click and lists by Alt-click", async () => {
    const box = await stage();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await visit.page.mouse.click(x, y);
    await visit.page.waitForFunction(() => document.querySelector("svt-app").session.view.state.selection.length === 1);
    const pick = await inPage("s.volume.engine.pick(0.5, 0.5)");
    assert.deepEqual((await state()).selection, [pick.id]);
    assert.match(await visit.page.locator("#said").innerText(), /^Selected: /);
    await visit.page.keyboard.down("Alt");
    await visit.page.mouse.click(x, y);
    await visit.page.keyboard.up("Alt");
    await visit.page.getByRole("heading", { name: "Along this ray" }).waitFor();
    const stretches = await inPage("s.selection.along.stretches");
    assert.ok(stretches.length > 1);
    assert.equal(stretches.find((s) => s.class !== "BuildingRoom").id, pick.id);
    assert.ok(stretches.every((s, i) => s.from <= s.to && (i === 0 || s.from >= stretches[i - 1].from - 1e-6)));
    await visit.page.locator("svt-properties .along button").nth(1).click();
    assert.deepEqual((await state()).selection, [stretches[1].id]);
  });

  it("is turned, moved and zoomed by mouse", async () => {
    const box = await stage();
    const [x, y] = [box.x + box.width * 0.4, box.y + box.height * 0.4];
    const cameras = [(await state()).camera];
    const step = async (act) => {
      await act();
      await eventually(async () => assert.notDeepEqual((await state()).camera, cameras.at(-1)));
      cameras.push((await state()).camera);
    };
    const drag = async (options = {}) => {
      await visit.page.mouse.move(x, y);
      await visit.page.mouse.down(options);
      await visit.page.mouse.move(x + 60, y + 20, { steps: 4 });
      await visit.page.mouse.up(options);
    };
    await step(() => drag());
    await step(() => drag({ button: "right" }));
    await step(() => visit.page.mouse.wheel(0, -240));
    const distance = (c) => Math.hypot(...c.eye.map((e, i) => e - c.target[i]));
    assert.ok(Math.abs(distance(cameras[1]) - distance(cameras[0])) < 1e-6, "turning keeps the distance");
    assert.notDeepEqual(cameras[1].eye, cameras[0].eye);
    assert.notDeepEqual(cameras[2].target, cameras[1].target);
    assert.ok(distance(cameras[3]) < distance(cameras[2]), "the wheel comes nearer");
  });

  it("frames what is double-clicked, and goes to named views by key", async () => {
    await visit.page.keyboard.press("2");
    const target = await eventually(async () => {
      const { eye, target } = (await state()).camera;
      assert.ok(Math.abs(eye[0] - target[0]) < 1e-6 && eye[1] < target[1], "from the front");
      return target;
    });
    await settled();
    const box = await stage();
    await visit.page.mouse.dblclick(box.x + box.width / 2, box.y + box.height / 2);
    await visit.page.waitForFunction(
      (before) => document.querySelector("svt-app").session.view.state.camera.target.some((v, i) => Math.abs(v - before[i]) > 0.01),
      target,
    );
  });

  it("flies to a view, unless the visitor prefers less motion", async () => {
    await inPage("s.view.goTo('', 'top')");
    const there = (await state()).camera.eye;
    await inPage("s.view.goTo('', 'front')");
    await visit.page.emulateMedia({ reducedMotion: "no-preference" });
    const first = await inPage("(await s.view.goTo('', 'top'), s.view.state.camera.eye)");
    await visit.page.emulateMedia({ reducedMotion: "reduce" });
    const distance = (eye) => Math.hypot(...eye.map((e, i) => e - there[i]));
    assert.ok(distance(first) > 1e-3, "it is not there at once");
    await eventually(async () => assert.ok(distance((await state()).camera.eye) < 1e-6));
  });
});

describe("touch", () => {
  it("turns by one finger, zooms by two, selects by a tap, and has a menu that lists by a long press", async () => {
    await open("?model=house", { hasTouch: true, viewport: { width: 360, height: 740 } });
    await settled();
    const box = await stage();
    const touch = await visit.page.context().newCDPSession(visit.page);
    const fingers = (type, ...points) =>
      touch.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x: box.x + x, y: box.y + y, id })) });
    const distance = (c) => Math.hypot(...c.eye.map((e, i) => e - c.target[i]));
    const before = (await state()).camera;
    await fingers("touchStart", [150, 200]);
    for (let n = 1; n <= 5; ++n) await fingers("touchMove", [150 + 12 * n, 200]);
    await fingers("touchEnd");
    const turned = await eventually(async () => {
      const { camera } = await state();
      assert.notDeepEqual(camera.eye, before.eye);
      return camera;
    });
    assert.ok(Math.abs(distance(turned) - distance(before)) < 1e-6);
    await fingers("touchStart", [150, 200], [200, 200]);
    for (let n = 1; n <= 5; ++n) await fingers("touchMove", [150 - 8 * n, 200], [200 + 8 * n, 200]);
    await fingers("touchEnd");
    await eventually(async () => assert.ok(distance((await state()).camera) < 0.7 * distance(turned)));
    await settled();
    await visit.page.touchscreen.tap(box.x + box.width / 2, box.y + box.height / 2);
    await eventually(async () => assert.equal((await state()).selection.length, 1));
    await fingers("touchStart", [box.width / 2, box.height / 2]);
    const item = visit.page.getByRole("menuitem", { name: "List everything behind a point" });
    await item.waitFor();
    await fingers("touchEnd");
    await item.click();
    await eventually(async () => assert.ok((await inPage("s.selection.along"))?.stretches.length > 1));
  });
});

describe("exact surfaces", () => {
  before(() => open());

  /** The source of the surfaces of the scenes that are drawn until the picture is fine. */
  const drawnAfter = (change) =>
    inPage(`(async () => {
      const { engine } = s.volume, drawn = [], { draw } = engine;
      engine.draw = (scene, ...size) => (drawn.push(scene), draw.call(engine, scene, ...size));
      s.view.${change};
      while (s.picture.quality !== "fine") await new Promise(requestAnimationFrame);
      engine.draw = draw;
      return drawn.map(({ surfaces }) => surfaces ?? null);
    })()`);
  const shown = () =>
    visit.page
      .locator("svt-picture canvas")
      .first()
      .evaluate((canvas) => canvas.toDataURL());

  it("are those of pictures at rest, once their module is there; a switch ends them, also in saved pictures", async () => {
    await visit.until("s.view.hasFaces");
    await settled();
    const drawn = await drawnAfter("turn({ ...s.view.state.camera })");
    assert.deepEqual([drawn[0], drawn.at(-1)], ["voxels", null]);
    assert.equal((await inPage("s.view.composed([320, 180])")).surfaces, undefined);
    await tool("look");
    await settled();
    const exact = await shown();
    await visit.page.locator("#exact-surfaces").uncheck();
    await settled();
    assert.ok((await shown()) !== exact);
    assert.equal((await inPage("s.view.composed([320, 180])")).surfaces, "voxels");
    await visit.page.keyboard.press("Control+z");
    await eventually(async () => assert.ok(await visit.page.locator("#exact-surfaces").isChecked()));
    await settled();
    assert.ok((await shown()) === exact);
  });

  it("are left out where the volume has no meshes", async () => {
    svt("build", at("house.gml"), "-o", at("voxels.svt"), "--spacing", "0.12", "--vectors", "none");
    await visit.choose({ name: "voxels.svt", bytes: readFileSync(at("voxels.svt")) });
    await visit.until("s.volume.file === 'voxels.svt' && s.picture.report");
    await settled();
    assert.equal((await drawnAfter("turn({ ...s.view.state.camera })")).at(-1), "voxels");
    await tool("look");
    assert.ok(await visit.page.locator("#exact-surfaces").isDisabled());
    assert.deepEqual(visit.problems, []);
  });
});

describe("moving", () => {
  before(() => open());

  it("has fewer pixels while it is slow, and all of them at rest", async (t) => {
    await settled();
    const { milliseconds, share } = await inPage(`(async () => {
      let last = s.picture.report, share = 1, milliseconds = 0;
      for (let frames = 0; frames < 12; ) {
        const { camera } = s.view.state;
        s.view.turn({ ...camera, eye: [camera.eye[0] + 0.01, camera.eye[1], camera.eye[2]] });
        await new Promise(requestAnimationFrame);
        if (s.picture.report === last) continue;
        last = s.picture.report;
        ++frames;
        milliseconds = last.milliseconds;
        share = last.width / s.view.size[0];
      }
      return { milliseconds, share };
    })()`);
    t.diagnostic(`while moving: ${Math.round(milliseconds)} ms a frame at ${Math.round(share * 100)} % of width and height`);
    assert.ok(share > 0.19 && share <= 1, `${share} of the width`);
    // Levels of detail would take longer than voxels, so that the picture would have fewer pixels.
    const levels = await inPage(`(async () => {
      const { engine } = s.volume, drawn = [], { draw } = engine;
      engine.draw = (scene, ...size) => (drawn.push(scene.passes.map(({ level }) => level ?? null)), draw.call(engine, scene, ...size));
      s.view.turn({ ...s.view.state.camera });
      while (s.picture.quality !== "fine") await new Promise(requestAnimationFrame);
      engine.draw = draw;
      return drawn;
    })()`);
    assert.deepEqual([levels[0], levels.at(-1)], [[0], [null]]);
    await settled();
    assert.deepEqual(await inPage("[s.picture.report.width, s.picture.report.height]"), await inPage("s.view.size"));
  });
});
