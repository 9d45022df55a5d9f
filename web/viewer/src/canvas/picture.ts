/** The picture: the engine's canvas, its overlays, and mouse, touch and key input. */

import { css, html, nothing, svg } from "lit";
import { Controls } from "../camera/controls";
import type { Pick } from "../engine";
import { t } from "../texts";
import { controls, Part } from "../ui/part";
import { labelOf } from "../state/feature_index";
import { ofId } from "../state/queries";
import { askForMenu, isMenuKey } from "../panels/menu_request";
import { dragged, rangeOf } from "../tools/plane_outline";
import { compass, handleOf, place, planes, selectionBox, type PictureTools, type View } from "./overlay";

const kHoverEvery = 80;
/** The splitters load after the first picture. Then panels have other sizes for some frames. */
const kFramesToSettle = 8;
const kSplitter = "wa-split-panel";

/** A click on the picture, before it selects anything: preventDefault() keeps the selection. */
export type PickEvent = CustomEvent<{ pick: Pick | null; x: number; y: number }>;

/**
 * page: takes all mouse, touch and key input.
 * part: a part of another page. It does not scroll that page until it has the focus.
 * still: no input, and nothing over the picture.
 */
export type Inputs = "page" | "part" | "still";

export class PictureView extends Part {
  static override properties = {
    ...Part.properties,
    canvas: { attribute: false },
    inputs: { attribute: false },
    isBare: { attribute: false },
    tools: { attribute: false },
    label: { attribute: false },
    hover: { state: true },
    size: { state: true },
  };
  declare canvas: HTMLCanvasElement;
  declare inputs: Inputs;
  /** No planes with handles and no axes over the picture. */
  declare isBare: boolean;
  /** null: none. */
  declare tools: PictureTools | null;
  /** Replaces the description for screen readers; empty: the name of the model. */
  declare label: string;
  declare hover: { pick: Pick; x: number; y: number } | null;
  /** CSS pixels. */
  declare size: [width: number, height: number];
  private readonly watched = new ResizeObserver(() => this.measureAfter(1));
  /** Frames until the next measurement of the size; 0: no measurement. */
  private framesToMeasure = 0;
  private hoverTimer = 0;
  private hoverAt: { x: number; y: number } | null = null;
  private drag: { n: number; x: number; y: number; at: number } | null = null;

  static override styles = [
    controls,
    css`
      :host { position: relative; display: block; width: 100%; height: 100%; overflow: hidden; background: var(--stage); }
      .stage { position: absolute; inset: 0; touch-action: none; cursor: default; outline-offset: -3px !important; }
      .stage.measuring { cursor: crosshair; }
      .stage.part:not(:focus) { touch-action: pan-y; }
      .stage.still { pointer-events: none; }
      ::slotted(canvas), canvas { position: absolute; inset: 0; width: 100%; height: 100%; pointer-events: none; }
      svg.over { position: absolute; inset: 0; width: 100%; height: 100%; pointer-events: none; overflow: hidden; }
      .plane { fill: var(--accent); fill-opacity: 0.07; stroke: var(--accent); stroke-width: 1.5; stroke-dasharray: 6 4; }
      .box-under { fill: none; stroke: #fff; stroke-opacity: 0.7; stroke-width: 3; }
      .box { fill: none; stroke: var(--mark); stroke-width: 1.5; }
      .measure { fill: var(--mark); fill-opacity: 0.12; stroke: var(--mark); stroke-width: 2; }
      .dot { fill: #fff; stroke: var(--mark); stroke-width: 2; }
      .over text { font: 600 12px var(--sans); fill: #14181b; stroke: #fff; stroke-width: 3.5; paint-order: stroke; font-variant-numeric: tabular-nums; }
      .compass line { stroke: var(--stage-quiet); stroke-width: 1.5; }
      .compass text { font-weight: 500; font-size: 11px; fill: var(--stage-quiet); stroke: none; }
      .handle {
        position: absolute; width: 34px; height: 34px; min-height: 0; margin: -17px 0 0 -17px; padding: 0; border-radius: 50%;
        background: var(--accent); color: var(--on-accent); border: 2px solid #fff; box-shadow: 0 1px 5px #0006; cursor: grab; touch-action: none;
        font-size: 12px; font-weight: 700;
      }
      @media (max-width: 759px), (pointer: coarse) { .handle { width: 44px; height: 44px; margin: -22px 0 0 -22px; } }
      .handle:hover { background: var(--accent); filter: brightness(1.1); }
      .handle:active { cursor: grabbing; }
      .tip {
        position: absolute; max-width: 240px; padding: 3px 8px; border-radius: 6px; background: var(--tip); color: var(--tip-text);
        font-size: 12px; pointer-events: none; overflow: hidden; text-overflow: ellipsis; white-space: nowrap;
      }
      .cross { position: absolute; left: 50%; top: 50%; width: 15px; height: 15px; margin: -8px; pointer-events: none; display: none; }
      .stage:focus-visible ~ .cross { display: block; }
      .cross path { stroke: var(--mark); stroke-width: 1.5; fill: none; }
    `,
  ];

