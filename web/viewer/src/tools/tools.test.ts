import { describe, expect, it } from "vitest";
import { corners, kWorldAxes, project, type Box } from "../camera/camera";
import { add, dot, scale } from "../camera/vec";
import { Resolution } from "../canvas/resolution";
import type { Camera, Section } from "../state/view_state";
import { indexFeatures } from "../state/feature_index";
import { firstOpen, rowsOf } from "../panels/tree_rows";
import { ringBoxes, tilesOver } from "./hatch_tiles";
import { pathLength, polygonArea } from "./measure";
import { dragged, keptInside, middleOf, normalOf, planeOutline, rangeOf } from "./plane_outline";
import { paperOf, printRules } from "./print_sheets";

const box: Box = { low: [0, 0, 0], high: [4, 3, 2], axes: kWorldAxes };
const section = (change: Partial<Section>): Section => ({ axis: "z", at: 1, flip: false, turn: 0, tilt: 0, ...change });

describe("measures", () => {
  it("of a rectangle that stands askew", () => {
    const points = [
      [0, 0, 0],
      [3, 0, 0],
      [3, 4, 3],
      [0, 4, 3],
    ] as [number, number, number][];
    expect(polygonArea(points)).toBeCloseTo(15, 12);
    expect(pathLength(points, true)).toBeCloseTo(16, 12);
    expect(pathLength(points, false)).toBeCloseTo(11, 12);
    expect(polygonArea(points.slice(0, 2))).toBe(0);
  });

  it("of an L, which is not convex", () => {
    const points = [
      [0, 0, 5],
      [2, 0, 5],
      [2, 1, 5],
      [1, 1, 5],
      [1, 2, 5],
      [0, 2, 5],
    ] as [number, number, number][];
    expect(polygonArea(points)).toBeCloseTo(3, 12);
  });
});

describe("section planes", () => {
  it("cut the box in a polygon that lies in them", () => {
    const plan = planeOutline(section({}), box);
    expect(plan).toHaveLength(4);
    expect(polygonArea(plan)).toBeCloseTo(12, 9);
    const free = section({ axis: "free", turn: 45, tilt: 35, at: 2.6 });
    const outline = planeOutline(free, box);
    expect(outline.length).toBeGreaterThanOrEqual(3);
    for (const p of outline) expect(dot(p, normalOf(free, box))).toBeCloseTo(2.6, 9);
    expect(planeOutline(section({ at: 9 }), box)).toEqual([]);
  });

  it("follow the axes of a turned building", () => {
    const turned: Box = {
      ...box,
      axes: [
        [0, 1, 0],
        [-1, 0, 0],
        [0, 0, 1],
      ],
    };
    expect(normalOf(section({ axis: "x" }), turned)).toEqual([0, 1, 0]);
    expect(rangeOf(section({ axis: "x" }), turned)).toEqual([0, 4]);
    expect(corners(turned)[1]).toEqual([0, 4, 0]);
  });

  it("stay in the box where they are drawn", () => {
    expect(planeOutline(keptInside(section({ at: 2 }), box), box)).toHaveLength(4);
  });

  it("follow the hand: what is under the pointer stays under it", () => {
    const camera: Camera = { eye: [9, -8, 7], target: [2, 1.5, 1], parallel: false, height: 5, fieldOfView: 30 };
    const size: [number, number] = [800, 450];
    const handle = middleOf(planeOutline(section({}), box)),
      normal = normalOf(section({}), box);
    const metres = dragged(camera, size, handle, normal, 0, -10);
    const before = project(camera, 800 / 450, handle)!,
      after = project(camera, 800 / 450, add(handle, scale(normal, metres)))!;
    expect(metres).toBeGreaterThan(0);
    expect((before.y - after.y) * 450).toBeCloseTo(10, 0);
  });
});

describe("resolution", () => {
  it("finds 20 to 45 ms on slow and on fast machines, with a frame now and then that stumbles", () => {
    for (const millisecondsAtFull of [2000, 400, 80])
      for (const fixed of [0, 15]) {
        const resolution = new Resolution();
        const frame = () => fixed + millisecondsAtFull * resolution.share ** 2;
        for (let n = 0; n < 60; ++n) resolution.learn(n % 7 === 6 ? 2 * frame() : frame());
        expect(resolution.share === 0.2 || (frame() >= 20 && frame() <= 45)).toBe(true);
      }
    const fast = new Resolution();
    for (let n = 0; n < 10; ++n) fast.learn(5);
    expect(fast.share).toBe(1);
  });
});

describe("tree rows", () => {
  const feature = (id: string, parent: string, name = "") => ({
    id,
    parent,
    name,
    class: "Wall",
    depth: 0,
    first: 1,
    count: 1,
    color: "#fff",
    opacity: 1,
  });
  const index = indexFeatures([
    feature("a", "", "House"),
    feature("b", "a", "Kitchen"),
    feature("c", "b", "Table"),
    feature("d", "a", "Hall"),
  ]);

  it("show what is open", () => {
    expect(rowsOf(index, new Set(), "").shown).toEqual([0]);
    expect(rowsOf(index, new Set([0]), "").shown).toEqual([0, 1, 3]);
    expect([...firstOpen(index)]).toEqual([0, 1]);
    expect([...firstOpen(index, 3)]).toEqual([0]);
  });

  it("find by name, class or id, with what is above", () => {
    const found = rowsOf(index, new Set(), "wall tab");
    expect(found.matches).toBe(1);
    expect(found.shown).toEqual([0, 1, 2]);
    expect(rowsOf(index, new Set(), "nothing").shown).toEqual([]);
  });
});

it("hatches as lines: boxes of rings, and all tiles over them", () => {
  expect(ringBoxes("M1 2L3 2 3 5ZM10 -1L12 -1 12 0Z")).toEqual([
    { left: 1, top: 2, right: 3, bottom: 5 },
    { left: 10, top: -1, right: 12, bottom: 0 },
  ]);
  expect(ringBoxes("M1 2c3 2 3 5 4 4Z")).toBeNull();
  const area = { left: 0, top: 0, right: 10, bottom: 4 };
  expect(tilesOver([area], [2, 2], 0)).toHaveLength(10);
  for (const degrees of [-45, -20, 30, 90]) {
    const [width, height] = [1.4, 2.6];
    const tiles = new Set(tilesOver([area], [width, height], degrees).map(String));
    const [cos, sin] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
    for (let x = 0.05; x < 10; x += 0.3)
      for (let y = 0.05; y < 4; y += 0.3)
        expect(tiles.has(String([Math.floor((x * cos + y * sin) / width), Math.floor((y * cos - x * sin) / height)]))).toBe(true);
    // Few more than the area of the box needs.
    expect(tiles.size).toBeLessThan((1.9 * 40) / (width * height) + 20);
  }
});

it("sheets are printed in the size of their paper", () => {
  expect(paperOf('<?xml?>\n<svg xmlns="a" width="420mm" height="297mm" viewBox="0 0 420 297">')).toEqual({ width: 420, height: 297 });
  expect(paperOf('<svg viewBox="0 0 420 297"><rect width="3mm" height="3mm"/></svg>')).toBeNull();
  const rules = printRules(['<svg width="420mm" height="297mm">', "<svg>"]);
  expect(rules).toContain("@page sheet-0 { size: 420mm 297mm; margin: 0; } #printed > :nth-child(1) { page: sheet-0; }");
  expect(rules).toContain("@page sheet-1 { size: A4 landscape;");
});
