// The WebAssembly module against the command: the same bytes for the same questions. Run by ctest, or by
//   node tests/web/module_test.mjs COMMAND MODULE_FOLDER
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, test } from "node:test";
import { pathToFileURL } from "node:url";

const [command, moduleFolder] = process.argv.slice(2).map((path) => resolve(path));
if (!existsSync(join(moduleFolder, "svt.js"))) {
  console.log(`no module at ${moduleFolder}; 'make web' builds it`);
  process.exit(77);
}
// What the module asks of a browser.
Object.assign(globalThis, { self: { location: { href: pathToFileURL(join(moduleFolder, "svt.js")).href } } });
const { default: createSvt } = await import(self.location.href);
const wasm = readFileSync(join(moduleFolder, "svt.wasm"));

const folder = mkdtempSync(join(tmpdir(), "svt-web-"));
after(() => rmSync(folder, { recursive: true }));
const at = (name) => join(folder, name);
const run = (...args) => execFileSync(command, args, { encoding: "utf8", stdio: ["ignore", "pipe", "pipe"], maxBuffer: 1 << 28 });
const rows = (...args) => JSON.parse(run(...args, "--json"));

const steps = [];
const svt = await createSvt({ wasmBinary: wasm, onProgress: (step, done) => steps.push([step, done]) });
const text = (name, ...args) => new TextDecoder().decode(svt.call(name, args));
const ask = (name, ...args) => JSON.parse(text(name, ...args));
const bytes = (name, ...args) => Buffer.from(svt.call(name, args));
const open = (file) => JSON.parse(new TextDecoder().decode(svt.call("open", [file.split("/").pop()], readFileSync(file))));

svt.call("font", [], readFileSync(join(moduleFolder, "DejaVuSans.ttf")));

const kScenes = {
  plain: {},
  cut: {
    look: "paper",
    samples: 4,
    camera: { preset: "iso-sw" },
    hatches: { show: true },
    passes: [{ hide: ["class=BuildingRoom"], cut: "z>1.4" }],
  },
  glass: {
    look: "dark",
    samples: 1,
    camera: { eye: [-8, -6, 9], target: [4, 4, 1.5] },
    passes: [{ styles: [{ select: "all", ghost: true }] }, { show: ["class=BuildingRoom"], join: "depth" }],
  },
  named: { camera: { preset: "front", parallel: true }, passes: [{ hide: ["class=BuildingRoom"] }], names: ["class=Window"] },
};

function makeHouse() {
  run("sample", "house", "-o", at("house.gml"));
  run("build", at("house.gml"), "-o", at("house.svt"));
  return [at("house.gml"), at("house.svt")];
}
const [houseModel, houseVolume] = makeHouse();

function comparePictures(file, names = Object.keys(kScenes)) {
  for (const name of names) {
    const scene = { size: [320, 200], ...kScenes[name] };
    writeFileSync(at("s.scene.json"), JSON.stringify({ format: "svt-scene", version: 1, ...scene }));
    run("render", file, "-o", at("p.png"), "--scene", at("s.scene.json"), "--labels", at("l.png"));
    assert.ok(bytes("labels", scene).equals(readFileSync(at("l.png"))), `labels of '${name}'`);
    assert.ok(bytes("picture", scene).equals(readFileSync(at("p.png"))), `picture of '${name}'`);
  }
}

