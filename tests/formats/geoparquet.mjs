// Reads a GeoParquet by hyparquet and compares it with the GeoJSON of the same features.
//   node tests/formats/geoparquet.mjs ORACLES FILE.parquet FILE.geojson EPSG
// ORACLES holds node_modules: npm install --prefix ORACLES hyparquet. Exit code 77 where it is not there.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [oracles, file, reference, epsg] = process.argv.slice(2);
const reader = join(resolve(oracles), "node_modules", "hyparquet", "src", "index.js");
if (!existsSync(reader)) {
  console.log(`not there: ${reader}`);
  process.exit(77);
}
const { parquetMetadata, parquetReadObjects } = await import(pathToFileURL(reader).href);
const bytes = readFileSync(file),
  buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
const metadata = parquetMetadata(buffer);
const geo = JSON.parse(metadata.key_value_metadata.find((entry) => entry.key === "geo").value);
assert.equal(geo.version, "1.1.0");
assert.equal(geo.primary_column, "geometry");
const { encoding, geometry_types: types, crs, bbox } = geo.columns.geometry;
assert.deepEqual([encoding, types], ["WKB", ["MultiPolygon"]]);
assert.deepEqual(crs?.id, { authority: "EPSG", code: Number(epsg) });

const rows = await parquetReadObjects({ file: buffer });
const { features } = JSON.parse(readFileSync(reference, "utf8"));
assert.equal(rows.length, features.length);
const around = [Infinity, Infinity, -Infinity, -Infinity];
rows.forEach((row, n) => {
  const { geometry, properties } = features[n];
  // GeoParquet has one type for all rows.
  const parts = geometry?.type === "Polygon" ? [geometry.coordinates] : (geometry?.coordinates ?? []);
  const expected = geometry ? { type: "MultiPolygon", coordinates: parts } : null;
  assert.deepEqual(row.geometry ?? null, expected, `geometry of row ${n}`);
  for (const [x, y] of parts.flatMap(([outer]) => outer)) {
    around.splice(0, 4, Math.min(around[0], x), Math.min(around[1], y), Math.max(around[2], x), Math.max(around[3], y));
  }
  for (const [name, value] of Object.entries(row)) {
    if (name === "geometry") continue;
    const told = properties[name] ?? null;
    assert.equal(typeof value === "bigint" ? Number(value) : value, told, `${name} of row ${n}`);
  }
});
assert.deepEqual(bbox, around);
console.log(`hyparquet: the same ${rows.length} features in ${metadata.row_groups.length} groups, ${crs.name}`);
