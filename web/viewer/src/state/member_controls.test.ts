import { readdirSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { describe, expect, it } from "vitest";
import { kWorldAxes, type Box } from "../camera/camera";
import { kSceneMembers, type SceneMember } from "../generated/scene_members";
import { help, kGermanHelp, setLanguage, t, withUnit } from "../texts";
import { commandOf } from "./command";
import { ofScene, restored } from "./link";
import { isAllowed, kOtherFirstValues, kRanges, kViews, rangeOfControl } from "./member_controls";
import { sceneOf } from "./scene_of";
import { initialState, type Camera } from "./view_state";

const box: Box = { low: [0, 0, 0], high: [12, 10, 6], axes: kWorldAxes };
const declaredOf = (name: SceneMember): Record<string, unknown> => kSceneMembers[name];
const controls = Object.keys(kRanges) as (keyof typeof kRanges)[];

/** The values of a scene by the names of its members. */
function valuesOf(value: unknown, name = ""): [string, unknown][] {
  if (Array.isArray(value) && value.some((item) => typeof item === "object")) return value.flatMap((item) => valuesOf(item, `${name}/*`));
  if (typeof value !== "object" || value === null || Array.isArray(value)) return [[name, value]];
  return Object.entries(value).flatMap(([key, member]) => valuesOf(member, `${name}/${key}`));
}

describe("controls of scene members", () => {
  it("have ranges within the declared ones", () => {
    for (const control of controls) {
      const { minimum, maximum, step } = rangeOfControl(control);
      expect(isAllowed(kRanges[control].member, minimum), control).toBe(true);
      expect(isAllowed(kRanges[control].member, maximum), control).toBe(true);
      expect(step, control).toBeGreaterThan(0);
      expect(step, control).toBeLessThan(maximum - minimum);
    }
  });

  it("have the declared range where the page does not narrow it", () => {
    const narrowed = controls.filter((control) => {
      const { minimum, maximum } = rangeOfControl(control),
        declared = kSceneMembers[kRanges[control].member];
      return minimum !== declared.minimum || maximum !== declared.maximum;
    });
    expect(narrowed).toEqual(["fieldOfView", "latitude"]);
    expect(rangeOfControl("opacity")).toEqual({ minimum: 0, maximum: 1, step: 0.01 });
  });

  it("step in whole numbers where the member is whole, and reach its default", () => {
    for (const control of controls) {
      const { type, default: first } = declaredOf(kRanges[control].member);
      const { minimum, maximum, step } = rangeOfControl(control);
      if (type === "whole") expect(Number.isInteger(step), control).toBe(true);
      for (const value of [first ?? []].flat() as number[]) expect(value >= minimum && value <= maximum, control).toBe(true);
    }
  });

  it("offer declared views, each once", () => {
    const declared: readonly string[] = kSceneMembers["/camera/preset"].choices;
    expect(kViews.filter((view) => !declared.includes(view))).toEqual([]);
    expect(new Set(kViews).size).toBe(kViews.length);
  });

  it("begin with the declared default, except these", () => {
    expect(Object.keys(kOtherFirstValues)).toEqual(["pictureSize", "walkingFieldOfView"]);
    for (const { member, value } of Object.values(kOtherFirstValues)) {
      expect(value).not.toEqual(kSceneMembers[member].default);
      for (const one of [value].flat()) expect(isAllowed(member, one), member).toBe(true);
    }
  });

  // Those of the lens, the margin of a cutaway and the place of a plane stand for no member: they end in regions, or in
  // passes that the library makes. Those of a comparison are its tolerance, and a share that ends in two styles.
  it("are all sliders and number fields, except those that stand for no member", () => {
    const folder = fileURLToPath(new URL("..", import.meta.url));
    const sources = readdirSync(folder, { recursive: true, encoding: "utf8" })
      .filter((name) => name.endsWith(".ts") && !name.endsWith(".test.ts"))
      .map((name) => ({ name, text: readFileSync(folder + name, "utf8") }));
    const numeric = sources.filter(({ text }) => /<wa-slider|<input type="(number|range)"/.test(text));
    const own = numeric.filter(({ text }) => !text.includes("rangeOfControl("));
    expect(own.map(({ name }) => name).sort()).toEqual([
      "basemap/basemap_choice.ts",
      "comparing/changes_panel.ts",
      "tools/focus_tool.ts",
      "tools/lens_tool.ts",
      "tools/section_tool.ts",
    ]);
  });
});

describe("a view that nobody has changed", () => {
  const described = sceneOf(initialState(), box, [640, 360]);

  it("says nothing in its scene but defaults", () => {
    const values = valuesOf(described.scene).filter(([name]) => !["/format", "/version", "/size", "/passes/*"].includes(name));
    expect(values).toEqual((["/samples", "/camera/preset"] as const).map((name) => [name, kSceneMembers[name].default]));
  });

  it("needs no options as a command", () => {
    expect(commandOf(initialState(), described, { files: ["house.svt"], owners: "", address: "" })).toBe(
      "svt render house.svt -o view.png --size 640x360",
    );
    const camera = {
      preset: kSceneMembers["/camera/preset"].default,
      fieldOfView: kSceneMembers["/camera/fieldOfView"].default,
      zoom: kSceneMembers["/camera/zoom"].default,
    };
    const edges = { ...initialState(), wireframe: kSceneMembers["/passes/*/lines/*/hidden"].default };
    expect(commandOf(edges, { scene: { camera }, effects: {} }, { files: ["house.svt"], owners: "", address: "" })).toBe(
      "svt render house.svt -o view.png --size 1280x720 --wireframe",
    );
  });

  it("has the declared angle of view where a scene gives none", () => {
    const scene = { camera: { eye: [1, 2, 3] as [number, number, number], target: [0, 0, 0] as [number, number, number] } };
    expect(ofScene(scene, initialState()).camera!.fieldOfView).toBe(kSceneMembers["/camera/fieldOfView"].default);
  });
});

describe("links", () => {
  it("bring no angle of view that a scene may not have", () => {
    const { minimum, maximum } = kSceneMembers["/camera/fieldOfView"];
    const linked = (fieldOfView: number) => {
      const camera: Camera = { eye: [1, 2, 3], target: [0, 0, 0], parallel: false, height: 1, fieldOfView };
      return restored({ camera }).camera?.fieldOfView;
    };
    for (const fieldOfView of [minimum, 30, maximum]) expect(linked(fieldOfView)).toBe(fieldOfView);
    for (const fieldOfView of [0, minimum / 2, (maximum + 180) / 2, NaN]) expect(linked(fieldOfView)).toBeUndefined();
  });
});

describe("texts of scene members", () => {
  it("name each choice in both languages", () => {
    const texts = () => [
      ...kSceneMembers["/look"].choices.map((look) => t(`look_${look}`)),
      ...kSceneMembers["/passes/*/shell"].choices.map((level) => t(`shell_${level}`)),
      ...kSceneMembers["/passes/*/lines/*/hidden"].choices.map((hidden) => t(`wireframe_${hidden}`)),
      ...kViews.map((view) => t(`view_${view}`)),
    ];
    for (const language of ["de", "en"] as const) {
      setLanguage(language);
      expect(new Set(texts()).size).toBe(texts().length);
    }
  });

  it("translate help that is declared as it stands there", () => {
    const declared = new Set<string>(Object.values(kSceneMembers).map((member) => member.help));
    expect(Object.keys(kGermanHelp).filter((text) => !declared.has(text))).toEqual([]);
  });

  it("say what a control does, with its unit", () => {
    expect(help("/camera/fieldOfView")).toBe("Vertical field of view (°)");
    expect(help("/size")).toBe("Width and height (px)");
    setLanguage("de");
    expect(help("/camera/parallel")).toBe("Parallelprojektion");
    setLanguage("en");
    expect(withUnit(30, 0, kSceneMembers["/camera/fieldOfView"].unit)).toBe("30°");
    expect(withUnit(1.5, 1, "metres")).toBe("1.5 m");
  });
});
