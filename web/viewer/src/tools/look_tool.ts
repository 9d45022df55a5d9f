/** Look, edges, names, legend, colours by attribute, sun, scale bar and north arrow. */

import { css, html, nothing } from "lit";
import type { HiddenLines } from "../engine";
import { kSceneMembers } from "../generated/scene_members";
import { help, t } from "../texts";
import { kPlainMembers, type PlainMember } from "../state/member_controls";
import { withMember } from "../state/view_state";
import { plainControl } from "../ui/plain_control";
import { controls, Part } from "../ui/part";
import { toolText } from "../tool_texts";
import { colorChoice } from "./color_choice";
import "./sun_choice";

const kLooks = kSceneMembers["/look"].choices;
const kLines = ["off", ...kSceneMembers["/passes/*/lines/*/hidden"].choices] as const;

export class LookTool extends Part {
  static override properties = { ...Part.properties, isBasemapShown: { state: true } };
  declare isBasemapShown: boolean;

  static override styles = [controls, css`.segments { display: flex; } svt-basemap { margin-top: 8px; } h3:first-child { margin-top: 0; }`];

  constructor() {
    super();
    this.isBasemapShown = false;
  }

  override render() {
    const { session } = this;
    const { look, wireframe, names, picture, surfaces } = session.view.now;
    const hasEdges = session.volume.info?.hasEdges ?? false;
    const hasMeshes = !session.volume.isCity && (session.volume.info?.hasMeshes ?? false);
    return html`
      <div class="segments" role="radiogroup" aria-label=${t("look")} title=${help("/look")}>${kLooks.map(
        (wanted) =>
          html`<button role="radio" aria-checked=${look === wanted} @click=${() => session.view.set({ look: wanted })}>${t(`look_${wanted}`)}</button>`,
      )}</div>
      <h3 id="wire-title">${t("wireframe")}</h3>
      <select id="wireframe" aria-labelledby="wire-title" title=${help("/passes/*/lines/*/hidden")} ?disabled=${!hasEdges} @change=${(
        e: Event,
      ) => {
        const value = (e.target as HTMLSelectElement).value;
        session.view.set({ wireframe: value === "off" ? null : (value as HiddenLines) });
      }}>${kLines.map((line) => html`<option value=${line} ?selected=${(wireframe ?? "off") === line}>${t(`wireframe_${line}`)}</option>`)}</select>
      ${hasEdges ? nothing : html`<p class="small quiet">${toolText("noEdges")}</p>`}
      <div class="row">
        <label class="check" title=${help("/names")}><input type="checkbox" id="names" .checked=${names} @change=${(e: Event) => session.view.set({ names: (e.target as HTMLInputElement).checked })} />${t("names")}</label>
        <label class="check"><input type="checkbox" id="legend" .checked=${session.view.isLegendShown} @change=${(e: Event) => (session.view.isLegendShown = (e.target as HTMLInputElement).checked)} />${t("legend")}</label>
        <label class="check" title=${help("/surfaces")}><input type="checkbox" id="exact-surfaces" ?disabled=${!hasMeshes} .checked=${hasMeshes && surfaces !== "voxels"} @change=${(e: Event) => session.view.set({ surfaces: (e.target as HTMLInputElement).checked ? null : "voxels" })} />${t("exactSurfaces")}</label>
      </div>
      ${colorChoice(session)}
      ${session.volume.info?.hasFields ? this.fields() : nothing}
      <svt-sun-choice .session=${session}></svt-sun-choice>
      ${session.volume.isServerOnly ? nothing : html`<button id="basemap" aria-expanded=${this.isBasemapShown} @click=${() => void this.toggleBasemap()}>${toolText("basemap")}</button>`}
      ${this.isBasemapShown ? html`<svt-basemap .session=${session}></svt-basemap>` : nothing}
      ${kPlainMembers.map((name) => plainControl(name, picture[name.slice(1) as PlainMember], (value) => session.view.set({ picture: withMember(picture, name, value) })))}
    `;
  }

  private fields() {
    void import("../fields/field_choice").catch((error: unknown) => this.session.messages.fail(error));
    return html`<svt-field .session=${this.session}></svt-field>`;
  }

  private async toggleBasemap(): Promise<void> {
    try {
      await import("../basemap/basemap_choice");
      this.isBasemapShown = !this.isBasemapShown;
    } catch (error) {
      this.session.messages.fail(error);
    }
  }
}
customElements.define("svt-look-tool", LookTool);
