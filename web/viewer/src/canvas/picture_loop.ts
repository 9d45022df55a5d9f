/**
 * Draws the session whenever it changes: coarse while it moves, then at full resolution, then with as many
 * rays per pixel as a scene has by default. Only one frame is requested at a time, always the newest.
 */

import type { Engine, EngineError, FrameReport, Samples } from "../engine";
import { kSceneMembers } from "../generated/scene_members";
import type { Described } from "../state/scene_of";
import { pixelsAt, Resolution } from "./resolution";

/** Coarse while moving, then full resolution, then antialiased. */
export type Quality = "moving" | "full" | "fine";

export interface PictureHost {
  engine: Engine;
  /** Size of the canvas, device pixels. */
  size(): [number, number];
  describe(size: [number, number], samples: Samples, quality: Quality): Described | null;
  /** Called when a frame is on the canvas; `token` is the result of take() when it was requested. */
  shown(report: FrameReport, quality: Quality, token: unknown): void;
  take(): unknown;
  failed(error: EngineError, token: unknown): void;
}

const kStillAfter = 140;
/** A picture cannot be cancelled, so a slow one waits until the input has stopped. */
const kFineAfter = 200,
  kFineAfterSlow = 2500;

export class PictureLoop {
  private readonly resolution = new Resolution();
  private quality: Quality | null = null;
  private isRunning = false;
  private changedAt = 0;
  private timer = 0;
  /** Time of the last picture at full resolution: with one ray per pixel, and with all. */
  private fullMilliseconds = 0;
  private fineMilliseconds = 0;

  constructor(private readonly host: PictureHost) {}

  /** Something changed. */
  invalidate(): void {
    this.changedAt = performance.now();
    this.quality = null;
    this.wake();
  }

  private wake(): void {
    clearTimeout(this.timer);
    if (!this.isRunning) void this.run();
  }

  private async run(): Promise<void> {
    this.isRunning = true;
    try {
      for (;;) {
        const next = this.next();
        if (next === null) return;
        if (typeof next === "number") {
          this.timer = window.setTimeout(() => this.wake(), next);
          return;
        }
        await this.draw(next);
      }
    } finally {
      this.isRunning = false;
    }
  }

  /** The quality to draw now, or milliseconds until the next check; null: nothing to do. */
  private next(): Quality | number | null {
    const still = performance.now() - this.changedAt;
    if (this.quality === null) return "moving";
    if (this.quality === "moving") {
      if (still < kStillAfter) return kStillAfter - still;
      return this.resolution.share === 1 ? this.afterFull(still) : "full";
    }
    return this.quality === "full" ? this.afterFull(still) : null;
  }

  private afterFull(still: number): Quality | number {
    const after = Math.min(kFineAfterSlow, Math.max(kFineAfter, this.fullMilliseconds, this.fineMilliseconds / 2));
    return still < after ? after - still : "fine";
  }

  private async draw(quality: Quality): Promise<void> {
    const size = pixelsAt(this.host.size(), quality === "moving" ? this.resolution.share : 1);
    const described = this.host.describe(size, quality === "fine" ? kSceneMembers["/samples"].default : 1, quality);
    this.quality = quality;
    if (!described) return;
    const token = this.host.take();
    try {
      const { engine } = this.host;
      const hasEffect = Object.keys(described.effects).length > 0;
      const scene = hasEffect ? await engine.compose(described.scene, described.effects) : described.scene;
      const report = await engine.draw(scene, size[0], size[1]);
      if (!report) return;
      if (quality === "full") this.fullMilliseconds = report.milliseconds;
      if (quality === "fine") this.fineMilliseconds = report.milliseconds;
      if (quality === "moving") this.resolution.learn(report.milliseconds);
      // Later changes are not in this picture.
      this.host.shown(report, this.quality === quality ? quality : "moving", token);
    } catch (error) {
      // Drawing failed in this state; the next change tries again.
      if (this.quality === quality) this.quality = "fine";
      this.host.failed(error as EngineError, token);
    }
  }
}
