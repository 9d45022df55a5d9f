/** The panel of a comparison: its two files, its legend in m3, the switch between old and new, and the list of changes. */

import { css, html, nothing, unsafeCSS } from "lit";
import { untracked } from "../observable";
import { kFileKinds } from "../opening";
import type { ViewState } from "../state/view_state";
import { number, t } from "../texts";
import { save } from "../ui/files";
import { icon } from "../ui/icons";
import { controls, Part } from "../ui/part";
import { kChanges, type Change, type Compared, type Row, type Sums } from "./compared";
import { Comparison, comparisonOf, type State } from "./comparison";
import { hasVolumes, kindsOf, nameOfRow, otherProperties, rowsWith } from "./rows";
import { changeText, compareText, type CompareTextKey } from "./texts";

/** Height of a row, pixels. */
const kRow = 52;
const kSpare = 6;
const kDigits = 4;
/** Decimals of a bound, which may be far below a litre. */
const kBoundDigits = 6;

export class ChangesPanel extends Part {
  static override properties = {
    ...Part.properties,
    comparison: { state: true },
    kinds: { state: true },
    search: { state: true },
    active: { state: true },
    chosen: { state: true },
    top: { state: true },
    listHeight: { state: true },
    isFormOpen: { state: true },
  };
  declare comparison: Comparison;
  /** Kinds that are listed; empty: all. */
  declare kinds: ReadonlySet<Change>;
  declare search: string;
  /** Row with the keyboard focus. */
  declare active: number;
  /** Row whose object was shown last; -1: none. */
  declare chosen: number;
  declare top: number;
  declare listHeight: number;
  declare isFormOpen: boolean;
  private rows: Row[] = [];
  private seen: unknown[] = [];
  private readonly watched = new ResizeObserver(([entry]) => (this.listHeight = entry?.contentRect.height ?? 0));

  static override styles = [
    controls,
    css`
      :host { display: grid; grid-template: auto minmax(0, 1fr) / minmax(0, 1fr); height: 100%; min-height: 0; background: var(--panel); font-size: 13px; }
      header { display: flex; flex-wrap: wrap; gap: 6px 8px; align-items: center; padding: 6px 10px; border-bottom: 1px solid var(--line); }
      header h2 { flex: 0 1 auto; min-width: 0; overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
      .grow { flex: 1; }
      .body { display: grid; grid-template: minmax(0, 1fr) / minmax(250px, 340px) minmax(0, 1fr); min-height: 0; }
      .side { overflow: auto; padding: 8px 12px 12px; border-right: 1px solid var(--line); }
      .alone { grid-column: 1 / -1; border-right: 0; max-width: 620px; }
      .side > * + * { margin-top: 8px; }
      .slider { display: grid; grid-template-columns: auto minmax(60px, 1fr); gap: 10px; align-items: center; }
      ul { list-style: none; margin: 0; padding: 0; }
      .legend li { display: flex; gap: 8px; align-items: center; min-height: 22px; }
      .swatch { width: 12px; height: 12px; flex: none; border-radius: 3px; border: 1px solid #0005; }
      .notes li { padding: 6px 8px; border: 1px solid var(--line); border-radius: 8px; margin-top: 6px; font-size: 12px; line-height: 1.4; overflow-wrap: anywhere; }
      .notes button { margin-top: 4px; white-space: normal; text-align: left; }
      table { border-collapse: collapse; width: 100%; font-size: 12px; }
      th { text-align: left; font-weight: 600; }
      th, td { padding: 2px 4px; border-bottom: 1px solid var(--line); overflow-wrap: anywhere; }
      .n { text-align: right; font-variant-numeric: tabular-nums; overflow-wrap: normal; }
      td.n { white-space: nowrap; }
      .wide { overflow-x: auto; }
      summary { cursor: pointer; min-height: 28px; padding: 4px 0; font-weight: 600; }
      .state { display: grid; grid-template-columns: 84px minmax(0, 1fr) auto; gap: 6px; align-items: center; margin-top: 6px; }
      .options { display: grid; grid-template-columns: minmax(0, 1fr) minmax(0, 1fr); gap: 6px 10px; align-items: center; margin: 8px 0; }
      .options label.check { grid-column: 1 / -1; }
      .list { display: grid; grid-template: auto minmax(0, 1fr) / minmax(0, 1fr); min-height: 0; min-width: 0; }
      .filters { display: flex; flex-wrap: wrap; gap: 4px 6px; align-items: center; padding: 6px 10px; border-bottom: 1px solid var(--line); }
      .filters input { flex: 1 1 120px; width: auto; min-width: 90px; }
      .filters button { padding: 2px 8px; min-height: 28px; gap: 5px; }
      .scroll { overflow: auto; min-height: 0; outline-offset: -2px !important; overscroll-behavior: contain; position: relative; }
      .space { position: relative; }
      .line { position: absolute; left: 0; right: 0; height: ${unsafeCSS(`${kRow}px`)}; display: grid; grid-template-columns: 14px minmax(0, 1fr) auto; gap: 2px 8px; align-content: center; align-items: center; padding: 0 10px; cursor: default; border-bottom: 1px solid var(--line); }
      .line > * { overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
      .line .small { grid-column: 2 / -1; color: var(--quiet); }
      .line .m3 { text-align: right; font-variant-numeric: tabular-nums; }
      .line:hover { background: var(--hover); }
      .line[aria-selected="true"] { background: var(--accent-soft); color: var(--accent-text); }
      .line[aria-selected="true"] .small { color: inherit; }
      .scroll:focus-visible .line.active { box-shadow: inset 0 0 0 2px var(--focus); }
      .none { padding: 14px; }
      progress { width: 100%; height: 6px; accent-color: var(--accent); }
      @media (max-width: 759px) {
        header { padding: 4px 6px; }
        header h2 { flex: 1 1 90px; }
        #changes-back { flex: 0 1 auto; min-width: 0; overflow: hidden; text-overflow: ellipsis; }
        header .grow { display: none; }
        /* One column that scrolls as a whole; the list keeps a height of its own. */
        .body { display: block; overflow: auto; }
        .side { border-right: 0; border-bottom: 1px solid var(--line); overflow: visible; padding: 6px 10px; }
        .list { height: 44dvh; }
        .filters button { min-height: 44px; }
        summary { min-height: 44px; padding: 12px 0; }
        #changes-save-svt, #changes-save-json { display: none; }
      }
      @media (pointer: coarse) { .filters button { min-height: 44px; } }
    `,
  ];

