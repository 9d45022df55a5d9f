/** State of the page: the engine, the open model, the view state, and messages to the user. Parts observe it. */

import { boxOf, withProjection, between, type Box } from "./camera/camera";
import { PictureLoop, type Quality } from "./canvas/picture_loop";
import { CityStream } from "./city/city_stream";
import type { CityFiles } from "./city/city_files";
import { kCancelled } from "./engine";
import type {
  ColorScale,
  Engine,
  EngineError,
  FeatureProperties,
  FileBytes,
  FrameReport,
  MovedPlane,
  OpenOptions,
  Pick,
  Point,
  Samples,
  CameraPreset,
  SceneCamera,
  Stretch,
  VolumeInfo,
} from "./engine";
import { kSceneMembers } from "./generated/scene_members";
import { indexFeatures, labelOf, type FeatureIndex } from "./state/feature_index";
import { History, type Changed } from "./state/history";
import { hashOf } from "./state/link";
import { ofId } from "./state/queries";
import { kBuiltIn, moreLanguages, textsOf, wantedOf, type ListedLanguage } from "./languages";
import { Owners } from "./owners";
import { memoryOfPage, Refining, wantsDraft, type Source } from "./refining";
import { cutOf, sceneCamera, sceneOf, type Described } from "./state/scene_of";
import { hiddenFlags, hideQueries, switched } from "./state/visibility";
import { sub } from "./camera/vec";
import { initialState, shifted, type Camera, type ViewState } from "./state/view_state";
import { browserLanguage, movedText, setLanguage, stageText, t, type Language, type LanguageTexts, type TextKey } from "./texts";

export type Tool = "section" | "lens" | "focus" | "look" | "measure" | "views" | "share";
export type Status = "starting" | "empty" | "loading" | "ready";

export interface ListedModel {
  name: string;
  file: string;
  bytes: number;
  title?: string;
  /** A city, whose folder `file` is: it is fetched piece by piece. */
  city?: boolean;
}

export interface Progress {
  text: string;
  /** 0 to 1; negative: unknown. */
  share: number;
}

/** A model that is being fetched and opened. */
export interface Opening {
  name: string;
  /** Stops its download. */
  abort: AbortController;
}

/** A message at the lower border of the page. */
export interface Message {
  title?: string;
  text: string;
  isError: boolean;
}

export interface AlongList {
  x: number;
  y: number;
  stretches: Stretch[];
}

