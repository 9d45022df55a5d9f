/** The meaning of the colours in the picture. Its text has the size of the page, whatever the resolution of the picture. */

import { css, html, nothing } from "lit";
import { coverText } from "../city/cover";
import type { ColorScale } from "../engine";
import { number, t } from "../texts";
import { toolText } from "../tool_texts";
import { Part } from "../ui/part";

/** Decimals of the ends of a ramp. */
const kDecimals = 2;

export class ColorLegend extends Part {
  static override styles = css`
    :host { display: block; padding: 8px 12px; border: 1px solid var(--line); border-radius: 10px; background: var(--panel); color: var(--text); font-size: 12px; max-height: 40vh; overflow: auto; }
    :host([hidden]) { display: none; }
    strong { display: block; margin-bottom: 4px; overflow-wrap: anywhere; }
    ul { list-style: none; margin: 0; padding: 0; display: grid; gap: 4px; }
    li { display: grid; grid-template-columns: 14px 1fr; gap: 8px; align-items: center; overflow-wrap: anywhere; }
    .swatch { width: 14px; height: 14px; border-radius: 3px; border: 1px solid #0003; }
    .cover { margin: 6px 0 0; max-width: 24em; color: var(--quiet); }
    li.ramp { display: block; font-variant-numeric: tabular-nums; }
    .bar { height: 12px; min-width: 110px; margin-bottom: 3px; border-radius: 3px; border: 1px solid #0003; }
  `;

  override render() {
    const { scale } = this.session.picture;
    if (!scale) return nothing;
    const cover = coverText(this.session);
    const unknown = scale.hasUnknown ? this.row(toolText("noValue"), scale.missingColor) : nothing;
    const missing = scale.missing ? this.row(t("legendMissing", { n: scale.missing }), scale.missingColor) : nothing;
    return html`<strong id="color-title">${scale.title}</strong>
      <ul id="color-scale" aria-label="${t("legend")}: ${scale.title}">
        ${scale.isRamp ? this.ramp(scale) : scale.entries.map(({ text, count, color }) => this.row(`${text}: ${count}`, color))}${unknown}${missing}${(scale.notes ?? []).map((note) => html`<li class="ramp">${note}</li>`)}</ul>${cover ? html`<p class="cover">${cover}</p>` : nothing}`;
  }

  private ramp({ low, high, ramp = [] }: ColorScale) {
    return html`<li class="ramp"><div class="bar" data-background="linear-gradient(90deg, ${ramp.join()})"></div>${t("legendRange", { low: number(low, kDecimals), high: number(high, kDecimals) })}</li>`;
  }

  private row(text: string, color = "transparent") {
    return html`<li><span class="swatch" data-background=${color}></span><span>${text}</span></li>`;
  }

  override updated(): void {
    // Not as attributes: the policy of the page forbids inline styles.
    this.renderRoot.querySelectorAll<HTMLElement>("[data-background]").forEach((e) => (e.style.background = e.dataset["background"]!));
    this.hidden = !this.session.picture.scale;
  }
}
customElements.define("svt-color-legend", ColorLegend);
