/** The panel of quantities: its options and notes, and the table of objects or of sums, which selects in the picture. */

import { css, html, nothing } from "lit";
import { untracked } from "../observable";
import { gridStyles, kGridRow, placeLines, reveal, rowOfKey, rowsAt } from "../panels/grid";
import { sorted, withWords, type Cell, type Column, type Order } from "../panels/table_rows";
import { language, number, t } from "../texts";
import { icon } from "../ui/icons";
import { controls, Part } from "../ui/part";
import { quantitiesOf, type Quantities } from "./quantities";
import { cellText, columnsOf, keysOf, totalOf, unitOf, type Sums, type TakeOff } from "./take_off";
import { quantityText } from "./texts";

const kNoOrder: Order = { column: -1, isDescending: false };
const kMostFindings = 50;
/** There, the options are folded once there are figures. */
const isNarrow = () => matchMedia("(max-width: 759px)").matches;

export class QuantitiesPanel extends Part {
  static override properties = {
    ...Part.properties,
    quantities: { state: true },
    hasSums: { state: true },
    search: { state: true },
    order: { state: true },
    active: { state: true },
    top: { state: true },
    listHeight: { state: true },
  };
  declare quantities: Quantities;
  /** The table of sums is shown, not that of objects. */
  declare hasSums: boolean;
  declare search: string;
  declare order: Order;
  /** Row with the keyboard focus. */
  declare active: number;
  declare top: number;
  declare listHeight: number;
  private columns: Column[] = [];
  private rows: number[] = [];
  private seenTable: unknown = null;
  private seenRows = "";
  private seenSelection: unknown = null;
  private readonly watched = new ResizeObserver(([entry]) => (this.listHeight = entry?.contentRect.height ?? 0));

  static override styles = [
    controls,
    gridStyles,
    css`
      :host { --cell: 146px; display: grid; grid-template: auto minmax(0, 1fr) / minmax(0, 1fr); height: 100%; min-height: 0; background: var(--panel); font-size: 13px; }
      header { display: flex; flex-wrap: wrap; gap: 6px 8px; align-items: center; padding: 6px 10px; border-bottom: 1px solid var(--line); }
      header h2 { flex: 0 1 auto; min-width: 0; overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
      .grow { flex: 1; }
      .body { display: grid; grid-template: minmax(0, 1fr) / minmax(230px, 300px) minmax(0, 1fr); min-height: 0; }
      .side { overflow: auto; padding: 8px 12px 12px; border-right: 1px solid var(--line); }
      .alone { grid-column: 1 / -1; border-right: 0; max-width: 620px; }
      .side > * + * { margin-top: 8px; }
      form { display: grid; gap: 6px; }
      form label:not(.check) { font-size: 12px; color: var(--quiet); }
      ul { list-style: none; margin: 0; padding: 0; }
      .notes li { padding: 6px 8px; border: 1px solid var(--line); border-radius: 8px; margin-top: 6px; font-size: 12px; line-height: 1.4; overflow-wrap: anywhere; }
      summary { cursor: pointer; min-height: 28px; padding: 4px 0; font-weight: 600; }
      .list { display: grid; grid-template: auto minmax(0, 1fr) / minmax(0, 1fr); min-height: 0; min-width: 0; }
      .filters { display: flex; flex-wrap: wrap; gap: 4px 8px; align-items: center; padding: 6px 10px; border-bottom: 1px solid var(--line); }
      .filters input { flex: 1 1 120px; width: auto; min-width: 90px; }
      .filters select { width: auto; max-width: 200px; flex: 0 1 auto; }
      .foot { position: sticky; bottom: 0; z-index: 1; display: flex; height: 28px; align-items: center; background: var(--panel); border-top: 1px solid var(--line-strong); width: max-content; min-width: 100%; font-weight: 600; }
      /* The next cells are empty. */
      .foot > :first-child { overflow: visible; }
      [role="columnheader"].number .sort { justify-content: flex-end; }
      .none { padding: 14px; }
      progress { width: 100%; height: 6px; accent-color: var(--accent); }
      @media (max-width: 759px) {
        header { padding: 4px 6px; }
        header h2 { flex: 1 1 90px; }
        header .grow { display: none; }
        /* One column that scrolls as a whole; the table keeps a height of its own. */
        .body { display: block; overflow: auto; }
        .side { border-right: 0; border-bottom: 1px solid var(--line); overflow: visible; padding: 6px 10px; }
        .list { height: 49dvh; }
        .filters .segments { flex: 1 1 100%; }
        .filters select { flex: 1 1 40%; max-width: none; min-width: 0; }
        summary { min-height: 44px; padding: 12px 0; }
      }
    `,
  ];

  constructor() {
    super();
    this.hasSums = false;
    this.search = "";
    this.order = kNoOrder;
    this.active = this.top = 0;
    this.listHeight = 240;
  }

