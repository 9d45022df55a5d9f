import { describe, expect, it } from "vitest";
import type { Camera } from "../state/view_state";
import { kWorldAxes } from "./camera";
import { faceOf, facesAt, nextDirection, turnedTo, visibleFaces, type Direction } from "./cube";

const camera = (eye: [number, number, number]): Camera => ({ eye, target: [0, 0, 0], parallel: false, height: 10, fieldOfView: 30 });

describe("the view cube", () => {
  it("shows the faces that look at the viewer, with 26 directions altogether", () => {
    expect(visibleFaces(camera([10, -10, 10]), kWorldAxes, 27).map(({ name }) => name)).toEqual(["front", "right", "top"]);
    expect(visibleFaces(camera([0, 0, 10]), kWorldAxes, 27).map(({ name }) => name)).toEqual(["top"]);
    const all = [camera([10, -10, 10]), camera([-10, 10, -10])].flatMap((one) => visibleFaces(one, kWorldAxes, 27));
    const directions = new Set(all.flatMap(({ areas }) => areas.map(({ direction }) => direction.join())));
    expect(directions.size).toBe(26);
    for (const { name, areas } of all) expect(faceOf(areas[4]!.direction)).toBe(name);
  });

  it("has the named faces where they are in the picture", () => {
    const [front] = visibleFaces(camera([0, -10, 0]), kWorldAxes, 27);
    expect(front!.name).toBe("front");
    expect(front!.matrix.map((v) => Math.round(v * 100) / 100 + 0)).toEqual([1, 0, 0, 1, 0, 0]);
    // The upper right area looks from above, in front and the right.
    expect(front!.areas[8]!.direction).toEqual([1, -1, 1]);
    expect(front!.areas[8]!.points[2]).toEqual([27, -27]);
    expect(facesAt([1, -1, 1])).toEqual(["front", "right", "top"]);
  });

  it("turns by 45 degrees, up to the top", () => {
    let now = turnedTo(camera([0, -10, 0]), [0, -1, 0]);
    const step = (turn: number, rise: number): Direction => {
      const next = nextDirection(now, kWorldAxes, turn, rise);
      now = turnedTo(now, next);
      return next;
    };
    expect(step(1, 0)).toEqual([1, -1, 0]);
    expect(step(1, 0)).toEqual([1, 0, 0]);
    expect(step(0, 1)).toEqual([1, 0, 1]);
    expect(step(0, 1)).toEqual([0, 0, 1]);
    expect(step(0, 1)).toEqual([0, 0, 1]);
    expect(step(0, -1)).toEqual([0, -1, 1]);
    expect(Math.hypot(...now.eye)).toBeCloseTo(10);
  });
});
