/** Saving a view: bookmarks, link, command, scene file, picture. */

import { css, html, nothing } from "lit";
import type { Scene } from "../engine";
import { pretty } from "../state/bookmarks";
import { commandOf, embeddingOf } from "../state/command";
import { forgetFile, isKept, keepFile } from "../state/kept_files";
import { ofScene } from "../state/link";
import { kOtherFirstValues, kRanges, rangeOfControl } from "../state/member_controls";
import { initialState, type ViewState } from "../state/view_state";
import { help, t } from "../texts";
import { toolText } from "../tool_texts";
import { copy, save } from "../ui/files";
import { icon } from "../ui/icons";
import { controls, Part } from "../ui/part";
import "./bookmark_list";

export class ShareTool extends Part {
  static override properties = {
    ...Part.properties,
    size: { state: true },
    isDrawing: { state: true },
    sceneText: { state: true },
    error: { state: true },
    isFileKept: { state: true },
  };
  declare size: [number, number];
  declare isDrawing: boolean;
  /** null: hidden. */
  declare sceneText: string | null;
  declare error: string;
  declare isFileKept: boolean;
  private seenFile = "";

  static override styles = [
    controls,
    css`
    .size input { padding: 4px 6px; }
    .size { display: grid; grid-template-columns: 1fr auto 1fr auto; gap: 6px; align-items: center; }
    textarea { width: 100%; height: 220px; margin-top: 6px; }
    .row { margin-top: 6px; }
    h3:first-child { margin-top: 0; }
  `,
  ];

  constructor() {
    super();
    this.size = [...kOtherFirstValues.pictureSize.value];
    this.isDrawing = false;
    this.sceneText = null;
    this.error = "";
    this.isFileKept = false;
  }

  override willUpdate(): void {
    const file = this.session.volume.isLocal ? this.session.volume.file : "";
    if (this.seenFile === file) return;
    this.seenFile = file;
    this.isFileKept = false;
    if (file) void isKept(file).then((kept) => (this.isFileKept = kept));
  }

  override render() {
    return html`
      <svt-bookmark-list .session=${this.session} .size=${this.size}></svt-bookmark-list>
      <h3>${t("passOn")}</h3>
      <div class="row">
        <button id="copy-link" @click=${() => void this.copyLink()}>${icon("copy", 16)}${t("copyLink")}</button>
        <button id="copy-command" @click=${() => void this.copyCommand()}>${icon("code", 16)}${t("copyCommand")}</button>
        <button id="copy-embedding" title=${toolText("copyEmbeddingHint")} ?hidden=${this.session.volume.isLocal} @click=${() => void this.copyEmbedding()}>${t("copyEmbedding")}</button>
        <button id="show-scene" aria-expanded=${this.sceneText !== null} @click=${() => void this.toggleScene()}>${t("sceneJson")}</button>
      </div>
      ${this.sceneText !== null ? this.scene(this.sceneText) : nothing}
      ${
        this.session.volume.isLocal && !this.session.volume.compared
          ? html`<label class="check" title=${toolText("keepFileHint")}><input type="checkbox" id="keep-file" .checked=${this.isFileKept} @change=${(e: Event) => void this.keepFile((e.target as HTMLInputElement).checked)} />
        ${t("keepFile", { name: this.session.volume.file })}</label>`
          : nothing
      }
      <h3>${t("picture")}</h3>
      <div class="size">
        ${this.side(t("pictureWidth"), 0)}<span aria-hidden="true">×</span>${this.side(t("pictureHeight"), 1)}
        <button id="save-picture" class="loud" ?disabled=${this.isDrawing} @click=${() => void this.savePicture()}>${icon("image", 16)}${this.isDrawing ? t("pictureWorking") : t("pictureSave")}</button>
      </div>
    `;
  }