test("a volume has the features that the command lists", () => {
  const info = open(houseVolume);
  const listed = rows("info", houseVolume);
  const all = new Map([...listed.objects, ...listed.features].map((feature) => [feature.id, feature]));
  assert.equal(info.features.length, all.size);
  for (const feature of info.features) {
    const other = all.get(feature.id);
    assert.deepEqual(
      [feature.class, feature.name, feature.parent, feature.first, feature.count],
      [other.class, other.name, other.parent ?? "", other.first, other.count],
    );
  }
  assert.deepEqual(info.dimension, listed.grid.dimension);
  assert.deepEqual(info.spacing, listed.grid.spacing);
  assert.ok(info.storeys.length > 0 && info.storeys.every((storey) => storey.top > storey.floor));
  assert.equal(info.hasEdges, false);
  const described = rows("query", houseVolume, "all");
  const spaces = new Set(info.features.filter(({ isSpace }) => isSpace).map(({ id }) => id));
  for (const { name, count, onSpaces, isNumber } of info.attributeUses) {
    const having = described.filter(({ attributes = {} }) => name in attributes);
    const isOfNumbers = having.every(({ attributes }) => typeof attributes[name] === "number");
    assert.deepEqual([count, onSpaces, isNumber], [having.length, having.filter(({ id }) => spaces.has(id)).length, isOfNumbers], name);
  }
  const isMember = ({ groups = [] }) => groups.some((group) => info.features[group].id === "house_storey_0");
  const below = new Set(rows("query", houseVolume, "storey=house_storey_0").map(({ id }) => id));
  const members = info.features.filter(isMember).map(({ id }) => id);
  assert.ok(members.length > 0 && members.every((id) => below.has(id)), members.join());
});

test("pictures and labels are those of the command, byte by byte", () => {
  open(houseVolume);
  comparePictures(houseVolume);
});

test("a model gives the volume that the command builds of it, with its edges", () => {
  steps.length = 0;
  const info = open(houseModel);
  assert.ok(info.hasEdges);
  assert.ok(steps.some(([step]) => step === "voxelize") && steps.every(([, done]) => done >= 0 && done <= 1));
  comparePictures(houseModel, ["plain", "cut"]);
  const listed = rows("info", houseModel);
  const counts = new Map(listed.objects.map((object) => [object.id, object.voxels * voxelVolume(listed.grid)]));
  for (const feature of info.features.filter(({ count }) => count > 0).slice(0, 12))
    assert.equal(ask("properties", feature.id).voxelVolume, counts.get(feature.id));
});

const voxelVolume = ({ spacing: [x, y, z] }) => x * y * z;

test("properties, neighbours and selections are rows of 'svt query'", () => {
  open(houseVolume);
  const { grid } = rows("info", houseVolume);
  const selected = rows("query", houseVolume, "class=BuildingRoom", "--with", "volume,surface,box");
  assert.deepEqual(
    ask("select", "class=BuildingRoom"),
    selected.map(({ id }) => id),
  );
  const areas = new Map(rows("query", houseVolume, "all", "--areas").map(({ id, area }) => [id, area]));
  assert.equal(ask("properties", "house_hidden_beam").floorArea, null);
  for (const row of selected) {
    const properties = ask("properties", row.id);
    assert.equal(properties.floorArea, areas.get(row.id) ?? null);
    assert.equal(properties.surface, row.ownSurface.area);
    assert.equal(properties.totalSurface, row.totalSurface.area);
    assert.equal(properties.voxelVolume, row.ownVoxels * voxelVolume(grid));
    assert.equal(properties.totalVolume, row.totalVolume);
    assert.equal(properties.modelVolume, row.closed ? row.solidVolume : null);
    assert.deepEqual(
      properties.box.low,
      row.totalBox.min.map((x, axis) => x - grid.origin[axis]),
    );
    const neighbours = rows("query", houseVolume, `id="${row.id}"`, "--neighbours").filter((n) => n.neighbour !== null);
    assert.deepEqual(
      properties.neighbours,
      neighbours.map((n) => ({ id: n.neighbour, class: n.neighbourClass, name: n.neighbourName, area: n.area })),
    );
  }
});