  constructor() {
    super();
    this.inputs = "page";
    this.isBare = false;
    this.tools = null;
    this.label = "";
    this.hover = null;
    this.size = [1, 1];
  }

  override connectedCallback(): void {
    super.connectedCallback();
    this.watched.observe(this);
    if (!customElements.get(kSplitter)) void customElements.whenDefined(kSplitter).then(() => this.measureAfter(kFramesToSettle));
  }
  override disconnectedCallback(): void {
    this.watched.disconnect();
    super.disconnectedCallback();
  }

  override firstUpdated(): void {
    new Controls({
      session: this.session,
      element: this.stage,
      clicked: (x, y, event) => void this.clicked(x, y, event),
      listed: (x, y) => void this.session.selection.listAlong(x, y),
      menu: (x, y, at, isTouch) => void this.menu(x, y, at, isTouch),
      framed: (x, y) => void this.framed(x, y),
      hovered: (at) => this.hovered(at),
      wheeled: (event) => this.wheeled(event),
    });
    this.measureSize();
  }

  private get stage(): HTMLElement {
    return this.renderRoot.querySelector(".stage")!;
  }

  override focus(): void {
    this.stage.focus();
  }

  /** Measures the size only after some frames, because a size may last only for a moment. */
  private measureAfter(frames: number): void {
    const isWaiting = this.framesToMeasure > 0;
    this.framesToMeasure = Math.max(this.framesToMeasure, frames);
    if (!isWaiting) this.awaitFrame();
  }

  private awaitFrame(): void {
    requestAnimationFrame(() => {
      if (--this.framesToMeasure > 0) this.awaitFrame();
      else this.measureSize();
    });
  }

  private measureSize(): void {
    const { clientWidth: w, clientHeight: h } = this;
    if (!w || !h) return;
    this.size = [w, h];
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    this.session.view.resize([Math.max(16, Math.round(w * ratio)), Math.max(16, Math.round(h * ratio))]);
  }

  private async clicked(x: number, y: number, event: PointerEvent): Promise<void> {
    const { session } = this;
    if (!session.volume.engine || session.volume.isServerOnly || session.model.status !== "ready") return;
    const { state } = session.view;
    if (state.effect === "lens" && !state.lens.pinned && session.view.tool === "lens")
      return session.view.set({ lens: { ...state.lens, x, y, pinned: true } });
    if (this.tools?.click(x, y, event, this.size)) return;
    try {
      const pick = await session.volume.engine.pick(x, y);
      if (!this.asks(pick, x, y)) return;
      session.selection.picked(pick, event.ctrlKey || event.metaKey || event.shiftKey);
    } catch (error) {
      session.messages.fail(error);
    }
  }