  constructor() {
    super();
    this.kinds = new Set();
    this.search = "";
    this.active = this.top = 0;
    this.chosen = -1;
    this.listHeight = 240;
    this.isFormOpen = false;
  }

  override disconnectedCallback(): void {
    this.watched.disconnect();
    super.disconnectedCallback();
  }

  /** The states and the view of a link, as Comparison.follow(). */
  follow({ state, ...linked }: { old: string; new: string; state: ViewState | null }): void {
    void this.comparison.follow(linked, state);
  }

  /** Files to compare, as Comparison.take(). */
  take(files: readonly File[]): void {
    if (files.length) void this.comparison.take(files);
  }

  override focus(): void {
    this.renderRoot.querySelector<HTMLElement>(".scroll, form select")?.focus();
  }

  override willUpdate(): void {
    if (!this.comparison) {
      this.comparison = comparisonOf(this.session);
      untracked(() => this.comparison.begin());
    }
    const { result } = this.comparison;
    const now = [result, this.kinds, this.search];
    if (now.every((value, n) => value === this.seen[n])) return;
    if (result !== this.seen[0]) {
      this.kinds = now[1] = new Set();
      this.search = now[2] = "";
      this.isFormOpen = false;
    }
    this.seen = now;
    this.rows = result ? rowsWith(result, this.kinds, this.search) : [];
    this.active = this.top = 0;
    this.chosen = -1;
  }

  override render() {
    const { comparison } = this;
    const { result, progress, names } = comparison;
    const title = result ? `${names.old} → ${names.is}` : compareText("compareTitle");
    return html`<header>
        <h2 title=${title}>${title}</h2><span class="grow"></span>
        ${result ? this.saving(result) : nothing}
        ${comparison.backTo !== null ? html`<button id="changes-back" @click=${() => void comparison.back()}>${icon("undo", 16)}${compareText("compareBack", { name: comparison.backTo })}</button>` : nothing}
        <button class="bare" id="changes-close" aria-label=${t("close")} @click=${() => this.close()}>${icon("close", 18)}</button>
      </header>
      <div class="body">
        <div class="side ${result ? "" : "alone"}">
          ${progress ? this.working(progress.text, progress.share) : nothing}
          ${result ? this.outcome(result) : nothing}
          ${result ? html`<details ?open=${this.isFormOpen} @toggle=${(e: Event) => (this.isFormOpen = (e.target as HTMLDetailsElement).open)}><summary>${compareText("compareStates")}</summary>${this.form()}</details>` : this.form()}
        </div>
        ${result ? this.list(result) : nothing}
      </div>`;
  }

