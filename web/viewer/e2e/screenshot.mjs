// Makes docs/images/viewer.png: the generated house, cut open, in the page. Needs `make viewer`.
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { browse, repository, serve, svt, withModels } from "./harness.mjs";

const folder = mkdtempSync(join(tmpdir(), "svt-viewer-picture-"));
const model = join(folder, "house.gml"),
  volume = join(folder, "house.svt");
svt("sample", "house", "-o", model);
svt("build", model, "-o", volume, "--spacing", "0.03", "--vectors", "edges");
const server = await serve(withModels([{ name: "house", path: volume, title: "Sample house" }]));
const { context, close } = await browse({ viewport: { width: 1440, height: 860 }, locale: "en-US", colorScheme: "light" });
const page = await context.newPage();
await page.goto(server.url);
const finished = () =>
  page.waitForFunction(() => document.querySelector("svt-app").session.picture.quality === "fine", null, { timeout: 120_000 });
await finished();
await page.evaluate(() => {
  const { session } = document.querySelector("svt-app");
  session.view.set({ hide: ["class=BuildingRoom"], sections: [{ axis: "y", at: 5, flip: true, turn: 0, tilt: 0 }], hatches: true });
  session.selection.select(["house_hidden_beam"]);
});
await page.click("#tool-section");
await finished();
await page.screenshot({ path: join(repository, "docs/images/viewer.png") });
await close();
await server.close();
rmSync(folder, { recursive: true, force: true });
