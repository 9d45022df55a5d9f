/** Distances and areas between picked points. */

import type { Point } from "../engine";
import { add, cross, distance, length, scale, sub } from "../camera/vec";

/** Length of the polyline through all points, metres; closed: including the segment back to the first. */
export function pathLength(points: Point[], isClosed: boolean): number {
  let sum = 0;
  for (let i = 1; i < points.length; ++i) sum += distance(points[i - 1]!, points[i]!);
  if (isClosed && points.length > 2) sum += distance(points[points.length - 1]!, points[0]!);
  return sum;
}

/** Area of the polygon, m2: its vector area, which is exact for coplanar points (Newell). */
export function polygonArea(points: Point[]): number {
  if (points.length < 3) return 0;
  const from = points[0]!;
  let sum: Point = [0, 0, 0];
  for (let i = 2; i < points.length; ++i) sum = add(sum, cross(sub(points[i - 1]!, from), sub(points[i]!, from)));
  return length(scale(sum, 0.5));
}
