/** A section plane through a face of the model that the user picks. */

import { halfHeight, type Box } from "../camera/camera";
import { add, cross, distance, dot, normalized, scale, sub } from "../camera/vec";
import type { Pick, Point } from "../engine";
import type { Session } from "../session";
import type { Camera, Section } from "../state/view_state";
import { lateText } from "../late_texts";

export interface Face {
  point: Point;
  /** Towards the viewer, world axes. */
  normal: Point;
}

/** Half the side of the sampled grid of points. */
const kSteps = 3;
/** Pixels from the middle to the border of the grid. */
const kLeast = 10,
  kMost = 60;
/** Voxels that the grid covers at least, because slanted faces consist of steps. */
const kVoxels = 4;
/** Cosine of the angle within which a plane lies along an axis. */
const kAlong = Math.cos((8 * Math.PI) / 180);

/**
 * The face at a position of the picture, from points of the same object around it: the area vector of the surface between them,
 * which is the mean normal also where voxels form steps. Null: nothing is there, or only an edge.
 * @param reach  half the width of the sampled square, fractions of the picture
 */
export async function faceAt(
  pick: (x: number, y: number) => Promise<Pick | null>,
  [x, y]: [number, number],
  reach: [number, number],
  camera: Camera,
): Promise<Face | null> {
  const steps = Array.from({ length: 2 * kSteps + 1 }, (_, i) => i / kSteps - 1);
  const picks = await Promise.all(steps.map((j) => Promise.all(steps.map((i) => pick(x + i * reach[0], y + j * reach[1])))));
  const middle = picks[kSteps]![kSteps];
  if (!middle) return null;
  let sum: Point = [0, 0, 0];
  for (let j = 1; j < steps.length; ++j)
    for (let i = 1; i < steps.length; ++i) {
      const corners = [picks[j - 1]![i - 1], picks[j - 1]![i], picks[j]![i], picks[j]![i - 1]];
      if (corners.some((corner) => corner?.id !== middle.id)) continue;
      const [a, b, c, d] = corners.map((corner) => corner!.point) as [Point, Point, Point, Point];
      sum = add(sum, cross(sub(c, a), sub(d, b)));
    }
  if (dot(sum, sum) === 0) return null;
  const normal = normalized(sum);
  const toEye = camera.parallel ? sub(camera.eye, camera.target) : sub(camera.eye, middle.point);
  return { point: middle.point, normal: dot(normal, toEye) < 0 ? scale(normal, -1) : normal };
}

/** The plane that removes everything in front of a face. */
export function planeThrough({ point, normal }: Face, box: Box): Section {
  const rounded = (value: number, digits: number) => Number(value.toFixed(digits));
  for (const [i, axis] of (["x", "y", "z"] as const).entries()) {
    const along = dot(box.axes[i]!, normal);
    if (Math.abs(along) > kAlong) return { axis, at: rounded(dot(box.axes[i]!, point), 3), flip: along < 0, turn: 45, tilt: 0 };
  }
  const degrees = 180 / Math.PI;
  const turn = rounded(Math.atan2(normal[1], normal[0]) * degrees, 1),
    tilt = rounded(Math.asin(Math.max(-1, Math.min(1, normal[2]))) * degrees, 1);
  const [a, b] = [turn / degrees, tilt / degrees];
  const exact: Point = [Math.cos(a) * Math.cos(b), Math.sin(a) * Math.cos(b), Math.sin(b)];
  return { axis: "free", at: rounded(dot(exact, point), 3), flip: false, turn, tilt };
}

/** Adds a plane through the face at a position of the picture. @param size  of the picture, CSS pixels */
export async function addPlaneAt(session: Session, x: number, y: number, size: [number, number]): Promise<void> {
  const { view, volume, messages } = session;
  const { engine, info, box } = volume;
  const { camera } = view.state;
  if (!engine || !info || !camera) return;
  try {
    const first = await engine.pick(x, y);
    const depth = camera.parallel || !first ? 1 : distance(camera.eye, first.point);
    const metresPerPixel = (2 * halfHeight(camera) * depth) / size[1];
    const pixels = Math.min(kMost, Math.max(kLeast, (kVoxels * Math.max(...info.spacing)) / metresPerPixel));
    const face = first && (await faceAt((at, down) => engine.pick(at, down), [x, y], [pixels / size[0], pixels / size[1]], camera));
    if (!face) return messages.tell(lateText("faceNothing"));
    view.set({ sections: [...view.state.sections, planeThrough(face, box)] });
    messages.say(lateText("facePlane", { n: view.state.sections.length }));
  } catch (error) {
    messages.fail(error);
  }
}