  override disconnectedCallback(): void {
    this.watched.disconnect();
    this.quantities?.end();
    super.disconnectedCallback();
  }

  override focus(): void {
    this.renderRoot.querySelector<HTMLElement>("h2")?.focus();
  }

  private get scroller(): HTMLElement | null {
    return this.renderRoot.querySelector(".scroll");
  }

  private get table(): TakeOff | Sums | null {
    const { result, sums } = this.quantities;
    return this.hasSums && sums ? sums : result;
  }

  override willUpdate(): void {
    if (!this.quantities) {
      this.quantities = quantitiesOf(this.session);
      untracked(() => this.quantities.begin());
    }
    const { table } = this;
    const now = JSON.stringify([this.search, this.order, language()]);
    if (this.seenTable === table && this.seenRows === now) return this.follow();
    if (this.seenTable !== table) {
      this.order = kNoOrder;
      this.search = "";
      this.active = this.top = 0;
    }
    this.seenTable = table;
    this.seenRows = JSON.stringify([this.search, this.order, language()]);
    this.columns = table ? columnsOf(table) : [];
    const all = withWords(table?.rows.map((_, n) => n) ?? [], this.columns, this.search);
    const by = this.columns[this.order.column];
    this.rows = by ? sorted(all, by, this.order.isDescending, language()) : all;
    this.active = Math.min(this.active, Math.max(0, this.rows.length - 1));
    this.follow();
  }

  /** The row of an object that was selected elsewhere comes into view. */
  private follow(): void {
    const { selection } = this.session.view.now;
    if (this.seenSelection === selection) return;
    this.seenSelection = selection;
    const isSelected = this.selected();
    if (!this.rows[this.active] || !isSelected(this.rows[this.active]!)) {
      const row = this.rows.findIndex(isSelected);
      if (row < 0) return;
      this.active = row;
      void this.updateComplete.then(() => this.show(row));
    }
  }

  /** Ids of a row of the shown table. */
  private idsOf(n: number): string[] {
    const { result, sums } = this.quantities;
    const at = result?.columns.indexOf("id") ?? -1;
    const members = this.table === sums && sums ? sums.members[n]! : [n];
    return members.map((member) => String(result!.rows[member]![at]));
  }

  /** Whether all objects of a row are selected. */
  private selected(): (n: number) => boolean {
    const chosen = new Set(this.session.view.now.selection);
    if (!chosen.size || !this.quantities.result) return () => false;
    return (n) => this.idsOf(n).every((id) => chosen.has(id));
  }

  override render() {
    const { quantities } = this;
    const { result, progress, obstacle, isStopped } = quantities;
    const title = `${t("quantities")}${quantities.name ? `: ${quantities.name}` : ""}`;
    return html`<header>
        <h2 tabindex="-1" title=${title}>${title}</h2><span class="grow"></span>
        ${result ? this.saving() : nothing}
        <button class="bare" id="quantities-close" aria-label=${t("close")} @click=${() => this.close()}>${icon("close", 18)}</button>
      </header>
      <div class="body">
        <div class="side ${result ? "" : "alone"}">
          ${obstacle ? html`<p id="quantities-obstacle" role="status">${quantityText(obstacle)}</p>` : nothing}
          ${progress ? this.working(progress.text, progress.share) : nothing}
          ${isStopped ? html`<p role="status">${quantityText("quantitiesStopped")}</p>` : nothing}
          ${obstacle ? nothing : result && isNarrow() ? html`<details><summary>${quantityText("quantitiesOptions")}</summary>${this.form()}</details>` : this.form()}
          ${result ? this.notes(result) : nothing}
        </div>
        ${result ? this.list(result) : nothing}
      </div>`;
  }

  private saving() {
    const button = (ending: "csv" | "json", text: string, isSums: boolean) =>
      html`<button id="quantities-save-${ending}" aria-label=${text} title=${text} @click=${() => void this.quantities.save(ending, isSums ? "sums" : "quantities")}>${ending.toUpperCase()}</button>`;
    return html`${button("csv", quantityText("quantitiesSaveCsv"), this.table === this.quantities.sums)}${button("json", quantityText("quantitiesSaveJson"), false)}`;
  }

  private working(text: string, share: number) {
    return html`<div id="measuring" role="status"><span>${text}</span><progress aria-label=${text} max="1" value=${share >= 0 ? share : nothing}></progress>
      <button id="quantities-cancel" @click=${() => this.quantities.cancel()}>${t("cancel")}</button></div>`;
  }

