import { describe, expect, it } from "vitest";
import { kWorldAxes, type Box } from "../camera/camera";
import type { Feature } from "../engine";
import { loadBookmarks, saveBookmarks } from "./bookmarks";
import { commandOf, embeddingOf, shellWord, type Inputs } from "./command";
import { indexFeatures, ownerOf } from "./feature_index";
import { hashOf, ofScene, packed, restored, stateOfHash, unpacked } from "./link";
import { ofId, parseOwn, quoted } from "./queries";
import { cutOf, focusQueries, regionOf, sceneOf } from "./scene_of";
import { initialState, withStyle, type Section, type ViewState } from "./view_state";
import { hiddenFlags, hideQueries, SeenCounts, subtree, switched } from "./visibility";

const box: Box = { low: [0, 0, 0], high: [12, 10, 6], axes: kWorldAxes };
const size: [number, number] = [640, 360];
const given: Inputs = { files: ["house.svt"], owners: "", address: "" };
const section = (change: Partial<Section>): Section => ({ axis: "z", at: 1.6, flip: false, turn: 0, tilt: 0, ...change });
const state = (change: Partial<ViewState>): ViewState => ({ ...initialState(), ...change });

describe("queries", () => {
  it("quotes whatever stands in an id, and reads it back", () => {
    for (const id of ["plain", 'with "quotes"', "back\\slash", "a and b", ""])
      expect(parseOwn(ofId(id))).toEqual({ kind: "id", value: id });
    expect(quoted('a"b')).toBe('"a\\"b"');
    expect(parseOwn("volume>20")).toBeNull();
    expect(parseOwn("class=A or class=B")).toBeNull();
  });
});

