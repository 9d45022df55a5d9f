// The library of the package svt, in Node.js and in a browser, and the command run from a program: the bytes of the command.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { before, describe, it } from "node:test";
import { pathToFileURL } from "node:url";
import { browserPath, svt } from "../../../web/viewer/e2e/harness.mjs";
import { at, makeHouse, putShared, serve, Visitor } from "./site.mjs";

const resolve = createRequire(at("package.json")).resolve;
/** A module as a program in the folder imports it. */
const load = (name) => import(pathToFileURL(resolve(name)).href);
const kName = "@semantic-volume-texture/svt";
const kScene = { size: [320, 200], look: "paper", passes: [{ hide: ["class=BuildingRoom"], cut: "y<5" }], names: ["class=Window"] };

/** What the command gives for the same: the picture, its labels, a plan, the rooms. */
function expected(model) {
  writeFileSync(at("library.scene.json"), JSON.stringify({ format: "svt-scene", version: 1, ...kScene }));
  svt("render", at(model), "-o", at("p.png"), "--scene", at("library.scene.json"), "--labels", at("l.png"), "--quiet");
  svt("section", at(model), "--plane", "z=1.2", "-o", at("plan.svg"), "--quiet");
  const rooms = JSON.parse(svt("query", at(model), "class=BuildingRoom", "--json").toString()).map(({ id }) => id);
  return { picture: readFileSync(at("p.png")), labels: readFileSync(at("l.png")), drawing: readFileSync(at("plan.svg")), rooms };
}

before(makeHouse);

describe("the library in Node.js", () => {
  it("gives the bytes of the command, from a path, an address and bytes", async () => {
    const { open } = await load(kName);
    const wanted = expected("house.svt");
    const site = await serve();
    for (const source of [
      at("house.svt"),
      pathToFileURL(at("house.svt")),
      `${site.url}house.svt`,
      { name: "house.svt", bytes: readFileSync(at("house.svt")) },
      new File([readFileSync(at("house.svt"))], "house.svt"),
    ]) {
      const volume = await open(source);
      assert.ok(volume.info.features.length > 50);
      assert.ok(Buffer.from(await volume.picture(kScene)).equals(wanted.picture));
      assert.ok(Buffer.from(await volume.labels(kScene)).equals(wanted.labels));
      assert.ok(Buffer.from(await volume.drawing("z=1.2", "svg")).equals(wanted.drawing));
      assert.deepEqual(await volume.select("class=BuildingRoom"), wanted.rooms);
      assert.equal((await volume.properties(wanted.rooms[0])).id, wanted.rooms[0]);
      volume.close();
    }
    await site.close();
  });

  it("builds models, several at a time, and leaves the globals of Node.js as they are", async () => {
    const { open } = await load(kName);
    const steps = [];
    const [model, volume] = await Promise.all([open(at("house.gml"), { onProgress: (step) => steps.push(step) }), open(at("house.svt"))]);
    assert.ok(steps.includes("voxelize"));
    assert.ok(Buffer.from(await model.picture(kScene)).equals(expected("house.gml").picture));
    assert.ok(Buffer.from(await volume.picture(kScene)).equals(expected("house.svt").picture));
    const { scene, effects } = {
      scene: { size: [320, 200], passes: [{}] },
      effects: { highlight: { queries: ["class=Window"], context: "ghost" } },
    };
    svt("render", at("house.svt"), "-o", at("p.png"), "--size", "320x200", "--highlight", "class=Window", "--quiet");
    assert.ok(Buffer.from(await volume.picture(await volume.compose(scene, effects))).equals(readFileSync(at("p.png"))));
    assert.equal(globalThis.self, undefined);
  });

  it("rejects with errors that have codes", async () => {
    const { open, SvtError } = await load(kName);
    const fails = async (made, code) => {
      const error = await made.then(
        () => null,
        (caught) => caught,
      );
      assert.ok(error instanceof SvtError && error instanceof Error, String(error));
      assert.equal(/** @type {any} */ (error).code, code);
      assert.ok(error.message.length > 10);
    };
    await fails(open(at("none.svt")), "E101");
    await fails(open([]), "E904");
    await fails(open({ name: "a.svt", bytes: new Uint8Array([1, 2, 3]) }), "E103");
    const volume = await open(at("house.svt"));
    await fails(volume.select("class="), "E901");
    volume.close();
    await fails(volume.select("all"), "E904");
  });

  it("runs the command", async () => {
    const { run } = await load(`${kName}/command`);
    const done = await run(["query", "house.svt", "class=BuildingRoom", "--csv"], { cwd: at("") });
    assert.deepEqual([done.code, done.stderr], [0, ""]);
    const bin = at("node_modules/.bin/svt");
    assert.ok(Buffer.from(done.stdout).equals(execFileSync(bin, ["query", at("house.svt"), "class=BuildingRoom", "--csv"])));
    const failed = await run(["info", "none.svt"], { cwd: at("") });
    assert.equal(failed.code, 3);
    assert.match(failed.stderr, /error E101 CannotOpen: none\.svt/);
  });

  it("names its files and types for other programs", () => {
    for (const name of ["svt", "viewer"]) {
      const root = at(`node_modules/@semantic-volume-texture/${name}/`);
      const described = JSON.parse(readFileSync(`${root}package.json`, "utf8"));
      const paths = JSON.stringify([described.exports, described.bin ?? {}, described.types]).match(/\.?\/?[\w-]+(\/[\w.-]+)+/g);
      for (const path of paths) if (!path.includes("*")) assert.ok(existsSync(`${root}${path}`), `${name}: ${path}`);
      for (const member of ["version", "description", "license", "author", "keywords", "engines", "files", "sideEffects", "type"])
        assert.ok(member in described, `${name}: ${member}`);
      const version = /^project\(svt VERSION ([\d.]+)/m.exec(readFileSync(new URL("../../../CMakeLists.txt", import.meta.url), "utf8"))[1];
      assert.equal(described.version, version);
    }
  });
});

describe("the library in a browser", { skip: existsSync(browserPath) ? false : "chromium is missing (scripts/setup.sh web)" }, () => {
  const visitor = new Visitor();

  it("gives the bytes of the command, and ends with its worker", async () => {
    putShared();
    const site = await serve();
    const page = await visitor.show(site, "");
    const made = await page.evaluate(
      async ([script, scene]) => {
        const { open } = await import(script);
        const text = (bytes) => btoa(Array.from(new Uint8Array(bytes), (c) => String.fromCharCode(c)).join(""));
        const volume = await open("house.svt");
        const code = await volume.select("class=").catch((error) => error instanceof Error && /** @type {any} */ (error).code);
        const made = {
          picture: text(await volume.picture(scene)),
          drawing: text(await volume.drawing("z=1.2", "svg")),
          rooms: await volume.select("class=BuildingRoom"),
          code,
          none: await open("none.svt").catch((error) => error.code),
        };
        volume.close();
        return made;
      },
      [`/node_modules/${kName}/library/browser.js`, kScene],
    );
    const wanted = expected("house.svt");
    assert.ok(Buffer.from(made.picture, "base64").equals(wanted.picture));
    assert.ok(Buffer.from(made.drawing, "base64").equals(wanted.drawing));
    assert.deepEqual(made.rooms, wanted.rooms);
    assert.deepEqual([made.code, made.none], ["E901", "E101"]);
    await page.waitForTimeout(300);
    assert.equal(page.workers().length, 0);
    await site.close();
  });
});