  private saving({ file, volume }: Compared) {
    const name = (ending: string) => `changes.${ending}`;
    const button = (
      id: string,
      key: CompareTextKey,
      text: string,
      blob: Blob,
      ending: string,
    ) => html`<button id=${id} aria-label=${compareText(key)} title=${compareText(key)}
      @click=${() => void blob.arrayBuffer().then((bytes) => save(bytes, name(ending)))}>${text}</button>`;
    return html`${button("changes-save-json", "compareSaveJson", "JSON", file, "json")}
      ${volume ? button("changes-save-svt", "compareSaveSvt", "SVT", volume, "svt") : nothing}`;
  }

  private working(text: string, share: number) {
    return html`<div id="comparing" role="status"><span>${text}</span><progress aria-label=${text} max="1" value=${share >= 0 ? share : nothing}></progress>
      <button id="changes-cancel" @click=${() => this.comparison.cancel()}>${t("cancel")}</button></div>`;
  }

  private outcome(result: Compared) {
    const { names, isShown } = this.comparison;
    const values = { old: names.old, new: names.is, n: number(result.order.length, 0) };
    return html`
      <p id="changes-summary">${compareText(result.summary.different ? "compareDone" : "compareEqual", values)}</p>
      ${isShown ? this.states() : nothing}
      ${this.legend(result)}
      ${this.notes(result)}
      ${result.summary.classes.length ? this.classes(result) : nothing}`;
  }

  /** Old, both, new; and a transition between them. */
  private states() {
    const { share } = this.comparison;
    const text = compareText("compareSlider");
    const shown = [
      ["old", "shownOld", 0],
      ["both", "shownBoth", 0.5],
      ["new", "shownNew", 1],
    ] as const;
    return html`<div class="slider"><div class="segments" role="radiogroup" aria-label=${compareText("compareShown")}>${shown.map(
      ([id, key, at]) =>
        html`<button id="shown-${id}" role="radio" aria-checked=${share === at} @click=${() => this.comparison.setShare(at)}>${compareText(key)}</button>`,
    )}</div>
      <wa-slider id="share" size="s" label=${text} aria-label=${text} min="0" max="1" step="0.05" .value=${share} @input=${(e: Event) => this.comparison.setShare(Number((e.target as HTMLInputElement).value))}></wa-slider></div>`;
  }

  private legend({ report, summary }: Compared) {
    const { changes } = summary;
    const { components: all, colors } = report;
    const others = changes.changed + changes.split + changes.merged + changes.reassigned;
    const line = (change: Change, text: string) => html`<li><span class="swatch" data-color=${colors[change]}></span>${text}</li>`;
    const m3 = (value: number | null) => (value === null ? compareText("unknown") : cubic(value));
    const isKnown = all.objects > all.withoutVolume;
    return html`<ul class="legend" id="changes-legend" aria-label=${compareText("compareLegend")}>
        ${all.objects ? line("added", compareText("legendAdded", { m3: m3(all.added) })) : nothing}
        ${all.objects ? line("removed", compareText("legendRemoved", { m3: m3(all.removed) })) : nothing}
        ${changes.moved ? line("moved", compareText("legendMoved", { n: number(changes.moved, 0) })) : nothing}
        ${others ? line("changed", compareText("legendChanged", { n: number(others, 0) })) : nothing}
        ${changes.same ? line("same", compareText("legendSame", { n: number(changes.same, 0) })) : nothing}
      </ul>
      ${isKnown ? html`<p class="small quiet">${compareText("legendSum", { bound: all.bound === null ? compareText("unknown") : cubic(all.bound, kBoundDigits) })}</p>` : nothing}
      ${all.withoutVolume ? html`<p class="small quiet">${compareText("legendUnknown", { n: number(all.withoutVolume, 0), all: number(all.objects, 0) })}</p>` : nothing}`;
  }

