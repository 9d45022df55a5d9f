// The software bill of materials of the page and of the npm package: what of others they embed, as CycloneDX JSON.
//   node sbom.mjs PAGE_SBOM   that of the npm package, from the one of its page: the command holds more libraries
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

/** @typedef {{ type: "library", name: string, version: string, licenses: [{ license: { id: string } }], purl: string, "bom-ref": string }} Component */

/**
 * @param {string} name
 * @param {string} version
 * @param {string} licence  by SPDX
 * @param {string} purl
 * @returns {Component}
 */
const component = (name, version, licence, purl) => ({
  type: "library",
  name,
  version,
  licenses: [{ license: { id: licence } }],
  purl,
  "bom-ref": purl,
});

/**
 * What the module holds, as scripts/web_dependencies.sh lists it: name, version, licence, package URL in each line.
 * @param {string} text
 */
export function moduleComponents(text) {
  return text
    .split("\n")
    .filter((line) => line !== "")
    .map((line) => {
      const [name, version, licence, purl] = line.split("\t");
      if (!name || !version || !licence || !purl) throw new Error(`no component: ${line}`);
      return component(name, version, licence, purl);
    });
}

/**
 * The npm packages that files come from.
 * @param {Iterable<string>} files  with their paths
 */
export function npmComponents(files) {
  /** @type {Map<string, Component>} */
  const found = new Map();
  for (const file of files) {
    const folder = /^.*\/node_modules\/(?:@[^/]+\/)?[^/]+/.exec(file.replaceAll("\\", "/").replace(/^\0/, ""))?.[0];
    if (!folder || !existsSync(join(folder, "package.json"))) continue;
    const { name, version, license } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const purl = `pkg:npm/${name.replace("@", "%40")}@${version}`;
    found.set(purl, component(name, version, license, purl));
  }
  return [...found.values()];
}

/**
 * The document: the same bytes for the same components.
 * @param {string} name
 * @param {string} version
 * @param {Component[]} components
 */
export function billOfMaterials(name, version, components) {
  const sorted = [...components].sort((a, b) => (a.purl < b.purl ? -1 : 1));
  const document = {
    bomFormat: "CycloneDX",
    specVersion: "1.5",
    version: 1,
    metadata: { component: { type: "application", name, version, licenses: [{ license: { id: "Apache-2.0" } }] } },
    components: sorted,
  };
  return `${JSON.stringify(document, null, 1)}\n`;
}

const repository = fileURLToPath(new URL("../..", import.meta.url));

/** All that was built into the modules. CLI11 reads the words of the command, and so is in that for Node.js alone. */
export function componentsOfModules() {
  const list = join(repository, "build/web-sources/components.tsv");
  if (!existsSync(list)) throw new Error(`${list} is missing; 'scripts/web_dependencies.sh' writes it`);
  return moduleComponents(readFileSync(list, "utf8"));
}

/** The version of SVT. */
export function ownVersion() {
  return /^project\(svt VERSION ([\d.]+)/m.exec(readFileSync(join(repository, "CMakeLists.txt"), "utf8"))?.[1] ?? "0.0.0";
}

if (process.argv[1] && fileURLToPath(import.meta.url) === process.argv[1]) {
  const page = JSON.parse(readFileSync(String(process.argv[2]), "utf8"));
  const ofPage = page.components.filter((/** @type {Component} */ { purl }) => purl.startsWith("pkg:npm/"));
  process.stdout.write(billOfMaterials("svt", ownVersion(), [...ofPage, ...componentsOfModules()]));
}
