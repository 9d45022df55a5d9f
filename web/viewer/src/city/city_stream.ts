/**
 * An open city. One tile is the first picture. Then a second worker fetches, joins and prepares the tiles that the camera
 * sees, and replaces the first worker. So pictures never wait for tiles.
 */

import type { CityFound, CityLook, DrawingFormat, Engine, VolumeInfo } from "../engine";
import { batch, effect, Observable, untracked } from "../observable";
import type { Selection } from "../session/selection";
import type { ShownPicture } from "../session/shown_picture";
import type { ViewParts } from "../session/view_part";
import type { Camera } from "../state/view_state";
import { stageText, t } from "../texts";
import type { Message } from "../session/messages";
import type { CityFiles } from "./city_files";
import { roundMs } from "./retry";

/** Maximum width of voxels in pixels: in the first picture, in a moving one, in one at rest. */
const kFirstPixels = 4,
  kMovingPixels = 2,
  kStillPixels = 1;
/** Milliseconds after which a camera counts as at rest, and between two looks while it moves. */
const kStillAfter = 250,
  kPause = 100;
/** Memory limits of the page for the city, bytes: on a phone, and on other devices. */
const kPhone = 128e6,
  kDesk = 256e6;
/** Share of the limit for the decoded tiles of one worker; the rest is for the other worker and for pictures. */
const kTileShare = 0.35;
/** Share of the limit for the bytes of the tiles in a section, which are decoded one after the other: 30,000 buildings. */
const kSectionShare = 0.125;

/**
 * waiting: for the first picture.
 * following: tiles are being fetched, coarser ones while the camera moves.
 * resting: the picture stays while the camera stays, because all tiles are there, or cannot be fetched. Missing tiles
 *   are fetched again after a while.
 * ended: another model is open.
 */
type Phase = "waiting" | "following" | "resting" | "ended";

/** The camera and the size of the picture, and the time of their last change, in milliseconds of performance.now(). */
interface Place {
  camera: Camera | null;
  size: [number, number];
  since: number;
}

export interface CityHost extends ViewParts {
  selection: Selection;
  picture: ShownPicture;
}

export class CityStream extends Observable {
  /** The visible part of the city. */
  look: CityLook | null = null;
  /** No finer tiles could be chosen or fetched: how many are missing is unknown. */
  isStopped = false;
  /** Missing tiles are being fetched again. */
  isFetchingAgain = false;
  private phase: Phase = "waiting";
  private place: Place | null = null;
  /** The page still shows only the coarsest tile. */
  private isFirst = true;
  /** The tiles on the page were opened while the camera moved, without their features. */
  private lacksFeatures = false;
  /** The next look reads all tiles again. */
  private isAgain = false;
  /** Number of times that the page has fetched missing tiles again by itself, and the timer of the next time. */
  private rounds = 0;
  private timer: ReturnType<typeof setTimeout> | undefined;
  /** The message about an interruption. */
  private told: Message | null = null;
  private unwatch: () => void = () => {};
  private wake: () => void = () => {};

  constructor(
    readonly files: CityFiles,
    private readonly host: CityHost,
  ) {
    super();
  }

  /** Whether no finer tiles will follow while the camera stays. */
  get isComplete(): boolean {
    return this.phase === "resting";
  }
  /** The reason for each missing tile. */
  get lacks(): readonly string[] {
    return this.look?.lacks ?? [];
  }
  private get isEnded(): boolean {
    return this.phase === "ended";
  }
  private get engine(): Engine {
    return this.host.volume.engine!;
  }

  /** Opens the city with its coarsest tile. */
  async open(): Promise<VolumeInfo> {
    const look = await this.engine.openCity(this.files, { pixels: 1, memory: kTileShare * memoryOfCity(), shown: "" });
    this.take(look);
    return look.info!;
  }

  /** Begins to follow the camera, after the first picture. */
  begin(): void {
    const { view, picture } = this.host;
    this.unwatch = effect(() => {
      const { camera } = view.now;
      const { size } = view;
      if (picture.report) untracked(() => this.moved(camera, size));
    });
  }

  end(): void {
    this.phase = "ended";
    clearTimeout(this.timer);
    this.unwatch();
    this.wake();
  }

  /** Shows tiles that have replaced others; the view stays. */
  show(info: VolumeInfo): void {
    const { volume, view } = this.host;
    batch(() => {
      volume.info = { ...info, name: volume.info?.name ?? info.name };
      view.redraw();
    });
  }

  /** Searches the whole city for buildings by words of names and attributes. */
  search(words: string, most: number): Promise<CityFound> {
    return this.engine.searchCity(this.files, words, most);
  }

  /** Searches the whole city for a building by its id, and moves the camera to it. */
  async find(id: string): Promise<void> {
    const { view, selection, messages } = this.host;
    const { scene } = view.describe(view.size, 1);
    try {
      view.moveToFound(await this.engine.findInCity(this.files, id, scene.camera ?? {}, view.aspect));
      selection.select([id]);
    } catch (error) {
      messages.fail(error);
    }
  }

