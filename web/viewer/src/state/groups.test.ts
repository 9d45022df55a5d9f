import { describe, expect, it } from "vitest";
import type { Feature, Scene } from "../engine";
import { coloredBy, colorKeys } from "./color_keys";
import { compacted, expanded, positionsOf, rangesOf } from "./compact";
import { indexFeatures, isGroupOfParts, withMembers } from "./feature_index";
import { History } from "./history";
import { hashOf, stateOfHash } from "./link";
import { joined, ofId, ofSubtree, ownTerms } from "./queries";
import { tintStyles } from "./tint";
import { initialState } from "./view_state";
import { hiddenFlags, hideQueries, SeenCounts, subtree } from "./visibility";

let scalar = 1;
const feature = (id: string, parent: string, name: string, count = 1, groups?: number[]): Feature => ({
  ...{ id, class: name, name: "", parent, depth: 0, first: count ? scalar++ : 0, count, color: "#808080", opacity: 1 },
  ...(groups ? { groups } : {}),
  ...(/Room|Unit|Storey/.test(name) ? { isSpace: true } : {}),
});

/** A flat below its storey, whose room and wall are elsewhere in the tree. */
const house = indexFeatures([
  feature("b", "", "Building", 0),
  feature("storey", "b", "Storey", 0),
  feature("flat", "storey", "BuildingUnit"),
  feature("room", "b", "BuildingRoom", 1, [2]),
  feature("bed", "room", "BuildingFurniture"),
  feature("wall", "b", "Wall", 1, [2, 99]),
  feature("outer", "b", "Wall"),
]);
const ids = (places: Iterable<number>) => [...places].map((i) => house.features[i]!.id);
const flagsOf = (...names: string[]) => Uint8Array.from(house.features, ({ id }) => (names.includes(id) ? 1 : 0));
const all = ["flat", "room", "bed", "wall"];

describe("groups", () => {
  it("have their members, whatever the place of these in the tree", () => {
    expect(ids(subtree(house, 2))).toEqual(all);
    expect(ids(withMembers(house, [1]))).toEqual(["storey", ...all]);
    expect(ids(withMembers(house, [3, 4]))).toEqual(["room", "bed"]);
    expect([0, 1, 2, 3, 5].map((i) => isGroupOfParts(house, i))).toEqual([true, true, true, false, false]);
    const ring = indexFeatures([feature("x", "", "Group", 1, [1]), feature("y", "", "Group", 1, [0])]);
    expect(withMembers(ring, [0])).toEqual([0, 1]);
  });

  it("are hidden by one query, which hides the same as the library does", () => {
    const flags = flagsOf(...all);
    const queries = hideQueries(house, flags, [], undefined, ['under "flat"']);
    expect(queries).toEqual(['under "flat"']);
    expect(hiddenFlags(house, queries)).toEqual(flags);
    // The query must go when a member of the flat becomes visible.
    const without = hideQueries(house, flagsOf("flat", "room", "bed"), queries);
    expect(hiddenFlags(house, without)).toEqual(flagsOf("flat", "room", "bed"));
    expect(without).not.toContain('under "flat"');
    // The flat is not the whole storey, although the tree has nothing else below the storey.
    expect(hideQueries(house, flagsOf("flat"))).toEqual(['id="flat"']);
  });

  it("are counted with their members", () => {
    const counts = new SeenCounts(house, flagsOf("room"));
    expect([counts.ofSubtree(1), counts.ofSubtree(5), counts.solidsOf(2), counts.solidsOf(0)]).toEqual(["some", "all", 4, 5]);
    expect(new SeenCounts(house, flagsOf(...all)).ofSubtree(1)).toBe("none");
  });
});

describe("queries of the user", () => {
  const answers = (query: string) => (query === "volume>20" ? [3, 5] : undefined);

  it("hide what the library has found for them, and are replaced where a part is shown again", () => {
    expect(ids(house.features.flatMap((_, i) => (hiddenFlags(house, ["volume>20"], answers)[i] ? [i] : [])))).toEqual(["room", "wall"]);
    expect(hideQueries(house, flagsOf("room", "wall"), [], answers, ["volume>20"])).toEqual(["volume>20"]);
    expect(hideQueries(house, flagsOf("room"), ["volume>20"], answers)).toEqual(['id="room"']);
    expect(hideQueries(house, flagsOf("room"), ["unknown>1"], answers)).toEqual(["unknown>1", 'id="room"']);
  });
});

