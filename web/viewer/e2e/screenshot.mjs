// Makes docs/images/viewer.png, the generated house, cut open, in the page, docs/images/viewer_comparison.png, two states of it,
// and docs/images/viewer_field.png, temperatures in it; or only the named ones. Needs `make viewer`.
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
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

/** Values of sensors in the ground floor, which spread through open doors. */
async function withField() {
  const at = (file) => join(folder, file);
  svt("sample", "house", "-o", at("warm.ifc"));
  svt("build", at("warm.ifc"), "-o", at("plain.svt"), "--spacing", "0.05", "--vectors", "edges,meshes");
  writeFileSync(at("places.csv"), "name,room\nliving,Living room\nkitchen,Kitchen\nhall,Hall\nstudy,Study\n");
  writeFileSync(at("warm.csv"), "time,living,kitchen,hall,study\n0,21,23,18,20\n1800,21.5,26,19,20\n3600,22,24,20,20.5\n");
  svt("field", "add", at("plain.svt"), at("warm.csv"), "--places", at("places.csv"), "--unit", "Cel", "--name", "sensors", "-q");
  svt("simulate", "spread", at("plain.svt"), "sensors", "--open", "class=Door", "-o", at("warm.svt"), "-q");
  const server = await serve(withModels([{ name: "warm", path: at("warm.svt"), title: "Sample house" }]));
  await page.goto(server.url);
  await finished();
  await page.evaluate(async () => {
    const { session } = document.querySelector("svt-app");
    session.view.set({ sections: [{ axis: "z", at: 1.5, flip: false, turn: 0, tilt: 90 }] });
    await session.view.goTo("", "iso");
  });
  await page.click("#tool-look");
  await page.locator("#field").selectOption("spread");
  await page.evaluate(() => {
    const { session } = document.querySelector("svt-app");
    session.view.set({ field: { name: "spread", time: 1800, isolines: 0.5 } });
  });
  await finished();
  const { x, y, width, height } = await page.locator("svt-picture").boundingBox();
  await page.mouse.click(x + width * 0.42, y + height * 0.55);
  await page.locator("svt-field svg.series").scrollIntoViewIfNeeded();
  return server;
}

const pictures = { viewer: cutOpen, viewer_comparison: compared, viewer_field: withField };
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
