/**
 * The parts of the building: as a tree and by class, with search and query. Only visible rows are in the DOM,
 * so that 100,000 features cost no more than 30.
 */

import { css, html, nothing, unsafeCSS } from "lit";
import { repeat } from "lit/directives/repeat.js";
import type { EngineError } from "../engine";
import type { CitySearch } from "../city/city_search";
import type { CityStream } from "../city/city_stream";
import { coverText } from "../city/cover";
import { ancestors, isGroupOfParts, labelOf } from "../state/feature_index";
import { areSpacesShown, showAll, showSpaces } from "../shown_spaces";
import { classText } from "../state/class_words";
import { ofClass, ofId, ofSubtree } from "../state/queries";
import { spacesOf } from "../state/spaces";
import { SeenCounts, subtree, type Seen } from "../state/visibility";
import { t } from "../texts";
import { toolText } from "../tool_texts";
import { shownText } from "./shown_text";
import { icon } from "../ui/icons";
import { controls, Part } from "../ui/part";
import { eyeOf } from "./eye";
import { kindOf } from "./feature_path";
import { askForMenu, isMenuKey } from "./menu_request";
import { firstOpen, rowsOf, type Rows } from "./tree_rows";

/** Height of a row in pixels: the width of a finger on touch screens. */
const kRow = matchMedia("(max-width: 759px), (pointer: coarse)").matches ? 44 : 30;
const kSpare = 6;
/** Milliseconds until a touch is a long press. */
const kLongPress = 550;
/** Milliseconds after the last key. */
const kAttributesAfter = 150;

export class TreePanel extends Part {
  static override properties = {
    ...Part.properties,
    tab: { state: true },
    search: { state: true },
    query: { state: true },
    answer: { state: true },
    error: { state: true },
    byAttribute: { state: true },
    active: { state: true },
    edited: { state: true },
    top: { state: true },
    listHeight: { state: true },
  };
  declare tab: "structure" | "classes";
  declare search: string;
  declare query: string;
  declare answer: string;
  declare error: string;
  /** Features that the search finds by their attributes; these results arrive slightly later. */
  declare byAttribute: ReadonlySet<number>;
  private attributeTimer = 0;
  /** Feature with keyboard focus. */
  declare active: number;
  /** The feature from which Shift selects a range of rows. */
  private anchor = 0;
  /** Query whose style is edited below the list. */
  declare edited: { query: string; label: string; color: string; opacity: number } | null;
  declare top: number;
  declare listHeight: number;
  private open = new Set<number>();
  private seenIndex: unknown = null;
  private seenCity: unknown = null;
  private seenSelection: unknown = null;
  private seenHidden: unknown = null;
  private counts!: SeenCounts;
  /** Rooms and other spaces with voxels. */
  private spaces: readonly number[] = [];
  private rows: Rows = { shown: [], matches: null, isOpen: () => false };
  private readonly watched = new ResizeObserver(([entry]) => (this.listHeight = entry?.contentRect.height ?? 0));

