/** A section box: six planes along the axes of the grid, of which each pair keeps what lies between. */

import { corners, kWorldAxes } from "../camera/camera";
import { dot } from "../camera/vec";
import type { Point } from "../engine";
import type { Session } from "../session";
import type { Section } from "../state/view_state";
import { normalOf } from "./plane_outline";

const kAxes = ["x", "y", "z"] as const;
/** Metres around the selection. */
const kMargin = 0.3;
/** Share of the building that the first box removes at each side. */
const kInset = 0.2;

/** Whether the planes are a box and nothing else. */
export function isSectionBox(sections: readonly Section[]): boolean {
  const has = (axis: string, flip: boolean) => sections.some((section) => section.axis === axis && section.flip === flip);
  return sections.length === 6 && kAxes.every((axis) => has(axis, false) && has(axis, true));
}

export function boxSections(low: Point, high: Point): Section[] {
  return kAxes.flatMap((axis, i) => [
    { axis, at: Number(low[i]!.toFixed(2)), flip: true, turn: 45, tilt: 0 },
    { axis, at: Number(high[i]!.toFixed(2)), flip: false, turn: 45, tilt: 0 },
  ]);
}

/** The corners of the boxes of one or two selected objects; empty: another selection, or an object without a box. */
function cornersOf({ pair, properties }: Session["selection"]): Point[] {
  const boxes = (pair ?? (properties ? [properties] : [])).map((of) => of.box);
  const isKnown = boxes.every(({ low, high }) => [...low, ...high].every(Number.isFinite));
  return isKnown ? boxes.flatMap((of) => corners({ ...of, axes: kWorldAxes })) : [];
}

/** Where a plane begins: in the middle of the selection, else of the building, or of the view of a city. */
export function placeOf(section: Section, { selection, volume, view }: Session): number {
  const normal = normalOf(section, volume.box);
  const { camera } = view.state;
  const selected = cornersOf(selection);
  const seen = volume.isCity && camera ? [camera.target] : corners(volume.box);
  const along = (selected.length ? selected : seen).map((point) => dot(point, normal));
  return Number(((Math.min(...along) + Math.max(...along)) / 2).toFixed(2));
}

/** The box around the selection with a margin, within the building; without a selection, the middle of the building. */
export function sectionBox({ selection, volume }: Session): Section[] {
  const { box } = volume;
  const points = cornersOf(selection);
  const side = (axis: number) => box.high[axis]! - box.low[axis]!;
  if (!points.length)
    return boxSections(box.low.map((v, i) => v + kInset * side(i)) as Point, box.high.map((v, i) => v - kInset * side(i)) as Point);
  const along = (axis: number) => points.map((p) => dot(p, box.axes[axis]!));
  const low = [0, 1, 2].map((i) => Math.max(box.low[i]!, Math.min(...along(i)) - kMargin)) as Point;
  const high = [0, 1, 2].map((i) => Math.min(box.high[i]!, Math.max(...along(i)) + kMargin)) as Point;
  return boxSections(low, high);
}
