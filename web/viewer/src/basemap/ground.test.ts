/** The place of the ground in the picture, of pictures and of tiles. */

import { describe, expect, it } from "vitest";
import { project } from "../camera/camera";
import type { Camera } from "../state/view_state";
import type { Scene } from "../engine";
import { aboveGround, groundAround, groundMatrix, isAbove, mapped, pixelAt, placeIn, Ground, type Place } from "./ground";
import { placeOfWorldFile } from "./image_files";
import { lzw } from "./tiff";
import { addressOf, isTemplate, mercatorOf, metresOf, tilesOf, zoomOf } from "./mercator";

const eye: Camera = { eye: [20, -30, 25], target: [5, 4, 2], parallel: false, height: 30, fieldOfView: 30 };
const place: Place = { origin: [1000, 2000], right: [0.5, 0.1], down: [0.1, -0.5] };
const ground = new Ground({} as HTMLCanvasElement, place, 103, "");
const origin = [990, 1990, 100] as [number, number, number];

describe("the ground", () => {
  it("is where the camera sees it, in perspective and parallel", () => {
    for (const camera of [eye, { ...eye, parallel: true }]) {
      const m = groundMatrix(ground, origin, camera, [800, 450]);
      for (const [x, y] of [
        [0, 0],
        [31, 7],
        [12, 40],
      ] as const) {
        const world = [10 + 0.5 * x + 0.1 * y, 10 + 0.1 * x - 0.5 * y, 3] as [number, number, number];
        const seen = project(camera, 800 / 450, world)!;
        const [px, py] = mapped(m, [x, y]);
        expect(px).toBeCloseTo(seen.x * 800, 6);
        expect(py).toBeCloseTo(seen.y * 450, 6);
      }
    }
  });

  it("is visible only from above", () => {
    expect([isAbove(eye, 24), isAbove(eye, 26), isAbove(null, 0)]).toEqual([true, false, false]);
    expect(isAbove({ ...eye, parallel: true, eye: [0, 0, -9], target: [0, 0, 0] }, -20)).toBe(false);
  });

  it("hides parts below it, and only these", () => {
    const scene: Scene = { passes: [{ cut: "x>1" }] };
    aboveGround(scene, 0, 0);
    expect(scene).toEqual({ transparent: true, passes: [{ cut: "x>1" }] });
    aboveGround(scene, 1.25, 0);
    expect(scene.passes).toEqual([{ keep: "z>1.25", cut: "x>1" }]);
  });

  it("surrounds the model by a margin within limits", () => {
    expect(
      groundAround(
        [
          [0, 0, 0],
          [10, 20, 3],
        ],
        [100, 200, 0],
      ),
    ).toEqual([40, 140, 170, 280]);
  });

  it("knows the pixel of a place", () => {
    const [x, y] = pixelAt(place, [1000 + 0.5 * 3 + 0.1 * 4, 2000 + 0.1 * 3 - 0.5 * 4]);
    expect([x, y].map((v) => Number(v.toFixed(9)))).toEqual([3, 4]);
    expect(placeIn([10, 20, 30, 25], [100, 50])).toEqual({ origin: [10, 25], right: [0.2, 0], down: [0, -0.1] });
  });
});

describe("pictures", () => {
  it("have the place of their world file", () => {
    expect(placeOfWorldFile("0.5\n0\n0\n-0.5\n100.25\n199.75\n", "a.pgw")).toEqual({
      origin: [100, 200],
      right: [0.5, 0],
      down: [0, -0.5],
    });
    expect(() => placeOfWorldFile("1 2 3", "a.pgw")).toThrow();
  });

  it("are read from LZW, as in section 13 of TIFF 6.0", () => {
    const packed = packed9([256, 7, 258, 8, 8, 258, 6, 6, 257]);
    expect([...lzw(packed, 10)]).toEqual([7, 7, 7, 8, 8, 7, 7, 6, 6, 0]);
  });
});

/** Codes of 9 bits from the most significant one. */
function packed9(codes: number[]): Uint8Array {
  const bits = codes.map((code) => code.toString(2).padStart(9, "0")).join("");
  return Uint8Array.from(bits.match(/.{1,8}/g)!, (byte) => parseInt(byte.padEnd(8, "0"), 2));
}

describe("tiles", () => {
  it("have the numbers of OpenStreetMap", () => {
    // The Brandenburg Gate.
    const at = mercatorOf([13.3777, 52.5163]);
    expect(tilesOf(at, at, 17).tiles).toEqual([{ z: 17, x: 70406, y: 42987 }]);
    expect(metresOf([180, 0])[0]).toBeCloseTo(20037508.342789, 5);
    // EPSG guidance note 7-2, section 3.2.1.2, has this latitude on the sphere of the ellipsoid's axis.
    expect(metresOf([-100.333333333, 24.381786944])[1]).toBeCloseTo(2800000, -1);
  });

  it("are at most 8 x 8", () => {
    const low = mercatorOf([13.37, 52.52]),
      high = mercatorOf([13.39, 52.51]);
    const z = zoomOf(low, high, 19);
    const { count } = tilesOf(low, high, z);
    expect(Math.max(...count)).toBeLessThanOrEqual(8);
    expect(Math.max(...tilesOf(low, high, z + 1).count)).toBeGreaterThan(6);
  });

  it("have addresses by a template", () => {
    expect(isTemplate("https://a.b/{z}/{x}/{y}.png")).toBe(true);
    expect(isTemplate("https://a.b/{z}/{x}.png")).toBe(false);
    expect(addressOf("https://{s}.b/{z}/{x}/{y}{r}.png?k={key}", { z: 3, x: 1, y: 2 })).toBe("https://a.b/3/1/2.png?k={key}");
    expect(addressOf("{z}/{x}/{-y}", { z: 3, x: 1, y: 2 })).toBe("3/1/5");
  });
});
