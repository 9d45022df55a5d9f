/**
 * `<svt-viewer src="house.svt" section="z<1.2">`: the picture of a building in any page. This script is small; it loads the viewer
 * when the element is visible and has a model. The manual is docs/user/web-component.md.
 */

import type { CameraPreset, DrawingFormat, EngineError, FeatureProperties, Pick, Scene, VolumeInfo } from "../engine";
import { errorOf, SvtError } from "../engine/errors";
import type { Camera } from "../state/view_state";
import { Frame } from "./frame";
import type { PictureSize, SvtViewerEventMap } from "./types";
import type { Viewing } from "./viewing";

export type * from "./types";
export type { Camera, CameraPreset, DrawingFormat, EngineError, FeatureProperties, Pick, Scene, VolumeInfo };
export type { Feature, Point } from "../engine";
export { SvtError };

/** Attributes with a text. Each has a property of its name in camel case. */
const kTexts = [
  ...["src", "poster", "alt", "loading", "controls", "theme", "camera", "around", "eye", "target", "fov", "section", "cut"],
  ...[
    "show",
    "hide",
    "color",
    "opacity",
    "color-by",
    "highlight",
    "cutaway",
    "lens",
    "context",
    "shell",
    "surfaces",
    "hidden-lines",
    "names",
  ],
  ...["look", "background"],
] as const;
/** Attributes that are on or off. */
const kFlags = ["ortho", "hatch", "wireframe", "scale-bar", "north-arrow", "transparent"] as const;

/** Elements begin to load when they are this near to the visible part of the page. */
const kNear = "200px";

// Servers that render pages have no elements; there, the module may be imported, too.
const Base = (globalThis.HTMLElement ?? class {}) as typeof HTMLElement;

export class SvtViewer extends Base {
  static readonly observedAttributes: readonly string[] = [...kTexts, ...kFlags, "lang"];
  /** Address of the folder with worker.js and the files next to it, for bundlers that do not copy them; empty: next to this script. */
  static assets = "";

  declare src: string;
  declare poster: string;
  declare alt: string;
  /** `lazy` (default) or `eager`. */
  declare loading: string;
  /** `on` (default): everything; `camera`: no handles of planes, no axes; `off`: the picture takes no input. */
  declare controls: string;
  /** `light`, `dark`, or `auto` (default): that of the page around the element. */
  declare theme: string;
  declare camera: string;
  declare around: string;
  declare eye: string;
  declare target: string;
  declare fov: string;
  declare section: string;
  declare cut: string;
  declare show: string;
  declare hide: string;
  declare color: string;
  declare opacity: string;
  declare colorBy: string;
  declare highlight: string;
  declare cutaway: string;
  declare lens: string;
  declare context: string;
  declare shell: string;
  declare surfaces: string;
  declare hiddenLines: string;
  declare names: string;
  declare look: string;
  declare background: string;
  declare ortho: boolean;
  declare hatch: boolean;
  declare wireframe: boolean;
  declare scaleBar: boolean;
  declare northArrow: boolean;
  declare transparent: boolean;

  private frame: Frame | null = null;
  private viewing: Viewing | null = null;
  /** The present start; a later one, or the end, supersedes it. */
  private starting: object | null = null;
  private nearness: IntersectionObserver | null = null;
  /** Attributes that have changed in this turn. */
  private readonly changed = new Set<string>();
  private readonly schemeChanged = () => this.changedLater("theme");

  /** The open model; null before the event `load`. */
  get info(): VolumeInfo | null {
    return this.viewing?.info ?? null;
  }
  /** Whether a model is open and visible. */
  get loaded(): boolean {
    return this.viewing?.loaded ?? false;
  }
  /** Ids of the selected features. */
  get selection(): string[] {
    return this.viewing?.selection ?? [];
  }

  connectedCallback(): void {
    this.frame ??= new Frame(this.attachShadow({ mode: "open", delegatesFocus: true }));
    for (const name of [...kTexts, ...kFlags]) this.takeEarly(propertyOf(name));
    this.setLooks();
    matchMedia(kDark).addEventListener("change", this.schemeChanged);
    if (!this.viewing) this.startWhenNear();
  }

