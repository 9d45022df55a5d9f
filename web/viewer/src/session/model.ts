/** Opens models and cities, and reopens a model that the library has lost. */

import { CityStream, type CityHost } from "../city/city_stream";
import type { CityFiles } from "../city/city_files";
import { kCancelled } from "../engine";
import type { EngineError, FileBytes, OpenOptions, Point, VolumeInfo } from "../engine";
import { sub } from "../camera/vec";
import { batch, until } from "../observable";
import { expanded } from "../state/compact";
import { hiddenSpaces } from "../state/spaces";
import { initialState, shifted, type ViewState } from "../state/view_state";
import { stageText, t } from "../texts";
import { Owners } from "./owners";
import { memoryOfDevice, Refining, wantsDraft, type Source } from "./refining";
import { ViewPart } from "./view_part";

export type Status = "starting" | "empty" | "loading" | "ready";

/** A model that is being fetched and opened. */
export interface Opening {
  name: string;
  /** Stops its download. */
  abort: AbortController;
}

/** Milliseconds until the library may be reopened again. */
const kReopenAfter = 20_000;

export class Model extends ViewPart {
  status: Status = "starting";
  /** null: nothing is being opened. */
  opening: Opening | null = null;
  /** null: no city is open. */
  city: CityStream | null = null;
  /** Size limit of a volume that is built here, bytes. */
  memory = memoryOfDevice();
  /** A view whose model is a file that the user has not opened yet. */
  awaited: { file: string; state: ViewState | null } | null = null;
  readonly refining: Refining;
  readonly owners: Owners;
  /** Fetches the bytes of the open model again, for a restarted library; null: a city. */
  source: Source | null = null;
  private openedWith: OpenOptions = {};
  private restartedAt = -Infinity;
  /** The library is reading the model that is being opened. */
  private isReading = false;

  constructor(private readonly parts: CityHost) {
    super(parts);
    this.owners = new Owners(parts);
    this.refining = new Refining(parts.volume, parts.messages, {
      firstPicture: () => until(() => parts.picture.report !== null),
      take: (info, memory) => this.takeFiner(info, memory),
    });
  }

  /** The files of the open model; null if they cannot be fetched again. */
  async filesAgain(): Promise<FileBytes[] | null> {
    return (await this.source?.().catch(() => null)) ?? null;
  }

  /** Cancels the current opening; the previous model stays open. */
  cancelOpening(): void {
    const { opening } = this;
    if (!opening) return;
    opening.abort.abort();
    if (this.isReading) {
      this.volume.engine?.cancel();
      this.volume.isLost = true;
    }
    this.endOpening();
    this.messages.tell(t("cancelled", { name: opening.name }));
  }

  /** Ends everything in progress, and the library. */
  end(): void {
    this.opening?.abort.abort();
    this.opening = null;
    this.city?.end();
    this.city = null;
    this.source = null;
    this.refining.cancel();
    this.volume.engine?.close();
  }

  private endOpening(): void {
    this.opening = this.messages.progress = null;
    this.isReading = false;
    if (this.status === "loading") this.status = this.volume.info ? "ready" : "empty";
  }

  /**
   * Fetches and opens a model, and cancels an opening in progress. On failure or cancellation, the previous model stays open.
   * @param fetched  fetches the files, and reports its progress
   * @param again  fetches them again
   * @param state  null: starts with a new view
   */
  open(name: string, fetched: (signal: AbortSignal) => Promise<FileBytes[]>, again: Source, state: ViewState | null): Promise<boolean> {
    return this.attempt(name, fetched, async (files) => {
      const options = { draft: wantsDraft(files), memory: this.memory };
      const [file, ...otherFiles] = files.map((one) => one.name);
      const tell = (step: string, share: number) => (this.messages.progress = { text: stageText(step), share });
      const info = await this.volume.engine!.open(files, tell, options);
      this.city?.end();
      this.city = null;
      this.openedWith = options;
      this.replace(info, { file: file!, otherFiles, source: again, state });
      if (options.draft) this.refining.begin(again, options.memory);
    });
  }

