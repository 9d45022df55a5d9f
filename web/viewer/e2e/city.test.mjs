// A city that the page fetches piece by piece: how much it asks for, what is seen, and servers that answer badly.
import assert from "node:assert/strict";
import { createReadStream, existsSync, readFileSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join } from "node:path";
import { after, before, describe, it } from "node:test";
import { page as pageFolder, policy, svt, svtJson, svtServe } from "./harness.mjs";
import { scratch, Visit } from "./visit.mjs";

const { at, drop } = scratch("svt-city-test-");
const kTypes = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".css": "text/css",
  ".svg": "image/svg+xml",
  ".wasm": "application/wasm",
  ".json": "application/json",
};
const kId = "BLDG_0000000100000005";
const servers = [];
const visit = new Visit();
let page;

const started = (server) => (servers.push(server), server);

/** Serves the page with the city; `answer(path, first, last, bytes)` may give another answer to a request for a part. */
function serveCity(answer = (_path, _first, _last, _part, _all) => null) {
  const server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url, "http://x").pathname).replace(/^\/+/, "") || "index.html";
    const own = path.startsWith("town/") ? at(path) : join(pageFolder, path);
    if (path === "models.json")
      return response.end(JSON.stringify({ models: [{ name: "town", title: "town", file: "town/", bytes: 0, city: true }] }));
    if (!existsSync(own) || !statSync(own).isFile()) return response.writeHead(404).end();
    const headers = { "Content-Type": kTypes[extname(path)] ?? "application/octet-stream", "Content-Security-Policy": policy };
    const range = /^bytes=(\d+)-(\d+)$/.exec(request.headers.range ?? "");
    if (!range) {
      response.writeHead(200, headers);
      return createReadStream(own).pipe(response);
    }
    const all = readFileSync(own),
      first = Number(range[1]),
      last = Math.min(Number(range[2]), all.length - 1);
    const part = all.subarray(first, last + 1);
    const other = answer(path, first, last, part, all);
    response.writeHead(other?.status ?? 206, { ...headers, "Content-Range": `bytes ${first}-${last}/${all.length}`, ...other?.headers });
    response.end(other?.body ?? part);
  });
  return new Promise((done) =>
    server.listen(0, "127.0.0.1", () =>
      done({
        url: `http://127.0.0.1:${/** @type {import("node:net").AddressInfo} */ (server.address()).port}/`,
        close: () => new Promise((r) => (server.closeAllConnections(), server.close(r))),
      }),
    ),
  );
}

const { inPage } = visit;
const complete = () => visit.until("s.model.city?.isComplete && s.picture.quality === 'fine'");

/** The camera in the middle of the city, near the ground, with all of its tiles. */
async function goToStreet() {
  const size = await inPage("s.volume.info.size");
  await inPage("s.view.set({ camera: { ...s.view.state.camera, eye: v.eye, target: v.target } })", {
    eye: [size[0] / 2, size[1] / 2, 60],
    target: [size[0] / 2 + 60, size[1] / 2 + 80, 5],
  });
  await page.waitForFunction(() => !document.querySelector("svt-app").session.model.city.isComplete);
  await complete();
}

