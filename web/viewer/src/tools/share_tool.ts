/** Saving a view: bookmarks, link, command, scene file, picture. */

import { css, html, nothing } from "lit";
import type { Scene } from "../engine";
import { loadBookmarks, saveBookmarks, type Bookmark } from "../state/bookmarks";
import { commandOf } from "../state/command";
import { ofScene } from "../state/link";
import { kOtherFirstValues, kRanges, rangeOfControl } from "../state/member_controls";
import { sceneOf } from "../state/scene_of";
import { initialState, type ViewState } from "../state/view_state";
import { help, t } from "../texts";
import { copy, save } from "../ui/files";
import { icon } from "../ui/icons";
import { controls, Part } from "../ui/part";

export class ShareTool extends Part {
  static override properties = {
    ...Part.properties,
    size: { state: true }, isDrawing: { state: true }, sceneText: { state: true }, error: { state: true },
  };
  declare size: [number, number];
  declare isDrawing: boolean;
  /** null: hidden. */
  declare sceneText: string | null;
  declare error: string;
  private bookmarks: Bookmark[] = [];
  private bookmarksOf = "";

  static override styles = [controls, css`
    ul { list-style: none; margin: 0; padding: 0; }
    li { display: flex; gap: 4px; align-items: center; }
    li .go { flex: 1; justify-content: flex-start; min-width: 0; overflow: hidden; text-overflow: ellipsis; border-color: transparent; }
    .size { display: grid; grid-template-columns: 1fr auto 1fr auto; gap: 6px; align-items: center; }
    textarea { width: 100%; height: 220px; margin-top: 6px; }
    .row { margin-top: 6px; }
    h3:first-child { margin-top: 0; }
  `];

  constructor() {
    super();
    this.size = [...kOtherFirstValues.pictureSize.value];
    this.isDrawing = false;
    this.sceneText = null;
    this.error = "";
  }

  protected override uses() {
    return [this.session.modelFile, this.session.state.custom];
  }

  override willUpdate(): void {
    if (this.bookmarksOf === this.session.modelFile) return;
    this.bookmarksOf = this.session.modelFile;
    this.bookmarks = loadBookmarks(this.bookmarksOf);
  }

  override render() {
    return html`
      <h3>${t("bookmarks")}</h3>
      <ul>${this.bookmarks.map((bookmark, n) => this.bookmark(bookmark, n))}</ul>
      <button id="keep-view" @click=${() => this.keep()}>${icon("bookmark", 16)}${t("keepView")}</button>
      <h3>${t("passOn")}</h3>
      <div class="row">
        <button id="copy-link" @click=${() => void this.copyLink()}>${icon("copy", 16)}${t("copyLink")}</button>
        <button id="copy-command" @click=${() => void this.copyCommand()}>${icon("code", 16)}${t("copyCommand")}</button>
        <button id="show-scene" aria-expanded=${this.sceneText !== null} @click=${() => void this.toggleScene()}>${t("sceneJson")}</button>
      </div>
      ${this.sceneText !== null ? this.scene(this.sceneText) : nothing}
      <h3>${t("picture")}</h3>
      <div class="size">
        ${this.side(t("pictureWidth"), 0)}<span aria-hidden="true">×</span>${this.side(t("pictureHeight"), 1)}
        <button id="save-picture" class="loud" ?disabled=${this.isDrawing} @click=${() => void this.savePicture()}>${icon("image", 16)}${this.isDrawing ? t("pictureWorking") : t("pictureSave")}</button>
      </div>
    `;
  }

  private bookmark({ name, state }: Bookmark, n: number) {
    return html`<li>
      <button class="go" @click=${() => this.go(state)}>${name}</button>
      <button class="bare" aria-label=${t("bookmarkExport", { name })} title=${t("bookmarkExport", { name })} @click=${() => void this.exportBookmark(name, state)}>${icon("code", 16)}</button>
      <button class="bare" aria-label=${t("bookmarkRemove", { name })} title=${t("bookmarkRemove", { name })} @click=${() => this.store(this.bookmarks.filter((_, i) => i !== n))}>${icon("bin", 16)}</button>
    </li>`;
  }

