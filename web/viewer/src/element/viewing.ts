/** The viewer of one `<svt-viewer>`: a session of the page without its panels. Loaded when the element needs it. */

import { CityFiles } from "../city/city_files";
import { movedByKey } from "../camera/view_keys";
import type { PickEvent, PictureView } from "../canvas/picture";
import "../canvas/picture";
import type { CameraPreset, Engine, EngineError, Scene } from "../engine";
import { createEngine } from "../engine/client";
import { effect, untracked } from "../observable";
import { Download } from "../download";
import { openFiles, openModel } from "../opening";
import { Session } from "../session";
import { initialState, type Camera, type ViewState } from "../state/view_state";
import { setLanguage, t } from "../texts";
import { changesOf, givenBy, hasOtherCamera, type Attributes, type Given } from "./attributes";
import type { Frame } from "./frame";
import type { PictureSize, SvtViewerEventMap } from "./types";

/** The element, as the viewer needs it. */
export interface ViewingHost {
  attributes: Attributes;
  frame: Frame;
  /** Address of the folder with the worker and its files; empty: next to the script. */
  assets: string;
  isDark(): boolean;
  /** False if a listener has called preventDefault(). */
  send<Name extends keyof SvtViewerEventMap>(name: Name, detail: SvtViewerEventMap[Name]["detail"]): boolean;
}

