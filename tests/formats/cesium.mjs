// Opens a folder of 3D Tiles in Cesium in headless Chromium: where on the globe it is, and what a click tells.
//   node tests/formats/cesium.mjs ORACLES TILES LONGITUDE LATITUDE HEIGHT CLASS [PICTURE.png]
// ORACLES holds node_modules: npm install --prefix ORACLES cesium playwright-core@1.56.1. Exit code 77 where it or Chromium is not
// there. LONGITUDE, LATITUDE, HEIGHT: of the middle, expected within some metres; CLASS: of components that must be seen.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import http from "node:http";
import { extname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [oracles, tiles, longitude, latitude, height, className, picture] = process.argv.slice(2);
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
    const tileset = await Cesium.Cesium3DTileset.fromUrl("/tiles/tileset.json");
    tileset.allTilesLoaded.addEventListener(() => { window.isLoaded = true; });
    viewer.scene.primitives.add(tileset);
    const { center, radius } = tileset.boundingSphere;
    await viewer.zoomTo(tileset, new Cesium.HeadingPitchRange(0.6, -0.45, 4.5 * radius));
    const place = Cesium.Cartographic.fromCartesian(center);
    window.place = [Cesium.Math.toDegrees(place.longitude), Cesium.Math.toDegrees(place.latitude), place.height, radius];
  } catch (error) {
    window.failure = String(error.stack ?? error);
  }
})();
window.pick = () => {
  const seen = new Map();
  for (let y = 10; y < 640; y += 20)
    for (let x = 10; x < 960; x += 20) {
      const feature = viewer.scene.pick(new Cesium.Cartesian2(x, y));
      if (feature?.getProperty) seen.set(feature.getProperty("id"), ["class", "name", "storey", "volume"].map((key) => feature.getProperty(key)));
    }
  return [...seen];
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
  await tab.goto(`http://127.0.0.1:${server.address().port}/`);
  await tab.waitForFunction("window.isLoaded || window.failure", null, { timeout: 150000 });
  assert.equal(await tab.evaluate("window.failure"), undefined);
  await tab.waitForTimeout(2000);
  const place = await tab.evaluate("window.place");
  const metres = [
    (place[0] - Number(longitude)) * 111320 * Math.cos((Number(latitude) * Math.PI) / 180),
    (place[1] - Number(latitude)) * 111200,
    place[2] - Number(height),
  ];
  assert.ok(Math.hypot(...metres) < 3, `the middle is ${metres} m from where it should be`);
  const seen = await tab.evaluate("window.pick()");
  if (picture) await tab.screenshot({ path: picture });
  assert.ok(seen.some(([, [found]]) => found === className), `no ${className} among ${JSON.stringify(seen)}`);
  console.log("place", place.join(" "), "\n" + seen.map((entry) => JSON.stringify(entry)).join("\n"));
} finally {
  await browser.close();
  server.close();
}
