/** Highlight in context, cutaway, and hulls by level. */

import { css, html, nothing } from "lit";
import type { EngineError, ShellLevel } from "../engine";
import { kSceneMembers } from "../generated/scene_members";
import { focusQueries } from "../state/scene_of";
import type { Effect, Focus } from "../state/view_state";
import { help, number, t } from "../texts";
import { toolText } from "../tool_texts";
import { controls, Part } from "../ui/part";
import { contextChoice } from "./context_choice";

const kLevels = kSceneMembers["/passes/*/shell"].choices;
const kEffects = { none: "effectNone", highlight: "effectHighlight", cutaway: "effectCutaway" } as const;

export class FocusTool extends Part {
  static override properties = { ...Part.properties, error: { state: true } };
  declare error: string;
  static override styles = [
    controls,
    css`
      .line { display: grid; grid-template-columns: 84px 1fr 62px; gap: 10px; align-items: center; min-height: 32px; margin-top: 6px; }
      output { text-align: right; font-variant-numeric: tabular-nums; }
      form { display: grid; grid-template-columns: 1fr auto; gap: 6px; margin-top: 8px; }
      #focus-query { font-family: var(--mono); font-size: 12px; }
    `,
  ];

  constructor() {
    super();
    this.error = "";
  }

  override render() {
    const { effect, focus, shell } = this.session.view.now;
    const isOn = effect === "highlight" || effect === "cutaway";
    return html`
      <div class="segments" role="radiogroup" aria-label=${t("focusEffect")}>${(["none", "highlight", "cutaway"] as const)
        // Cities have no cutaway: their parts are drawn one by one.
        .filter((wanted) => wanted !== "cutaway" || !this.session.volume.isCity)
        .map(
          (wanted) =>
            html`<button role="radio" aria-checked=${wanted === "none" ? !isOn : effect === wanted} @click=${() => this.session.view.set({ effect: wanted as Effect })}>${t(kEffects[wanted])}</button>`,
        )}</div>
      <form @submit=${this.apply}>
        <input id="focus-query" autocomplete="off" spellcheck="false" aria-label=${toolText("focusQuery")} placeholder=${toolText("focusQuery")} .value=${focus.query} />
        <button type="submit">${t("apply")}</button>
      </form>
      ${this.error ? html`<p class="error" role="alert">${this.error}</p>` : nothing}
      ${isOn && !focusQueries(this.session.view.now).length ? html`<p class="small quiet">${toolText("focusEmpty")}</p>` : nothing}
      ${effect === "highlight" ? contextChoice(focus.context, (context) => this.change({ context })) : nothing}
      ${
        effect === "cutaway"
          ? html`<div class="line"><span class="quiet">${toolText("margin")}</span>
            <wa-slider size="s" label=${toolText("margin")} aria-label=${toolText("margin")} min="0" max="1" step="0.05" .value=${focus.margin} @input=${(e: Event) => this.change({ margin: Number((e.target as HTMLInputElement).value) })}></wa-slider>
            <output>${number(focus.margin, 2)} m</output></div>`
          : nothing
      }
      <h3 id="shell-title">${t("shell")}</h3>
      <select id="shell" aria-labelledby="shell-title" title=${help("/passes/*/shell")} @change=${(e: Event) => this.session.view.set({ shell: ((e.target as HTMLSelectElement).value || null) as ShellLevel | null })}>
        <option value="" ?selected=${!shell}>${t("shellOff")}</option>
        ${kLevels.map((level) => html`<option value=${level} ?selected=${shell === level}>${t(`shell_${level}`)}</option>`)}
      </select>
    `;
  }

  private change(change: Partial<Focus>): void {
    this.session.view.set({ focus: { ...this.session.view.now.focus, ...change } });
  }

  private readonly apply = async (event: Event): Promise<void> => {
    event.preventDefault();
    const query = this.renderRoot.querySelector<HTMLInputElement>("#focus-query")!.value.trim();
    this.error = "";
    try {
      if (query) await this.session.volume.engine!.select(query);
      const { effect } = this.session.view.now;
      this.change({ query });
      if (query && effect !== "cutaway") this.session.view.set({ effect: "highlight" });
    } catch (error) {
      this.error = (error as EngineError).message;
    }
  };
}
customElements.define("svt-focus-tool", FocusTool);
