// Makes docs/images/viewer.png, the generated house, cut open, in the page, and docs/images/viewer_comparison.png, two states of
// it; or only the named ones. Needs `make viewer`.
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { browse, repository, serve, svt, withModels } from "./harness.mjs";

const folder = mkdtempSync(join(tmpdir(), "svt-viewer-picture-"));

function listed(name, title, vectors, ...options) {
  const model = join(folder, `${name}.gml`),
    path = join(folder, `${name}.svt`);
  svt("sample", "house", "-o", model, ...options);
  svt("build", model, "-o", path, "--spacing", "0.03", "--vectors", vectors);
  return { name, path, title };
}

const { context, close } = await browse({ viewport: { width: 1440, height: 860 }, locale: "en-US", colorScheme: "light" });
const page = await context.newPage();
page.setDefaultTimeout(240_000);
const finished = () =>
  page.waitForFunction(() => {
    const { picture, view } = document.querySelector("svt-app").session;
    return picture.quality === "fine" && view.hasFaces;
  });

async function cutOpen() {
  const server = await serve(withModels([listed("house", "Sample house", "edges")]));
  await page.goto(server.url);
  await finished();
  await page.evaluate(() => {
    const { session } = document.querySelector("svt-app");
    session.view.set({ hide: ["class=BuildingRoom"], sections: [{ axis: "y", at: 5, flip: true, turn: 0, tilt: 0 }], hatches: true });
    session.selection.select(["house_hidden_beam"]);
  });
  await page.click("#tool-section");
  return server;
}

async function compared() {
  const old = listed("old", "Sample house", "edges,meshes"),
    later = listed("new", "Sample house, later", "edges,meshes", "--change", "4");
  const server = await serve(withModels([old, later]));
  await page.goto(`${server.url}?old=old&new=new`);
  await page.locator("svt-changes #changes-summary").waitFor();
  return server;
}

const pictures = { viewer: cutOpen, viewer_comparison: compared };
const wanted = process.argv.slice(2);
for (const [name, show] of Object.entries(pictures)) {
  if (wanted.length && !wanted.includes(name)) continue;
  const server = await show();
  await finished();
  await page.screenshot({ path: join(repository, `docs/images/${name}.png`) });
  await server.close();
}
await close();
rmSync(folder, { recursive: true, force: true });
