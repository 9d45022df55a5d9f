/** A picture of the ground below the model: its place, and the scene above it. */

import type { Point, Scene } from "../engine";
import { basisOf, corners, halfHeight, kWorldAxes, type Box } from "../camera/camera";
import { add, dot, scale, sub } from "../camera/vec";
import type { OpenVolume } from "../session/open_volume";
import type { Camera, ViewState } from "../state/view_state";

export type Pair = [number, number];

/** Where the pixels of a picture lie, in coordinates of a reference system: x to the east, y to the north. */
export interface Place {
  /** Upper left corner of the picture. */
  origin: Pair;
  /** Steps of one pixel to the right and downwards. */
  right: Pair;
  down: Pair;
}

/** A horizontal picture in the coordinates of the model. */
export class Ground {
  /**
   * @param height  in coordinates of the model, metres
   * @param attribution  who made the picture
   */
  constructor(
    readonly picture: HTMLCanvasElement,
    readonly place: Place,
    readonly height: number,
    readonly attribution: string,
  ) {}

  at(height: number): Ground {
    return new Ground(this.picture, this.place, height, this.attribution);
  }

  /** Makes the scene of a view one above the ground, if the ground is visible. */
  show(scene: Scene, { camera, custom }: ViewState, { info, box }: OpenVolume): void {
    const height = this.height - (info?.origin[2] ?? 0);
    if (!isAbove(camera, height)) return;
    // Passes of a given scene stay as they are.
    aboveGround(scene, height, custom ? height : lowestOf(box));
  }
}

/** Height of the lowest point of a box, metres from the grid's lower corner. */
export function lowestOf(box: Box): number {
  return Math.min(...corners(box).map((p) => p[2]));
}

/** Depth, metres, up to which the lower border of a model counts as above the ground. */
const kTouches = 1e-6;

/** The ground is visible only from above: from below it would hide the model. @param height  metres from the grid's lower corner */
export function isAbove(camera: Camera | null, height: number): boolean {
  if (!camera) return false;
  return camera.parallel ? camera.target[2] < camera.eye[2] : camera.eye[2] > height;
}

/**
 * The scene as it is drawn above the ground, which shows through its background. Parts below the ground are hidden; then
 * nothing of the model is behind the ground, so that no depth is needed.
 * @param height  of the ground, metres from the grid's lower corner
 * @param lowest  of the model
 */
export function aboveGround(scene: Scene, height: number, lowest: number): void {
  scene.transparent = true;
  if (height > lowest + kTouches)
    scene.passes = (scene.passes ?? [{}]).map((pass) => ({ keep: `z>${Number(height.toFixed(4))}`, ...pass }));
}

/**
 * From pixels of the picture of the ground to CSS pixels of the view: the 16 numbers of `matrix3d()`. A plane in
 * perspective is a linear map of homogeneous coordinates, so this is exact.
 * @param origin  the grid's lower corner in coordinates of the model
 * @param size  of the view, CSS pixels
 */
export function groundMatrix(ground: Ground, origin: Point, camera: Camera, size: Pair, axes = kWorldAxes): number[] {
  const { forward, right, up } = basisOf(camera, axes);
  const [width, height] = size;
  const half = halfHeight(camera);
  const { place } = ground;
  const corner = sub([place.origin[0], place.origin[1], ground.height], origin);
  // The column of a direction or, with `w` 1, of a point from the eye.
  const column = (d: Point, w: number) => {
    const depth = camera.parallel ? w : dot(d, forward);
    const u = dot(d, right) / (half * (width / height)),
      v = dot(d, up) / half;
    return [((u + depth) / 2) * width, ((depth - v) / 2) * height, 0, depth];
  };
  const columns = [column([...place.right, 0], 0), column([...place.down, 0], 0), [0, 0, 1, 0], column(sub(corner, camera.eye), 1)];
  // Browsers keep these numbers in single precision.
  const most = Math.max(...columns.flat().map(Math.abs));
  return columns.flatMap((numbers, n) => numbers.map((v) => (n === 2 ? v : v / most)));
}

/** The rectangle of a picture along the axes: west, south, east and north. */
export function boundsOf({ origin, right, down }: Place, [width, height]: Pair): [number, number, number, number] {
  const at = (x: number, y: number) => [0, 1].map((i) => origin[i]! + right[i]! * x + down[i]! * y) as Pair;
  const all = [at(0, 0), at(width, 0), at(0, height), at(width, height)];
  const of = (i: 0 | 1, pick: (...values: number[]) => number) => pick(...all.map((p) => p[i]));
  return [of(0, Math.min), of(1, Math.min), of(0, Math.max), of(1, Math.max)];
}

/** The place of a picture that fills a rectangle. */
export function placeIn([west, south, east, north]: readonly number[], [width, height]: Pair): Place {
  return { origin: [west!, north!], right: [(east! - west!) / width, 0], down: [0, -(north! - south!) / height] };
}

/** The pixel at coordinates of the picture's reference system. */
export function pixelAt({ origin, right, down }: Place, [x, y]: Pair): Pair {
  const by: Pair = [x - origin[0], y - origin[1]];
  const area = right[0] * down[1] - right[1] * down[0];
  return [(by[0] * down[1] - by[1] * down[0]) / area, (right[0] * by[1] - right[1] * by[0]) / area];
}

/** Shares of the model's size, and limits in metres, of the ground around it. */
const kAround = 0.6,
  kLeast = 60,
  kMost = 400;

/** The part of the ground around the model that is fetched: west, south, east, north in coordinates of the model. */
export function groundAround(corners: readonly Point[], origin: Point): [number, number, number, number] {
  const all = corners.map((p) => add(p, origin));
  const [west, east, south, north] = [0, 1].flatMap((i) => [Math.min(...all.map((p) => p[i]!)), Math.max(...all.map((p) => p[i]!))]) as [
    number,
    number,
    number,
    number,
  ];
  const by = Math.min(kMost, Math.max(kLeast, kAround * Math.max(east - west, north - south)));
  return [west - by, south - by, east + by, north + by];
}

/** Only for tests: the image of a pixel under a matrix. */
export function mapped(m: readonly number[], [x, y]: Pair): Point {
  const [a, b, , w] = [0, 1, 2, 3].map((i) => m[i]! * x + m[4 + i]! * y + m[12 + i]!) as [number, number, number, number];
  return scale([a, b, w], 1 / w);
}
