/**
 * A plan and two upright sections beside the picture, through one point. A click in one of them, or in the picture, moves the
 * point. Only a section that has changed is drawn again, one at a time.
 */

import { css, html, type PropertyValues } from "lit";
import {
  cameraOf,
  insideBox,
  kPanes,
  middleOfBox,
  panned,
  planeOf,
  pointIn,
  toGrid,
  wholeFrame,
  zoomed,
  type Frame,
  type PaneName,
} from "../camera/pane_camera";
import { project, toWorld } from "../camera/camera";
import type { Point, VolumeInfo } from "../engine";
import { isSameChoice, type ViewState } from "../state/view_state";
import { number, t } from "../texts";
import { lateText } from "../late_texts";
import { controls, Part } from "../ui/part";

const kNames = Object.keys(kPanes) as PaneName[];
const kClickSlop = 5;
/** Milliseconds at rest after which a section has all pixels. */
const kStillAfter = 180;
/** Share of the pixels along each side while a section moves. */
const kMovingShare = 0.5;
/** Steps of the keys: share of the height for the point, metres for the plane. */
const kStep = 0.02,
  kPlaneStep = 0.1;
/** Limits of the visible height, as shares of the height of the whole section. */
const kNearest = 0.002,
  kFarthest = 4;

interface Pane {
  /** null: the whole section. */
  frame: Frame | null;
  /** The drawn scene. */
  drawn: string;
  changedAt: number;
  hasFailed: boolean;
}

export class SectionPanes extends Part {
  static override properties = { ...Part.properties, at: { state: true }, revision: { state: true } };
  /** The point of all sections, in axes of the grid; null: not chosen yet. */
  declare at: Point | null;
  declare revision: number;
  private readonly panes = Object.fromEntries(
    kNames.map((name): [PaneName, Pane] => [name, { frame: null, drawn: "", changedAt: 0, hasFailed: false }]),
  ) as Record<PaneName, Pane>;
  private readonly made = new Map<string, { from: unknown[]; state: ViewState; scene: string }>();
  private seenInfo: VolumeInfo | null = null;
  private isDrawing = false;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private readonly fingers = new Map<number, { x: number; y: number }>();
  private press: { x: number; y: number; isMoved: boolean } | null = null;
  private readonly watched = new ResizeObserver(() => ++this.revision);

  static override styles = [
    controls,
    css`
      :host { pointer-events: none; }
      section { position: absolute; width: 50%; height: 50%; overflow: hidden; background: var(--stage); border: 0 solid var(--line-strong); pointer-events: auto; }
      #plan { left: 50%; top: 0; border-width: 0 0 1px 1px; }
      #front { left: 0; top: 50%; border-width: 1px 1px 0 0; }
      #side { left: 50%; top: 50%; border-width: 1px 0 0; }
      .stage { position: absolute; inset: 0; touch-action: none; cursor: crosshair; outline-offset: -3px !important; }
      canvas, svg { position: absolute; inset: 0; width: 100%; height: 100%; pointer-events: none; }
      line { stroke: var(--accent); stroke-width: 1; stroke-dasharray: 5 4; vector-effect: non-scaling-stroke; }
      h2 { position: absolute; left: 8px; top: 8px; max-width: calc(100% - 16px); padding: 2px 8px; border-radius: 6px; background: var(--panel); border: 1px solid var(--line); font-size: 12px; pointer-events: none; }
      p { position: absolute; left: 12px; right: 12px; top: 45%; text-align: center; }
    `,
  ];

  constructor() {
    super();
    this.at = null;
    this.revision = 0;
  }

  override connectedCallback(): void {
    super.connectedCallback();
    this.watched.observe(this);
  }
  override disconnectedCallback(): void {
    this.watched.disconnect();
    clearTimeout(this.timer);
    super.disconnectedCallback();
  }

  /** Moves the sections to a point in world axes, metres from the grid's lower corner. */
  moveTo(point: Point): void {
    this.move(toGrid(this.session.volume.box, point));
  }

  /** Whether all sections show the view with all their pixels. */
  get isComplete(): boolean {
    return this.at !== null && kNames.every((name) => this.panes[name].drawn === this.sceneOf(name, 1));
  }

  override willUpdate(_: PropertyValues): void {
    const { info, box } = this.session.volume;
    if (this.seenInfo === info) return;
    // A finer volume keeps the point.
    for (const pane of Object.values(this.panes)) pane.drawn = "";
    this.seenInfo = info;
    this.at = this.at ? insideBox(box, this.at) : this.begin();
  }

  /** Through the middle of the selection, or else of the model. */
  private begin(): Point {
    const { selection, volume } = this.session;
    const chosen = selection.properties?.box;
    const { low, high } = chosen ?? volume.box;
    return chosen ? insideBox(volume.box, low.map((v, i) => (v + high[i]!) / 2) as Point) : middleOfBox(volume.box);
  }

  override render() {
    void this.session.view.revision;
    const { at } = this;
    return at && kNames.map((name) => this.pane(name, at));
  }

