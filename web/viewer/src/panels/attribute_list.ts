/** The attributes of a feature in foldable groups with a filter; quantities stand beside measured values. */

import { css, html, nothing } from "lit";
import type { FeatureProperties } from "../engine";
import { dateText, number, t } from "../texts";
import { lateText } from "../late_texts";
import { controls, Part } from "../ui/part";
import { filtered, groupsOf, measuredFor, type AttributeGroup, type AttributeRow } from "./attribute_groups";

/** With more attributes than this, there is a filter, and only the first property sets are open. */
const kMany = 12;
/** Longer values get a line of their own. */
const kLongValue = 24;

/** Groups that the user folded or unfolded, by name: they stay so for other features. */
const kept = new Map<string, boolean>();

export class AttributeList extends Part {
  static override properties = { ...Part.properties, of: { attribute: false }, search: { state: true } };
  declare of: FeatureProperties;
  declare search: string;

  static override styles = [
    controls,
    css`
      :host { display: block; }
      details { border-top: 1px solid var(--line); }
      summary { cursor: pointer; padding: 6px 0; font-weight: 600; font-size: 12px; color: var(--quiet); overflow-wrap: anywhere; }
      summary .count { font-weight: 400; }
      dl { margin: 0 0 8px; display: grid; gap: 4px; }
      dl > div { display: grid; grid-template-columns: minmax(0, 2fr) minmax(0, 3fr); gap: 2px 10px; }
      dl > div.long { grid-template-columns: minmax(0, 1fr); }
      dt { color: var(--quiet); overflow-wrap: anywhere; }
      dd { margin: 0; text-align: right; font-variant-numeric: tabular-nums; overflow-wrap: anywhere; white-space: pre-line; }
      .long dd { text-align: left; }
      table { border-collapse: collapse; width: 100%; margin-bottom: 8px; font-variant-numeric: tabular-nums; table-layout: fixed; }
      th, td { padding: 3px 0 3px 6px; text-align: right; vertical-align: top; overflow-wrap: anywhere; font-weight: 400; }
      th { color: var(--quiet); }
      th:first-child { text-align: left; padding-left: 0; }
      thead th { font-size: 11px; border-bottom: 1px solid var(--line); }
      #filter { margin-bottom: 8px; }
      @media (max-width: 759px), (pointer: coarse) { summary { min-height: 44px; padding: 12px 0; } }
    `,
  ];

  constructor() {
    super();
    this.search = "";
  }

  override render() {
    const all = groupsOf(this.of.attributes);
    const count = all.reduce((n, { rows }) => n + rows.length, 0);
    const isMany = count > kMany;
    const shown = isMany ? filtered(all, this.search) : all;
    return html`
      ${
        isMany
          ? html`<input id="filter" type="search" autocomplete="off" spellcheck="false" aria-label=${lateText("filterAttributes")} placeholder=${lateText("filterAttributes")}
              .value=${this.search} @input=${(e: Event) => (this.search = (e.target as HTMLInputElement).value)} />`
          : nothing
      }
      ${shown.length ? shown.map((group, n) => this.group(group, this.isOpen(group, n, isMany))) : html`<p class="quiet">${count ? lateText("noSuchAttribute") : t("noAttributes")}</p>`}
    `;
  }

  private isOpen(group: AttributeGroup, n: number, isMany: boolean): boolean {
    if (this.search) return true;
    return kept.get(keyOf(group)) ?? (!isMany || n < 2 || group.kind !== "set" || /^Pset_/.test(group.set));
  }

  private group(group: AttributeGroup, isOpen: boolean) {
    const title = group.kind === "set" ? group.set : lateText(`group_${group.kind}`);
    const set = group.kind === "quantities" && group.set ? ` · ${group.set}` : "";
    return html`<details ?open=${isOpen} data-group=${keyOf(group)}>
      <summary @click=${(e: Event) => this.folds(group, (e.currentTarget as HTMLElement).parentElement as HTMLDetailsElement)}>${title}${set} <span class="count">(${group.rows.length})</span></summary>
      ${group.kind === "quantities" ? this.quantities(group, title) : html`<dl>${group.rows.map((row) => this.row(row))}</dl>`}
    </details>`;
  }

  /** The search opens groups only as long as it lasts. */
  private folds(group: AttributeGroup, { open }: HTMLDetailsElement): void {
    if (!this.search) kept.set(keyOf(group), !open);
  }

  private row({ name, label, value }: AttributeRow) {
    const text = this.text(name, value);
    return html`<div class=${text.length > kLongValue ? "long" : ""}><dt>${label}</dt><dd>${text}</dd></div>`;
  }

  private text(name: string, value: string): string {
    return valueText(this.of.numbers[name], value);
  }

  private quantities({ rows }: AttributeGroup, title: string) {
    const found = rows.map((row) => ({ row, measured: measuredFor(row.label, this.of) }));
    if (!found.some(({ measured }) => measured)) return html`<dl>${rows.map((row) => this.row(row))}</dl>`;
    return html`<table aria-label=${title}>
      <thead><tr><th scope="col">${lateText("quantity")}</th><th scope="col">${lateText("stated")}</th><th scope="col">${lateText("measured")}</th></tr></thead>
      <tbody>${found.map(
        ({ row, measured }) =>
          html`<tr><th scope="row">${row.label}</th><td>${this.text(row.name, row.value)}</td><td>${measured ? `${number(measured.value, 3)} ${measured.unit}` : ""}</td></tr>`,
      )}</tbody></table>`;
  }
}
customElements.define("svt-attributes", AttributeList);

const keyOf = ({ kind, set }: AttributeGroup): string => (kind === "set" ? set : kind);

/** Numbers and days in the notation of the page's language. */
function valueText(value: { value: number; unit: string } | undefined, text: string): string {
  if (!value) return dateText(text);
  const digits = /\.(\d+)/.exec(text)?.[1]?.length ?? 0;
  return `${number(value.value, Math.min(6, digits))}${value.unit ? ` ${signOf(value.unit)}` : ""}`;
}

/** `m²` for `m2`. */
function signOf(unit: string): string {
  return unit.replace(/^(.*m)([23])$/, (_, metre: string, power: string) => metre + (power === "2" ? "²" : "³"));
}
