import { describe, expect, it } from "vitest";
import { initialState } from "../state/view_state";
import { sceneOf } from "../state/scene_of";
import { cutsOf, listOf, numbersOf } from "./attribute_text";
import { changesOf, givenBy, hasOtherCamera, type Given } from "./attributes";

const box = {
  low: [0, 0, 0] as [number, number, number],
  high: [12, 10, 6] as [number, number, number],
  axes: [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ] as [[number, number, number], [number, number, number], [number, number, number]],
};
const given = (attributes: Record<string, string>): Given => givenBy((name) => attributes[name] ?? null, "plain");
const described = (attributes: Record<string, string>) => {
  const { view, camera } = given(attributes);
  return sceneOf({ ...initialState(), ...view, camera }, box, [640, 360]);
};
const passOf = (attributes: Record<string, string>) => described(attributes).scene.passes![0];

describe("texts", () => {
  it("are exactly so many numbers", () => {
    expect(numbersOf(" 1, -2.5,3e1", 3)).toEqual([1, -2.5, 30]);
    for (const text of ["", "1,2", "1,2,x", "1,,3", "1,2,3,4", "1,2,1e999", "0x1,2,3"]) expect(numbersOf(text, 3), text).toBeNull();
  });

  it("are lists, whose semicolons in quotes separate nothing", () => {
    expect(listOf('class=A:red; name="a;b:c":blue ;; ')).toEqual(["class=A:red", 'name="a;b:c":blue']);
    expect(listOf("")).toEqual([]);
  });

  it("are planes with handles, storeys, or else one region", () => {
    const [z, y] = [
      { axis: "z", at: 1.2, flip: true, turn: 0, tilt: 90 },
      { axis: "y", at: 3, flip: false, turn: 0, tilt: 0 },
    ];
    expect(cutsOf("z<1.2 or y>3")).toEqual({ sections: [z, y], regions: [] });
    expect(cutsOf("z<1.2 or storey=Attic+1")).toEqual({ sections: [z], regions: ["storey=Attic+1"] });
    expect(cutsOf("storey=Upper floor+1.2")).toEqual({ sections: [], regions: ["'storey=Upper floor+1.2'"] });
    expect(cutsOf("")).toEqual({ sections: [], regions: [] });
    for (const text of ["z<1.2 and y>3", "not z<1", 'storey="Upper floor"+1', "storey=Attic and z<3", "ball(1,2,3,4)", "z<", "0,0,0,1"])
      expect(cutsOf(text), text).toEqual({ sections: [], regions: [text] });
  });
});

describe("attributes", () => {
  it("without a value leave the view as it is at first", () => {
    const { view, camera, problems } = given({});
    expect({ ...initialState(), ...view, camera }).toEqual(initialState());
    expect(problems).toEqual([]);
  });

  it("cut like the options of the command", () => {
    expect(passOf({ section: "z<1.2 or y>3" })!.cut).toBe("z<1.2 or y>3");
    expect(passOf({ section: "z=1.2" })!.cut).toBe("z>1.2");
    expect(passOf({ section: "storey=Attic+1.1", cut: "ball(1,2,3,4)" })!.cut).toBe("storey=Attic+1.1 or ball(1,2,3,4)");
    expect(passOf({ section: "3,4,0,-10" })!.cut).toBe("0.6,0.8,0,-2");
    expect(passOf({ section: "0,0,-2,5" })!.cut).toBe("0,0,-1,2.5");
  });

  it("select by one query each", () => {
    expect(passOf({ hide: "class=A or class=B", show: "all" })).toEqual({ hide: ["class=A or class=B"], show: ["all"] });
    expect(described({ names: "class=BuildingRoom" }).scene.names).toEqual(["class=BuildingRoom"]);
    expect(described({ "color-by": "storey" }).scene.colorBy).toBe("storey");
  });

  it("style by lists of a query and a value, which may have colons", () => {
    expect(passOf({ color: "class=bldg:Window:#3388ff; class=Door:red", opacity: "class=Door:0.4" })!.styles).toEqual([
      { select: "class=bldg:Window", color: "#3388ff" },
      { select: "class=Door", color: "red", opacity: 0.4 },
    ]);
  });

  it("have one effect, and report the second", () => {
    expect(described({ highlight: "class=Window", context: "shell" }).effects).toEqual({
      highlight: { queries: ["class=Window"], context: "shell" },
    });
    expect(described({ cutaway: "class=Beam" }).effects).toEqual({ cutaway: { query: "class=Beam", margin: 0.15 } });
    const lens = { lens: "view(0.4, 0.5, 0.2)", section: "y<5", highlight: "all" };
    expect(described(lens).effects).toEqual({ lens: { region: "view(0.4,0.5,0.2)", cut: "y<5", context: "ghost" } });
    expect(given(lens).problems).toEqual(['highlight="all": it excludes lens; give one of them']);
  });

  it("draw lines, hatches and annotations", () => {
    expect(passOf({ wireframe: "" })!.lines).toEqual([{ hidden: "faint" }]);
    expect(passOf({ wireframe: "", "hidden-lines": "dashed" })!.lines).toEqual([{ hidden: "dashed" }]);
    expect(passOf({ "hidden-lines": "dashed" })!.lines).toBeUndefined();
    expect(described({ hatch: "" }).scene.hatches).toEqual({ show: true });
    expect(described({ hatch: "off" }).scene.hatches).toEqual({ show: false });
    const { scene } = described({ "north-arrow": "", transparent: "", background: "#eee", look: "paper" });
    expect(scene).toMatchObject({ northArrow: true, transparent: true, background: "#eee", look: "paper" });
  });

  it("place the camera, or fit it", () => {
    const placed = given({ eye: "8,-6,9", target: "6,5,2", fov: "40" });
    expect(placed.camera).toMatchObject({ eye: [8, -6, 9], target: [6, 5, 2], parallel: false, fieldOfView: 40 });
    expect(given({ eye: "8,-6,9", target: "6,5,2", ortho: "" }).camera!.parallel).toBe(true);
    const fitted = given({ camera: "top", ortho: "", around: "class=Door" });
    expect([fitted.camera, fitted.view.preset, fitted.framing]).toEqual([
      null,
      "top",
      { around: "class=Door", parallel: true, fieldOfView: 30 },
    ]);
  });

  it("that cannot be used are reported, and have no effect", () => {
    const bad = {
      camera: "above",
      look: "fancy",
      context: "fog",
      shell: "wing",
      eye: "1,2",
      fov: "180",
      color: "class=A",
      opacity: "class=A:2",
      lens: "ball(1,2,3,4)",
    };
    const { view, camera, framing, problems } = given(bad);
    expect(problems.map((problem) => problem.replace(/=.*/, "")).sort()).toEqual(Object.keys(bad).sort());
    expect(view).toEqual(given({}).view);
    expect([camera, framing]).toEqual([null, given({}).framing]);
    expect(given({ eye: "1,2,3" }).problems).toEqual(['eye="1,2,3": it needs target, too']);
  });

  it("change only the members that they concern", () => {
    const [before, after] = [given({ section: "z<1" }), given({ section: "z<2", look: "dark" })];
    expect(Object.keys(changesOf(before.view, after.view)).sort()).toEqual(["look", "sections"]);
    expect(hasOtherCamera(before, after)).toBe(false);
    expect(hasOtherCamera(before, given({ camera: "top" }))).toBe(true);
    expect(hasOtherCamera(before, given({ eye: "1,2,3", target: "0,0,0" }))).toBe(true);
  });
});
