/**
 * A layer over the picture that takes the next drag, for a rectangle of objects, or the next click, for a face. Without a mouse, arrow
 * keys change the rectangle, or move a cross. For points of a measurement, the layer takes only keys: clicks reach the picture.
 */

import { css, html, nothing, svg } from "lit";
import type { PictureTools } from "../canvas/overlay";
import { pressOnPicture } from "../canvas/picture_keys";
import { lateText } from "../late_texts";
import { toolText } from "../tool_texts";
import { t } from "../texts";
import { icon } from "../ui/icons";
import { controls, Part } from "../ui/part";
import { addPlaneAt } from "./face_plane";
import { selectInRectangle, type Rectangle, type RectangleRule } from "./rectangle";

type Place = readonly [x: number, y: number];

/** Steps of the arrow keys, fractions of the picture. */
const kStep = 0.05;
/** The same with Shift, for the cross: pixels. */
const kFineStep = 1;
/** Smallest side of a rectangle, pixels: less is a click. */
const kLeast = 4;

export class AimLayer extends Part {
  static override properties = {
    ...Part.properties,
    tools: { attribute: false },
    from: { state: true },
    to: { state: true },
    cross: { state: true },
    isDown: { state: true },
  };
  /** Takes the points; null: nothing does. */
  declare tools: PictureTools | null;
  /** Corners of the rectangle, fractions of the picture: where it began, and where it ends. */
  declare from: Place;
  declare to: Place;
  /** Where Enter picks, fractions of the picture. */
  declare cross: Place;
  declare isDown: boolean;

  static override styles = [
    controls,
    css`
      :host { position: absolute; inset: 0; z-index: 3; }
      .layer { position: absolute; inset: 0; cursor: crosshair; touch-action: none; outline-offset: -3px !important; }
      .layer.point { pointer-events: none; }
      svg.drawn { position: absolute; inset: 0; width: 100%; height: 100%; pointer-events: none; }
      rect { fill: var(--accent); fill-opacity: 0.12; stroke: var(--accent); stroke-width: 2; }
      rect.touching { stroke-dasharray: 7 4; }
      line { stroke: var(--mark); stroke-width: 1.5; }
      line.under { stroke: #fff; stroke-width: 3.5; }
      p { position: absolute; right: 10px; top: 10px; left: 112px; justify-self: end; max-width: 340px; margin-left: auto; padding: 6px 6px 6px 12px; display: flex; gap: 8px; align-items: center; border: 1px solid var(--line); border-radius: 10px; background: var(--panel); font-size: 12px; box-shadow: var(--shadow); }
      p span { flex: 1; }
      p button { pointer-events: auto; }
      @media (max-width: 759px) { p { left: 10px; top: auto; bottom: 10px; max-width: none; } }
    `,
  ];

  constructor() {
    super();
    this.from = [0.3, 0.3];
    this.to = [0.7, 0.7];
    this.cross = [0.5, 0.5];
    this.tools = null;
    this.isDown = false;
  }

  override firstUpdated(): void {
    this.renderRoot.querySelector<HTMLElement>(".layer")!.focus();
  }

  override render() {
    const { view } = this.session;
    const { aim } = view;
    const isRectangle = aim === "rectangle";
    const hint = aim === "face" ? toolText("faceHint") : lateText(isRectangle ? "rectangleHint" : "pointHint");
    const keys = aim === "point" ? "" : lateText(isRectangle ? "rectangleKeys" : "faceKeys");
    // Clicks between the parts of this layer are for the picture.
    this.style.pointerEvents = aim === "point" ? "none" : "";
    return html`<div class="layer ${aim}" tabindex="0" role="application" aria-label="${hint} ${keys}"
        @pointerdown=${this.pressed} @pointermove=${this.moved} @pointerup=${this.released} @pointercancel=${() => (this.isDown = false)} @keydown=${this.key}></div>
      <svg class="drawn" aria-hidden="true">${isRectangle ? this.rectangle() : cross(this.cross)}</svg>
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
    const size: [number, number] = [this.clientWidth, this.clientHeight];
    if (aim === "point") {
      const { ctrlKey, metaKey, shiftKey } = event;
      return void this.tools?.click(...at, new PointerEvent("pointerup", { ctrlKey, metaKey, shiftKey }), size);
    }
    session.view.aim = null;
    if (aim === "face") void addPlaneAt(session, ...at, size);
    else void selectInRectangle(session, this.chosen, this.rule, event.ctrlKey || event.metaKey || event.shiftKey);
  }

  private readonly key = (event: KeyboardEvent): void => {
    const isRectangle = this.session.view.aim === "rectangle";
    const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    const inside = (value: number) => Math.min(1, Math.max(0, value));
    const moved = ([x, y]: Place, step: Place): Place => [inside(x + by![0]! * step[0]), inside(y + by![1]! * step[1])];
    if (event.key === "Enter") this.take(event, this.cross);
    else if (by && isRectangle) {
      this.to = moved(this.to, [kStep, kStep]);
      if (event.shiftKey) this.from = moved(this.from, [kStep, kStep]);
    } else if (by)
      this.cross = moved(this.cross, event.shiftKey ? [kFineStep / this.clientWidth, kFineStep / this.clientHeight] : [kStep, kStep]);
    else if ("+=-".includes(event.key)) pressOnPicture(this, "keydown", event.key);
    else return;
    event.preventDefault();
    event.stopPropagation();
  };
}
customElements.define("svt-aim", AimLayer);

/** Where Enter picks. */
function cross([x, y]: Place) {
  const arms = (name: string) =>
    svg`<line class=${name} x1="-9" x2="9" y1="0" y2="0"></line><line class=${name} x1="0" x2="0" y1="-9" y2="9"></line>`;
  return svg`<svg x="${100 * x}%" y="${100 * y}%" overflow="visible">${arms("under")}${arms("")}</svg>`;
}
