/** The features of the model by class, or by the values of an attribute: streets or districts of a city, materials of a house. */

import { css, html, nothing } from "lit";
import type { AttributeValues } from "../engine";
import { untracked } from "../observable";
import { classText } from "../state/class_words";
import { withMembers, type FeatureIndex } from "../state/feature_index";
import { ofClass } from "../state/queries";
import type { SeenCounts } from "../state/visibility";
import { language, number, t } from "../texts";
import { toolText } from "../tool_texts";
import { controls, Part } from "../ui/part";
import { eyeOf } from "./eye";

/** Rows of an attribute with more values, the most frequent first. */
const kMostRows = 300;
const kMostAttributes = 100;
const kDecimals = 3;

interface Group {
  title: string;
  /** The name in the model; the tooltip. */
  name: string;
  /** Selects the members; empty: no short query does. */
  query: string;
  members: number[];
}

export class FeatureGroups extends Part {
  static override properties = {
    ...Part.properties,
    counts: { attribute: false },
    edited: { attribute: false },
    attribute: { state: true },
    values: { state: true },
  };
  declare counts: SeenCounts;
  /** The query whose style is being edited. */
  declare edited: string;
  /** Empty: by class. */
  declare attribute: string;
  declare values: { index: FeatureIndex; name: string; of: AttributeValues } | null;

  static override styles = [
    controls,
    css`
      :host { display: block; }
      label.by { display: grid; grid-template-columns: auto 1fr; gap: 8px; align-items: center; padding: 8px 10px; font-size: 12px; color: var(--quiet); }
      ul { list-style: none; margin: 0; padding: 0; }
      li { display: flex; align-items: center; gap: 4px; padding: 0 6px 0 8px; min-height: 30px; }
      li:hover { background: var(--hover); }
      li button { min-height: 26px; min-width: 26px; padding: 2px; border-radius: 6px; flex: none; }
      li button.name { flex: 1; min-width: 0; justify-content: flex-start; overflow: hidden; }
      .name span { overflow: hidden; text-overflow: ellipsis; white-space: nowrap; min-width: 0; }
      .gone .name { color: var(--quiet); text-decoration: line-through; }
      .swatch { width: 14px; height: 14px; border-radius: 4px; border: 1px solid #0003; }
      .count { font-size: 12px; color: var(--quiet); font-variant-numeric: tabular-nums; padding-right: 4px; }
      .eye { color: var(--quiet); }
      .eye.none { color: var(--text); }
      p { margin: 0; padding: 8px 10px; }
      @media (max-width: 759px), (pointer: coarse) { li, li button { min-height: 44px; min-width: 44px; } }
    `,
  ];

  constructor() {
    super();
    this.attribute = this.edited = "";
    this.values = null;
  }

  override willUpdate(): void {
    const { index, info } = this.session.volume;
    if (this.attribute && !info?.attributes.includes(this.attribute)) this.attribute = "";
    const { attribute, values } = this;
    if (attribute && (values?.index !== index || values.name !== attribute)) untracked(() => void this.load(attribute, index));
  }

  private async load(name: string, index: FeatureIndex): Promise<void> {
    try {
      const of = await this.session.volume.engine!.attributeValues(name);
      if (this.attribute === name && this.session.volume.index === index) this.values = { index, name, of };
    } catch (error) {
      this.attribute = "";
      this.session.messages.fail(error);
    }
  }

  override render() {
    const { index, info } = this.session.volume;
    const { attribute, values } = this;
    const groups = !attribute ? classesOf(index) : values?.name === attribute && values.index === index ? valuesOf(index, values.of) : null;
    const attributes = (info?.attributes ?? []).slice(0, kMostAttributes);
    return html`
      ${
        attributes.length
          ? html`<label class="by">${toolText("groupBy")}<select id="group-by" @change=${(e: Event) => (this.attribute = (e.target as HTMLSelectElement).value)}>
            <option value="" ?selected=${!attribute}>${t("key_class")}</option>${attributes.map(
              (name) => html`<option value=${name} ?selected=${name === attribute}>${name}</option>`,
            )}</select></label>`
          : nothing
      }
      <ul class="classes">${groups?.slice(0, kMostRows).map((group) => this.row(group, index))}</ul>
      ${groups && groups.length > kMostRows ? html`<p class="small quiet">${toolText("groupsMore", { n: number(groups.length - kMostRows, 0) })}</p>` : nothing}
    `;
  }

  private row({ title, name, query, members }: Group, index: FeatureIndex) {
    const { selection, view } = this.session;
    const all = query ? members : withMembers(index, members);
    const seen = this.counts.ofMembers(all);
    const solid = index.features[members.find((i) => index.features[i]!.count > 0) ?? -1];
    const color = view.now.styles.find((style) => style.select === query && style.color)?.color ?? solid?.color;
    const edit = () => this.dispatchEvent(new CustomEvent("svt-edit", { detail: { query, name: title, like: members } }));
    return html`<li class=${seen === "none" ? "gone" : ""}>
      ${
        query
          ? html`<button class="bare" aria-label=${t("styleOf", { name: title })} aria-expanded=${this.edited === query} @click=${edit}><span class="swatch" data-color=${color}></span></button>`
          : nothing
      }
      <button class="bare name" title=${name} @click=${(e: MouseEvent) =>
        selection.select(
          members.map((i) => index.features[i]!.id),
          e.ctrlKey,
          query,
        )}><span>${title}</span></button>
      <span class="count">${number(query ? members.filter((i) => index.features[i]!.count > 0).length : members.length, 0)}</span>
      <button class="bare eye ${seen}" aria-pressed=${seen === "none"} aria-label="${t("hide")}: ${title}" @click=${() => view.hide(all, seen !== "none")}>${eyeOf(seen)}</button>
    </li>`;
  }

  override updated(): void {
    this.renderRoot.querySelectorAll<HTMLElement>("[data-color]").forEach((e) => (e.style.background = e.dataset["color"]!));
  }
}
customElements.define("svt-groups", FeatureGroups);

/** Classes with voxels. */
function classesOf(index: FeatureIndex): Group[] {
  return [...index.classes]
    .filter(([, members]) => members.some((i) => index.features[i]!.count > 0))
    .map(([name, members]) => ({ title: classText(name), name, query: ofClass(name), members }));
}

/** Values of an attribute, the most frequent first; those of equal number in the order of a dictionary. */
function valuesOf(index: FeatureIndex, { values, unit }: AttributeValues): Group[] {
  const groups = new Map<string, number[]>();
  values.forEach((value, i) => {
    if (value === null || i >= index.features.length) return;
    const text = typeof value === "number" ? `${number(value, Number.isInteger(value) ? 0 : kDecimals)}${unit ? ` ${unit}` : ""}` : value;
    const members = groups.get(text);
    if (members) members.push(i);
    else groups.set(text, [i]);
  });
  const { compare } = new Intl.Collator(language(), { numeric: true });
  return [...groups]
    .sort(([a, some], [b, others]) => others.length - some.length || compare(a, b))
    .map(([title, members]) => ({ title, name: title, query: "", members }));
}
