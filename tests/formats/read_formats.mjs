// What programs of npm that know nothing of SVT read of files that `svt convert` wrote. Run by tests/cli, or by
//   node tests/formats/read_formats.mjs ORACLES READER FILE [REFERENCE]
// ORACLES holds node_modules: npm install --prefix ORACLES gltf-validator@2.0.0-dev.3.10 three@0.187.0 hyparquet@1.31.5 parquet-wasm@0.8.0 \
//   apache-arrow tinyusdz@0.9.0-rc10
// Exit code 77 where it does not.
import assert from "node:assert/strict";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [oracles, reader, file, reference] = process.argv.slice(2);
const load = (...parts) => {
  const path = resolve(oracles, "node_modules", ...parts);
  if (!existsSync(path)) {
    console.log(`no ${parts[0]} in ${oracles}; npm install --prefix ${oracles} ${parts[0]}`);
    process.exit(77);
  }
  return import(pathToFileURL(path).href);
};

// Lines of CSV as objects; quotes as RFC 4180 has them.
const csv = (path) => {
  const rows = [[""]];
  let isQuoted = false;
  const text = readFileSync(path, "utf8");
  for (let n = 0; n < text.length; ++n) {
    const c = text[n];
    const row = rows.at(-1);
    if (isQuoted && c === '"' && text[n + 1] === '"') row[row.length - 1] += text[++n];
    else if (c === '"') isQuoted = !isQuoted;
    else if (!isQuoted && c === ",") row.push("");
    else if (!isQuoted && c === "\r") continue;
    else if (!isQuoted && c === "\n") rows.push([""]);
    else row[row.length - 1] += c;
  }
  rows.pop();
  const [names, ...cells] = rows;
  return { names, rows: cells };
};

// A cell of a table against the text of CSV.
const same = (value, text, what) => {
  if (text === "") assert.ok(value === null || value === undefined || value === "", `${what}: ${value}`);
  else if (typeof value === "number") assert.ok(Math.abs(value - Number(text)) <= 1e-6 * Math.abs(value), `${what}: ${value} ${text}`);
  else assert.equal(String(value), text, what);
};

const readers = {
  // The Khronos validator on every tile; it does not know the two extensions and so takes their buffers for unused.
  async tileset() {
    const { validateBytes } = await load("gltf-validator", "index.js");
    for (const name of readdirSync(file).filter((name) => name.endsWith(".glb"))) {
      const report = await validateBytes(new Uint8Array(readFileSync(join(file, name))));
      const found = report.issues.messages.filter((m) => !["UNSUPPORTED_EXTENSION", "UNUSED_OBJECT"].includes(m.code));
      assert.deepEqual(found, [], name);
      console.log(name, report.info.totalTriangleCount, "triangles");
    }
  },

  async parquet() {
    const { parquetMetadata, parquetReadObjects } = await load("hyparquet", "src", "index.js");
    const buffer = arrayOf(file);
    const expected = csv(reference);
    const notes = parquetMetadata(buffer).key_value_metadata?.map((entry) => entry.key);
    // Tables of quantities have none.
    const isOfQuantities = expected.names.some((name) => ["netVolume", "areaOfB"].includes(name));
    assert.deepEqual(notes, isOfQuantities ? undefined : ["crs", "source", "unit"]);
    const rows = await parquetReadObjects({ file: buffer });
    assert.equal(rows.length, expected.rows.length);
    rows.forEach((row, r) => {
      assert.deepEqual(Object.keys(row), expected.names);
      expected.names.forEach((name, c) => same(row[name], expected.rows[r][c], `row ${r}, ${name}`));
    });
    console.log("hyparquet: same", rows.length, "rows of", expected.names.length);
  },

  // The same by Arrow's own implementation in Rust.
  async arrow() {
    const { readParquet } = await load("parquet-wasm", "node", "parquet_wasm.js");
    const { tableFromIPC } = await load("apache-arrow", "Arrow.node.mjs");
    const table = tableFromIPC(readParquet(new Uint8Array(readFileSync(file))).intoIPCStream());
    const expected = csv(reference);
    assert.equal(table.numRows, expected.rows.length);
    assert.deepEqual(
      table.schema.fields.map((field) => field.name),
      expected.names,
    );
    expected.rows.forEach((row, r) => expected.names.forEach((name, c) => same(table.getChildAt(c).get(r), row[c], `row ${r}, ${name}`)));
    console.log("parquet-wasm: same", table.numRows, "rows;", table.schema.fields.map((field) => field.type).join(" "));
  },

  // Voxels by the graph of the scene; three.js has y up.
  async vox() {
    const { VOXLoader } = await load("three", "examples", "jsm", "loaders", "VOXLoader.js");
    const { chunks, scene } = new VOXLoader().parse(arrayOf(file));
    const { box, count } = usedBox(reference, (place) => place);
    assert.equal(
      chunks.reduce((sum, chunk) => sum + chunk.data.length / 4, 0),
      count,
    );
    // It has the middle of a model where MagicaVoxel has the middle rounded down: half a voxel for odd sizes.
    await expectBox(scene, box, 0.51);
    console.log("three:", count, "voxels;", scene.children.map((child) => child.name).join(", "));
  },

  // Points of every mesh in world space, and the names of the tree.
  async usda() {
    const { USDLoader } = await load("three", "examples", "jsm", "loaders", "USDLoader.js");
    const root = new USDLoader().parse(readFileSync(file, "utf8"));
    const { box } = usedBox(reference, (place, matrix) =>
      matrix.map((row) => row[0] * place[0] + row[1] * place[1] + row[2] * place[2] + row[3]),
    );
    await expectBox(root, box, 1e-3);
    let triangles = 0;
    root.traverse((node) => {
      triangles += node.isMesh ? (node.geometry.index ?? node.geometry.attributes.position).count / 3 : 0;
    });
    assert.ok(triangles > 0);
    console.log("three:", triangles, "triangles;", root.children[0].children.map((child) => child.name).join(", "));
  },
};

