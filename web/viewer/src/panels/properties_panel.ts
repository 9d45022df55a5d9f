/** The selection: its properties, neighbours and actions; or the objects along a ray. */

import { css, html, nothing } from "lit";
import type { FeatureProperties } from "../engine";
import { labelOf } from "../state/feature_index";
import { ofId, ofSubtree } from "../state/queries";
import { subtree } from "../state/visibility";
import { dateText, number, t } from "../texts";
import { icon } from "../ui/icons";
import { controls, Part } from "../ui/part";
import "./style_editor";

export class PropertiesPanel extends Part {
  static override styles = [
    controls,
    css`
      :host { display: block; height: 100%; overflow: auto; padding: 14px; font-size: 13px; line-height: 1.45; }
      h2 { font-size: 16px; overflow-wrap: anywhere; }
      dl { display: grid; grid-template-columns: auto 1fr; gap: 4px 12px; margin: 10px 0 0; }
      dt { color: var(--quiet); }
      dd { margin: 0; text-align: right; font-variant-numeric: tabular-nums; overflow-wrap: anywhere; }
      ul { list-style: none; margin: 0; padding: 0; }
      li button { width: 100%; justify-content: space-between; gap: 10px; border-color: transparent; background: transparent; min-height: 30px; padding: 3px 6px; text-align: left; }
      li.outside { display: flex; justify-content: space-between; padding: 3px 6px; min-height: 30px; align-items: center; }
      li button:hover { background: var(--hover); }
      li span:first-child { overflow: hidden; text-overflow: ellipsis; min-width: 0; }
      li span:last-child { color: var(--quiet); font-variant-numeric: tabular-nums; flex: none; }
      .actions { margin: 12px 0 4px; display: flex; flex-wrap: wrap; gap: 6px; }
      .hint { color: var(--quiet); margin-top: 8px; }
      .head { display: flex; align-items: start; gap: 8px; justify-content: space-between; }
      .id { font-family: var(--mono); font-size: 11px; color: var(--quiet); overflow-wrap: anywhere; }
      .findings li { padding: 4px 0; font-size: 12px; }
      @media (max-width: 759px), (pointer: coarse) { li button { min-height: 44px; } }
    `,
  ];

  override render() {
    const { session } = this;
    if (session.selection.along) return this.alongList();
    const feature = session.selection.only;
    if (feature) return this.one(session.selection.properties);
    const n = session.view.now.selection.length;
    if (n > 1) return this.several(n);
    return html`<h2>${t("nothingSelected")}</h2><p class="hint">${t("selectHint")}</p>${this.findings()}`;
  }

  private findings() {
    const { findings: found = [], spacingReason = "" } = this.session.volume.info ?? {};
    const findings = spacingReason ? [t("spacingTold", { reason: spacingReason }), ...found] : found;
    if (!findings.length) return nothing;
    return html`<h3>${t("findingsTitle")}</h3><ul class="findings">${findings.slice(0, 50).map((text) => html`<li>${text}</li>`)}</ul>`;
  }

  private close() {
    return html`<button class="bare" aria-label=${t("deselect")} title=${t("deselect")} @click=${() => {
      this.session.selection.along = null;
      this.session.selection.select([]);
    }}>${icon("close", 18)}</button>`;
  }

  private one(properties: FeatureProperties | null) {
    const { session } = this;
    const feature = session.selection.only!;
    return html`
      <div class="head"><div><h2>${labelOf(feature)}</h2><div class="quiet">${feature.class}</div><div class="id">${feature.id}</div></div>${this.close()}</div>
      ${this.actions()}
      ${
        feature.count > 0
          ? html`<svt-style-editor .session=${session} .query=${ofId(feature.id)} .label=${labelOf(feature)} .color=${feature.color} .opacity=${feature.opacity}></svt-style-editor>`
          : nothing
      }
      ${properties ? this.details(properties) : nothing}
    `;
  }

