/** Fields of the volume: which one is shown, its time, lines and colours, its value at a place, and its values by component. */

import { css, html, nothing, svg } from "lit";
import type { FieldInfo, FieldRow, Scene } from "../engine";
import { kSceneMembers } from "../generated/scene_members";
import { untracked } from "../observable";
import { labelOf } from "../state/feature_index";
import { rangeOfControl } from "../state/member_controls";
import { number } from "../texts";
import { icon } from "../ui/icons";
import { controls, Part } from "../ui/part";
import { seriesPath, timeIndex, timeText, unitText, valueAt, valueText } from "./field_values";
import { probeOf } from "./probe";
import { fieldText } from "./texts";

type SceneField = NonNullable<Scene["field"]>;

const kMaps = kSceneMembers["/field/map"].choices;
const kPer = ["place", ...kSceneMembers["/field/per"].choices] as const;
/** Milliseconds of each time while it plays, at least; a picture may take longer. */
const kStep = 250;
const kMostRows = 100;

export class FieldChoice extends Part {
  static override properties = {
    ...Part.properties,
    fields: { state: true },
    rows: { state: true },
    isPlaying: { state: true },
    areRowsOpen: { state: true },
  };
  /** null: not read yet. */
  declare fields: readonly FieldInfo[] | null;
  /** The components by value at one time; null: not asked for. */
  declare rows: { field: string; time: number; of: readonly FieldRow[] } | null;
  declare isPlaying: boolean;
  declare areRowsOpen: boolean;
  private seenInfo: unknown = null;
  private timer: ReturnType<typeof setInterval> | undefined;

  static override styles = [
    controls,
    css`
      :host { display: block; }
      .line { display: grid; grid-template-columns: 84px minmax(0, 1fr); gap: 6px 10px; align-items: center; margin-top: 6px; }
      .time { grid-template-columns: auto minmax(0, 1fr); }
      .time output { grid-column: 1 / -1; font-variant-numeric: tabular-nums; }
      .ends { display: flex; gap: 6px; align-items: center; }
      .ends input { min-width: 0; flex: 1; }
      svg.series { width: 100%; height: 44px; display: block; border: 1px solid var(--line); border-radius: 6px; }
      .series path { fill: none; stroke: var(--accent); stroke-width: 1.2; vector-effect: non-scaling-stroke; }
      .series line { stroke: var(--quiet); stroke-width: 1; vector-effect: non-scaling-stroke; }
      table { width: 100%; border-collapse: collapse; font-size: 12px; font-variant-numeric: tabular-nums; }
      th, td { text-align: right; padding: 2px 4px; font-weight: 400; }
      th:first-child, td:first-child { text-align: left; }
      td:first-child button { width: 100%; justify-content: flex-start; text-align: left; overflow-wrap: anywhere; white-space: normal; }
      caption { text-align: left; padding: 2px 4px; color: var(--quiet); }
      thead th { color: var(--quiet); }
      #field-value { margin: 6px 0 4px; overflow-wrap: anywhere; }
    `,
  ];

  constructor() {
    super();
    this.fields = this.rows = null;
    this.isPlaying = this.areRowsOpen = false;
  }

  override disconnectedCallback(): void {
    this.stop();
    super.disconnectedCallback();
  }

  override willUpdate(): void {
    const { info } = this.session.volume;
    if (this.seenInfo !== info) {
      this.seenInfo = info;
      this.fields = this.rows = null;
      this.stop();
      untracked(() => void this.load());
    }
    const { field } = this.session.view.now;
    const shown = this.shown;
    if (this.isPlaying && !field) this.stop();
    if (!this.areRowsOpen || !field || !shown) return;
    const time = timeIndex(shown.times, field.time);
    if (!this.isPlaying && (this.rows?.field !== field.name || this.rows.time !== time))
      untracked(() => void this.findRows(field.name, time));
  }

  private get shown(): FieldInfo | undefined {
    const { field } = this.session.view.now;
    return this.fields?.find(({ name }) => name === field?.name);
  }

  private async load(): Promise<void> {
    const { engine, info } = this.session.volume;
    try {
      const fields = (await engine?.fieldList()) ?? [];
      if (this.session.volume.info === info) this.fields = fields;
    } catch (error) {
      this.session.messages.fail(error);
    }
  }

