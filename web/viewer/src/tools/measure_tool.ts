/** Lengths and areas between points clicked in the picture. */

import { css, html, nothing } from "lit";
import { distance } from "../camera/vec";
import { number, t } from "../texts";
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
  `,
  ];

  override render() {
    const { session } = this;
    const points = session.view.now.measured;
    const set = (measured: typeof points) => session.view.set({ measured });
    return html`
      <p class="quiet">${t("measureHint")}</p>
      <dl aria-live="polite">
        <dt>${t("points")}</dt><dd id="measured-points">${points.length}</dd>
        ${
          points.length > 1
            ? html`<dt>${t("lastStretch")}</dt><dd>${number(distance(points.at(-2)!, points.at(-1)!), 3)} m</dd>
          <dt>${t("distance")}</dt><dd id="measured-length">${number(pathLength(points, false), 3)} m</dd>`
            : nothing
        }
        ${points.length > 2 ? html`<dt>${t("area")}</dt><dd id="measured-area">${number(polygonArea(points), 3)} m²</dd>` : nothing}
      </dl>
      <div class="row">
        <button ?disabled=${!points.length} @click=${() => set(points.slice(0, -1))}>${icon("undo", 16)}${t("undoPoint")}</button>
        <button ?disabled=${!points.length} @click=${() => set([])}>${t("clear")}</button>
      </div>
    `;
  }
}
customElements.define("svt-measure-tool", MeasureTool);
