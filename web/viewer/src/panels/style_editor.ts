/** Edits colour and opacity of the features selected by a query. */

import { css, html, nothing } from "lit";
import { help, t } from "../texts";
import { memberSlider } from "../ui/member_slider";
import { controls, Part } from "../ui/part";
import { withStyle } from "../state/view_state";

export class StyleEditor extends Part {
  static override properties = {
    ...Part.properties,
    query: {},
    label: {},
    color: {},
    opacity: { type: Number },
  };
  declare query: string;
  declare label: string;
  /** Values from the model. */
  declare color: string;
  declare opacity: number;

  static override styles = [
    controls,
    css`
      :host { display: block; }
      .line { display: grid; grid-template-columns: auto 1fr auto; gap: 10px; align-items: center; min-height: 36px; }
      output { font-variant-numeric: tabular-nums; min-width: 34px; text-align: right; }
      .line input[type="color"] { width: 34px; min-width: 34px; padding: 2px; cursor: pointer; }
      @media (max-width: 759px), (pointer: coarse) { .line { column-gap: 18px; } .line input[type="color"] { min-width: 44px; } }
    `,
  ];

  override render() {
    const style = this.session.view.now.styles.find((s) => s.select === this.query);
    const color = style?.color ?? this.color,
      opacity = style?.opacity ?? this.opacity;
    return html`
      <div class="line">
        <input type="color" aria-label=${t("colorOf", { name: this.label })} title=${help("/passes/*/styles/*/color")} .value=${color}
          @input=${(e: Event) => this.change({ color: (e.target as HTMLInputElement).value })} />
        ${memberSlider("opacity", t("opacityOf", { name: this.label }), opacity, (wanted) => this.change({ opacity: wanted }))}
        <output>${Math.round(opacity * 100)} %</output>
      </div>
      ${style ? html`<button class="bare small" @click=${() => this.reset()}>${t("resetStyle")}</button>` : nothing}
    `;
  }

  private change(change: { color?: string; opacity?: number }): void {
    this.session.view.set({ styles: withStyle(this.session.view.now.styles, this.query, change) });
  }
  private reset(): void {
    this.session.view.set({ styles: this.session.view.now.styles.filter((style) => style.select !== this.query) });
  }
}

customElements.define("svt-style-editor", StyleEditor);