  private form() {
    const { quantities } = this;
    const { wish, progress } = quantities;
    const query = (id: "where" | "formwork", label: string, empty: string) => html`<label for="quantities-${id}">${label}</label>
      <input id="quantities-${id}" autocomplete="off" spellcheck="false" placeholder=${empty} .value=${wish[id]} @change=${(e: Event) => (quantities.wish = { ...quantities.wish, [id]: (e.target as HTMLInputElement).value.trim() })} />`;
    return html`<form @submit=${(e: Event) => (e.preventDefault(), void quantities.run())}>
      <p class="quiet small">${quantityText("quantitiesHint")}</p>
      ${query("where", quantityText("quantitiesWhere"), quantityText("quantitiesAll"))}
      ${query("formwork", quantityText("quantitiesFormwork"), quantityText("quantitiesNoFormwork"))}
      <label class="check"><input type="checkbox" id="quantities-exterior" .checked=${wish.exterior} @change=${(e: Event) => (quantities.wish = { ...quantities.wish, exterior: (e.target as HTMLInputElement).checked })} />${quantityText("quantitiesExterior")}</label>
      <div class="row"><button id="quantities-run" class="loud" ?disabled=${progress !== null}>${quantityText("quantitiesRun")}</button></div>
    </form>`;
  }

  /** The notes that the command prints, too. The library's own words are English. */
  private notes({ notes, assumptions }: TakeOff) {
    const { model } = this.quantities;
    const spacing = model ? [...new Set(model.spacing.map((metres) => number(metres, 3)))].join(" × ") : "";
    const findings = model?.findings ?? [];
    const english = (text: string) => html`<li lang="en">${text}</li>`;
    return html`<ul class="notes" id="quantities-notes">
        ${notes.map(english)}${model?.reason ? english(`spacing: ${model.reason}`) : nothing}
        <li>${quantityText("quantitiesSpacing", { m: spacing })}</li><li>${quantityText("quantitiesLegend")}</li></ul>
      <details><summary>${quantityText("quantitiesAssumptions")}</summary><ul class="notes">${assumptions.map(english)}</ul></details>
      ${findings.length ? html`<details><summary>${quantityText("quantitiesFindings", { n: number(findings.length, 0) })}</summary><ul class="notes">${findings.slice(0, kMostFindings).map(english)}</ul></details>` : nothing}`;
  }

  private list(result: TakeOff) {
    const { rows, columns, table } = this;
    const { sums } = this.quantities;
    const [from, to] = rowsAt(this.top, this.listHeight, rows.length);
    const isSelected = this.selected();
    const isSums = table === sums;
    const title = quantityText(isSums ? "quantitiesSums" : "quantitiesObjects");
    const shown = (isOf: boolean, id: string, text: string) =>
      html`<button id="quantities-${id}" role="radio" aria-checked=${isSums === isOf} ?disabled=${isOf && !sums} @click=${() => (this.hasSums = isOf)}>${text}</button>`;
    return html`<div class="list">
      <div class="filters">
        <div class="segments" role="radiogroup" aria-label=${quantityText("quantitiesShown")}>${shown(false, "objects", quantityText("quantitiesObjects"))}${shown(true, "sums", quantityText("quantitiesSums"))}</div>
        ${this.key(0)}${this.quantities.keys.length ? this.key(1) : nothing}
        <input id="quantities-filter" type="search" autocomplete="off" spellcheck="false" aria-label=${quantityText("quantitiesFilter")} placeholder=${quantityText("quantitiesFilter")} .value=${this.search} @input=${(e: Event) => this.find((e.target as HTMLInputElement).value)} />
        <span class="small quiet" id="quantities-count" role="status">${quantityText("quantitiesCount", { n: number(rows.length, 0), all: number(table!.rows.length, 0) })}</span></div>
      <div class="scroll" id="quantities-table" role="grid" tabindex="0" aria-label=${title} aria-rowcount=${rows.length + 2} aria-colcount=${columns.length} aria-multiselectable="true"
        aria-activedescendant=${this.active >= from && this.active < to ? `line-${this.active}` : nothing} @scroll=${(e: Event) => (this.top = (e.target as HTMLElement).scrollTop)} @keydown=${this.keyDown}>
        <div class="head" role="row" aria-rowindex="1">${columns.map((column, n) => this.header(column, n))}</div>
        <div class="space" role="rowgroup" data-height=${rows.length * kGridRow}>${rows.slice(from, to).map((n, at) => this.line(n, from + at, isSelected(n)))}</div>
        <div class="foot" role="row" aria-rowindex=${rows.length + 2}>${columns.map((column, n) => this.sum(result, column, n))}</div>
      </div></div>`;
  }

  /** The choice of a key of the sums. */
  private key(n: 0 | 1) {
    const { quantities } = this;
    const { keys } = quantities;
    const label = quantityText(n === 0 ? "quantitiesBy" : "quantitiesThenBy");
    const possible = keysOf(this.session.volume.info?.attributes ?? []).filter((key) => n === 0 || key !== keys[0]);
    return html`<select id="quantities-by-${n}" aria-label=${label} @change=${(e: Event) => this.sumBy(n, (e.target as HTMLSelectElement).value)}>
      <option value="" ?selected=${!keys[n]}>${label}: ${quantityText("quantitiesNoKey")}</option>
      ${possible.map((key) => html`<option value=${key} ?selected=${key === keys[n]}>${label}: ${key}</option>`)}</select>`;
  }

