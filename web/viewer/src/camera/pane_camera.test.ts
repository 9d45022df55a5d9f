import { expect, it } from "vitest";
import type { Point } from "../engine";
import { kWorldAxes, project, toWorld, type Box } from "./camera";
import { cameraOf, insideBox, kPanes, panned, planeOf, pointIn, toGrid, wholeFrame, zoomed, type PaneName } from "./pane_camera";

const kNames = Object.keys(kPanes) as PaneName[];
const turn = 0.4;
const boxes: Record<string, Box> = {
  straight: { low: [0, 0, 0], high: [10, 6, 4], axes: kWorldAxes },
  turned: {
    low: [-1, 2, 0],
    high: [10, 6, 4],
    axes: [
      [Math.cos(turn), Math.sin(turn), 0],
      [-Math.sin(turn), Math.cos(turn), 0],
      [0, 0, 1],
    ],
  },
};

for (const [kind, box] of Object.entries(boxes)) {
  it(`puts the axes of a ${kind} grid to the right and up`, () => {
    for (const name of kNames) {
      const { right, up, axis } = kPanes[name];
      const frame = wholeFrame(name, box, 1.5);
      const seen = (p: Point) => project(cameraOf(name, box, frame), 1.5, toWorld(box, p), box.axes)!;
      const middle = seen(frame.middle);
      expect([middle.x, middle.y]).toEqual([expect.closeTo(0.5), expect.closeTo(0.5)]);
      const moved = (i: number) => seen(frame.middle.map((v, k) => v + (k === i ? 1 : 0)) as Point);
      expect([moved(right).x > 0.5, moved(right).y]).toEqual([true, expect.closeTo(0.5)]);
      expect([moved(up).x, moved(up).y < 0.5]).toEqual([expect.closeTo(0.5), true]);
      // Towards the viewer: nearer.
      expect(Math.sign(middle.depth - moved(axis).depth)).toBe(kPanes[name].towards);
      for (const corner of [box.low, box.high]) {
        const { x, y } = seen(corner);
        expect(Math.min(x, y, 1 - x, 1 - y)).toBeGreaterThan(0);
      }
    }
  });

  it(`finds the point under the pointer in a ${kind} grid, which stays there`, () => {
    const at: Point = [3, 4, 1];
    expect(toGrid(box, toWorld(box, at))).toEqual(at.map((v) => expect.closeTo(v)));
    for (const name of kNames) {
      const frame = wholeFrame(name, box, 2);
      const p = pointIn(name, box, frame, 2, 0.3, 0.7, at);
      expect(p[kPanes[name].axis]).toBe(at[kPanes[name].axis]);
      const place = (other: typeof frame) => project(cameraOf(name, box, other), 2, toWorld(box, p), box.axes)!;
      expect([place(frame).x, place(frame).y]).toEqual([expect.closeTo(0.3), expect.closeTo(0.7)]);
      const near = place(zoomed(frame, p, 0.25));
      expect([near.x, near.y]).toEqual([expect.closeTo(0.3), expect.closeTo(0.7)]);
      const aside = place(panned(name, frame, 0.2, -0.1));
      expect([aside.x, aside.y]).toEqual([expect.closeTo(0.4), expect.closeTo(0.6)]);
    }
  });
}

it("removes the side of the viewer, and stays in the box", () => {
  expect(kNames.map((name) => [planeOf(name, [1, 2, 3]).axis, planeOf(name, [1, 2, 3]).at, planeOf(name, [1, 2, 3]).flip])).toEqual([
    ["z", 3, false],
    ["y", 2, true],
    ["x", 1, false],
  ]);
  expect(insideBox(boxes.straight!, [-1, 3, 9])).toEqual([0, 3, 4]);
});
