import { deflateSync } from "node:zlib";
import { describe, expect, it } from "vitest";
import { kWorldAxes, type Box } from "../camera/camera";
import type { Pick, Point } from "../engine";
import type { Camera, Section } from "../state/view_state";
import { nearestOf, outlinesOf } from "./cut_snap";
import { faceAt, planeThrough } from "./face_plane";
import { alongAxis } from "./measure_points";
import { keptBox } from "./plane_outline";
import { featuresOf, labelImageOf, scalarsIn, type LabelImage } from "./rectangle";
import { boxSections, isSectionBox } from "./section_box";

const box: Box = { low: [0, 0, 0], high: [4, 3, 2], axes: kWorldAxes };
const above: Camera = { eye: [2, 2, 50], target: [2, 2, 0], parallel: true, height: 4, fieldOfView: 30 };

/** A PNG of two rows, of which each filter of PNG is tried for the second one. */
function png(values: number[][], filter: number): ArrayBuffer {
  const width = values[0]!.length;
  const raw = values.map((row) => row.flatMap((value) => [value >> 8, value & 255]));
  const rows = raw.flatMap((row, y) => {
    if (y === 0 || filter === 0) return [0, ...row];
    const before = raw[y - 1]!;
    const coded = row.map((byte, x) => {
      const [left, up, corner] = [x > 1 ? row[x - 2]! : 0, before[x]!, x > 1 ? before[x - 2]! : 0];
      const [a, b, c] = [Math.abs(up - corner), Math.abs(left - corner), Math.abs(left + up - 2 * corner)];
      const nearest = a <= b && a <= c ? left : b <= c ? up : corner;
      return (byte - [0, left, up, (left + up) >> 1, nearest][filter]! + 256) % 256;
    });
    return [filter, ...coded];
  });
  const chunk = (kind: string, data: Uint8Array) => {
    const head = Buffer.alloc(8);
    head.writeUInt32BE(data.length);
    head.write(kind, 4, "latin1");
    return Buffer.concat([head, data, Buffer.alloc(4)]);
  };
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width);
  header.writeUInt32BE(values.length, 4);
  header.set([16, 0, 0, 0, 0], 8);
  const all = Buffer.concat([
    Buffer.alloc(8),
    chunk("IHDR", header),
    chunk("IDAT", deflateSync(Buffer.from(rows))),
    chunk("IEND", Buffer.alloc(0)),
  ]);
  return new Uint8Array(all).buffer;
}

describe("a rectangle of the picture", () => {
  it("reads label images of all filters", async () => {
    const values = [
      [1, 300, 65535, 7],
      [2, 300, 512, 9],
    ];
    for (const filter of [0, 1, 2, 3, 4]) expect([...(await labelImageOf(png(values, filter))).values]).toEqual(values.flat());
    const color = png(values, 0);
    new Uint8Array(color)[25] = 2;
    await expect(labelImageOf(color)).rejects.toThrow();
  });

  it("selects objects inside, or objects that it touches", () => {
    const image: LabelImage = { width: 4, height: 2, values: Uint16Array.of(0, 5, 5, 6, 0, 7, 6, 6) };
    const left = { left: 0, top: 0, right: 0.5, bottom: 1 };
    expect([...scalarsIn(image, left, "touching")].sort()).toEqual([5, 7]);
    expect([...scalarsIn(image, left, "inside")]).toEqual([7]);
    const feature = (id: string, first: number, count: number) => ({
      id,
      first,
      count,
      class: "",
      name: "",
      parent: "",
      depth: 0,
      color: "",
      opacity: 1,
    });
    expect(featuresOf({ features: [feature("a", 5, 2), feature("b", 7, 1), feature("c", 8, 0)] }, new Set([7, 6]))).toEqual(["a", "b"]);
  });
});

