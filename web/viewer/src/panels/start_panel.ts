/** Shown before anything is open: an introduction, and a drop area for building files. */

import { css, html } from "lit";
import { kModelEndings } from "../generated/model_endings";
import { t } from "../texts";
import { icon } from "../ui/icons";
import { controls, Part } from "../ui/part";

export class StartPanel extends Part {
  static override styles = [
    controls,
    css`
    :host { display: grid; place-items: center; height: 100%; overflow: auto; padding: 24px; background: var(--stage); }
    .card { max-width: 520px; width: 100%; text-align: center; display: grid; gap: 14px; justify-items: center; }
    .drop { width: 100%; border: 2px dashed var(--line-strong); border-radius: 16px; padding: 40px 24px; display: grid; gap: 12px; justify-items: center; background: var(--panel); }
    h1 { margin: 0; font-size: 24px; font-weight: 650; letter-spacing: -0.01em; }
    p { line-height: 1.5; color: var(--quiet); max-width: 44ch; }
    .mark { color: var(--accent); }
  `,
  ];

  override render() {
    return html`<div class="card">
      <div class="drop">
        <span class="mark">${icon("section", 56)}</span>
        <h1>${t("dropTitle")}</h1>
        <p>${t("dropText", { kinds: kModelEndings.join(", ") })}</p>
        <button class="loud" @click=${() => this.dispatchEvent(new Event("svt-choose", { bubbles: true, composed: true }))}>${icon("open", 18)}${t("choose")}</button>
      </div>
      <p class="small">${t("startFeatures")}</p>
    </div>`;
  }
}
customElements.define("svt-start", StartPanel);
