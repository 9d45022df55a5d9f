import { describe, expect, it } from "vitest";
import type { Point } from "../engine";
import type { Camera } from "../state/view_state";
import {
  between,
  boxOf,
  kWorldAxes,
  lookAround,
  orbit,
  pan,
  parallelHeight,
  pointAt,
  project,
  rayAt,
  walk,
  withProjection,
  zoom,
  type Box,
} from "./camera";
import { add, distance, dot, scale, sub } from "./vec";

const camera: Camera = { eye: [12, -9, 7], target: [4, 3, 2], parallel: false, height: 10, fieldOfView: 30 };
const aspect = 16 / 9;
const isNear = (a: Point, b: Point, by = 1e-9) => a.forEach((v, i) => expect(Math.abs(v - b[i]!)).toBeLessThan(by));

describe("projection", () => {
  it("shows the target in the middle", () => {
    const seen = project(camera, aspect, camera.target)!;
    expect(seen.x).toBeCloseTo(0.5, 12);
    expect(seen.y).toBeCloseTo(0.5, 12);
    expect(seen.depth).toBeCloseTo(distance(camera.eye, camera.target), 12);
  });

  it("is undone by pointAt and met by rayAt, parallel or not", () => {
    for (const parallel of [false, true])
      for (const p of [
        [1, 2, 3],
        [5, 5, 0],
        [0, -2, 6],
      ] as Point[]) {
        const view = { ...camera, parallel };
        const seen = project(view, aspect, p)!;
        isNear(pointAt(view, aspect, seen.x, seen.y, seen.depth), p);
        const { from, along } = rayAt(view, aspect, seen.x, seen.y);
        const t = dot(sub(p, from), along);
        isNear(add(from, scale(along, t)), p);
      }
  });

  it("knows what is behind the viewer", () => {
    expect(project(camera, aspect, add(camera.eye, sub(camera.eye, camera.target)))).toBeNull();
  });

  it("has north up when it looks straight down", () => {
    const top: Camera = { ...camera, eye: [4, 3, 20], target: [4, 3, 0] };
    const north = project(top, 1, [4, 4, 0])!,
      east = project(top, 1, [5, 3, 0])!;
    expect(north.y).toBeLessThan(0.5);
    expect(east.x).toBeGreaterThan(0.5);
  });
});

describe("orbit", () => {
  it("keeps the distance and leaves the pivot where it is seen", () => {
    const pivot: Point = [2, 1, 1];
    const before = project(camera, aspect, pivot)!;
    const after = orbit(camera, pivot, 0.7, -0.2);
    expect(distance(after.eye, pivot)).toBeCloseTo(distance(camera.eye, pivot), 9);
    const seen = project(after, aspect, pivot)!;
    expect(seen.x).toBeCloseTo(before.x, 6);
    expect(seen.y).toBeCloseTo(before.y, 6);
  });

  it("turns by the angle and comes back", () => {
    const there = orbit(camera, camera.target, 1.1, 0.3);
    isNear(orbit(there, camera.target, -1.1, -0.3).eye, camera.eye, 1e-9);
  });

  it("stops short of the poles", () => {
    let steep = camera;
    for (let n = 0; n < 50; ++n) steep = orbit(steep, camera.target, 0, 0.2);
    const away = sub(steep.eye, steep.target);
    expect(Math.asin(away[2] / Math.hypot(...away))).toBeCloseTo((89 * Math.PI) / 180, 6);
    expect(Math.hypot(away[0], away[1])).toBeGreaterThan(0.01);
  });

  it("goes on from straight down", () => {
    const top: Camera = { ...camera, eye: [4, 3, 20], target: [4, 3, 0] };
    const tilted = orbit(top, top.target, 0, -0.5);
    expect(tilted.eye.every(Number.isFinite)).toBe(true);
    expect(tilted.eye[1]).toBeLessThan(3);
  });
});

describe("hand movements", () => {
  it("zooms to the point under the pointer, parallel or not", () => {
    for (const parallel of [false, true]) {
      const view = { ...camera, parallel };
      const p: Point = [1, 2, 3];
      const before = project(view, aspect, p)!;
      const after = project(zoom(view, p, 0.6), aspect, p)!;
      expect(after.x).toBeCloseTo(before.x, 9);
      expect(after.y).toBeCloseTo(before.y, 9);
    }
    expect(distance(zoom(camera, camera.target, 0.5).eye, camera.target)).toBeCloseTo(distance(camera.eye, camera.target) / 2, 9);
    expect(zoom({ ...camera, parallel: true }, camera.target, 0.5).height).toBe(5);
  });

  it("pans so that what is grabbed stays under the finger", () => {
    for (const parallel of [false, true]) {
      const view = { ...camera, parallel };
      const depth = distance(view.eye, view.target);
      const after = project(pan(view, 0.2, -0.1, depth), aspect, view.target)!;
      expect(after.x).toBeCloseTo(0.5 + 0.2 / aspect, 9);
      expect(after.y).toBeCloseTo(0.5 - 0.1, 9);
    }
  });

  it("walks on the ground and looks around from the spot", () => {
    const gone = walk(camera, 2, 0, 0);
    expect(gone.eye[2]).toBe(camera.eye[2]);
    expect(Math.hypot(gone.eye[0] - camera.eye[0], gone.eye[1] - camera.eye[1])).toBeCloseTo(2, 9);
    const turned = lookAround(camera, 0.4, 0.1);
    expect(turned.eye).toEqual(camera.eye);
    expect(distance(turned.eye, turned.target)).toBeCloseTo(distance(camera.eye, camera.target), 9);
  });

  it("changes the projection and leaves the target's surroundings as large", () => {
    const flat = withProjection(camera, true);
    const p: Point = add(camera.target, [0, 0, 0]);
    expect(project(flat, aspect, p)!.y).toBeCloseTo(0.5, 9);
    expect(flat.height).toBeCloseTo(2 * Math.tan(Math.PI / 12) * distance(camera.eye, camera.target), 9);
    isNear(withProjection(flat, false).eye, camera.eye, 1e-9);
  });

  it("flies from one view to the other without passing through the target", () => {
    const other: Camera = { ...camera, eye: [-4, 15, -3], target: [4, 3, 2] };
    expect(between(camera, other, 0).eye.map((v) => +v.toFixed(9))).toEqual(camera.eye);
    expect(between(camera, other, 1).eye.map((v) => +v.toFixed(9))).toEqual(other.eye);
    for (let share = 0; share <= 1; share += 0.1) expect(distance(between(camera, other, share).eye, camera.target)).toBeGreaterThan(10);
  });
});

describe("box", () => {
  const info = { dimension: [11, 21, 6], spacing: [0.5, 0.5, 0.5] } as unknown as Parameters<typeof boxOf>[0];

  it("begins half a voxel before the lower corner", () => {
    expect(boxOf(info)).toEqual({ low: [-0.25, -0.25, -0.25], high: [5.25, 10.25, 2.75], axes: kWorldAxes });
  });

  it("fits a parallel plan by its narrower side", () => {
    const box: Box = { low: [0, 0, 0], high: [8, 4, 3], axes: kWorldAxes };
    expect(parallelHeight("top", box, 1)).toBeCloseTo(8 / 0.88, 9);
    expect(parallelHeight("top", box, 4)).toBeCloseTo(4 / 0.88, 9);
  });
});
