/** The picture on the page, which lags behind the view by a frame, and its quality, planes and colours. */

import { PictureLoop, type Quality } from "../canvas/picture_loop";
import type { ColorScale, Engine, EngineError, FrameReport, MovedPlane } from "../engine";
import { effect, untracked } from "../observable";
import { roomClasses, withSolidRooms } from "../state/color_keys";
import { cutOf, type Described } from "../state/scene_of";
import { isSameChoice, type Camera, type ViewState } from "../state/view_state";
import { movedText, t } from "../texts";
import { ViewPart, type ViewParts } from "./view_part";

/** Code of errors after which the library has no volume. */
const kFatal = "E999";
/** Code of the error that a part of the library cannot be loaded. */
const kNotLoaded = "E101";
const kMostRefusals = 3;

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
  /** The last view that was drawn; null: none yet. */
  private drawable: ViewState | null = null;
  /** Number of views in succession that could not be drawn. */
  private refusals = 0;
  /** The view whose colours have `scale`, and the state of their data. */
  private scaled: ViewState | null = null;
  private scaledData = 0;
  /** The cut whose planes were compared with faces. */
  private seenCut: string | null = null;

  constructor(parts: ViewParts) {
    super(parts);
    effect(() => {
      if (this.view.revision) untracked(() => this.redraw());
    });
  }

  /** @param died  called when the library has stopped */
  start(engine: Engine, died: (error: EngineError) => void): void {
    const { volume, view } = this;
    this.loop = new PictureLoop({
      engine,
      size: () => view.size,
      describe: (size, samples, quality) => {
        if (!volume.info || volume.isLost) return null;
        const described = view.describe(size, samples, true);
        if (quality === "moving") return withVoxels(described);
        // A graphics card draws voxels at once; faces are drawn by the CPU.
        return quality === "fine" && this.report?.engine !== "webgl2" ? described : withoutFaces(described);
      },
      take: () => view.state,
      shown: (report, quality, token) => this.shown(report, quality, token as ViewState),
      failed: (error, token) => {
        if (error.code === kFatal) {
          this.messages.fail(error);
          died(error);
        } else if (error.code === kNotLoaded && view.hasFaces && this.wasDrawn(token as ViewState)) {
          // Another worker has begun, without a connection: voxels remain.
          view.hasFaces = false;
          view.redraw();
        } else this.refuse(error, token as ViewState);
      },
    });
  }

  /** Whether a picture of the same choice was drawn; pictures of a moving view have no faces. */
  private wasDrawn(state: ViewState): boolean {
    return this.drawable !== null && isSameChoice(state, this.drawable);
  }

  /** Takes back a choice that cannot be drawn, so that the picture goes on following the camera. */
  private refuse(error: EngineError, refused: ViewState): void {
    const { view, messages } = this;
    // A newer view is drawn next, and may be good.
    if (!isSameChoice(view.state, refused)) return;
    if (this.refusals >= kMostRefusals) return messages.fail(error);
    const { drawable } = this;
    view.refuse(refused, drawable, this.refusals++ > 0);
    const repairs = refused.colorBy && refused.colorBy !== drawable?.colorBy ? this.solidRooms(refused.colorBy) : [];
    messages.refuse(error, t("refused"), repairs);
  }

  private solidRooms(key: string) {
    const { index } = this.volume;
    const act = () => {
      this.messages.message = null;
      this.view.set(withSolidRooms(this.view.state, key, index, true));
    };
    return roomClasses(index).length ? [{ text: t("makeRoomsSolid"), act }] : [];
  }

  /** Called when another model is opened. */
  forget(): void {
    this.moved = [];
    this.seenCut = null;
    this.report = null;
    this.drawable = this.scaled = this.scale = null;
    this.refusals = 0;
  }

  private redraw(): void {
    this.quality = null;
    this.loop?.invalidate();
  }

  private shown(report: FrameReport, quality: Quality, state: ViewState): void {
    if (!this.report) performance.mark("svt-first-image");
    this.drawable = state;
    this.refusals = 0;
    this.report = report;
    this.quality = quality;
    this.camera = state.camera;
    this.view.refit(report.width / report.height);
    if (quality !== "moving") void this.findMoved(state);
    if (quality !== "moving") void this.findScale(state);
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

  /** The meaning of the colours, once per change. */
  private async findScale(state: ViewState): Promise<void> {
    const { dataRevision } = this.view;
    if (this.scaled && isSameChoice(state, this.scaled) && this.scaledData === dataRevision) return;
    this.scaled = state;
    this.scaledData = dataRevision;
    const { engine } = this.volume;
    const legend = async () => engine!.legend(await this.view.composed(this.view.size));
    const scale = (state.colorBy || state.field) && engine ? await legend().catch(() => null) : null;
    if (this.scaled === state && JSON.stringify(scale) !== JSON.stringify(this.scale)) this.scale = scale;
  }
}

/**
 * The scene without levels of detail. These blend at the borders of objects, so that rays pass through many voxels. Voxels take
 * a fifth of the time, and the picture gets more pixels.
 */
function withVoxels({ scene, effects }: Described): Described {
  const passes = (scene.passes ?? [{}]).map((pass) => ({ level: 0, ...pass }));
  return withoutFaces({ scene: { ...scene, passes }, effects });
}

function withoutFaces({ scene, effects }: Described): Described {
  return { scene: { ...scene, surfaces: "voxels" }, effects };
}