/** The folder of a city, from its address or that of its index; null: the address of a file. */
function cityFolder(address: string): string | null {
  const [, folder] = /^([^?#]*\/)(?:city\.json)?$/.exec(address) ?? [];
  return folder ?? null;
}

export class Viewing {
  private readonly session = new Session();
  private readonly picture = document.createElement("svt-picture") as PictureView;
  private readonly ended = new AbortController();
  private readonly starting: Promise<Engine>;
  private readonly unwatch: (() => void)[] = [];
  private given: Given;
  /** The last opening; a later one supersedes it. */
  private opening: object | null = null;
  /** The model of the last opening is open, and then also visible. */
  private isOpen = false;
  private isLoaded = false;
  private cameraFrame = 0;

  constructor(private readonly host: ViewingHost) {
    this.given = this.read();
    const canvas = document.createElement("canvas");
    canvas.setAttribute("aria-hidden", "true");
    const place = { mayUseThreads: true, ...(host.assets ? { assets: host.assets } : {}) };
    this.starting = createEngine(canvas, null, place, this.ended.signal);
    this.starting.catch(() => undefined);
    this.session.view.hasSwitches = false;
    this.picture.session = this.session;
    this.picture.canvas = canvas;
    this.picture.addEventListener("svt-pick", (event) => this.picked(event as PickEvent));
    this.picture.addEventListener("keydown", (event) => this.keyDown(event));
    this.setInputs();
    host.frame.stage.replaceChildren(this.picture);
    this.watch();
  }

  /** The model is open, and its first picture is visible. */
  get loaded(): boolean {
    return this.isLoaded;
  }
  get info() {
    return this.isLoaded ? this.session.volume.info : null;
  }
  /** The engine of the loaded model. */
  get engine(): Engine {
    return this.session.volume.engine!;
  }
  get camera(): Camera | null {
    return this.session.view.state.camera;
  }
  get selection(): string[] {
    return this.session.view.state.selection;
  }

  /** Opens an address: a volume, a model, or the folder of a city. */
  async open(address: string): Promise<void> {
    const { volume } = this.session;
    const folder = cityFolder(address);
    const coming = folder ? null : new Download(address, 0);
    this.ended.signal.addEventListener("abort", () => coming?.cancel());
    const files = folder ? new CityFiles(folder) : null;
    void files?.begin();
    const name = nameOf(folder ?? address);
    await this.begin((state) => {
      volume.models = [{ name, file: folder ?? address, bytes: 0, city: folder !== null }];
      return openModel(this.session, name, state, coming, files);
    });
  }

  /** Opens files of the visitor. Several models become one. */
  async openFiles(files: File[]): Promise<void> {
    await this.begin((state) => openFiles(this.session, files, state));
  }

  private async begin(open: (state: ViewState) => Promise<boolean>): Promise<void> {
    const opening = (this.opening = {});
    const { session, host } = this;
    this.isLoaded = this.isOpen = false;
    session.messages.message = null;
    session.messages.progress = { text: t("starting"), share: -1 };
    try {
      const engine = await this.starting;
      if (this.opening !== opening) return;
      if (!session.volume.engine) session.start(engine);
    } catch (error) {
      if (this.opening !== opening) return;
      session.messages.progress = null;
      return session.messages.fail({ ...(error as EngineError), message: `${t("cannotRun")} ${(error as EngineError).message}` });
    }
    this.given = this.read();
    session.view.framing = this.given.framing;
    const isOpen = await open({ ...initialState(), ...this.given.view, camera: this.given.camera });
    if (this.opening !== opening) return;
    this.isOpen = isOpen;
    if (isOpen) return this.loadedNow();
    session.messages.progress = null;
    // The session keeps the model before, but it is not the one that is asked for.
    host.frame.isShown = false;
  }

  /** Attributes have changed. */
  update(): void {
    const before = this.given;
    const { session } = this;
    if (this.isOpen) session.messages.message = null;
    const given = (this.given = this.read());
    this.setInputs();
    if (!this.isOpen) return;
    const changes = changesOf(before.view, given.view);
    if (Object.keys(changes).length) session.view.set(changes);
    if (!hasOtherCamera(before, given)) return;
    session.view.framing = given.framing;
    if (given.camera) session.view.moveTo(given.camera);
    else void session.view.goTo(given.framing.around, given.view.preset, true, given.framing);
  }

  async goTo(preset: CameraPreset | null, query: string): Promise<void> {
    await this.session.view.goTo(query, preset);
  }

  setCamera(camera: Partial<Camera>): void {
    const now = this.camera;
    if (now) this.session.view.moveTo({ ...now, ...camera });
  }

  /** The scene for `svt render --scene`. */
  async scene({ width, height }: PictureSize): Promise<Scene> {
    const { view } = this.session;
    const [w, h] = view.size;
    const size: [number, number] = [
      width ?? (height ? Math.round((height * w) / h) : w),
      height ?? (width ? Math.round((width * h) / w) : h),
    ];
    return view.composed(size);
  }

  /** Selects features, and resolves to their ids. */
  async select(query: string): Promise<string[]> {
    const ids = query ? await this.engine.select(query) : [];
    this.session.selection.select(ids);
    return ids;
  }

  focus(): void {
    this.picture.focus();
  }

  /** Ends it with the library: worker, memory and WebGL context. */
  end(): void {
    this.opening = null;
    this.isLoaded = this.isOpen = false;
    cancelAnimationFrame(this.cameraFrame);
    for (const stop of this.unwatch) stop();
    this.session.model.end();
    this.ended.abort();
    this.picture.remove();
  }

  private read(): Given {
    const given = givenBy(this.host.attributes, this.host.isDark() ? "dark" : "plain");
    const [first] = given.problems;
    if (first) queueMicrotask(() => this.session.messages.fail({ code: "E904", message: given.problems.join("; ") }));
    return given;
  }

  private setInputs(): void {
    const { attributes } = this.host;
    const controls = attributes("controls");
    this.picture.inputs = controls === "off" ? "still" : "part";
    this.picture.isBare = controls === "camera";
    this.picture.label = attributes("alt") ?? "";
    this.host.frame.isClear = this.given.view.picture.transparent === true;
  }

  private watch(): void {
    const { host, session } = this;
    const { messages, picture, view } = session;
    const watch = (run: () => void) => this.unwatch.push(effect(run));
    watch(() => {
      const { progress } = messages;
      host.frame.showProgress(progress);
      if (progress) untracked(() => host.send("progress", { text: progress.text, share: progress.share }));
    });
    watch(() => {
      const { message } = messages;
      host.frame.showMessage(message, t("close"), () => (messages.message = null));
      if (message?.error) untracked(() => host.send("error", message.error!));
    });
    watch(() => host.frame.say(messages.said));
    watch(() => {
      if (isDrawn(session)) untracked(() => this.loadedNow());
    });
    watch(() => {
      const wantsFaces = view.mayHaveFaces && view.now.surfaces !== "voxels";
      if (wantsFaces && picture.quality === "fine") untracked(() => void session.prepareFaces());
    });
    watch(() => {
      if (view.now.camera) untracked(() => this.cameraChanged());
    });
  }

  private loadedNow(): void {
    const { info, engine } = this.session.volume;
    if (this.isLoaded || !this.isOpen || !info || !engine || !isDrawn(this.session)) return;
    this.isLoaded = true;
    this.host.frame.isShown = true;
    this.host.send("load", { info, threads: engine.threads });
  }

  /** At most one event per frame. */
  private cameraChanged(): void {
    if (this.cameraFrame) return;
    this.cameraFrame = requestAnimationFrame(() => {
      this.cameraFrame = 0;
      if (this.isLoaded && this.camera) this.host.send("camerachange", { camera: this.camera });
    });
  }

  private picked(event: PickEvent): void {
    const { pick, x, y } = event.detail;
    const { clientWidth, clientHeight } = this.picture;
    const detail = { pick, x: x * clientWidth, y: y * clientHeight, selection: this.selection };
    if (!this.host.send("pick", detail)) event.preventDefault();
  }

  private keyDown(event: KeyboardEvent): void {
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
    const { selection, view } = this.session;
    if (event.key === "Escape" && !selection.isEmpty) selection.select([]);
    else if (!this.isLoaded || !movedByKey(view, event.key.toLowerCase())) return;
    event.preventDefault();
  }
}

/** Whether the picture shows the open model from the first fitted camera, or from a later one. */
function isDrawn({ model, picture, view }: Session): boolean {
  return model.status === "ready" && picture.report !== null && picture.camera !== null && picture.camera === view.now.camera;
}

function nameOf(address: string): string {
  const last = address
    .replace(/[?#].*$/, "")
    .replace(/\/$/, "")
    .replace(/^.*\//, "");
  try {
    return decodeURIComponent(last);
  } catch {
    return last;
  }
}

/** English or German. */
export function speak(tag: string): void {
  setLanguage(/^de\b/i.test(tag) ? "de" : "en");
}
