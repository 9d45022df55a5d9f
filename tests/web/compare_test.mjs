// The WebAssembly module that compares two states, against `svt diff`: the same rows and the same volume, byte by byte. Run
// by ctest, or by
//   node tests/web/compare_test.mjs COMMAND MODULE_FOLDER
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { test } from "node:test";
import { ask, at, bytes, command, run, steps, svt } from "./reports_module.mjs";

/** Compares two states, each a path or several, and returns the report. */
function compare(old, is, wish = {}) {
  const states = [old, is].map((state) => [state].flat().map((path) => ({ name: path.split("/").pop(), content: readFileSync(path) })));
  const of = (value) => states.map((files) => files.map(value));
  const all = Buffer.concat(states.flat().map(({ content }) => content));
  return JSON.parse(
    new TextDecoder().decode(svt.call("compare", [of(({ name }) => name), of(({ content }) => content.length), wish], all)),
  );
}

/** The files that `svt diff` writes of the same states. */
function diff(old, is, ...options) {
  const done = spawnSync(command, ["diff", old, is, "-q", "-o", at("diff.json"), "-o", at("diff.svt"), ...options]);
  assert.ok([0, 7].includes(done.status), String(done.stderr));
  return { json: readFileSync(at("diff.json")), svt: readFileSync(at("diff.svt")) };
}

function makeStates() {
  run("sample", "house", "-o", at("old.gml"));
  run("sample", "house", "-o", at("new.gml"), "--change", "4");
  run("build", at("old.gml"), "-o", at("old.svt"), "--spacing", "0.2", "--vectors", "meshes");
  run("build", at("new.gml"), "-o", at("new.svt"), "--spacing", "0.2", "--vectors", "meshes");
}
makeStates();

function assertAsDiff(old, is, ...options) {
  const { json, svt: volume } = diff(old, is, ...options);
  assert.ok(bytes("rows").equals(json), "rows");
  // The command adds both states behind the entries of the volume, so both are equal up to the central directory.
  const own = bytes("difference"),
    directory = own.readUInt32LE(own.length - 6);
  assert.ok(directory > 0 && own.subarray(0, directory).equals(volume.subarray(0, directory)), "volume");
  return JSON.parse(json.toString());
}

for (const [old, is] of [
  ["old.svt", "new.svt"],
  ["old.svt", "new.gml"],
  ["old.gml", "new.svt"],
  ["old.gml", "new.gml"],
])
  test(`${old} and ${is} have the rows and the volume of 'svt diff'`, () => {
    steps.length = 0;
    const report = compare(at(old), at(is));
    const { rows, summary } = assertAsDiff(at(old), at(is));
    assert.ok(summary.different);
    assert.ok(report.overlaps && report.hasMeshes && report.isOnOneLattice && report.isComplete);
    assert.equal(report.aligned, "");
    assert.ok(steps.some(([step]) => step === "compare") && steps.every(([, done]) => done >= 0 && done <= 1));
    // The order of pages and issues: known volumes from the largest, then unknown ones, then other properties.
    const order = ask("order");
    const differs = (row) =>
      row.change !== "same" || Object.keys(row.attributes).length || Object.keys(row.properties).some((name) => name !== "id");
    assert.deepEqual(
      [...order].sort((a, b) => a - b),
      rows.flatMap((row, n) => (differs(row) ? [n] : [])),
    );
    const volumes = order
      .map((n) => rows[n])
      .filter(({ geometry, change, added, removed }) => geometry && !["same", "reassigned"].includes(change) && (added ?? removed) !== null)
      .map(({ added, removed }) => (added ?? 0) + (removed ?? 0));
    assert.ok(volumes.length > 0);
    assert.deepEqual(
      volumes,
      [...volumes].sort((a, b) => b - a),
    );
  });

test("options are those of 'svt diff'", () => {
  for (const [wish, ...options] of [
    [{ match: "id" }, "--match", "id"],
    [{ match: "space", properties: "names" }, "--match", "space", "--properties", "names"],
    [{ properties: "none", tolerance: 0.5 }, "--properties", "none", "--tolerance", "0.5"],
  ]) {
    compare(at("old.svt"), at("new.svt"), wish);
    assertAsDiff(at("old.svt"), at("new.svt"), ...options);
  }
});

test("sums of components leave out rooms and buildings, and unknown volumes are null", () => {
  const { components } = compare(at("old.svt"), at("new.svt"));
  const { rows } = JSON.parse(bytes("rows").toString());
  const isComponent = (name) => !/^(Building|BuildingPart|BuildingUnit|BuildingRoom|Storey)$/.test(name);
  const changed = rows.filter((row) => row.geometry && row.change !== "same" && isComponent(row.class));
  const known = changed.filter(({ added, removed }) => added !== null || removed !== null);
  const sum = (key) => known.reduce((all, row) => all + (row[key] ?? 0), 0);
  assert.equal(components.objects, changed.length);
  assert.equal(components.withoutVolume, changed.length - known.length);
  assert.ok(Math.abs(components.added - sum("added")) < 1e-6 && Math.abs(components.removed - sum("removed")) < 1e-6);
  const same = compare(at("old.svt"), at("old.svt")).components;
  assert.deepEqual(same, { objects: 0, added: null, removed: null, bound: null, withoutVolume: 0 });
});

test("a model that was shifted as a whole is moved on request, and the vector is reported", () => {
  const shifted = readFileSync(at("old.gml"), "utf8").replace(
    /(<gml:(?:posList|lowerCorner|upperCorner|pos)[^>]*>)([^<]*)/g,
    (_, tag, text) => {
      const moved = text
        .trim()
        .split(/\s+/)
        .map((value, n) => (n % 3 === 0 ? String(Number(value) + 1000) : value));
      return tag + moved.join(" ");
    },
  );
  writeFileSync(at("shifted.gml"), shifted);
  const apart = compare(at("old.gml"), at("shifted.gml"));
  assert.equal(apart.overlaps, false);
  const report = compare(at("old.gml"), at("shifted.gml"), { align: true });
  assert.equal(report.aligned, "moved");
  assert.ok(Math.abs(report.shift[0] + 1000) < 1e-3 && Math.hypot(report.shift[1], report.shift[2]) < 1e-3, report.shift.join());
  assert.equal(report.overlaps, true);
  assertAsDiff(at("old.gml"), at("shifted.gml"), "--align", "translation");
});

test("errors are those of the library, and no comparison remains", () => {
  /** @returns {{ code: string; message: string }} */
  const fails = (old, is) => {
    try {
      compare(old, is);
    } catch (error) {
      return /** @type {any} */ (error);
    }
    return assert.fail("it succeeded");
  };
  writeFileSync(at("empty.gml"), "");
  writeFileSync(at("noise.svt"), "no volume");
  writeFileSync(at("damaged.svt"), readFileSync(at("new.svt")).subarray(0, 5000));
  for (const name of ["empty.gml", "noise.svt", "damaged.svt"]) {
    const { code, message } = fails(at("old.svt"), at(name));
    assert.match(code, /^E\d+$/);
    assert.ok(message.includes(name), message);
  }
  assert.equal(fails([at("old.svt"), at("new.svt")], at("new.svt")).code, "E904");
  assert.throws(() => svt.call("rows", []), { code: "E904" });
});
