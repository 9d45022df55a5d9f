/** Start: fetches engine and model at once, while the page is built. */

import { arrival, canvas, creating, listing } from "./early";
import "./ui/theme.css";
import "./app";
import type { App } from "./app";
import { openFiles, openKept, openModel } from "./opening";
import { effect, untracked, until } from "./observable";
import { Session } from "./session";
import { stateOfHash } from "./state/link";
import { initialState, type ViewState } from "./state/view_state";
import { t } from "./texts";
import { startTheme, theme } from "./ui/theme";
import type { Engine, EngineError } from "./engine";

/** Milliseconds after which the components load even without a first picture. */
const kComponentsAfter = 10_000;

const session = new Session();
session.address.keep();
const memory = Number(new URLSearchParams(location.search).get("memory"));
if (memory > 0) session.model.memory = Math.max(16, memory) * 1e6;
effect(() => {
  const { info } = session.volume;
  if (info) document.title = `${info.name || info.source} - SVT`;
});
const starting = startEngine();

startTheme(() => session.view.set({ look: theme() === "dark" ? "dark" : "plain" }));
session.languages.speak();
session.view.state = initialState(theme() === "dark" ? "dark" : "plain");

const app = document.createElement("svt-app") as App;
app.session = session;
app.canvas = canvas;
app.onFiles = (files) => void openFiles(session, files);
app.onModel = (name) => void openModel(session, name);
app.arrival = arrival;
/** The picture of a published page (addPageHead() in svt/serve/site.cpp); it shows the first model. */
const preview = document.querySelector<HTMLImageElement>("#preview");
preview?.remove();
if (preview && !new URLSearchParams(location.search).has("model")) app.preview = preview.src;
document.body.append(app);
addEventListener("hashchange", () => void follow());
void start();
loadComponents();

/** Loads splitters, sliders and similar parts after the first picture, which they would delay. */
function loadComponents(): void {
  const isPast = new Promise((done) => setTimeout(done, kComponentsAfter));
  const isSeen = until(() => session.picture.report !== null || session.model.status === "empty");
  void Promise.race([isPast, isSeen]).then(() => {
    void import("./ui/components");
    void import("./canvas/view_cube");
    void session.languages.find();
  });
}

/** Loads the rest of the library once a picture is fine; then pictures have faces. Cities need it only for models opened later. */
effect(() => {
  if (session.picture.quality === "fine" && !session.volume.isCity) untracked(() => void session.prepareFaces());
});
/** Loads the other scripts, so that the page then needs no connection. A page in one text contains them (svtModuleOf). */
void until(() => session.picture.quality === "fine").then(async () => {
  if (!("svtModuleOf" in self) && !(navigator as { connection?: { saveData?: boolean } }).connection?.saveData)
    await import("./late").then(({ loadLate }) => loadLate()).catch(() => undefined);
});

/** The library in the browser; else pictures from the server. */
async function startEngine(): Promise<Engine> {
  try {
    return await creating;
  } catch (error) {
    const { createServerEngine } = await import("./engine_server");
    const server = await createServerEngine(canvas);
    if (!server) throw error;
    session.volume.isServerOnly = true;
    return server;
  }
}

/** The address of the page has a view that cannot be read. */
let isDamaged = false;

async function start(): Promise<void> {
  const linked = linkedState();
  const list = await listing;
  session.volume.models = list.models;
  if (preview && list.chosen && list.chosen === list.models[0]) app.preview = preview.src;
  if (list.chosen) {
    session.model.status = "loading";
    session.messages.progress = { text: t("starting"), share: -1 };
  }
  let engine: Engine;
  try {
    engine = await starting;
  } catch (error) {
    session.messages.progress = null;
    session.model.status = "empty";
    return session.messages.fail({ message: `${t("cannotRun")} ${(error as EngineError).message ?? ""}` });
  }
  session.start(engine);
  const wanted = new URLSearchParams(location.search);
  const file = wanted.get("file"),
    newState = wanted.get("new");
  if (file !== null) {
    const state = await linked;
    if (await openKept(session, file, state)) return;
    session.model.awaited = { file, state };
  }
  const state = file === null && newState === null ? await linked : null;
  if (list.chosen) await openModel(session, list.chosen.name, state, list.bytes, list.files);
  if (newState !== null) app.compare([], { old: wanted.get("old") ?? "", new: newState, state: await linked });
  else if (list.note) session.messages.tell(list.note, "closed");
  // Opening a model clears messages.
  if (isDamaged) session.messages.fail({ message: t("badLink") });
  if (file !== null) session.messages.tell(t("awaitsFile", { name: file }), "closed");
}

async function linkedState(): Promise<ViewState | null> {
  try {
    return await stateOfHash(location.hash, session.view.state);
  } catch {
    isDamaged = true;
    return null;
  }
}

/** Opens a link pasted into the open page. */
async function follow(): Promise<void> {
  isDamaged = false;
  const state = await linkedState();
  if (isDamaged) session.messages.fail({ message: t("badLink") });
  if (state && session.volume.info) session.view.set(state);
}
