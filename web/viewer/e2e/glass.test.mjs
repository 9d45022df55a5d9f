// Glass in the page: a pane shows what is behind it, in its own colour.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { dataDir, serve, svt, withModels } from "./harness.mjs";
import { readPng } from "./png.mjs";
import { scratch, Visit } from "./visit.mjs";

const kRevit = join(dataDir, "samplehouse.ifc");
const { at, drop } = scratch("svt-glass-test-");
const visit = new Visit();
let server;

/** The picture in the page with only some features, all without `show`, and without those of `hide`. */
async function drawn(hide, show = []) {
  await visit.inPage("s.view.set(v)", { hide, show });
  await visit.settled();
  return readPng(await visit.page.screenshot({ clip: await visit.stage() }));
}

/** The middle value. */
const median = (numbers) => numbers.sort((a, b) => a - b)[numbers.length >> 1];

/**
 * A pane of opacity `a` and colour `c` in front of `b` is drawn as a c + (1 - a) b. So the pictures of the pane in front of two backgrounds
 * differ by 1 - a times the difference of these. Returns the number of pixels with glass, that of pixels with enough difference, and 1 - a.
 */
async function glass() {
  const rooms = "class=BuildingRoom";
  const house = await drawn([rooms]),
    open = await drawn([rooms, "phase=glass"]),
    panes = await drawn([], ["phase=glass"]),
    nothing = await drawn(["all"]);
  const shares = [];
  let count = 0;
  for (let pixel = 0; pixel < house.data.length; pixel += house.channels) {
    const value = (picture) => picture.data[pixel + 1];
    if (Math.abs(value(panes) - value(nothing)) < 5 || Math.abs(value(house) - value(open)) < 3) continue;
    ++count;
    const behind = value(open) - value(nothing);
    if (Math.abs(behind) > 40) shares.push((value(house) - value(panes)) / behind);
  }
  return { count, share: median(shares), places: shares.length };
}

describe("glass", () => {
  before(async () => {
    svt("sample", "house", "-o", at("house.gml"));
    svt("build", at("house.gml"), "-o", at("house.svt"), "--spacing", "0.06");
    const models = [{ name: "house", path: at("house.svt"), title: "Sample house" }];
    if (existsSync(kRevit)) {
      svt("build", kRevit, "-o", at("revit.svt"), "--spacing", "0.06");
      models.push({ name: "revit", path: at("revit.svt"), title: "Revit house" });
    }
    server = await serve(withModels(models));
  });
  after(async () => {
    await visit.close();
    await server?.close();
    drop();
  });

  for (const [name, view] of [
    ["house", "iso-sw"],
    ["revit", "left"],
  ])
    it(`shows what is behind a pane: ${name}`, async (test) => {
      if (name === "revit" && !existsSync(kRevit)) return test.skip(`${kRevit} is missing`);
      await visit.open(`${server.url}?model=${name}`);
      await visit.inPage("s.view.goTo('', v)", view);
      const { count, share, places } = await glass();
      assert.ok(count > 200 && places > 100, `${count} pixels of glass, ${places} before something`);
      assert.ok(share > 0.3 && share < 0.97, `${share} of the light passes`);
    });
});