  /** Selects the object at a point, unless it is selected already, and asks the page for the menu. Other pages have no menu. */
  private async menu(x: number, y: number, at: { x: number; y: number }, isTouch: boolean): Promise<void> {
    const { selection, volume, view, model } = this.session;
    if (this.inputs !== "page") return isTouch ? selection.listAlong(x, y) : undefined;
    if (!volume.engine || volume.isServerOnly || model.status !== "ready") return;
    const pick = await volume.engine.pick(x, y).catch(() => null);
    if (pick && !view.state.selection.includes(pick.id)) selection.select([pick.id]);
    this.hover = null;
    askForMenu(this, { ...at, inPicture: [x, y] });
  }

  /** The menu of the selection, or of the object in the middle. */
  private readonly menuKey = (event: KeyboardEvent): void => {
    if (!isMenuKey(event) || this.inputs !== "page") return;
    event.preventDefault();
    event.stopPropagation();
    const { left, top, width, height } = this.getBoundingClientRect();
    const at = { x: left + width / 2, y: top + height / 2 };
    if (this.session.selection.isEmpty) void this.menu(0.5, 0.5, at, false);
    else askForMenu(this, { ...at, inPicture: [0.5, 0.5] });
  };

  /** Whether the click may select. */
  private asks(pick: Pick | null, x: number, y: number): boolean {
    const event: PickEvent = new CustomEvent("svt-pick", { detail: { pick, x, y }, bubbles: true, cancelable: true });
    return this.dispatchEvent(event);
  }

  private async framed(x: number, y: number): Promise<void> {
    const pick = await this.session.volume.engine?.pick(x, y).catch(() => null);
    void this.session.view.goTo(pick ? ofId(pick.id) : "", null);
  }

  private wheeled(event: WheelEvent): boolean | "ignored" {
    if (this.inputs === "part" && !event.ctrlKey && !this.stage.matches(":focus")) return "ignored";
    const { state } = this.session.view;
    if (state.effect !== "lens" || !event.shiftKey) return false;
    const delta = event.deltaY || event.deltaX;
    const radius = Math.min(0.9, Math.max(0.04, state.lens.radius * Math.exp(-delta * 0.001)));
    this.session.view.set({ lens: { ...state.lens, radius } });
    return true;
  }

  private hovered(at: { x: number; y: number; isDown: boolean } | null): void {
    const { state } = this.session.view;
    if (at && state.effect === "lens" && !state.lens.pinned && !at.isDown)
      this.session.view.set({ lens: { ...state.lens, x: at.x, y: at.y } });
    this.hover = null;
    this.hoverAt = at && !at.isDown ? at : null;
    if (!this.hoverTimer && this.hoverAt) this.hoverTimer = window.setTimeout(() => void this.readHover(), kHoverEvery);
  }

  /** Makes one request at a time, for the current position of the pointer. */
  private async readHover(): Promise<void> {
    const at = this.hoverAt;
    const { session } = this;
    if (at && session.model.status === "ready" && !session.volume.isServerOnly && session.picture.quality !== "moving") {
      const pick = await session.volume.engine?.pick(at.x, at.y).catch(() => null);
      if (this.hoverAt === at) this.hover = pick ? { pick, ...at } : null;
    }
    this.hoverTimer = 0;
    if (this.hoverAt && this.hoverAt !== at) this.hoverTimer = window.setTimeout(() => void this.readHover(), kHoverEvery);
  }

