// Compares a folder of 3D Tiles that has EXT_meshopt_compression with the same tiles without it, by the decoder of meshoptimizer.
//   node tests/formats/meshopt_tiles.mjs ORACLES PLAIN COMPRESSED
// ORACLES holds node_modules: npm install --prefix ORACLES meshoptimizer gltf-validator (3d-tiles-tools brings the first). Exit code 77
// where they are not there. Each view of a compressed tile decodes to the bytes of the plain tile, and each compressed tile is valid.
import assert from "node:assert/strict";
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [oracles, plain, compressed] = process.argv.slice(2);
const modules = join(resolve(oracles), "node_modules");
const decoder = join(modules, "meshoptimizer", "meshopt_decoder.js"),
  validator = join(modules, "gltf-validator", "index.js");
for (const file of [decoder, validator])
  if (!existsSync(file)) {
    console.log(`not there: ${file}`);
    process.exit(77);
  }
const { validateBytes } = (await import(pathToFileURL(validator).href)).default;
const MeshoptDecoder = createRequire(import.meta.url)(decoder);
await MeshoptDecoder.ready;

// The JSON of a .glb, and its views as they are when decoded.
function viewsOf(file) {
  const bytes = readFileSync(file),
    size = bytes.readUInt32LE(12);
  const json = JSON.parse(bytes.subarray(20, 20 + size).toString()),
    binary = bytes.subarray(28 + size);
  const part = ({ byteOffset, byteLength }) => binary.subarray(byteOffset, byteOffset + byteLength);
  const views = json.bufferViews.map((view) => {
    const packed = view.extensions?.EXT_meshopt_compression;
    if (!packed) return Buffer.from(part(view));
    const decoded = new Uint8Array(packed.count * packed.byteStride);
    MeshoptDecoder.decodeGltfBuffer(decoded, packed.count, packed.byteStride, part(packed), packed.mode, packed.filter);
    assert.equal(decoded.length, view.byteLength);
    return Buffer.from(decoded);
  });
  return [json, views];
}

const glbs = (folder) =>
  readdirSync(folder, { recursive: true })
    .map(String)
    .filter((name) => name.endsWith(".glb"))
    .sort();
assert.deepEqual(glbs(compressed), glbs(plain));
let packed = 0;
for (const name of glbs(plain)) {
  const [json, views] = viewsOf(join(compressed, name)),
    [plainJson, plainViews] = viewsOf(join(plain, name));
  assert.deepEqual(json.accessors, plainJson.accessors, name);
  assert.equal(views.length, plainViews.length, name);
  views.forEach((view, n) => assert.ok(view.equals(plainViews[n]), `${name}: view ${n} differs`));
  packed += json.bufferViews.filter((view) => view.extensions).length;
  assert.deepEqual(json.extensionsRequired, ["KHR_mesh_quantization", "EXT_meshopt_compression"]);
  const report = await validateBytes(new Uint8Array(readFileSync(join(compressed, name))));
  const unknown = ["UNSUPPORTED_EXTENSION", "UNUSED_OBJECT", "INCOMPLETE_EXTENSION_SUPPORT"];
  assert.deepEqual(
    report.issues.messages.filter((m) => !unknown.includes(m.code)),
    [],
    name,
  );
}
assert.ok(packed > 0, "nothing is compressed");
console.log(`${glbs(plain).length} tiles, ${packed} compressed views decode to the same bytes`);
