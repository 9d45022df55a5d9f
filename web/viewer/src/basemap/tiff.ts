/** TIFF 6.0 with 8 bits per sample, and the place and reference system of GeoTIFF 1.1 (OGC 19-008). */

import { basemapText } from "./texts";
import type { Place } from "./ground";

const kTag = {
  width: 256,
  height: 257,
  bits: 258,
  compression: 259,
  photometric: 262,
  stripOffsets: 273,
  samples: 277,
  rowsPerStrip: 278,
  stripBytes: 279,
  planar: 284,
  predictor: 317,
  colors: 320,
  tileWidth: 322,
  tileHeight: 323,
  tileOffsets: 324,
  tileBytes: 325,
  pixelScale: 33550,
  tiepoints: 33922,
  transformation: 34264,
  geoKeys: 34735,
} as const;

const kGeoKey = { rasterType: 1025, geographic: 2048, projected: 3072 } as const;
const kPixelIsPoint = 2,
  kUserDefined = 32767;
/** Bytes of each type of a field. */
const kTypeBytes: Record<number, number> = { 1: 1, 2: 1, 3: 2, 4: 4, 5: 8, 6: 1, 8: 2, 9: 4, 11: 4, 12: 8 };
const kGray = [0, 1],
  kRgb = 2,
  kPalette = 3;
/** Pixels of a picture, and samples of one block. */
const kMostPixels = 400e6,
  kMostInBlock = 64e6;

export function isTiff(bytes: ArrayBuffer): boolean {
  const head = new Uint8Array(bytes.slice(0, 4));
  return (head[0] === 0x49 && head[1] === 0x49 && head[2] === 42) || (head[0] === 0x4d && head[1] === 0x4d && head[3] === 42);
}

type Fields = Map<number, number[]>;

function fieldsOf(view: DataView): Fields {
  const isLittle = view.getUint8(0) === 0x49;
  const start = view.getUint32(4, isLittle);
  const fields: Fields = new Map();
  for (let n = 0, count = view.getUint16(start, isLittle); n < count; ++n) {
    const at = start + 2 + 12 * n;
    const [tag, type, size] = [view.getUint16(at, isLittle), view.getUint16(at + 2, isLittle), view.getUint32(at + 4, isLittle)];
    const bytes = kTypeBytes[type];
    if (!bytes || size * bytes > view.byteLength) continue;
    const from = size * bytes <= 4 ? at + 8 : view.getUint32(at + 8, isLittle);
    const read = (i: number) => {
      const place = from + i * bytes;
      if (type === 12) return view.getFloat64(place, isLittle);
      return bytes === 1 ? view.getUint8(place) : bytes === 2 ? view.getUint16(place, isLittle) : view.getUint32(place, isLittle);
    };
    fields.set(
      tag,
      Array.from({ length: size }, (_, i) => read(i)),
    );
  }
  return fields;
}

/** The picture, made smaller to at most `longest` pixels, with the share of its size; place and code of the file. */
export async function readTiff(
  bytes: ArrayBuffer,
  longest: number,
): Promise<{ picture: HTMLCanvasElement; scale: number; place: Place | null; epsg: number | null }> {
  try {
    const fields = fieldsOf(new DataView(bytes));
    const one = (tag: number, otherwise: number) => fields.get(tag)?.[0] ?? otherwise;
    const [width, height] = [one(kTag.width, 0), one(kTag.height, 0)];
    if (!width || !height || width * height > kMostPixels) throw { message: basemapText("tiffSize") };
    const scale = Math.min(1, longest / Math.max(width, height));
    const picture = document.createElement("canvas");
    Object.assign(picture, { width: Math.max(1, Math.round(width * scale)), height: Math.max(1, Math.round(height * scale)) });
    await paint(picture.getContext("2d")!, scale, new Uint8Array(bytes), fields, [width, height]);
    return { picture, scale, place: placeOf(fields), epsg: epsgOf(fields) };
  } catch (error) {
    if (error instanceof RangeError) throw { message: basemapText("tiffDamaged") };
    throw error;
  }
}

