// The packages in programs of others: bundled by Vite and by esbuild, imported on a server, and checked by TypeScript.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, rmSync } from "node:fs";
import { join } from "node:path";
import { before, describe, it } from "node:test";
import { browserPath, repository } from "../../../web/viewer/e2e/harness.mjs";
import { at, htmlOf, makeHouse, put, putShared, serve, Visitor } from "./site.mjs";

const bin = (name) => join(repository, "web/viewer/node_modules/.bin", name);
/** Runs a program in the folder; throws with what it said where it fails. */
function run(program, ...words) {
  const { status, stdout, stderr } = spawnSync(program, words, { cwd: at(""), encoding: "utf8" });
  assert.equal(status, 0, stdout + stderr);
  return stdout;
}
/** Files that esbuild leaves to the page. */
const kThreads = ["svt_threads", "svt_view_threads"].flatMap((name) => [`${name}.js`, `${name}.wasm`, `${name}.worker.js`]);
const kBeside = ["worker.js", "svt_view.wasm", "svt.wasm", ...kThreads, "DejaVuSans.ttf"];
const kBody = '<svt-viewer id="a" src="/house.svt" section="z>1.6" names="class=BuildingRoom"></svt-viewer>';
const visitor = new Visitor();

before(() => {
  makeHouse();
  putShared();
});

/** The element and the library work in a page of a folder. */
async function works(root) {
  copyFileSync(at("house.svt"), join(root, "house.svt"));
  for (const name of ["page.css", "events.js"]) copyFileSync(at(name), join(root, name));
  const site = await serve({ root });
  await visitor.visit(`${site.url}index.html`);
  await visitor.loaded("a");
  assert.ok((await visitor.snapshot("a")).length > 2000);
  await visitor.page.waitForFunction(() => /** @type {any} */ (window).rooms > 3);
  assert.deepEqual(visitor.problems, []);
  await site.close();
}

describe("bundlers", { skip: existsSync(browserPath) ? false : "chromium is missing (scripts/setup.sh web)" }, () => {
  const script = (assets) => `import { SvtViewer } from "@semantic-volume-texture/viewer";
import { open } from "@semantic-volume-texture/svt";
${assets ? `SvtViewer.assets = "${assets}";` : "void SvtViewer;"}
const volume = await open("/house.svt"${assets ? `, { assets: "${assets}" }` : ""});
window.rooms = (await volume.select("class=BuildingRoom")).length;
`;
  const head = (name) =>
    `<link rel="stylesheet" href="/page.css"><script src="/events.js"></script><script type="module" src="${name}"></script>`;

  it("such as Vite find all files", async () => {
    rmSync(at("app"), { recursive: true, force: true });
    put("app/main.js", script(""));
    put("app/index.html", htmlOf(kBody, head("/main.js")));
    put(
      "app/vite.config.js",
      "export default { build: { outDir: '../built', emptyOutDir: true, target: 'es2022', assetsInlineLimit: 0 }, worker: { format: 'es' } };",
    );
    run(bin("vite"), "build", "app", "--logLevel", "error");
    await works(at("built"));
  });

  it("such as esbuild need the files beside", async () => {
    for (const assets of ["", "/files/"]) {
      const root = at(assets ? "esbuild2" : "esbuild1");
      mkdirSync(join(root, assets || "."), { recursive: true });
      put("main.js", script(assets));
      run(
        bin("esbuild"),
        "main.js",
        "--bundle",
        "--format=esm",
        "--splitting",
        "--conditions=browser",
        `--outdir=${root}`,
        "--log-level=error",
      );
      for (const name of kBeside) copyFileSync(at(`node_modules/@semantic-volume-texture/viewer/dist/${name}`), join(root, assets, name));
      put(join(assets ? "esbuild2" : "esbuild1", "index.html"), htmlOf(kBody, head("/main.js")));
      await works(root);
    }
  });
});

describe("other programs", () => {
  it("may import the element where no page is", () => {
    put(
      "server.mjs",
      'import { SvtViewer } from "@semantic-volume-texture/viewer"; console.log(typeof SvtViewer, SvtViewer.observedAttributes.length);',
    );
    assert.match(run(process.execPath, "server.mjs"), /^function \d+\n$/);
  });

  it("get types, by both ways to resolve modules", () => {
    put(
      "types.mts",
      `import { SvtViewer, type PickDetail } from "@semantic-volume-texture/viewer";
import { open, type Scene, type Volume } from "@semantic-volume-texture/svt";
import { run } from "@semantic-volume-texture/svt/command";
const element: SvtViewer = document.createElement("svt-viewer");
element.section = "z<1.2";
element.scaleBar = true;
element.addEventListener("pick", (event) => { const detail: PickDetail = event.detail; console.log(detail.pick?.id); });
element.addEventListener("error", ({ detail }) => console.log(detail.code, detail.message));
const png: Blob = await element.snapshot({ width: 100 });
const scene: Scene = { size: [100, 100], look: "paper" };
const volume: Volume = await open("house.svt");
const ids: string[] = await volume.select("all");
const code: number = (await run(["info"])).code;
console.log(png, scene, ids, code);
// @ts-expect-error a look that is none
const wrong: Scene = { look: "fancy" };
// @ts-expect-error no such property
element.cuts = "z<1";
// @ts-expect-error a call that needs a picture
await volume.pick(0, 0);
console.log(wrong);
`,
    );
    for (const module of ["NodeNext", "ESNext"]) {
      const moduleResolution = module === "ESNext" ? "Bundler" : module;
      const compilerOptions = { noEmit: true, strict: true, target: "ES2022", lib: ["ES2022", "DOM"], types: [], module, moduleResolution };
      put("tsconfig.json", JSON.stringify({ compilerOptions, files: ["types.mts"] }));
      run(bin("tsc"));
    }
  });
});
