/** Pictures of the user with their place: GeoTIFF, and PNG, JPEG or WebP with a world file. */

import { basemapText } from "./texts";
import type { Place } from "./ground";
import { isTiff, readTiff } from "./tiff";

export interface PlacedPicture {
  name: string;
  picture: HTMLCanvasElement;
  /** null: the files do not state it. */
  place: Place | null;
  /** Code of the reference system; null: the files do not state it. */
  epsg: number | null;
}

/** Longest side of a picture, pixels: larger ones are made smaller. */
export const kLongest = 4096;

const kWorldFile = /\.(tfw|tifw|pgw|pngw|jgw|jpgw|jpegw|wpw|wld)$/i;
export const kPictureKinds = ".tif,.tiff,.png,.jpg,.jpeg,.webp";
export const kWorldFileKinds = ".tfw,.tifw,.pgw,.pngw,.jgw,.jpgw,.jpegw,.wpw,.wld";

export async function readPicture(files: readonly { name: string; arrayBuffer(): Promise<ArrayBuffer> }[]): Promise<PlacedPicture> {
  const worldFile = files.find(({ name }) => kWorldFile.test(name));
  const file = files.find((other) => other !== worldFile);
  if (!file) throw { message: basemapText("onlyWorldFile") };
  const bytes = await file.arrayBuffer();
  const read = isTiff(bytes) ? await readTiff(bytes, kLongest) : await decoded(file.name, bytes);
  const place = worldFile ? placeOfWorldFile(new TextDecoder().decode(await worldFile.arrayBuffer()), worldFile.name) : read.place;
  return { name: file.name, picture: read.picture, epsg: read.epsg, place: place && scaled(place, read.scale) };
}

/** The place of a smaller picture. @param scale  its size by the size of the first */
function scaled({ origin, right, down }: Place, scale: number): Place {
  return { origin, right: [right[0] / scale, right[1] / scale], down: [down[0] / scale, down[1] / scale] };
}

async function decoded(name: string, bytes: ArrayBuffer) {
  const bitmap = await createImageBitmap(new Blob([bytes])).catch(() => {
    throw { message: basemapText("notPicture", { name }) };
  });
  return { ...drawn(bitmap, bitmap.width, bitmap.height), place: null, epsg: null };
}

/** A canvas with a picture, not larger than kLongest. */
export function drawn(image: CanvasImageSource, width: number, height: number): { picture: HTMLCanvasElement; scale: number } {
  const scale = Math.min(1, kLongest / Math.max(width, height));
  const picture = canvasOf(Math.max(1, Math.round(width * scale)), Math.max(1, Math.round(height * scale)));
  const context = picture.getContext("2d")!;
  context.imageSmoothingQuality = "high";
  context.drawImage(image, 0, 0, picture.width, picture.height);
  return { picture, scale };
}

export function canvasOf(width: number, height: number): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  Object.assign(canvas, { width, height });
  return canvas;
}

/** Six numbers, one per line. The last two are the centre of the upper left pixel. */
export function placeOfWorldFile(text: string, name: string): Place {
  const numbers = text.trim().split(/\s+/).map(Number);
  const [a, d, b, e, c, f] = numbers as [number, number, number, number, number, number];
  if (numbers.length !== 6 || !numbers.every(Number.isFinite) || a * e === b * d) throw { message: basemapText("badWorldFile", { name }) };
  return { origin: [c - (a + b) / 2, f - (d + e) / 2], right: [a, d], down: [b, e] };
}