/** Draws block after block, so that a large picture needs little memory. */
async function paint(
  context: CanvasRenderingContext2D,
  scale: number,
  bytes: Uint8Array,
  fields: Fields,
  [width, height]: [number, number],
): Promise<void> {
  const one = (tag: number, otherwise: number) => fields.get(tag)?.[0] ?? otherwise;
  const samples = one(kTag.samples, 1),
    photometric = one(kTag.photometric, 1);
  const isKnown = kGray.includes(photometric) || (photometric === kRgb && samples >= 3) || photometric === kPalette;
  if (!isKnown || (fields.get(kTag.bits) ?? [1]).some((bits) => bits !== 8) || one(kTag.planar, 1) !== 1)
    throw { message: basemapText("tiffSamples") };
  const isTiled = fields.has(kTag.tileWidth);
  const across = isTiled ? one(kTag.tileWidth, 0) : width,
    down = isTiled ? one(kTag.tileHeight, 0) : Math.min(height, one(kTag.rowsPerStrip, height));
  const offsets = fields.get(isTiled ? kTag.tileOffsets : kTag.stripOffsets) ?? [],
    sizes = fields.get(isTiled ? kTag.tileBytes : kTag.stripBytes) ?? [];
  const columns = Math.ceil(width / across);
  if (!across || !down || across * down * samples > kMostInBlock || offsets.length < columns * Math.ceil(height / down))
    throw { message: basemapText("tiffDamaged") };
  for (const [n, offset] of offsets.entries()) {
    const [x, y] = [(n % columns) * across, Math.floor(n / columns) * down];
    const rows = Math.min(down, height - y);
    if (rows <= 0) break;
    const size = across * (isTiled ? down : rows) * samples;
    const block = await unpacked(bytes.subarray(offset, offset + (sizes[n] ?? 0)), one(kTag.compression, 1), size);
    if (one(kTag.predictor, 1) === 2) addLeft(block, across * samples, samples);
    const part = new OffscreenCanvas(Math.min(across, width - x), rows);
    part
      .getContext("2d")!
      .putImageData(new ImageData(colored(block, across, rows, samples, photometric, fields.get(kTag.colors) ?? []), across, rows), 0, 0);
    context.drawImage(part, x * scale, y * scale, part.width * scale, rows * scale);
  }
}

function colored(block: Uint8Array, width: number, rows: number, samples: number, photometric: number, colors: number[]) {
  const pixels = new Uint8ClampedArray(width * rows * 4);
  const hasAlpha = samples === 2 || samples === 4;
  const entries = colors.length / 3;
  for (let n = 0; n < width * rows; ++n) {
    const at = n * samples;
    const value = block[at]!;
    if (photometric === kRgb) pixels.set(block.subarray(at, at + 3), 4 * n);
    else if (photometric === kPalette) for (let c = 0; c < 3; ++c) pixels[4 * n + c] = (colors[c * entries + value] ?? 0) >> 8;
    else pixels.fill(photometric === 0 ? 255 - value : value, 4 * n, 4 * n + 3);
    pixels[4 * n + 3] = hasAlpha ? block[at + samples - 1]! : 255;
  }
  return pixels;
}

/** Predictor 2: each sample is the difference from the pixel at its left. */
function addLeft(block: Uint8Array, row: number, samples: number): void {
  for (let start = 0; start + row <= block.length; start += row)
    for (let i = start + samples; i < start + row; ++i) block[i] = block[i]! + block[i - samples]!;
}

async function unpacked(packed: Uint8Array, compression: number, size: number): Promise<Uint8Array> {
  if (compression === 1) return padded(packed.slice(), size);
  if (compression === 5) return lzw(packed, size);
  if (compression === 32773) return packBits(packed, size);
  if (compression !== 8 && compression !== 32946) throw { message: basemapText("tiffCompression", { n: compression }) };
  const reader = new Blob([packed.slice()]).stream().pipeThrough(new DecompressionStream("deflate")).getReader();
  const block = new Uint8Array(size);
  for (let at = 0; ;) {
    const { done, value } = await reader.read().catch(() => {
      throw { message: basemapText("tiffDamaged") };
    });
    if (done) return block;
    block.set(value.subarray(0, Math.max(0, size - at)), Math.min(at, size));
    at += value.length;
    if (at >= size) {
      await reader.cancel();
      return block;
    }
  }
}

