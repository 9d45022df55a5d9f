/** Opens listed models and user files. */

import type { ListedModel, Session } from "./session";
import type { ViewState } from "./state/view_state";
import { bytes as bytesText, t } from "./texts";

export interface ModelList {
  models: ListedModel[];
  chosen: ListedModel | null;
  /** Pending download of the chosen model. */
  bytes: Promise<Response> | null;
  note: string | null;
}

/** The models listed in `models.json` next to the page; the download of the chosen one starts at once. */
export async function readModels(wanted: string | null): Promise<ModelList> {
  const models = await listed();
  const chosen = models.find((model) => model.name === wanted) ?? models[0] ?? null;
  const note = wanted !== null && chosen && chosen.name !== wanted ? t("noModel", { name: wanted }) : null;
  const bytes = chosen ? fetch(chosen.file) : null;
  bytes?.catch(() => undefined);
  return { models, chosen, bytes, note };
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

export async function openModel(session: Session, name: string, state: ViewState | null = null, coming: Promise<Response> | null = null): Promise<void> {
  const model = session.models.find((m) => m.name === name);
  if (!model) return;
  const title = model.title || model.name;
  let data: ArrayBuffer;
  try {
    const response = await (coming ?? fetch(model.file));
    if (!response.ok) throw { message: t("notLoaded", { name: model.file, status: response.status }) };
    data = await received(response, model.bytes, (done) => {
      const text = `${t("loadingFile", { name: title })}: ${t("loadedBytes", { done: bytesText(done), all: bytesText(model.bytes || done) })}`;
      session.progress = { text, share: model.bytes ? done / model.bytes : -1 };
      session.changed();
    });
  } catch (error) {
    session.progress = null;
    if (session.status === "loading") session.status = "empty";
    return session.fail(error, t("failedTitle"));
  }
  const fileName = model.file.split("/").pop()!.split("?")[0]!;
  const again = async () => (await fetch(model.file)).arrayBuffer();
  if (await session.open(data, fileName, again, state)) session.modelName = model.name;
  session.changed();
}

/** The bytes of a response, with progress for slow downloads. */
async function received(response: Response, expected: number, progress: (done: number) => void): Promise<ArrayBuffer> {
  if (!response.body || !(expected > 1e6)) return response.arrayBuffer();
  const reader = response.body.getReader();
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let done = 0, told = 0;
  for (;;) {
    const { done: isEnd, value } = await reader.read();
    if (isEnd) return new Blob(parts).arrayBuffer();
    parts.push(value as Uint8Array<ArrayBuffer>);
    done += value.length;
    if (performance.now() - told > 100) {
      told = performance.now();
      progress(done);
    }
  }
}

export async function openFile(session: Session, file: File): Promise<void> {
  if (!/\.(svt|gml|xml|json|citygml|cityjson)(\.gz)?$/i.test(file.name)) return session.fail({ message: t("wrongKind", { name: file.name }) }, t("failedTitle"));
  session.progress = { text: t("loadingFile", { name: file.name }), share: -1 };
  session.changed();
  try {
    const data = await file.arrayBuffer();
    if (await session.open(data, file.name, () => file.arrayBuffer())) session.modelName = "";
  } catch (error) {
    session.fail(error, t("failedTitle"));
  }
  session.progress = null;
  session.changed();
}