  private notes({ report, volume, reason }: Compared) {
    const texts: unknown[] = [];
    const [x, y, z] = report.shift.map((value) => number(value, kDigits)) as [string, string, string];
    if (report.aligned === "moved") texts.push(compareText("noteShift", { x, y, z }));
    if (report.aligned === "aligned") texts.push(compareText("noteAligned"));
    if (report.aligned === "notFound") texts.push(compareText("noteNotFound"));
    if (!report.overlaps)
      texts.push(
        html`${compareText("noteApart")} ${report.aligned ? nothing : html`<button id="changes-align" @click=${() => this.alignAndRun()}>${compareText("noteAlign")}</button>`}`,
      );
    if (report.isReferenceSystemUnknown) texts.push(compareText("noteCrs"));
    if (!report.hasMeshes) texts.push(compareText("noteMeshes"));
    if (!report.isOnOneLattice) texts.push(compareText("noteLattice"));
    else if (!volume) texts.push(compareText("noteNoPicture", { reason }));
    if (!report.isComplete) texts.push(compareText("noteIncomplete"));
    const { findings } = report;
    if (findings.length)
      texts.push(
        html`<details><summary>${compareText("noteFindings", { n: number(findings.length, 0) })}</summary>${findings.slice(0, 50).map((finding) => html`<p class="small">${finding}</p>`)}</details>`,
      );
    return texts.length ? html`<ul class="notes" id="changes-notes">${texts.map((text) => html`<li>${text}</li>`)}</ul>` : nothing;
  }

  private classes({ summary }: Compared) {
    const cell = (value: number | null, digits = kDigits) =>
      html`<td class="n">${value === null ? compareText("unknown") : number(value, digits)}</td>`;
    const row = (sums: Sums & { class: string }) => html`<tr><th scope="row">${sums.class}</th>
      ${cell(sums.added)}${cell(sums.removed)}${cell(sums.bound, kBoundDigits)}<td class="n">${sums.withoutVolume || ""}</td></tr>`;
    const headings = ["addedHeading", "removedHeading", "boundHeading", "unknownHeading"] as const;
    return html`<details><summary>${compareText("compareClasses")}</summary><div class="wide"><table id="changes-classes"><thead><tr><th scope="col">${compareText("classHeading")}</th>${headings.map(
      (key) => html`<th scope="col" class="n">${compareText(key)}</th>`,
    )}</tr></thead><tbody>${summary.classes.map(row)}</tbody></table></div></details>`;
  }

  private form() {
    const { comparison } = this;
    const { wish, linked, old, is, result } = comparison;
    const choice = <Key extends "match" | "properties">(
      key: Key,
      label: CompareTextKey,
      values: readonly string[],
    ) => html`<label for=${`compare-${key}`}>${compareText(label)}</label>
      <select id=${`compare-${key}`} @change=${(e: Event) => (comparison.wish = { ...wish, [key]: (e.target as HTMLSelectElement).value })}>${values.map(
        (value) =>
          html`<option value=${value} ?selected=${value === wish[key]}>${compareText(`${key}_${value}` as CompareTextKey)}</option>`,
      )}</select>`;
    return html`<form @submit=${(e: Event) => (e.preventDefault(), void comparison.run())}>
      ${linked ? html`<p role="status">${compareText("compareLinked", linked)}</p>` : result ? nothing : html`<p class="quiet">${compareText("compareHint")}</p>`}
      ${this.state("old", compareText("compareOld"), old)}${this.state("is", compareText("compareNew"), is)}
      <div class="options">
        <label for="compare-tolerance">${compareText("compareTolerance")}</label>
        <input id="compare-tolerance" type="number" min="0.001" max="1000000" step="any" .value=${String(Number((1000 * wish.tolerance).toFixed(6)))} @change=${this.setTolerance} />
        ${choice("match", "compareMatch", ["both", "space", "id"])}
        ${choice("properties", "compareProperties", ["all", "names", "none"])}
        <label class="check"><input type="checkbox" id="compare-align" .checked=${wish.align} @change=${(e: Event) => (comparison.wish = { ...wish, align: (e.target as HTMLInputElement).checked })} />${compareText("compareAlign")}</label>
      </div>
      <div class="row"><button id="compare-run" class="loud" ?disabled=${!old || !is || comparison.progress !== null}>${compareText(result ? "compareAgain" : "compareRun")}</button>
        <button type="button" id="compare-swap" ?disabled=${!old && !is} @click=${() => comparison.swap()}>${icon("flip", 16)}${compareText("compareSwap")}</button></div>
    </form>`;
  }

