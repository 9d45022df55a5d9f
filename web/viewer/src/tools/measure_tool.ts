/** Lengths and areas between points clicked in the picture. */

import { css, html, nothing } from "lit";
import { distance, dot, sub } from "../camera/vec";
import type { Point } from "../engine";
import { number, t } from "../texts";
import { toolHint, toolText } from "../tool_texts";
import { icon } from "../ui/icons";
import { controls, Part } from "../ui/part";
import { pathLength, polygonArea } from "./measure";

export class MeasureTool extends Part {
  static override styles = [
    controls,
    css`
    dl { display: grid; grid-template-columns: 1fr auto; gap: 4px 12px; margin: 10px 0; }
    dt { color: var(--quiet); }
    dd { margin: 0; font-variant-numeric: tabular-nums; text-align: right; font-weight: 600; }
    dt.part { padding-left: 12px; }
    dd.part { font-weight: 400; }
  `,
  ];

  override render() {
    const { session } = this;
    const points = session.view.now.measured;
    const set = (measured: typeof points) => session.view.set({ measured });
    return html`
      <p class="quiet">${toolHint("measure")}</p>
      <dl aria-live="polite">
        <dt>${t("points")}</dt><dd id="measured-points">${points.length}</dd>
        ${
          points.length > 1
            ? html`<dt>${t("lastStretch")}</dt><dd>${number(distance(points.at(-2)!, points.at(-1)!), 3)} m</dd>
          ${this.parts(points.at(-2)!, points.at(-1)!)}
          <dt>${t("distance")}</dt><dd id="measured-length">${number(pathLength(points, false), 3)} m</dd>`
            : nothing
        }
        ${points.length > 2 ? html`<dt>${t("area")}</dt><dd id="measured-area">${number(polygonArea(points), 3)} m²</dd>` : nothing}
      </dl>
      <label class="check" title=${toolText("squareHint")}><input type="checkbox" id="square" .checked=${session.view.isSquare} @change=${(e: Event) => (session.view.isSquare = (e.target as HTMLInputElement).checked)} />${toolText("square")}</label>
      <div class="row">
        <button ?disabled=${!points.length} @click=${() => set(points.slice(0, -1))}>${icon("undo", 16)}${t("undoPoint")}</button>
        <button ?disabled=${!points.length} @click=${() => set([])}>${t("clear")}</button>
      </div>
    `;
  }

  /** The last stretch along the axes of the grid, and on the ground. */
  private parts(from: Point, to: Point) {
    const way = sub(to, from);
    const along = this.session.volume.box.axes.map((axis) => dot(axis, way));
    const signed = (value: number) => `${value < -0.0005 ? "−" : ""}${number(Math.abs(value), 3)} m`;
    return html`${(["x", "y", "z"] as const).map((axis, i) => html`<dt class="part">d${axis}</dt><dd class="part" id="measured-d${axis}">${signed(along[i]!)}</dd>`)}
      <dt class="part">${toolText("onGround")}</dt><dd class="part" id="measured-ground">${number(Math.hypot(along[0]!, along[1]!), 3)} m</dd>`;
  }
}
customElements.define("svt-measure-tool", MeasureTool);