  private async findRows(field: string, time: number): Promise<void> {
    this.rows = { field, time, of: [] };
    try {
      const of = await this.session.volume.engine!.fieldRows(field, time);
      // Another model, field or time may be shown meanwhile.
      if (this.rows?.field === field && this.rows.time === time)
        this.rows = { field, time, of: [...of].sort((a, b) => (b.mean ?? -Infinity) - (a.mean ?? -Infinity)) };
    } catch (error) {
      this.areRowsOpen = false;
      this.session.messages.fail(error);
    }
  }

  override render() {
    const { fields } = this;
    if (!fields?.length) return nothing;
    const { field } = this.session.view.now;
    const { shown } = this;
    const choose = (e: Event) => this.choose((e.target as HTMLSelectElement).value);
    const nameOf = ({ name, quantity, unit }: FieldInfo) =>
      [name, [quantity, unitText(unit)].filter(Boolean).join(", ")].filter(Boolean).join(": ");
    return html`<h3 id="field-title">${fieldText("field")}</h3>
      <select id="field" aria-labelledby="field-title" @change=${choose}>
        <option value="" ?selected=${!field}>${fieldText("fieldNone")}</option>
        ${fields.map((one) => html`<option value=${one.name} ?selected=${one.name === field?.name}>${nameOf(one)}</option>`)}</select>
      ${field && shown ? this.options(field, shown) : nothing}`;
  }

  private options(field: SceneField, shown: FieldInfo) {
    const lines = rangeOfControl("fieldLines");
    return html`${shown.times.length > 1 ? this.time(field, shown) : nothing}
      <div class="line"><label for="field-lines">${fieldText("fieldIsolines")}</label><span class="ends"><input id="field-lines" type="number" ?disabled=${field.per !== undefined} min=${lines.minimum} max=${lines.maximum} step="any" .value=${field.isolines ? String(field.isolines) : ""}
        @change=${(e: Event) => this.change({ isolines: Math.max(0, (e.target as HTMLInputElement).valueAsNumber || 0) })} /><span class="quiet">${unitText(shown.unit)}</span></span></div>
      <div class="line"><label for="field-low">${fieldText("fieldRange")}</label><span class="ends">${this.end(field, shown, 0)}–${this.end(field, shown, 1)}</span></div>
      <div class="line"><label for="field-map">${fieldText("fieldMap")}</label><select id="field-map" @change=${(e: Event) => this.change({ map: (e.target as HTMLSelectElement).value as SceneField["map"] & string })}>
        ${kMaps.map((map) => html`<option ?selected=${(field.map ?? kSceneMembers["/field/map"].default) === map}>${map}</option>`)}</select></div>
      <div class="line"><label for="field-per">${fieldText("fieldPer")}</label><select id="field-per" @change=${(e: Event) => this.changePer((e.target as HTMLSelectElement).value)}>
        ${kPer.map((per) => html`<option value=${per} ?selected=${(field.per ?? "place") === per}>${fieldText(`fieldPer_${per}`)}</option>`)}</select></div>
      ${this.probe(field, shown)}
      <details id="field-rows" ?open=${this.areRowsOpen} @toggle=${(e: Event) => (this.areRowsOpen = (e.target as HTMLDetailsElement).open)}>
        <summary>${fieldText("fieldRows")}</summary>${this.areRowsOpen ? this.table(shown) : nothing}</details>`;
  }

  private time(field: SceneField, shown: FieldInfo) {
    const at = timeIndex(shown.times, field.time);
    return html`<div class="line time"><button class="bare" id="field-play" aria-pressed=${this.isPlaying} aria-label=${fieldText(this.isPlaying ? "fieldPause" : "fieldPlay")} title=${fieldText(this.isPlaying ? "fieldPause" : "fieldPlay")}
        @click=${() => (this.isPlaying ? this.stop() : this.play())}>${icon(this.isPlaying ? "pause" : "play", 16)}</button>
      <wa-slider size="s" id="field-time" label=${fieldText("fieldTime")} aria-label=${fieldText("fieldTime")} min="0" max=${shown.times.length - 1} step="1" .value=${at}
        @input=${(e: Event) => this.goTo(Number((e.target as HTMLInputElement).value))}></wa-slider>
      <output id="field-time-text">${timeText(shown, field.time ?? shown.times[at]!)}</output></div>`;
  }

