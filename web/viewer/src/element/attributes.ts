/**
 * Attributes of `<svt-viewer>` as members of the view. They have the names and the grammar of the options of `svt render`.
 * Invalid attributes are reported, and have no effect.
 */

import { withProjection } from "../camera/camera";
import type { Point, SceneStyle } from "../engine";
import { kSceneMembers, type ChoiceOf, type SceneMemberWith } from "../generated/scene_members";
import type { Framing } from "../session/view";
import { isAllowed } from "../state/member_controls";
import { initialState, withMember, withStyle, type Camera, type Effect, type Lens, type ViewState } from "../state/view_state";
import { cutsOf, listOf, numbersOf } from "./attribute_text";

/** The text of an attribute; null: it is absent. */
export type Attributes = (name: string) => string | null;

/** The members of the view that attributes determine. */
export type GivenView = Omit<ViewState, "camera" | "names" | "sun" | "field" | "selection" | "selectedBy" | "measured" | "custom">;

export interface Given {
  view: GivenView;
  /** The camera by `eye` and `target`; null: the view of `camera` is fitted as `framing` states. */
  camera: Camera | null;
  framing: Framing;
  /** One sentence for each attribute that cannot be used. */
  problems: string[];
}

const kContexts = ["ghost", "solid", "shell", "none"] as const;

/** Reads attributes, and notes those that cannot be used. */
class Reader {
  readonly problems: string[] = [];

  constructor(private readonly attributes: Attributes) {}

  text(name: string): string {
    return this.attributes(name)?.trim() ?? "";
  }

  /** A list of one query; empty without the attribute. */
  queries(name: string): string[] {
    const text = this.text(name);
    return text ? [text] : [];
  }

  flag(name: string): boolean {
    const text = this.attributes(name);
    return text !== null && text !== "off" && text !== "false";
  }

  fail(name: string, reason: string): void {
    this.problems.push(`${name}="${this.text(name)}": ${reason}`);
  }

  choice<Choice extends string>(name: string, choices: readonly Choice[]): Choice | null {
    const text = this.text(name);
    const found = choices.find((choice) => choice === text) ?? null;
    if (text && found === null) this.fail(name, `use one of ${choices.join(", ")}`);
    return found;
  }

  point(name: string): Point | null {
    const text = this.text(name);
    const found = numbersOf(text, 3);
    if (text && !found) this.fail(name, 'use three numbers, such as "8,-6,9"');
    return found as Point | null;
  }

  number(name: string, member: SceneMemberWith<"minimum" | "maximum">): number | null {
    const text = this.text(name);
    const [found] = numbersOf(text, 1) ?? [];
    if (found !== undefined && isAllowed(member, found)) return found;
    const { minimum, maximum } = kSceneMembers[member];
    if (text) this.fail(name, `use a number from ${minimum} to ${maximum}`);
    return null;
  }
}

export function givenBy(attributes: Attributes, look: ChoiceOf<"/look">): Given {
  const reader = new Reader(attributes);
  const effect = effectOf(reader);
  const view: GivenView = {
    preset: reader.choice("camera", kSceneMembers["/camera/preset"].choices) ?? kSceneMembers["/camera/preset"].default,
    look: reader.choice("look", kSceneMembers["/look"].choices) ?? look,
    hide: reader.queries("hide"),
    show: reader.queries("show"),
    styles: stylesOf(reader),
    ...cutOf(reader),
    hatches: attributes("hatch") === null ? null : reader.flag("hatch"),
    ...effect,
    shell: reader.choice("shell", kSceneMembers["/passes/*/shell"].choices),
    surfaces: reader.choice("surfaces", kSceneMembers["/surfaces"].choices),
    wireframe: linesOf(reader),
    named: reader.queries("names"),
    colorBy: reader.text("color-by"),
    picture: pictureOf(reader),
  };
  const framing = framingOf(reader);
  return { view, framing, camera: cameraOf(reader, framing), problems: reader.problems };
}

function cutOf(reader: Reader): Pick<GivenView, "sections" | "regions"> {
  const { sections, regions } = cutsOf(reader.text("section"));
  return { sections, regions: [...regions, ...reader.queries("cut")] };
}