test("values of an attribute are those of 'svt query', null for features without it", () => {
  const { features } = open(houseVolume);
  const known = new Map(rows("query", houseVolume, "all").map(({ id, attributes = {} }) => [id, attributes]));
  const names = [...new Set([...known.values()].flatMap((attributes) => Object.keys(attributes)))];
  let numbers = 0;
  for (const name of [...names.slice(0, 12), "nothing"]) {
    const { values } = ask("attributeValues", name);
    assert.equal(values.length, features.length);
    features.forEach(({ id }, n) => {
      const expected = known.get(id)?.[name] ?? null;
      numbers += typeof values[n] === "number" ? 1 : 0;
      if (typeof expected === "number")
        assert.ok(values[n] === expected || String(values[n]).startsWith(String(expected)), `${id} ${name}`);
      else if (typeof expected === "string" || expected === null) assert.equal(values[n], expected, `${id} ${name}`);
    });
  }
  assert.ok(numbers > 0);
});

test("a draft has as many pixels as the picture, and is picked as it is", () => {
  open(houseVolume);
  const scene = { ...kScenes.plain, size: [64, 40], samples: 1 };
  const [draft, picture] = [true, false].map((isDraft) => {
    const pixels = svt.call("draw", [scene, 64, 40, isDraft]).length;
    return { pixels, id: ask("pick", 0.5, 0.5).id };
  });
  assert.deepEqual(draft, picture);
});

test("what is picked is what the label buffer has there, and lies on the ray", () => {
  open(houseVolume);
  const scene = { ...kScenes.plain, size: [64, 40], samples: 1 };
  assert.equal(ask("pick", 0.5, 0.5), null, "nothing is drawn yet");
  assert.equal(svt.call("draw", [scene, 64, 40]).length, 64 * 40 * 4);
  const hit = ask("pick", 0.5, 0.5);
  const line = ask("along", 0.5, 0.5);
  assert.equal(line[0].id, hit.id);
  assert.ok(line.every(({ from, to }, n) => to > from && (n === 0 || from >= line[n - 1].to - 1e-9)));
  const { features, size } = open(houseVolume);
  const owner = features.find(({ id }) => id === hit.id);
  assert.ok(hit.scalar >= owner.first && hit.scalar < owner.first + owner.count);
  assert.ok(hit.point.every((x, axis) => x > -1 && x < size[axis] + 1));
});

test("effects and drawings are those of the command", () => {
  open(houseVolume);
  const lens = { region: "view(0.5,0.5,0.3)", cut: "y<4", context: "ghost" };
  run(
    "render",
    houseVolume,
    "-o",
    at("p.png"),
    "--size",
    "64x40",
    "--lens",
    lens.region,
    "--section",
    lens.cut,
    "--write-scene",
    at("lens.json"),
  );
  const scene = { size: [64, 40] };
  assert.deepEqual(ask("compose", scene, { lens }), JSON.parse(readFileSync(at("lens.json"), "utf8")));
  for (const format of ["svg", "dxf", "geojson"]) {
    run("section", houseVolume, "-o", at(`d.${format}`), "--plane", "z=1.2");
    assert.equal(text("drawing", "z=1.2", format), readFileSync(at(`d.${format}`), "utf8"));
  }
  run("section", houseVolume, "--table", at("d.csv"), "--plane", "z=1.2");
  assert.equal(text("drawing", "z=1.2", "csv"), readFileSync(at("d.csv"), "utf8"));
});

test("a view shows what is selected", () => {
  open(houseVolume);
  const seen = ask("view", "class=BuildingRoom", "front", { parallel: true });
  const again = ask("view", "class=BuildingRoom", null, seen);
  for (const member of ["eye", "target"])
    again[member].forEach((x, axis) => assert.ok(Math.abs(x - seen[member][axis]) < 1e-6, `${member} ${x}`));
});

const fails = (code, act) => assert.throws(act, (/** @type {any} */ error) => error.code === code && error.message.length > 10);

test("errors have their codes, and leave what was open as it was", () => {
  const before = open(houseVolume);
  fails("E103", () => svt.call("open", ["bad.gml"], new TextEncoder().encode("not a model")));
  const damaged = readFileSync(houseVolume);
  damaged.fill(0x55, damaged.length >> 1, (damaged.length >> 1) + 64);
  assert.throws(
    () => svt.call("open", ["bad.svt"], damaged),
    ({ code }) => code === "E401" || code === "E402",
  );
  fails("E901", () => svt.call("select", ["class=="]));
  fails("E902", () => svt.call("properties", ["nobody"]));
  fails("E502", () => svt.call("draw", [{}, 0, 10]));
  fails("E504", () => svt.call("picture", [{ passes: [{ hidden: [] }] }]));
  assert.equal(ask("select", "all").length, before.features.length);
});