  /** Opens a city with its coarsest tile; then the city follows the camera. Failures are as for open(). */
  openCity(name: string, files: CityFiles, state: ViewState | null): Promise<boolean> {
    const city = new CityStream(files, this.parts);
    return this.attempt(
      name,
      async () => {
        this.messages.progress = { text: t("loadingFile", { name }), share: -1 };
      },
      async () => {
        this.city?.end();
        // The library has one city at a time: if this one fails, the previous one must be opened again.
        this.volume.isLost ||= this.city !== null;
        const info = await city.open();
        this.city = city;
        this.openedWith = {};
        this.replace({ ...info, name }, { file: "city", otherFiles: [], source: null, state });
        city.begin();
      },
    );
  }

  private async attempt<T>(
    name: string,
    fetched: (signal: AbortSignal) => Promise<T>,
    open: (files: T) => Promise<void>,
  ): Promise<boolean> {
    this.cancelOpening();
    const opening = (this.opening = { name, abort: new AbortController() });
    try {
      const files = await fetched(opening.abort.signal);
      if (!this.volume.engine || this.opening !== opening) return false;
      this.status = "loading";
      this.messages.message = null;
      this.isReading = true;
      this.refining.cancel();
      await open(files);
      return true;
    } catch (error) {
      if (this.opening !== opening || (error as EngineError).code === kCancelled) return false;
      this.endOpening();
      this.messages.fail(error, t("failedTitle"));
      if (isFatal(error)) await this.reopen(error);
      return false;
    } finally {
      if (this.opening === opening) this.endOpening();
      // If another opening has begun meanwhile, that one replaces the volume.
      if (this.volume.isLost && !this.opening) await this.bringBack();
    }
  }

  /** Another model has replaced the previous one. */
  private replace(info: VolumeInfo, from: { file: string; otherFiles: string[]; source: Source | null; state: ViewState | null }): void {
    this.volume.isLost = false;
    this.source = from.source;
    this.volume.file = from.file;
    this.volume.otherFiles = from.otherFiles;
    this.volume.compared = null;
    this.owners.forget();
    this.take(info, from.state ?? { ...initialState(this.view.state.look), wireframe: null }, from.state === null);
  }

  /** @param isNew  a new view, in which spaces are hidden */
  private take(info: VolumeInfo, given: ViewState, isNew: boolean): void {
    const { volume, view } = this;
    batch(() => {
      volume.take(info);
      const known = volume.isCity ? given : expanded(given, volume.index);
      const state = isNew ? { ...known, hide: hiddenSpaces(volume.index) } : known;
      this.parts.selection.forget();
      this.parts.picture.forget();
      // The selected features of a city may not be visible yet.
      view.begin({ ...state, selection: state.selection.filter((id) => volume.isCity || volume.index.byId.has(id)) });
      this.status = "ready";
    });
    const { selection, selectedBy } = view.state;
    if (selectedBy && !selection.length) void this.parts.selection.selectByQuery(selectedBy);
    if (!view.state.camera) void view.fit(0);
  }

  /** A finer volume of the same model has replaced the coarse one: the view and the selection stay. */
  private async takeFiner(info: VolumeInfo, memory: number): Promise<void> {
    const { volume } = this;
    const by = volume.info ? sub(volume.info.origin, info.origin) : ([0, 0, 0] as Point);
    this.openedWith = { draft: false, memory };
    batch(() => {
      volume.take(info);
      this.parts.selection.properties = null;
      this.view.shift((state) => shifted(state, by, volume.box));
    });
    await this.owners.giveAgain();
  }

  /** The library has crashed and lost the volume: reopens it, unless that just failed. */
  async reopen(error: EngineError): Promise<void> {
    if (performance.now() - this.restartedAt < kReopenAfter) return;
    this.restartedAt = performance.now();
    if (await this.bringBack()) this.messages.tell(t("reopened", { error: error.message }));
  }

  /** Reopens the model that the library has lost. */
  private async bringBack(): Promise<boolean> {
    const { city, source } = this;
    const { engine } = this.volume;
    if (!(source || city) || !engine) return false;
    try {
      if (city) await this.reopenCity(city);
      else {
        await engine.open(await source!(), () => undefined, this.openedWith);
        await this.owners.giveAgain();
      }
      this.volume.isLost = false;
      this.view.redraw();
      return true;
    } catch (again) {
      this.messages.fail(again);
      return false;
    }
  }

  private async reopenCity(before: CityStream): Promise<void> {
    before.end();
    const city = (this.city = new CityStream(before.files, this.parts));
    city.show(await city.open());
    city.begin();
  }
}

/** Errors after which the worker is replaced and has no volume. */
export function isFatal(error: unknown): error is EngineError {
  return (error as EngineError).code === "E999";
}
