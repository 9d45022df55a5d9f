import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { expect, it } from "vitest";
import { billOfMaterials, moduleComponents, npmComponents } from "./sbom.mjs";

const kZlib = "zlib\t1.2.13.dfsg-1\tZlib\tpkg:deb/debian/zlib@1.2.13.dfsg-1?arch=source\n";

it("lists the libraries of the module with version and licence", () => {
  expect(moduleComponents(kZlib)).toEqual([
    {
      type: "library",
      name: "zlib",
      version: "1.2.13.dfsg-1",
      licenses: [{ license: { id: "Zlib" } }],
      purl: "pkg:deb/debian/zlib@1.2.13.dfsg-1?arch=source",
      "bom-ref": "pkg:deb/debian/zlib@1.2.13.dfsg-1?arch=source",
    },
  ]);
  expect(() => moduleComponents("zlib\t\tZlib\tpkg:x\n")).toThrow("no component");
});

it("lists each npm package of a bundle once, and no own file", () => {
  const folder = mkdtempSync(join(tmpdir(), "svt-sbom-"));
  const add = (name: string, version: string) => {
    mkdirSync(join(folder, "node_modules", name), { recursive: true });
    writeFileSync(join(folder, "node_modules", name, "package.json"), JSON.stringify({ name, version, license: "MIT" }));
    return join(folder, "node_modules", name);
  };
  const lit = add("lit", "3.0.0"),
    scoped = add("@lit/reactive-element", "2.0.0");
  const found = npmComponents([`${lit}/index.js`, `${lit}/html.js`, `${scoped}/a/b.js?worker`, `${folder}/src/app.ts`, "\0virtual"]);
  expect(found.map(({ purl }) => purl)).toEqual(["pkg:npm/lit@3.0.0", "pkg:npm/%40lit/reactive-element@2.0.0"]);
  rmSync(folder, { recursive: true });
});

it("is CycloneDX, sorted, the same each time", () => {
  const components = moduleComponents(`${kZlib}fmtlib\t9.1\tMIT\tpkg:deb/debian/fmtlib@9.1?arch=source\n`);
  const text = billOfMaterials("svt-viewer", "0.1.0", components);
  expect(text).toBe(billOfMaterials("svt-viewer", "0.1.0", [...components].reverse()));
  const document = JSON.parse(text);
  expect([document.bomFormat, document.specVersion, document.metadata.component.version]).toEqual(["CycloneDX", "1.5", "0.1.0"]);
  expect(document.components.map(({ name }: { name: string }) => name)).toEqual(["fmtlib", "zlib"]);
});
