/** S-Lens: a round window; sections cut only inside it. */

import { html, nothing, css } from "lit";
import type { Context } from "../engine";
import type { Lens } from "../state/view_state";
import { number } from "../texts";
import { toolHint, toolText } from "../tool_texts";
import { controls, Part } from "../ui/part";
import { contextChoice } from "./context_choice";

export class LensTool extends Part {
  static override styles = [
    controls,
    css`
      .line { display: grid; grid-template-columns: 84px 1fr 52px; gap: 10px; align-items: center; min-height: 32px; }
      output { text-align: right; font-variant-numeric: tabular-nums; }
      p { margin-top: 8px; }
    `,
  ];

  override render() {
    const { effect, lens } = this.session.view.now;
    const isOn = effect === "lens";
    return html`
      <div class="row">
        <label class="check"><input type="checkbox" id="lens-on" .checked=${isOn} @change=${(e: Event) => this.session.view.set({ effect: (e.target as HTMLInputElement).checked ? "lens" : "none", lens: { ...lens, pinned: false } })} />${toolText("lensOn")}</label>
        <label class="check"><input type="checkbox" id="lens-pinned" .checked=${lens.pinned} ?disabled=${!isOn} @change=${(e: Event) => this.change({ pinned: (e.target as HTMLInputElement).checked })} />${toolText("lensPinned")}</label>
      </div>
      ${this.slider(toolText("lensSize"), lens.radius, 0.04, 0.9, (radius) => this.change({ radius }))}
      ${
        lens.pinned
          ? html`${this.slider(toolText("lensX"), lens.x, 0, 1, (x) => this.change({ x }))}${this.slider(toolText("lensY"), lens.y, 0, 1, (y) => this.change({ y }))}`
          : nothing
      }
      ${contextChoice(lens.context, (context: Context) => this.change({ context }))}
      <p class="quiet small">${toolHint("lens")}</p>
    `;
  }

  private slider(label: string, value: number, low: number, high: number, change: (value: number) => void) {
    return html`<div class="line"><span class="quiet">${label}</span>
      <wa-slider size="s" label=${label} aria-label=${label} min=${low} max=${high} step="0.01" .value=${value} @input=${(e: Event) => change(Number((e.target as HTMLInputElement).value))}></wa-slider>
      <output>${number(value * 100, 0)} %</output></div>`;
  }

  private change(change: Partial<Lens>): void {
    this.session.view.set({ lens: { ...this.session.view.now.lens, ...change } });
  }
}
customElements.define("svt-lens-tool", LensTool);
