/** All that the page shows, as one plain object. `sceneOf()` makes a scene of it; tools change it and nothing else. */

import type { Context, Point, Scene, SceneStyle, ShellLevel } from "../engine";

export type Look = "plain" | "paper" | "blueprint" | "dark";
export type HiddenLines = "none" | "faint" | "dashed";

/** z is up, except where the view is straight down or up: then the grid's y axis is. */
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

/** A plane that takes away what is beyond it. */
export interface Section {
  axis: SectionAxis;
  /** Metres from the grid's lower corner along the plane's normal. */
  at: number;
  /** Takes away the other side. */
  flip: boolean;
  /** Free planes: direction of the normal in world axes, degrees: from x towards y, and above the ground. */
  turn: number;
  tilt: number;
}

export interface Lens {
  /** Middle as shares of the picture's width and height, radius as a share of its height. */
  x: number;
  y: number;
  radius: number;
  /** Stays where it is; else it follows the mouse. */
  pinned: boolean;
  context: Context;
}

export interface Focus {
  /** Queries; empty: the selection. */
  query: string;
  context: Context;
  /** Cutaway: metres to spare. */
  margin: number;
}

/** What turns the one pass into more; at most one at a time. */
export type Effect = "none" | "lens" | "highlight" | "cutaway";

export interface ViewState {
  /** null: not known (yet); `preset` is shown. */
  camera: Camera | null;
  /** Named view, see render::cameraPresetNames(). */
  preset: string;
  look: Look;
  /** Queries; what the page writes is short even where much is hidden (visibility.ts). */
  hide: string[];
  /** Queries; where there are any, all else is hidden. */
  show: string[];
  styles: SceneStyle[];
  sections: Section[];
  /** null: as the look has it. */
  hatches: boolean | null;
  effect: Effect;
  lens: Lens;
  focus: Focus;
  shell: ShellLevel | null;
  /** null: no lines. */
  wireframe: HiddenLines | null;
  /** Names of the selected beside the picture. */
  names: boolean;
  /** Ids. */
  selection: string[];
  /** A scene given as JSON: its passes are drawn as they are, and the tools change the rest alone. */
  custom: Scene | null;
}

export function initialState(look: Look = "plain"): ViewState {
  return {
    camera: null,
    preset: "iso",
    look,
    hide: [],
    show: [],
    styles: [],
    sections: [],
    hatches: null,
    effect: "none",
    lens: { x: 0.5, y: 0.5, radius: 0.25, pinned: false, context: "ghost" },
    focus: { query: "", context: "ghost", margin: 0.15 },
    shell: null,
    wireframe: null,
    names: false,
    selection: [],
    custom: null,
  };
}

/** The style of exactly this query changed; a style that says nothing any more is dropped. */
export function withStyle(styles: SceneStyle[], select: string, change: Partial<SceneStyle>): SceneStyle[] {
  const before = styles.find((style) => style.select === select) ?? { select };
  const after: SceneStyle = { ...before, ...change };
  for (const key of Object.keys(after) as (keyof SceneStyle)[]) if (after[key] === undefined) delete after[key];
  const others = styles.filter((style) => style.select !== select);
  return Object.keys(after).length > 1 ? [...others, after] : others;
}