  static override styles = [
    controls,
    css`
      :host { display: flex; flex-direction: column; height: 100%; min-height: 0; font-size: 13px; container-type: size; }
      header { padding: 10px 10px 8px; display: grid; gap: 8px; }
      .segments { margin-right: var(--sheet-close, 0); }
      form { display: grid; grid-template-columns: 1fr auto; gap: 6px; }
      .field { position: relative; }
      .field svg { position: absolute; left: 9px; top: 8px; color: var(--quiet); pointer-events: none; }
      .field input { padding-left: 32px; }
      #query { font-family: var(--mono); font-size: 12px; }
      .list { flex: 1; min-height: 0; overflow: auto; position: relative; border-top: 1px solid var(--line); overscroll-behavior: contain; outline-offset: -2px !important; }
      .space { position: relative; }
      .item {
        position: absolute; left: 0; right: 0; height: ${unsafeCSS(`${kRow}px`)}; display: flex; align-items: center; gap: 4px; padding-right: 6px; cursor: default; user-select: none;
      }
      .item:hover { background: var(--hover); }
      .item.selected { background: var(--accent-soft); color: var(--accent-text); }
      .list:focus-visible .item.active { box-shadow: inset 0 0 0 2px var(--focus); }
      .item button { min-height: 26px; min-width: 26px; padding: 2px; border-radius: 6px; flex: none; }
      @media (max-width: 759px), (pointer: coarse) { .field svg { top: 14px; } .item { gap: 0; } .kind { padding-right: 5px; } .item button { min-height: 44px; min-width: 44px; } }
      .twist { color: var(--quiet); }
      .kind { flex: none; display: flex; color: var(--quiet); }
      .selected .kind { color: inherit; }
      .name { flex: 1; min-width: 0; overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
      .name .quiet { font-size: 12px; margin-left: 6px; }
      .item.selected .quiet { color: inherit; }
      .gone .name { color: var(--quiet); text-decoration: line-through; }
      .swatch { width: 14px; height: 14px; border-radius: 4px; border: 1px solid #0003; }
      .count { font-size: 12px; color: var(--quiet); font-variant-numeric: tabular-nums; padding-right: 4px; }
      .eye { color: var(--quiet); }
      .eye.none { color: var(--text); }
      footer { padding: 8px 10px; border-top: 1px solid var(--line); display: grid; gap: 6px; }
      .note { display: flex; gap: 8px; align-items: center; justify-content: space-between; }
      /* Above a tool and the selection, the list comes first. */
      @container (max-height: 300px) { footer { display: none; } }
    `,
  ];

  constructor() {
    super();
    this.tab = "structure";
    this.search = this.query = this.answer = this.error = "";
    this.byAttribute = new Set();
    this.active = 0;
    this.edited = null;
    this.top = 0;
    this.listHeight = 400;
  }

  override disconnectedCallback(): void {
    this.watched.disconnect();
    super.disconnectedCallback();
  }

  override willUpdate(): void {
    const { volume, view, model } = this.session;
    const { index } = volume;
    const { now, hidden } = view;
    if (this.seenHidden !== hidden || this.seenIndex !== index) {
      this.seenHidden = hidden;
      this.counts = new SeenCounts(index, hidden);
    }
    if (this.seenIndex !== index) {
      this.seenIndex = index;
      this.spaces = spacesOf(index);
      // Other tiles of a city: the search stays.
      const isSameCity = model.city !== null && this.seenCity === model.city;
      this.seenCity = model.city;
      this.open = firstOpen(index);
      if (!isSameCity) this.search = this.answer = this.error = "";
      this.byAttribute = new Set();
      this.edited = null;
      this.active = this.top = this.anchor = 0;
    }
    if (this.seenSelection !== now.selection) {
      this.seenSelection = now.selection;
      const last = index.byId.get(now.selection.at(-1) ?? "");
      if (last !== undefined) {
        for (const above of ancestors(index, last)) this.open.add(above);
        this.active = last;
        if (now.selection.length === 1) this.anchor = last;
      }
    }
    this.rows = rowsOf(index, this.open, this.search, this.byAttribute);
  }

  override updated(changed: Map<string, unknown>): void {
    const list = this.renderRoot.querySelector<HTMLElement>(".list");
    if (list && (changed.has("tab") || !changed.size)) {
      this.watched.disconnect();
      this.watched.observe(list);
    }
    this.renderRoot.querySelectorAll<HTMLElement>("[data-top]").forEach((e) => {
      e.style.transform = `translateY(${e.dataset["top"]}px)`;
      e.style.paddingLeft = `${4 + Number(e.dataset["depth"]) * 14}px`;
    });
    const space = this.renderRoot.querySelector<HTMLElement>(".space");
    if (space) space.style.height = `${this.rows.shown.length * kRow}px`;
    this.renderRoot.querySelectorAll<HTMLElement>("[data-color]").forEach((e) => (e.style.background = e.dataset["color"]!));
    if (changed.has("active") || this.lastSeen !== this.seenSelection) this.scrollToActive();
    this.lastSeen = this.seenSelection;
  }
  private lastSeen: unknown = null;

  focusSearch(): void {
    const field = this.renderRoot.querySelector<HTMLInputElement>("#search");
    field?.focus();
    field?.select();
  }