describe("sets of many features", () => {
  const many = Array.from({ length: 100_000 }, (_, i) => feature(`feature_${i}_"x"`, i ? 'feature_0_"x"' : "", `C${i % 7}`));
  const index = indexFeatures(many);
  const every = (n: number, most = many.length) => many.filter((_, i) => i > 0 && i % n === 0 && i < most).map(({ id }) => id);

  it("become few queries, which are read back", () => {
    const terms = [...every(9, 20_000).map(ofId), ofSubtree("a or b")];
    const queries = joined(terms);
    expect(queries.length).toBeLessThan(8);
    expect(Math.max(...queries.map((query) => query.length))).toBeLessThan(21_000);
    expect(queries.flatMap((query) => ownTerms(query)!).length).toBe(terms.length);
    expect(ownTerms('id="a" or volume>2')).toBeNull();
    expect(ownTerms('id="a" or ')).toBeNull();
    expect(joined(['id="a"', 'id="b"'])).toEqual(['id="a"', 'id="b"']);
  });

  it("become ranges of the tree in links, which stay short", async () => {
    expect(rangesOf([1, 2, 3, 7, 3, 9])).toBe("1+3,3,1");
    expect(positionsOf("1+3,3,1", 100)).toEqual([1, 2, 3, 7, 9]);
    expect(positionsOf("1+zzzzz,x,-4", 5)).toEqual([1, 2, 3, 4]);
    const state = { ...initialState(), selection: every(3), hide: joined(every(2).map(ofId)), show: joined(every(5).map(ofSubtree)) };
    const scene: Scene = { format: "svt-scene", version: 1, passes: [{ hide: state.hide }] };
    const hash = await hashOf(scene, state, index);
    expect(hash.length).toBeLessThan(8000);
    expect(expanded((await stateOfHash(hash, initialState()))!, index)).toEqual(state);
    // Sets without any order do not fit. The picture matters more than the selection.
    let seed = 1;
    const noise = many.filter(() => (seed = (seed * 48271) % 2147483647) % 2).map(({ id }) => id);
    const noisy = await hashOf(scene, { ...state, selection: noise }, index);
    expect(noisy.length).toBeLessThan(8000);
    expect(expanded((await stateOfHash(noisy, initialState()))!, index)).toEqual({ ...state, selection: [] });
  }, 60_000);

  it("keep a query as it is", () => {
    const state = { ...initialState(), selection: every(2), selectedBy: "volume>20" };
    expect(compacted(state, index).selection).toEqual([]);
    expect(compacted(state, index).selectedBy).toBe("volume>20");
  });
});

describe("colours by value", () => {
  const info = {
    attributes: ["rent", "material"],
    attributeUses: [
      { name: "rent", count: 2, onSpaces: 2, isNumber: true },
      { name: "material", count: 9, onSpaces: 0, isNumber: false },
    ],
  } as unknown as Parameters<typeof colorKeys>[0];
  const keys = colorKeys(info, house, false);
  const start = { ...initialState(), hide: ["class=BuildingUnit", "class=BuildingRoom"] };

  it("are listed with their kind and count", () => {
    expect(keys.own.map(({ key, count }) => [key, count])).toEqual([
      ["class", 5],
      ["name", 0],
      ["storey", null],
      ["volume", 5],
      ["area", 2],
    ]);
    expect(keys.attributes.map(({ key, isNumber, spaces }) => [key, isNumber, spaces])).toEqual([
      ["rent", true, "only"],
      ["material", false, "none"],
    ]);
  });

  it("make rooms solid where these have the values, and leave no trace", () => {
    const colored = { ...start, ...coloredBy(start, "rent", keys, house) };
    expect([colored.show, colored.hide]).toEqual([["class=BuildingRoom"], []]);
    expect(colored.styles).toEqual([{ select: "class=BuildingRoom", opacity: 1 }]);
    const volume = { ...colored, ...coloredBy(colored, "volume", keys, house) };
    expect([volume.colorBy, volume.show, volume.hide]).toEqual(["volume", [], ["class=BuildingUnit"]]);
    const after = { ...volume, ...coloredBy(volume, "", keys, house) };
    expect({ ...after, hide: after.hide.sort() }).toEqual({ ...start, hide: start.hide.sort() });
    expect(coloredBy(start, "material", keys, house)).toEqual({ colorBy: "material", field: null });
  });
});

describe("a choice that cannot be drawn", () => {
  it("leaves no step", () => {
    const history = new History();
    const camera = { eye: [0, 0, 1], target: [0, 0, 0], parallel: false, height: 1, fieldOfView: 30 } as const;
    const start = {
      ...initialState(),
      camera: { ...camera, eye: [0, 0, 1] as [number, number, number], target: [0, 0, 0] as [number, number, number] },
    };
    const hidden = { ...start, hide: ["class=A"] };
    const bad = { ...hidden, colorBy: "nothing" };
    const turned = { ...bad, camera: { ...start.camera, height: 2 } };
    history.record(start, hidden, 0);
    history.record(hidden, bad, 1000);
    history.record(bad, turned, 2000);
    expect(history.refuse(turned)).toEqual({ colorBy: "" });
    expect(history.last).toEqual(["camera"]);
    history.undo(turned);
    expect(history.last).toEqual(["hide"]);
  });
});

describe("the tint of a selection", () => {
  it("keeps classes apart, and selects something in each", () => {
    const styles = tintStyles(house, ['under "flat"', 'under "outer"'], [2, 4, 5, 6], "#ff0000");
    expect(styles.map(({ select }) => select)).toEqual(
      ["BuildingUnit", "BuildingFurniture", "Wall"].map((name) => `((under "flat") or (under "outer")) and class="${name}"`),
    );
    expect(styles[0]!.color).toBe("#c63a3a");
    expect(tintStyles(house, ['under "outer"'], [6], "#ff0000")).toHaveLength(1);
    expect(tintStyles(house, ['under "outer"'], [], "#ff0000")).toEqual([]);
  });
});