describe("scene of the state", () => {
  it("is plain where nothing is set", () => {
    expect(sceneOf(initialState(), box, size)).toEqual({
      scene: { format: "svt-scene", version: 1, size, samples: 4, camera: { preset: "iso" }, passes: [{}] },
      effects: {},
    });
  });

  it("writes planes as regions", () => {
    expect(regionOf(section({}))).toBe("z>1.6");
    expect(regionOf(section({ axis: "y", at: 5, flip: true }))).toBe("y<5");
    expect(regionOf(section({ axis: "free", at: 2, turn: 90 }))).toBe("0,1,0,-2");
    expect(regionOf(section({ axis: "free", at: 2, turn: 90, flip: true }))).toBe("0,-1,0,2");
    expect(cutOf([section({}), section({ axis: "x", at: 3 })])).toBe("z>1.6 or x>3");
  });

  it("cuts regions besides planes, and names features besides the selection", () => {
    const both = state({ sections: [section({})], regions: ["ball(1,2,3,4)"], named: ["class=Room"], names: true, selection: ["a"] });
    const { scene } = sceneOf(both, box, size);
    expect(scene.passes).toEqual([{ cut: "z>1.6 or ball(1,2,3,4)" }]);
    expect(scene.names).toEqual(["class=Room", 'id="a"']);
    expect(sceneOf({ ...both, effect: "lens" }, box, size).effects.lens!.cut).toBe("z>1.6 or ball(1,2,3,4)");
    expect(commandOf(both, sceneOf(both, box, size), given)).toContain(
      "--names class=Room --names 'id=\"a\"' --section 'z>1.6' --cut 'ball(1,2,3,4)'",
    );
  });

  it("cuts everywhere, or within the lens alone", () => {
    const cut = state({ sections: [section({})] });
    expect(sceneOf(cut, box, size).scene.passes).toEqual([{ cut: "z>1.6" }]);
    const lens = sceneOf({ ...cut, effect: "lens" }, box, size);
    expect(lens.scene.passes).toEqual([{}]);
    expect(lens.effects).toEqual({ lens: { region: "view(0.5,0.5,0.25)", cut: "z>1.6", context: "ghost" } });
    expect(sceneOf(state({ effect: "lens" }), box, size).effects.lens!.cut).toBe("y<5");
  });

  it("highlights the selection where no query is given", () => {
    const selected = state({ selection: ["a", "b"], effect: "highlight" });
    expect(sceneOf(selected, box, size).effects).toEqual({ highlight: { queries: ['under "a"', 'under "b"'], context: "ghost" } });
    expect(focusQueries({ ...selected, focus: { ...selected.focus, query: "class=Door" } })).toEqual(["class=Door"]);
    expect(sceneOf(state({ effect: "highlight" }), box, size).effects).toEqual({});
    expect(sceneOf({ ...selected, effect: "cutaway" }, box, size).effects).toEqual({
      cutaway: { query: 'under "a" or under "b"', margin: 0.15 },
    });
  });

  it("colours by an attribute and draws what a plan needs", () => {
    const shown = state({ colorBy: "storey", picture: { scaleBar: true, northArrow: true } });
    const { scene } = sceneOf(shown, box, size);
    expect(scene.colorBy).toBe("storey");
    expect(scene.northArrow).toBe(true);
    expect(scene.scaleBar, "in perspective there is no one scale").toBeUndefined();
    const parallel = { ...shown, camera: { eye: [1, 2, 50], target: [1, 2, 0], fieldOfView: 30, parallel: true, height: 10 } } as ViewState;
    expect(sceneOf(parallel, box, size).scene.scaleBar).toBe(true);
    expect(commandOf(shown, sceneOf(shown, box, size), given)).toContain("--north-arrow --color-by storey");
  });

  it("names the selection, draws lines and hulls, hatches or not", () => {
    const { scene } = sceneOf(
      state({ selection: ["a"], names: true, wireframe: "dashed", shell: "room", hatches: false, look: "paper" }),
      box,
      size,
    );
    expect(scene.names).toEqual(['id="a"']);
    expect(scene.passes).toEqual([{ lines: [{ hidden: "dashed" }], shell: "room" }]);
    expect(scene.hatches).toEqual({ show: false });
    expect(scene.look).toBe("paper");
  });

  it("rounds the camera to tenths of a millimetre", () => {
    const camera = {
      eye: [1.23456789, 2, 3] as [number, number, number],
      target: [0, 0, -0.00001] as [number, number, number],
      parallel: false,
      height: 1,
      fieldOfView: 30,
    };
    expect(sceneOf(state({ camera }), box, size).scene.camera).toEqual({
      preset: "iso",
      eye: [1.2346, 2, 3],
      target: [0, 0, 0],
      fieldOfView: 30,
    });
  });

  it("looks straight down as the preset does", () => {
    const camera = {
      eye: [6, 5, 20] as [number, number, number],
      target: [6, 5, 3] as [number, number, number],
      parallel: true,
      height: 10 / 0.88,
      fieldOfView: 30,
    };
    const scene = sceneOf(state({ camera }), box, size).scene.camera!;
    expect(scene.preset).toBe("top");
    expect(scene.zoom).toBeCloseTo(1, 5);
  });

  it("leaves the passes of a scene that was written by hand", () => {
    const custom = { passes: [{ show: ["all"] }, { keep: "ball(1,2,3,1)" }], background: "#fff" };
    const { scene, effects } = sceneOf(state({ custom, sections: [section({})], effect: "lens" }), box, size);
    expect(scene.passes).toEqual(custom.passes);
    expect(scene.background).toBe("#fff");
    expect(effects).toEqual({});
  });
});

describe("styles", () => {
  it("change, add up and vanish", () => {
    let styles = withStyle([], "class=A", { color: "#ff0000" });
    styles = withStyle(styles, "class=A", { opacity: 0.5 });
    expect(styles).toEqual([{ select: "class=A", color: "#ff0000", opacity: 0.5 }]);
    const none = { color: undefined, opacity: undefined } as unknown as { color: string };
    expect(withStyle(styles, "class=A", none)).toEqual([]);
  });
});

const feature = (id: string, parent: string, className = "Wall", count = 1, first = 0): Feature => ({
  id,
  parent,
  class: className,
  name: "",
  depth: 0,
  first,
  count,
  color: "#fff",
  opacity: 1,
});
const house = indexFeatures([
  feature("house", "", "Building", 0),
  feature("s0", "house", "Storey", 0),
  feature("w0", "s0", "Wall", 1, 1),
  feature("r0", "s0", "Room", 2, 2),
  feature("s1", "house", "Storey", 0),
  feature("w1", "s1", "Wall", 1, 4),
  feature("r1", "s1", "Room", 1, 5),
]);