  override render() {
    const { session } = this;
    const cover = coverText(session);
    const spaces = this.spaces.length;
    const hidden = this.counts.hiddenSolids - this.counts.hiddenOf(this.spaces);
    return html`
      <header>
        <div class="segments" role="tablist" aria-label=${t("panelTree")} @keydown=${this.tabKey}>
          ${(["structure", "classes"] as const).map(
            (tab) =>
              html`<button role="tab" id="tab-${tab}" aria-controls="panel" tabindex=${this.tab === tab ? 0 : -1} aria-selected=${this.tab === tab} @click=${() => (this.tab = tab)}>${t(tab)}</button>`,
          )}
        </div>
        ${
          this.tab === "structure"
            ? html`<div class="field">${icon("search", 16)}
              <input id="search" type="search" autocomplete="off" spellcheck="false" aria-label=${t("search")} placeholder=${t("search")}
                .value=${this.search} @input=${(e: Event) => this.find((e.target as HTMLInputElement).value)} @keydown=${this.searchKey} />
            </div>`
            : nothing
        }
        ${cover ? html`<div class="small quiet" id="cover">${cover}</div>` : nothing}
        ${
          this.search && this.tab === "structure"
            ? html`<div class="small quiet" role="status">${this.rows.matches ? t("found", { n: this.rows.matches }) : session.model.city ? nothing : t("nothingFound")}</div>
              ${this.citySearch()}`
            : nothing
        }
      </header>
      <div id="panel" class="list" role="tabpanel" aria-labelledby="tab-${this.tab}" tabindex="-1" @scroll=${this.scrolled}>
        ${this.tab === "structure" ? this.tree() : this.groups()}
      </div>
      <footer>
        ${this.edited ? this.editor(this.edited) : nothing}
        ${
          session.view.now.show.length
            ? html`<div class="note small" id="shown"><span>${t("filterNote", { name: shownText(session.volume.index, session.view.now.show, session.view.answers.of) })}</span>
              <button class="small" @click=${() => session.view.showOthers()}>${t("showAll")}</button></div>`
            : nothing
        }
        ${
          hidden
            ? html`<div class="note small"><span>${t("hiddenCount", { n: hidden })}</span>
              <button class="small" @click=${() => showAll(session)}>${t("showAll")}</button></div>`
            : nothing
        }
        ${
          spaces
            ? html`<label class="check small"><input type="checkbox" id="spaces" .checked=${areSpacesShown(session)}
              @change=${(e: Event) => showSpaces(session, (e.target as HTMLInputElement).checked)} />${toolText("spaces", { n: spaces })}</label>`
            : nothing
        }
        <form @submit=${this.ask}>
          <input id="query" autocomplete="off" autocapitalize="off" spellcheck="false" aria-label=${t("queryLabel")} placeholder=${t("queryPlaceholder")}
            aria-invalid=${this.error ? "true" : "false"} aria-describedby="query-answer" .value=${this.query}
            @input=${(e: Event) => (this.query = (e.target as HTMLInputElement).value)} />
          <button type="submit">${t("select")}</button>
        </form>
        <div id="query-answer" role="status" class=${this.error ? "error" : "small quiet"}>${this.error || this.answer}</div>
      </footer>
    `;
  }

  /** Buildings of the whole city, of which the tree has only the visible tiles. */
  private citySearch() {
    if (!this.session.model.city || this.search.trim().length < 2) return nothing;
    void import("../city/city_search");
    return html`<svt-city-search .session=${this.session} .words=${this.search}></svt-city-search>`;
  }

  private tree() {
    const { session } = this;
    const { shown } = this.rows;
    const from = Math.max(0, Math.floor(this.top / kRow) - kSpare);
    const to = Math.min(shown.length, Math.ceil((this.top + this.listHeight) / kRow) + kSpare);
    if (!shown.length) return nothing;
    const selected = new Set(session.view.now.selection);
    const rows = shown.slice(from, to);
    return html`<div class="space" role="tree" tabindex="0" aria-label=${t("structure")} aria-multiselectable="true"
      aria-activedescendant=${rows.includes(this.active) ? `row-${this.active}` : nothing} @keydown=${this.treeKey}>
      ${repeat(
        rows,
        (i) => i,
        (i, n) => this.item(i, from + n, selected),
      )}
    </div>`;
  }

