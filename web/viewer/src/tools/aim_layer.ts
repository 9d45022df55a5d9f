/** A layer over the picture that takes the next drag, for a rectangle of objects, or the next click, for a face. */

import { css, html, nothing, svg } from "lit";
import { toolText } from "../tool_texts";
import { t } from "../texts";
import { icon } from "../ui/icons";
import { controls, Part } from "../ui/part";
import { addPlaneAt } from "./face_plane";
import { selectInRectangle, type Rectangle, type RectangleRule } from "./rectangle";

type Place = readonly [x: number, y: number];

/** Steps of the arrow keys, fractions of the picture. */
const kStep = 0.05;
/** Smallest side of a rectangle, pixels: less is a click. */
const kLeast = 4;

export class AimLayer extends Part {
  static override properties = { ...Part.properties, from: { state: true }, to: { state: true }, isDown: { state: true } };
  /** Corners of the rectangle, fractions of the picture: where it began, and where it ends. */
  declare from: Place;
  declare to: Place;
  declare isDown: boolean;

  static override styles = [
    controls,
    css`
      :host { position: absolute; inset: 0; z-index: 3; }
      .layer { position: absolute; inset: 0; cursor: crosshair; touch-action: none; outline-offset: -3px !important; }
      svg.drawn { position: absolute; inset: 0; width: 100%; height: 100%; pointer-events: none; }
      rect { fill: var(--accent); fill-opacity: 0.12; stroke: var(--accent); stroke-width: 2; }
      rect.touching { stroke-dasharray: 7 4; }
      line { stroke: var(--mark); stroke-width: 1.5; }
      p { position: absolute; right: 10px; top: 10px; left: 112px; justify-self: end; max-width: 340px; margin-left: auto; padding: 6px 6px 6px 12px; display: flex; gap: 8px; align-items: center; border: 1px solid var(--line); border-radius: 10px; background: var(--panel); font-size: 12px; box-shadow: var(--shadow); }
      p span { flex: 1; }
      @media (max-width: 759px) { p { left: 10px; top: auto; bottom: 10px; max-width: none; } }
    `,
  ];

  constructor() {
    super();
    this.from = [0.3, 0.3];
    this.to = [0.7, 0.7];
    this.isDown = false;
  }

  override firstUpdated(): void {
    this.renderRoot.querySelector<HTMLElement>(".layer")!.focus();
  }

  override render() {
    const { view } = this.session;
    const isRectangle = view.aim === "rectangle";
    const hint = toolText(isRectangle ? "rectangleHint" : "faceHint");
    return html`<div class="layer" tabindex="0" role="application" aria-label="${hint} ${toolText(isRectangle ? "rectangleKeys" : "faceKeys")}"
        @pointerdown=${this.pressed} @pointermove=${this.moved} @pointerup=${this.released} @pointercancel=${() => (this.isDown = false)} @keydown=${this.key}></div>
      <svg class="drawn" aria-hidden="true">${isRectangle ? this.rectangle() : cross()}</svg>
      <p><span>${hint}</span><button class="bare" aria-label=${t("cancel")} @click=${() => (view.aim = null)}>${icon("close", 16)}</button></p>`;
  }

  private get chosen(): Rectangle {
    const [[x, y], [u, v]] = [this.from, this.to];
    return { left: Math.min(x, u), right: Math.max(x, u), top: Math.min(y, v), bottom: Math.max(y, v) };
  }
  /** A rectangle that is drawn from the right to the left takes everything that it touches. */
  private get rule(): RectangleRule {
    return this.to[0] < this.from[0] ? "touching" : "inside";
  }

  private rectangle() {
    if (!this.isDown && !this.matches(":focus-within")) return nothing;
    const { left, top, right, bottom } = this.chosen;
    const percent = (value: number) => `${(100 * value).toFixed(2)}%`;
    return svg`<rect class=${this.rule} x=${percent(left)} y=${percent(top)} width=${percent(right - left)} height=${percent(bottom - top)}></rect>`;
  }

  private shareOf(event: PointerEvent): Place {
    const { left, top, width, height } = this.getBoundingClientRect();
    const inside = (value: number) => Math.min(1, Math.max(0, value));
    return [inside((event.clientX - left) / width), inside((event.clientY - top) / height)];
  }

  private readonly pressed = (event: PointerEvent): void => {
    if (event.button !== 0) return void (this.session.view.aim = null);
    (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
    this.from = this.to = this.shareOf(event);
    this.isDown = true;
  };

  private readonly moved = (event: PointerEvent): void => {
    if (this.isDown) this.to = this.shareOf(event);
  };

  private readonly released = (event: PointerEvent): void => {
    if (!this.isDown) return;
    this.isDown = false;
    this.to = this.shareOf(event);
    const isClick = Math.hypot((this.to[0] - this.from[0]) * this.clientWidth, (this.to[1] - this.from[1]) * this.clientHeight) < kLeast;
    // A click is not a rectangle: the layer waits for one.
    if (this.session.view.aim === "face") this.take(event);
    else if (!isClick) this.take(event);
  };

  private take(event: PointerEvent | KeyboardEvent, at: Place = this.to): void {
    const { session } = this;
    const { aim } = session.view;
    session.view.aim = null;
    if (aim === "face") void addPlaneAt(session, ...at, [this.clientWidth, this.clientHeight]);
    else void selectInRectangle(session, this.chosen, this.rule, event.ctrlKey || event.metaKey || event.shiftKey);
  }

  private readonly key = (event: KeyboardEvent): void => {
    const by = { ArrowLeft: [-kStep, 0], ArrowRight: [kStep, 0], ArrowUp: [0, -kStep], ArrowDown: [0, kStep] }[event.key];
    const moved = ([x, y]: Place): Place => [Math.min(1, Math.max(0, x + by![0]!)), Math.min(1, Math.max(0, y + by![1]!))];
    if (event.key === "Enter") this.take(event, [0.5, 0.5]);
    else if (by && this.session.view.aim === "rectangle") {
      this.to = moved(this.to);
      if (event.shiftKey) this.from = moved(this.from);
    } else return;
    event.preventDefault();
    event.stopPropagation();
  };
}
customElements.define("svt-aim", AimLayer);

/** The middle of the picture, where Enter picks. */
function cross() {
  return svg`<svg x="50%" y="50%" overflow="visible"><line x1="-9" x2="9" y1="0" y2="0"></line><line x1="0" x2="0" y1="-9" y2="9"></line></svg>`;
}
