// Writes labels as Zarr version 3 by zarrita, packed in each way that it knows, with the samples beside them as they are.
//   node tests/formats/write_zarr.mjs ORACLES FOLDER
// ORACLES holds node_modules: npm install --prefix ORACLES zarrita@0.7.5 @zarrita/storage. Exit code 77 where it does not.
import { existsSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [oracles, folder] = process.argv.slice(2);
const load = async (...parts) => {
  const path = resolve(oracles, "node_modules", ...parts);
  if (!existsSync(path)) {
    console.log(`no ${parts.slice(0, 2).join("/")} in ${oracles}`);
    process.exit(77);
  }
  return import(pathToFileURL(path).href);
};
const zarr = await load("zarrita", "dist", "src", "index.js");
const { default: FileSystemStore } = await load("@zarrita", "storage", "dist", "src", "fs.js");

const shape = [23, 41, 70];
const values = new Uint16Array(shape[0] * shape[1] * shape[2]);
for (let z = 0, at = 0; z < shape[0]; ++z)
  for (let y = 0; y < shape[1]; ++y)
    for (let x = 0; x < shape[2]; ++x, ++at)
      values[at] = x + y > 20 ? Math.floor(x / 9) + 7 * Math.floor(y / 11) + 40 * Math.floor(z / 6) + 1 : 0;
writeFileSync(join(folder, "expected.raw"), Buffer.from(values.buffer));

const bytes = { name: "bytes", configuration: { endian: "little" } };
const big = { name: "bytes", configuration: { endian: "big" } };
const layouts = {
  plain: [bytes],
  big: [big],
  gzip: [bytes, { name: "gzip", configuration: { level: 5 } }],
  zstd: [bytes, { name: "zstd", configuration: { level: 3, checksum: false } }],
  blosc: [bytes, { name: "blosc", configuration: { cname: "lz4", clevel: 5, shuffle: "shuffle", typesize: 2, blocksize: 0 } }],
  transpose: [{ name: "transpose", configuration: { order: [2, 0, 1] } }, bytes],
  crc32c: [bytes, { name: "crc32c", configuration: {} }],
};
const written = [];
for (const [name, codecs] of Object.entries(layouts)) {
  try {
    const store = new FileSystemStore(join(folder, `${name}.zarr`));
    const array = await zarr.create(zarr.root(store), { shape, chunkShape: [8, 16, 33], dtype: "uint16", codecs, fillValue: 0 });
    await zarr.set(array, null, { data: values, shape, stride: [shape[1] * shape[2], shape[2], 1] });
    written.push(name);
  } catch (error) {
    console.log(`zarrita does not write ${name}: ${/** @type {Error} */ (error).message}`);
  }
}
writeFileSync(join(folder, "written.txt"), written.join("\n") + "\n");
