/** The selection: its properties, neighbours and actions; or the objects along a ray. */

import { css, html, nothing } from "lit";
import type { FeatureProperties } from "../engine";
import { isGroupOfParts, labelOf, type FeatureIndex } from "../state/feature_index";
import { classText } from "../state/class_words";
import { ofId, ofSubtree } from "../state/queries";
import { number, t } from "../texts";
import { toolText } from "../tool_texts";
import { icon } from "../ui/icons";
import { controls, Part } from "../ui/part";
import { comparison } from "./comparison";
import { kindOf, nameOf, pathTo } from "./feature_path";
import "./style_editor";

/** The word of the page's language, the type and the class; each name once. */
function kindText({ type = "", class: name }: { type?: string; class: string }): string {
  return [...new Set([classText(type || name), type || name, name])].join(" · ");
}

export class PropertiesPanel extends Part {
  static override styles = [
    controls,
    css`
      :host { display: block; height: 100%; overflow: auto; padding: 14px; font-size: 13px; line-height: 1.45; }
      h2 { font-size: 16px; overflow-wrap: anywhere; }
      :is(.path, .head, h2):first-child { padding-right: var(--sheet-close, 0); }
      dl { display: grid; grid-template-columns: auto 1fr; gap: 4px 12px; margin: 10px 0 0; }
      dt { color: var(--quiet); }
      dd small { display: block; color: var(--quiet); font-size: 11px; }
      dd { margin: 0; text-align: right; font-variant-numeric: tabular-nums; overflow-wrap: anywhere; }
      ul { list-style: none; margin: 0; padding: 0; }
      li button { width: 100%; justify-content: space-between; gap: 10px; border-color: transparent; background: transparent; min-height: 30px; padding: 3px 6px; text-align: left; }
      li.outside { display: flex; justify-content: space-between; padding: 3px 6px; min-height: 30px; align-items: center; }
      li button:hover { background: var(--hover); }
      li span:first-child { overflow: hidden; text-overflow: ellipsis; min-width: 0; }
      li span:last-child { color: var(--quiet); font-variant-numeric: tabular-nums; flex: none; }
      .actions { margin: 12px 0 4px; display: flex; flex-wrap: wrap; gap: 6px; }
      .scroll { overflow-x: auto; }
      #comparison { width: 100%; font-size: 12px; font-variant-numeric: tabular-nums; }
      #comparison :is(thead, tbody) { display: block; }
      #comparison tr { display: grid; grid-template-columns: repeat(3, minmax(0, 1fr)); padding: 3px 0; border-bottom: 1px solid var(--line); }
      #comparison :is(th, td) { padding: 0 2px; text-align: right; overflow-wrap: anywhere; font-weight: 400; }
      #comparison th[scope="col"] { font-weight: 600; }
      #comparison th[scope="row"] { grid-column: 1 / -1; text-align: left; color: var(--quiet); }
      #comparison .same td { color: var(--quiet); }
      .hint { color: var(--quiet); margin-top: 8px; }
      .head { display: flex; align-items: start; gap: 8px; justify-content: space-between; }
      .id { font-family: var(--mono); font-size: 11px; color: var(--quiet); overflow-wrap: anywhere; }
      .path ol { list-style: none; margin: 0 0 8px; padding: 0; display: flex; flex-wrap: wrap; align-items: center; font-size: 12px; }
      .path li { display: flex; align-items: center; min-width: 0; }
      .path li + li::before { content: "›"; color: var(--quiet); padding: 0 2px; }
      .path button { width: auto; min-height: 26px; padding: 2px 4px; color: var(--quiet); justify-content: flex-start; gap: 4px; min-width: 0; white-space: normal; }
      .path button span { color: inherit; overflow-wrap: anywhere; }
      .path svg { flex: none; }
      @media (max-width: 759px), (pointer: coarse) { li button, .path button { min-height: 44px; min-width: 44px; } }
    `,
  ];

