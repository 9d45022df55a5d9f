/** The files of a report. */

import type { EngineError, FileBytes } from "../engine";
import type { Source } from "../session/refining";
import { inLanguage } from "../texts";

const kFileTexts = {
  fileLost: [
    "{name}: the file cannot be read again; open it again.",
    "{name}: Die Datei lässt sich nicht noch einmal lesen; öffnen Sie sie erneut.",
  ],
  fileEmpty: ["{name}: the file is empty.", "{name}: Die Datei ist leer."],
} as const satisfies Record<string, readonly [string, string]>;

/** The English of these texts, for translation in a language file. */
export function fileTemplate(): Record<string, string> {
  return Object.fromEntries(Object.entries(kFileTexts).map(([key, [english]]) => [key, english]));
}

/** Fetches files. Rejects with the reason, also if one of them is empty. @param name  of all of them, for messages */
export async function filesOf(source: Source, name: string): Promise<FileBytes[]> {
  let files: FileBytes[];
  try {
    files = await source();
  } catch (error) {
    // A download states its reason; a file of the user that was moved or deleted does not.
    const { message } = error as EngineError;
    throw error instanceof Error || !message ? { message: inLanguage("fileLost", kFileTexts.fileLost, { name }) } : error;
  }
  const empty = files.find(({ bytes }) => !bytes.byteLength);
  if (empty) throw { message: inLanguage("fileEmpty", kFileTexts.fileEmpty, { name: empty.name }) };
  return files;
}