  private pane(name: PaneName, at: Point) {
    const { axis } = kPanes[name];
    const title = `${lateText(`pane_${name}`)}: ${"xyz"[axis]} = ${number(at[axis], 2)} m`;
    const { x, y } = this.placeOf(name, at);
    const [across, down] = [100 * x, 100 * y];
    return html`<section id=${name} aria-label=${title}>
      <canvas aria-hidden="true"></canvas>
      <svg aria-hidden="true" viewBox="0 0 100 100" preserveAspectRatio="none"><line x1=${across} x2=${across} y1="0" y2="100"></line><line x1="0" x2="100" y1=${down} y2=${down}></line></svg>
      <div class="stage" tabindex="0" role="application" aria-roledescription=${t("picture")} aria-label="${title}. ${lateText("paneKeys")}"
        @pointerdown=${(e: PointerEvent) => this.pressed(e)} @pointermove=${(e: PointerEvent) => this.dragged(e, name)}
        @pointerup=${(e: PointerEvent) => this.released(e, name)} @pointercancel=${(e: PointerEvent) => this.lost(e)}
        @wheel=${(e: WheelEvent) => this.wheeled(e, name)} @keydown=${(e: KeyboardEvent) => this.key(e, name)} @contextmenu=${(e: Event) => e.preventDefault()}></div>
      <h2>${title}</h2>
      ${this.panes[name].hasFailed ? html`<p class="quiet">${lateText("paneFailed")}</p>` : ""}
    </section>`;
  }

  override updated(): void {
    void this.draw();
  }

  private stageOf(name: PaneName): HTMLElement | null {
    return this.renderRoot.querySelector(`#${name}`);
  }
  private aspectOf(name: PaneName): number {
    const stage = this.stageOf(name);
    return stage?.clientHeight ? stage.clientWidth / stage.clientHeight : 1;
  }
  private frameOf(name: PaneName): Frame {
    return this.panes[name].frame ?? wholeFrame(name, this.session.volume.box, this.aspectOf(name));
  }
  private placeOf(name: PaneName, at: Point): { x: number; y: number } {
    const { box } = this.session.volume;
    return project(cameraOf(name, box, this.frameOf(name)), this.aspectOf(name), toWorld(box, at), box.axes) ?? { x: 0.5, y: 0.5 };
  }

  /** Draws the sections that have changed: with fewer pixels while they move. */
  private async draw(): Promise<void> {
    if (this.isDrawing) return;
    this.isDrawing = true;
    clearTimeout(this.timer);
    try {
      for (let next = this.next(); next && this.isConnected; next = this.next()) await this.drawPane(next.name, next.scene);
    } finally {
      this.isDrawing = false;
    }
  }

  /** The next section to draw, with its scene; null: all are drawn, or a timer waits. */
  private next(): { name: PaneName; scene: string } | null {
    for (const isMoving of [true, false])
      for (const name of kNames) {
        const pane = this.panes[name];
        const fine = this.sceneOf(name, 1);
        if (fine === null || pane.drawn === fine) continue;
        const coarse = this.sceneOf(name, kMovingShare)!;
        if (isMoving) {
          if (pane.drawn !== coarse) return { name, scene: coarse };
          continue;
        }
        const rest = pane.changedAt + kStillAfter - performance.now();
        if (rest <= 0) return { name, scene: fine };
        this.timer = setTimeout(() => void this.draw(), rest);
        return null;
      }
    return null;
  }

  /** The scene of a section as JSON; null: nothing can be drawn yet. The camera of the view does not change it. */
  private sceneOf(name: PaneName, share: number): string | null {
    const { view, volume } = this.session;
    const stage = this.stageOf(name);
    if (!stage?.clientWidth || !stage.clientHeight || !this.at || !volume.info) return null;
    const ratio = Math.min(window.devicePixelRatio || 1, 2) * share;
    const size = [stage.clientWidth, stage.clientHeight].map((v) => Math.max(16, Math.round(v * ratio))) as [number, number];
    const { selection, selectedBy } = view.state;
    const from = [...size, this.at[kPanes[name].axis], this.panes[name].frame, volume.info, view.hidden, view.mark, selection, selectedBy];
    const key = `${name} ${share}`;
    const made = this.made.get(key);
    if (made && isSameChoice(made.state, view.state) && from.every((v, i) => v === made.from[i])) return made.scene;
    const scene = this.describe(name, size, this.at);
    this.made.set(key, { from, state: view.state, scene });
    return scene;
  }

  /** The view without what belongs to one picture: effects, names, colours with a legend, the user's own planes. */
  private describe(name: PaneName, size: [number, number], at: Point): string {
    const { view, volume } = this.session;
    const state: ViewState = {
      ...view.state,
      effect: "none",
      names: false,
      named: [],
      colorBy: "",
      picture: {},
      sun: null,
      custom: null,
      regions: [],
      camera: cameraOf(name, volume.box, this.frameOf(name)),
      sections: [planeOf(name, at)],
    };
    return JSON.stringify(view.describe(size, 1, true, state).scene);
  }