  override render() {
    const { session } = this;
    if (session.selection.along) return this.alongList();
    const feature = session.selection.only;
    if (feature) return this.one(session.selection.properties);
    const n = session.view.now.selection.length;
    if (n > 1) return this.several(n);
    return html`<h2>${t("nothingSelected")}</h2><p class="hint">${toolText("selectHint")}</p>${this.findings()}`;
  }

  private findings() {
    const { findings = [], spacingReason = "" } = this.session.volume.info ?? {};
    if (!findings.length && !spacingReason) return nothing;
    loadDetails();
    return html`<svt-findings .session=${this.session}></svt-findings>`;
  }

  /** Building, storey, flat and room around the feature, as buttons that select them. */
  private path(i: number) {
    const { index } = this.session.volume;
    const above = pathTo(index, i);
    if (!above.length) return nothing;
    return html`<nav class="path" aria-label=${toolText("pathOf")}><ol>${above.map((at) => {
      const feature = index.features[at]!;
      return html`<li><button class="bare" title=${feature.class} @click=${() => this.session.selection.select([feature.id])}>${icon(kindOf(feature), 14)}<span>${nameOf(index, feature)}</span></button></li>`;
    })}</ol></nav>`;
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
    const { index } = session.volume;
    const i = index.byId.get(feature.id)!;
    const isGroup = isGroupOfParts(index, i);
    return html`
      ${this.path(i)}
      <div class="head"><div><h2>${labelOf(feature)}</h2><div class="quiet">${kindText(feature)}</div><div class="id">${feature.id}</div></div>${this.close()}</div>
      ${this.actions()}
      ${
        feature.count > 0 || isGroup
          ? html`<svt-style-editor .session=${session} .query=${isGroup ? ofSubtree(feature.id) : ofId(feature.id)} .label=${labelOf(feature)} .color=${feature.color} .opacity=${feature.opacity}></svt-style-editor>`
          : nothing
      }
      ${properties ? this.details(properties, isGroup) : nothing}
    `;
  }

  private details(p: FeatureProperties, isGroup: boolean) {
    const size = p.box.high.map((high, i) => high - p.box.low[i]!);
    const { index } = this.session.volume;
    loadDetails();
    const hasParts = p.totalSurface > 0 && p.totalSurface !== p.surface;
    return html`
      <dl>
        ${isGroup && p.totalVolume !== null ? html`<dt>${toolText("totalVolume")}</dt><dd id="total-volume">${number(p.totalVolume, 3)} m³</dd>` : nothing}
        ${isGroup && hasParts ? html`<dt>${toolText("totalSurface")}</dt><dd>${number(p.totalSurface, 2)} m²</dd>` : nothing}
        ${isGroup ? nothing : this.volume(p)}
        ${p.floorArea !== null ? html`<dt>${t("floorArea")}</dt><dd id="floor-area">${this.floorArea(p.floorArea)}</dd>` : nothing}
        ${p.surface > 0 && !isGroup ? html`<dt>${t("surface")}</dt><dd>${number(p.surface, 2)} m²</dd>` : nothing}
        ${hasParts && !isGroup && p.totalVolume !== null ? html`<dt>${toolText("totalVolume")}</dt><dd>${number(p.totalVolume, 3)} m³</dd>` : nothing}
        ${hasParts && !isGroup ? html`<dt>${toolText("totalSurface")}</dt><dd>${number(p.totalSurface, 2)} m²</dd>` : nothing}
        ${size.every(Number.isFinite) && p.totalSurface > 0 ? html`<dt>${t("extent")}</dt><dd>${size.map((v) => number(v, 2)).join(" × ")} m</dd>` : nothing}
      </dl>
      <h3>${toolText("attributes")}</h3>
      <svt-attributes .session=${this.session} .of=${p}></svt-attributes>
      ${
        p.neighbours.length
          ? html`<h3>${toolText("neighbours")}</h3><ul>${p.neighbours.map((n) =>
              n.id === ""
                ? html`<li class="outside"><span>${t("outside")}</span><span>${number(n.area, 2)} m²</span></li>`
                : html`<li><button @click=${() => this.session.selection.select([n.id])}><span>${nameOf(index, n)} <span class="quiet">${classText(typeOf(index, n))}</span></span><span>${number(n.area, 2)} m²</span></button></li>`,
            )}</ul>`
          : nothing
      }
    `;
  }

