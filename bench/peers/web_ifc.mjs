// Seconds that web-ifc takes to read IFC files with the meshes of all products, as JSON: for scripts/bench_ifc.py.
//   node bench/peers/web_ifc.mjs NODE_MODULES FILE REPEAT
import { existsSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const [modules, path, repeat] = [resolve(process.argv[2]), process.argv[3], Number(process.argv[4])];
const main = join(modules, "web-ifc", "web-ifc-api-node.js");
if (!existsSync(main)) process.exit(77);
const WebIFC = createRequire(import.meta.url)(main);
const version = JSON.parse(readFileSync(join(modules, "web-ifc", "package.json"), "utf8")).version;

const api = new WebIFC.IfcAPI();
await api.Init();
api.SetLogLevel(WebIFC.LogLevel.LOG_LEVEL_OFF);
const bytes = new Uint8Array(readFileSync(path));
const times = [];
let triangles = 0;
for (let run = 0; run < repeat; ++run) {
  triangles = 0;
  const begin = performance.now();
  const model = api.OpenModel(bytes, { COORDINATE_TO_ORIGIN: false });
  const add = (mesh) => {
    for (let g = 0; g < mesh.geometries.size(); ++g) {
      const geometry = api.GetGeometry(model, mesh.geometries.get(g).geometryExpressID);
      triangles += api.GetIndexArray(geometry.GetIndexData(), geometry.GetIndexDataSize()).length / 3;
      geometry.delete();
    }
  };
  api.StreamAllMeshes(model, add);
  api.StreamAllMeshesWithTypes(model, [WebIFC.IFCSPACE], add);
  times.push((performance.now() - begin) / 1000);
  api.CloseModel(model);
}
console.log(JSON.stringify({ version, times, triangles, peakBytes: process.resourceUsage().maxRSS * 1024 }));
