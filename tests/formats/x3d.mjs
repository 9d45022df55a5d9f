// Shows an X3D scene of a volume in a player in headless Chromium, and compares it with our own picture of the same view.
//   node tests/formats/x3d.mjs ORACLES x_ite|x3dom SCENE.x3d PICTURE.png OURS.png
// ORACLES holds node_modules: npm install --prefix ORACLES x_ite playwright-core@1.56.1; and x3dom-full.js, which the npm package of
// X3DOM leaves out (https://www.x3dom.org/download/dev/x3dom-full.js). Exit code 77 where one of them or Chromium is not there.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { needs, openLoaded, withPage } from "./browser_page.mjs";

const [oracles, player, scene, picture, ours] = process.argv.slice(2);
const files = player === "x_ite" ? join(resolve(oracles), "node_modules", "x_ite", "dist") : resolve(oracles);
const script = player === "x_ite" ? "x_ite.min.js" : "x3dom-full.js";
needs(oracles, join(files, script));
const [width, height] = [960, 640];
const pages = {
  x_ite: `<script src="/player/${script}"></script>
<x3d-canvas id="scene" style="width:${width}px;height:${height}px" antialiased="true" splashScreen="false" contextMenu="false" notifications="false" preserveDrawingBuffer="true" contentScale="1"></x3d-canvas><script type="module">
try {
  const browser = document.getElementById("scene").browser;
  window.browser = browser;
  browser.setBrowserOption("PrimitiveQuality", "HIGH");
  browser.setBrowserOption("TextureQuality", "HIGH");
  await browser.loadURL(new X3D.MFString("/scene/" + ${JSON.stringify(scene.split("/").pop())}));
  window.isLoaded = true;
} catch (error) { window.failure = String(error?.stack ?? error); }
</script>`,
  x3dom: `<link rel="stylesheet" href="data:text/css,x3d{border:0}"><script src="/player/${script}"></script>
<x3d id="scene" width="${width}px" height="${height}px" showStat="false" showLog="false"><scene>
<inline url="/scene/${scene.split("/").pop()}" onload="window.isLoaded = true" onerror="window.failure = 'not loaded'"></inline></scene></x3d>`,
};
const page = `<!doctype html><html><body style="margin:0;background:#fff">${pages[player]}</body></html>`;
/// Of what is not background, as in the corner: the share that both have, and the mean difference of a channel there. Ours is lit, a volume of X3D is not.
async function compare(pictures) {
  const [a, b] = await Promise.all(
    pictures.map(async (base64) => {
      const image = new Image();
      image.src = "data:image/png;base64," + base64;
      await image.decode();
      const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
      const context = canvas.getContext("2d");
      context.drawImage(image, 0, 0);
      return context.getImageData(0, 0, image.width, image.height).data;
    }),
  );
  let [both, any, sum] = [0, 0, 0];
  for (let at = 0; at < a.length; at += 4) {
    const [isA, isB] = [a, b].map((p) => [0, 1, 2].some((c) => Math.abs(p[at + c] - p[c]) > 6));
    any += Number(isA || isB);
    if (!isA || !isB) continue;
    ++both;
    for (let c = 0; c < 3; ++c) sum += Math.abs(a[at + c] - b[at + c]) / 3;
  }
  return [both / any, sum / both];
}
const folders = { "/player/": files, "/scene/": dirname(scene) };
await withPage({ oracles, html: page, folders, width, height }, async (tab, address) => {
  const faults = [];
  tab.on("pageerror", (error) => faults.push(String(error)));
  tab.on("response", (answer) => answer.status() >= 400 && !answer.url().endsWith("favicon.ico") && faults.push(answer.url()));
  await openLoaded(tab, address, 40);
  // A picture is done when two in a row are the same, and not empty.
  let last = "";
  for (let n = 0; n < 40; ++n) {
    await tab.waitForTimeout(1000);
    const shot = (await tab.screenshot({ path: picture, timeout: 60000 })).toString("base64");
    if (shot === last && n > 2) break;
    last = shot;
  }
  const [overlap, difference] = await tab.evaluate(compare, [last, readFileSync(ours).toString("base64")]);
  console.log(`overlap ${overlap.toFixed(4)}, difference ${difference.toFixed(1)} of 255`);
  assert.deepEqual(faults, []);
  assert.ok(overlap > 0.95, "the outline is not that of our picture");
  assert.ok(difference < 40, "the colours are not those of our picture");
});
