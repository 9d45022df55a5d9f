/** The view cube: its visible faces in the picture, and the view directions that its faces, edges and corners stand for. */

import type { CameraPreset, Point } from "../engine";
import type { Camera } from "../state/view_state";
import { basisOf, kWorldAxes } from "./camera";
import { add, cross, dot, normalized, scale, sub } from "./vec";

/** From the target to the eye, along the axes of the grid: -1, 0 or 1 each. One number: a face; two: an edge; three: a corner. */
export type Direction = readonly [number, number, number];
type Axes = [Point, Point, Point];

export interface CubeFace {
  name: FaceName;
  /** Areas of the face, from its lower left corner; the middle one stands for the face, the others for edges and corners. */
  areas: { direction: Direction; points: [number, number][] }[];
  /** Place of the name: a matrix of SVG. */
  matrix: [number, number, number, number, number, number];
}

export type FaceName = Extract<CameraPreset, "front" | "right" | "back" | "left" | "top" | "bottom">;

const kFaces: readonly { name: FaceName; normal: Direction; right: Direction }[] = [
  { name: "front", normal: [0, -1, 0], right: [1, 0, 0] },
  { name: "right", normal: [1, 0, 0], right: [0, 1, 0] },
  { name: "back", normal: [0, 1, 0], right: [-1, 0, 0] },
  { name: "left", normal: [-1, 0, 0], right: [0, -1, 0] },
  { name: "top", normal: [0, 0, 1], right: [1, 0, 0] },
  { name: "bottom", normal: [0, 0, -1], right: [1, 0, 0] },
];
/** Share of a face's half side that belongs to the face itself. */
const kInner = 0.6;
const kSteps = [-1, -kInner, kInner, 1] as const;

const inWorld = (p: Direction, axes: Axes): Point => add(add(scale(axes[0], p[0]), scale(axes[1], p[1])), scale(axes[2], p[2]));

/** The named view of a face; null for edges and corners. */
export function faceOf(direction: Direction): FaceName | null {
  return kFaces.find(({ normal }) => normal.every((v, i) => v === direction[i]))?.name ?? null;
}

/** The faces that meet at a direction. */
export function facesAt(direction: Direction): FaceName[] {
  return kFaces.filter(({ normal }) => normal.some((v, i) => v !== 0 && v === direction[i])).map(({ name }) => name);
}

/** The visible faces. @param half  half the side of the cube, pixels */
export function visibleFaces(camera: Camera, axes: Axes, half: number): CubeFace[] {
  const { forward, right, up } = basisOf(camera, axes);
  const seen = (p: Point): [number, number] => [dot(p, right) * half, -dot(p, up) * half];
  return kFaces.flatMap((face) => {
    const normal = inWorld(face.normal, axes);
    if (dot(normal, forward) > -0.02) return [];
    const across = inWorld(face.right, axes),
      upward = cross(normal, across);
    const upwardInGrid = cross([...face.normal], [...face.right]);
    const at = (a: number, b: number) => seen(add(normal, add(scale(across, a), scale(upward, b))));
    const areas = [-1, 0, 1].flatMap((j) =>
      [-1, 0, 1].map((i) => {
        const [left, farther] = [kSteps[i + 1]!, kSteps[i + 2]!],
          [low, high] = [kSteps[j + 1]!, kSteps[j + 2]!];
        const direction = face.normal.map((v, k) => v + i * face.right[k]! + j * upwardInGrid[k]!) as Point;
        return { direction, points: [at(left, low), at(farther, low), at(farther, high), at(left, high)] };
      }),
    );
    const [ax, ay] = seen(across),
      [ux, uy] = seen(upward),
      [x, y] = seen(normal);
    return [{ name: face.name, areas, matrix: [ax / half, ay / half, -ux / half, -uy / half, x, y] }];
  });
}

/** The camera at the same distance from its target, in another direction. */
export function turnedTo(camera: Camera, direction: Direction, axes: Axes = kWorldAxes): Camera {
  const away = sub(camera.eye, camera.target);
  return { ...camera, eye: add(camera.target, scale(normalized(inWorld(direction, axes)), Math.sqrt(dot(away, away)))) };
}

const kEighth = Math.PI / 4;

/** The next direction of the cube after steps of 45 degrees: to the right around the model, and upwards. */
export function nextDirection(camera: Camera, axes: Axes, turn: number, rise: number): Direction {
  const away = normalized(sub(camera.eye, camera.target));
  const [x, y, z] = axes.map((axis) => dot(axis, away)) as Point;
  const isVertical = Math.hypot(x, y) < 1e-3;
  const around = Math.round((isVertical ? -Math.PI / 2 : Math.atan2(y, x)) / kEighth) + turn;
  const level = Math.max(-2, Math.min(2, Math.round(Math.asin(Math.max(-1, Math.min(1, z))) / kEighth) + rise));
  if (Math.abs(level) === 2) return [0, 0, level / 2];
  const sign = (value: number) => (Math.abs(value) < 0.1 ? 0 : Math.sign(value));
  return [sign(Math.cos(around * kEighth)), sign(Math.sin(around * kEighth)), level];
}