function arrayOf(path) {
  const bytes = readFileSync(path);
  return bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
}

// The outer box of all voxels but background of a raw NRRD, and their number. place: from corners of voxels, counted from the
// centre of the first one, to where they are.
function usedBox(path, place) {
  const bytes = readFileSync(path);
  const end = bytes.indexOf("\n\n");
  const fields = Object.fromEntries(
    bytes
      .subarray(0, end)
      .toString()
      .split("\n")
      .filter((line) => line.includes(": "))
      .map((line) => line.split(": ")),
  );
  const sizes = fields.sizes.split(" ").map(Number);
  const vectors = [...`${fields["space directions"]} ${fields["space origin"]}`.matchAll(/\(([^)]*)\)/g)].map((match) =>
    match[1].split(",").map(Number),
  );
  const matrix = [0, 1, 2].map((row) => vectors.map((vector) => vector[row]));
  const isWide = fields.type.includes("16");
  const min = [Infinity, Infinity, Infinity],
    max = [-Infinity, -Infinity, -Infinity];
  let count = 0;
  for (let k = 0, at = end + 2; k < sizes[2]; ++k)
    for (let j = 0; j < sizes[1]; ++j)
      for (let i = 0; i < sizes[0]; ++i, at += isWide ? 2 : 1) {
        if (bytes[at] === 0 && (!isWide || bytes[at + 1] === 0)) continue;
        ++count;
        [i, j, k].forEach((n, axis) => {
          min[axis] = Math.min(min[axis], n - 0.5);
          max[axis] = Math.max(max[axis], n + 0.5);
        });
      }
  return { box: [place(min, matrix), place(max, matrix)], count };
}

// That a scene with y up fills a box with z up; of voxels up to the half voxel that a centre is from its corner.
async function expectBox(scene, expected, tolerance) {
  const [min, max] = expected;
  const { Box3 } = await load("three", "build", "three.module.js");
  scene.updateMatrixWorld(true);
  const box = new Box3().setFromObject(scene);
  const found = [
    [box.min.x, -box.max.z, box.min.y],
    [box.max.x, -box.min.z, box.max.y],
  ];
  const shift = tolerance > 0.1 ? 0.5 : 0;
  [min, max].forEach((corner, n) =>
    corner.forEach((value, axis) =>
      assert.ok(Math.abs(found[n][axis] - value - shift) <= tolerance, `corner ${n}, axis ${axis}: ${found[n][axis]}, ${value} expected`),
    ),
  );
}

await readers[reader]();
