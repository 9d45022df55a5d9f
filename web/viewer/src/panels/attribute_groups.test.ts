import { describe, expect, it } from "vitest";
import type { FeatureProperties } from "../engine";
import { filtered, groupsOf, measuredFor } from "./attribute_groups";

const kWall = {
  ifcType: "IfcWall",
  "Pset_WallCommon.IsExternal": "true",
  material: "Concrete",
  "Pset_WallCommon.Reference.Sub": "A",
  "BaseQuantities.NetVolume": "2.5 m3",
  classification: "330",
  "Custom.Height": "3",
};

describe("groups of attributes", () => {
  it("are sets, materials, classification and quantities, in this order", () => {
    const groups = groupsOf(kWall);
    expect(groups.map(({ kind, set }) => `${kind} ${set}`.trim())).toEqual([
      "general",
      "material",
      "classification",
      "quantities BaseQuantities",
      "set Pset_WallCommon",
      "set Custom",
    ]);
    expect(groups[4]!.rows.map(({ label }) => label)).toEqual(["IsExternal", "Reference.Sub"]);
    expect(groups.flatMap(({ rows }) => rows).length).toBe(Object.keys(kWall).length);
  });

  it("keep complete names for quantities of several sets", () => {
    const [group] = groupsOf({ "Qto_WallBaseQuantities.Height": "3", "OtherQuantities.Height": "3.1" });
    expect(group!.rows.map(({ label }) => label)).toEqual(["Qto_WallBaseQuantities.Height", "OtherQuantities.Height"]);
    expect(group!.set).toBe("");
  });

  it("do not split names that begin or end with a dot", () => {
    expect(groupsOf({ ".a": "1", "b.": "2" }).map(({ kind }) => kind)).toEqual(["general"]);
  });

  it("are filtered by all words in name or value", () => {
    expect(filtered(groupsOf(kWall), "wallcommon true").flatMap(({ rows }) => rows.map(({ name }) => name))).toEqual([
      "Pset_WallCommon.IsExternal",
    ]);
    expect(filtered(groupsOf(kWall), "nothing of this")).toEqual([]);
    expect(filtered(groupsOf(kWall), "  ").length).toBe(6);
  });
});

describe("measured values beside quantities", () => {
  const box = { low: [0, 0, 1], high: [4, 0.3, 3.5] };
  const p = { totalVolume: null, modelVolume: null, voxelVolume: 2.4, surface: 20, totalSurface: 0, box } as unknown as FeatureProperties;

  it("have the same meaning, and gross quantities are not measured", () => {
    expect(measuredFor("NetVolume", p)).toEqual({ value: 2.4, unit: "m³" });
    expect(measuredFor("NetVolume", { ...p, modelVolume: 2.5 })).toEqual({ value: 2.5, unit: "m³" });
    // With its parts, as a door with its frame.
    expect(measuredFor("NetVolume", { ...p, modelVolume: 2.5, totalVolume: 3 })).toEqual({ value: 3, unit: "m³" });
    expect(measuredFor("Height", p)?.value).toBeCloseTo(2.5);
    for (const name of ["GrossVolume", "Length", "NetSideArea"]) expect(measuredFor(name, p), name).toBeNull();
  });

  it("are unknown rather than 0", () => {
    expect(measuredFor("NetVolume", { ...p, voxelVolume: 0 })).toBeNull();
    expect(measuredFor("TotalSurfaceArea", { ...p, surface: 0 })).toBeNull();
  });
});
