// Reads a folder of 3D Tiles with implicit tiling by 3d-tiles-tools, which follows the subtrees and their metadata, and checks each content.
//   node tests/formats/city_tiles.mjs ORACLES TILES BUILDINGS
// ORACLES holds node_modules: npm install --prefix ORACLES 3d-tiles-tools gltf-validator. Exit code 77 where they are not there.
// BUILDINGS: how many features the finest content has together. Each content is valid glTF, stands in the box of its tile, and
// that in the box of its parent; errors grow to the root; every file is found once.
import assert from "node:assert/strict";
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [oracles, tiles, buildings] = process.argv.slice(2);
const modules = join(resolve(oracles), "node_modules");
const tools = join(modules, "3d-tiles-tools", "build", "src", "index.js"),
  validator = join(modules, "gltf-validator", "index.js");
for (const file of [tools, validator])
  if (!existsSync(file)) {
    console.log(`not there: ${file}`);
    process.exit(77);
  }
const { TilesetTraverser, ResourceResolvers } = createRequire(import.meta.url)(tools);
const { validateBytes } = (await import(pathToFileURL(validator).href)).default;

// The JSON and the binary chunk of a .glb.
function glbOf(bytes) {
  const size = bytes.readUInt32LE(12);
  return [JSON.parse(bytes.subarray(20, 20 + size).toString()), bytes.subarray(28 + size)];
}

// A column of strings of the table.
function strings(json, binary, name) {
  const table = json.extensions.EXT_structural_metadata.propertyTables[0];
  const { values, stringOffsets, stringOffsetType } = table.properties[name];
  const choices = json.extensions.EXT_structural_metadata.schema.enums?.[name];
  const view = (n) => binary.subarray(json.bufferViews[n].byteOffset, json.bufferViews[n].byteOffset + json.bufferViews[n].byteLength);
  if (choices) {
    const number = (n) => (choices.valueType === "UINT8" ? view(values).readUInt8(n) : view(values).readUInt16LE(2 * n));
    return Array.from({ length: table.count }, (_, n) => choices.values[number(n)].name);
  }
  const offset = (n) => (stringOffsetType === "UINT16" ? view(stringOffsets).readUInt16LE(2 * n) : view(stringOffsets).readUInt32LE(4 * n));
  return Array.from({ length: table.count }, (_, n) =>
    view(values)
      .subarray(offset(n), offset(n + 1))
      .toString(),
  );
}

// The box of a content in the frame of the tileset (z up).
function boxOf(json) {
  const { translation, scale = [1, 1, 1] } = json.nodes[0],
    places = json.meshes[0].primitives.map((primitive) => json.accessors[primitive.attributes.POSITION]);
  const at = (choose, end) =>
    [0, 1, 2].map((axis) => choose(...places.map((accessor) => accessor[end][axis])) * scale[axis] + translation[axis]);
  const [low, high] = [at(Math.min, "min"), at(Math.max, "max")];
  return [
    [low[0], -high[2], low[1]],
    [high[0], -low[2], high[1]],
  ];
}

const boxOfTile = ({ box }) => [0, 1].map((side) => [0, 1, 2].map((axis) => box[axis] + (2 * side - 1) * box[3 + 4 * axis]));
const isWithin = (inner, outer, reach) =>
  [0, 1, 2].every((axis) => inner[0][axis] >= outer[0][axis] - reach && inner[1][axis] <= outer[1][axis] + reach);

const tileset = JSON.parse(readFileSync(join(tiles, "tileset.json"), "utf8"));
const seen = new Set(),
  finest = new Map();
let triangles = 0,
  levels = 0;
const resolver = ResourceResolvers.createFileResourceResolver(resolve(tiles));
await new TilesetTraverser(resolve(tiles), resolver, { depthFirst: true }).traverse(tileset, async (traversed) => {
  const tile = traversed.asFinalTile(),
    parent = traversed.getParent()?.asFinalTile();
  const box = boxOfTile(tile.boundingVolume);
  if (parent) {
    assert.ok(parent.geometricError >= tile.geometricError, `${traversed.path}: the error of the parent is smaller`);
    assert.ok(isWithin(box, boxOfTile(parent.boundingVolume), 1e-6), `${traversed.path}: its box is not in that of its parent`);
  }
  if (traversed.isImplicitTilesetRoot()) return true; // its content is a template
  for (const { uri } of traversed.getFinalContents()) {
    assert.ok(!seen.has(uri), `${uri} is there twice`);
    seen.add(uri);
    levels = Math.max(levels, traversed.level);
    const bytes = readFileSync(join(tiles, uri));
    const report = await validateBytes(new Uint8Array(bytes));
    assert.deepEqual(
      report.issues.messages.filter((m) => !["UNSUPPORTED_EXTENSION", "UNUSED_OBJECT"].includes(m.code)),
      [],
      uri,
    );
    triangles += report.info.totalTriangleCount;
    const [json, binary] = glbOf(bytes);
    assert.ok(isWithin(boxOf(json), box, 0.05), `${uri}: ${boxOf(json)} is not in ${box}`);
    if (tile.geometricError !== 0) continue;
    const classes = strings(json, binary, "class"),
      attributes = strings(json, binary, "attributes");
    strings(json, binary, "id").forEach((id, n) => {
      assert.ok(!finest.has(id), `${id} is there twice`);
      finest.set(id, [classes[n], JSON.parse(attributes[n] || "{}")]);
    });
  }
  return true;
});
const files = readdirSync(join(tiles, "content"), { recursive: true }).filter((name) => String(name).endsWith(".glb"));
assert.equal(seen.size, files.length, "contents that no tile refers to");
assert.equal(finest.size, Number(buildings));
console.log(
  `${seen.size} contents on ${levels + 1} levels, ${triangles} triangles, ${finest.size} buildings, such as ${JSON.stringify([...finest][0])}`,
);
