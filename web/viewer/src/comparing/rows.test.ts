import { describe, expect, it } from "vitest";
import type { Feature } from "../engine";
import { indexFeatures } from "../state/feature_index";
import type { Change, Row } from "./compared";
import { fileOf, hasVolumes, kindsOf, nameOfRow, onlyIn, otherProperties, partsOf, rowsWith, shareOf, withShare } from "./rows";

function row(change: Change, given: Partial<Row> = {}): Row {
  return {
    change,
    old: [],
    new: [],
    class: "Wall",
    name: "",
    storey: null,
    geometry: true,
    vector: null,
    added: null,
    removed: null,
    distance: null,
    exact: false,
    bound: null,
    properties: {},
    attributes: {},
    ...given,
  };
}

const rows = [
  row("same", { old: ["a"], new: ["a"], name: "Nordwand", attributes: { fireRating: ["F30", "F90"] } }),
  row("removed", { old: ["b"], removed: 2 }),
  row("changed", { old: ["c"], new: ["c2"], added: 1, removed: 4, storey: "Attic", properties: { id: ["c", "c2"] } }),
  row("same", { old: ["d"], new: ["d"] }),
];
const compared = { rows, order: [2, 1, 0] };

function feature(id: string, parent = "", count = 1): Feature {
  return { id, class: "Wall", name: "", parent, depth: parent ? 1 : 0, first: 1, count, color: "#ffffff", opacity: 1 };
}
const index = indexFeatures([
  feature("added", "", 0),
  feature("n", "added"),
  feature("removed", "", 0),
  feature("b", "removed"),
  feature("changed", "", 0),
  feature("c2", "changed"),
  feature("c2/added", "changed"),
  feature("c/removed", "changed"),
]);

describe("rows of a comparison", () => {
  it("keep the order of the library, and only those that differ", () => {
    expect(rowsWith(compared, new Set(), "")).toEqual([rows[2], rows[1], rows[0]]);
    expect([...kindsOf(compared)]).toEqual([
      ["changed", 1],
      ["removed", 1],
      ["same", 1],
    ]);
  });

  it("are found by kind, and by words in names, ids, storeys and changed properties", () => {
    expect(rowsWith(compared, new Set(["removed"]), "")).toEqual([rows[1]]);
    expect(rowsWith(compared, new Set(), "attic WALL")).toEqual([rows[2]]);
    expect(rowsWith(compared, new Set(), "firerating")).toEqual([rows[0]]);
    expect(rowsWith(compared, new Set(["removed"]), "c2")).toEqual([]);
  });

  it("have names, and other properties without new ids", () => {
    expect(rows.map(nameOfRow)).toEqual(["Nordwand", "b", "c2", "d"]);
    expect(otherProperties(rows[0]!)).toEqual(["fireRating"]);
    expect(otherProperties(rows[2]!)).toEqual([]);
  });

  it("distinguish unknown volumes from 0", () => {
    expect(hasVolumes(row("changed"))).toBe(false);
    expect(hasVolumes(row("changed", { added: 0 }))).toBe(true);
  });

  it("have their parts in the volume of the difference", () => {
    expect(partsOf(rows[2]!, index)).toEqual(["c2", "c2/added", "c/removed"]);
    expect(partsOf(rows[1]!, index)).toEqual(["b"]);
    expect(partsOf(row("removed", { old: ["n"] }), index)).toEqual([]);
    expect(partsOf(row("same", { old: ["x"], new: ["x"] }), index)).toEqual([]);
  });
});

describe("the shown state", () => {
  const was = `under "removed" or id~"/removed$"`,
    is = `under "added" or id~"/added$"`;

  it("is a query of the space that only one state has", () => {
    expect(onlyIn("was", index)).toBe(was);
    expect(onlyIn("is", index)).toBe(is);
    expect(onlyIn("was", indexFeatures([feature("a")]))).toBeNull();
  });

  it("is old, new, both, or a transition, and is read from the styles", () => {
    expect(withShare([], 0, index)).toEqual([{ select: is, opacity: 0 }]);
    expect(withShare([], 1, index)).toEqual([{ select: was, opacity: 0 }]);
    expect(withShare([], 0.5, index)).toEqual([]);
    expect(withShare([], 0.25, index)).toEqual([{ select: is, opacity: 0.5 }]);
    for (const share of [0, 0.25, 0.5, 0.75, 1]) expect(shareOf(withShare([], share, index), index)).toBe(share);
  });

  it("keeps styles of the user", () => {
    const own = [{ select: "class=Wall", color: "#ff0000" }];
    const old = withShare(own, 0, index);
    expect(old).toEqual([...own, { select: is, opacity: 0 }]);
    expect(withShare(old, 0.5, index)).toEqual(own);
    const colored = [{ select: is, color: "#00ff00" }];
    expect(withShare(withShare(colored, 0, index), 1, index)).toEqual([{ select: was, opacity: 0 }, ...colored]);
  });
});

describe("the file of a difference", () => {
  it("has the names of both", () => {
    expect(fileOf("old.gml", "sub/new state.ifc")).toBe("old_new_state.svt");
    expect(fileOf("house", "a.city.json.gz, b.gml")).toBe("house_a_city_json_gz_b.svt");
  });
});
