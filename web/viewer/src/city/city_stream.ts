/**
 * A city that is open: one tile of it is the first picture; then the tiles that the camera sees are fetched, joined and
 * made ready in a second worker, which takes the place of the first. So pictures never wait for tiles.
 */

import type { CityLook, EngineError } from "../engine";
import { kCancelled } from "../engine";
import type { Session } from "../session";
import { t } from "../texts";
import type { CityFiles } from "./city_files";

/** Voxels may be so many pixels wide: of the first picture, of one that moves, of one that stands still. */
const kFirstPixels = 4,
  kMovingPixels = 2,
  kStillPixels = 1;
/** Milliseconds after which a camera stands still, and between two looks while it moves. */
const kStillAfter = 250,
  kPause = 100;
/** Of a phone, and of others: bytes that the page may take for the city. */
const kPhone = 128e6,
  kDesk = 256e6;
/** Share of them that the tiles of one worker may have when they are decoded; the rest is that of the other one, and of pictures. */
const kTileShare = 0.35;

export class CityStream {
  /** What is seen now. */
  look: CityLook | null = null;
  /** Whether nothing finer is to come while the camera stays. */
  isComplete = false;
  private key = "";
  private isRunning = false;
  private isEnded = false;
  private camera: unknown = null;
  private size: unknown = null;
  private changedAt = 0;
  private pixels = kFirstPixels;
  private readonly watch = () => this.follow();
  private wake: (() => void) | null = null;

  constructor(
    private readonly session: Session,
    readonly files: CityFiles,
  ) {}

  /** Opens it with its coarsest tile. */
  async open(): Promise<CityLook> {
    const look = await this.session.engine!.openCity(this.files, { pixels: 1, memory: this.memory, shown: "" });
    this.take(look);
    return look;
  }

  /** Begins to follow the camera, once the first picture stands. */
  begin(): void {
    this.session.addEventListener("change", this.watch);
    this.follow();
  }

  end(): void {
    this.isEnded = true;
    this.session.removeEventListener("change", this.watch);
    this.wake?.();
  }

  private get memory(): number {
    const device = (navigator as { deviceMemory?: number }).deviceMemory ?? 8;
    const isPhone = device < 4 || matchMedia("(max-width: 759px) and (pointer: coarse)").matches;
    return (isPhone ? kPhone : kDesk) * kTileShare;
  }

  private take(look: CityLook): void {
    this.look = look;
    this.key = look.key;
    if (look.lacks.length) this.session.tell(t("cityLacks", { n: look.lacks.length, first: look.lacks[0]! }));
  }

  private follow(): void {
    const { state, pictureSize, report } = this.session;
    if (!report || (this.camera === state.camera && this.size === pictureSize)) return;
    this.camera = state.camera;
    this.size = pictureSize;
    this.changedAt = performance.now();
    this.isComplete = false;
    if (this.pixels < kMovingPixels) this.pixels = kMovingPixels;
    if (!this.isRunning) void this.run();
  }

  private async run(): Promise<void> {
    this.isRunning = true;
    try {
      while (!this.isEnded && !this.isComplete) await this.step();
    } finally {
      this.isRunning = false;
    }
  }

  private async step(): Promise<void> {
    const { session } = this;
    const { camera, size } = this;
    const still = performance.now() - this.changedAt;
    if (this.pixels <= kMovingPixels) this.pixels = still < kStillAfter ? kMovingPixels : kStillPixels;
    const { pixels } = this;
    try {
      const { scene } = session.describe(session.pictureSize, 1);
      const look = await session.engine!.followCity(this.files, scene, session.pictureSize, {
        pixels,
        memory: this.memory,
        shown: this.key,
        isMoving: pixels > kStillPixels,
      });
      if (this.isEnded) return;
      if (look.info) {
        this.take(look);
        this.isInfoDue = pixels > kStillPixels;
        if (this.isInfoDue) session.redraw();
        else session.takeTiles(look.info);
      } else if (this.look) this.look = { ...this.look, pixels: look.pixels };
    } catch (error) {
      if ((error as EngineError).code === kCancelled || this.isEnded) return this.stop();
      // What stands stays; the next movement tries again.
      session.fail(error, t("cityStopped"));
      return this.stop();
    }
    const isSame = this.camera === camera && this.size === size;
    if (isSame && pixels === kStillPixels) {
      await this.takeInfo();
      this.isComplete = this.camera === camera && this.size === size;
      session.changed();
    } else if (pixels > kMovingPixels) this.pixels = kMovingPixels;
    else if (!isSame || pixels === kMovingPixels) await this.pause();
    if (this.pixels === kMovingPixels && isSame && performance.now() - this.changedAt >= kStillAfter) this.pixels = kStillPixels;
  }

  /** Features of what was opened while the camera moved. */
  private async takeInfo(): Promise<void> {
    if (!this.isInfoDue) return;
    const info = await this.session.engine!.cityInfo().catch(() => null);
    if (this.isEnded || !info) return;
    this.isInfoDue = false;
    this.session.takeTiles(info);
  }
  private isInfoDue = false;

  private stop(): void {
    this.isComplete = true;
    this.session.changed();
  }

  private pause(): Promise<void> {
    return new Promise((done) => {
      this.wake = done;
      setTimeout(done, kPause);
    });
  }

  /** Looks for a building in all of the city, and goes there. */
  async find(id: string): Promise<void> {
    const { session } = this;
    const { scene } = session.describe(session.pictureSize, 1);
    try {
      const camera = await session.engine!.findInCity(this.files, id, scene.camera ?? {}, session.aspect);
      session.goToFound(id, camera);
    } catch (error) {
      session.fail(error);
    }
  }
}
