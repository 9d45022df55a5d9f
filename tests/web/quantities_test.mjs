// The WebAssembly module that measures quantities, against `svt quantities`: the same files, byte by byte. Run by ctest, or by
//   node tests/web/quantities_test.mjs COMMAND MODULE_FOLDER [DATA_FOLDER]
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { ask, at, bytes, command, dataFolder, folder, run, steps, svt } from "./reports_module.mjs";

const read = (...paths) => {
  const files = paths.map((path) => ({ name: path.split("/").pop(), content: readFileSync(path) }));
  const sizes = files.map(({ content }) => content.length);
  return ask("readModel", [files.map(({ name }) => name), sizes, {}], Buffer.concat(files.map(({ content }) => content)));
};

/** The file that `svt quantities` writes, and its notes without the findings of the reader. */
function quantities(input, ending, ...options) {
  const file = at(`out.${ending}`);
  const done = spawnSync(command, ["quantities", input, "-o", file, ...options], { encoding: "utf8" });
  assert.equal(done.status, 0, done.stderr);
  const notes = done.stderr
    .split("\n")
    .flatMap((line) => line.match(/^svt: (?!(note|warning|error) E\d| {2}|.*--verbose shows)(.*)$/)?.[2] ?? []);
  return { bytes: readFileSync(file), notes: notes.filter((note) => !note.includes(file)) };
}

run("sample", "house", "-o", at("house.gml"));
run("sample", "house", "-o", at("house.ifc"), "--format", "ifc");
run("sample", "house", "-o", at("house.city.json"), "--format", "cityjson");
run("build", at("house.gml"), "-o", at("house.svt"), "--spacing", "0.2", "--vectors", "meshes");
run("build", at("house.gml"), "-o", at("bare.svt"), "--spacing", "0.2", "--vectors", "none");
run("sample", "tower", "-o", at("tower.gml"));

const concrete = "class=BuildingConstructiveElement";
const walls = "class=IfcWall";
const kAll = { exterior: true, formwork: concrete };
const kAllOptions = ["--exterior", "--formwork", concrete];
/** File, options of the module, options of the command, keys of sums. @type {[string, object, string[], string][]} */
const inputs = [
  ["house.svt", kAll, kAllOptions, "class,storey"],
  ["bare.svt", { exterior: true }, ["--exterior"], "storey"],
  ["house.gml", {}, [], "material"],
  ["house.ifc", { where: walls, formwork: walls }, ["--where", walls, "--formwork", walls], "storey"],
  ["house.city.json", { where: 'storey="Ground floor"' }, ["--where", 'storey="Ground floor"'], "class"],
  ["tower.gml", {}, [], "owner"],
];
// Files of other programs, where they are.
/** @type {typeof inputs} */
const kOthers = [
  ["fzk_haus.ifc", { exterior: true }, ["--exterior"], "ifcType,storey"],
  ["fzk_haus.city.json", {}, [], "class"],
  ["samplehouse.ifc", {}, [], "material"],
  ["100_buildings_lod2_citygml3.gml", {}, [], "class"],
];

