/** Bookmarks: a list with pictures and names, which can be changed, ordered, and passed on as a file. */

import { css, html, nothing } from "lit";
import { bookmarkFile, bookmarksOfFile, loadBookmarks, movedUp, pretty, saveBookmarks, type Bookmark } from "../state/bookmarks";
import { bcfOf, viewsOfBcf, type BcfModel } from "../state/bcf";
import { sceneOf } from "../state/scene_of";
import type { ViewState } from "../state/view_state";
import { dateText, t } from "../texts";
import { save } from "../ui/files";
import { icon } from "../ui/icons";
import { controls, Part } from "../ui/part";

/** Pixels of a small picture. */
const kPicture: [number, number] = [112, 70];

export class BookmarkList extends Part {
  static override properties = { ...Part.properties, size: { attribute: false }, views: { state: true } };
  /** Size of the pictures in exported scenes. */
  declare size: [number, number];
  declare views: Bookmark[];
  private viewsOf = "";

  static override styles = [
    controls,
    css`
    h3 { margin-top: 0; }
    ul { list-style: none; margin: 0; padding: 0; }
    li { display: grid; grid-template-columns: 56px minmax(0, 1fr) auto auto auto; gap: 4px; align-items: center; min-height: 44px; }
    .go { padding: 0; width: 56px; height: 35px; min-height: 0; overflow: hidden; }
    .go img { width: 100%; height: 100%; object-fit: cover; display: block; }
    input[type="text"] { border-color: transparent; background: transparent; padding: 4px; min-width: 0; width: 100%; }
    input[type="text"]:hover, input[type="text"]:focus { border-color: var(--line); }
    .row { margin-top: 6px; }
  `,
  ];

  constructor() {
    super();
    this.views = [];
  }

  override willUpdate(): void {
    if (this.viewsOf === this.session.volume.file) return;
    this.viewsOf = this.session.volume.file;
    this.views = loadBookmarks(this.viewsOf);
  }

  override render() {
    return html`
      <h3>${t("bookmarks")}</h3>
      <ul>${this.views.map((view, n) => this.view(view, n))}</ul>
      <div class="row">
        <button id="keep-view" @click=${() => void this.keep()}>${icon("bookmark", 16)}${t("keepView")}</button>
        <button class="bare" id="import-views" aria-label=${t("bookmarksImport")} title=${t("bookmarksImport")} @click=${() => this.renderRoot.querySelector<HTMLInputElement>("#views-file")!.click()}>${icon("open", 16)}</button>
        <button class="bare" id="export-views" ?disabled=${!this.views.length} aria-label=${t("bookmarksExport")} title=${t("bookmarksExport")}
          @click=${() => save(bookmarkFile(this.viewsOf, this.views), "views.json")}>${icon("share", 16)}</button>
        <button id="export-bcf" ?disabled=${!this.views.length} aria-label=${t("bcfExport")} title=${t("bcfExport")} @click=${() => void this.exportBcf()}>BCF</button>
        <input type="file" id="views-file" hidden accept=".json,.bcf,.bcfzip" aria-label=${t("bookmarksImport")} @change=${(e: Event) => void this.add(e.target as HTMLInputElement)} />
      </div>
    `;
  }

  private view({ name, state, picture, date }: Bookmark, n: number) {
    return html`<li>
      <button class="go" aria-label=${name} title=${name} @click=${() => this.go(state)}>${picture ? html`<img src=${picture} alt="" />` : icon("view", 18)}</button>
      <input type="text" autocomplete="off" spellcheck="false" aria-label=${t("bookmarkRename")} title=${date ? dateText(date) : nothing} .value=${name} @change=${(e: Event) => this.rename(n, e.target as HTMLInputElement)} />
      ${n > 0 ? this.button("up", t("bookmarkUp", { name }), () => this.store(movedUp(this.views, n))) : html`<span>${nothing}</span>`}
      ${this.button("code", t("bookmarkExport", { name }), () => void this.exportScene(name, state))}
      ${this.button("bin", t("bookmarkRemove", { name }), () => this.store(this.views.filter((_, i) => i !== n)))}
    </li>`;
  }

  private button(name: "up" | "code" | "bin", text: string, act: () => void) {
    return html`<button class="bare" aria-label=${text} title=${text} @click=${act}>${icon(name, 16)}</button>`;
  }

  private go(state: ViewState): void {
    const { camera, ...rest } = state;
    this.session.view.history.seal();
    this.session.view.set(rest);
    if (camera) this.session.view.moveTo(camera);
  }

  private async keep(): Promise<void> {
    const { state } = this.session.view;
    const picture = await this.smallPicture();
    this.store([
      ...this.views,
      {
        name: t("bookmarkName", { n: this.views.length + 1 }),
        state,
        date: new Date().toISOString().slice(0, 10),
        ...(picture ? { picture } : {}),
      },
    ]);
  }

  private rename(n: number, input: HTMLInputElement): void {
    const name = input.value.trim();
    if (!name) input.value = this.views[n]!.name;
    else this.store(this.views.map((view, i) => (i === n ? { ...view, name } : view)));
  }

  /** The view, small, as a data URL; null if it cannot be drawn. */
  private async smallPicture(): Promise<string | null> {
    const { session } = this;
    try {
      const png = await session.volume.engine!.picture(await session.view.composed(kPicture, 1));
      return `data:image/png;base64,${btoa(Array.from(new Uint8Array(png), (byte) => String.fromCharCode(byte)).join(""))}`;
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
    if (!views?.length) return session.messages.tell(t("noViews", { name: file.name }));
    this.store([...this.views, ...views]);
    session.messages.tell(t("bookmarksAdded", { n: views.length }));
  }

  private async addBcf(file: File): Promise<void> {
    const { session } = this;
    const model = this.bcfModel();
    if (!model) return;
    try {
      const { views, missing } = await viewsOfBcf(await file.arrayBuffer(), model);
      if (!views.length) return session.messages.tell(t("noViews", { name: file.name }));
      this.store([...this.views, ...views]);
      session.messages.tell([t("bookmarksAdded", { n: views.length }), ...(missing ? [t("bcfMissing", { n: missing })] : [])].join(". "));
    } catch (error) {
      session.messages.fail({ message: t("notBcf", { name: file.name, error: (error as Error).message ?? String(error) }) });
    }
  }

  private bcfModel(): BcfModel | null {
    const { engine, info, index, box, file } = this.session.volume;
    return engine && info && { engine, info, index, box, aspect: this.session.view.aspect, file };
  }

  private async exportBcf(): Promise<void> {
    const model = this.bcfModel();
    if (model) save(await bcfOf(this.views, model, "SVT", new Date()), "views.bcf");
  }

  private store(views: Bookmark[]): void {
    this.views = views;
    if (!saveBookmarks(this.viewsOf, views)) this.session.messages.tell(t("notKept"));
  }

  private async exportScene(name: string, state: ViewState): Promise<void> {
    const { session } = this;
    const { scene, effects } = sceneOf(state, session.volume.box, this.size);
    try {
      save(pretty(await session.volume.engine!.compose(scene, effects)), `${name.replace(/[^\p{L}\p{N}_-]+/gu, "_")}.scene.json`);
    } catch (error) {
      session.messages.fail(error);
    }
  }
}
customElements.define("svt-bookmark-list", BookmarkList);