  private item(i: number, row: number, selected: ReadonlySet<string>) {
    const { index } = this.session.volume;
    const { styles } = this.session.view.now;
    const feature = index.features[i]!;
    const isParent = index.end[i]! > i + 1;
    const seen = this.counts.ofSubtree(i);
    const isSelected = selected.has(feature.id);
    const color =
      styles.find((s) => s.select === this.queryOf(i) && s.color)?.color ??
      styles.find((s) => s.select === ofClass(feature.class) && s.color)?.color ??
      feature.color;
    return html`<div id="row-${i}" role="treeitem" class="item ${isSelected ? "selected" : ""} ${this.active === i ? "active" : ""} ${seen === "none" ? "gone" : ""}"
      data-top=${row * kRow} data-depth=${index.depth[i]!} aria-level=${index.depth[i]! + 1} aria-posinset=${row + 1} aria-setsize=${this.rows.shown.length}
      aria-selected=${isSelected} aria-expanded=${isParent ? String(this.rows.isOpen(i)) : nothing}
      @click=${(e: MouseEvent) => this.picked(i, e)} @contextmenu=${(e: MouseEvent) => this.menuAt(i, e)} @pointerdown=${(e: PointerEvent) => this.pressed(i, e)} @dblclick=${() => void this.session.view.goTo(ofSubtree(feature.id), null)}>
      ${
        isParent
          ? html`<button class="bare twist" tabindex="-1" aria-hidden="true" @click=${(e: Event) => this.toggle(i, e)}>${icon(this.rows.isOpen(i) ? "down" : "right", 14)}</button>`
          : html`<span class="twist"><svg width="26" height="1" aria-hidden="true"></svg></span>`
      }
      ${
        feature.count > 0
          ? html`<button class="bare" tabindex="-1" aria-hidden="true" title=${t("styleOf", { name: labelOf(feature) })} @click=${(e: Event) => this.edit(i, e)}><span class="swatch" data-color=${color}></span></button>`
          : nothing
      }
      <span class="kind">${icon(kindOf(feature), 14)}</span>
      <span class="name" title="${labelOf(feature)} · ${feature.type || feature.class}">${labelOf(feature)} <span class="quiet">${classText(feature.type || feature.class)}</span></span>
      ${isParent ? html`<span class="count">${this.counts.solidsOf(i)}</span>` : nothing}
      ${seen === "none" ? html`<span class="visually-hidden">${t("isHidden")}</span>` : nothing}
      <button class="bare eye ${seen}" tabindex="-1" aria-hidden="true" title=${seen === "none" ? t("show") : t("hide")} @click=${(e: Event) => this.see(i, seen, e)}>${eyeOf(seen)}</button>
    </div>`;
  }

  private editor(edited: NonNullable<typeof this.edited>) {
    return html`<div class="note"><strong class="small">${edited.label}</strong>
        <button class="bare" aria-label=${t("close")} @click=${() => (this.edited = null)}>${icon("close", 16)}</button></div>
      <svt-style-editor .session=${this.session} .query=${edited.query} .label=${edited.label} .color=${edited.color} .opacity=${edited.opacity}></svt-style-editor>`;
  }

  private find(text: string): void {
    this.search = text;
    this.byAttribute = new Set();
    clearTimeout(this.attributeTimer);
    if (text.trim().length > 1) this.attributeTimer = window.setTimeout(() => void this.findInAttributes(text), kAttributesAfter);
    this.top = 0;
    this.renderRoot.querySelector(".list")?.scrollTo(0, 0);
  }

  private async findInAttributes(text: string): Promise<void> {
    const ids = await this.session.volume.engine?.findInAttributes(text).catch(() => []);
    if (this.search !== text || !ids?.length) return;
    const { byId } = this.session.volume.index;
    this.byAttribute = new Set(ids.map((id) => byId.get(id)!));
  }