function padded(bytes: Uint8Array, size: number): Uint8Array {
  if (bytes.length >= size) return bytes.subarray(0, size);
  const all = new Uint8Array(size);
  all.set(bytes);
  return all;
}

function packBits(packed: Uint8Array, size: number): Uint8Array {
  const block = new Uint8Array(size);
  for (let from = 0, to = 0; from < packed.length && to < size;) {
    const head = packed[from++]!;
    if (head < 128) {
      block.set(packed.subarray(from, from + Math.min(head + 1, size - to)), to);
      from += head + 1;
      to += head + 1;
    } else if (head > 128) {
      block.fill(packed[from++]!, to, (to += 257 - head));
    }
  }
  return block;
}

/** Section 13 of TIFF 6.0: codes from the most significant bit, one bit longer a code early. */
export function lzw(packed: Uint8Array, size: number): Uint8Array {
  const kClear = 256,
    kEnd = 257,
    kMostCodes = 4096;
  const prefix = new Int32Array(kMostCodes),
    last = new Uint8Array(kMostCodes),
    lengths = new Int32Array(kMostCodes).fill(1);
  for (let code = 0; code < 256; ++code) last[code] = code;
  const block = new Uint8Array(size);
  let next = 258,
    bits = 9,
    before = -1,
    to = 0,
    buffer = 0,
    held = 0;
  const write = (code: number) => {
    const length = lengths[code]!;
    let first = 0;
    for (let at = to + length - 1, now = code; at >= to; --at, now = prefix[now]!) {
      first = last[now]!;
      if (at < size) block[at] = first;
    }
    to += length;
    return first;
  };
  for (const byte of packed) {
    buffer = ((buffer << 8) | byte) & 0xffffff;
    held += 8;
    if (held < bits) continue;
    held -= bits;
    const code = (buffer >> held) & ((1 << bits) - 1);
    if (code === kEnd || to >= size) break;
    if (code === kClear) {
      [next, bits, before] = [258, 9, -1];
      continue;
    }
    if (before < 0) write(code);
    else {
      if (code > next || next >= kMostCodes) throw { message: basemapText("tiffDamaged") };
      prefix[next] = before;
      lengths[next] = lengths[before]! + 1;
      // The code that is being defined begins and ends with the same byte.
      if (code === next) {
        let first = before;
        while (lengths[first]! > 1) first = prefix[first]!;
        last[next] = last[first]!;
        write(code);
      } else last[next] = write(code);
      ++next;
    }
    before = code;
    bits = next >= 2047 ? 12 : next >= 1023 ? 11 : next >= 511 ? 10 : 9;
  }
  return block;
}

function geoKeys(fields: Fields): Map<number, number> {
  const all = fields.get(kTag.geoKeys) ?? [];
  const keys = new Map<number, number>();
  // Values elsewhere are texts and doubles.
  for (let at = 4; at + 3 < all.length; at += 4) if (all[at + 1] === 0) keys.set(all[at]!, all[at + 3]!);
  return keys;
}

function epsgOf(fields: Fields): number | null {
  const keys = geoKeys(fields);
  const code = keys.get(kGeoKey.projected) ?? keys.get(kGeoKey.geographic) ?? 0;
  return code > 0 && code !== kUserDefined ? code : null;
}

function placeOf(fields: Fields): Place | null {
  const isPoint = geoKeys(fields).get(kGeoKey.rasterType) === kPixelIsPoint;
  const moved = (place: Place): Place => {
    if (!isPoint) return place;
    const { origin, right, down } = place;
    return { ...place, origin: [origin[0] - (right[0] + down[0]) / 2, origin[1] - (right[1] + down[1]) / 2] };
  };
  const m = fields.get(kTag.transformation);
  if (m?.length === 16) return moved({ origin: [m[3]!, m[7]!], right: [m[0]!, m[4]!], down: [m[1]!, m[5]!] });
  const [sx, sy] = fields.get(kTag.pixelScale) ?? [];
  const [i, j, , x, y] = fields.get(kTag.tiepoints) ?? [];
  if (!sx || !sy || x === undefined || y === undefined) return null;
  return moved({ origin: [x - i! * sx, y + j! * sy], right: [sx, 0], down: [0, -sy] });
}
