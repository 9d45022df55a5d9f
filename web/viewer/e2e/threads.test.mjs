// The module with threads, where the server isolates the page (COOP, COEP), and the one without: the same pictures.
import assert from "node:assert/strict";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { page, serve, svt, svtServe, withModels } from "./harness.mjs";
import { scratch, Visit } from "./visit.mjs";

const files = scratch("svt-threads-");
const visit = new Visit();
const kScenes = {
  plain: {},
  cut: { look: "paper", samples: 4, hatches: { show: true }, passes: [{ hide: ["class=BuildingRoom"], cut: "z>1.4" }] },
  glass: {
    look: "dark",
    samples: 1,
    passes: [{ styles: [{ select: "all", ghost: true }] }, { show: ["class=BuildingRoom"], join: "depth" }],
  },
  edges: { passes: [{ hide: ["class=BuildingRoom"], lines: [{ select: "all" }] }] },
  sun: { sun: { time: "2026-06-21 15:00", place: [50, 8] } },
  voxels: { surfaces: "voxels", passes: [{ cut: "y<5" }] },
};
let isolated, plain;

before(async () => {
  svt("sample", "house", "-o", files.at("house.gml"));
  svt("build", files.at("house.gml"), "-o", files.at("house.svt"), "--vectors", "edges,meshes");
  isolated = await svtServe(files.at("house.svt"));
  plain = await serve(models());
});
after(async () => {
  await visit.close();
  await isolated?.close();
  await plain?.close();
  files.drop();
});

const models = () => withModels([{ name: "house", path: files.at("house.svt"), title: "House" }]);

/** Pictures of all scenes, as base64 of PNG. */
async function pictures() {
  const made = {};
  for (const [name, scene] of Object.entries(kScenes)) {
    made[name] = await visit.inPage(
      `s.volume.engine.picture(v).then((b) => btoa(Array.from(new Uint8Array(b), (c) => String.fromCharCode(c)).join("")))`,
      { size: [480, 300], ...scene },
    );
  }
  return made;
}

describe("threads", () => {
  it("draw the same pictures as one thread and as the command", async (t) => {
    if (cpus().length < 2) return t.skip("this machine has one core");
    await visit.open(isolated.url);
    assert.equal(await visit.page.evaluate(() => crossOriginIsolated), true);
    assert.equal(await visit.inPage("s.volume.engine.threads"), Math.min(8, cpus().length));
    const many = await pictures();
    await visit.settled();
    assert.deepEqual(visit.problems, []);
    await visit.open(`${isolated.url}?threads=no`);
    assert.equal(await visit.inPage("s.volume.engine.threads"), 1);
    assert.deepEqual(await pictures(), many);
    for (const [name, scene] of Object.entries(kScenes)) {
      writeFileSync(files.at("s.scene.json"), JSON.stringify({ format: "svt-scene", version: 1, size: [480, 300], ...scene }));
      svt("render", files.at("house.svt"), "-o", files.at(`${name}.png`), "--scene", files.at("s.scene.json"));
      assert.equal(readFileSync(files.at(`${name}.png`)).toString("base64"), many[name], name);
    }
  });

  it("build the same volume of a model, and survive that an opening is cancelled", async (t) => {
    if (cpus().length < 2) return t.skip("this machine has one core");
    await visit.open(isolated.url);
    await visit.inPage("s.volume.engine.cancel()");
    await visit.choose({ name: "house.gml", bytes: readFileSync(files.at("house.gml")) });
    await visit.until("s.volume.file === 'house.gml' && s.picture.report");
    const { plain: shown } = await pictures();
    svt("render", files.at("house.gml"), "-o", files.at("model.png"), "--size", "480x300");
    assert.equal(readFileSync(files.at("model.png")).toString("base64"), shown);
  });

  it("are left out where the site does not isolate the page", async () => {
    await visit.open(plain.url);
    assert.equal(await visit.page.evaluate(() => crossOriginIsolated), false);
    assert.equal(await visit.inPage("s.volume.engine.threads"), 1);
    assert.deepEqual(visit.problems, []);
  });

  it("are left out where their module cannot be loaded", async () => {
    const script = readdirSync(join(page, "assets")).find((name) => /^svt_view_threads-.*\.js$/.test(name) && !name.includes("worker"));
    const broken = await serve({ ...models(), [`assets/${script}`]: files.at("missing.js") }, true);
    await visit.open(broken.url);
    assert.equal(await visit.page.evaluate(() => crossOriginIsolated), true);
    assert.equal(await visit.inPage("s.volume.engine.threads"), 1);
    await visit.close();
    await broken.close();
  });
});
