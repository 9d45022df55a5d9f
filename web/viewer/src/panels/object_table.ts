/** The table of objects with their attributes. Only visible rows are in the page, so that 100,000 objects cost no more than 30. */

import { css, html, nothing, unsafeCSS } from "lit";
import { coverText } from "../city/cover";
import { language, number, t } from "../texts";
import { lateText } from "../late_texts";
import { save } from "../ui/files";
import { icon } from "../ui/icons";
import { controls, Part } from "../ui/part";
import { nameOf } from "./feature_path";
import { gridStyles, kGridRow, placeLines, reveal, rowOfKey, rowsAt } from "./grid";
import { cellsOf, csvOf, rowsWith, sorted, storeysOf, type Cell, type Column, type Order } from "./table_rows";

const kWidth = 170;
/** Attributes that a new table shows. */
const kFirstAttributes = 3;
const kDigits = 6;

export class ObjectTable extends Part {
  static override properties = {
    ...Part.properties,
    added: { state: true },
    search: { state: true },
    order: { state: true },
    active: { state: true },
    top: { state: true },
    listHeight: { state: true },
  };
  /** Columns of attributes, in the order of the user. */
  declare added: readonly Column[];
  /** Empty: all classes. */
  private ofOnly = "";
  declare search: string;
  declare order: Order;
  /** Row with the keyboard focus. */
  declare active: number;
  declare top: number;
  declare listHeight: number;
  private seenIndex: unknown = null;
  private seenColumns: unknown = null;
  private seenRows = "";
  private columns: Column[] = [];
  private rows: number[] = [];
  private readonly watched = new ResizeObserver(([entry]) => (this.listHeight = entry?.contentRect.height ?? 0));

  static override styles = [
    controls,
    gridStyles,
    css`
      :host { --cell: ${unsafeCSS(`${kWidth}px`)}; display: grid; grid-template: auto minmax(0, 1fr) / minmax(0, 1fr); height: 100%; min-height: 0; background: var(--panel); font-size: 13px; }
      header { display: flex; flex-wrap: wrap; gap: 8px; align-items: center; padding: 6px 10px; border-bottom: 1px solid var(--line); }
      header h2 { flex: none; }
      header input { flex: 1 1 160px; width: auto; min-width: 0; }
      header select { width: auto; max-width: 190px; flex: 0 1 auto; }
      .grow { flex: 1; }
      @media (max-width: 759px) {
        header { padding: 4px 6px; gap: 6px; }
        header h2 { display: none; }
        header select { flex: 1 1 110px; max-width: none; min-width: 0; }
        #table-close { order: 1; }
        header input, header span { order: 2; }
        #table-select, #table-save { order: 3; flex: 1 1 auto; }
      }
    `,
  ];

  constructor() {
    super();
    this.added = [];
    this.search = "";
    this.order = { column: -1, isDescending: false };
    this.active = this.top = 0;
    this.listHeight = 240;
  }

  override disconnectedCallback(): void {
    this.watched.disconnect();
    super.disconnectedCallback();
  }
  override firstUpdated(): void {
    this.watched.observe(this.scroller);
    this.renderRoot.querySelector<HTMLElement>("#table-filter")?.focus();
  }
  private get scroller(): HTMLElement {
    return this.renderRoot.querySelector(".scroll")!;
  }

  override willUpdate(): void {
    const { index, info } = this.session.volume;
    if (this.seenIndex !== index) {
      const isFirst = this.seenIndex === null;
      this.seenIndex = index;
      if (!index.classes.has(this.ofOnly)) this.ofOnly = "";
      const names = isFirst
        ? (info?.attributes ?? []).filter((name) => name !== "ifcType").slice(0, kFirstAttributes)
        : this.added.map(({ key }) => key);
      this.added = [];
      void this.load(names.filter((name) => info?.attributes.includes(name)));
      this.seenColumns = null;
      this.active = 0;
    }
    if (this.seenColumns !== this.added) {
      this.seenColumns = this.added;
      this.columns = [...this.ownColumns(), ...this.added];
      this.seenRows = "";
    }
    const key = JSON.stringify([this.ofOnly, this.search, this.order, language()]);
    if (this.seenRows === key) return;
    this.seenRows = key;
    const rows = rowsWith(index, this.columns, this.ofOnly, this.search);
    const by = this.columns[this.order.column];
    this.rows = by ? sorted(rows, by, this.order.isDescending, language()) : rows;
    this.active = Math.min(this.active, Math.max(0, this.rows.length - 1));
  }

