// m3 added and removed of exact rows of `svt diff` against the booleans of manifold. Run by ctest, or by
//   node tests/compare/oracle_test.mjs COMMAND DATA_FOLDER ORACLE_FOLDER [--table]
// ORACLE_FOLDER holds node_modules with manifold-3d: npm install --prefix ORACLE_FOLDER manifold-3d. Skipped with a word where
// it does not. --table prints the largest errors.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [command, dataFolder, oracleFolder] = process.argv.slice(2, 5).map((path) => resolve(path));
const printsTable = process.argv.includes("--table");
const manifoldPath = join(oracleFolder, "node_modules", "manifold-3d", "manifold.js");
if (!existsSync(manifoldPath)) {
  console.log(`skipped: no manifold-3d in ${oracleFolder}; npm install --prefix ${oracleFolder} manifold-3d`);
  process.exit(77);
}
const module = await (await import(pathToFileURL(manifoldPath).href)).default();
module.setup();
const { Manifold, Mesh, triangulate } = module;

const folder = mkdtempSync(join(tmpdir(), "svt-oracle-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
function run(...args) {
  const done = spawnSync(command, args, { encoding: "utf8", maxBuffer: 1 << 29 });
  assert.ok([0, 7].includes(done.status), `svt ${args.join(" ")}: ${done.status}\n${done.stderr}`);
  return done.stdout;
}
const read = (path) => JSON.parse(readFileSync(path, "utf8"));

const kLargestShare = 0.001; // of the changed volume
let state = 20261129n;
const random = () => {
  state = (state * 6364136223846793005n + 1442695040888963407n) & 0xffffffffffffffffn;
  return Number(state >> 33n) / 2 ** 31;
};

/** The points of a CityJSON, metres from the origin of its transform. */
const pointsOf = (model) => model.vertices.map((p) => p.map((value, axis) => value * model.transform.scale[axis]));

/** The triangles of a polygon with holes: indices of points. */
function trianglesOf(rings, points) {
  const normal = [0, 0, 0];
  for (let n = 0; n < rings[0].length; ++n) {
    const [a, b] = [points[rings[0][n]], points[rings[0][(n + 1) % rings[0].length]]];
    for (let i = 0; i < 3; ++i) normal[i] += (a[(i + 1) % 3] - b[(i + 1) % 3]) * (a[(i + 2) % 3] + b[(i + 2) % 3]);
  }
  const away = normal.map(Math.abs).indexOf(Math.max(...normal.map(Math.abs)));
  const [u, v] = normal[away] > 0 ? [(away + 1) % 3, (away + 2) % 3] : [(away + 2) % 3, (away + 1) % 3];
  const origin = points[rings[0][0]];
  const all = rings.flat();
  return triangulate(rings.map((ring) => ring.map((p) => [points[p][u] - origin[u], points[p][v] - origin[v]]))).map((t) =>
    [...t].map((n) => all[n]),
  );
}

/** The solid of an object, about `origin`; undefined if manifold takes no such mesh. */
function solidOf(model, points, id, origin) {
  const geometries = model.CityObjects[id]?.geometry ?? [];
  if (geometries.length !== 1 || geometries[0].type !== "Solid") return undefined;
  const numbers = new Map();
  const positions = [];
  const numberOf = (p) => {
    const at = points[p].map((value, axis) => value - origin[axis]);
    const key = at.map((value) => Math.round(value * 1e6)).join(",");
    if (!numbers.has(key)) {
      numbers.set(key, numbers.size);
      positions.push(...at);
    }
    return numbers.get(key);
  };
  const corners = [];
  for (const shell of geometries[0].boundaries)
    for (const rings of shell) for (const triangle of trianglesOf(rings, points)) corners.push(...triangle.map(numberOf));
  try {
    const solid = new Manifold(new Mesh({ numProp: 3, vertProperties: new Float32Array(positions), triVerts: new Uint32Array(corners) }));
    return solid.volume() > 0 ? solid : undefined;
  } catch {
    return undefined;
  }
}

const worst = { pairs: 0, left: 0, share: 0, id: "" };

/** Compares the exact rows of two CityJSON files. */
function compareFiles(oldPath, newPath, name) {
  const rows = JSON.parse(
    run("diff", oldPath, newPath, "--json", "-q", "--spacing", "0.3", "--tolerance", "0.002", "--properties", "none"),
  ).rows;
  const [old, now] = [read(oldPath), read(newPath)];
  const [oldPoints, newPoints] = [pointsOf(old), pointsOf(now)];
  const shift = now.transform.translate.map((value, axis) => value - old.transform.translate[axis]);
  const moved = newPoints.map((p) => p.map((value, axis) => value + shift[axis]));
  for (const row of rows) {
    if (!row.exact || !["changed", "moved"].includes(row.change)) continue;
    const first = old.CityObjects[row.old[0]]?.geometry?.[0]?.boundaries?.flat(Infinity)[0];
    if (first === undefined) continue;
    const origin = oldPoints[first];
    const a = solidOf(old, oldPoints, row.old[0], origin);
    const b = solidOf(now, moved, row.new[0], origin);
    if (a === undefined || b === undefined) {
      ++worst.left;
      continue;
    }
    const [added, removed] = [b.subtract(a).volume(), a.subtract(b).volume()];
    const share = Math.max(Math.abs(added - row.added), Math.abs(removed - row.removed)) / (added + removed);
    ++worst.pairs;
    if (share > worst.share) [worst.share, worst.id] = [share, `${name} ${row.old[0]}`];
    assert.ok(share <= kLargestShare, `${name}: ${row.old[0]} +${row.added} -${row.removed}, manifold +${added} -${removed}`);
    a.delete();
    b.delete();
  }
}

/** A copy of a model in which solids are turned about any axis, scaled, or moved. */
function editedCopy(model, count) {
  const copy = structuredClone(model);
  const ids = Object.keys(copy.CityObjects).filter((id) => copy.CityObjects[id].geometry?.[0]?.type === "Solid");
  const scale = model.transform.scale;
  for (let n = 0; n < count; ++n) {
    const [id] = ids.splice(Math.floor(random() * ids.length), 1);
    const used = [...new Set(copy.CityObjects[id].geometry[0].boundaries.flat(Infinity))];
    const middle = [0, 1, 2].map((axis) => {
      const values = used.map((p) => model.vertices[p][axis] * scale[axis]);
      return 0.5 * (Math.min(...values) + Math.max(...values));
    });
    const angle = random() < 0.7 ? 0.02 + random() * 0.6 : 0;
    const axis = [random() - 0.5, random() - 0.5, random() - 0.5];
    const length = Math.hypot(...axis);
    const [x, y, z] = axis.map((value) => value / length);
    const size = random() < 0.5 ? 0.9 + random() * 0.2 : 1;
    const by = [0, 1, 2].map(() => (random() - 0.5) * 0.3);
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const turned = (p) => {
      const along = (p[0] * x + p[1] * y + p[2] * z) * (1 - c);
      return [
        p[0] * c + (y * p[2] - z * p[1]) * s + x * along,
        p[1] * c + (z * p[0] - x * p[2]) * s + y * along,
        p[2] * c + (x * p[1] - y * p[0]) * s + z * along,
      ];
    };
    const numbers = new Map();
    for (const p of used) {
      const local = turned(model.vertices[p].map((value, i) => (value * scale[i] - middle[i]) * size));
      numbers.set(p, copy.vertices.length);
      copy.vertices.push(local.map((value, i) => Math.round((value + middle[i] + by[i]) / scale[i])));
    }
    const renumbered = (value) => (Array.isArray(value) ? value.map(renumbered) : numbers.get(value));
    copy.CityObjects[id].geometry[0].boundaries = renumbered(copy.CityObjects[id].geometry[0].boundaries);
  }
  return copy;
}

// Generated edits of boxes.
const oldHouse = join(folder, "old.json"),
  newHouse = join(folder, "new.json");
run("sample", "house", "-q", "--format", "cityjson", "-o", oldHouse);
for (let seed = 0; seed < 24; ++seed) {
  run(
    "sample",
    "house",
    "-q",
    "--format",
    "cityjson",
    "-o",
    newHouse,
    "--change",
    String(seed),
    "--change-list",
    join(folder, "answer.json"),
  );
  compareFiles(oldHouse, newHouse, `seed ${seed}`);
}
assert.ok(worst.pairs >= 24, `only ${worst.pairs} pairs of generated houses were compared`);
const generated = worst.pairs;

// Objects of the FZK-Haus at any angle.
const house = join(dataFolder, "fzk_haus.city.json");
if (existsSync(house)) {
  const model = read(house);
  const edited = join(folder, "edited.json");
  for (let n = 0; n < 4; ++n) {
    writeFileSync(edited, JSON.stringify(editedCopy(model, 12)));
    compareFiles(house, edited, `FZK-Haus ${n}`);
  }
  assert.ok(worst.pairs - generated >= 30, `only ${worst.pairs - generated} objects of the FZK-Haus were compared`);
}
console.log(
  `${worst.pairs} changed solids as manifold has them (${worst.left} meshes left out), m3 within ${(100 * worst.share).toFixed(5)} %` +
    (printsTable ? `, the largest error: ${worst.id}` : ""),
);
