/** Three sections through one point, each seen straight on: the plan from above, the others from the front and from the right. */

import type { Point } from "../engine";
import type { Camera, Section } from "../state/view_state";
import { rayAt, toWorld, type Box } from "./camera";
import { add, dot, scale } from "./vec";

export type PaneName = "plan" | "front" | "side";

interface PaneAxes {
  /** Axis of the grid across the plane, and its sign towards the viewer. */
  axis: 0 | 1 | 2;
  towards: 1 | -1;
  /** Axes of the grid to the right and up in the picture. */
  right: 0 | 1 | 2;
  up: 0 | 1 | 2;
}

export const kPanes: Readonly<Record<PaneName, PaneAxes>> = {
  plan: { axis: 2, towards: 1, right: 0, up: 1 },
  front: { axis: 1, towards: -1, right: 0, up: 2 },
  side: { axis: 0, towards: 1, right: 1, up: 2 },
};

/** The visible part of a section: its middle in axes of the grid, metres from its lower corner, and the metres from bottom to top. */
export interface Frame {
  middle: Point;
  height: number;
}

const kMargin = 0.08;

/** A point in axes of the grid. */
export function toGrid(box: Box, p: Point): Point {
  return box.axes.map((axis) => dot(axis, p)) as Point;
}

export function middleOfBox(box: Box): Point {
  return box.low.map((low, i) => (low + box.high[i]!) / 2) as Point;
}

export function insideBox(box: Box, p: Point): Point {
  return p.map((v, i) => Math.min(box.high[i]!, Math.max(box.low[i]!, v))) as Point;
}

/** The frame that shows the whole section. */
export function wholeFrame(name: PaneName, box: Box, aspect: number): Frame {
  const { right, up } = kPanes[name];
  const extent = (i: number) => box.high[i]! - box.low[i]!;
  return { middle: middleOfBox(box), height: Math.max(extent(up), extent(right) / aspect) / (1 - 2 * kMargin) };
}

export function cameraOf(name: PaneName, box: Box, frame: Frame): Camera {
  const { axis, towards } = kPanes[name];
  const target = toWorld(box, frame.middle);
  const eye = add(target, scale(box.axes[axis], towards * (1 + box.high[axis] - box.low[axis])));
  return { eye, target, parallel: true, height: frame.height, fieldOfView: 40 };
}

/** The plane through `at`, which removes everything on the viewer's side. */
export function planeOf(name: PaneName, at: Point): Section {
  const { axis, towards } = kPanes[name];
  return { axis: (["x", "y", "z"] as const)[axis], at: at[axis], flip: towards < 0, turn: 0, tilt: 0 };
}

/** The point of the section at fractions of the picture; `at` is any point of its plane. */
export function pointIn(name: PaneName, box: Box, frame: Frame, aspect: number, x: number, y: number, at: Point): Point {
  const seen = toGrid(box, rayAt(cameraOf(name, box, frame), aspect, x, y, box.axes).from);
  seen[kPanes[name].axis] = at[kPanes[name].axis];
  return seen;
}

/** Moves the section with the pointer by fractions of the picture's height. */
export function panned(name: PaneName, frame: Frame, dx: number, dy: number): Frame {
  const { right, up } = kPanes[name];
  const middle: Point = [...frame.middle];
  middle[right] -= dx * frame.height;
  middle[up] += dy * frame.height;
  return { ...frame, middle };
}

/** Zooms in (factor below 1) towards a point, which keeps its place. */
export function zoomed(frame: Frame, towards: Point, factor: number): Frame {
  return { middle: frame.middle.map((v, i) => towards[i]! + (v - towards[i]!) * factor) as Point, height: frame.height * factor };
}