  /** With Shift, all rows from the last one that was selected without Shift. */
  private picked(i: number, event: MouseEvent | KeyboardEvent): void {
    const isAdded = event.ctrlKey || event.metaKey || this.session.selection.isMore;
    this.active = i;
    if (event.shiftKey) return this.pickRange(i, isAdded);
    this.anchor = i;
    this.session.selection.select([this.session.volume.index.features[i]!.id], isAdded);
  }

  private pickRange(i: number, isAdded: boolean): void {
    const { shown } = this.rows;
    const { view, selection, volume } = this.session;
    const [from, to] = [Math.max(0, shown.indexOf(this.anchor)), shown.indexOf(i)];
    const ids = shown.slice(Math.min(from, to), Math.max(from, to) + 1).map((at) => volume.index.features[at]!.id);
    selection.select(isAdded ? [...new Set([...view.state.selection, ...ids])] : ids);
    // The last selected feature becomes active; here it is the row that was picked.
    this.seenSelection = view.state.selection;
  }

  /** Selects a row, unless it is selected already, and asks for its menu. */
  private menuAt(
    i: number,
    event: Event & { clientX?: number; clientY?: number },
    at = { x: event.clientX ?? 0, y: event.clientY ?? 0 },
  ): void {
    event.preventDefault();
    const { id } = this.session.volume.index.features[i]!;
    this.active = i;
    if (!this.session.view.state.selection.includes(id)) this.session.selection.select([id]);
    askForMenu(this, at);
  }

  /** Touch: a long press asks for the menu. */
  private pressed(i: number, event: PointerEvent): void {
    if (event.pointerType !== "touch") return;
    const row = event.currentTarget as HTMLElement;
    const timer = setTimeout(() => this.menuAt(i, event), kLongPress);
    const end = () => clearTimeout(timer);
    for (const kind of ["pointerup", "pointercancel", "pointermove", "contextmenu"]) row.addEventListener(kind, end, { once: true });
  }

  private toggle(i: number, event?: Event): void {
    event?.stopPropagation();
    if (this.open.has(i)) this.open.delete(i);
    else this.open.add(i);
    this.requestUpdate();
  }

  private see(i: number, seen: Seen, event?: Event): void {
    event?.stopPropagation();
    this.session.view.hide(subtree(this.session.volume.index, i), seen !== "none");
  }

  private edit(i: number, event?: Event): void {
    event?.stopPropagation();
    const feature = this.session.volume.index.features[i]!;
    this.editQuery(this.queryOf(i), labelOf(feature), i);
  }

  /** The query of styles of a row: of a group, also its members. */
  private queryOf(i: number): string {
    const { index } = this.session.volume;
    const { id } = index.features[i]!;
    return isGroupOfParts(index, i) ? ofSubtree(id) : ofId(id);
  }

  private groups() {
    void import("./feature_groups").catch((error: unknown) => this.session.messages.fail(error));
    return html`<svt-groups .session=${this.session} .counts=${this.counts} .edited=${this.edited?.query ?? ""} @svt-edit=${this.editGroup}></svt-groups>`;
  }

  private readonly editGroup = ({ detail: { query, name, like } }: CustomEvent<{ query: string; name: string; like: number[] }>): void => {
    const { features } = this.session.volume.index;
    this.editQuery(
      query,
      name,
      like.find((i) => features[i]!.count > 0)!,
    );
  };

  private editQuery(query: string, label: string, like: number): void {
    const { color, opacity } = this.session.volume.index.features[like]!;
    this.edited = this.edited?.query === query ? null : { query, label, color, opacity };
  }

  private readonly ask = async (event: Event): Promise<void> => {
    event.preventDefault();
    this.error = this.answer = "";
    const query = this.query.trim();
    if (!query || !this.session.volume.engine) return;
    try {
      const ids = await this.session.volume.engine.select(query);
      this.session.selection.select(ids, false, query);
      const cover = coverText(this.session);
      this.answer = t("selectedByQuery", { n: ids.length }) + (cover ? `. ${cover}` : "");
    } catch (error) {
      this.error = (error as EngineError).message;
    }
  };