function effectOf(reader: Reader): Pick<GivenView, "effect" | "lens" | "focus"> {
  const { lens, focus } = initialState();
  const context = reader.choice("context", kContexts) ?? "ghost";
  const given = (["lens", "highlight", "cutaway"] as const).filter((name) => reader.text(name));
  if (given.length > 1) reader.fail(given[1]!, `it excludes ${given[0]}; give one of them`);
  const effect: Effect = given[0] ?? "none";
  const circle = effect === "lens" ? lensOf(reader) : null;
  return {
    effect: effect === "lens" && !circle ? "none" : effect,
    lens: { ...lens, ...circle, pinned: circle !== null, context },
    focus: { ...focus, query: effect === "highlight" || effect === "cutaway" ? reader.text(effect) : "", context },
  };
}

function lensOf(reader: Reader): Pick<Lens, "x" | "y" | "radius"> | null {
  const [, inside = ""] = /^view\((.*)\)$/.exec(reader.text("lens")) ?? [];
  const [x, y, radius] = numbersOf(inside, 3) ?? [];
  if (x !== undefined && y !== undefined && radius !== undefined) return { x, y, radius };
  reader.fail("lens", 'use a circle of the picture, such as "view(0.5,0.5,0.3)"');
  return null;
}

/** The styles of `color` and `opacity`: lists of QUERY:VALUE. */
function stylesOf(reader: Reader): SceneStyle[] {
  let styles: SceneStyle[] = [];
  for (const name of ["color", "opacity"] as const)
    for (const entry of listOf(reader.text(name))) {
      const colon = entry.lastIndexOf(":");
      const [query, value] = [entry.slice(0, colon).trim(), entry.slice(colon + 1).trim()];
      const opacity = numbersOf(value, 1)?.[0];
      const isNumber = opacity !== undefined && isAllowed("/passes/*/styles/*/opacity", opacity);
      if (colon < 1 || !value || (name === "opacity" && !isNumber))
        reader.fail(name, `use a query and a ${name}, such as "class=Window:${name === "color" ? "#3388ff" : "0.4"}"`);
      else styles = withStyle(styles, query, name === "color" ? { color: value } : { opacity: opacity! });
    }
  return styles;
}

function linesOf(reader: Reader): GivenView["wireframe"] {
  const hidden = reader.choice("hidden-lines", kSceneMembers["/passes/*/lines/*/hidden"].choices);
  return reader.flag("wireframe") ? (hidden ?? kSceneMembers["/passes/*/lines/*/hidden"].default) : null;
}

function pictureOf(reader: Reader): GivenView["picture"] {
  let picture = withMember({}, "/background", reader.text("background"));
  picture = withMember(picture, "/transparent", reader.flag("transparent"));
  picture = withMember(picture, "/scaleBar", reader.flag("scale-bar"));
  return withMember(picture, "/northArrow", reader.flag("north-arrow"));
}

function framingOf(reader: Reader): Framing {
  const fieldOfView = reader.number("fov", "/camera/fieldOfView") ?? kSceneMembers["/camera/fieldOfView"].default;
  return { around: reader.text("around"), parallel: reader.flag("ortho"), fieldOfView };
}

function cameraOf(reader: Reader, { parallel, fieldOfView }: Framing): Camera | null {
  const eye = reader.point("eye"),
    target = reader.point("target");
  if (!reader.text("eye") && !reader.text("target")) return null;
  if (!eye || !target) {
    const [given, missing] = eye ? ["eye", "target"] : ["target", "eye"];
    if (!reader.text(missing!)) reader.fail(given!, `it needs ${missing}, too`);
    return null;
  }
  return withProjection({ eye, target, parallel: false, height: 10, fieldOfView }, parallel);
}

/** The members that differ. */
export function changesOf(before: GivenView, after: GivenView): Partial<GivenView> {
  const keys = Object.keys(after) as (keyof GivenView)[];
  return Object.fromEntries(keys.filter((key) => !isSame(before[key], after[key])).map((key) => [key, after[key]]));
}

/** Whether the attributes ask for another camera. */
export function hasOtherCamera(before: Given, after: Given): boolean {
  return !isSame([before.view.preset, before.framing, before.camera], [after.view.preset, after.framing, after.camera]);
}

function isSame(a: unknown, b: unknown): boolean {
  return JSON.stringify(a) === JSON.stringify(b);
}