  disconnectedCallback(): void {
    // An element that is only moved is connected again at once.
    queueMicrotask(() => {
      if (this.isConnected) return;
      matchMedia(kDark).removeEventListener("change", this.schemeChanged);
      this.end();
    });
  }

  attributeChangedCallback(name: string, before: string | null, now: string | null): void {
    if (this.frame && this.isConnected && before !== now) this.changedLater(name);
  }

  /** A property that was set before the element was defined hides the one of the class. */
  private takeEarly(name: string): void {
    const own = this as unknown as Record<string, unknown>;
    if (!Object.hasOwn(this, name)) return;
    const value = own[name];
    delete own[name];
    own[name] = value;
  }

  /** Several changes of one turn become one. */
  private changedLater(name: string): void {
    if (!this.changed.size) queueMicrotask(() => this.applyChanges());
    this.changed.add(name);
  }

  private applyChanges(): void {
    const names = new Set(this.changed);
    this.changed.clear();
    if (!this.isConnected) return;
    this.setLooks();
    if (names.has("src")) {
      if (!this.src) return this.end();
      if (this.viewing) return void this.viewing.open(this.address);
    }
    if (this.viewing) this.viewing.update();
    else if (names.has("src") || names.has("loading")) this.startWhenNear();
  }

  private setLooks(): void {
    this.frame!.isDark = this.isDark;
    this.frame!.setPoster(this.poster, this.alt);
  }

  private get address(): string {
    return new URL(this.src, document.baseURI).href;
  }

  private get isDark(): boolean {
    if (this.theme === "dark" || this.theme === "light") return this.theme === "dark";
    const schemes = getComputedStyle(this).colorScheme.split(" ");
    return schemes.includes("dark") && (!schemes.includes("light") || matchMedia(kDark).matches);
  }

  private startWhenNear(): void {
    this.nearness?.disconnect();
    this.nearness = null;
    if (!this.src) return;
    const begin = () => void this.begin((viewing) => viewing.open(this.address));
    if (this.loading === "eager") return begin();
    this.nearness = new IntersectionObserver(
      (seen) => {
        if (seen.some(({ isIntersecting }) => isIntersecting)) begin();
      },
      { rootMargin: kNear },
    );
    this.nearness.observe(this);
  }

  /** Loads the viewer, and then opens something in it. */
  private async begin(open: (viewing: Viewing) => Promise<void>): Promise<void> {
    this.nearness?.disconnect();
    const starting = (this.starting = {});
    this.frame!.showProgress({ text: "", share: -1 });
    try {
      const { Viewing, speak } = await import("./viewing");
      if (this.starting !== starting) return;
      speak(this.closest("[lang]")?.getAttribute("lang") ?? navigator.language);
      this.viewing ??= new Viewing({
        attributes: (name) => this.getAttribute(name),
        frame: this.frame!,
        assets: SvtViewer.assets,
        isDark: () => this.isDark,
        send: (name, detail) => this.dispatchEvent(new CustomEvent(name, { detail, cancelable: name === "pick" })),
      });
      await open(this.viewing);
    } catch (error) {
      if (this.starting === starting) this.cannotStart(error);
    }
  }

  private cannotStart(error: unknown): void {
    const message = `The viewer cannot be loaded: ${error instanceof Error ? error.message : String(error)}`;
    this.frame!.showProgress(null);
    this.frame!.showMessage({ text: message, isError: true }, "Close", () => this.frame!.showMessage(null));
    this.dispatchEvent(new CustomEvent("error", { detail: { code: "", message } satisfies EngineError }));
  }

  private end(): void {
    this.nearness?.disconnect();
    this.starting = null;
    this.viewing?.end();
    this.viewing = null;
    this.frame!.isShown = false;
    this.frame!.showProgress(null);
    this.frame!.showMessage(null);
  }

  /** The viewer of an open model. */
  private get ready(): Viewing {
    if (!this.viewing?.loaded) throw new SvtError("E904", "no model is open; wait for the event load");
    return this.viewing;
  }

  /**
   * Opens files of the visitor, such as those of an `<input type="file">`. Several models become one. The events `load` and `error`
   * report the result.
   */
  async open(...files: File[]): Promise<void> {
    if (!this.isConnected) throw new SvtError("E904", "the element is not part of a page");
    await this.begin((viewing) => viewing.openFiles(files));
  }

