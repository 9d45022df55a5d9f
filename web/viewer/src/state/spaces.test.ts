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
    expect(withSpaces({ cut: "z>1" }, house, flags())).toEqual({ cut: "z>1", styles: [asked] });
    expect(withSpaces({}, house, flags("r0"))).toEqual({ styles: [{ ...asked, select: 'id="r1"' }] });
    const own = { select: "class=BuildingRoom", color: "#ff0000" };
    expect(withSpaces({ styles: [own] }, house, flags())).toEqual({ styles: [own] });
    expect(withSpaces({ show: ["id=w"] }, house, flags())).toEqual({ show: ["id=w"] });
    const invisible = { select: "class=BuildingRoom", opacity: 0 };
    expect(withSpaces({ show: ["all"] }, house, flags("r0", "r1"))).toEqual({ show: ["all"], styles: [invisible] });
  });

  it("are left out by the library, so that queries do not hide what belongs to them", () => {
    const hide = ["class=BuildingRoom", 'id="r0"', "class=Wall", "volume>20"];
    expect(withSpaces({ hide }, house, flags("r0", "r1", "w"))).toEqual({ hide: ["class=Wall", "volume>20"] });
  });

  it("stay invisible where a style or a name may ask for them", () => {
    const own = { select: "all", color: "#ff0000" };
    const invisible = { ...asked, opacity: 0 };
    expect(withSpaces({ styles: [own] }, house, flags("r0", "r1"), true)).toEqual({ styles: [own, invisible] });
    expect(withSpaces({}, house, flags(), true)).toEqual({ styles: [asked] });
  });
});