async function open(url) {
  await visit.begin();
  page = visit.page;
  const asked = [];
  page.on(
    "request",
    (request) =>
      request.headers().range &&
      asked.push({ file: new URL(request.url()).pathname.replace(/^.*(town|models\/[^/]+)\//, ""), range: request.headers().range }),
  );
  await page.goto(url);
  return asked;
}

before(() => {
  svt("sample", "city", "--buildings", "1500", "--files", "2", "-o", at("files"));
  svt("city", "plan", at("files"), "-o", at("town"), "--spacing", "0.5");
  svt("city", "run", at("town"));
});
after(async () => {
  await visit.close();
  for (const server of servers) await server.close();
  drop();
});

describe("A city on the page", () => {
  it("is seen after 3 requests, and completely after few more", async () => {
    const server = started(await svtServe(at("town")));
    const asked = await open(server.url);
    await page.waitForFunction(() => performance.getEntriesByName("svt-first-image").length > 0);
    const first = asked.slice(0, 3).map(({ file }) => file);
    assert.equal(first[0], "city.json");
    assert.deepEqual(
      first
        .slice(1)
        .map((file) => file.replace(/\d+/, "N"))
        .sort(),
      ["index.bin", "packs/N.svtp"],
    );
    await complete();
    const { requests, bytes } = await inPage("s.model.city.files.traffic");
    assert.equal(requests, asked.length);
    assert.ok(requests <= 12, `${requests} requests`);
    assert.ok(bytes < 400_000, `${bytes} bytes`);
    const seen = await inPage(
      "({ look: { ...s.model.city.look, info: null }, buildings: s.volume.info.buildings, drawn: s.picture.report.width })",
    );
    assert.equal(seen.buildings, 1500);
    assert.equal(seen.look.pixels, 1);
    // Near the ground there are buildings with their attributes, and the address leads there again.
    await goToStreet();
    assert.equal(
      await inPage("s.model.city.look.finest"),
      0,
      JSON.stringify(
        await inPage(
          "[{ ...s.model.city.look, info: null }, s.view.state.camera, s.messages.message, s.model.city.files.traffic, s.model.city.phase, s.model.city.place]",
        ),
      ),
    );
    assert.ok((await inPage("s.volume.index.features.filter(({ class: c }) => c === 'Building').length")) > 10);
    const picked = await inPage("s.volume.engine.pick(0.5, 0.6)");
    assert.ok(picked?.id, "nothing in the middle of the picture");
    await page.waitForFunction(() => location.hash.includes("view="));
    const camera = await inPage("s.view.state.camera");
    await page.reload();
    await complete();
    assert.deepEqual(await inPage("s.view.state.camera"), camera);
  });

  it("draws sections of the whole city as the command does, and stays meanwhile", async () => {
    const server = started(await svtServe(at("town")));
    await open(server.url);
    await complete();
    const [width] = await inPage("s.volume.info.size");
    const plane = Number((width / 2).toFixed(2));
    svt("section", at("town"), "--plane", `x>${plane}`, "-o", at("d.svg"), "-o", at("d.dxf"), "--table", at("d.csv"));
    await inPage("s.view.set({ sections: [{ axis: 'x', at: v, flip: false, turn: 0, tilt: 0 }] })", plane);
    await visit.tool("section");
    assert.equal(await page.locator("#draw-sheets, #draw-beyond").count(), 0, "parts that a city cannot draw");
    const key = await inPage("s.model.city.look.key");
    for (const format of ["svg", "dxf", "csv"]) {
      const { name, bytes } = await visit.saved(() => page.click(`[aria-label="Export as ${format.toUpperCase()}"]`));
      assert.equal(name, `section-1.${format}`);
      assert.ok(bytes.toString() === readFileSync(at(`d.${format}`), "utf8"), `${format}, as the command makes it`);
    }
    assert.equal(await inPage("s.messages.progress"), null);
    assert.equal(await inPage("s.model.city.look.key"), key);
    await inPage("s.view.set({ sections: [{ axis: 'z', at: 400, flip: false, turn: 0, tilt: 90 }] })");
    await page.click('[aria-label="Export as SVG"]');
    await page.getByText("E503").first().waitFor();
    assert.ok((await inPage("s.volume.engine.select('all')")).length > 0, "the city can still be asked");
  });

  it("refuses drawings of a volume, and stays when they are asked for", async () => {
    const server = started(await svtServe(at("town")));
    await open(server.url);
    await complete();
    const codes = await page.evaluate(async () => {
      const { engine } = document.querySelector("svt-app").session.volume;
      const codeOf = (answer) =>
        answer.then(
          () => "",
          (error) => `${error.code} ${error.message}`,
        );
      return [await codeOf(engine.sheets("en")), await codeOf(engine.drawing("z=1", "svg")), await engine.select("all")];
    });
    assert.match(codes[0], /^E904 .*not a city/);
    assert.match(codes[1], /^E904 .*not a city/);
    assert.ok(codes[2].length > 0, "the city can still be asked");
  });

  it("says how much of the city its lists and counts cover, and groups the buildings by an attribute", async () => {
    const server = started(await serveCity());
    await open(server.url);
    await complete();
    const cover = () => page.locator("svt-tree #cover").innerText();
    assert.equal(await cover(), "Lists and counts cover 0 of 1,500 buildings: those near the camera.");
    await inPage("s.model.city.find(v)", kId);
    await page.waitForFunction((id) => document.querySelector("svt-app").session.selection.properties?.id === id, kId);
    await complete();
    const buildings = await inPage(
      "s.volume.index.features.filter(({ id, parent, class: c }) => !parent && c === 'Building' && id !== c).length",
    );
    assert.ok(buildings > 0 && buildings < 1500);
    assert.equal(await cover(), `Lists and counts cover ${buildings} of 1,500 buildings: those near the camera.`);
    await page.fill("#query", "class=Building");
    await page.press("#query", "Enter");
    await page.locator("svt-tree #query-answer").getByText(`of 1,500 buildings`).waitFor();
    await visit.tool("look");
    await page.selectOption("#color-by", "class");
    await page.locator("svt-color-legend .cover").getByText(`cover ${buildings} of 1,500`).waitFor();
    await page.locator("#tab-classes").click();
    await page.selectOption("#group-by", "roofType");
    const values = await inPage("s.volume.engine.attributeValues('roofType')");
    const counts = new Map();
    for (const value of values.values) if (value !== null) counts.set(String(value), (counts.get(String(value)) ?? 0) + 1);
    await visit.eventually(async () => assert.equal(await page.locator("svt-groups li").count(), counts.size));
    const [most] = [...counts].sort((a, b) => b[1] - a[1]);
    const row = page.locator("svt-groups li").first();
    assert.equal(await row.locator(".count").innerText(), String(most[1]));
    await row.locator("button.name").click();
    assert.equal(await inPage("s.view.state.selection.length"), most[1]);
    assert.deepEqual(visit.problems, []);
  });

  it("fetches nothing when the camera turns back", async () => {
    const server = started(await serveCity());
    const asked = await open(server.url);
    await complete();
    const camera = await inPage("s.view.state.camera");
    await goToStreet();
    const before = asked.length;
    await inPage("s.view.set({ camera: v })", camera);
    await page.waitForFunction(() => !document.querySelector("svt-app").session.model.city.isComplete);
    await complete();
    assert.deepEqual(asked.slice(before), []);
  });

  it("has a new plane in the middle of the view, and shadows of the sun", async () => {
    const server = started(await serveCity());
    await open(server.url);
    await complete();
    const target = await inPage("s.view.state.camera.target");
    await visit.tool("section");
    await page.click("#add-plane");
    const [plane] = await inPage("s.view.state.sections");
    assert.equal(plane.axis, "y");
    const [, near] = target;
    const { size } = await inPage("s.volume.info");
    assert.ok(Math.abs(plane.at - near) < 0.25 * size[1], `${plane.at}, the camera looks at ${target}`);
    await inPage("s.view.set({ sections: [] })");
    await complete();
    const plain = await inPage("s.volume.engine.picture(s.view.describe([320, 180], 1).scene).then((png) => png.byteLength)");
    await visit.tool("look");
    await page.locator("#sun").check();
    await visit.until("s.view.state.sun");
    await complete();
    const scene = await inPage("s.view.describe([320, 180], 1).scene.sun");
    assert.ok(scene?.time, "the place is that of the city");
    const sunny = await inPage("s.volume.engine.picture(s.view.describe([320, 180], 1).scene).then((png) => png.byteLength)");
    assert.notEqual(plain, sunny);
    assert.deepEqual(visit.problems, []);
  });

  it("finds a building by its id with two requests of ids.bin, and tells its properties", async () => {
    const server = started(await serveCity());
    const asked = await open(server.url);
    await complete();
    await inPage("s.model.city.find(v)", kId);
    await page.waitForFunction((id) => document.querySelector("svt-app").session.selection.properties?.id === id, kId);
    assert.ok(asked.filter(({ file }) => file === "ids.bin").length <= 2);
    const properties = await inPage("s.selection.properties");
    // Half a voxel of the tile along the surface, not one of the frame of the whole city.
    assert.ok(Math.abs(properties.voxelBound - properties.surface / 4) < 1e-6, JSON.stringify(properties));
    assert.ok(properties.surface > 50 && properties.box.high[2] > properties.box.low[2], JSON.stringify(properties));
    await page.getByRole("button", { name: "Highlight", exact: true }).first().waitFor();
    assert.equal(await page.getByRole("button", { name: "Cut away to it" }).count(), 0, "cities have no cutaway");
    await page.fill("#search", "nobody");
    await page.getByText("No building of the city has these words").waitFor();
    await page.press("#search", "Enter");
    await page.getByText("the city has no building with the id 'nobody'").first().waitFor();
  });

  it("finds buildings of the whole city by words, as the command does, with few requests", async () => {
    const server = started(await serveCity());
    const asked = await open(server.url);
    await complete();
    const found = page.locator("svt-city-search");
    const search = async (words) => {
      const { count, buildings } = svtJson("city", "find", at("town"), ...words.split(" "), "--json", "--most", "50");
      await page.fill("#search", words);
      await found.getByText(new RegExp(`^${count} in the whole city`)).waitFor();
      assert.equal(await found.locator("li").count(), buildings.length);
      return buildings;
    };
    const buildings = await search("roofType=1000");
    assert.ok(buildings.length > 1);
    assert.ok(asked.filter(({ file }) => file === "words.bin").length <= 3, "the fence, words and buildings");
    const last = buildings.at(-1);
    await found.locator("li button").last().click();
    await page.waitForFunction((id) => document.querySelector("svt-app").session.selection.properties?.id === id, last.id);
    assert.equal(await found.locator("li").count(), buildings.length, "the list stays while other tiles come");
    // By the keyboard: Enter goes to the first one, where no visible building has the words.
    const [first] = await search("storeysAboveGround=3 roofType=1000");
    await page.fill("#search", "nobody at all");
    await found.getByText("No building of the city has these words").waitFor();
    // Enter waits for the answer to the words that the field has.
    await page.fill("#search", "storeysAboveGround=3 roofType=1000");
    await page.press("#search", "Enter");
    await page.waitForFunction((id) => document.querySelector("svt-app").session.selection.properties?.id === id, first.id);
    assert.deepEqual(visit.problems, []);
  });

  it("states where words cannot be searched: in cities of earlier programs, and where the index is damaged", async () => {
    /** @type {[Parameters<typeof serveCity>[0], RegExp][]} */
    const kSpoiled = [
      [(path) => (path.endsWith("words.bin") ? { status: 404, body: "" } : null), /words/],
      [
        (path, _first, _last, part) => (path.endsWith("words.bin") ? { body: Buffer.from(part.map((byte) => byte ^ 255)) } : null),
        /damaged/,
      ],
    ];
    for (const [spoil, said] of kSpoiled) {
      const server = started(await serveCity(spoil));
      await open(server.url);
      await complete();
      await page.fill("#search", "roofType=1000");
      await page.locator("svt-city-search .error").getByText(said).waitFor();
    }
  });

  it("shows the rest where tiles are damaged, cut off or missing", async () => {
    // Every part of a pack but the top tile: one byte wrong; one byte too few, and no more.
    const top = JSON.parse(readFileSync(at("town/city.json"), "utf8")).top;
    const isTop = (path, first) => path.endsWith(`${String(top.pack).padStart(5, "0")}.svtp`) && first === top.offset;
    for (const spoil of [
      (part) => ({ body: Buffer.concat([part.subarray(0, 40), Buffer.from([part[40] ^ 255]), part.subarray(41)]) }),
      (part, first, last, all) => ({
        body: part.subarray(0, -1),
        headers: { "Content-Range": `bytes ${first}-${last - 1}/${all.length}` },
      }),
      () => ({ status: 404, body: "" }),
    ]) {
      const server = started(
        await serveCity((path, first, last, part, all) =>
          path.startsWith("town/packs/") && !isTop(path, first) ? spoil(part, first, last, all) : null,
        ),
      );
      await open(server.url);
      await page.getByText("tiles of the city cannot be shown").first().waitFor();
      await complete();
      assert.equal(await inPage("s.model.status"), "ready");
    }
  });

  it("names missing tiles, fetches them again, and takes its note back", async () => {
    const top = JSON.parse(readFileSync(at("town/city.json"), "utf8")).top;
    let isBroken = true,
      refused = 0;
    const server = started(
      await serveCity((path, first) => {
        const isTop = path.endsWith(`${String(top.pack).padStart(5, "0")}.svtp`) && first === top.offset;
        return isBroken && path.startsWith("town/packs/") && !isTop ? (++refused, { status: 404, body: "" }) : null;
      }),
    );
    await open(server.url);
    const note = page.locator("#missing-tiles");
    await note.getByText(/^\d+ tiles? (is|are) missing$/).waitFor();
    const before = refused;
    await visit.eventually(async () => assert.ok(refused > before, "the page asks again by itself"));
    isBroken = false;
    await note.getByRole("button").click();
    await note.waitFor({ state: "detached" });
    await complete();
    assert.deepEqual(await inPage("s.model.city.lacks"), []);
    // Without a click.
    isBroken = true;
    await page.reload();
    await note.waitFor();
    isBroken = false;
    await note.waitFor({ state: "detached" });
    assert.equal(await page.locator("#said").textContent(), "The missing tiles have come.");
  });

  it("names a server without ranges, and an index that is damaged", async () => {
    const whole = started(await serveCity((_path, _first, _last, _part, all) => ({ status: 200, body: all })));
    await open(whole.url);
    await page.getByText("the server sends whole files instead of parts").first().waitFor();
    const damaged = started(
      await serveCity((path, _first, _last, part) =>
        path.endsWith("index.bin") ? { body: Buffer.concat([part.subarray(0, 50), Buffer.from([part[50] ^ 1]), part.subarray(51)]) } : null,
      ),
    );
    await open(damaged.url);
    await page.getByText("the root of the index is missing or damaged").first().waitFor();
  });
});