  private side(label: string, axis: 0 | 1) {
    const { minimum, maximum, step } = rangeOfControl("pictureSide");
    return html`<input type="number" min=${minimum} max=${maximum} step=${step} aria-label=${label} title=${help(kRanges.pictureSide.member)} .value=${String(this.size[axis])} @change=${(
      e: Event,
    ) => {
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
        <button @click=${() => void copy(this.sceneInput).then((done) => this.session.messages.tell(t(done ? "copied" : "notCopied")))}>${t("copy")}</button>
        <button @click=${() => save(this.sceneInput, "view.scene.json")}>${t("download")}</button>
      </div>`;
  }

  private get sceneInput(): string {
    return this.renderRoot.querySelector<HTMLTextAreaElement>("#scene-json")!.value;
  }

  private async keepFile(isWanted: boolean): Promise<void> {
    const { session } = this;
    if (!isWanted) await forgetFile(session.volume.file);
    const bytes = isWanted ? ((await session.model.filesAgain())?.[0]?.bytes ?? null) : null;
    this.isFileKept = bytes !== null && (await keepFile(session.volume.file, bytes));
    if (isWanted && !this.isFileKept) session.messages.tell(t("notKept"));
  }

  private async copyLink(): Promise<void> {
    const { session } = this;
    await session.address.write();
    const isCopied = await copy(location.href);
    if (!isCopied) return session.messages.tell(t("notCopied"));
    if (session.volume.isLocal)
      session.messages.tell(
        toolText("linkNeedsFile", { name: Object.values(session.volume.compared ?? session.volume.fileNames).join(", ") }),
      );
    else if (isOfThisMachine(location)) session.messages.tell(toolText("linkOnThisMachine"));
    else if (location.href.length > kLongLink) session.messages.tell(toolText("linkTooLong", { n: location.href.length }));
    else session.messages.tell(t("copied"));
  }

  private async copyCommand(): Promise<void> {
    const { session } = this;
    const command = commandOf(session.view.state, session.view.describe(this.size), {
      files: session.volume.fileNames,
      owners: session.model.owners.file,
      // A model of the site is not on the reader's machine yet.
      address: session.volume.isLocal || session.volume.compared ? "" : new URL(session.volume.address, location.href).href,
    });
    if (command.includes("--scene")) save(pretty(await session.view.composed(this.size)), "view.scene.json");
    session.messages.tell((await copy(command)) ? `${t("copied")}: ${command}` : command);
  }

  private async copyEmbedding(): Promise<void> {
    const { session } = this;
    await session.address.write();
    const code = embeddingOf(location.href, session.volume.name || session.volume.file, this.size);
    session.messages.tell((await copy(code)) ? `${t("copied")}: ${code}` : code);
  }

  private async toggleScene(): Promise<void> {
    this.error = "";
    try {
      this.sceneText = this.sceneText === null ? pretty(await this.session.view.composed(this.size)) : null;
    } catch (error) {
      this.session.messages.fail(error);
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
      await session.volume.engine!.picture({ ...scene, size: [16, 9], samples: 1 });
      session.view.set({ ...ofScene(scene, session.view.state), selection: session.view.state.selection });
    } catch (error) {
      this.error = (error as { message?: string }).message ?? String(error);
    }
  }

  private async savePicture(): Promise<void> {
    const { session } = this;
    this.isDrawing = true;
    try {
      save(await session.volume.engine!.picture(await session.view.composed(this.size)), "view.png");
    } catch (error) {
      session.messages.fail(error);
    }
    this.isDrawing = false;
  }
}
customElements.define("svt-share-tool", ShareTool);

/** Number of characters of a link that all programs pass on. */
const kLongLink = 2000;

function isOfThisMachine({ protocol, hostname }: Location): boolean {
  return protocol === "file:" || hostname === "localhost" || hostname === "[::1]" || /^127\./.test(hostname);
}

/** Leaves a scene that was written by hand. */
export function leaveCustom(state: ViewState): Partial<ViewState> {
  const { camera, look, selection } = state;
  return { ...initialState(look), camera, selection };
}
