/** The complete view as one plain object. `sceneOf()` makes a scene from it; tools modify only this object. */

import type { CameraPreset, Context, HiddenLines, Look, Point, Scene, SceneStyle, ShellLevel } from "../engine";
import { kSceneMembers, type ChoiceOf, type DeclaredMember, type SceneMember } from "../generated/scene_members";
import type { PlainMember } from "./member_controls";

/** The up direction is z, except in views straight down or up: there it is the grid's y axis. */
export interface Camera {
  eye: Point;
  target: Point;
  parallel: boolean;
  /** Parallel: metres from the lower to the upper border of the picture. */
  height: number;
  /** Perspective: degrees from the lower to the upper border. */
  fieldOfView: number;
}

export type SectionAxis = "x" | "y" | "z" | "free";

/** A plane that removes everything beyond it. */
export interface Section {
  axis: SectionAxis;
  /** Metres from the grid's lower corner along the plane's normal. */
  at: number;
  /** Removes the other side instead. */
  flip: boolean;
  /** Free planes: direction of the normal in world axes, degrees: from x towards y, and above the horizon. */
  turn: number;
  tilt: number;
}

export interface Lens {
  /** Centre as fractions of the picture's width and height, radius as a fraction of its height. */
  x: number;
  y: number;
  radius: number;
  /** Fixed in place; else it follows the mouse. */
  pinned: boolean;
  context: Context;
}

export interface Focus {
  /** Queries; empty: the selection. */
  query: string;
  context: Context;
  /** Cutaway: margin in metres. */
  margin: number;
}

/** Effect that turns the single pass into several; at most one at a time. */
export type Effect = "none" | "lens" | "highlight" | "cutaway";

export interface ViewState {
  /** null: not yet known; `preset` is shown. */
  camera: Camera | null;
  /** Named view, see render::cameraPresetNames(). */
  preset: CameraPreset;
  look: Look;
  /** Queries; the page keeps its own short even if much is hidden (visibility.ts). */
  hide: string[];
  /** Queries; if there are any, everything else is hidden. */
  show: string[];
  styles: SceneStyle[];
  sections: Section[];
  /** Regions that are cut away besides the planes (docs/user/regions.md). */
  regions: string[];
  /** null: according to the look. */
  hatches: boolean | null;
  effect: Effect;
  lens: Lens;
  focus: Focus;
  shell: ShellLevel | null;
  /** The source of the labels; null: the faces of the model, if it has meshes. */
  surfaces: ChoiceOf<"/surfaces"> | null;
  /** null: no lines. */
  wireframe: HiddenLines | null;
  /** Names of selected features beside the picture. */
  names: boolean;
  /** Queries: features whose names are written into the picture. */
  named: string[];
  /** The meaning of colours and legend in the picture: class, storey, volume, an attribute, ...; empty: no colouring. */
  colorBy: string;
  /** Members of the scene without a separate control; members with their defaults are absent. */
  picture: Partial<Pick<Scene, PlainMember>>;
  /** Light by the sun, with shadows; null: light beside the camera. */
  sun: NonNullable<Scene["sun"]> | null;
  /** A field of the volume as colours, in place of `colorBy`; null: none. */
  field: NonNullable<Scene["field"]> | null;
  /** Ids. */
  selection: string[];
  /** The query that selected them; empty: they were selected one by one. */
  selectedBy: string;
  /** Points measured between, metres from the grid's lower corner. */
  measured: Point[];
  /** A scene given as JSON: its passes are drawn unchanged, and the tools change only the rest. */
  custom: Scene | null;
}

export function initialState(look: Look = kSceneMembers["/look"].default): ViewState {
  return {
    camera: null,
    preset: kSceneMembers["/camera/preset"].default,
    look,
    hide: [],
    show: [],
    styles: [],
    sections: [],
    regions: [],
    hatches: null,
    effect: "none",
    lens: { x: 0.5, y: 0.5, radius: 0.25, pinned: false, context: "ghost" },
    focus: { query: "", context: "ghost", margin: 0.15 },
    shell: null,
    surfaces: null,
    wireframe: null,
    names: false,
    named: [],
    colorBy: "",
    picture: {},
    sun: null,
    field: null,
    selection: [],
    selectedBy: "",
    measured: [],
    custom: null,
  };
}

/** Members that a picture can always follow. */
const kFree: readonly (keyof ViewState)[] = ["camera", "preset", "selection", "selectedBy", "measured"];

/** Whether two views differ at most in members that a picture can always follow. */
export function isSameChoice(a: ViewState, b: ViewState): boolean {
  return isSameBut(kFree, a, b);
}
/** Whether two views differ at most in their cameras. */
export function isSameButCamera(a: ViewState, b: ViewState): boolean {
  return isSameBut(["camera", "preset"], a, b);
}
function isSameBut(free: readonly (keyof ViewState)[], a: ViewState, b: ViewState): boolean {
  return (Object.keys(b) as (keyof ViewState)[]).every((key) => free.includes(key) || a[key] === b[key]);
}

/** Changes the style of exactly this query; a style without any setting is removed. */
export function withStyle(styles: SceneStyle[], select: string, change: Partial<SceneStyle>): SceneStyle[] {
  const before = styles.find((style) => style.select === select) ?? { select };
  const after: SceneStyle = { ...before, ...change };
  for (const key of Object.keys(after) as (keyof SceneStyle)[]) if (after[key] === undefined) delete after[key];
  const others = styles.filter((style) => style.select !== select);
  return Object.keys(after).length > 1 ? [...others, after] : others;
}

/** Sets a plain member of the picture; its default, or an empty text, removes it. */
export function withMember(picture: ViewState["picture"], name: SceneMember, value: unknown): ViewState["picture"] {
  const { default: byDefault = "" }: DeclaredMember = kSceneMembers[name];
  const key = name.slice(1);
  const others = Object.fromEntries(Object.entries(picture).filter(([other]) => other !== key));
  return value === byDefault ? others : { ...others, [key]: value };
}

/** The same view of a volume whose grid begins elsewhere: points move by `by`, planes along their normals. */
export function shifted(state: ViewState, by: Point, box: { axes: [Point, Point, Point] }): ViewState {
  const move = (p: Point): Point => [p[0] + by[0], p[1] + by[1], p[2] + by[2]];
  const along = (n: Point) => n[0] * by[0] + n[1] * by[1] + n[2] * by[2];
  const normal = ({ axis, turn, tilt }: Section): Point => {
    if (axis !== "free") return box.axes[{ x: 0, y: 1, z: 2 }[axis]]!;
    const [a, b] = [(turn * Math.PI) / 180, (tilt * Math.PI) / 180];
    return [Math.cos(a) * Math.cos(b), Math.sin(a) * Math.cos(b), Math.sin(b)];
  };
  const { camera } = state;
  return {
    ...state,
    camera: camera && { ...camera, eye: move(camera.eye), target: move(camera.target) },
    sections: state.sections.map((section) => ({ ...section, at: section.at + along(normal(section)) })),
    measured: state.measured.map(move),
  };
}
