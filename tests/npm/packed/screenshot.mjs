// Makes the picture of docs/user/web-component.md, from the packages installed in SVT_NPM_FOLDER:
//   SVT_NPM_FOLDER=FOLDER node tests/npm/packed/screenshot.mjs PICTURE
import process from "node:process";
import { endBrowser, svt } from "../../../web/viewer/e2e/harness.mjs";
import { at, put, putShared, serve, Visitor } from "./site.mjs";

svt("sample", "house", "-o", at("house.gml"), "--quiet");
svt("build", at("house.gml"), "-o", at("fine.svt"), "--spacing", "0.05", "--quiet");
putShared();
put(
  "page.css",
  "body { margin: 0; padding: 12px 18px; font: 16px system-ui, sans-serif } main { display: grid; grid-template-columns: 1fr 1fr; gap: 6px 18px } svt-viewer { height: 340px; aspect-ratio: auto; border: 1px solid #ccd; border-radius: 10px } code { display: block; height: 34px; font-size: 12px }",
);
const site = await serve();
const visitor = new Visitor();
const elements = [
  'section="y<5" hide="class=BuildingRoom"',
  'camera="top" ortho section="z>1.6" names="class=BuildingRoom" controls="camera"',
];
await visitor.show(
  site,
  elements
    .map(
      (attributes, n) =>
        `<div><code>${attributes.replaceAll("<", "&lt;")}</code><svt-viewer id="e${n}" src="fine.svt" ${attributes}></svt-viewer></div>`,
    )
    .join(""),
  { viewport: { width: 1100, height: 400 } },
);
await visitor.loaded("e0", "e1");
await visitor.page.waitForTimeout(8000);
await visitor.page.screenshot({ path: process.argv[2] });
await visitor.leave();
await endBrowser();
await site.close();
