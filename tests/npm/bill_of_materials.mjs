// Compares a software bill of materials with what is built in: the table of libraries of the WebAssembly module, the libraries
// that CMake compiles for it, and the packages of the page.
//   node tests/npm/bill_of_materials.mjs command|page|element SBOM   exits with 1 and a line for each fault
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

/** The source packages of headers that are taken as they are installed, by the name of their folder. */
const kHeaders = { fmt: "fmtlib", nlohmann: "nlohmann-json3", fast_float: "fast-float", CLI: "cli11" };

/** What a module holds besides libraries: the libraries of the compiler, and the font. */
const kOthers = ["emscripten", "fonts-dejavu"];

/**
 * The source packages of all libraries in a module.
 * @param cmake  cmake/WebDependencies.cmake; @param script  scripts/web_dependencies.sh
 */
export function linkedLibraries(cmake, script) {
  const packages = new Map([...script.matchAll(/^ {2}"(\S+) (\S+) \S+ \S+"$/gm)].map(([, source, folder]) => [folder, source]));
  const folders = [...cmake.matchAll(/^web_library\(\s*\S+\s+([^\s/]+)/gm)].map((call) => call[1]);
  const headers = /^headers=\(([^)]*)\)/m.exec(script)[1].split(/\s+/);
  return [...folders.map((folder) => packages.get(folder) ?? folder), ...headers.map((header) => kHeaders[header] ?? header)];
}

/**
 * A line for each fault.
 * @param sbom  CycloneDX, parsed; @param table  build/web-sources/components.tsv
 * @param linked  names of linkedLibraries(); @param packages  what the page takes from npm, and package-lock.json, parsed
 */
export function faultsOf(sbom, table, linked, { dependencies, lock }) {
  const faults = [];
  const [ofNpm, ofModule] = [[], []];
  for (const component of sbom.components) (component.purl.startsWith("pkg:npm/") ? ofNpm : ofModule).push(component);
  const rows = table.split("\n").filter((line) => line !== "");
  const lines = ofModule.map(({ name, version, licenses, purl }) => [name, version, licenses[0].license.id, purl].join("\t"));
  for (const line of lines) if (!rows.includes(line)) faults.push(`not in the table of components: ${line}`);
  for (const name of linked) if (!ofModule.some((component) => component.name === name)) faults.push(`missing: ${name}`);
  for (const row of rows) {
    const [name] = row.split("\t");
    if (linked.includes(name) || kOthers.includes(name)) continue;
    faults.push(`in the table of components, but nothing links it: ${name}`);
  }
  for (const name of kOthers) if (!ofModule.some((component) => component.name === name)) faults.push(`missing: ${name}`);
  for (const name of dependencies) if (!ofNpm.some((component) => component.name === name)) faults.push(`missing: ${name}`);
  for (const { name, version } of ofNpm) {
    const locked = lock.packages[`node_modules/${name}`]?.version;
    if (version !== locked) faults.push(`${name} ${version}: package-lock.json has ${locked}`);
  }
  return faults;
}

if (process.argv[1] && fileURLToPath(import.meta.url) === process.argv[1]) {
  const read = (name) => readFileSync(fileURLToPath(new URL(`../../${name}`, import.meta.url)), "utf8");
  const [kind, file] = process.argv.slice(2);
  const linked = linkedLibraries(read("cmake/WebDependencies.cmake"), read("scripts/web_dependencies.sh"));
  // CLI11 reads the words of the command, which the page does not have.
  const isMeant = (name) => kind === "command" || name !== "cli11";
  const table = read("build/web-sources/components.tsv").split("\n");
  const faults = faultsOf(
    JSON.parse(readFileSync(file, "utf8")),
    table.filter((line) => isMeant(line.split("\t")[0])).join("\n"),
    linked.filter(isMeant),
    {
      // The element has no panels, and so no widgets.
      dependencies: Object.keys(JSON.parse(read("web/viewer/package.json")).dependencies).filter(
        (name) => kind !== "element" || !name.includes("webawesome"),
      ),
      lock: JSON.parse(read("web/viewer/package-lock.json")),
    },
  );
  for (const fault of faults) console.log(`${file}: ${fault}`);
  process.exitCode = faults.length === 0 ? 0 : 1;
}