  private readonly scrolled = (event: Event): void => {
    this.top = (event.target as HTMLElement).scrollTop;
  };

  private scrollToActive(): void {
    const list = this.renderRoot.querySelector<HTMLElement>(".list");
    const row = this.rows.shown.indexOf(this.active);
    if (!list || row < 0 || this.tab !== "structure") return;
    const top = row * kRow;
    if (top < list.scrollTop) list.scrollTop = top;
    else if (top + kRow > list.scrollTop + list.clientHeight) list.scrollTop = top + kRow - list.clientHeight;
  }

  private readonly tabKey = (event: KeyboardEvent): void => {
    if (event.key !== "ArrowLeft" && event.key !== "ArrowRight") return;
    this.tab = this.tab === "structure" ? "classes" : "structure";
    void this.updateComplete.then(() => this.renderRoot.querySelector<HTMLElement>(`#tab-${this.tab}`)?.focus());
  };

  /** Goes to the first building with the words; without one, to that with the id. */
  private async findInCity(city: CityStream): Promise<void> {
    const { search } = this;
    await import("../city/city_search");
    const hits = this.renderRoot.querySelector<CitySearch>("svt-city-search");
    const isFound = (await hits?.goToFirst()) ?? false;
    if (!isFound && this.search === search) void city.find(search.trim());
  }

  private readonly searchKey = (event: KeyboardEvent): void => {
    if (event.key !== "ArrowDown" && event.key !== "Enter") return;
    const { index } = this.session.volume;
    const { city } = this.session.model;
    if (city && event.key === "Enter" && !this.rows.matches) return void this.findInCity(city);
    const words = this.search.toLowerCase();
    const first =
      this.rows.shown.find((i) => `${labelOf(index.features[i]!)} ${index.features[i]!.class}`.toLowerCase().includes(words)) ??
      this.rows.shown[0];
    if (first === undefined) return;
    event.preventDefault();
    this.active = first;
    if (event.key === "Enter") this.picked(first, event);
    this.renderRoot.querySelector<HTMLElement>("[role=tree]")?.focus();
  };

  private readonly treeKey = (event: KeyboardEvent): void => {
    const { shown } = this.rows;
    const { index } = this.session.volume;
    const at = Math.max(0, shown.indexOf(this.active));
    const i = shown[at]!;
    if (isMenuKey(event)) {
      const row = this.renderRoot.querySelector(`#row-${i}`)?.getBoundingClientRect() ?? this.getBoundingClientRect();
      event.stopPropagation();
      return this.menuAt(i, event, { x: row.left + 40, y: row.bottom });
    }
    const isParent = index.end[i]! > i + 1;
    const go = (row: number) => (this.active = shown[Math.min(shown.length - 1, Math.max(0, row))]!);
    const page = Math.max(1, Math.floor(this.listHeight / kRow) - 1);
    if (event.shiftKey && (event.key === "ArrowDown" || event.key === "ArrowUp")) {
      event.preventDefault();
      event.stopPropagation();
      const next = at + (event.key === "ArrowDown" ? 1 : -1);
      return shown[next] === undefined ? undefined : this.picked(shown[next], event);
    }
    const actions: Record<string, () => void> = {
      ArrowDown: () => go(at + 1),
      ArrowUp: () => go(at - 1),
      Home: () => go(0),
      End: () => go(shown.length - 1),
      PageDown: () => go(at + page),
      PageUp: () => go(at - page),
      ArrowRight: () => (isParent && !this.rows.isOpen(i) ? this.toggle(i) : go(at + (isParent ? 1 : 0))),
      ArrowLeft: () => (isParent && this.open.has(i) ? this.toggle(i) : index.parent[i]! >= 0 && (this.active = index.parent[i]!)),
      Enter: () => this.picked(i, event),
      " ": () => this.see(i, this.counts.ofSubtree(i)),
      c: () => this.edit(i),
    };
    const action = actions[event.key];
    if (!action || event.altKey || (event.ctrlKey && event.key !== "Enter")) return;
    event.preventDefault();
    event.stopPropagation();
    action();
  };
}
customElements.define("svt-tree", TreePanel);
