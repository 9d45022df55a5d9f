/** The objects in a rectangle of the picture, from its label image: those that are visible there, not what they hide. */

import type { Session } from "../session";
import type { FeatureIndex } from "../state/feature_index";

/** Fractions of the picture, from its upper left corner. */
export interface Rectangle {
  left: number;
  top: number;
  right: number;
  bottom: number;
}
/** inside: objects whose visible part is completely in the rectangle; touching: all that are partly in it. */
export type RectangleRule = "inside" | "touching";

export interface LabelImage {
  width: number;
  height: number;
  /** Scalars; 0: nothing. */
  values: Uint16Array;
}

/** Width of the label image in pixels: finer than a finger, and drawn at once. */
const kWidth = 800;

/** @param isAdded  to the selection */
export async function selectInRectangle(session: Session, rectangle: Rectangle, rule: RectangleRule, isAdded: boolean): Promise<void> {
  const { view, volume, selection, messages } = session;
  const { engine, info, index } = volume;
  if (!engine) return;
  try {
    const [width, height] = view.size;
    const share = Math.min(1, kWidth / width);
    const size: [number, number] = [Math.max(2, Math.round(width * share)), Math.max(2, Math.round(height * share))];
    const image = await labelImageOf(await engine.labels(await view.composed(size, 1)));
    if (volume.info === info) selection.select(featuresOf(index, scalarsIn(image, rectangle, rule)), isAdded);
  } catch (error) {
    messages.fail(error);
  }
}

export function scalarsIn({ width, height, values }: LabelImage, rectangle: Rectangle, rule: RectangleRule): Set<number> {
  const { left, top, right, bottom } = rectangle;
  const isIn = (x: number, y: number) => {
    const [across, down] = [(x + 0.5) / width, (y + 0.5) / height];
    return across >= left && across <= right && down >= top && down <= bottom;
  };
  const inside = new Set<number>(),
    outside = new Set<number>();
  for (let y = 0; y < height; ++y) for (let x = 0; x < width; ++x) (isIn(x, y) ? inside : outside).add(values[y * width + x]!);
  inside.delete(0);
  return rule === "touching" ? inside : new Set([...inside].filter((scalar) => !outside.has(scalar)));
}

/** Ids of the features that own scalars, in the order of the tree. */
export function featuresOf({ features }: Pick<FeatureIndex, "features">, scalars: ReadonlySet<number>): string[] {
  const owns = (first: number, count: number) => {
    for (let scalar = first; scalar < first + count; ++scalar) if (scalars.has(scalar)) return true;
    return false;
  };
  return features.filter(({ first, count }) => owns(first, count)).map(({ id }) => id);
}

/** Bytes per pixel of a gray PNG with 16 bits. */
const kPixel = 2;

/** Reads a gray PNG with 16 bits, not interlaced. A canvas would round it to 8 bits. Rejects other files. */
export async function labelImageOf(png: ArrayBuffer): Promise<LabelImage> {
  const view = new DataView(png);
  const data: Uint8Array<ArrayBuffer>[] = [];
  let width = 0,
    height = 0;
  for (let at = 8; at + 12 <= png.byteLength;) {
    const length = view.getUint32(at),
      kind = view.getUint32(at + 4);
    if (kind === 0x49484452) {
      [width, height] = [view.getUint32(at + 8), view.getUint32(at + 12)];
      if (view.getUint16(at + 16) !== 0x1000 || view.getUint8(at + 20) !== 0) throw new Error("not a label image");
    }
    if (kind === 0x49444154) data.push(new Uint8Array(png, at + 8, length));
    at += 12 + length;
  }
  const inflated = new Response(new Blob(data).stream().pipeThrough(new DecompressionStream("deflate")));
  const rows = unfiltered(new Uint8Array(await inflated.arrayBuffer()), kPixel * width, height);
  const values = new Uint16Array(width * height);
  for (let i = 0; i < values.length; ++i) values[i] = (rows[2 * i]! << 8) | rows[2 * i + 1]!;
  return { width, height, values };
}

/** Undoes the filters of PNG's rows. */
function unfiltered(bytes: Uint8Array, stride: number, height: number): Uint8Array {
  const rows = new Uint8Array(stride * height);
  for (let y = 0; y < height; ++y) {
    const filter = bytes[y * (stride + 1)]!;
    for (let x = 0; x < stride; ++x) {
      const i = y * stride + x;
      const left = x >= kPixel ? rows[i - kPixel]! : 0,
        above = y > 0 ? rows[i - stride]! : 0,
        corner = x >= kPixel && y > 0 ? rows[i - stride - kPixel]! : 0;
      const guess = [0, left, above, (left + above) >> 1, paeth(left, above, corner)][filter] ?? 0;
      rows[i] = bytes[y * (stride + 1) + 1 + x]! + guess;
    }
  }
  return rows;
}

function paeth(left: number, above: number, corner: number): number {
  const sum = left + above - corner;
  const [a, b, c] = [Math.abs(sum - left), Math.abs(sum - above), Math.abs(sum - corner)];
  return a <= b && a <= c ? left : b <= c ? above : corner;
}