  /** The section of the whole city on a plane, from the tiles that the plane meets. */
  draw(plane: string, format: DrawingFormat): Promise<ArrayBuffer> {
    const { messages } = this.host;
    const tell = (step: string, share: number) => (messages.progress = { text: stageText(step), share });
    tell("tiles", -1);
    return this.engine.drawCity(this.files, plane, format, kSectionShare * memoryOfCity(), tell).finally(() => (messages.progress = null));
  }

  /** Fetches the missing tiles again, on request of the user. */
  fetchAgain(): void {
    if (this.isFetchingAgain || this.isEnded) return;
    this.rounds = 0;
    this.beginAgain();
  }

  private beginAgain(): void {
    clearTimeout(this.timer);
    // Reasons begin with the name of the file.
    this.files.forget([...new Set(this.lacks.map((reason) => reason.split(":")[0]!))]);
    this.isAgain = this.isFetchingAgain = true;
    this.beginToFollow();
  }

  /** Plans the next attempt, if tiles are missing. */
  private planAgain(): void {
    clearTimeout(this.timer);
    this.isFetchingAgain = false;
    if (!this.isStopped && !this.lacks.length) {
      this.rounds = 0;
      return;
    }
    const wait = roundMs(this.rounds, this.files.askedUntil - Date.now());
    if (wait === null) return;
    this.timer = setTimeout(() => {
      ++this.rounds;
      this.beginAgain();
    }, wait);
  }

  private moved(camera: Camera | null, size: [number, number]): void {
    if (this.place?.camera === camera && this.place.size === size) return;
    this.place = { camera, size, since: performance.now() };
    clearTimeout(this.timer);
    this.beginToFollow();
  }

  private beginToFollow(): void {
    if (this.phase === "following") return;
    this.phase = "following";
    void this.follow();
  }

  private async follow(): Promise<void> {
    for (;;) {
      const place = this.place!;
      const isDone = await this.step(place);
      if (this.isEnded) return;
      if (isDone && this.place === place && !this.isAgain) break;
    }
    this.phase = "resting";
    this.planAgain();
  }

  /** Looks once from a place. Resolves to true if no finer look from there will follow. */
  private async step(place: Place): Promise<boolean> {
    const isStill = performance.now() - place.since >= kStillAfter;
    const pixels = this.isFirst ? kFirstPixels : isStill ? kStillPixels : kMovingPixels;
    try {
      await this.fetch(pixels);
    } catch (error) {
      // The visible tiles stay; the next movement tries again, and so does planAgain().
      if (!this.isEnded) this.interrupted(error);
      return true;
    }
    this.isFirst = false;
    this.continued();
    const isLast = pixels === kStillPixels && this.place === place;
    if (isLast) await this.fetchFeatures();
    else if (pixels < kFirstPixels) await this.pause();
    return isLast;
  }

  private interrupted(error: unknown): void {
    const { messages } = this.host;
    if (!this.isFetchingAgain) {
      messages.fail(error, t("cityStopped"));
      this.told = messages.message;
    }
    this.isStopped = true;
  }

  private continued(): void {
    const { messages } = this.host;
    if (this.told && messages.message === this.told) messages.message = null;
    this.told = null;
    this.isStopped = false;
  }

  private async fetch(pixels: number): Promise<void> {
    const { view } = this.host;
    const { scene } = view.describe(view.size, 1);
    const isMoving = pixels > kStillPixels;
    const shown = this.isAgain ? "" : (this.look?.key ?? "");
    this.isAgain = false;
    const options = { pixels, memory: kTileShare * memoryOfCity(), shown, isMoving };
    const look = await this.engine.followCity(this.files, scene, view.size, options);
    if (this.isEnded) return;
    if (look.info) {
      this.take(look);
      this.lacksFeatures = isMoving;
      if (isMoving) view.redraw();
      else this.show(look.info);
    } else if (this.look) this.look = { ...this.look, pixels: look.pixels };
  }

  private async fetchFeatures(): Promise<void> {
    if (!this.lacksFeatures) return;
    const info = await this.engine.cityInfo().catch(() => null);
    if (this.isEnded || !info) return;
    this.lacksFeatures = false;
    this.show(info);
  }

  private take(look: CityLook): void {
    const before = this.lacks.length;
    this.look = look;
    const n = look.lacks.length;
    if (n && n !== before) this.host.messages.say(t("cityLacks", { n, first: look.lacks[0]! }));
    else if (before && !n) this.host.messages.say(t("cityAllThere"));
  }

  private pause(): Promise<void> {
    return new Promise((done) => {
      this.wake = done;
      setTimeout(done, kPause);
    });
  }
}

function memoryOfCity(): number {
  const device = (navigator as { deviceMemory?: number }).deviceMemory ?? 8;
  const isPhone = device < 4 || matchMedia("(max-width: 759px) and (pointer: coarse)").matches;
  return isPhone ? kPhone : kDesk;
}
