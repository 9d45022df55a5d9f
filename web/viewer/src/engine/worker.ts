/** The worker: owns the library and the open volume, and answers the page's requests in order. */
import type { SvtModule } from "../../../../build/web/svt_view.js";
import { fieldFileOf, fieldOf, json, makeCall, needsFont, needsWhole, openFiles } from "./calls";
import { Drawer } from "./drawer";
import { isEngineError } from "./errors";
import { loadModule, loadWhole, prepareWhole } from "./module";
import type { CityLook, EngineError, VolumeInfo } from "../engine";
import type { Answer, Calls, CityNeeds, Request } from "./protocol";

/** Idle time of the page before longer work starts. */
const idleMilliseconds = 700;

const onProgress = (step: string, done: number) => post({ id: current, step, done });
/** The module in use. */
let loaded = loadModule("view", onProgress, (received, all) => post({ received, all }));
// The code that awaits it handles a rejection; an unhandled one must not end the worker.
loaded.catch(() => undefined);
let isWhole = false;
/** The open volume, from which the whole module continues. */
let opened: {
  files: Calls["open"]["args"][0];
  options: Calls["open"]["args"][1];
  owners: Calls["owners"]["args"] | null;
  hasMeshes: boolean;
} | null = null;

/** The open `.svt`, if it has fields, and the field that the module has read; empty: none. */
let fieldFile: ArrayBuffer | null = null;
let openField = "";

let drawer: Drawer | null = null;
/** Id of the current request. */
let current = 0;
/** The open part of a city. */
let cityInfo: VolumeInfo | null = null;
/** Failure of the library outside any request; reported to the next request. */
let stopped: unknown = null;

function post(answer: Answer, transfer: Transferable[] = []): void {
  self.postMessage(answer, { transfer });
}

function drawerOf(svt: SvtModule): Drawer {
  return (drawer ??= new Drawer(svt, null));
}

/** Loads what later calls need. Resolves to true if the whole module is there. */
async function prepare(drawer: Drawer): Promise<boolean> {
  const isThere = isWhole || (await prepareWhole());
  if (isThere && !isWhole) await drawer.fontBytes().catch(() => undefined);
  return isThere;
}

/** The whole module with the open volume in place of the module that draws only. */
async function continueInWhole(name: string): Promise<void> {
  const isOfCity = name === "cityDrawing";
  if (!opened && !isOfCity) throw { code: "E904", message: "drawings and sheets need an open volume, not a city" } satisfies EngineError;
  const svt = await loadWhole(onProgress);
  if (opened) openFiles(svt, opened.files, opened.options);
  if (opened?.owners) makeCall(svt, "owners", opened.owners);
  await adopt(svt);
}

async function adopt(svt: SvtModule): Promise<void> {
  const before = await loaded;
  await drawerOf(before).moveTo(svt);
  before.close();
  loaded = Promise.resolve(svt);
  isWhole = true;
  opened = null;
  openField = "";
}

/** Reads a field that a call needs, unless the module has it. */
function readField(svt: SvtModule, field: string | null): void {
  if (field === null || field === openField) return;
  if (!fieldFile) throw { code: "E904", message: `the open model has no field '${field}'` } satisfies EngineError;
  openField = "";
  svt.call("fieldOpen", [field], new Uint8Array(fieldFile));
  openField = field;
}

async function answer(request: Request): Promise<void> {
  const { id, name, args } = request;
  await loaded;
  if (stopped) throw stopped;
  current = id;
  const isTooMuch = !isWhole && needsWhole(name, args, opened?.hasMeshes ?? false);
  if (isTooMuch && name !== "open") await continueInWhole(name);
  const svt = await loaded;
  readField(svt, fieldOf(name, args));
  switch (name) {
    case "start":
      drawer = new Drawer(svt, args[0]);
      return post({ id, result: { kind: drawer.kind, threads: json(svt.call("threads", [])) } });
    case "open": {
      const own = isTooMuch ? await loadWhole(onProgress) : svt;
      // If this fails, the open volume stays.
      const info = openFiles(own, ...args);
      drawerOf(svt).forgetPicture();
      fieldFile = fieldFileOf(args[0]);
      openField = "";
      if (own !== svt) await adopt(own);
      else if (!isWhole) opened = { files: args[0], options: args[1], owners: null, hasMeshes: info.hasMeshes };
      return post({ id, result: fieldFile ? { ...info, hasFields: true } : info });
    }
    case "fieldList":
      return post({ id, result: fieldFile ? json(svt.call(name, [], new Uint8Array(fieldFile))) : [] });
    case "fieldAt":
    case "fieldRows":
      return post({ id, result: json(svt.call(name, args.slice(1))) });
    case "draw": {
      const drawn = await drawerOf(svt).draw(...args);
      return post({ id, result: drawn }, [drawn.bitmap]);
    }
    case "cityDrop":
      drawerOf(svt).forgetPicture();
      cityInfo = null;
      opened = null;
      return post({ id, result: json(svt.call(name, args)) });
    case "prepare":
      // Other requests do not wait for the module.
      void prepare(drawerOf(svt)).then((result) => post({ id, result }));
      return;
    case "cityInfo":
      return post({ id, result: cityInfo });
    case "cityLook": {
      const look = json<CityLook | CityNeeds>(svt.call(name, args));
      if ("needs" in look) return post({ id, result: look });
      if (args[0]) drawerOf(svt).forgetPicture();
      if (look.info) cityInfo = look.info;
      opened = null;
      return post({ id, result: look.info && args[4].isMoving ? { ...look, info: { ...look.info, features: [] } } : look });
    }
    default: {
      if (needsFont(name, args)) await drawerOf(svt).fetchFont();
      if (name === "owners" && opened) opened.owners = args;
      const result = makeCall(svt, name, args) as Calls[typeof name]["result"];
      return post({ id, result }, result instanceof ArrayBuffer ? [result] : []);
    }
  }
}

/** Any error that is not an error of the library leaves the module in an undefined state. */
function fail(id: number, error: unknown): void {
  if (isEngineError(error)) return post({ id, error: { code: error.code, message: error.message }, isDead: false });
  const message = error instanceof Error ? error.message : String(error);
  post({ id, error: { code: "E999", message: `the library has stopped (${message}); open the model again` }, isDead: true });
}

// Processes requests one by one in order, although some answers take several turns of the event loop.
let queue = Promise.resolve();
let idleTimer: ReturnType<typeof setTimeout> | undefined;
self.onmessage = (event: MessageEvent<Request>) => {
  const request = event.data;
  clearTimeout(idleTimer);
  queue = queue
    .then(() => answer(request))
    .catch((error: unknown) => fail(request.id, error))
    .then(() => {
      clearTimeout(idleTimer);
      if (drawer?.isWaiting) idleTimer = setTimeout(onIdle, idleMilliseconds);
    });
};

function onIdle(): void {
  try {
    drawer?.onIdle();
  } catch (error) {
    stopped = error;
  }
}
