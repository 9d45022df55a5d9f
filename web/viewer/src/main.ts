/** Start: engine and model are fetched at once, while the page is built. */

import { canvas, creating, listing } from "./early";
import "./ui/theme.css";
import "./app";
import type { App } from "./app";
import { openFiles, openKept, openModel } from "./opening";
import { Session } from "./session";
import { stateOfHash } from "./state/link";
import { initialState, type ViewState } from "./state/view_state";
import { t } from "./texts";
import { startTheme, theme } from "./ui/theme";
import { createServerEngine } from "./engine_server";
import type { Engine, EngineError } from "./engine";

const session = new Session();
const starting = startEngine();

startTheme(() => session.set({ look: theme() === "dark" ? "dark" : "plain" }));
session.setLanguage();
session.state = initialState(theme() === "dark" ? "dark" : "plain");

const app = document.createElement("svt-app") as App;
app.session = session;
app.canvas = canvas;
app.onFiles = (files) => void openFiles(session, files);
app.onModel = (name) => void openModel(session, name);
document.body.append(app);
addEventListener("hashchange", () => void follow());
void start();
loadComponents();

/** Splitters, sliders etc. are loaded after the first picture, which they would delay. */
function loadComponents(): void {
  const load = () => {
    clearTimeout(timer);
    session.removeEventListener("change", look);
    void import("./ui/components");
    void session.findLanguages();
  };
  const look = () => (session.report || session.status === "empty") && load();
  const timer = setTimeout(load, 1500);
  session.addEventListener("change", look);
}

/** The library in the browser; else pictures from the server. */
async function startEngine(): Promise<Engine> {
  try {
    return await creating;
  } catch (error) {
    const server = await createServerEngine(canvas);
    if (!server) throw error;
    session.isServerOnly = true;
    return server;
  }
}

/** The address of the page has a view that cannot be read. */
let isDamaged = false;

async function start(): Promise<void> {
  const linked = linkedState();
  const list = await listing;
  session.models = list.models;
  if (list.chosen) {
    session.status = "loading";
    session.progress = { text: t("starting"), share: -1 };
    session.changed();
  }
  let engine: Engine;
  try {
    engine = await starting;
  } catch (error) {
    session.progress = null;
    session.status = "empty";
    return session.fail({ message: `${t("cannotRun")} ${(error as EngineError).message ?? ""}` });
  }
  session.start(engine);
  const file = new URLSearchParams(location.search).get("file");
  if (file !== null) {
    const state = await linked;
    if (await openKept(session, file, state)) return;
    session.awaited = { file, state };
  }
  if (list.chosen) await openModel(session, list.chosen.name, file === null ? await linked : null, list.bytes, list.files);
  if (list.note) session.tell(list.note);
  // Opening a model clears messages.
  if (isDamaged) session.fail({ message: t("badLink") });
  if (file !== null) session.tell(t("awaitsFile", { name: file }));
}

async function linkedState(): Promise<ViewState | null> {
  try {
    return await stateOfHash(location.hash, session.state);
  } catch {
    isDamaged = true;
    return null;
  }
}

/** Opens a link pasted into the open page. */
async function follow(): Promise<void> {
  isDamaged = false;
  const state = await linkedState();
  if (isDamaged) session.fail({ message: t("badLink") });
  if (state && session.info) session.set(state);
}