/** An IFC file with a box as #7, its map as #8 and `records`. */
const ifcOf = (records) =>
  `ISO-10303-21;
HEADER;
FILE_SCHEMA(('IFC4'));
ENDSEC;
DATA;
#1=IFCCARTESIANPOINT((0.,0.,0.));
#2=IFCAXIS2PLACEMENT3D(#1,$,$);
#3=IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#1,1.,$);
#7=IFCBLOCK(#2,1.,2.,3.);
#8=IFCREPRESENTATIONMAP(#2,#9);
#9=IFCSHAPEREPRESENTATION($,'Body','CSG',(#7));
#10=IFCPRODUCTDEFINITIONSHAPE($,$,(#11));
${records}
ENDSEC;
END-ISO-10303-21;
`;
const shapeOf = (items) => `#11=IFCSHAPEREPRESENTATION($,'Body','MappedRepresentation',(${items.join(",")}));\n`;
const wallOf = (id) => `#${id}=IFCWALL('w${id}',$,$,$,$,$,#10,$,$);\n`;
const ids = (first, count) => Array.from({ length: count }, (_, n) => first + n);

test("hostile models end with their codes, and the next model opens", () => {
  const box = ifcOf(wallOf(20) + shapeOf(["#7"]));
  const items = ids(1000, 3000);
  const bomb = ifcOf(
    ids(5000, 200).map(wallOf).join("") +
      shapeOf(items.map((id) => `#${id}`)) +
      items.map((id) => `#${id}=IFCMAPPEDITEM(#8,#3);\n`).join(""),
  );
  const circle = ifcOf(
    wallOf(20) +
      shapeOf(["#30"]) +
      "#30=IFCMAPPEDITEM(#31,#3);\n#31=IFCREPRESENTATIONMAP(#2,#32);\n#32=IFCSHAPEREPRESENTATION($,'Body','CSG',(#30));",
  );
  const openText = (text) => JSON.parse(new TextDecoder().decode(svt.call("open", ["a.ifc"], new TextEncoder().encode(text))));
  for (const [code, text] of [
    ["E104", bomb],
    ["E109", circle],
    ["E137", box.slice(0, box.indexOf("ENDSEC;\nEND"))],
  ]) {
    fails(code, () => openText(text));
    assert.equal(openText(box).features[0].id, "w20", `after ${code}`);
  }
  // Beside a wall that is sound, the circle is a finding.
  const { findings } = openText(
    circle.replace("#30=", "#40=IFCWALL('sound',$,$,$,$,$,#41,$,$);\n#41=IFCPRODUCTDEFINITIONSHAPE($,$,(#9));\n#30="),
  );
  assert.ok(findings.some((finding) => finding.includes("E111")));
});

/** Answers the module with ranges of bytes of the city's folder until a call has all that it needs. */
function askCity(city, call, argsOf) {
  for (let round = 0; ; ++round) {
    const reply = ask(call, ...argsOf(round));
    if (!reply.needs) return reply;
    const given = reply.needs.map(([name, offset, size]) => {
      const all = readFileSync(join(city, name));
      return { row: [name, offset, size], bytes: all.subarray(offset, offset + size), total: all.length };
    });
    const rows = given.map(({ row, bytes, total }) => [...row, bytes.length, total, null]);
    svt.call("cityGive", [rows], Buffer.concat(given.map(({ bytes }) => bytes)));
  }
}

/** Shows the part of a city that a scene shows. */
const look = (city, scene, isOther) =>
  askCity(city, "cityLook", (round) => [isOther && round === 0, scene, ...scene.size, { pixels: 1, memory: 1e9, shown: "" }]);