  override render() {
    const { session } = this;
    const [width, height] = this.size;
    const view: View = { session, width, height };
    const isStill = this.inputs === "still";
    const isReady = session.model.status === "ready" && session.volume.info !== null && !isStill;
    const label = this.label || t(isStill ? "stillLabel" : "pictureLabel", { name: session.volume.info?.name || t("model") });
    return html`
      ${session.view.ground ? html`<svt-ground .session=${session}></svt-ground>` : nothing}
      ${this.canvas}
      <div class="stage ${session.view.tool === "measure" ? "measuring" : ""} ${this.inputs}" data-picture tabindex=${isStill ? nothing : 0}
        role=${isStill ? "img" : "application"} aria-roledescription=${isStill ? nothing : t("picture")} aria-label=${label} @keydown=${this.menuKey}></div>
      <svg class="cross" viewBox="0 0 15 15" aria-hidden="true"><path d="M7.5 0v15M0 7.5h15"></path></svg>
      <svg class="over" aria-hidden="true">
        ${isReady ? svg`${this.isBare ? nothing : planes(view)}${selectionBox(view)}${this.tools?.graphics(view)}${this.isBare ? nothing : compass(view)}` : nothing}
      </svg>
      ${isReady && !this.isBare ? session.view.now.sections.map((_, n) => this.handle(view, n)) : nothing}
      ${this.hover ? this.tip(view) : nothing}
    `;
  }

  override updated(): void {
    this.renderRoot.querySelectorAll<HTMLElement>("[data-x]").forEach((element) => {
      element.style.left = `${element.dataset["x"]}px`;
      element.style.top = `${element.dataset["y"]}px`;
    });
  }

  private tip(view: View) {
    const { pick, x, y } = this.hover!;
    const left = Math.min(x * view.width + 14, view.width - 200),
      top = y * view.height + 18;
    return html`<div class="tip" data-x=${left} data-y=${Math.min(top, view.height - 30)}>${labelOf(pick)} <span>· ${pick.class}</span></div>`;
  }

  private handle(view: View, n: number) {
    const found = handleOf(view.session, n);
    const at = found && place(view, found.at);
    if (!found || !at) return nothing;
    const section = view.session.view.now.sections[n]!;
    const [low, high] = rangeOf(section, view.session.volume.box);
    const x = Math.min(view.width - 20, Math.max(20, at.x)),
      y = Math.min(view.height - 20, Math.max(20, at.y));
    return html`<button class="handle" role="slider" data-x=${x.toFixed(1)} data-y=${y.toFixed(1)}
      aria-label=${t("handleLabel", { n: n + 1 })} aria-valuemin=${low.toFixed(2)} aria-valuemax=${high.toFixed(2)} aria-valuenow=${section.at.toFixed(2)}
      @pointerdown=${(e: PointerEvent) => this.grab(e, n)} @pointermove=${(e: PointerEvent) => this.pull(e, view)}
      @pointerup=${() => (this.drag = null)} @pointercancel=${() => (this.drag = null)}
      @keydown=${(e: KeyboardEvent) => this.nudge(e, n)}>${section.axis === "free" ? n + 1 : section.axis}</button>`;
  }

  private grab(event: PointerEvent, n: number): void {
    event.preventDefault();
    const button = event.currentTarget as HTMLElement;
    button.focus();
    try {
      button.setPointerCapture(event.pointerId);
    } catch {
      // A pointer that is already gone cannot be captured.
    }
    this.drag = { n, x: event.clientX, y: event.clientY, at: this.session.view.now.sections[n]!.at };
  }

  private pull(event: PointerEvent, view: View): void {
    const drag = this.drag;
    const found = drag && handleOf(this.session, drag.n);
    const camera = this.session.view.now.camera;
    if (!drag || !found || !camera) return;
    const metres = dragged(camera, [view.width, view.height], found.at, found.normal, event.clientX - drag.x, event.clientY - drag.y);
    this.drag = { ...drag, x: event.clientX, y: event.clientY };
    this.moveSection(drag.n, metres);
  }

  private nudge(event: KeyboardEvent, n: number): void {
    const step = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1, PageUp: 10, PageDown: -10 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    this.moveSection(n, step * 0.05);
  }

  private moveSection(n: number, metres: number): void {
    const sections = this.session.view.now.sections.map((section, i) => {
      if (i !== n) return section;
      const [low, high] = rangeOf(section, this.session.volume.box);
      return { ...section, at: Math.min(high, Math.max(low, section.at + metres)) };
    });
    this.session.view.set({ sections });
  }
}
customElements.define("svt-picture", PictureView);