  private async drawPane(name: PaneName, scene: string): Promise<void> {
    const pane = this.panes[name];
    const { engine, info } = this.session.volume;
    let hasFailed = false;
    try {
      const bitmap = await createImageBitmap(new Blob([await engine!.picture(JSON.parse(scene))], { type: "image/png" }));
      this.renderRoot.querySelector<HTMLCanvasElement>(`#${name} canvas`)?.getContext("bitmaprenderer")?.transferFromImageBitmap(bitmap);
    } catch {
      hasFailed = true;
    }
    // Another volume is open: the section is drawn again.
    if (info !== this.session.volume.info) return;
    if (pane.drawn === "" || hasFailed !== pane.hasFailed) ++this.revision;
    pane.hasFailed = hasFailed;
    pane.drawn = scene;
    pane.changedAt = performance.now();
  }

  private move(at: Point): void {
    this.at = insideBox(this.session.volume.box, at);
    this.session.messages.say(`x ${number(this.at[0], 2)}, y ${number(this.at[1], 2)}, z ${number(this.at[2], 2)} m`);
  }

  private show(name: PaneName, frame: Frame | null): void {
    const whole = wholeFrame(name, this.session.volume.box, this.aspectOf(name)).height;
    if (frame && (frame.height < whole * kNearest || frame.height > whole * kFarthest)) return;
    this.panes[name].frame = frame;
    ++this.revision;
  }

  private pointAt(event: MouseEvent, name: PaneName): Point {
    const { left, top, width, height } = this.stageOf(name)!.getBoundingClientRect();
    const [x, y] = [(event.clientX - left) / width, (event.clientY - top) / height];
    return pointIn(name, this.session.volume.box, this.frameOf(name), this.aspectOf(name), x, y, this.at!);
  }

  private pressed(event: PointerEvent): void {
    const stage = event.currentTarget as HTMLElement;
    stage.focus({ preventScroll: true });
    try {
      stage.setPointerCapture(event.pointerId);
    } catch {
      // A pointer that is already gone cannot be captured.
    }
    this.fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    this.press = this.fingers.size === 1 ? { x: event.clientX, y: event.clientY, isMoved: false } : null;
  }

  private dragged(event: PointerEvent, name: PaneName): void {
    const finger = this.fingers.get(event.pointerId);
    if (!finger) return;
    const { press } = this;
    if (press && !press.isMoved && Math.hypot(event.clientX - press.x, event.clientY - press.y) < kClickSlop) return;
    if (press) press.isMoved = true;
    const height = this.stageOf(name)!.clientHeight;
    const share = 1 / this.fingers.size;
    const frame = panned(
      name,
      this.frameOf(name),
      ((event.clientX - finger.x) / height) * share,
      ((event.clientY - finger.y) / height) * share,
    );
    const other = [...this.fingers].find(([id]) => id !== event.pointerId)?.[1];
    const between = (x: number, y: number) => Math.max(1, Math.hypot(x - (other?.x ?? 0), y - (other?.y ?? 0)));
    const factor = other ? between(finger.x, finger.y) / between(event.clientX, event.clientY) : 1;
    this.show(name, zoomed(frame, this.pointAt(event, name), factor));
    this.fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  }

  private released(event: PointerEvent, name: PaneName): void {
    if (this.press && !this.press.isMoved && event.button === 0) this.move(this.pointAt(event, name));
    this.lost(event);
  }

  private lost(event: PointerEvent): void {
    this.fingers.delete(event.pointerId);
    this.press = null;
  }

  private wheeled(event: WheelEvent, name: PaneName): void {
    event.preventDefault();
    this.show(name, zoomed(this.frameOf(name), this.pointAt(event, name), Math.exp(Math.max(-200, Math.min(200, event.deltaY)) * 0.0015)));
  }

  private key(event: KeyboardEvent, name: PaneName): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { right, up, axis, towards } = kPanes[name];
    const frame = this.frameOf(name);
    const at: Point = [...this.at!];
    const [dx, dy] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key] ?? [0, 0];
    const plane = { PageUp: 1, PageDown: -1 }[event.key] ?? 0;
    const factor = { "+": 0.8, "-": 1.25 }[event.key];
    if (!dx && !dy && !plane && !factor && event.key !== "0") return;
    event.preventDefault();
    event.stopPropagation();
    if (factor) this.show(name, zoomed(frame, at, factor));
    else if (event.key === "0") this.show(name, null);
    else if (event.shiftKey) this.show(name, panned(name, frame, -0.1 * dx!, 0.1 * dy!));
    else {
      at[right] += dx! * kStep * frame.height;
      at[up] += dy! * kStep * frame.height;
      at[axis] += plane * towards * kPlaneStep;
      this.move(at);
    }
  }
}
customElements.define("svt-section-panes", SectionPanes);