describe("a plane through a face", () => {
  /** The surface z = f(x, y) of one object, seen from above: the picture is 4 m wide and high. */
  const surface = (height: (x: number, y: number) => number) => async (x: number, y: number) => {
    const [px, py] = [4 * x, 4 * (1 - y)];
    return { id: px < 4 ? "roof" : "other", class: "", name: "", scalar: 1, point: [px, py, height(px, py)] as Point } satisfies Pick;
  };

  it("has its normal, also on steps of voxels", async () => {
    const flat = (await faceAt(
      surface(() => 1.5),
      [0.5, 0.5],
      [0.05, 0.05],
      above,
    ))!;
    expect(planeThrough(flat, box)).toMatchObject({ axis: "z", at: 1.5, flip: false });
    const steps = (await faceAt(
      surface((x) => Math.floor(x / 0.1) * 0.1),
      [0.5, 0.5],
      [0.1, 0.1],
      above,
    ))!;
    const plane = planeThrough(steps, box);
    expect(plane.axis).toBe("free");
    expect(Math.abs(plane.tilt - 45)).toBeLessThan(12);
    expect(Math.abs(Math.abs(plane.turn) - 180)).toBeLessThan(3);
    const below = await faceAt(
      surface(() => 1.5),
      [0.5, 0.5],
      [0.05, 0.05],
      { ...above, eye: [2, 2, -50] },
    );
    expect(planeThrough(below!, box)).toMatchObject({ axis: "z", at: 1.5, flip: true });
  });

  it("needs a face", async () => {
    expect(await faceAt(async () => null, [0.5, 0.5], [0.05, 0.05], above)).toBeNull();
    const thin = async (x: number, y: number) => (x === 0.5 ? await surface(() => 1)(x, y) : null);
    expect(await faceAt(thin, [0.5, 0.5], [0.05, 0.05], above)).toBeNull();
  });
});

describe("a section box", () => {
  it("is six planes that limit each other", () => {
    const planes = boxSections([1, 1, 0.5], [3, 2, 1.5]);
    expect(isSectionBox(planes)).toBe(true);
    expect(isSectionBox(planes.slice(1))).toBe(false);
    expect(isSectionBox([...planes.slice(1), planes[1]!])).toBe(false);
    const n = planes.findIndex((plane) => plane.axis === "z" && !plane.flip);
    expect(keptBox(box, planes, n)).toEqual({ ...box, low: [1, 1, 0], high: [3, 2, 2] });
    const outside: Section[] = [planes[0]!, { ...planes[2]!, at: 99 }];
    expect(keptBox(box, outside, 0)).toEqual(box);
  });
});

describe("the outline of a cut", () => {
  const drawing = JSON.stringify({
    features: [
      {
        properties: { id: "wall" },
        geometry: {
          type: "MultiPolygon",
          coordinates: [
            [
              [
                [10, 20, 31],
                [12, 20, 31],
                [12, 21, 31],
                [10, 20, 31],
              ],
            ],
          ],
        },
      },
      {
        properties: { id: "pipe" },
        geometry: {
          type: "GeometryCollection",
          geometries: [
            {
              type: "MultiLineString",
              coordinates: [
                [
                  [15, 20, 31],
                  [15, 22, 31],
                ],
              ],
            },
          ],
        },
      },
      { properties: { id: "none" }, geometry: null },
    ],
  });

  it("attracts points to its corners, then to its edges", () => {
    const outlines = outlinesOf(drawing, [10, 20, 30]);
    expect(outlines.map(({ id, points }) => [id, points.length])).toEqual([
      ["wall", 4],
      ["pipe", 2],
    ]);
    const near = (at: Point, most: number) => nearestOf(outlines, at, (p) => 100 * Math.hypot(...p.map((v, i) => v - at[i]!)), most);
    expect(near([0.05, 0.02, 1], 9)).toEqual({ point: [0, 0, 1], to: "corner" });
    expect(near([1, 0.05, 1], 9)).toEqual({ point: [1, 0, 1], to: "edge" });
    expect(near([5, 1, 1.02], 9)).toEqual({ point: [5, 1, 1], to: "edge" });
    expect(near([1, 0.9, 1], 9)).toBeNull();
  });

  it("and right angles follow the longest axis", () => {
    expect(alongAxis([1, 1, 1], [1.2, 4, 1.5], kWorldAxes)).toEqual([1, 4, 1]);
  });
});
