import { describe, expect, it } from "vitest";
import type { Feature } from "../engine";
import { indexFeatures } from "./feature_index";
import { hiddenSpaces, withSpaces } from "./spaces";

const feature = (id: string, name: string, parent: string, first: number): Feature => ({
  ...{ id, class: name, name: id, parent, depth: parent ? 1 : 0, first, count: first ? 1 : 0 },
  ...{ color: "#808080", opacity: name === "BuildingRoom" ? 0.08 : 1, isSpace: name === "BuildingRoom" },
});
const rooms = [feature("b", "Building", "", 0), feature("r0", "BuildingRoom", "b", 1), feature("r1", "BuildingRoom", "b", 2)];
const house = indexFeatures([...rooms, feature("w", "Wall", "b", 3), feature("s", "Storey", "b", 0)]);
const flags = (...hidden: string[]) => Uint8Array.from(house.features, ({ id }) => (hidden.includes(id) ? 1 : 0));
const asked = { select: "class=BuildingRoom", opacity: 0.08 };

describe("spaces", () => {
  it("are hidden at first beside anything else", () => {
    expect(hiddenSpaces(house)).toEqual(["class=BuildingRoom"]);
    expect(hiddenSpaces(indexFeatures(rooms))).toEqual([]);
  });

  it("are asked for where one of them is visible", () => {
    expect(withSpaces({}, house, flags("r0", "r1"))).toEqual({});
    expect(withSpaces({ cut: "z>1" }, house, flags("r0"))).toEqual({ cut: "z>1", styles: [asked] });
    const own = { select: "class=BuildingRoom", color: "#ff0000" };
    expect(withSpaces({ styles: [own] }, house, flags())).toEqual({ styles: [own] });
    expect(withSpaces({ show: ["id=w"] }, house, flags())).toEqual({ show: ["id=w"] });
  });
});
