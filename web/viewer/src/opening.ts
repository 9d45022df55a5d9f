/** Opens listed models and user files. */

import { CityFiles } from "./city/city_files";
import { Download } from "./download";
import { kModelEndings } from "./generated/model_endings";
import { effect, untracked } from "./observable";
import type { Session } from "./session";
import type { ListedModel } from "./session/open_volume";
import { keptFile } from "./state/kept_files";
import type { ViewState } from "./state/view_state";
import { bytes as bytesText, t } from "./texts";

export interface ModelList {
  models: ListedModel[];
  chosen: ListedModel | null;
  /** Pending download of the chosen model. */
  bytes: Download | null;
  /** The files of a chosen city, of which the first are being fetched. */
  files: CityFiles | null;
  note: string | null;
}

/** The models in `models.json` next to the page; starts the download of the chosen one at once. */
export async function readModels(wanted: string | null): Promise<ModelList> {
  const models = await listed();
  const chosen = models.find((model) => model.name === wanted) ?? models[0] ?? null;
  const note = wanted !== null && chosen && chosen.name !== wanted ? t("noModel", { name: wanted }) : null;
  const files = chosen?.city ? filesOf(chosen) : null;
  void files?.begin();
  const bytes = chosen && !files ? new Download(chosen.file, chosen.bytes) : null;
  return { models, chosen, bytes, files, note };
}

async function listed(): Promise<ListedModel[]> {
  try {
    const response = await fetch("models.json");
    if (!response.ok) return [];
    const { models } = (await response.json()) as { models?: unknown };
    if (!Array.isArray(models)) return [];
    return models.filter((m): m is ListedModel => typeof m?.name === "string" && typeof m?.file === "string");
  } catch {
    return [];
  }
}

function filesOf(model: ListedModel): CityFiles {
  return new CityFiles(new URL(model.file.replace(/\/*$/, "/"), location.href).href);
}

/** Opens a listed model or city; false if that fails. */
export async function openModel(
  session: Session,
  name: string,
  state: ViewState | null = null,
  coming: Download | null = null,
  files: CityFiles | null = null,
): Promise<boolean> {
  const { model, volume, messages } = session;
  const listed = volume.models.find((m) => m.name === name);
  if (!listed) return false;
  const title = listed.title || listed.name;
  const fileName = listed.file.split("/").pop()!.split("?")[0]!;
  // Kept, so that the model can be read again without a connection.
  let kept: Blob;
  const again = async () => [{ name: fileName, bytes: await kept.arrayBuffer() }];
  const fetched = async (signal: AbortSignal) => {
    const download = coming ?? new Download(listed.file, listed.bytes);
    signal.addEventListener("abort", () => download.cancel());
    const unwatch = effect(() => {
      const { done, all } = download;
      if (done > 0 && all > kSlowBytes) untracked(() => (messages.progress = progressOf(title, done, all)));
    });
    kept = await download.blob.finally(unwatch);
    return again();
  };
  const isOpen =
    listed.city && !volume.isServerOnly
      ? await model.openCity(title, files ?? filesOf(listed), state)
      : await model.open(title, fetched, again, state);
  if (!isOpen) return false;
  volume.name = listed.name;
  volume.isLocal = false;
  return true;
}

/** Smaller files come too quickly for their progress to be of interest. */
const kSlowBytes = 1e6;

function progressOf(name: string, done: number, all: number) {
  const text = `${t("loadingFile", { name })}: ${t("loadedBytes", { done: bytesText(done), all: bytesText(all) })}`;
  return { text, share: Math.min(1, done / all) };
}

/** File types that the library reads: volumes and models; each also compressed by gzip. */
export const kFileKinds = [".svt", ...kModelEndings];

/**
 * Opens files of the user. Several models become one. A table gives owners to the open volume, or is opened with the files.
 * @param state  null: a new view
 * @return false if the models could not be opened
 */
export async function openFiles(session: Session, files: File[], state: ViewState | null = null): Promise<boolean> {
  const tables = files.filter(({ name }) => /\.(csv|tsv)$/i.test(name)),
    models = files.filter((file) => !tables.includes(file));
  for (const { name } of models) {
    const plain = name.toLowerCase().replace(/\.gz$/, "");
    if (kFileKinds.some((kind) => plain.endsWith(kind))) continue;
    session.messages.fail({ message: t("wrongKind", { name, kinds: kFileKinds.join(", ") }) }, t("failedTitle"));
    return false;
  }
  const isOpen = models.length > 0 ? await openLocal(session, models, state) : session.volume.info !== null;
  for (const table of tables) {
    try {
      await session.model.owners.give(await table.arrayBuffer(), table.name);
    } catch (error) {
      session.messages.fail(error, t("failedTitle"));
    }
  }
  return isOpen;
}

/** Opens a file that was stored in this browser; false if it is no longer there. */
export async function openKept(session: Session, name: string, state: ViewState | null): Promise<boolean> {
  const data = await keptFile(name);
  if (!data) return false;
  session.model.awaited = { file: name, state };
  await openLocal(session, [new File([data], name)]);
  return true;
}

async function openLocal(session: Session, files: File[], given: ViewState | null = null): Promise<boolean> {
  const { model, volume, messages } = session;
  const name = files.map((file) => file.name).join(", ");
  const state = model.awaited?.file === name ? model.awaited.state : given;
  const read = () => Promise.all(files.map(async (file) => ({ name: file.name, bytes: await file.arrayBuffer() })));
  const fetched = () => {
    messages.progress = { text: t("loadingFile", { name }), share: -1 };
    return read();
  };
  if (!(await model.open(name, fetched, read, state))) return false;
  volume.name = "";
  volume.isLocal = true;
  model.awaited = null;
  return true;
}
