/** Bookmarks: a list with pictures, names, comments and status, which can be walked through, ordered, and passed on as a file. */

import { css, html, nothing } from "lit";
import {
  type Bookmark,
  bookmarkFile,
  bookmarksOfFile,
  dataUrl,
  kSmallPicture,
  kStatuses,
  loadBookmarks,
  movedUp,
  pretty,
  saveBookmarks,
} from "../state/bookmarks";
import type { BcfModel } from "../state/bcf";
import type { ViewState } from "../state/view_state";
import { dateText, t } from "../texts";
import { toolText, type ToolTextKey } from "../tool_texts";
import { save } from "../ui/files";
import { icon } from "../ui/icons";
import { controls, Part } from "../ui/part";

/** Pixels of the pictures in BCF. */
const kSnapshot: [number, number] = [1280, 720];
const kAuthorKey = "svt-author";
const kStatusTexts: Record<string, ToolTextKey> = { Open: "statusOpen", "In Progress": "statusInProgress", Closed: "statusClosed" };

export class BookmarkList extends Part {
  static override properties = {
    ...Part.properties,
    size: { attribute: false },
    views: { state: true },
    at: { state: true },
    edited: { state: true },
    isWorking: { state: true },
  };
  /** Size of the pictures in exported scenes. */
  declare size: [number, number];
  declare views: Bookmark[];
  /** The bookmark of the walk; -1: none yet. */
  declare at: number;
  /** The bookmark whose comment is open; -1: none. */
  declare edited: number;
  declare isWorking: boolean;
  private viewsOf = "";

  static override styles = [
    controls,
    css`
    h3 { margin-top: 0; }
    ul { list-style: none; margin: 0; padding: 0; }
    li { display: grid; grid-template-columns: 56px minmax(0, 1fr) auto auto auto auto; gap: 2px; align-items: center; min-height: 44px; border-radius: 8px; }
    li[aria-current="true"] { background: var(--accent-soft); }
    li button.bare { min-width: 28px; }
    .details { grid-column: 1 / -1; display: grid; grid-template-columns: 1fr 1fr; gap: 6px; padding: 4px 0 10px; }
    .details textarea { font: inherit; grid-column: 1 / -1; height: 62px; resize: vertical; }
    .details label { display: grid; gap: 2px; color: var(--quiet); font-size: 12px; }
    .details label :is(input, select) { color: var(--text); }
    .details .wide { grid-column: 1 / -1; }
    .walk { display: flex; align-items: center; gap: 6px; margin-bottom: 6px; }
    .walk output { flex: 1; text-align: center; font-size: 12px; font-variant-numeric: tabular-nums; overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
    @media (max-width: 759px), (pointer: coarse) { li { grid-template-columns: 56px minmax(0, 1fr) repeat(4, 44px); } }
    .go { padding: 0; width: 56px; height: 35px; min-height: 0; overflow: hidden; }
    .go img { width: 100%; height: 100%; object-fit: cover; display: block; }
    li > input[type="text"] { border-color: transparent; background: transparent; padding: 4px; min-width: 0; width: 100%; }
    li > input[type="text"]:hover, li > input[type="text"]:focus { border-color: var(--line); }
    .row { margin-top: 6px; }
  `,
  ];

  constructor() {
    super();
    this.views = [];
    this.at = this.edited = -1;
    this.isWorking = false;
  }

  override willUpdate(): void {
    if (this.viewsOf === this.session.volume.file) return;
    this.at = this.edited = -1;
    this.viewsOf = this.session.volume.file;
    this.views = loadBookmarks(this.viewsOf);
  }

  override render() {
    return html`
      <h3>${toolText("bookmarks")}</h3>
      ${this.views.length > 1 ? this.walk() : nothing}
      <ul>${this.views.map((view, n) => this.view(view, n))}</ul>
      <div class="row">
        <button id="keep-view" @click=${() => void this.keep()}>${icon("bookmark", 16)}${t("keepView")}</button>
        <button class="bare" id="import-views" aria-label=${t("bookmarksImport")} title=${t("bookmarksImport")} @click=${() => this.renderRoot.querySelector<HTMLInputElement>("#views-file")!.click()}>${icon("open", 16)}</button>
        <button class="bare" id="export-views" ?disabled=${!this.views.length} aria-label=${t("bookmarksExport")} title=${t("bookmarksExport")}
          @click=${() => save(bookmarkFile(this.viewsOf, this.views), "views.json")}>${icon("share", 16)}</button>
        <button id="export-bcf" ?disabled=${!this.views.length || this.isWorking} aria-label=${t("bcfExport")} title=${t("bcfExport")} @click=${() => void this.exportBcf()}>BCF</button>
        <input type="file" id="views-file" hidden accept=".json,.bcf,.bcfzip" aria-label=${t("bookmarksImport")} @change=${(e: Event) => void this.add(e.target as HTMLInputElement)} />
      </div>
    `;
  }