for (const [name, wish, options, by] of [...inputs, ...kOthers])
  test(`${name} has the files of 'svt quantities'`, (context) => {
    const path = existsSync(at(name)) ? at(name) : join(dataFolder ?? folder, name);
    if (!existsSync(path)) return context.skip("the file is missing");
    steps.length = 0;
    const model = read(path);
    const found = ask("measure", [wish]);
    assert.equal(model.hasMeshes, name !== "bare.svt");
    assert.ok(model.spacing.every((metres) => metres > 0));
    assert.ok(steps.some(([step]) => step === "measure") && steps.every(([, done]) => done >= 0 && done <= 1));
    const csv = quantities(path, "csv", ...options);
    assert.ok(bytes("quantitiesCsv", "").equals(csv.bytes), "CSV of the rows");
    assert.ok(bytes("quantitiesJson", "").equals(quantities(path, "json", ...options).bytes), "JSON");
    // Other keys replace those before.
    ask("sums", ["name"]);
    const sums = ask("sums", [by]);
    assert.ok(bytes("quantitiesCsv", by).equals(quantities(path, "csv", ...options, "--by", by).bytes), "CSV of the sums");
    const json = quantities(path, "json", ...options, "--by", by).bytes;
    assert.ok(bytes("quantitiesJson", by).equals(json), "JSON with sums");
    // Another table after that of the sums, and notes without those on the spacing.
    assert.ok(bytes("quantitiesCsv", "").equals(csv.bytes), "CSV of the rows again");
    assert.deepEqual(
      found.notes,
      csv.notes.filter((note) => !note.startsWith("spacing: ")),
    );
    assert.equal(
      model.reason ? `spacing: ${model.reason}` : undefined,
      csv.notes.find((note) => note.startsWith("spacing: ")),
    );
    const { rows, total, sums: groups, assumptions } = JSON.parse(json.toString());
    assert.ok(rows.length > 0);
    assert.deepEqual(found.total, total);
    assert.deepEqual(found.assumptions, assumptions);
    const column = (key) => found.rows.map((row) => row[found.columns.indexOf(key)]);
    for (const key of ["id", "storey", "netVolume", "openingArea", "trust", "bound"])
      assert.deepEqual(
        column(key),
        rows.map((row) => row[key]),
        key,
      );
    // Each object is in one group, and groups have the sums of the file.
    assert.deepEqual(
      sums.members.flat().sort((a, b) => a - b),
      rows.map((_, n) => n),
    );
    assert.deepEqual(
      sums.rows.map((row) => row[sums.columns.indexOf("netVolume")]),
      groups.map((group) => group.netVolume),
    );
    assert.deepEqual(
      sums.unknown,
      groups.map((group) => group.unknown ?? {}),
    );
  });

test("a volume without meshes has unknown areas, which are null", () => {
  read(at("bare.svt"));
  const { columns, rows, notes, total } = ask("measure", [kAll]);
  assert.ok(notes[0].includes("no meshes"));
  for (const key of ["sideArea", "exteriorArea", "formworkArea", "length"])
    assert.ok(
      rows.every((row) => row[columns.indexOf(key)] === null),
      key,
    );
  assert.equal(total.sideArea, null);
});

test("a query that selects nothing gives no rows and a note; a wrong one is an error, and the model stays", () => {
  read(at("house.svt"));
  const none = ask("measure", [{ where: "class=Nothing" }]);
  assert.deepEqual(none.rows, []);
  assert.ok(none.notes.length >= 2, none.notes.join());
  assert.throws(() => svt.call("quantitiesCsv", [""]) && svt.call("measure", [{ where: "class=" }]), { code: "E901" });
  assert.ok(ask("measure", [{}]).rows.length > 0);
  const csv = bytes("quantitiesCsv", "");
  assert.throws(() => svt.call("measure", [{ formwork: "class=" }]), { code: "E901" });
  assert.ok(bytes("quantitiesCsv", "").equals(csv), "the last figures stay");
});

test("errors are those of the library, and no model remains", () => {
  assert.throws(() => read(), { code: "E904" });
  assert.throws(() => svt.call("quantitiesJson", [""]), { code: "E904" });
  writeFileSync(at("empty.gml"), "");
  writeFileSync(at("noise.svt"), "no volume");
  writeFileSync(at("cut.svt"), readFileSync(at("house.svt")).subarray(0, 4000));
  for (const name of ["empty.gml", "noise.svt", "cut.svt"]) {
    read(at("house.svt"));
    assert.throws(
      () => read(at(name)),
      ({ code, message }) => /^E\d+$/.test(code) && message.includes(name),
    );
    assert.throws(() => svt.call("measure", [{}]), { code: "E904" });
  }
});
