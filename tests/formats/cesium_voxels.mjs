// Opens voxels as 3D Tiles (draft extensions) in Cesium in headless Chromium: each tile against the samples, and what a click tells.
//   node tests/formats/cesium_voxels.mjs ORACLES TILES REFERENCE.nrrd [PICTURE.png]
// ORACLES as of cesium.mjs. REFERENCE: the same volume as raw NRRD. Exit code 77 where something is not there.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import http from "node:http";
import { extname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

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
            filled += found !== 0;
          }
    }
console.log("filled", filled);

const modules = resolve(oracles, "node_modules");
const browserPath = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);
const cesium = join(modules, "cesium", "Build", "Cesium");
const playwright = join(modules, "playwright-core", "index.mjs");
if (!browserPath || !existsSync(cesium) || !existsSync(playwright)) {
  console.log(`no Chromium, or no cesium and playwright-core in ${oracles}`);
  process.exit(77);
}
const page = `<!doctype html><html><link rel="stylesheet" href="/cesium/Widgets/widgets.css"><body style="margin:0"><div id="globe" style="width:960px;height:640px"></div>
<script>window.CESIUM_BASE_URL = "/cesium/";</script><script src="/cesium/Cesium.js"></script><script>
(async () => {
  try {
    const off = ["animation", "timeline", "geocoder", "baseLayer", "baseLayerPicker", "homeButton", "infoBox", "fullscreenButton",
                 "sceneModePicker", "navigationHelpButton", "selectionIndicator"];
    const options = Object.fromEntries(off.map((name) => [name, false]));
    window.viewer = new Cesium.Viewer("globe", { ...options, contextOptions: { webgl: { preserveDrawingBuffer: true } } });
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
  } catch (error) {
    window.failure = String(error.stack ?? error);
  }
})();
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
</script></body></html>`;
const types = { ".js": "text/javascript", ".json": "application/json", ".css": "text/css", ".glb": "model/gltf-binary", ".wasm": "application/wasm" };
const server = http.createServer((request, answer) => {
  const url = decodeURIComponent(request.url.split("?")[0]);
  const file = url.startsWith("/cesium/") ? join(cesium, url.slice(8)) : join(resolve(tiles), url.replace("/tiles/", ""));
  if (url === "/") return answer.setHeader("content-type", "text/html").end(page);
  if (!existsSync(file)) return answer.writeHead(404).end();
  answer.setHeader("content-type", types[extname(file)] ?? "application/octet-stream").end(readFileSync(file));
});
await new Promise((done) => server.listen(0, "127.0.0.1", done));
const { chromium } = await import(pathToFileURL(playwright).href);
const browser = await chromium.launch({
  executablePath: browserPath,
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
try {
  const tab = await browser.newPage({ viewport: { width: 960, height: 640 } });
  tab.on("console", (message) => message.type() === "error" && console.log(message.text().slice(0, 600)));
  await tab.goto(`http://127.0.0.1:${server.address().port}/`);
  await tab.waitForFunction("window.isLoaded || window.failure", null, { timeout: 120000 });
  assert.equal(await tab.evaluate("window.failure"), undefined);
  await tab.waitForTimeout(3000);
  if (picture) await tab.screenshot({ path: picture, timeout: 120000 });
  const seen = await tab.evaluate("window.pick()");
  console.log("names", await tab.evaluate("window.names"), "seen", seen.length, JSON.stringify(seen.slice(0, 5)));
  const scalars = seen.map(([, , label]) => label.map(Math.round).reduce((sum, byte, n) => sum + byte * 256 ** n, 0)).filter((s) => s > 0);
  assert.ok(scalars.length > 20, "voxels are seen");
  const known = new Set();
  for (let k = 0; k < sizes[2]; ++k) for (let j = 0; j < sizes[1]; ++j) for (let i = 0; i < sizes[0]; ++i) known.add(sampleAt(i, j, k));
  for (const scalar of scalars) assert.ok(known.has(scalar), `${scalar} is no scalar`);
} finally {
  await browser.close();
  server.close();
}