  /** A listed model, or files. */
  private state(which: "old" | "is", label: string, chosen: State | null) {
    const listed = this.session.volume.models.filter(({ city }) => !city);
    const text = compareText("compareFile", { state: label });
    const isElse = chosen !== null && !listed.some(({ name }) => name === chosen.name && chosen.isListed);
    return html`<div class="state"><label for="compare-${which}">${label}</label>
      <select id="compare-${which}" @change=${(e: Event) => this.setListed(which, (e.target as HTMLSelectElement).value)}>
        ${chosen ? nothing : html`<option value="" selected>${compareText("compareNone")}</option>`}
        ${isElse ? html`<option value="" selected>${chosen.name}</option>` : nothing}
        ${listed.map(({ name, title }) => html`<option value=${name} ?selected=${chosen?.isListed === true && name === chosen.name}>${title || name}</option>`)}</select>
      <button type="button" class="bare" id="compare-${which}-file" aria-label=${text} title=${text} @click=${(e: Event) => (e.currentTarget as HTMLElement).parentElement!.querySelector<HTMLInputElement>("input")!.click()}>${icon("open", 18)}</button>
      <input type="file" hidden multiple accept=${[...kFileKinds, ".gz"].join(",")} aria-label=${text} @change=${(e: Event) => this.setFiles(which, e.target as HTMLInputElement)} /></div>`;
  }

  private setListed(which: "old" | "is", name: string): void {
    const found = this.comparison.listed(name);
    if (found) this.comparison[which] = found;
  }

  private setFiles(which: "old" | "is", input: HTMLInputElement): void {
    const files = [...(input.files ?? [])];
    input.value = "";
    if (files.length) this.comparison[which] = Comparison.local(files);
  }

  private readonly setTolerance = (event: Event): void => {
    const input = event.target as HTMLInputElement;
    const { comparison } = this;
    if (input.checkValidity() && Number(input.value) > 0) comparison.wish = { ...comparison.wish, tolerance: Number(input.value) / 1000 };
    else input.value = String(1000 * comparison.wish.tolerance);
  };

  private alignAndRun(): void {
    const { comparison } = this;
    comparison.wish = { ...comparison.wish, align: true };
    void comparison.run();
  }

  private list(result: Compared) {
    const { rows } = this;
    const from = Math.max(0, Math.floor(this.top / kRow) - kSpare);
    const to = Math.min(rows.length, Math.ceil((this.top + this.listHeight) / kRow) + kSpare);
    const kinds = kindsOf(result);
    return html`<div class="list">
      <div class="filters"><div class="row" role="group" aria-label=${compareText("changesKinds")}>${kChanges
        .filter((kind) => kinds.has(kind))
        .map((kind) => this.kind(kind, kinds.get(kind)!, result))}</div>
        <input id="changes-filter" type="search" autocomplete="off" spellcheck="false" aria-label=${compareText("changesFilter")} placeholder=${compareText("changesFilter")} .value=${this.search} @input=${(e: Event) => (this.search = (e.target as HTMLInputElement).value)} />
        <span class="small quiet" id="changes-count" role="status">${compareText("changesCount", { n: number(rows.length, 0), all: number(result.order.length, 0) })}</span></div>
      <div class="scroll" id="changes-list" role="listbox" tabindex="0" aria-label=${compareText("changes")} aria-activedescendant=${this.active >= from && this.active < to ? `change-${this.active}` : nothing}
        @scroll=${(e: Event) => (this.top = (e.target as HTMLElement).scrollTop)} @keydown=${this.key}>
        ${rows.length ? html`<div class="space" role="presentation" data-height=${rows.length * kRow}>${rows.slice(from, to).map((row, n) => this.line(row, from + n, result))}</div>` : html`<p class="none quiet" role="option" aria-selected="false" aria-disabled="true">${compareText(result.order.length ? "changesNone" : "compareEqual", { old: this.comparison.names.old, new: this.comparison.names.is })}</p>`}
      </div></div>`;
  }

  private kind(kind: Change, n: number, { report }: Compared) {
    const isOn = this.kinds.has(kind);
    const next = new Set(this.kinds);
    if (!next.delete(kind)) next.add(kind);
    return html`<button id="kind-${kind}" aria-pressed=${isOn} @click=${() => (this.kinds = next)}><span class="swatch" data-color=${report.colors[kind]}></span>${changeText(kind)} ${number(n, 0)}</button>`;
  }

