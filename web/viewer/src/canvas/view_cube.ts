/** The view cube over the picture: its faces, edges and corners choose the direction of the view. Below it are frequent actions. */

import { css, html, nothing, svg } from "lit";
import { orbit } from "../camera/camera";
import { faceOf, facesAt, nextDirection, turnedTo, visibleFaces, type CubeFace, type Direction } from "../camera/cube";
import { toggleParallel } from "../camera/projection";
import { t } from "../texts";
import { toolText } from "../tool_texts";
import { icon, type IconName } from "../ui/icons";
import { controls, Part } from "../ui/part";

/** Half the side of the cube, and half the side of its picture: pixels. */
const kHalf = 27,
  kReach = 48;
/** Pixels that a click may move. */
const kClickSlop = 4;

export class ViewCube extends Part {
  private drag: { x: number; y: number; isMoved: boolean } | null = null;

  static override styles = [
    controls,
    css`
      :host { position: absolute; left: 8px; top: 8px; z-index: 3; display: grid; justify-items: center; gap: 4px; }
      .cube { width: 96px; height: 96px; border-radius: 50%; touch-action: none; cursor: pointer; }
      .cube svg { display: block; overflow: visible; }
      .cube path { fill: var(--panel); fill-opacity: 0.92; stroke: var(--line-strong); stroke-width: 0.7; stroke-linejoin: round; }
      .cube path:hover { fill: var(--accent-soft); fill-opacity: 1; }
      text { font: 600 11px var(--sans); fill: var(--text); text-anchor: middle; pointer-events: none; }
      .buttons { display: flex; border: 1px solid var(--line); border-radius: 9px; background: var(--panel); overflow: hidden; }
      .buttons button { border-radius: 0; min-width: 31px; min-height: 30px; padding: 3px; }
      .buttons :focus-visible { outline-offset: -2px; }
      @media (max-width: 759px), (pointer: coarse) { .buttons button { min-width: 44px; min-height: 44px; } }
      @media (max-width: 759px) { :host { justify-items: start; } .buttons { flex-direction: column; } }
    `,
  ];

  override render() {
    const { volume, view } = this.session;
    const { camera } = view.now;
    if (!camera || !volume.info) return nothing;
    return html`<div class="cube" tabindex="0" role="application" aria-roledescription=${toolText("cube")} aria-label=${toolText("cubeHint")} title=${toolText("cube")}
        @keydown=${this.key} @pointerdown=${this.pressed} @pointermove=${this.moved} @pointerup=${this.released} @pointercancel=${() => (this.drag = null)}>
        <svg viewBox="${-kReach} ${-kReach} ${2 * kReach} ${2 * kReach}" width=${2 * kReach} height=${2 * kReach} aria-hidden="true">
          ${visibleFaces(camera, volume.box.axes, kHalf).map((face) => this.face(face))}</svg></div>
      <div class="buttons">
        ${this.button("fit", "fit", toolText("cubeFit"), () => void view.goTo("", null), null)}
        ${this.button("parallel", "parallel", t("parallel"), () => toggleParallel(view), view.projection.parallel)}
        ${this.button("rectangle", "rectangle", toolText("rectangle"), () => (view.aim = view.aim === "rectangle" ? null : "rectangle"), view.aim === "rectangle")}
      </div>`;
  }

  private button(id: string, name: IconName, text: string, act: () => void, isPressed: boolean | null) {
    return html`<button class="bare" id="cube-${id}" aria-label=${text} title=${text} aria-pressed=${isPressed ?? nothing}
      ?disabled=${this.session.view.isWalking && id === "parallel"} @click=${act}>${icon(name, 18)}</button>`;
  }

  private face({ name, areas, matrix }: CubeFace) {
    return svg`<g data-face=${name}>${areas.map(({ direction, points }) => svg`<path data-direction=${direction.join()} d="M${points.map((p) => p.map((v) => v.toFixed(2)).join()).join("L")}Z"></path>`)}
      <text transform="matrix(${matrix.map((v) => v.toFixed(4)).join(" ")})" y="4">${t(`view_${name}`)}</text></g>`;
  }

  /** The view from a direction, fitted as a named view is. */
  private go(direction: Direction): void {
    const { view, volume } = this.session;
    const { camera } = view.state;
    if (!camera) return;
    this.say(direction);
    const name = faceOf(direction);
    if (name) return void view.goTo("", name, true, view.endWalking());
    void view.goTo("", null, true, view.endWalking(), turnedTo(camera, direction, volume.box.axes));
  }

  private say(direction: Direction): void {
    this.session.messages.say(
      facesAt(direction)
        .map((name) => t(`view_${name}`))
        .join(", "),
    );
  }

  private readonly key = (event: KeyboardEvent): void => {
    const { view, volume } = this.session;
    const { camera } = view.state;
    const step = ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] } as Record<string, [number, number]>)[
      event.key
    ];
    if (!camera || event.ctrlKey || event.altKey || event.metaKey) return;
    if (step) {
      const direction = nextDirection(camera, volume.box.axes, ...step);
      this.say(direction);
      view.moveTo(turnedTo(camera, direction, volume.box.axes));
    } else if (event.key === "Home") this.go([1, -1, 1]);
    else if (event.key === "Enter") this.go(nextDirection(camera, volume.box.axes, 0, 0));
    else return;
    event.preventDefault();
    event.stopPropagation();
  };

  private readonly pressed = (event: PointerEvent): void => {
    if (event.button !== 0) return;
    this.drag = { x: event.clientX, y: event.clientY, isMoved: false };
  };

  private readonly moved = (event: PointerEvent): void => {
    const { drag } = this;
    const { camera } = this.session.view.state;
    if (!drag || !camera) return;
    const [dx, dy] = [event.clientX - drag.x, event.clientY - drag.y];
    if (!drag.isMoved) {
      if (Math.hypot(dx, dy) < kClickSlop) return;
      drag.isMoved = true;
      (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
    }
    this.drag = { x: event.clientX, y: event.clientY, isMoved: true };
    // The face below the pointer follows it.
    this.session.view.turn(orbit(camera, camera.target, -dx / kHalf, dy / kHalf));
  };

  private readonly released = (event: PointerEvent): void => {
    const { drag } = this;
    this.drag = null;
    const direction = (event.target as Element).getAttribute("data-direction");
    if (drag && !drag.isMoved && direction) this.go(direction.split(",").map(Number) as [number, number, number]);
  };
}
customElements.define("svt-view-cube", ViewCube);