  private details(p: FeatureProperties) {
    const size = p.box.high.map((high, i) => high - p.box.low[i]!);
    const attributes = Object.entries(p.attributes);
    const hasParts = p.totalSurface > 0 && p.totalSurface !== p.surface;
    return html`
      <dl>
        ${p.voxelVolume > 0 ? html`<dt>${t("volumeByVoxels")}</dt><dd>${number(p.voxelVolume, 3)} m³</dd>` : nothing}
        ${p.modelVolume !== null ? html`<dt>${t("modelVolume")}</dt><dd>${number(p.modelVolume, 3)} m³</dd>` : nothing}
        ${p.surface > 0 ? html`<dt>${t("surface")}</dt><dd>${number(p.surface, 2)} m²</dd>` : nothing}
        ${hasParts && p.totalVolume !== null ? html`<dt>${t("totalVolume")}</dt><dd>${number(p.totalVolume, 3)} m³</dd>` : nothing}
        ${hasParts ? html`<dt>${t("totalSurface")}</dt><dd>${number(p.totalSurface, 2)} m²</dd>` : nothing}
        ${size.every(Number.isFinite) && p.totalSurface > 0 ? html`<dt>${t("extent")}</dt><dd>${size.map((v) => number(v, 2)).join(" × ")} m</dd>` : nothing}
      </dl>
      <h3>${t("attributes")}</h3>
      ${attributes.length ? html`<dl>${attributes.map(([key, value]) => html`<dt>${key}</dt><dd>${valueText(p.numbers[key], value)}</dd>`)}</dl>` : html`<p class="quiet">${t("noAttributes")}</p>`}
      ${
        p.neighbours.length
          ? html`<h3>${t("neighbours")}</h3><ul>${p.neighbours.map((n) =>
              n.id === ""
                ? html`<li class="outside"><span>${t("outside")}</span><span>${number(n.area, 2)} m²</span></li>`
                : html`<li><button @click=${() => this.session.selection.select([n.id])}><span>${labelOf(n)}</span><span>${number(n.area, 2)} m²</span></button></li>`,
            )}</ul>`
          : nothing
      }
    `;
  }

  private several(n: number) {
    const { volume, view } = this.session;
    const { index } = volume;
    return html`
      <div class="head"><h2>${t("severalSelected", { n })}</h2>${this.close()}</div>
      ${this.actions()}
      <ul>${view.now.selection.slice(0, 200).map((id) => {
        const feature = index.features[index.byId.get(id) ?? -1];
        return feature
          ? html`<li><button @click=${() => this.session.selection.select([id])}><span>${labelOf(feature)}</span><span>${feature.class}</span></button></li>`
          : nothing;
      })}</ul>
    `;
  }

  private actions() {
    const { session } = this;
    const { index } = session.volume;
    const { now, hidden } = session.view;
    const members = now.selection.flatMap((id) => {
      const i = index.byId.get(id);
      return i === undefined ? [] : [...subtree(index, i)];
    });
    const isHidden = members.some((i) => index.features[i]!.count > 0) && members.every((i) => hidden[i]);
    const focus = { ...now.focus, query: "" };
    return html`<div class="actions">
      <button @click=${() => void session.view.goTo(now.selection.map(ofSubtree).join(" or "), null)}>${icon("fit", 16)}${t("frameIt")}</button>
      <button aria-pressed=${now.effect === "highlight"} @click=${() => session.view.set({ effect: now.effect === "highlight" ? "none" : "highlight", focus })}>${icon("focus", 16)}${t("highlightIt")}</button>
      <button aria-pressed=${now.effect === "cutaway"} @click=${() => session.view.set({ effect: now.effect === "cutaway" ? "none" : "cutaway", focus })}>${icon("target", 16)}${t("cutawayTo")}</button>
      <button aria-pressed=${isHidden} @click=${() => session.view.hide(members, !isHidden)}>${icon(isHidden ? "eye" : "eyeOff", 16)}${isHidden ? t("show") : t("hide")}</button>
      <button aria-pressed=${now.show.length > 0} @click=${() => session.view.set({ show: now.show.length ? [] : now.selection.map(ofSubtree) })}>${icon("only", 16)}${t("onlyThis")}</button>
    </div>`;
  }

  private alongList() {
    const { stretches } = this.session.selection.along!;
    return html`
      <div class="head"><h2>${t("alongTitle")}</h2>${this.close()}</div>
      ${stretches.length ? nothing : html`<p class="hint">${t("alongNothing")}</p>`}
      <ul class="along">${stretches.map(
        (
          s,
        ) => html`<li><button @click=${() => this.session.selection.select([s.id])}><span>${labelOf(s)} <span class="quiet">${s.class}</span></span>
          <span>${t("alongAt", { from: number(s.from, 2), to: number(s.to, 2) })}</span></button></li>`,
      )}</ul>
    `;
  }
}
customElements.define("svt-properties", PropertiesPanel);

/** Numbers and days in the notation of the page's language. */
function valueText(value: { value: number; unit: string } | undefined, text: string): string {
  if (!value) return dateText(text);
  const digits = /\.(\d+)/.exec(text)?.[1]?.length ?? 0;
  return `${number(value.value, Math.min(6, digits))}${value.unit ? ` ${value.unit}` : ""}`;
}