  /** An end of the range; empty: that of all values. */
  private end(field: SceneField, shown: FieldInfo, n: 0 | 1) {
    const value = field.range?.[n];
    const { minimum, maximum } = rangeOfControl("fieldEnd");
    const hint = shown.range ? String(Number(shown.range[n].toPrecision(4))) : "";
    const set = (e: Event) => {
      const given = (e.target as HTMLInputElement).valueAsNumber;
      const range = [...(field.range ?? shown.range ?? [0, 1])] as [number, number];
      range[n] = Number.isFinite(given) ? given : (shown.range?.[n] ?? range[n]);
      const isWhole = range.every((end, i) => end === shown.range?.[i]);
      if (range[0] < range[1]) this.change(isWhole ? {} : { range }, isWhole ? "range" : undefined);
      this.requestUpdate(); // resets a value that is refused
    };
    return html`<input id=${n ? "field-high" : "field-low"} type="number" min=${minimum} max=${maximum} step="any" aria-label=${`${fieldText("fieldRange")} ${fieldText(n ? "fieldTo" : "fieldFrom")}`} placeholder=${hint} .value=${value === undefined ? "" : String(value)} @change=${set} />`;
  }

  private probe(field: SceneField, shown: FieldInfo) {
    const series = probeOf(this.session).of(field.name);
    if (!series) return html`<p class="small quiet" id="field-value">${fieldText("fieldHint")}</p>`;
    const seconds = field.time ?? shown.times[0]!;
    const value = valueAt(shown.times, series.values, seconds);
    const name = labelOf(series);
    const path = seriesPath(shown.times, series.values);
    const known = series.values.filter((one): one is number => one !== null);
    const x = shown.times.length > 1 ? (100 * (seconds - shown.times[0]!)) / (shown.times.at(-1)! - shown.times[0]!) : 0;
    return html`<p id="field-value" role="status">${value === null ? fieldText("fieldNoValue", { name }) : fieldText("fieldProbe", { name, value: valueText(value, shown.unit) })}</p>
      ${
        path
          ? html`<svg class="series" viewBox="0 0 100 30" preserveAspectRatio="none" role="img"
            aria-label=${fieldText("fieldSeries", { name, low: valueText(Math.min(...known), shown.unit), high: valueText(Math.max(...known), shown.unit) })}>
            ${svg`<path d=${path}></path><line x1=${x} x2=${x} y1="0" y2="30"></line>`}</svg>`
          : nothing
      }`;
  }

  private table(shown: FieldInfo) {
    const rows = this.rows?.of ?? [];
    const cell = (value: number | null) => (value === null ? fieldText("fieldUnknown") : valueText(value, ""));
    const time = shown.times.length > 1 && this.rows ? html`<caption>${timeText(shown, shown.times[this.rows.time]!)}</caption>` : nothing;
    return html`<table>${time}<thead><tr><th></th><th>${fieldText("fieldMean")} ${unitText(shown.unit)}</th><th>${fieldText("fieldRange")}</th></tr></thead><tbody>
      ${rows.slice(0, kMostRows).map(
        (
          row,
        ) => html`<tr><td><button class="bare" @click=${() => this.session.selection.select([row.id])}>${labelOf(row)}</button></td><td>${cell(row.mean)}</td>
          <td>${row.min === null || row.max === null ? fieldText("fieldUnknown") : `${cell(row.min)} – ${cell(row.max)}`}</td></tr>`,
      )}</tbody></table>${rows.length > kMostRows ? html`<p class="small quiet">${fieldText("fieldMore", { n: number(rows.length - kMostRows, 0) })}</p>` : nothing}`;
  }

  private choose(name: string): void {
    // Colours by a key and by a field exclude each other.
    this.session.view.set(name ? { field: { name }, colorBy: "" } : { field: null });
  }

  private change(change: Partial<SceneField>, without?: keyof SceneField): void {
    const { field } = this.session.view.now;
    if (!field) return;
    const next: SceneField = { ...field, ...change };
    if (without) delete next[without];
    this.session.view.set({ field: next });
  }

  private changePer(per: string): void {
    if (per === "place") return this.change({}, "per");
    // Lines need the values at places.
    this.change({ per: per as NonNullable<SceneField["per"]> }, "isolines");
  }

  private goTo(index: number): void {
    const time = this.shown?.times[index];
    if (time !== undefined) this.change({ time });
  }

  private play(): void {
    this.isPlaying = true;
    this.timer = setInterval(() => {
      const { shown } = this;
      // The next time comes after the picture of this one.
      if (!shown || this.session.picture.quality === null) return;
      const at = timeIndex(shown.times, this.session.view.now.field?.time);
      this.goTo((at + 1) % shown.times.length);
    }, kStep);
  }

  private stop(): void {
    clearInterval(this.timer);
    this.isPlaying = false;
  }
}
customElements.define("svt-field", FieldChoice);