  private line(row: Row, n: number, { report }: Compared) {
    return html`<div id="change-${n}" class="line ${n === this.active ? "active" : ""}" role="option" aria-selected=${n === this.chosen} aria-setsize=${this.rows.length} aria-posinset=${n + 1} data-top=${n * kRow} @click=${() => this.choose(n)}>
      <span class="swatch" data-color=${report.colors[row.change]}></span><span><strong>${changeText(row.change)}</strong> ${nameOfRow(row)}</span><span class="m3">${volumesText(row)}</span>
      <span class="small">${detailsText(row)}</span></div>`;
  }

  override updated(): void {
    const { renderRoot } = this;
    renderRoot.querySelectorAll<HTMLElement>("[data-color]").forEach((e) => (e.style.background = e.dataset["color"]!));
    renderRoot.querySelectorAll<HTMLElement>("[data-top]").forEach((e) => (e.style.transform = `translateY(${e.dataset["top"]}px)`));
    const space = renderRoot.querySelector<HTMLElement>(".space");
    if (space) space.style.height = `${space.dataset["height"]}px`;
    const scroller = renderRoot.querySelector(".scroll");
    this.watched.disconnect();
    if (scroller) this.watched.observe(scroller);
  }

  private choose(n: number): void {
    this.active = this.chosen = n;
    const row = this.rows[n];
    if (row) void this.comparison.goTo(row);
  }

  private readonly key = (event: KeyboardEvent): void => {
    const last = this.rows.length - 1;
    const page = Math.max(1, Math.floor(this.listHeight / kRow) - 1);
    const to = { ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page, Home: -Infinity, End: Infinity }[event.key];
    if (to !== undefined) {
      this.active = Math.max(0, Math.min(last, this.active + to));
      this.reveal(this.active);
    } else if (event.key === "Enter" || event.key === " ") this.choose(this.active);
    else return;
    // The page's own keys would turn the picture.
    event.preventDefault();
    event.stopPropagation();
  };

  private reveal(n: number): void {
    const scroller = this.renderRoot.querySelector<HTMLElement>(".scroll")!;
    const top = n * kRow;
    if (top < scroller.scrollTop) scroller.scrollTop = top;
    else if (top + kRow > scroller.scrollTop + scroller.clientHeight) scroller.scrollTop = top + kRow - scroller.clientHeight;
  }

  private close(): void {
    this.dispatchEvent(new Event("svt-close-changes", { bubbles: true, composed: true }));
  }
}
customElements.define("svt-changes", ChangesPanel);

function cubic(value: number, digits = kDigits): string {
  return `${number(value, digits)} m³`;
}

function volumesText(row: Row): string {
  if (!row.geometry || row.change === "same" || row.change === "reassigned") return "";
  if (!hasVolumes(row)) return compareText("rowUnknown");
  const part = (value: number | null, key: "rowAdded" | "rowRemoved") => {
    const m3 = value === null ? compareText("unknown") : number(value, kDigits);
    return value === 0 ? [] : [compareText(key, { m3 })];
  };
  const parts = [
    ...(row.change === "removed" ? [] : part(row.added, "rowAdded")),
    ...(row.change === "added" ? [] : part(row.removed, "rowRemoved")),
  ];
  return parts.length ? parts.join("  ") : cubic(0, 0);
}

function detailsText(row: Row): string {
  const { class: name, storey, vector, distance, exact, bound, change } = row;
  const names = otherProperties(row);
  const hasSpace = row.geometry && change !== "same" && change !== "reassigned";
  const moved = vector?.map((value) => number(value, kDigits));
  const trust = () => {
    if (!hasVolumes(row)) return "";
    if (bound === null) return compareText("rowNoBound");
    return compareText(exact ? "rowExact" : "rowVoxels", { bound: number(bound, kBoundDigits) });
  };
  return [
    name,
    storey ?? "",
    row.geometry ? "" : compareText("rowNoSpace"),
    moved ? compareText("rowMoved", { x: moved[0]!, y: moved[1]!, z: moved[2]! }) : "",
    hasSpace && distance !== null ? compareText("rowDistance", { m: number(distance, kDigits) }) : "",
    hasSpace ? trust() : "",
    names.length ? compareText("rowProperties", { names: names.join(", ") }) : "",
  ]
    .filter(Boolean)
    .join(" · ");
}