test("a city is drawn as by the command, near and far, with styles by class and shadows", () => {
  run("sample", "district", "--columns", "24", "--rows", "3", "-o", at("town.gml"));
  run("city", "plan", at("town.gml"), "-o", at("town"), "--spacing", "0.4", "--quiet");
  run("city", "run", at("town"), "--quiet");
  const styles = [{ styles: [{ select: "class=Building", color: "#c04030" }] }];
  const scenes = {
    near: { camera: { zoom: 6 } },
    far: { camera: { zoom: 0.1 }, passes: styles },
    cut: { camera: { preset: "iso-sw" }, passes: [{ ...styles[0], cut: "y<20" }] },
    street: { camera: { eye: [-20, -20, 5], target: [40, 30, 2] }, sun: { time: "2026-06-21 17:00Z", place: [52.5, 13.4] } },
  };
  const details = Object.entries(scenes).map(([name, members], n) => {
    const scene = { size: [320, 200], ...members };
    writeFileSync(at("s.scene.json"), JSON.stringify({ format: "svt-scene", version: 1, ...scene }));
    run("render", at("town"), "-o", at("p.png"), "--scene", at("s.scene.json"));
    const { coarsest } = look(at("town"), scene, n === 0);
    assert.ok(bytes("picture", scene).equals(readFileSync(at("p.png"))), `picture of '${name}'`);
    return coarsest;
  });
  assert.equal(details[1], 3, "a mixture of classes");
  for (const plane of ["x=30", "z=2.5", "0.6,0.8,0,-40"]) {
    const formats = ["svg", "dxf", "geojson", "csv"];
    for (const format of formats.slice(0, 3)) run("section", at("town"), "--plane", plane, "-o", at(`c.${format}`));
    run("section", at("town"), "--plane", plane, "--table", at("c.csv"));
    for (const format of formats)
      assert.equal(
        askCity(at("town"), "cityDrawing", () => [plane, format, 1e9]).text,
        readFileSync(at(`c.${format}`), "utf8"),
        `${plane} ${format}`,
      );
  }
  for (const [plane, most, said] of [
    ["z=2.5", 1000, /may cut \d+ tiles with .* MB, and the page reads at most/],
    ["z=18", 1e9, /does not meet the volume/],
  ])
    assert.throws(() => askCity(at("town"), "cityDrawing", () => [plane, "svg", most]), { code: "E503", message: said });
});

const real = join(process.env.SVT_DATA_DIR ?? "../shared/data", "fzk_haus_citygml3.gml");
test("a real house is the same", { skip: !existsSync(real) && `no ${real}` }, () => {
  run("build", real, "-o", at("real.svt"));
  open(at("real.svt"));
  comparePictures(at("real.svt"), ["plain", "cut"]);
});

test("the module that draws gives the same pictures of voxels, and names what it lacks", async () => {
  const { default: createView } = await import(pathToFileURL(join(moduleFolder, "svt_view.js")).href);
  const view = await createView({ wasmBinary: readFileSync(join(moduleFolder, "svt_view.wasm")) });
  open(houseVolume);
  view.call("open", ["house.svt"], readFileSync(houseVolume));
  const scene = { size: [320, 200], ...kScenes.cut, surfaces: "voxels" };
  assert.ok(Buffer.from(view.call("picture", [scene])).equals(bytes("picture", scene)));
  assert.ok(!bytes("picture", { ...scene, surfaces: "exact" }).equals(bytes("picture", scene)));
  assert.throws(() => view.call("picture", [{ ...scene, surfaces: "exact" }]), { code: "E904", message: /not available here/ });
  assert.throws(() => view.call("open", ["house.gml"], readFileSync(houseModel)), { code: "E904", message: /reads no models/ });
  for (const name of ["drawing", "sheets"]) assert.throws(() => view.call(name, []), { code: "E904" }, name);
  assert.ok(Buffer.from(view.call("picture", [scene])).equals(bytes("picture", scene)), "the volume stays open");
});
