// Opens a folder of 3D Tiles in Cesium in headless Chromium: where on the globe it is, and what a click tells.
//   node tests/formats/cesium.mjs ORACLES TILES LONGITUDE LATITUDE HEIGHT CLASS [PICTURE.png [RADII]]
// ORACLES holds node_modules: npm install --prefix ORACLES cesium playwright-core@1.56.1. Exit code 77 where it or Chromium is not
// there. LONGITUDE, LATITUDE, HEIGHT: of the middle, expected within some metres; CLASS: of components that must be seen;
// RADII: how far away the camera is, 4.5 if not given.
import assert from "node:assert/strict";
import { cesiumIn, cesiumPage, needs, openLoaded, withPage } from "./browser_page.mjs";

const [oracles, tiles, longitude, latitude, height, className, picture, radii = 4.5] = process.argv.slice(2);
needs(oracles, cesiumIn(oracles));
const script = `
    const tileset = await Cesium.Cesium3DTileset.fromUrl("/tiles/tileset.json");
    tileset.allTilesLoaded.addEventListener(() => { window.isLoaded = true; });
    viewer.scene.primitives.add(tileset);
    const { center, radius } = tileset.boundingSphere;
    await viewer.zoomTo(tileset, new Cesium.HeadingPitchRange(0.6, -0.45, ${Number(radii)} * radius));
    const place = Cesium.Cartographic.fromCartesian(center);
    window.place = [Cesium.Math.toDegrees(place.longitude), Cesium.Math.toDegrees(place.latitude), place.height, radius];
`;
const functions = `
window.pick = () => {
  const seen = new Map();
  for (let y = 10; y < 640; y += 20)
    for (let x = 10; x < 960; x += 20) {
      const feature = viewer.scene.pick(new Cesium.Cartesian2(x, y));
      if (feature?.getProperty) seen.set(feature.getProperty("id"), ["class", "name", "storey", "volume"].map((key) => feature.getProperty(key)));
    }
  return [...seen];
};
`;
const page = { oracles, html: cesiumPage(script, functions), folders: { "/cesium/": cesiumIn(oracles), "/tiles/": tiles } };
await withPage(page, async (tab, address) => {
  await openLoaded(tab, address, 150);
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
  assert.ok(
    seen.some(([, [found]]) => found === className),
    `no ${className} among ${JSON.stringify(seen)}`,
  );
  console.log("place", place.join(" "), "\n" + seen.map((entry) => JSON.stringify(entry)).join("\n"));
});