  /** A call of the viewer of a loaded model. Its errors are SvtErrors. */
  private async ask<Answer>(call: (viewing: Viewing) => Promise<Answer>): Promise<Answer> {
    try {
      return await call(this.ready);
    } catch (error) {
      throw errorOf(error);
    }
  }

  /** The picture as PNG, byte for byte that of `svt render` with scene(). */
  snapshot(size: PictureSize = {}): Promise<Blob> {
    return this.ask(async (viewing) => new Blob([await viewing.engine.picture(await viewing.scene(size))], { type: "image/png" }));
  }

  /** The scene of the picture, for `svt render --scene`. */
  scene(size: PictureSize = {}): Promise<Scene> {
    return this.ask((viewing) => viewing.scene(size));
  }

  /** The object at a place of the picture, in CSS pixels from the upper left corner of the element; null: nothing is there. */
  pick(x: number, y: number): Promise<Pick | null> {
    return this.ask((viewing) => viewing.engine.pick(x / this.clientWidth, y / this.clientHeight));
  }

  /** Selects the features of a query, and resolves to their ids. An empty query selects nothing. */
  select(query: string): Promise<string[]> {
    return this.ask((viewing) => viewing.select(query));
  }

  /** All properties of a feature. */
  properties(id: string): Promise<FeatureProperties> {
    return this.ask((viewing) => viewing.engine.properties(id));
  }

  /** The drawing of `svt section --plane`. */
  drawing(plane: string, format: DrawingFormat = "svg"): Promise<Blob> {
    const types = { svg: "image/svg+xml", dxf: "image/vnd.dxf", geojson: "application/geo+json", csv: "text/csv" };
    return this.ask(async ({ engine }) => new Blob([await engine.drawing(plane, format)], { type: types[format] }));
  }

  /** The present camera; null before the event `load`. */
  getCamera(): Camera | null {
    return this.loaded ? this.viewing!.camera : null;
  }

  /** Moves the camera; absent members stay. */
  setCamera(camera: Partial<Camera>): void {
    this.ready.setCamera(camera);
  }

  /** Moves the camera to a named view; null: from the present direction. It fits the features of the query, or everything. */
  goTo(camera: CameraPreset | null, query = ""): Promise<void> {
    return this.ask((viewing) => viewing.goTo(camera, query));
  }

  override focus(options?: FocusOptions): void {
    if (this.viewing) this.viewing.focus();
    else super.focus(options);
  }

  override addEventListener<Name extends keyof SvtViewerEventMap>(
    type: Name,
    listener: (this: SvtViewer, event: SvtViewerEventMap[Name]) => void,
    options?: boolean | AddEventListenerOptions,
  ): void;
  override addEventListener(
    type: string,
    listener: EventListenerOrEventListenerObject | null,
    options?: boolean | AddEventListenerOptions,
  ): void;
  override addEventListener(type: string, listener: unknown, options?: boolean | AddEventListenerOptions): void {
    super.addEventListener(type, listener as EventListener, options);
  }
}

const kDark = "(prefers-color-scheme: dark)";

function propertyOf(attribute: string): string {
  return attribute.replace(/-(\w)/g, (_, letter: string) => letter.toUpperCase());
}

for (const name of kTexts)
  Object.defineProperty(SvtViewer.prototype, propertyOf(name), {
    get(this: SvtViewer) {
      return this.getAttribute(name) ?? "";
    },
    set(this: SvtViewer, value: unknown) {
      if (value === null || value === undefined || value === "") this.removeAttribute(name);
      else this.setAttribute(name, String(value));
    },
  });
for (const name of kFlags)
  Object.defineProperty(SvtViewer.prototype, propertyOf(name), {
    get(this: SvtViewer) {
      const text = this.getAttribute(name);
      return text !== null && text !== "off" && text !== "false";
    },
    set(this: SvtViewer, value: unknown) {
      if (value) this.setAttribute(name, "");
      else this.removeAttribute(name);
    },
  });

declare global {
  interface HTMLElementTagNameMap {
    "svt-viewer": SvtViewer;
  }
}

// A page may load the script twice, from two places.
if (globalThis.customElements && !customElements.get("svt-viewer")) customElements.define("svt-viewer", SvtViewer);