  /** The volume of a closed mesh. Below, or if the mesh is open, that of the voxels with its bound. */
  private volume({ modelVolume, voxelVolume, voxelBound }: FeatureProperties) {
    const voxels = voxelVolume > 0 ? toolText("byVoxels", { value: `${number(voxelVolume, 3)} ± ${number(voxelBound, 3)} m³` }) : "";
    if (modelVolume === null) return voxels ? html`<dt>${t("key_volume")}</dt><dd id="volume">${voxels}</dd>` : nothing;
    return html`<dt>${t("key_volume")}</dt><dd id="volume">${number(modelVolume, 3)} m³${voxels ? html`<small>${voxels}</small>` : nothing}</dd>`;
  }

  private floorArea(area: number): string {
    const value = `${number(area, 2)} m²`;
    return this.session.volume.info?.hasMeshes ? value : toolText("byVoxels", { value });
  }

  private several(n: number) {
    const { volume, view } = this.session;
    const { index } = volume;
    return html`
      <div class="head"><h2>${t("severalSelected", { n })}</h2>${this.close()}</div>
      ${this.actions()}
      ${comparison(this.session.selection.pair)}
      <ul>${view.now.selection.slice(0, 200).map((id) => {
        const feature = index.features[index.byId.get(id) ?? -1];
        return feature
          ? html`<li><button @click=${() => this.session.selection.select([id])}><span>${labelOf(feature)}</span><span title=${feature.class}>${classText(feature.class)}</span></button></li>`
          : nothing;
      })}</ul>
    `;
  }

  private actions() {
    const { session } = this;
    const { now, isSelectionHidden: isHidden } = session.view;
    const focus = { ...now.focus, query: "" };
    return html`<div class="actions">
      <button @click=${() => void session.view.goToSelected()}>${icon("fit", 16)}${toolText("frameIt")}</button>
      <button aria-pressed=${now.effect === "highlight"} @click=${() => session.view.set({ effect: now.effect === "highlight" ? "none" : "highlight", focus })}>${icon("focus", 16)}${t("highlightIt")}</button>
      ${session.volume.isCity ? nothing : html`<button aria-pressed=${now.effect === "cutaway"} @click=${() => session.view.set({ effect: now.effect === "cutaway" ? "none" : "cutaway", focus })}>${icon("target", 16)}${t("cutawayTo")}</button>`}
      <button aria-pressed=${isHidden} @click=${() => session.view.hideSelected(!isHidden)}>${icon(isHidden ? "eye" : "eyeOff", 16)}${isHidden ? t("show") : t("hide")}</button>
      <button aria-pressed=${now.show.length > 0} @click=${() => (now.show.length ? session.view.showOthers() : session.view.showOnlySelected())}>${icon("only", 16)}${t("onlyThis")}</button>
    </div>`;
  }

  private alongList() {
    const { stretches } = this.session.selection.along!;
    return html`
      <div class="head"><h2>${t("alongTitle")}</h2>${this.close()}</div>
      ${stretches.length ? nothing : html`<p class="hint">${toolText("alongNothing")}</p>`}
      <ul class="along">${stretches.map(
        (
          s,
        ) => html`<li><button @click=${() => this.session.selection.select([s.id])}><span>${labelOf(s)} <span class="quiet" title=${s.class}>${classText(s.class)}</span></span>
          <span>${toolText("alongAt", { from: number(s.from, 2), to: number(s.to, 2) })}</span></button></li>`,
      )}</ul>
    `;
  }
}
customElements.define("svt-properties", PropertiesPanel);

/** Attributes and findings come after the first picture. */
function loadDetails(): void {
  void import("./details");
}

/** The type of a neighbour, unless it is its name. */
function typeOf(index: FeatureIndex, { id, name, class: className }: { id: string; name: string; class: string }): string {
  const type = index.features[index.byId.get(id) ?? -1]?.type || className;
  return name && name !== type ? type : "";
}