  private ownColumns(): Column[] {
    const { index } = this.session.volume;
    const { features } = index;
    const storeys = storeysOf(index);
    const own = (key: string, title: string, cells: Cell[]): Column => ({ key, isAttribute: false, title, unit: "", cells });
    return [
      own(
        "name",
        lateText("tableName"),
        features.map((feature) => nameOf(index, feature)),
      ),
      own(
        "type",
        lateText("tableType"),
        features.map(({ type, class: name }) => type || name),
      ),
      own(
        "storey",
        lateText("tableStorey"),
        features.map((_, i) => (storeys[i]! < 0 ? null : nameOf(index, features[storeys[i]!]!))),
      ),
      own(
        "id",
        lateText("tableId"),
        features.map(({ id }) => id),
      ),
    ];
  }

  private async load(names: readonly string[]): Promise<void> {
    const { engine, info, index } = this.session.volume;
    if (!engine || !info) return;
    try {
      for (const name of names) {
        const found = await engine.attributeValues(name);
        // Another model may have been opened meanwhile.
        if (this.session.volume.index !== index) return;
        const column = { key: name, isAttribute: true, title: name, unit: found.unit, cells: cellsOf(found, info.features, index) };
        this.added = [...this.added, column];
      }
    } catch (error) {
      this.session.messages.fail(error);
    }
  }

  override render() {
    const { volume, view } = this.session;
    const { index } = volume;
    const { columns, rows } = this;
    const chosen = new Set(view.now.selection);
    const [from, to] = rowsAt(this.top, this.listHeight, rows.length);
    const selected = view.now.selection.length ? (i: number) => chosen.has(index.features[i]!.id) : () => false;
    return html`
      ${this.bar()}
      <div class="scroll" role="grid" tabindex="0" aria-label=${lateText("table")} aria-rowcount=${rows.length + 1} aria-colcount=${columns.length} aria-multiselectable="true"
        aria-activedescendant=${this.active >= from && this.active < to ? `line-${this.active}` : nothing} @scroll=${(e: Event) => (this.top = (e.target as HTMLElement).scrollTop)} @keydown=${this.key}>
        <div class="head" role="row" aria-rowindex="1">${columns.map((column, n) => this.header(column, n))}</div>
        <div class="space" role="rowgroup" data-height=${rows.length * kGridRow}>${rows.slice(from, to).map((i, n) => this.line(i, from + n, selected(i)))}</div>
      </div>`;
  }

  private bar() {
    const { index, info } = this.session.volume;
    const used = new Set(this.added.map(({ key }) => key));
    const classes = [...index.classes.keys()].sort();
    return html`<header>
      <h2>${lateText("table")}</h2>
      <select id="table-class" aria-label=${lateText("tableClass")} @change=${(e: Event) => this.ofClass((e.target as HTMLSelectElement).value)}>
        <option value="">${lateText("tableAllClasses")}</option>
        ${classes.map((name) => html`<option value=${name} ?selected=${name === this.ofOnly}>${name}</option>`)}</select>
      <input id="table-filter" type="search" autocomplete="off" spellcheck="false" aria-label=${lateText("tableFilter")} placeholder=${lateText("tableFilter")}
        .value=${this.search} @input=${(e: Event) => this.find((e.target as HTMLInputElement).value)} />
      <select id="table-column" aria-label=${lateText("tableColumn")} @change=${(e: Event) => this.addColumn(e.target as HTMLSelectElement)}>
        <option value="" selected>${lateText("tableColumn")}</option>
        ${(info?.attributes ?? []).filter((name) => !used.has(name)).map((name) => html`<option value=${name}>${name}</option>`)}</select>
      <span id="table-count" class="small quiet" role="status">${lateText("tableCount", { n: number(this.rows.length, 0), all: number(index.features.length, 0) })} ${coverText(this.session) ?? ""}</span>
      <button id="table-select" ?disabled=${!this.rows.length} @click=${() => this.selectAll()}>${lateText("tableSelect")}</button>
      <button id="table-save" ?disabled=${!this.rows.length} @click=${() => save(csvOf(this.columns, this.rows), "objects.csv")}>${lateText("tableSave")}</button>
      <button class="bare" id="table-close" aria-label=${t("close")} @click=${() => this.close()}>${icon("close", 18)}</button>
    </header>`;
  }

