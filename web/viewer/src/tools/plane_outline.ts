/** Intersection of a section plane with the building's box: its outline in the picture, and dragging. */

import type { Point } from "../engine";
import { corners, kWorldAxes, project, type Box } from "../camera/camera";
import { add, cross, dot, scale, sub } from "../camera/vec";
import { freeNormal } from "../state/scene_of";
import type { Camera, Section } from "../state/view_state";

/** Normal of a plane dot(normal, p) = at, world axes. */
export function normalOf(section: Section, box: Box): Point {
  if (section.axis === "free") return freeNormal(section);
  return box.axes[{ x: 0, y: 1, z: 2 }[section.axis]] as Point;
}

/** Range of plane positions that intersect the box. */
export function rangeOf(section: Section, box: Box): [number, number] {
  const along = corners(box).map((corner) => dot(corner, normalOf(section, box)));
  return [Math.min(...along), Math.max(...along)];
}

const kEdges: [number, number][] = [
  [0, 1],
  [2, 3],
  [4, 5],
  [6, 7],
  [0, 2],
  [1, 3],
  [4, 6],
  [5, 7],
  [0, 4],
  [1, 5],
  [2, 6],
  [3, 7],
];

/** The polygon in which a plane cuts the box, around its centre; empty if it does not. */
export function planeOutline(section: Section, box: Box): Point[] {
  const normal = normalOf(section, box);
  const points = corners(box);
  const side = points.map((p) => dot(p, normal) - section.at);
  const cut: Point[] = [];
  for (const [a, b] of kEdges) {
    const [da, db] = [side[a]!, side[b]!];
    if (da < 0 === db < 0) continue;
    cut.push(add(points[a]!, scale(sub(points[b]!, points[a]!), da / (da - db))));
  }
  if (cut.length < 3) return [];
  const middle = middleOf(cut);
  const across = sub(cut[0]!, middle),
    upward = cross(normal, across);
  const angle = (p: Point) => Math.atan2(dot(sub(p, middle), upward), dot(sub(p, middle), across));
  return cut.sort((p, q) => angle(p) - angle(q));
}

export function middleOf(points: Point[]): Point {
  return scale(points.reduce(add, [0, 0, 0] as Point), 1 / Math.max(1, points.length));
}

/** The part of the box that other planes along its axes keep. @param n  the plane that is not considered */
export function keptBox(box: Box, sections: readonly Section[], n: number): Box {
  const low: Point = [...box.low],
    high: Point = [...box.high];
  sections.forEach(({ axis, at, flip }, i) => {
    const k = ["x", "y", "z"].indexOf(axis);
    if (i === n || k < 0 || axis === sections[n]!.axis || at <= low[k]! || at >= high[k]!) return;
    (flip ? low : high)[k] = at;
  });
  return { ...box, low, high };
}

/** Moves a plane at the border of the box slightly inside, so that it stays visible. */
export function keptInside(section: Section, box: Box): Section {
  const [low, high] = rangeOf(section, box);
  const inset = (high - low) * 1e-4;
  return { ...section, at: Math.min(high - inset, Math.max(low + inset, section.at)) };
}

/** The plane, or one beside it if it would coincide with one of the others. */
export function keptApart(section: Section, others: Section[], box: Box): Section {
  const [low, high] = rangeOf(section, box);
  const step = (high - low) / 8;
  const isTaken = (at: number) =>
    others.some(
      (other) =>
        other.axis === section.axis && other.turn === section.turn && other.tilt === section.tilt && Math.abs(other.at - at) < step / 2,
    );
  for (let n = 0; n < 8; ++n) {
    // Alternates around its original place: 0, +1, -1, +2, ...
    const at = Number((section.at + (n % 2 ? (n + 1) / 2 : -n / 2) * step).toFixed(2));
    if (at > low && at < high && !isTaken(at)) return { ...section, at };
  }
  return section;
}

/**
 * Metres that the plane moves along its normal when its handle is dragged by (dx, dy) pixels.
 * @param size  of the picture, pixels
 */
export function dragged(camera: Camera, size: [number, number], handle: Point, normal: Point, dx: number, dy: number): number {
  const aspect = size[0] / size[1];
  const step = 0.01;
  const a = project(camera, aspect, handle),
    b = project(camera, aspect, add(handle, scale(normal, step)));
  if (!a || !b) return 0;
  const along: [number, number] = [((b.x - a.x) * size[0]) / step, ((b.y - a.y) * size[1]) / step];
  const square = along[0] ** 2 + along[1] ** 2;
  // Seen nearly end on, one pixel would correspond to metres.
  if (square < 4) return (-dy * 2 * camera.height) / size[1];
  return (dx * along[0] + dy * along[1]) / square;
}

export const boxEdges = (box: { low: Point; high: Point }): [Point, Point][] => {
  const at = corners({ ...box, axes: kWorldAxes });
  return kEdges.map(([a, b]) => [at[a]!, at[b]!]);
};