  override focus(): void {
    this.renderRoot.querySelector<HTMLElement>("#keep-view")?.focus();
  }

  /** Steps through the views in their order. */
  private walk() {
    const { views, at } = this;
    const step = (by: number) => this.go((Math.max(at, by > 0 ? -1 : 0) + by + views.length) % views.length);
    return html`<div class="walk" role="group" aria-label=${toolText("walkThrough")}>
      <button id="previous-view" aria-label=${toolText("previousView")} title=${toolText("previousView")} @click=${() => step(-1)}>${icon("previous", 16)}</button>
      <output>${at < 0 ? toolText("walkThrough") : toolText("viewOf", { n: at + 1, all: views.length, name: views[at]?.name ?? "" })}</output>
      <button id="next-view" aria-label=${toolText("nextView")} title=${toolText("nextView")} @click=${() => step(1)}>${icon("right", 16)}</button></div>`;
  }

  private view(view: Bookmark, n: number) {
    const { name, state, picture, date } = view;
    const isEdited = this.edited === n;
    const text = toolText("viewDetails", { name });
    return html`<li aria-current=${this.at === n}>
      <button class="go" aria-label=${name} title=${name} @click=${() => this.go(n)}>${picture ? html`<img src=${picture} alt="" />` : icon("view", 18)}</button>
      <input type="text" autocomplete="off" spellcheck="false" aria-label=${toolText("bookmarkRename")} title=${date ? dateText(date) : nothing} .value=${name} @change=${(e: Event) => this.rename(n, e.target as HTMLInputElement)} />
      <button class="bare details-of" aria-label=${text} title=${text} aria-expanded=${isEdited} @click=${() => (this.edited = isEdited ? -1 : n)}>${icon("info", 16)}</button>
      ${n > 0 ? this.button("up", toolText("bookmarkUp", { name }), () => this.store(movedUp(this.views, n))) : html`<span>${nothing}</span>`}
      ${this.button("code", toolText("bookmarkExport", { name }), () => void this.exportScene(name, state))}
      ${this.button("bin", toolText("bookmarkRemove", { name }), () => this.drop(n))}
      ${isEdited ? this.details(view, n) : nothing}
    </li>`;
  }

  private details({ comment = "", author = "", status = kStatuses[0], date }: Bookmark, n: number) {
    const change = (key: "comment" | "author" | "status") => (e: Event) => this.change(n, key, (e.target as HTMLInputElement).value.trim());
    const statuses = [...new Set([...kStatuses, status])];
    return html`<div class="details">
      <textarea aria-label=${toolText("comment")} placeholder=${toolText("comment")} .value=${comment} @input=${change("comment")}></textarea>
      <label>${toolText("author")}<input type="text" autocomplete="name" .value=${author} @change=${change("author")} /></label>
      <label>${toolText("status")}<select @change=${change("status")}>${statuses.map(
        (value) =>
          html`<option value=${value} ?selected=${value === status}>${value in kStatusTexts ? toolText(kStatusTexts[value]!) : value}</option>`,
      )}</select></label>
      ${date ? html`<span class="small quiet wide">${dateText(date)}</span>` : nothing}</div>`;
  }

  private change(n: number, key: "comment" | "author" | "status", value: string): void {
    if (key === "author") remember(value);
    this.store(
      this.views.map((view, i) => {
        if (i !== n) return view;
        const changed = { ...view, [key]: value };
        if (!value) delete changed[key];
        return changed;
      }),
    );
  }

  private drop(n: number): void {
    this.at = this.edited = -1;
    this.store(this.views.filter((_, i) => i !== n));
  }

  private button(name: "up" | "code" | "bin", text: string, act: () => void) {
    return html`<button class="bare" aria-label=${text} title=${text} @click=${act}>${icon(name, 16)}</button>`;
  }

