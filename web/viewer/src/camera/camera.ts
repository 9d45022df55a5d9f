/**
 * Camera mathematics, with the same conventions as svt/render (CameraRays, camera presets). Points are metres from the
 * grid's lower corner in world axes; u and v run from -1 to 1, left to right and bottom to top.
 */

import type { Point, VolumeInfo } from "../engine";
import type { Camera } from "../state/view_state";
import { add, cross, dot, length, normalized, scale, sub } from "./vec";

/** A box along the grid's axes, metres from its lower corner. `axes` are its axes in world axes. */
export interface Box {
  low: Point;
  high: Point;
  axes: [Point, Point, Point];
}

/** The lower corner is the centre of the first voxel, so the box begins half a voxel before it. */
export function boxOf(info: VolumeInfo): Box {
  const { dimension: n, spacing: s } = info;
  return {
    low: [-s[0] / 2, -s[1] / 2, -s[2] / 2],
    high: [(n[0] - 0.5) * s[0], (n[1] - 0.5) * s[1], (n[2] - 0.5) * s[2]],
    axes: info.axes ?? kWorldAxes,
  };
}

export const kWorldAxes: [Point, Point, Point] = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];

/** From grid axes to world axes. */
export function toWorld(box: Box, p: Point): Point {
  return add(add(scale(box.axes[0], p[0]), scale(box.axes[1], p[1])), scale(box.axes[2], p[2]));
}

export function corners(box: Box): Point[] {
  return Array.from({ length: 8 }, (_, c) => toWorld(box, [0, 1, 2].map((axis) => ((c >> axis) & 1 ? box.high : box.low)[axis]!) as Point));
}

export interface Basis {
  forward: Point;
  right: Point;
  up: Point;
}

export function basisOf(camera: Camera, axes: [Point, Point, Point] = kWorldAxes): Basis {
  const forward = normalized(sub(camera.target, camera.eye));
  const isVertical = Math.hypot(forward[0], forward[1]) < 1e-4;
  const right = normalized(cross(forward, isVertical ? axes[1] : axes[2]));
  return { forward, right, up: cross(right, forward) };
}

/** Half the picture's height at depth 1 (perspective) or at any depth (parallel). */
export function halfHeight(camera: Camera): number {
  return camera.parallel ? camera.height / 2 : Math.tan((camera.fieldOfView * Math.PI) / 360);
}

/** Position of a point in the picture: fractions from the upper left corner, and depth; null behind the viewer. */
export function project(camera: Camera, aspect: number, p: Point, axes = kWorldAxes): { x: number; y: number; depth: number } | null {
  const { forward, right, up } = basisOf(camera, axes);
  const fromEye = sub(p, camera.eye);
  const depth = dot(fromEye, forward);
  if (!camera.parallel && depth <= 1e-6) return null;
  const half = halfHeight(camera) * (camera.parallel ? 1 : depth);
  const u = dot(fromEye, right) / (half * aspect);
  const v = dot(fromEye, up) / half;
  return { x: (u + 1) / 2, y: (1 - v) / 2, depth };
}

/** The ray through a position in the picture. */
export function rayAt(camera: Camera, aspect: number, x: number, y: number, axes = kWorldAxes): { from: Point; along: Point } {
  const { forward, right, up } = basisOf(camera, axes);
  const half = halfHeight(camera);
  const aside = add(scale(right, (2 * x - 1) * half * aspect), scale(up, (1 - 2 * y) * half));
  if (camera.parallel) return { from: add(camera.eye, aside), along: forward };
  return { from: camera.eye, along: normalized(add(forward, aside)) };
}

/** The point at `depth` along the view direction that appears at a position in the picture. */
export function pointAt(camera: Camera, aspect: number, x: number, y: number, depth: number, axes = kWorldAxes): Point {
  const { forward, right, up } = basisOf(camera, axes);
  const half = halfHeight(camera) * (camera.parallel ? 1 : depth);
  const aside = add(scale(right, (2 * x - 1) * half * aspect), scale(up, (1 - 2 * y) * half));
  return add(add(camera.eye, scale(forward, depth)), aside);
}

const kMargin = 0.06;

/** Metres from bottom to top of the parallel view `preset` that shows the whole box. */
export function parallelHeight(preset: "iso" | "top" | "bottom", box: Box, aspect: number): number {
  const forward = preset === "iso" ? normalized([-1, 1, -1]) : ([0, 0, preset === "top" ? -1 : 1] as Point);
  const right = normalized(cross(forward, preset === "iso" ? [0, 0, 1] : [0, 1, 0]));
  const up = cross(right, forward);
  const extent = (direction: Point) =>
    [0, 1, 2].reduce((sum, axis) => sum + Math.abs(direction[axis]!) * (box.high[axis]! - box.low[axis]!), 0);
  return Math.max(extent(up), extent(right) / aspect) / (1 - 2 * kMargin);
}