describe("feature index", () => {
  it("puts what belongs together in one stretch, whatever the order of the file", () => {
    const index = indexFeatures([feature("a", ""), feature("b", ""), feature("a1", "a"), feature("b1", "b"), feature("a2", "a")]);
    expect(index.features.map((f) => f.id)).toEqual(["a", "a1", "a2", "b", "b1"]);
    expect([...index.end]).toEqual([3, 2, 3, 5, 5]);
    expect([...index.depth]).toEqual([0, 1, 1, 0, 1]);
  });

  it("finds owners of scalars", () => {
    expect([0, 1, 2, 3, 4, 5, 6].map((s) => house.features[ownerOf(house, s)]?.id)).toEqual([
      undefined,
      "w0",
      "r0",
      "r0",
      "w1",
      "r1",
      undefined,
    ]);
  });

  it("survives parents that come later, or are missing", () => {
    const index = indexFeatures([feature("b", "a"), feature("a", "b"), feature("c", "nowhere")]);
    expect(index.features.length).toBe(3);
  });
});

describe("visibility", () => {
  const hide = (...ids: string[]) => {
    const flags = new Uint8Array(house.features.length);
    for (const id of ids) flags[house.byId.get(id)!] = 1;
    return flags;
  };

  it("says it in the fewest queries", () => {
    expect(hideQueries(house, hide("w0"))).toEqual(['id="w0"']);
    expect(hideQueries(house, hide("w0", "r0"))).toEqual(['under "s0"']);
    expect(hideQueries(house, hide("w0", "w1"))).toEqual(["class=Wall"]);
    expect(hideQueries(house, hide("w0", "r0", "w1"))).toHaveLength(2);
    expect(hideQueries(house, hide("w0", "r0", "w1", "r1"))).toEqual(["all"]);
    expect(hideQueries(house, hide(), ["volume>20"])).toEqual(["volume>20"]);
  });

  it("reads back what it says", () => {
    for (let bits = 0; bits < 16; ++bits) {
      const ids = ["w0", "r0", "w1", "r1"].filter((_, i) => (bits >> i) & 1);
      const flags = hiddenFlags(house, hideQueries(house, hide(...ids)));
      expect(["w0", "r0", "w1", "r1"].filter((id) => flags[house.byId.get(id)!])).toEqual(ids);
    }
  });

  it("counts what is seen", () => {
    const counts = new SeenCounts(house, switched(hide(), subtree(house, 1), true));
    expect(counts.ofSubtree(0)).toBe("some");
    expect(counts.ofSubtree(1)).toBe("none");
    expect(counts.ofSubtree(4)).toBe("all");
    expect(counts.ofMembers(house.classes.get("Wall")!)).toBe("some");
    expect(counts.hiddenSolids).toBe(2);
  });

  it("needs little processor time for 100,000 features", () => {
    const many = Array.from({ length: 100_000 }, (_, i) =>
      feature(`f${i}`, i === 0 ? "" : i % 100 === 1 ? "f0" : `f${i - ((i - 1) % 100)}`, `C${i % 50}`, 1, i + 1),
    );
    const start = process.cpuUsage();
    const index = indexFeatures(many);
    const flags = new Uint8Array(many.length).map((_, i) => (i % 3 ? 1 : 0));
    expect(hiddenFlags(index, hideQueries(index, flags))).toEqual(flags);
    // 0.3 s; what compares each with each needs minutes.
    expect(process.cpuUsage(start).user / 1e6).toBeLessThan(20);
  });
});