  private side(label: string, axis: 0 | 1) {
    const { minimum, maximum, step } = rangeOfControl("pictureSide");
    return html`<input type="number" min=${minimum} max=${maximum} step=${step} aria-label=${label} title=${help(kRanges.pictureSide.member)} .value=${String(this.size[axis])} @change=${(e: Event) => {
      const value = Math.round(Number((e.target as HTMLInputElement).value));
      const size: [number, number] = [...this.size];
      size[axis] = Math.min(maximum, Math.max(minimum, value || minimum));
      this.size = size;
    }} />`;
  }

  private scene(text: string) {
    return html`
      <textarea id="scene-json" spellcheck="false" aria-label=${t("sceneJson")} .value=${text}></textarea>
      ${this.error ? html`<p class="error" role="alert">${this.error}</p>` : nothing}
      <div class="row">
        <button id="apply-scene" @click=${() => void this.applyScene()}>${t("apply")}</button>
        <button @click=${() => void copy(this.sceneInput).then((done) => this.session.tell(t(done ? "copied" : "notCopied")))}>${t("copy")}</button>
        <button @click=${() => save(this.sceneInput, "view.scene.json")}>${t("download")}</button>
      </div>`;
  }

  private get sceneInput(): string {
    return this.renderRoot.querySelector<HTMLTextAreaElement>("#scene-json")!.value;
  }

  private go(state: ViewState): void {
    const { camera, ...rest } = state;
    this.session.set(rest);
    if (camera) this.session.moveTo(camera);
  }

  private keep(): void {
    this.store([...this.bookmarks, { name: t("bookmarkName", { n: this.bookmarks.length + 1 }), state: this.session.state }]);
  }

  private store(bookmarks: Bookmark[]): void {
    this.bookmarks = bookmarks;
    if (!saveBookmarks(this.bookmarksOf, bookmarks)) this.session.tell(t("notKept"));
    this.requestUpdate();
  }

  private async exportBookmark(name: string, state: ViewState): Promise<void> {
    const { session } = this;
    const { scene, effects } = sceneOf(state, session.box, this.size);
    try {
      save(pretty(await session.engine!.compose(scene, effects)), `${name.replace(/[^\p{L}\p{N}_-]+/gu, "_")}.scene.json`);
    } catch (error) {
      session.fail(error);
    }
  }

  private async copyLink(): Promise<void> {
    await this.session.writeLink();
    this.session.tell(t((await copy(location.href)) ? "copied" : "notCopied"));
  }

  private async copyCommand(): Promise<void> {
    const { session } = this;
    const command = commandOf(session.state, session.describe(this.size), session.modelFile);
    if (command.includes("--scene")) save(pretty(await session.composed(this.size)), "view.scene.json");
    session.tell((await copy(command)) ? `${t("copied")}: ${command}` : command);
  }

  private async toggleScene(): Promise<void> {
    this.error = "";
    try {
      this.sceneText = this.sceneText === null ? pretty(await this.session.composed(this.size)) : null;
    } catch (error) {
      this.session.fail(error);
    }
  }

  private async applyScene(): Promise<void> {
    const { session } = this;
    this.error = "";
    let scene: Scene;
    try {
      scene = JSON.parse(this.sceneInput) as Scene;
    } catch (error) {
      this.error = t("badJson", { error: (error as Error).message });
      return;
    }
    try {
      // The library validates it by drawing a small picture.
      await session.engine!.picture({ ...scene, size: [16, 9], samples: 1 });
      session.set({ ...ofScene(scene, session.state), selection: session.state.selection });
    } catch (error) {
      this.error = (error as { message?: string }).message ?? String(error);
    }
  }

  private async savePicture(): Promise<void> {
    const { session } = this;
    this.isDrawing = true;
    try {
      save(await session.engine!.picture(await session.composed(this.size)), "view.png");
    } catch (error) {
      session.fail(error);
    }
    this.isDrawing = false;
  }
}
customElements.define("svt-share-tool", ShareTool);

/** Points on one line, everything else in the usual layout. */
const pretty = (scene: Scene) => `${JSON.stringify(scene, null, 2).replace(/\[\s+([-\d.,\se]+?)\s+\]/g, (_, n: string) => `[${n.replace(/\s+/g, " ")}]`)}\n`;

/** Leaves a scene that was written by hand. */
export function leaveCustom(state: ViewState): Partial<ViewState> {
  const { camera, look, selection } = state;
  return { ...initialState(look), camera, selection };
}