  private header({ title, unit, isAttribute, key }: Column, n: number) {
    const isSorted = this.order.column === n;
    const sort = isSorted ? (this.order.isDescending ? "descending" : "ascending") : "none";
    const name = unit ? `${title} [${unit}]` : title;
    return html`<div role="columnheader" aria-colindex=${n + 1} aria-sort=${sort}>
      <button class="sort" title=${lateText("tableSort", { name })} @click=${() => this.sortBy(n)}><span>${name}</span>${isSorted ? icon(this.order.isDescending ? "down" : "up", 12) : nothing}</button>
      ${isAttribute ? html`<button class="bare" aria-label=${lateText("tableRemove", { name: title })} title=${lateText("tableRemove", { name: title })} @click=${() => this.removeColumn(key)}>${icon("close", 12)}</button>` : nothing}
    </div>`;
  }

  private line(i: number, row: number, isSelected: boolean) {
    return html`<div id="line-${row}" class="line ${row === this.active ? "active" : ""}" role="row" aria-rowindex=${row + 2} aria-selected=${isSelected} data-top=${row * kGridRow}
      @click=${(e: MouseEvent) => this.pick(row, e.ctrlKey || e.metaKey)} @dblclick=${() => void this.session.view.goToSelected()}>
      ${this.columns.map(({ cells }) => {
        const cell = cells[i] ?? null;
        return html`<div role="gridcell" class=${typeof cell === "number" ? "number" : ""} title=${cellText(cell)}>${cellText(cell)}</div>`;
      })}</div>`;
  }

  override updated(): void {
    placeLines(this.renderRoot);
    const space = this.renderRoot.querySelector<HTMLElement>(".space")!;
    space.style.width = `${this.columns.length * kWidth}px`;
  }

  private pick(row: number, isAdded: boolean): void {
    this.active = row;
    const i = this.rows[row];
    if (i !== undefined) this.session.selection.select([this.session.volume.index.features[i]!.id], isAdded);
  }

  private readonly key = (event: KeyboardEvent): void => {
    if (event.target !== this.scroller || event.altKey) return;
    const to = rowOfKey(event.key, this.active, this.rows.length, this.listHeight);
    if (event.key === "Enter" || event.key === " ") this.pick(this.active, event.ctrlKey || event.metaKey);
    else if (to !== null) this.moveTo(to);
    else return;
    event.preventDefault();
    event.stopPropagation();
  };

  private moveTo(row: number): void {
    this.active = row;
    reveal(this.scroller, row);
  }

  private selectAll(): void {
    const { features } = this.session.volume.index;
    this.session.selection.select(this.rows.map((i) => features[i]!.id));
  }

  private ofClass(name: string): void {
    this.ofOnly = name;
    this.toTop();
    this.requestUpdate();
  }
  private find(text: string): void {
    this.search = text;
    this.toTop();
  }
  private toTop(): void {
    this.active = this.top = 0;
    this.scroller.scrollTop = 0;
  }

  private sortBy(column: number): void {
    this.order = { column, isDescending: this.order.column === column && !this.order.isDescending };
    this.toTop();
  }

  private addColumn(choice: HTMLSelectElement): void {
    const name = choice.value;
    choice.value = "";
    if (name) void this.load([name]);
  }

  private removeColumn(key: string): void {
    this.order = { column: -1, isDescending: false };
    this.added = this.added.filter((column) => column.key !== key);
  }

  private close(): void {
    this.dispatchEvent(new Event("svt-close-table", { bubbles: true, composed: true }));
  }
}
customElements.define("svt-table", ObjectTable);

/** A number with the digits that it has. */
function cellText(cell: Cell): string {
  if (typeof cell !== "number") return cell ?? "";
  return cell.toLocaleString(language(), { maximumFractionDigits: kDigits });
}
