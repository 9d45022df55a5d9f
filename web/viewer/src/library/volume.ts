/** The library for programs: an open volume or model, with the calls of the page that need no picture on a screen. */

import type { FileBytes, LibraryCalls, OpenOptions, VolumeInfo } from "../engine";
import { errorOf, SvtError } from "../engine/errors";

/** A file: its address or, in Node.js, its path; a file of the visitor; or bytes with a name. The name shows the format of a model. */
export type Source = string | URL | File | { name: string; bytes: ArrayBuffer | Uint8Array };

export interface OpenSettings extends OpenOptions {
  /** Called while the file is read; `done` is 0 to 1. */
  onProgress?: (step: string, done: number) => void;
  /** Browsers: address of the folder with worker.js and the files next to it, for bundlers that do not copy them. */
  assets?: string;
}

/** Calls that need a picture on a screen, or that only the page makes. */
type NotHere =
  | "pick"
  | "along"
  | "stand"
  | "step"
  | "places"
  | "cityInfo"
  | "prepare"
  | "movedPlanes"
  | "findInAttributes"
  | "attributeValues"
  | "fieldList"
  | "fieldAt"
  | "fieldRows";

/** Rejected promises carry an SvtError: a code and a message. */
export interface Volume extends Omit<LibraryCalls, NotHere> {
  readonly info: VolumeInfo;
  /** Frees the memory. Later calls are rejected. */
  close(): void;
}

const kCallNames = ["compose", "select", "properties", "view", "picture", "labels", "drawing", "owners", "legend", "sheets"] as const;
type CallName = (typeof kCallNames)[number];

export function volumeOf(info: VolumeInfo, call: (name: CallName, args: unknown[]) => Promise<unknown>, close: () => void): Volume {
  const calls = Object.fromEntries(
    kCallNames.map((name) => [
      name,
      (...args: unknown[]) =>
        call(name, args).catch((error: unknown) => {
          throw errorOf(error);
        }),
    ]),
  );
  return { ...(calls as unknown as Pick<LibraryCalls, CallName>), info, close };
}

export function sourcesOf(given: Source | readonly Source[]): readonly Source[] {
  const list = Array.isArray(given) ? (given as readonly Source[]) : [given as Source];
  if (!list.length) throw new SvtError("E904", "no file to open");
  return list;
}

/** The bytes of a source that has them; null: an address or a path. The bytes are copied, because the library takes them. */
export async function bytesOf(source: Source): Promise<FileBytes | null> {
  if (typeof source === "string" || source instanceof URL) return null;
  if (source instanceof Blob) return { name: source.name, bytes: await source.arrayBuffer() };
  const { name, bytes } = source;
  return { name, bytes: bytes instanceof ArrayBuffer ? bytes.slice(0) : (bytes.slice().buffer as ArrayBuffer) };
}

/** The bytes of an address. */
export async function fetched(address: URL): Promise<FileBytes> {
  const response = await fetch(address).catch((error: Error) => {
    throw new SvtError("E101", `${address.href}: it cannot be fetched (${error.message})`);
  });
  if (!response.ok) throw new SvtError("E101", `${address.href}: it cannot be fetched (status ${response.status})`);
  return { name: address.pathname.replace(/^.*\//, ""), bytes: await response.arrayBuffer() };
}
