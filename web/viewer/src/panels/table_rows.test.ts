import { describe, expect, it } from "vitest";
import type { Feature } from "../engine";
import { indexFeatures } from "../state/feature_index";
import { cellsOf, csvOf, rowsWith, sorted, storeysOf, type Cell, type Column } from "./table_rows";

function feature(id: string, parent: string, more: Partial<Feature> = {}): Feature {
  return { id, parent, class: "Wall", name: "", depth: 0, first: 0, count: 1, color: "#000000", opacity: 1, ...more };
}
const column = (cells: Cell[], key = "k", unit = ""): Column => ({ key, isAttribute: true, title: key, unit, cells });

describe("rows of the table", () => {
  const listed = [
    feature("house", "", { class: "Building" }),
    feature("ground", "house", { class: "Storey", name: "Ground floor" }),
    feature("wall", "ground"),
    feature("room", "house", { class: "BuildingRoom", groups: [4] }),
    feature("upper", "house", { class: "Storey", name: "Upper floor" }),
  ];
  const index = indexFeatures(listed);
  const at = (id: string) => index.byId.get(id)!;

  it("know the storey of parts and of members", () => {
    const storeys = storeysOf(index);
    expect(storeys[at("wall")]).toBe(at("ground"));
    expect(storeys[at("room")]).toBe(at("upper"));
    expect(storeys[at("house")]).toBe(-1);
  });

  it("assign values by id, and leave other features empty", () => {
    const cells = cellsOf({ values: [null, 1, 2, "x"], unit: "" }, listed, index);
    expect(["house", "ground", "wall", "room", "upper"].map((id) => cells[at(id)])).toEqual([null, 1, 2, "x", null]);
  });

  it("are filtered by class and by words in any column", () => {
    const names = column(index.features.map(({ name }) => name));
    const ids = column(index.features.map(({ id }) => id));
    expect(rowsWith(index, [names, ids], "", "FLOOR upper")).toEqual([at("upper")]);
    expect(rowsWith(index, [names, ids], "Storey", "")).toEqual([at("ground"), at("upper")]);
  });

  it("are sorted: numbers, texts, and rows without a value at the end in both directions", () => {
    const cells = column([10, null, 9, "b", "a"]);
    const all = [0, 1, 2, 3, 4];
    expect(sorted(all, cells, false, "en")).toEqual([2, 0, 4, 3, 1]);
    expect(sorted(all, cells, true, "en")).toEqual([0, 2, 3, 4, 1]);
  });

  it("are CSV with units, quotes, and nothing for unknown values", () => {
    expect(csvOf([column(["a,b", 'say "x"', null], "name"), column([1.5, null, 0], "Height", "m")], [0, 1, 2])).toBe(
      'name,Height [m]\r\n"a,b",1.5\r\n"say ""x""",\r\n,0\r\n',
    );
  });
});