const kUnitBox: Box = {
  low: [0, 0, 0],
  high: [1, 1, 1],
  axes: [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
};

/** Events: "change" when anything changed, "said" when a live region should be read out. */
export class Session extends EventTarget {
  engine: Engine | null = null;
  /** Pictures only, from the server. */
  isServerOnly = false;
  status: Status = "starting";
  progress: Progress | null = null;
  message: Message | null = null;
  models: ListedModel[] = [];
  /** Where the open model of the site lies, relative to the page. */
  get modelAddress(): string {
    return this.models.find((model) => model.name === this.modelName)?.file ?? this.modelFile;
  }
  modelName = "";
  /** null: what is open is no city. */
  city: CityStream | null = null;
  /** File name for generated commands. */
  modelFile = "model.svt";
  /** Names of the files that were opened with it. */
  otherFiles: string[] = [];
  readonly refining = new Refining(this);
  readonly owners = new Owners(this);
  private openedWith: OpenOptions = {};
  /** Section planes that are drawn beside faces of the model in which they lie. */
  moved: MovedPlane[] = [];
  info: VolumeInfo | null = null;
  index: FeatureIndex = indexFeatures([]);
  hidden: Uint8Array = new Uint8Array(0);
  box: Box = kUnitBox;
  state: ViewState = initialState();
  tool: Tool | null = null;
  isWalking = false;
  readonly history = new History();
  along: AlongList | null = null;
  properties: FeatureProperties | null = null;
  report: FrameReport | null = null;
  /** null: nothing is being opened. */
  opening: Opening | null = null;
  /** The open model is a file of this computer, which no link leads to. */
  isLocal = false;
  /** A view whose model is a file that is not here yet. */
  awaited: { file: string; state: ViewState | null } | null = null;
  quality: Quality | null = null;
  /** Camera of the visible picture, which lags the state by a frame. */
  shownCamera: Camera | null = null;
  /** Size of the picture area in device pixels. */
  pictureSize: [number, number] = [640, 360];
  isLegendShown = false;
  language: Language = "en";
  private loop: PictureLoop | null = null;
  private move = 0;
  private linkTimer = 0;

  start(engine: Engine): void {
    this.engine = engine;
    this.loop = new PictureLoop({
      engine,
      size: () => this.pictureSize,
      describe: (size, samples) => (this.info ? this.describe(size, samples) : null),
      take: () => this.state,
      shown: (report, quality, token) => this.shown(report, quality, token as ViewState),
      failed: (error) => {
        this.fail(error);
        if (isFatal(error)) void this.reopen(error);
      },
    });
    if (this.status === "starting") this.status = "empty";
    this.changed();
  }

  /** English and German, and what lies beside the page. */
  languages: ListedLanguage[] = kBuiltIn;

  setLanguage(language: Language = browserLanguage(), texts: LanguageTexts | null = null): void {
    this.language = language;
    setLanguage(language, texts);
    document.documentElement.lang = language;
    this.changed();
  }

  /** One of `languages`; its file is fetched if it has one. */
  async chooseLanguage(code: Language): Promise<void> {
    const isBuiltIn = kBuiltIn.some((language) => language.code === code);
    const texts = isBuiltIn ? null : await textsOf(code);
    if (isBuiltIn || texts) this.setLanguage(code, texts);
    else this.tell(t("noLanguage", { name: `languages/${code}.json` }));
  }

  /** Looks for more languages beside the page, and speaks the one that the address or the browser asks for. */
  async findLanguages(): Promise<void> {
    const more = await moreLanguages();
    this.languages = [...kBuiltIn, ...more];
    const asked = new URLSearchParams(location.search).get("language") ?? wantedOf(this.languages);
    if (asked && asked !== this.language && this.languages.some(({ code }) => code === asked)) await this.chooseLanguage(asked);
    if (more.length) this.changed();
  }

  changed(): void {
    this.dispatchEvent(new Event("change"));
  }

  get aspect(): number {
    return this.pictureSize[0] / this.pictureSize[1];
  }

  describe(size: [number, number], samples?: Samples): Described {
    const described = sceneOf(this.state, this.box, size, samples);
    // Tiles of a city are chosen by the pixel: levels of detail made of them would take time and memory for nothing.
    if (this.city) described.scene.passes = described.scene.passes!.map((pass) => ({ level: 0, ...pass }));
    return described;
  }

  /** Changes the view; the picture follows. */
  set(change: Partial<ViewState>): void {
    const before = this.state;
    this.put(change);
    this.history.record(before, this.state, performance.now());
    this.changed();
  }

  /** Changes the view by what is no choice of the user: no step to take back. */
  private put(change: Partial<ViewState>): void {
    const before = this.state;
    this.state = { ...before, ...change };
    this.follow(before);
  }

  private follow(before: ViewState): void {
    if (before.hide !== this.state.hide) this.hidden = hiddenFlags(this.index, this.state.hide);
    if (before.selection !== this.state.selection) void this.readProperties();
    if (isDrawnDifferently(before, this.state)) this.redraw();
    else if (before.measured !== this.state.measured) this.linkSoon();
    this.changed();
  }

  /** Takes the last step back, or repeats it. */
  undo(): void {
    this.step("undone", this.history.last, (now) => this.history.undo(now));
  }
  redo(): void {
    this.step("redone", this.history.next, (now) => this.history.redo(now));
  }

  private step(said: "undone" | "redone", changed: Changed | null, find: (now: ViewState) => ViewState | null): void {
    cancelAnimationFrame(this.move);
    const before = this.state;
    const found = find(before);
    if (!found || !changed) return;
    this.state = found;
    this.say(t(said, { what: stepText(changed) }));
    this.follow(before);
  }

  redraw(): void {
    this.quality = null;
    this.loop?.invalidate();
    this.linkSoon();
  }

  private linkSoon(): void {
    clearTimeout(this.linkTimer);
    this.linkTimer = window.setTimeout(() => void this.writeLink(), 500);
  }

  resize(size: [number, number]): void {
    if (size[0] === this.pictureSize[0] && size[1] === this.pictureSize[1]) return;
    this.pictureSize = size;
    this.redraw();
    this.changed();
  }

  private shown(report: FrameReport, quality: Quality, state: ViewState): void {
    if (!this.report) performance.mark("svt-first-image");
    this.report = report;
    this.quality = quality;
    this.shownCamera = state.camera;
    this.refit(report.width / report.height);
    if (quality !== "moving") void this.findMoved(state);
    if (quality === "fine") void this.findScale(state);
    this.changed();
  }

  /** Tells which planes lie in faces, once each time. */
  private async findMoved(state: ViewState): Promise<void> {
    if (state.sections === this.seenSections || !this.engine) return;
    this.seenSections = state.sections;
    const cut = cutOf(state.sections);
    const moved = cut ? await this.engine.movedPlanes({ passes: [{ cut }] }).catch(() => []) : [];
    if (this.state.sections !== state.sections) return;
    const isNew = moved.some(({ text }) => !this.moved.some((other) => other.text === text));
    this.moved = moved;
    if (isNew) this.say(movedText(moved));
    this.changed();
  }
  private seenSections: unknown = null;

  /** What the colours of the picture mean, for those who cannot see its legend; null: they are no legend's. */
  scale: ColorScale | null = null;

  private async findScale(state: ViewState): Promise<void> {
    const scale =
      state.colorBy && this.engine
        ? await this.composed(this.pictureSize)
            .then((scene) => this.engine!.legend(scene))
            .catch(() => null)
        : null;
    if (this.state !== state || JSON.stringify(scale) === JSON.stringify(this.scale)) return;
    this.scale = scale;
    this.changed();
  }

  /** The view fitted to the whole building, and its aspect ratio; it is recomputed for another aspect ratio. */
  private fitted: { camera: Camera; aspect: number } | null = null;

  private refit(aspect: number): void {
    const { fitted } = this;
    if (!fitted || fitted.camera !== this.state.camera || Math.abs(fitted.aspect / aspect - 1) < 0.02) return;
    this.fitted = null;
    void this.fit(aspect);
  }

  private async fit(aspect: number): Promise<void> {
    await this.goTo("", kSceneMembers["/camera/preset"].default, false);
    if (this.state.camera) this.fitted = { camera: this.state.camera, aspect };
  }

  fail(error: unknown, title?: string): void {
    const { code, message } = error as Partial<EngineError>;
    if (code === kCancelled) return;
    const text = message ?? String(error);
    this.message = { ...(title ? { title } : {}), text: code ? `${text} (${code})` : text, isError: true };
    this.changed();
  }

  tell(text: string): void {
    this.message = { text, isError: false };
    this.say(text);
    this.changed();
  }

  say(text: string): void {
    this.dispatchEvent(new CustomEvent("said", { detail: text }));
  }

  /** Fetches the bytes of the open model again, for a restarted library. */
  private source: Source | null = null;
  private restartedAt = -Infinity;

  /** The files of the open model; null if they cannot be had again. */
  async filesAgain(): Promise<FileBytes[] | null> {
    return (await this.source?.().catch(() => null)) ?? null;
  }

  /** The library has crashed and lost the volume: reopens it, unless that just failed. */
  private async reopen(error: EngineError): Promise<void> {
    if (performance.now() - this.restartedAt < 20_000) return;
    this.restartedAt = performance.now();
    if (await this.bringBack()) this.tell(t("reopened", { error: error.message }));
  }

  /** Opens the model again that the library has lost. */
  private async bringBack(): Promise<boolean> {
    if (!(this.source || this.city) || !this.engine) return false;
    try {
      if (this.city) return await this.reopenCity(this.city);
      await this.engine.open(await this.source!(), () => undefined, this.openedWith);
      await this.owners.giveAgain();
      this.hasLostVolume = false;
      this.redraw();
      return true;
    } catch (again) {
      this.fail(again);
      return false;
    }
  }

  /** Announces a model that is fetched and opened next; one that is still coming is given up. */
  startOpening(name: string): Opening {
    this.cancelOpening();
    this.opening = { name, abort: new AbortController() };
    return this.opening;
  }

  /** Gives up what is being opened; what was open before stays. */
  cancelOpening(): void {
    const { opening } = this;
    if (!opening) return;
    this.opening = null;
    opening.abort.abort();
    this.progress = null;
    if (this.isReading) {
      this.engine?.cancel();
      this.hasLostVolume = true;
    }
    this.isReading = false;
    if (this.status === "loading") this.status = this.info ? "ready" : "empty";
    this.tell(t("cancelled", { name: opening.name }));
  }
  /** What was open before comes back where a cancelled opening took it, and the one after it failed as well. */
  async recover(): Promise<void> {
    if (this.hasLostVolume && !this.opening) await this.bringBack();
  }
  /** The page shows a model that the library has not open any more. */
  private hasLostVolume = false;
  /** The library is reading the model that is being opened. */
  private isReading = false;

  /**
   * Opens a model; on failure, or when it is cancelled, the previous one stays open.
   * @param opening  from startOpening()
   * @param source  fetches the files again
   */
  async open(opening: Opening, files: FileBytes[], source: Source, state: ViewState | null = null): Promise<boolean> {
    if (!this.engine || this.opening !== opening) return false;
    this.status = "loading";
    this.message = null;
    this.isReading = true;
    try {
      this.refining.cancel();
      const [first, ...others] = files.map(({ name }) => name);
      const options = { draft: wantsDraft(files), memory: memoryOfPage() };
      const info = await this.engine.open(files, (step, share) => this.tellProgress(step, share), options);
      this.hasLostVolume = false;
      this.city?.end();
      this.city = null;
      this.modelFile = first!;
      this.otherFiles = others;
      this.source = source;
      this.openedWith = options;
      this.owners.forget();
      this.take(info, state ?? { ...initialState(this.state.look), wireframe: null });
      if (options.draft) this.refining.begin(source, options.memory);
      return true;
    } catch (error) {
      if ((error as EngineError).code === kCancelled) {
        await this.recover(); // unless another opening was begun meanwhile, which replaces the volume
        return false;
      }
      this.status = this.info ? "ready" : "empty";
      this.fail(error, t("failedTitle"));
      if (isFatal(error)) await this.reopen(error as EngineError);
      return false;
    } finally {
      if (this.opening === opening) {
        this.opening = null;
        this.isReading = false;
        this.progress = null;
      }
      this.changed();
      await this.recover();
    }
  }

  /** Opens a city with its coarsest tile; then it follows the camera. As open(). */
  async openCity(opening: Opening, files: CityFiles, state: ViewState | null): Promise<boolean> {
    if (!this.engine || this.opening !== opening) return false;
    this.status = "loading";
    this.message = null;
    this.isReading = true;
    const city = new CityStream(this, files);
    try {
      this.refining.cancel();
      this.city?.end();
      const { info } = await city.open();
      this.hasLostVolume = false;
      this.city = city;
      this.modelFile = "city";
      this.otherFiles = [];
      this.source = null;
      this.openedWith = {};
      this.owners.forget();
      const lacks = this.message;
      this.take({ ...info!, name: opening.name }, state ?? { ...initialState(this.state.look), wireframe: null });
      this.message = lacks;
      city.begin();
      return true;
    } catch (error) {
      if ((error as EngineError).code === kCancelled) return false;
      this.status = this.info ? "ready" : "empty";
      this.fail(error, t("failedTitle"));
      return false;
    } finally {
      if (this.opening === opening) {
        this.opening = null;
        this.isReading = false;
        this.progress = null;
      }
      this.changed();
    }
  }

  private async reopenCity(city: CityStream): Promise<boolean> {
    city.end();
    this.city = new CityStream(this, city.files);
    const { info } = await this.city.open();
    this.hasLostVolume = false;
    this.takeTiles(info!);
    this.city.begin();
    return true;
  }

  /** Other tiles of the city have taken the place of those before; the view stays. */
  takeTiles(info: VolumeInfo): void {
    this.info = { ...info, name: this.info?.name ?? info.name };
    this.index = indexFeatures(info.features);
    this.hidden = hiddenFlags(this.index, this.state.hide);
    this.redraw();
    void this.readProperties();
    this.changed();
  }

  /** Goes to a building of the city. */
  goToFound(id: string, { eye, target, fieldOfView }: SceneCamera): void {
    if (!eye || !target) return;
    const now = this.state.camera;
    const camera: Camera = {
      eye,
      target,
      parallel: false,
      height: 10,
      fieldOfView: fieldOfView ?? now?.fieldOfView ?? kSceneMembers["/camera/fieldOfView"].default,
    };
    this.moveTo(withProjection(camera, now?.parallel ?? false));
    this.select([id]);
  }

  private tellProgress(step: string, share: number): void {
    this.progress = { text: stageText(step), share };
    this.changed();
  }

  /** A finer volume of the same model has taken the place of the coarse one: what was chosen meanwhile stays. */
  takeFiner(info: VolumeInfo, memory: number): void {
    const by = this.info ? sub(this.info.origin, info.origin) : ([0, 0, 0] as Point);
    this.openedWith = { draft: false, memory };
    this.info = info;
    this.box = boxOf(info);
    this.index = indexFeatures(info.features);
    this.hidden = hiddenFlags(this.index, this.state.hide);
    const move = (state: ViewState) => shifted(state, by, this.box);
    this.history.change(move);
    this.state = move(this.state);
    this.fitted = null;
    this.properties = null;
    this.redraw();
    void this.readProperties();
    this.changed();
  }

  private take(info: VolumeInfo, state: ViewState): void {
    this.info = info;
    this.box = boxOf(info);
    this.index = indexFeatures(info.features);
    // Of a city, what is selected may not be seen yet.
    this.state = { ...state, selection: state.selection.filter((id) => this.city || this.index.byId.has(id)) };
    this.hidden = hiddenFlags(this.index, state.hide);
    this.history.clear();
    this.moved = [];
    this.seenSections = null;
    this.along = null;
    this.properties = null;
    this.report = null;
    this.status = "ready";
    document.title = `${info.name || info.source} - SVT`;
    this.redraw();
    void this.readProperties();
    if (!this.state.camera) void this.fit(0);
  }

  /** Moves to where the features of a query fill the picture; from a named view, or from the current direction. */
  async goTo(query: string, preset: CameraPreset | null, isFollowed = true): Promise<void> {
    if (!this.engine || !this.info) return;
    if (this.isServerOnly) return this.set({ camera: null, preset: preset ?? this.state.preset });
    const now = this.state.camera;
    const seen = now ? withProjection(now, false) : null;
    const from: SceneCamera = seen ? sceneCamera(seen, this.box, this.aspect) : { preset: kSceneMembers["/camera/preset"].default };
    try {
      const { eye, target, fieldOfView } = await this.engine.view(query, preset, from);
      if (!eye || !target) return;
      // Fitting is no wish of the user, whose own choice meanwhile stays.
      if (!isFollowed && this.state.camera !== now) return;
      const camera: Camera = {
        eye,
        target,
        parallel: false,
        height: 10,
        fieldOfView: fieldOfView ?? seen?.fieldOfView ?? kSceneMembers["/camera/fieldOfView"].default,
      };
      this.moveTo(withProjection(camera, now?.parallel ?? false), isFollowed);
    } catch (error) {
      this.fail(error);
    }
  }

  /** Animated, unless the user prefers reduced motion. */
  moveTo(camera: Camera, isFollowed = true): void {
    cancelAnimationFrame(this.move);
    if (!isFollowed) return this.put({ camera });
    this.history.seal();
    const from = this.state.camera;
    if (!from || matchMedia("(prefers-reduced-motion: reduce)").matches) return this.set({ camera });
    const start = performance.now(),
      duration = 350;
    const step = () => {
      const share = Math.min(1, (performance.now() - start) / duration);
      const eased = share * share * (3 - 2 * share);
      this.set({ camera: share === 1 ? camera : between(from, camera, eased) });
      if (share < 1) this.move = requestAnimationFrame(step);
    };
    step();
  }

  /** Camera movement by the user: ends an animation. */
  turn(camera: Camera): void {
    cancelAnimationFrame(this.move);
    this.set({ camera });
  }

  select(ids: string[], isAdded = false): void {
    const kept = isAdded ? this.state.selection.filter((id) => !ids.includes(id)) : [];
    const added = isAdded && ids.every((id) => this.state.selection.includes(id)) ? [] : ids;
    this.along = null;
    this.set({ selection: [...kept, ...added] });
    const only = this.selected();
    if (only) this.say(t("picked", { name: labelOf(only), class: only.class }));
    else this.say(ids.length ? t("severalSelected", { n: this.state.selection.length }) : t("nothingSelected"));
  }

  /** The selected feature, if there is exactly one. */
  selected() {
    const [id, second] = this.state.selection;
    if (id === undefined || second !== undefined) return null;
    const i = this.index.byId.get(id);
    return i === undefined ? null : this.index.features[i]!;
  }

  picked(pick: Pick | null, isAdded: boolean): void {
    if (pick) return this.select([pick.id], isAdded);
    if (!isAdded) this.select([]);
    this.say(t("pickedNothing"));
  }

  async listAlong(x: number, y: number): Promise<void> {
    if (!this.engine || !this.info) return;
    try {
      this.along = { x, y, stretches: await this.engine.along(x, y) };
      this.say(t("alongTitle"));
    } catch (error) {
      this.fail(error);
    }
    this.changed();
  }

  hide(members: Iterable<number>, hidden: boolean): void {
    const flags = switched(this.hidden, members, hidden);
    this.set({ hide: hideQueries(this.index, flags, this.state.hide) });
  }

  /** The files that are open; several: `A and B`. */
  get fileNames(): string[] {
    return [this.modelFile, ...this.otherFiles];
  }

  private async readProperties(): Promise<void> {
    const id = this.state.selection.length === 1 ? this.state.selection[0]! : null;
    if (this.properties?.id !== id) this.properties = null;
    if (id === null || !this.engine || !this.info || (this.city && !this.index.byId.has(id))) return;
    try {
      const properties = await this.engine.properties(id);
      if (this.state.selection[0] === id) this.properties = properties;
      this.changed();
    } catch (error) {
      this.fail(error);
    }
  }

  /** The scene as taken by `svt render --scene`, with effects. */
  async composed(size: [number, number], samples?: Samples) {
    const described = this.describe(size, samples);
    if (!this.engine || Object.keys(described.effects).length === 0) return described.scene;
    return this.engine.compose(described.scene, described.effects);
  }

  /** The address of the page with the open model, if there are several; of a local file only its name. */
  private address(): string {
    const url = new URL(location.href);
    if (this.modelName && this.models.length > 1) url.searchParams.set("model", this.modelName);
    else url.searchParams.delete("model");
    if (this.isLocal) url.searchParams.set("file", this.modelFile);
    else url.searchParams.delete("file");
    return url.pathname + url.search;
  }

  /** Updates the page's address to the current view. */
  async writeLink(): Promise<void> {
    if (!this.info || !this.state.camera) return;
    const state = this.state;
    try {
      const hash = await hashOf(await this.composed(this.pictureSize), state);
      if (this.state === state) history.replaceState(null, "", `${this.address()}${hash}`);
    } catch {
      // A view that cannot be drawn has no link; the picture already reported why.
    }
  }

  /** Selection as a query. */
  get selectionQuery(): string {
    return this.state.selection.map(ofId).join(" or ");
  }

  toolText(tool: Tool): string {
    return t(tool as TextKey);
  }
}

/** The name of a step: what it changed, the foremost of it. */
export function stepText(changed: Changed): string {
  return t(kStepNames[changed.find((key) => key !== "camera") ?? "camera"] ?? "look");
}

const kStepNames: Partial<Record<keyof ViewState, TextKey>> = {
  camera: "stepCamera",
  hide: "stepVisibility",
  show: "stepVisibility",
  styles: "stepStyles",
  sections: "section",
  effect: "focusEffect",
  lens: "lens",
  focus: "focus",
  shell: "shell",
  wireframe: "wireframe",
  names: "names",
  colorBy: "colorBy",
  picture: "picture",
  hatches: "hatches",
  measured: "measure",
  custom: "sceneJson",
};

/** Errors after which the worker is replaced and has no volume. */
function isFatal(error: unknown): boolean {
  return (error as EngineError).code === "E999";
}

function isDrawnDifferently(a: ViewState, b: ViewState): boolean {
  for (const key of Object.keys(b) as (keyof ViewState)[]) {
    if (a[key] === b[key]) continue;
    if (key === "measured") continue;
    if (key !== "selection" || b.names || ((b.effect === "highlight" || b.effect === "cutaway") && b.focus.query === "")) return true;
  }
  return false;
}
