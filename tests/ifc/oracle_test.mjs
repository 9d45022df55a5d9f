// Volumes of IFC products against web-ifc, and generated booleans against manifold. Run by ctest, or by
//   node tests/ifc/oracle_test.mjs COMMAND DATA_FOLDER ORACLE_FOLDER [--table]
// ORACLE_FOLDER holds node_modules with web-ifc and manifold-3d: npm install --prefix ORACLE_FOLDER web-ifc manifold-3d.
// Skipped with a word where it does not. --table prints the table of docs/dev/ifc.md.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [command, dataFolder, oracleFolder] = process.argv.slice(2, 5).map((path) => resolve(path));
const printsTable = process.argv.includes("--table");
const skip = (why) => {
  console.log(`skipped: ${why}`);
  process.exit(77);
};
const fileOf = (...parts) => {
  const path = join(oracleFolder, "node_modules", ...parts);
  return existsSync(path) ? path : skip(`no ${parts[0]} in ${oracleFolder}; npm install --prefix ${oracleFolder} web-ifc manifold-3d`);
};
const manifoldPath = fileOf("manifold-3d", "manifold.js");
const WebIFC = createRequire(import.meta.url)(fileOf("web-ifc", "web-ifc-api-node.js"));

const folder = mkdtempSync(join(tmpdir(), "svt-oracle-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
const run = (...args) => execFileSync(command, args, { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"], maxBuffer: 1 << 29 });

/** Signed volume of triangles and whether each edge is used as often both ways, points within 10 micrometres being one. */
function measure(triangles) {
  const ids = new Map();
  const edges = new Map();
  let volume = 0;
  const idOf = (p) => {
    const key = p.map((value) => Math.round(value * 1e5)).join(",");
    if (!ids.has(key)) ids.set(key, ids.size);
    return ids.get(key);
  };
  const origin = triangles[0][0];
  for (const triangle of triangles) {
    const [a, b, c] = triangle.map((p) => p.map((value, i) => value - origin[i]));
    volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
    const corners = triangle.map(idOf);
    for (let i = 0; i < 3; ++i) {
      const [p, q] = [corners[i], corners[(i + 1) % 3]];
      if (p === q) continue;
      const key = p < q ? `${p} ${q}` : `${q} ${p}`;
      edges.set(key, (edges.get(key) ?? 0) + (p < q ? 1 : -1));
    }
  }
  return { volume: Math.abs(volume), isClosed: [...edges.values()].every((count) => count === 0) };
}

/** GlobalId -> volume and closedness of all products with a shape, as web-ifc makes them; and the seconds it took. */
async function byWebIfc(path) {
  const api = new WebIFC.IfcAPI();
  await api.Init();
  api.SetLogLevel(WebIFC.LogLevel.LOG_LEVEL_OFF);
  const bytes = new Uint8Array(readFileSync(path));
  const begin = performance.now();
  const model = api.OpenModel(bytes, { COORDINATE_TO_ORIGIN: false });
  const products = new Map();
  const add = (mesh) => {
    const triangles = [];
    for (let g = 0; g < mesh.geometries.size(); ++g) {
      const placed = mesh.geometries.get(g);
      const geometry = api.GetGeometry(model, placed.geometryExpressID);
      const vertices = api.GetVertexArray(geometry.GetVertexData(), geometry.GetVertexDataSize());
      const indices = api.GetIndexArray(geometry.GetIndexData(), geometry.GetIndexDataSize());
      const m = placed.flatTransformation;
      const points = [];
      for (let v = 0; v < vertices.length; v += 6) {
        const [x, y, z] = vertices.slice(v, v + 3);
        points.push([0, 1, 2].map((i) => m[i] * x + m[4 + i] * y + m[8 + i] * z + m[12 + i]));
      }
      for (let t = 0; t < indices.length; t += 3) triangles.push([points[indices[t]], points[indices[t + 1]], points[indices[t + 2]]]);
      geometry.delete();
    }
    products.set(mesh.expressID, triangles);
  };
  api.StreamAllMeshes(model, add);
  api.StreamAllMeshesWithTypes(model, [WebIFC.IFCSPACE], add);
  const seconds = (performance.now() - begin) / 1000;
  const result = new Map();
  for (const [id, triangles] of products) if (triangles.length > 0) result.set(api.GetLine(model, id).GlobalId.value, measure(triangles));
  api.CloseModel(model);
  return { products: result, seconds };
}

function bySvt(path) {
  const volume = join(folder, "model.svt");
  let seconds = Infinity;
  for (let i = 0; i < 3; ++i) {
    const report = JSON.parse(run("build", path, "-o", volume, "--spacing", "0.5", "--json"));
    seconds = Math.min(seconds, report.seconds.read);
  }
  return { objects: withPhases(JSON.parse(run("info", volume, "--json")).objects), seconds };
}

/** Products as a whole: the volume of a window with that of its panes. */
function withPhases(objects) {
  const byId = new Map(objects.map((object) => [object.id, object]));
  const isPhase = (object) => object.class.endsWith("Phase");
  for (const phase of objects.filter(isPhase)) {
    const whole = byId.get(phase.parent);
    whole.volume += phase.volume;
    whole.closed &&= phase.closed;
  }
  return objects.filter((object) => !isPhase(object));
}

const kSame = 0.001;
const relative = (a, b) => Math.abs(a - b) / Math.max(Math.abs(a), Math.abs(b), 1e-9);

async function compare(name, path) {
  const [theirs, ours] = [await byWebIfc(path), bySvt(path)];
  const rows = { name, compared: 0, same: 0, onlyOurs: 0, openTheirs: 0, others: [], ours: ours.seconds, theirs: theirs.seconds };
  for (const object of ours.objects) {
    const type = object.attributes?.ifcType;
    if (!type || object.count === 0) continue;
    const other = theirs.products.get(object.id);
    if (!other) {
      ++rows.onlyOurs;
      continue;
    }
    theirs.products.delete(object.id);
    if (!object.closed) continue;
    if (!other.isClosed) ++rows.openTheirs;
    ++rows.compared;
    if (relative(object.volume, other.volume) <= kSame) ++rows.same;
    else
      rows.others.push({
        id: object.id,
        type,
        name: object.name,
        ours: object.volume,
        theirs: other.volume,
        isClosed: other.isClosed,
        stated: object.attributes["BaseQuantities.NetVolume"] ?? object.attributes["Dimensions.Volume"],
      });
  }
  rows.onlyTheirs = [...theirs.products.keys()];
  return rows;
}

// Of the products that are closed here, in percent. What differs is open in web-ifc; see docs/dev/ifc.md.
const kFiles = { "fzk_haus.ifc": 98, "openhouse.ifc": 100, "samplehouse.ifc": 98, "largebuilding.ifc": 98 };
const house = join(folder, "house.ifc");
run("sample", "house", "-o", house);
const all = [await compare("house.ifc (generated)", house)];
for (const name of Object.keys(kFiles)) if (existsSync(join(dataFolder, name))) all.push(await compare(name, join(dataFolder, name)));
for (const rows of all) {
  const share = (100 * rows.same) / rows.compared;
  if (printsTable) {
    console.log(
      `| ${rows.name} | ${rows.compared} | ${rows.same} | ${rows.openTheirs} | ${rows.onlyOurs} | ${rows.onlyTheirs.length} | ` +
        `${rows.ours.toFixed(3)} s | ${rows.theirs.toFixed(3)} s |`,
    );
    for (const o of rows.others)
      console.log(
        `    ${o.id} ${o.type} ${o.name}: ${o.ours.toFixed(6)}, web-ifc ${o.theirs.toFixed(6)}${o.isClosed ? "" : " (open)"}, file ${o.stated}`,
      );
    for (const id of rows.onlyTheirs) console.log(`    only web-ifc: ${id}`);
  }
  // Where both are closed they agree; where they do not, the volume that the file states is ours.
  for (const o of rows.others) {
    assert.ok(!o.isClosed, `${rows.name}: ${o.id} has ${o.ours} m3, web-ifc ${o.theirs}`);
    assert.ok(relative(o.ours, o.stated) <= kSame, `${rows.name}: ${o.id} has ${o.ours} m3, the file says ${o.stated}`);
  }
  assert.equal(rows.onlyTheirs.length, 0, `${rows.name}: only web-ifc has ${rows.onlyTheirs}`);
  if (rows.name in kFiles) assert.ok(share >= kFiles[rows.name], `${rows.name}: only ${share} % as web-ifc`);
}

// Booleans of up to five blocks: every third with faces on common planes.
async function againstManifold() {
  const Module = (await import(pathToFileURL(manifoldPath).href)).default;
  const module = await Module();
  module.setup();
  const { Manifold } = module;
  let state = 12345n;
  const random = () => {
    state = (state * 6364136223846793005n + 1442695040888963407n) & 0xffffffffffffffffn;
    return Number(state >> 33n) / 2 ** 31;
  };
  const records = [
    "#1=IFCPROJECT('0project',$,'P',$,$,$,$,(#20),#2)",
    "#2=IFCUNITASSIGNMENT((#3))",
    "#3=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)",
    "#20=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05,$,$)",
  ];
  let last = 100;
  const add = (text) => (records.push(`#${++last}=${text}`), last);
  const number = (value) => (Number.isInteger(value) ? `${value}.` : value.toFixed(12));
  const vector = (v) => `(${v.map(number).join(",")})`;
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const unit = (v) => v.map((value) => value / Math.hypot(...v));
  const body = (isAligned) => {
    const at = [0, 1, 2].map(() => (isAligned ? Math.floor(random() * 5) / 2 : random() * 2));
    const size = [0, 1, 2].map(() => (isAligned ? (1 + Math.floor(random() * 4)) / 2 : 0.3 + random() * 2));
    const z = isAligned ? [0, 0, 1] : unit([random() - 0.5, random() - 0.5, random() + 0.1]);
    const x = isAligned ? [1, 0, 0] : unit(cross([random(), 1, 0.3], z));
    const y = cross(z, x);
    const axes = add(
      `IFCAXIS2PLACEMENT3D(#${add(`IFCCARTESIANPOINT(${vector(at)})`)},#${add(`IFCDIRECTION(${vector(z)})`)},#${add(`IFCDIRECTION(${vector(x)})`)})`,
    );
    const solid = Manifold.cube(size).transform([...x, 0, ...y, 0, ...z, 0, ...at, 1]);
    return { item: add(`IFCBLOCK(#${axes},${size.map(number).join(",")})`), solid };
  };
  const wanted = [];
  for (let i = 0; i < 150; ++i) {
    let { item, solid } = body(i % 3 === 0);
    for (let k = 0; k < 1 + (i % 4); ++k) {
      const other = body(i % 3 === 0);
      const op = ["UNION", "DIFFERENCE", "INTERSECTION"][Math.floor(random() * (k === 0 ? 3 : 2))];
      item = add(`IFCBOOLEANRESULT(.${op}.,#${item},#${other.item})`);
      solid = op === "UNION" ? solid.add(other.solid) : op === "DIFFERENCE" ? solid.subtract(other.solid) : solid.intersect(other.solid);
    }
    const shape = add(`IFCPRODUCTDEFINITIONSHAPE($,$,(#${add(`IFCSHAPEREPRESENTATION(#20,'Body','CSG',(#${item}))`)}))`);
    add(`IFCBUILDINGELEMENTPROXY('p${i}',$,'${i}',$,$,$,#${shape},$,$)`);
    wanted.push(solid.volume());
  }
  const path = join(folder, "booleans.ifc");
  writeFileSync(
    path,
    `ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;\n${records.join(";\n")};\nENDSEC;\nEND-ISO-10303-21;\n`,
  );
  const found = new Map(bySvt(path).objects.map((object) => [object.id, object]));
  let worst = 0;
  wanted.forEach((volume, i) => {
    const object = found.get(`p${i}`);
    if (volume < 1e-9) return assert.ok(!object || object.count === 0 || object.volume < 1e-9, `p${i} should be empty`);
    assert.ok(object?.closed, `p${i}, ${volume} m3, is ${object ? "open" : "missing"}`);
    worst = Math.max(worst, Math.abs(object.volume - volume));
    assert.ok(Math.abs(object.volume - volume) < 2e-5, `p${i}: ${object.volume}, manifold ${volume}`);
  });
  console.log(`${wanted.length} booleans as manifold makes them, volumes within ${worst.toExponential(1)} m3`);
}
await againstManifold();
