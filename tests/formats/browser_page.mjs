// What the checks in a browser share: a small server of a page and its folders, and headless Chromium that has it open.
import { existsSync, readFileSync } from "node:fs";
import http from "node:http";
import { extname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const types = {
  ".css": "text/css",
  ".glb": "model/gltf-binary",
  ".html": "text/html",
  ".js": "text/javascript",
  ".json": "application/json",
  ".png": "image/png",
  ".wasm": "application/wasm",
  ".x3d": "model/x3d+xml",
};
const browserPath = ["/usr/bin/chromium-headless-shell", "/usr/bin/chromium"].find(existsSync);
const playwrightIn = (oracles) => join(resolve(oracles), "node_modules", "playwright-core", "index.mjs");

/// Ends with exit code 77 (skipped) where Chromium, playwright-core or one of the files is not there.
export function needs(oracles, ...files) {
  const missing = [browserPath ?? "Chromium", playwrightIn(oracles), ...files].filter((file) => !existsSync(file));
  if (missing.length === 0) return;
  console.log(`not there: ${missing.join(", ")}`);
  process.exit(77);
}

/// Serves the HTML text and the folders ({"/prefix/": folder}) and calls use(tab) with the page open.
export async function withPage({ oracles, html, folders, width = 960, height = 640 }, use) {
  const server = http.createServer((request, answer) => {
    const url = decodeURIComponent(request.url.split("?")[0]);
    if (url === "/") return answer.setHeader("content-type", "text/html").end(html);
    const prefix = Object.keys(folders).find((start) => url.startsWith(start));
    const file = prefix && join(resolve(folders[prefix]), url.slice(prefix.length));
    if (!file || !existsSync(file)) return answer.writeHead(404).end();
    answer.setHeader("content-type", types[extname(file)] ?? "application/octet-stream").end(readFileSync(file));
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", () => done(server)));
  const { chromium } = await import(pathToFileURL(playwrightIn(oracles)).href);
  const browser = await chromium.launch({
    executablePath: browserPath,
    args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
  try {
    const tab = await browser.newPage({ viewport: { width, height } });
    await use(tab, `http://127.0.0.1:${/** @type {import("node:net").AddressInfo} */ (server.address()).port}/`);
  } finally {
    await browser.close();
    server.close();
  }
}

/// The folder of Cesium's build.
export const cesiumIn = (oracles) => join(resolve(oracles), "node_modules", "cesium", "Build", "Cesium");

/// A page with a bare viewer of Cesium, window.viewer; then `script` runs, which sets window.isLoaded. A failure is window.failure.
export const cesiumPage = (script, functions) => `<!doctype html><html><link rel="stylesheet" href="/cesium/Widgets/widgets.css">
<body style="margin:0"><div id="globe" style="width:960px;height:640px"></div>
<script>window.CESIUM_BASE_URL = "/cesium/";</script><script src="/cesium/Cesium.js"></script><script>
(async () => {
  try {
    const off = ["animation", "timeline", "geocoder", "baseLayer", "baseLayerPicker", "homeButton", "infoBox", "fullscreenButton",
                 "sceneModePicker", "navigationHelpButton", "selectionIndicator"];
    const options = Object.fromEntries(off.map((name) => [name, false]));
    window.viewer = new Cesium.Viewer("globe", { ...options, contextOptions: { webgl: { preserveDrawingBuffer: true } } });
    ${script}
  } catch (error) {
    window.failure = String(error.stack ?? error);
  }
})();
${functions}
</script></body></html>`;

/// Goes to the page and waits until it says that it is loaded; throws what it failed with.
export async function openLoaded(tab, address, seconds) {
  await tab.goto(address);
  await tab.waitForFunction("window.isLoaded || window.failure", null, { timeout: 1000 * seconds });
  const failure = await tab.evaluate("window.failure");
  if (failure !== undefined) throw new Error(failure);
}
