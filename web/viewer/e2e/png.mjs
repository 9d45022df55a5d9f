// Reads PNGs of 8-bit colour and of 16-bit gray, as `svt render` writes them, and writes PNGs of 8-bit colour.
import { deflateSync, inflateSync } from "node:zlib";

/** CRC-32 of ISO 3309. */
function crc32(bytes) {
  let sum = 0xffffffff;
  for (const byte of bytes) {
    sum ^= byte;
    for (let bit = 0; bit < 8; ++bit) sum = (sum >>> 1) ^ (sum & 1 ? 0xedb88320 : 0);
  }
  return ~sum >>> 0;
}

/** A PNG of RGB. @param colorOf  (x, y) -> [r, g, b] */
export function writePng(width, height, colorOf) {
  const chunk = (name, body) => {
    const bytes = Buffer.concat([Buffer.from(name, "latin1"), body]),
      ends = Buffer.alloc(8);
    ends.writeUInt32BE(body.length, 0);
    ends.writeUInt32BE(crc32(bytes), 4);
    return Buffer.concat([ends.subarray(0, 4), bytes, ends.subarray(4)]);
  };
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 2], 8);
  const rows = Array.from({ length: height }, (_, y) =>
    Buffer.from([0, ...Array.from({ length: width }, (__, x) => colorOf(x, y)).flat()]),
  );
  const signature = Buffer.from([0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10]);
  return Buffer.concat([signature, chunk("IHDR", head), chunk("IDAT", deflateSync(Buffer.concat(rows))), chunk("IEND", Buffer.alloc(0))]);
}

/** { width, height, channels, data }: samples row by row; numbers of 8 or 16 bits. */
export function readPng(bytes) {
  const parts = [];
  let width, height, depth, kind;
  for (let at = 8; at < bytes.length;) {
    const size = bytes.readUInt32BE(at),
      name = bytes.toString("latin1", at + 4, at + 8),
      body = bytes.subarray(at + 8, at + 8 + size);
    if (name === "IHDR") [width, height, depth, kind] = [body.readUInt32BE(0), body.readUInt32BE(4), body[8], body[9]];
    if (name === "IDAT") parts.push(body);
    at += size + 12;
  }
  const channels = { 0: 1, 2: 3, 4: 2, 6: 4 }[kind],
    pixel = (channels * depth) / 8,
    row = width * pixel;
  const raw = inflateSync(Buffer.concat(parts)),
    out = Buffer.alloc(row * height);
  for (let y = 0; y < height; ++y) {
    const filter = raw[y * (row + 1)];
    for (let x = 0; x < row; ++x) {
      const left = x >= pixel ? out[y * row + x - pixel] : 0,
        up = y ? out[(y - 1) * row + x] : 0,
        corner = x >= pixel && y ? out[(y - 1) * row + x - pixel] : 0;
      out[y * row + x] = (raw[y * (row + 1) + 1 + x] + [0, left, up, (left + up) >> 1, paeth(left, up, corner)][filter]) & 255;
    }
  }
  const data = depth === 16 ? Array.from({ length: out.length / 2 }, (_, i) => out.readUInt16BE(2 * i)) : out;
  return { width, height, channels, data };
}

function paeth(a, b, c) {
  const p = a + b - c,
    [pa, pb, pc] = [Math.abs(p - a), Math.abs(p - b), Math.abs(p - c)];
  return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}
