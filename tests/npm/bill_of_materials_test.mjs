// What the check of the bill of materials finds. node --test tests/npm/bill_of_materials_test.mjs
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";

import { faultsOf, linkedLibraries } from "./bill_of_materials.mjs";

const read = (name) => readFileSync(new URL(`../../${name}`, import.meta.url), "utf8");
const kScript = 'libraries=(\n  "libzstd zstd libzstd-dev BSD-3-Clause"\n  "zlib zlib zlib1g-dev Zlib"\n)\nheaders=(fmt CLI)  # more\n';
const kCmake =
  "function(web_library alias include)\nweb_library(ZLIB::ZLIB zlib zlib/*.c)\n\nweb_library(ZSTD::ZSTD zstd/lib\n  zstd/lib/*.c)\n";
const kNames = ["zlib", "libzstd", "fmtlib", "cli11"];
const kAll = [...kNames, "emscripten", "fonts-dejavu"];

const row = (name, version = "1.0-1") => `${name}\t${version}\tMIT\tpkg:deb/debian/${name}@${version}?arch=source\n`;
const component = (name, version, purl) => ({ name, version, licenses: [{ license: { id: "MIT" } }], purl });
const ofDebian = (name, version = "1.0-1") => component(name, version, `pkg:deb/debian/${name}@${version}?arch=source`);
const kLit = component("lit", "3.3.3", "pkg:npm/lit@3.3.3");
const kPage = { dependencies: ["lit"], lock: { packages: { "node_modules/lit": { version: "3.3.3" } } } };

const check = ({
  components = [...kAll.map((name) => ofDebian(name)), kLit],
  table = kAll.map((name) => row(name)).join(""),
  linked = kNames,
}) => faultsOf({ components }, table, linked, kPage);

test("the libraries of a module are those that CMake compiles, and those of headers", () => {
  assert.deepEqual(linkedLibraries(kCmake, kScript), kNames);
  const added = `${kCmake}web_library(JPEG::JPEG jpeg/src jpeg/src/*.c)\n`;
  assert.ok(linkedLibraries(added, kScript).includes("jpeg"));
  assert.ok(linkedLibraries(kCmake, kScript.replace("(fmt ", "(Eigen fmt ")).includes("Eigen"));
  const own = linkedLibraries(read("cmake/WebDependencies.cmake"), read("scripts/web_dependencies.sh"));
  assert.deepEqual([...own].sort(), [
    ...["cli11", "fast-float", "fmtlib", "freetype", "highway", "libglu", "libpng1.6", "libzstd", "nlohmann-json3", "pugixml"],
    ...["simdjson", "zlib"],
  ]);
});

test("what is complete has no fault", () => assert.deepEqual(check({}), []));

test("a library that is missing is named", () => {
  for (const name of [...kAll, "lit"])
    assert.deepEqual(check({ components: [...kAll.map((n) => ofDebian(n)), kLit].filter((c) => c.name !== name) }), [`missing: ${name}`]);
  assert.deepEqual(check({ linked: [...kNames, "jpeg"] }), ["missing: jpeg"]);
});

test("another version than that of the table is named", () => {
  const components = [...kAll.map((name) => ofDebian(name, name === "zlib" ? "1.0-2" : "1.0-1")), kLit];
  assert.deepEqual(check({ components }), [`not in the table of components: ${row("zlib", "1.0-2").trimEnd()}`]);
  const older = [...kAll.map((name) => ofDebian(name)), { ...kLit, version: "3.3.2" }];
  assert.deepEqual(check({ components: older }), ["lit 3.3.2: package-lock.json has 3.3.3"]);
});

test("a library that nothing links is named", () => {
  assert.deepEqual(check({ linked: kNames.filter((name) => name !== "zlib") }), ["in the table of components, but nothing links it: zlib"]);
});