  private sumBy(n: 0 | 1, key: string): void {
    const { quantities } = this;
    const rest = n === 0 ? quantities.keys.slice(1).filter((other) => other !== key) : [];
    const keys = n === 0 ? (key ? [key, ...rest] : []) : [quantities.keys[0]!, ...(key ? [key] : [])];
    this.hasSums = keys.length > 0;
    void quantities.setKeys(keys);
  }

  private header({ key, title, unit }: Column, n: number) {
    const isSorted = this.order.column === n;
    const sort = isSorted ? (this.order.isDescending ? "descending" : "ascending") : "none";
    const name = unit ? `${title} ${unit}` : title;
    return html`<div role="columnheader" class=${isNumber(key) ? "number" : ""} aria-colindex=${n + 1} aria-sort=${sort}>
      <button class="sort" title=${quantityText("quantitiesSort", { name })} @click=${() => this.sortBy(n)}><span>${name}</span>${isSorted ? icon(this.order.isDescending ? "down" : "up", 12) : nothing}</button></div>`;
  }

  private line(n: number, row: number, isSelected: boolean) {
    const { sums } = this.quantities;
    const unknown = this.table === sums ? sums?.unknown[n] : undefined;
    return html`<div id="line-${row}" class="line ${row === this.active ? "active" : ""}" role="row" aria-rowindex=${row + 2} aria-selected=${isSelected} data-top=${row * kGridRow}
      @click=${(e: MouseEvent) => this.pick(row, e.ctrlKey || e.metaKey)} @dblclick=${() => void this.session.view.goToSelected()}>
      ${this.columns.map(({ key, cells }) => this.cell(key, cells[n] ?? null, unknown?.[key]))}</div>`;
  }

  /** @param unknown  number of objects that a sum leaves out */
  private cell(key: string, cell: Cell, unknown = 0) {
    const text = cellText(key, cell);
    const isPartial = unknown > 0 && cell !== null;
    const said = isPartial
      ? quantityText("quantitiesPartial", { value: text, n: number(unknown, 0) })
      : cell === null
        ? quantityText("quantitiesUnknown")
        : "";
    return html`<div role="gridcell" class=${isNumber(key) ? "number" : ""} title=${said || text} aria-label=${said || nothing}>${text}${isPartial ? " *" : ""}</div>`;
  }

  private sum({ total }: TakeOff, { key }: Column, n: number) {
    if (n === 0) {
      const text = quantityText("quantitiesTotal", { n: number(total.objects, 0) });
      return html`<div role="gridcell" title=${text}>${text}</div>`;
    }
    const value = totalOf(total, key);
    return value === undefined || key === "objects" ? html`<div role="gridcell"></div>` : this.cell(key, value, total.unknown?.[key]);
  }

  override updated(): void {
    placeLines(this.renderRoot);
    const { scroller } = this;
    this.watched.disconnect();
    if (scroller) this.watched.observe(scroller);
  }

  private pick(row: number, isAdded: boolean): void {
    this.active = row;
    const n = this.rows[row];
    if (n !== undefined) this.quantities.select(this.idsOf(n), isAdded);
  }

  private readonly keyDown = (event: KeyboardEvent): void => {
    if (event.target !== this.scroller || event.altKey) return;
    const to = rowOfKey(event.key, this.active, this.rows.length, this.listHeight);
    if (event.key === "Enter" || event.key === " ") this.pick(this.active, event.ctrlKey || event.metaKey);
    else if (to !== null) this.show((this.active = Math.max(0, to)));
    else return;
    // The page's own keys would turn the picture.
    event.preventDefault();
    event.stopPropagation();
  };

  private show(row: number): void {
    const { scroller } = this;
    if (scroller) reveal(scroller, row, scroller.querySelector<HTMLElement>(".foot")!.offsetHeight);
  }

  private find(text: string): void {
    this.search = text;
    this.toTop();
  }
  private sortBy(column: number): void {
    this.order = { column, isDescending: this.order.column === column && !this.order.isDescending };
    this.toTop();
  }
  private toTop(): void {
    this.active = this.top = 0;
    if (this.scroller) this.scroller.scrollTop = 0;
  }

  private close(): void {
    this.dispatchEvent(new Event("svt-close-quantities", { bubbles: true, composed: true }));
  }
}
customElements.define("svt-quantities", QuantitiesPanel);

/** Columns of figures are at the right. */
function isNumber(key: string): boolean {
  return unitOf(key) !== "" || key === "openings" || key === "objects";
}
