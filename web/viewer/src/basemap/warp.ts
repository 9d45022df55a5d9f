/** A picture of another reference system, drawn anew along the axes of the model's coordinates. */

import { canvasOf } from "./image_files";
import type { Pair } from "./ground";

/** Cells along each side, within each of which the map is linear. */
const kCells = 16;
const kLongest = 2048;

/** Points of a mesh over a rectangle (west, south, east, north), row by row from the north-west. */
export function meshOf([west, south, east, north]: readonly number[]): Pair[] {
  return Array.from({ length: (kCells + 1) ** 2 }, (_, n) => {
    const [i, j] = [n % (kCells + 1), Math.floor(n / (kCells + 1))];
    return [west! + ((east! - west!) * i) / kCells, north! - ((north! - south!) * j) / kCells];
  });
}

/**
 * @param pixels  for each point of meshOf(bounds), the pixel of `source`
 * @return a picture that fills the rectangle
 */
export function warped(source: CanvasImageSource, bounds: readonly number[], pixels: readonly Pair[]): HTMLCanvasElement {
  const [west, south, east, north] = bounds as [number, number, number, number];
  const scale = kLongest / Math.max(east - west, north - south);
  // Whole cells, so that they meet without gaps.
  const side = (metres: number) => Math.max(1, Math.round((metres * scale) / kCells));
  const [across, down] = [side(east - west), side(north - south)];
  const canvas = canvasOf(across * kCells, down * kCells);
  const context = canvas.getContext("2d")!;
  const at = (i: number, j: number) => pixels[j * (kCells + 1) + i]!;
  for (let j = 0; j < kCells; ++j)
    for (let i = 0; i < kCells; ++i) {
      const [p, q, r] = [at(i, j), at(i + 1, j), at(i, j + 1)];
      // Steps in the source for a pixel of this picture.
      const [a, b, c, d] = [(q[0] - p[0]) / across, (q[1] - p[1]) / across, (r[0] - p[0]) / down, (r[1] - p[1]) / down];
      const area = a * d - b * c;
      if (!area) continue;
      context.save();
      context.beginPath();
      context.rect(i * across, j * down, across, down);
      context.clip();
      context.translate(i * across, j * down);
      context.transform(d / area, -b / area, -c / area, a / area, 0, 0);
      context.translate(-p[0], -p[1]);
      context.drawImage(source, 0, 0);
      context.restore();
    }
  return canvas;
}
