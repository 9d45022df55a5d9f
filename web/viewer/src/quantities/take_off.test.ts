import { describe, expect, it } from "vitest";
import { cellText, columnsOf, fileOf, keysOf, totalOf, unitOf, type Total } from "./take_off";

const table = {
  columns: ["id", "name", "netVolume", "exterior_n", "openings", "trust", "bound", "grossBound"],
  rows: [
    ["w1", "Wall", 1.5, 2, 3, "exact", 1.25e-7, null],
    ["w2", "", null, null, null, null, null, null],
  ],
};

describe("columns of quantities", () => {
  it("have units by their names, and the id is the last one", () => {
    const columns = columnsOf(table);
    expect(columns.map(({ key, unit }) => [key, unit])).toEqual([
      ["name", ""],
      ["netVolume", "m³"],
      ["exterior_n", "m²"],
      ["openings", ""],
      ["trust", ""],
      ["bound", "m³"],
      ["grossBound", "m³"],
      ["id", ""],
    ]);
    expect(columns[1]!.cells).toEqual([1.5, null]);
    expect(["sideArea", "thickness", "perimeter", "storey", "owner"].map(unitOf)).toEqual(["m²", "m", "m", "", ""]);
  });

  it("have titles; a key of sums is its own title", () => {
    expect(columnsOf({ columns: ["netVolume", "owner"], rows: [] }).map(({ title }) => title)).toEqual(["Net volume", "owner"]);
  });
});

describe("cells of quantities", () => {
  it("show unknown values as a dash, and only 0 as 0", () => {
    expect(cellText("netVolume", null)).toBe("–");
    expect(cellText("netVolume", 0)).toBe("0.000");
    expect(cellText("netVolume", 1.23456)).toBe("1.235");
    expect(cellText("netVolume", 0.000412)).toBe("0.00041");
    expect(cellText("bound", 1.25e-7)).toBe("0.00000013");
    expect(cellText("openings", 3)).toBe("3");
    expect(cellText("trust", "caps")).toBe("closed by caps");
    expect(cellText("trust", "other")).toBe("other");
  });

  it("have the sums of the library; columns without a sum have none", () => {
    const total: Total = { objects: 2, netVolume: 1.5, grossVolume: null, bound: 0.1, exterior: { n: 2, s: null } };
    expect(["netVolume", "grossVolume", "exterior_n", "exterior_s", "bound"].map((key) => totalOf(total, key))).toEqual([
      1.5,
      null,
      2,
      null,
      0.1,
    ]);
    expect(["thickness", "trust", "id"].map((key) => totalOf(total, key))).toEqual([undefined, undefined, undefined]);
  });
});

describe("keys of sums", () => {
  it("are those of the library and attributes that can be given as a key", () => {
    expect(keysOf(["owner", "Material", "a,b", "Pset.X"])).toEqual(["class", "name", "storey", "material", "color", "owner", "Pset.X"]);
  });
});

describe("files of quantities", () => {
  it("are named after the model", () => {
    expect(fileOf("folder/House 1.city.json", "sums", "csv")).toBe("House_1_sums.csv");
    expect(fileOf("", "quantities", "json")).toBe("quantities.json");
  });
});