  private go(n: number): void {
    const { camera, ...rest } = this.views[n]!.state;
    const { view, messages } = this.session;
    this.at = n;
    view.history.seal();
    view.set(rest);
    if (camera) view.moveTo(camera);
    messages.say(toolText("viewOf", { n: n + 1, all: this.views.length, name: this.views[n]!.name }));
  }

  private async keep(): Promise<void> {
    const { state } = this.session.view;
    const picture = await this.pictureOf(state, kSmallPicture);
    const author = remembered();
    this.store([
      ...this.views,
      {
        name: toolText("bookmarkName", { n: this.views.length + 1 }),
        state,
        date: new Date().toISOString().slice(0, 10),
        ...(picture ? { picture: dataUrl(picture) } : {}),
        ...(author ? { author } : {}),
      },
    ]);
  }

  private rename(n: number, input: HTMLInputElement): void {
    const name = input.value.trim();
    if (!name) input.value = this.views[n]!.name;
    else this.store(this.views.map((view, i) => (i === n ? { ...view, name } : view)));
  }

  /** A view as PNG; null if it cannot be drawn. */
  private async pictureOf(state: ViewState, size: [number, number]): Promise<Uint8Array | null> {
    const { view, volume } = this.session;
    try {
      return new Uint8Array(await volume.engine!.picture(await view.composed(size, 1, state)));
    } catch {
      return null;
    }
  }

  private async add(input: HTMLInputElement): Promise<void> {
    const file = input.files?.[0];
    input.value = "";
    if (!file) return;
    const { session } = this;
    if (/\.bcf(zip)?$/i.test(file.name)) return this.addBcf(file);
    const views = bookmarksOfFile(await file.text());
    if (!views?.length) return session.messages.tell(toolText("noViews", { name: file.name }));
    this.store([...this.views, ...views]);
    session.messages.tell(toolText("bookmarksAdded", { n: views.length }));
  }

  private async addBcf(file: File): Promise<void> {
    const { session } = this;
    const model = this.bcfModel();
    if (!model) return;
    try {
      const { viewsOfBcf } = await import("../state/bcf");
      const { views, missing } = await viewsOfBcf(await file.arrayBuffer(), model);
      if (!views.length) return session.messages.tell(toolText("noViews", { name: file.name }));
      this.store([...this.views, ...views]);
      session.messages.tell(
        [toolText("bookmarksAdded", { n: views.length }), ...(missing ? [toolText("bcfMissing", { n: missing })] : [])].join(". "),
      );
    } catch (error) {
      session.messages.fail({ message: toolText("notBcf", { name: file.name, error: (error as Error).message ?? String(error) }) });
    }
  }

  private bcfModel(): BcfModel | null {
    const { engine, info, index, box, file } = this.session.volume;
    return engine && info && { engine, info, index, box, aspect: this.session.view.aspect, file };
  }

  private async exportBcf(): Promise<void> {
    const model = this.bcfModel();
    if (!model) return;
    this.isWorking = true;
    try {
      const snapshot = (state: ViewState) => this.pictureOf(state, kSnapshot);
      const { bcfOf } = await import("../state/bcf");
      save(await bcfOf(this.views, model, remembered() || "SVT", new Date(), snapshot), "views.bcf");
    } catch (error) {
      this.session.messages.fail(error);
    }
    this.isWorking = false;
  }

  private store(views: Bookmark[]): void {
    this.views = views;
    if (!saveBookmarks(this.viewsOf, views)) this.session.messages.tell(t("notKept"));
  }

  private async exportScene(name: string, state: ViewState): Promise<void> {
    const { session } = this;
    try {
      save(pretty(await session.view.composed(this.size, undefined, state)), `${name.replace(/[^\p{L}\p{N}_-]+/gu, "_")}.scene.json`);
    } catch (error) {
      session.messages.fail(error);
    }
  }
}
customElements.define("svt-bookmark-list", BookmarkList);

/** The author of the last comment in this browser. */
function remembered(): string {
  try {
    return localStorage.getItem(kAuthorKey) ?? "";
  } catch {
    return "";
  }
}

function remember(author: string): void {
  try {
    localStorage.setItem(kAuthorKey, author);
  } catch {
    // The next bookmark then has no author.
  }
}