describe("links", () => {
  const shown = state({
    camera: { eye: [1, 2, 3], target: [4, 5, 6], parallel: true, height: 7, fieldOfView: 30 },
    look: "blueprint",
    hide: ["class=Room"],
    sections: [section({ axis: "free", turn: 30, tilt: 10 })],
    effect: "lens",
    selection: ["a"],
    shell: "storey",
    styles: [{ select: 'id="Ü"', color: "#ff0000" }],
  });

  it("come back as they were", async () => {
    const { scene } = sceneOf(shown, box, size);
    const hash = await hashOf(scene, shown);
    expect(hash).toMatch(/^#scene=[\w-]+&view=[\w-]+$/);
    expect(await stateOfHash(hash, initialState())).toEqual(shown);
    expect(await unpacked(new URLSearchParams(hash.slice(1)).get("scene")!)).toEqual(scene);
  });

  it("with a scene alone draw that scene", async () => {
    const scene = {
      look: "paper" as const,
      camera: { eye: [1, 2, 3] as [number, number, number], target: [0, 0, 0] as [number, number, number] },
      passes: [{ cut: "z>1" }],
    };
    const found = await stateOfHash(`#scene=${await packed(scene)}`, initialState());
    expect(found).toEqual(ofScene(scene, initialState()));
    expect(sceneOf(found!, box, size).scene.passes).toEqual(scene.passes);
  });

  it("that are damaged are refused, those of the wrong kind do no harm", async () => {
    await expect(stateOfHash("#view=@@@", initialState())).rejects.toBeDefined();
    await expect(stateOfHash("#view=AAAA", initialState())).rejects.toBeDefined();
    expect(await stateOfHash("", initialState())).toBeNull();
    expect(await stateOfHash("#other=1", initialState())).toBeNull();
    const wrong = { hide: "all", camera: { eye: [1, 2] }, lens: 5, sections: [3], effect: 7, selection: [1], styles: null, custom: "x" };
    expect(restored(wrong)).toEqual(initialState());
    expect(restored(null)).toEqual(initialState());
  });

  it("are not unpacked without bound", async () => {
    await expect(unpacked(await packed("x".repeat(5 << 20)))).rejects.toBeDefined();
  });
});

describe("bookmarks", () => {
  it("are kept per model and survive a broken store", () => {
    const map = new Map<string, string>();
    const store = {
      getItem: (k: string) => map.get(k) ?? null,
      setItem: (k: string, v: string) => void map.set(k, v),
    } as unknown as Storage;
    const shown = state({ look: "dark" });
    expect(saveBookmarks("a.svt", [{ name: "One", state: shown }], store)).toBe(true);
    expect(loadBookmarks("a.svt", store)).toEqual([{ name: "One", state: shown }]);
    expect(loadBookmarks("b.svt", store)).toEqual([]);
    map.set("svt-bookmarks:a.svt", "{broken");
    expect(loadBookmarks("a.svt", store)).toEqual([]);
    const full = {
      getItem: () => null,
      setItem: () => {
        throw new Error("full");
      },
    } as unknown as Storage;
    expect(saveBookmarks("a.svt", [], full)).toBe(false);
  });
});

describe("command", () => {
  it("quotes for the shell", () => {
    expect(shellWord("a/b.svt")).toBe("a/b.svt");
    expect(shellWord("y<5")).toBe("'y<5'");
    expect(shellWord("it's")).toBe("'it'\\''s'");
  });

  it("says the view in options", () => {
    const shown = state({ hide: ["class=Room"], sections: [section({ axis: "y", at: 5, flip: true })], look: "paper" });
    expect(commandOf(shown, sceneOf(shown, box, size), given)).toBe(
      "svt render house.svt -o view.png --size 640x360 --look paper --hide class=Room --section 'y<5'",
    );
  });

  it("takes a scene file where options cannot say it", () => {
    const shown = state({ hatches: false });
    expect(commandOf(shown, sceneOf(shown, box, size), given)).toBe("svt render house.svt -o view.png --scene view.scene.json");
  });

  it("fetches a model that the reader has not", () => {
    const fetched = { ...given, address: "https://example.org/a b/models/house.svt" };
    expect(commandOf(initialState(), sceneOf(initialState(), box, size), fetched)).toBe(
      "curl -fLo house.svt 'https://example.org/a b/models/house.svt' && svt render house.svt -o view.png --size 640x360",
    );
  });

  it("names all that the user has opened", () => {
    const command = (inputs: Partial<Inputs>) => commandOf(initialState(), sceneOf(initialState(), box, size), { ...given, ...inputs });
    expect(command({ files: ["a.ifc", "b.ifc"] })).toBe(
      "svt build a.ifc b.ifc -o model.svt --vectors edges,meshes && svt render model.svt -o view.png --size 640x360",
    );
    expect(command({ files: ["a.svt", "b.svt"], owners: "parcels.csv" })).toBe(
      "svt render a.svt -o view.png --size 640x360 --with b.svt --owners parcels.csv",
    );
  });

  it("embeds a view whatever it is called", () => {
    expect(embeddingOf('https://example.org/?model=a&b#view="', 'A "house"', [640, 360])).toBe(
      '<iframe src="https://example.org/?model=a&amp;b#view=&quot;" title="A &quot;house&quot;" width="640" height="360" style="border: 0" loading="lazy" allow="fullscreen"></iframe>',
    );
  });
});
