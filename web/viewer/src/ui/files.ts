/** File downloads, and text for the clipboard. */

const kKinds: Record<string, string> = {
  svg: "image/svg+xml",
  png: "image/png",
  csv: "text/csv",
  json: "application/json",
  geojson: "application/geo+json",
  zip: "application/zip",
  bcf: "application/octet-stream",
};

export function save(data: ArrayBuffer | string, name: string): void {
  const kind = kKinds[name.split(".").pop() ?? ""] ?? "application/octet-stream";
  const url = URL.createObjectURL(new Blob([data], { type: kind }));
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 30_000);
}

/** False if the browser does not allow it. */
export async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}

/** An SVG as a picture, with `scale` pixels per CSS pixel. */
export async function pngOf(svg: ArrayBuffer, scale: number): Promise<ArrayBuffer> {
  const url = URL.createObjectURL(new Blob([svg], { type: kKinds["svg"]! }));
  try {
    const image = new Image();
    image.src = url;
    await image.decode();
    const canvas = new OffscreenCanvas(Math.ceil(image.naturalWidth * scale), Math.ceil(image.naturalHeight * scale));
    canvas.getContext("2d")!.drawImage(image, 0, 0, canvas.width, canvas.height);
    return await (await canvas.convertToBlob({ type: "image/png" })).arrayBuffer();
  } finally {
    URL.revokeObjectURL(url);
  }
}

/** A ZIP archive, not compressed, dated 1980-01-01, so that equal files give equal bytes. A name that ends with / is a folder. */
export function zipOf(files: { name: string; text: string | Uint8Array }[]): ArrayBuffer {
  const parts: Uint8Array[] = [],
    directory: Uint8Array[] = [];
  const encoder = new TextEncoder();
  let offset = 0;
  for (const file of files) {
    const name = encoder.encode(file.name),
      data = typeof file.text === "string" ? encoder.encode(file.text) : file.text;
    // Shared by both headers: version, flags, method, time and date, checksum, sizes, length of the name, of extra fields.
    const common = new DataView(new ArrayBuffer(26));
    common.setUint16(0, 20, true);
    common.setUint16(8, 0x21, true);
    common.setUint32(10, checksumOf(data), true);
    common.setUint32(14, data.length, true);
    common.setUint32(18, data.length, true);
    common.setUint16(22, name.length, true);
    const shared = new Uint8Array(common.buffer);
    parts.push(Uint8Array.of(0x50, 0x4b, 3, 4), shared, name, data);
    const rest = new DataView(new ArrayBuffer(14));
    rest.setUint32(10, offset, true);
    directory.push(Uint8Array.of(0x50, 0x4b, 1, 2, 20, 0), shared, new Uint8Array(rest.buffer), name);
    offset += 30 + name.length + data.length;
  }
  const size = directory.reduce((sum, part) => sum + part.length, 0);
  const end = new DataView(new ArrayBuffer(22));
  end.setUint32(0, 0x06054b50, true);
  end.setUint16(8, files.length, true);
  end.setUint16(10, files.length, true);
  end.setUint32(12, size, true);
  end.setUint32(16, offset, true);
  const all = new Uint8Array(offset + size + 22);
  let at = 0;
  for (const part of [...parts, ...directory, new Uint8Array(end.buffer)]) {
    all.set(part, at);
    at += part.length;
  }
  return all.buffer;
}

/** Size limit of an unpacked archive, bytes. */
const kMostUnpacked = 64 << 20;

/** The files of a ZIP archive, stored or deflated, by name. Rejects other files, and archives that are too big. */
export async function unzipped(bytes: ArrayBuffer): Promise<Map<string, Uint8Array>> {
  const view = new DataView(bytes);
  let end = bytes.byteLength - 22;
  while (end >= 0 && view.getUint32(end, true) !== 0x06054b50) --end;
  if (end < 0) throw new Error("no ZIP archive");
  const files = new Map<string, Uint8Array>();
  let at = view.getUint32(end + 16, true),
    room = kMostUnpacked;
  for (let n = view.getUint16(end + 10, true); n > 0; --n) {
    if (view.getUint32(at, true) !== 0x02014b50) throw new Error("damaged ZIP archive");
    const method = view.getUint16(at + 10, true),
      packed = view.getUint32(at + 20, true);
    const nameLength = view.getUint16(at + 28, true),
      rest = view.getUint16(at + 30, true) + view.getUint16(at + 32, true);
    const name = new TextDecoder().decode(new Uint8Array(bytes, at + 46, nameLength));
    const header = view.getUint32(at + 42, true);
    const from = header + 30 + view.getUint16(header + 26, true) + view.getUint16(header + 28, true);
    const data = new Uint8Array(bytes, from, packed);
    if (method !== 0 && method !== 8) throw new Error(`compressed by method ${method}`);
    const content = method === 0 ? data : await inflated(data, room);
    room -= content.length;
    if (room < 0) throw new Error("too big");
    files.set(name.replace(/\\/g, "/"), content);
    at += 46 + nameLength + rest;
  }
  return files;
}

async function inflated(data: Uint8Array<ArrayBuffer>, most: number): Promise<Uint8Array> {
  const reader = new Blob([data]).stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader();
  const parts: Uint8Array<ArrayBuffer>[] = [];
  for (let size = 0; ;) {
    const { done, value } = await reader.read();
    if (done) return new Uint8Array(await new Blob(parts).arrayBuffer());
    size += value.length;
    if (size > most) throw new Error("too big");
    parts.push(value as Uint8Array<ArrayBuffer>);
  }
}

/** CRC-32 of ISO 3309. */
function checksumOf(data: Uint8Array): number {
  let sum = 0xffffffff;
  for (const byte of data) {
    sum ^= byte;
    for (let bit = 0; bit < 8; ++bit) sum = (sum >>> 1) ^ (sum & 1 ? 0xedb88320 : 0);
  }
  return ~sum >>> 0;
}
