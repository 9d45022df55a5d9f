/** The picture on the page, which lags behind the view by a frame, and its quality, planes and colours. */

import { PictureLoop, type Quality } from "../canvas/picture_loop";
import type { ColorScale, Engine, EngineError, FrameReport, MovedPlane } from "../engine";
import { effect, untracked } from "../observable";
import { cutOf } from "../state/scene_of";
import type { Camera, ViewState } from "../state/view_state";
import { movedText } from "../texts";
import { ViewPart, type ViewParts } from "./view_part";

export class ShownPicture extends ViewPart {
  /** null: the open model does not have a picture yet. */
  report: FrameReport | null = null;
  /** null: another picture follows. */
  quality: Quality | null = null;
  camera: Camera | null = null;
  /** Section planes that are drawn beside faces of the model in which they lie. */
  moved: MovedPlane[] = [];
  /** The meaning of the colours, for readers who cannot see the legend; null: the picture has no legend. */
  scale: ColorScale | null = null;
  private loop: PictureLoop | null = null;
  /** The cut whose planes were compared with faces. */
  private seenCut: string | null = null;

  constructor(parts: ViewParts) {
    super(parts);
    effect(() => {
      if (this.view.revision) untracked(() => this.redraw());
    });
  }

  /** @param failed  called with the errors of pictures */
  start(engine: Engine, failed: (error: EngineError) => void): void {
    const { volume, view } = this;
    this.loop = new PictureLoop({
      engine,
      size: () => view.size,
      describe: (size, samples) => (volume.info ? view.describe(size, samples) : null),
      take: () => view.state,
      shown: (report, quality, token) => this.shown(report, quality, token as ViewState),
      failed,
    });
  }

  /** Called when another model is opened. */
  forget(): void {
    this.moved = [];
    this.seenCut = null;
    this.report = null;
  }

  private redraw(): void {
    this.quality = null;
    this.loop?.invalidate();
  }

  private shown(report: FrameReport, quality: Quality, state: ViewState): void {
    if (!this.report) performance.mark("svt-first-image");
    this.report = report;
    this.quality = quality;
    this.camera = state.camera;
    this.view.refit(report.width / report.height);
    if (quality !== "moving") void this.findMoved(state);
    if (quality === "fine") void this.findScale(state);
  }

  /** Reports the planes that lie in faces, once per change. */
  private async findMoved({ sections, regions }: ViewState): Promise<void> {
    const { engine } = this.volume;
    const cut = cutOf(sections, regions);
    if (cut === this.seenCut || !engine) return;
    this.seenCut = cut;
    const moved = cut ? await engine.movedPlanes({ passes: [{ cut }] }).catch(() => []) : [];
    if (this.seenCut !== cut) return;
    const isNew = moved.some(({ text }) => !this.moved.some((other) => other.text === text));
    this.moved = moved;
    if (isNew) this.messages.say(movedText(moved));
  }

  private async findScale(state: ViewState): Promise<void> {
    const { engine } = this.volume;
    const legend = async () => engine!.legend(await this.view.composed(this.view.size));
    const scale = state.colorBy && engine ? await legend().catch(() => null) : null;
    if (this.view.state === state && JSON.stringify(scale) !== JSON.stringify(this.scale)) this.scale = scale;
  }
}
