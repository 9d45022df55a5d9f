// Opens voxels as 3D Tiles (draft extensions) in Cesium in headless Chromium: each tile against the samples, and what a click tells.
//   node tests/formats/cesium_voxels.mjs ORACLES TILES REFERENCE.nrrd [PICTURE.png]
// ORACLES as of cesium.mjs. REFERENCE: the same volume as raw NRRD. Exit code 77 where something is not there.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { cesiumIn, cesiumPage, needs, openLoaded, withPage } from "./browser_page.mjs";

const [oracles, tiles, reference, picture] = process.argv.slice(2);
const nrrd = readFileSync(reference);
const headEnd = nrrd.indexOf("\n\n");
const head = nrrd.subarray(0, headEnd).toString();
const sizes = /\nsizes: (.*)/.exec(head)[1].split(" ").map(Number);
const sampleBytes = Number(/\ntype: uint(\d+)/.exec(head)[1]) / 8;
const sampleAt = (i, j, k) => nrrd.readUIntLE(headEnd + 2 + sampleBytes * (i + sizes[0] * (j + sizes[1] * k)), sampleBytes);

// The finest tiles have every sample once, in the order of the extension.
const tileset = JSON.parse(readFileSync(join(tiles, "tileset.json"), "utf8"));
const { dimensions } = tileset.root.content.extensions["3DTILES_content_voxels"];
const level = tileset.root.implicitTiling.availableLevels - 1;
let filled = 0;
for (let z = 0; z < 1 << level; ++z)
  for (let y = 0; y < 1 << level; ++y)
    for (let x = 0; x < 1 << level; ++x) {
      const file = join(tiles, "tiles", `${level}/${x}/${y}/${z}.glb`);
      const glb = existsSync(file) ? readFileSync(file) : undefined;
      const body = glb?.subarray(28 + glb.readUInt32LE(12));
      const [nx, ny, nz] = dimensions;
      for (let k = 0; k < nz; ++k)
        for (let j = 0; j < ny; ++j)
          for (let i = 0; i < nx; ++i) {
            const place = [x * nx + i, y * ny + j, z * nz + k];
            const expected = place.every((p, axis) => p < sizes[axis]) ? sampleAt(...place) : 0;
            const found = body ? body.readUInt32LE(4 * (i + nx * (k + nz * (ny - 1 - j)))) : 0;
            if (found !== expected) throw new Error(`${place}: ${found}, not ${expected}`);
            filled += Number(found !== 0);
          }
    }
console.log("filled", filled);

needs(oracles, cesiumIn(oracles));
const script = `
    viewer.scene.globe.show = false;
    for (const sky of [viewer.scene.skyBox, viewer.scene.skyAtmosphere]) if (sky) sky.show = false;
    viewer.scene.backgroundColor = Cesium.Color.fromCssColorString("#dbe3eb");
    const provider = await Cesium.Cesium3DTilesVoxelProvider.fromUrl("/tiles/tileset.json");
    window.names = provider.names;
    const shader = new Cesium.CustomShader({ fragmentShaderText:
      "void fragmentMain(FragmentInput fsInput, inout czm_modelMaterial material) {" +
      "  vec4 look = fsInput.metadata.color; material.diffuse = look.rgb; material.alpha = look.a < 0.002 ? 0.0 : look.a; }" });
    window.voxels = viewer.scene.primitives.add(new Cesium.VoxelPrimitive({ provider, customShader: shader }));
    voxels.nearestSampling = true;
    voxels.allTilesLoaded.addEventListener(() => { window.isLoaded = true; });
    const sphere = voxels.boundingSphere ?? provider.boundingSphere;
    viewer.camera.flyToBoundingSphere(sphere, { duration: 0, offset: new Cesium.HeadingPitchRange(-0.6, -0.5, 1.6 * sphere.radius) });
`;
const functions = `
window.pick = () => {
  const seen = [];
  for (let y = 20; y < 640; y += 40)
    for (let x = 20; x < 960; x += 40) {
      const cell = viewer.scene.pickVoxel(new Cesium.Cartesian2(x, y));
      const label = cell?.getProperty("label");
      if (label) seen.push([cell.tileIndex, cell.sampleIndex, Array.from(label)]);
    }
  return seen;
};
`;
const page = { oracles, html: cesiumPage(script, functions), folders: { "/cesium/": cesiumIn(oracles), "/tiles/": tiles } };
await withPage(page, async (tab, address) => {
  tab.on("console", (message) => message.type() === "error" && console.log(message.text().slice(0, 600)));
  await openLoaded(tab, address, 120);
  await tab.waitForTimeout(3000);
  if (picture) await tab.screenshot({ path: picture, timeout: 120000 });
  const seen = await tab.evaluate("window.pick()");
  console.log("names", await tab.evaluate("window.names"), "seen", seen.length, JSON.stringify(seen.slice(0, 5)));
  const scalars = seen.map(([, , label]) => label.map(Math.round).reduce((sum, byte, n) => sum + byte * 256 ** n, 0)).filter((s) => s > 0);
  assert.ok(scalars.length > 20, "voxels are seen");
  const known = new Set();
  for (let k = 0; k < sizes[2]; ++k) for (let j = 0; j < sizes[1]; ++j) for (let i = 0; i < sizes[0]; ++i) known.add(sampleAt(i, j, k));
  for (const scalar of scalars) assert.ok(known.has(scalar), `${scalar} is no scalar`);
});
