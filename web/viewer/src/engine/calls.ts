/** Calls of the module that need nothing of a browser: arguments in, answers out. Shared by the worker and by Node.js. */
import type { SvtModule } from "../../../../build/web/svt.js";
import type { FileBytes, LibraryCalls, OpenOptions, Scene, VolumeInfo } from "../engine";

/** Calls whose answers are bytes; all others answer with JSON. */
const kOfBytes: ReadonlySet<string> = new Set<keyof LibraryCalls>(["picture", "labels", "drawing"]);

export function json<T>(reply: Uint8Array): T {
  return JSON.parse(new TextDecoder().decode(reply)) as T;
}

/** Copies the bytes, because the reply is in the module's memory. */
function copied(reply: Uint8Array): ArrayBuffer {
  return reply.slice().buffer as ArrayBuffer;
}

export function openFiles(svt: SvtModule, files: readonly FileBytes[], options: OpenOptions): VolumeInfo {
  const sizes = files.map(({ bytes }) => bytes.byteLength);
  return json(svt.call("open", [files.map(({ name }) => name), sizes, options], joined(files)));
}

/** The first bytes of a `.svt`: a ZIP that begins with its media type (docs/formats/svt.md). */
const kMediaType = "mimetypeapplication/vnd.svt+zip";
const kMediaTypeAt = 30;

/**
 * Whether a call needs the whole module: it reads a model, makes a drawing, or draws the faces of the model.
 * @param hasMeshes  the open volume has faces
 */
export function needsWhole(name: string, args: readonly unknown[], hasMeshes: boolean): boolean {
  if (name === "open") return !(args[0] as readonly FileBytes[]).every(isVolume);
  if (fieldOf(name, args) !== null || name === "fieldList") return true;
  if (name === "draw" || name === "picture" || name === "labels") return hasMeshes && (args[0] as Scene).surfaces !== "voxels";
  return name === "drawing" || name === "sheets" || name === "cityDrawing";
}

/** The field that a call shows or reads; null: none. */
export function fieldOf(name: string, args: readonly unknown[]): string | null {
  if (name === "fieldAt" || name === "fieldRows") return args[0] as string;
  const isOfScene = name === "draw" || name === "picture" || name === "labels" || name === "legend";
  return (isOfScene && (args[0] as Scene).field?.name) || null;
}

/** Bytes at the end of a `.svt` that hold its directory. */
const kDirectoryBytes = 1 << 20;

/** The bytes of a single `.svt` with fields, which its directory names; null: other files. */
export function fieldFileOf(files: readonly FileBytes[]): ArrayBuffer | null {
  const [only] = files;
  if (files.length !== 1 || !only || !isVolume(only)) return null;
  const directory = new TextDecoder("latin1").decode(only.bytes.slice(Math.max(0, only.bytes.byteLength - kDirectoryBytes)));
  return directory.includes("fields.json") ? only.bytes : null;
}

function isVolume({ bytes }: FileBytes): boolean {
  const text = new TextDecoder("latin1").decode(bytes.slice(0, kMediaTypeAt + kMediaType.length));
  return text.startsWith("PK\x03\x04") && text.endsWith(kMediaType);
}

/** The bytes of all files, one after the other. */
export function joined(files: readonly FileBytes[]): Uint8Array {
  if (files.length === 1) return new Uint8Array(files[0]!.bytes);
  const all = new Uint8Array(files.reduce((sum, file) => sum + file.bytes.byteLength, 0));
  let at = 0;
  for (const { bytes } of files) {
    all.set(new Uint8Array(bytes), at);
    at += bytes.byteLength;
  }
  return all;
}

/** The answer of a call; an ArrayBuffer among the arguments is passed as its bytes. */
export function makeCall(svt: SvtModule, name: string, args: readonly unknown[]): unknown {
  if (kOfBytes.has(name)) return copied(svt.call(name, args));
  const bytes = args.find((arg) => arg instanceof ArrayBuffer);
  const others = args.filter((arg) => arg !== bytes);
  return json(svt.call(name, others, bytes && new Uint8Array(bytes)));
}

export function hasWords(scene: Scene): boolean {
  const hasLegend = (scene.colorBy || scene.field) && scene.legend !== false;
  return Boolean(scene.names?.length || scene.title || hasLegend || scene.scaleBar || scene.northArrow);
}

/** Whether the module must have the font before a call. */
export function needsFont(name: string, args: readonly unknown[]): boolean {
  if (name === "picture" || name === "labels") return hasWords(args[0] as Scene);
  // The font determines the size of dimension numbers.
  if (name === "drawing") return Boolean((args[2] as { dimensions?: boolean } | undefined)?.dimensions);
  return name === "sheets";
}