export function parallelZoom(preset: "iso" | "top" | "bottom", box: Box, aspect: number, height: number): number {
  return parallelHeight(preset, box, aspect) / height;
}

const kSteepest = (89 * Math.PI) / 180;

/** Orbits around `pivot`, which keeps its position in the picture; angles in radians. */
export function orbit(camera: Camera, pivot: Point, turn: number, rise: number): Camera {
  const { forward, right } = basisOf(camera);
  const pitch = Math.asin(Math.max(-1, Math.min(1, -forward[2])));
  const wanted = Math.max(-kSteepest, Math.min(kSteepest, pitch + rise));
  const moved = (p: Point) => add(pivot, turned(turnedAbout(sub(p, pivot), right, pitch - wanted), turn));
  return { ...camera, eye: moved(camera.eye), target: moved(camera.target) };
}

/** Looks around from a fixed eye position. */
export function lookAround(camera: Camera, turn: number, rise: number): Camera {
  return { ...orbit(camera, camera.eye, turn, rise), eye: camera.eye };
}

function turned(p: Point, angle: number): Point {
  const c = Math.cos(angle),
    s = Math.sin(angle);
  return [c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]];
}

function turnedAbout(p: Point, axis: Point, angle: number): Point {
  const c = Math.cos(angle),
    s = Math.sin(angle);
  return add(add(scale(p, c), scale(cross(axis, p), s)), scale(axis, dot(axis, p) * (1 - c)));
}

/** Moves parallel to the picture so that points at `depth` move by fractions of the picture's height. */
export function pan(camera: Camera, dx: number, dy: number, depth: number): Camera {
  const { right, up } = basisOf(camera);
  const metres = 2 * halfHeight(camera) * (camera.parallel ? 1 : depth);
  const step = add(scale(right, -dx * metres), scale(up, dy * metres));
  return { ...camera, eye: add(camera.eye, step), target: add(camera.target, step) };
}

/** Zooms in (factor below 1) towards `towards`, which keeps its position in the picture. */
export function zoom(camera: Camera, towards: Point, factor: number): Camera {
  const moved = (p: Point) => add(towards, scale(sub(p, towards), factor));
  if (!camera.parallel) return { ...camera, eye: moved(camera.eye), target: moved(camera.target) };
  const { forward } = basisOf(camera);
  const step = scale(sub(towards, camera.target), 1 - factor);
  const across = sub(step, scale(forward, dot(step, forward)));
  return { ...camera, eye: add(camera.eye, across), target: add(camera.target, across), height: camera.height * factor };
}

/** Walking: metres forwards, sideways (on the ground) and up. */
export function walk(camera: Camera, ahead: number, aside: number, rise: number): Camera {
  const { forward, right, up } = basisOf(camera);
  const level = Math.hypot(forward[0], forward[1]) < 1e-3 ? up : forward;
  const ground = normalized([level[0], level[1], 0]);
  const step = add(add(scale(ground, ahead), scale(right, aside)), [0, 0, rise]);
  return { ...camera, eye: add(camera.eye, step), target: add(camera.target, step) };
}

/** The same view in the other projection: the target keeps its size in the picture. */
export function withProjection(camera: Camera, parallel: boolean): Camera {
  if (camera.parallel === parallel) return camera;
  const tan = Math.tan((camera.fieldOfView * Math.PI) / 360);
  if (parallel) return { ...camera, parallel, height: 2 * tan * length(sub(camera.target, camera.eye)) };
  const { forward } = basisOf(camera);
  return { ...camera, parallel, eye: sub(camera.target, scale(forward, camera.height / 2 / tan)) };
}

/** Interpolates between two cameras for animation; share 0 to 1. */
export function between(a: Camera, b: Camera, share: number): Camera {
  const mix = (p: number, q: number) => p + (q - p) * share;
  const mixed = (p: Point, q: Point) => [0, 1, 2].map((i) => mix(p[i]!, q[i]!)) as Point;
  const from = sub(a.eye, a.target),
    to = sub(b.eye, b.target);
  const target = mixed(a.target, b.target);
  const reach = mix(length(from), length(to));
  const blended = add(scale(normalized(from), 1 - share), scale(normalized(to), share));
  const direction = length(blended) < 0.05 ? normalized(to) : normalized(blended);
  return { ...b, target, eye: add(target, scale(direction, reach)), height: mix(a.height, b.height) };
}
