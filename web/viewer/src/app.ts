/** The page: bar, panels, picture, tools, and global keyboard shortcuts. */

import { html, nothing, type PropertyValues } from "lit";
import { actionOfKey, actionsOf, kTools, type ActionHost } from "./actions";
import { appStyles } from "./app_styles";
import type { Arrival } from "./arrival";
import "./canvas/picture";
import type { PictureTools } from "./canvas/overlay";
import type { PickEvent, PictureView } from "./canvas/picture";
import type { SectionPanes } from "./canvas/section_panes";
import type { ChangesPanel } from "./comparing/changes_panel";
import type { CommandPalette } from "./panels/command_palette";
import type { ContextMenu } from "./panels/context_menu";
import type { HelpDialog } from "./panels/help_dialog";
import "./panels/legend";
import type { MenuRequest } from "./panels/menu_request";
import "./panels/properties_panel";
import "./panels/start_panel";
import "./panels/tree_panel";
import type { TreePanel } from "./panels/tree_panel";
import type { QuantitiesPanel } from "./quantities/quantities_panel";
import type { Tool } from "./session/view";
import { kFileKinds } from "./opening";
import { menuActions, nameOfSelection } from "./selection_actions";
import type { Message } from "./session/messages";
import { isSameButCamera, isSameChoice, type ViewState } from "./state/view_state";
import "./tools/focus_tool";
import "./tools/lens_tool";
import "./tools/look_tool";
import { measuringOf } from "./tools/measure_points";
import "./tools/measure_tool";
import "./tools/section_tool";
import "./tools/share_tool";
import { leaveCustom } from "./tools/share_tool";
import "./tools/views_tool";
import { setWalking } from "./tools/views_tool";
import { movedText, number, percentText, t } from "./texts";
import { toolText } from "./tool_texts";
import { movedByArrow } from "./ui/arrow_keys";
import { icon, type IconName } from "./ui/icons";
import { controls, Part } from "./ui/part";
import { theme, toggleTheme } from "./ui/theme";

/** Below this width, panels are sheets over the picture. */
const kNarrow = "(max-width: 759px)";
const kSmall = "(max-width: 1179px)";

export class App extends Part implements ActionHost {
  static override properties = {
    ...Part.properties,
    canvas: { attribute: false },
    isNarrow: { state: true },
    isSmall: { state: true },
    isTreeShown: { state: true },
    isSelectionShown: { state: true },
    below: { state: true },
    isFourShown: { state: true },
    isDropping: { state: true },
    dropAt: { state: true },
    dockAt: { state: true },
    preview: { attribute: false },
  };
  declare canvas: HTMLCanvasElement;
  declare isNarrow: boolean;
  declare isSmall: boolean;
  declare isTreeShown: boolean;
  declare isSelectionShown: boolean;
  /** The panel below the picture. */
  declare below: "table" | "changes" | "quantities" | null;
  /** A plan and two sections are beside the picture. */
  declare isFourShown: boolean;
  declare isDropping: boolean;
  /** The purpose of dropped files, which can also be compared. null: only to open them. */
  declare dropAt: "open" | "compare" | null;
  /** The tool that the Tab key reaches. */
  declare dockAt: number;
  /** Address of a picture that is shown until the model has one of its own; empty: none. */
  declare preview: string;
  /** null: how much has come is not known. */
  arrival: Arrival | null = null;
  /** Handlers for files, and for a listed model. */
  onFiles: (files: File[]) => void = () => {};
  onModel: (name: string) => void = () => {};
  private seenSelection: unknown = null;
  private wasWalking = false;
  private wasAiming = false;
  private pictureTools: PictureTools | null = null;
  /** The last message, and the view when it came. */
  private seenMessage: { message: Message | null; state: ViewState; aim: unknown; tool: unknown } | null = null;

  static override styles = [controls, appStyles];

  constructor() {
    super();
    this.isNarrow = matchMedia(kNarrow).matches;
    this.isSmall = matchMedia(kSmall).matches;
    this.isTreeShown = !this.isNarrow;
    this.isSelectionShown = true;
    this.isFourShown = this.isDropping = false;
    this.below = this.dropAt = null;
    this.dockAt = 0;
    this.preview = "";
  }

  override connectedCallback(): void {
    super.connectedCallback();
    for (const query of [kNarrow, kSmall]) matchMedia(query).addEventListener("change", () => this.fitWidth());
    addEventListener("keydown", (event) => this.keyDown(event));
    addEventListener("dragover", (event) => this.draggedOver(event));
    addEventListener("dragleave", (event) => !event.relatedTarget && (this.isDropping = false));
    addEventListener("drop", (event) => this.dropped(event));
    this.addEventListener("svt-choose", () => this.choose());
    this.addEventListener("svt-menu", (event) => void this.openMenu(event as MenuRequest));
    this.addEventListener("svt-close-table", () => this.openTable());
    this.addEventListener("svt-close-changes", () => this.endBelow("compare"));
    this.addEventListener("svt-close-quantities", () => this.endBelow("quantities"));
  }

  private get isHuge(): boolean {
    return matchMedia("(min-width: 2600px)").matches;
  }

  private fitWidth(): void {
    const wasNarrow = this.isNarrow;
    this.isNarrow = matchMedia(kNarrow).matches;
    this.isSmall = matchMedia(kSmall).matches;
    if (wasNarrow !== this.isNarrow) this.isTreeShown = !this.isNarrow;
  }

  override willUpdate(_: PropertyValues): void {
    const { session } = this;
    if (session.picture.report || session.model.status === "empty") this.preview = "";
    const { along, isEmpty } = session.selection;
    const what = along ?? session.view.now.selection;
    if (this.seenSelection === what) return;
    this.seenSelection = what;
    if (this.isNarrow) this.isSelectionShown = along !== null;
    else if (!isEmpty) this.isSelectionShown = true;
  }

  override updated(): void {
    const { view } = this.session;
    if (view.isWalking && !this.wasWalking) this.picture?.focus();
    if (view.aim) void this.loaded("svt-aim", () => import("./tools/aim_layer"));
    else if (this.wasAiming) this.picture?.focus();
    if (view.now.colorBy || view.now.field) void this.loaded("svt-color-legend", () => import("./panels/color_legend"));
    if (view.isWalking && isTouch()) void this.loaded("svt-walk-pad", () => import("./tools/walk_pad"));
    this.wasWalking = view.isWalking;
    this.wasAiming = view.aim !== null;
    this.endMessage();
    view.mark = getComputedStyle(this).getPropertyValue("--mark").trim();
  }

  override render() {
    const { session } = this;
    const hasModel = session.volume.info !== null;
    const isEmpty = session.model.status === "empty" && !hasModel;
    const part = (title: string, content: unknown) => html`<section class="table" aria-label=${title}>${content}</section>`;
    const below =
      this.below === "changes"
        ? part(t("compare"), html`<svt-changes .session=${session}></svt-changes>`)
        : this.below === "quantities"
          ? part(t("quantities"), html`<svt-quantities .session=${session}></svt-quantities>`)
          : this.below && hasModel
            ? part(t("tableHint"), html`<svt-table .session=${session}></svt-table>`)
            : nothing;
    return html`
      <button class="skip" @click=${() => this.picture?.focus()}>${t("skipToPicture")}</button>
      ${this.bar()}
      <main class=${below === nothing ? "" : "with-table"}>
        ${isEmpty ? html`<svt-start .session=${session}></svt-start>` : hasModel && !this.isNarrow ? this.wide() : this.middle()}
        ${this.isNarrow && hasModel ? this.sheets() : nothing}
        ${below}
        ${this.preview ? this.arriving() : session.messages.progress ? this.progress() : nothing}
        ${session.messages.message ? this.message() : nothing}
        ${this.isDropping ? this.dropZones() : nothing}
      </main>
      <div class="visually-hidden" role="status" aria-live="polite" id="said">${session.messages.said}</div>
      <input type="file" id="file" hidden multiple accept=${[...kFileKinds, ".gz", ".csv"].join(",")} aria-label=${t("openHint", { kinds: kFileKinds.join(", ") })} @change=${this.chosen} />
      <svt-help .session=${session}></svt-help>
      <svt-palette .session=${session}></svt-palette>
      <svt-menu .session=${session}></svt-menu>
    `;
  }

  private bar() {
    const { volume, view, languages } = this.session;
    const { info, models, name, file } = volume;
    const other = languages.current === "en" ? "de" : "en";
    const hasModel = info !== null;
    return html`<header>
      <div class="brand">${icon("section", 24)}<span>SVT</span></div>
      <div class="title">
        ${
          models.length > 1
            ? html`<select aria-label=${t("models")} @change=${(e: Event) => this.onModel((e.target as HTMLSelectElement).value)}>
              ${models.map((m) => html`<option value=${m.name} ?selected=${m.name === name}>${m.title || m.name}</option>`)}
              ${hasModel && !name ? html`<option selected value="">${info.name || file}</option>` : nothing}</select>`
            : html`<h1>${hasModel ? info.name || info.source || file : t("appName")}</h1>`
        }
        <span class="quiet small">${!hasModel ? t("tagline") : volume.isServerOnly ? "" : t("parts", { n: volume.index.firstScalars.length })}</span>
      </div>
      ${
        hasModel
          ? html`${this.toggle("tree", t("panelTree"), this.isTreeShown, () => this.showSheet("tree"))}
            ${this.toggle("info", t("panelProperties"), this.isSelectionShown && (!this.session.selection.isEmpty || !this.isSmall), () => this.showSheet("selection"))}`
          : nothing
      }
      ${hasModel && !volume.isServerOnly ? html`${this.stepButton("undo", view.undoable, () => view.undo())}${this.stepButton("redo", view.redoable, () => view.redo())}` : nothing}
      ${hasModel && !volume.isServerOnly ? html`<button class="bare" id="table" aria-pressed=${this.below === "table"} aria-label=${t("tableHint")} title="${t("tableHint")} (T)" @click=${() => this.openTable()}>${icon("table")}</button>` : nothing}
      ${hasModel && !volume.isServerOnly ? html`<button class="bare" id="four" aria-pressed=${this.isFourShown} aria-label=${t("fourViews")} title="${t("fourViews")} (J)" @click=${() => this.openFour()}>${icon("four")}</button>` : nothing}
      ${hasModel && !volume.isServerOnly ? html`<button class="bare" id="quantities" aria-pressed=${this.below === "quantities"} aria-label=${t("quantities")} title=${t("quantities")} @click=${() => this.openQuantities()}>${icon("sum")}</button>` : nothing}
      <button class="bare" id="actions" aria-haspopup="dialog" aria-label=${t("actionsHint")} title=${t("actionsHint")} @click=${() => this.openPalette()}>${icon("menu")}</button>
      <button class="bare" id="open" aria-label=${t("openHint", { kinds: kFileKinds.join(", ") })} title=${t("openHint", { kinds: kFileKinds.join(", ") })} @click=${() => this.choose()}>${icon("open")}</button>
      ${volume.isServerOnly ? nothing : html`<button class="bare" id="compare" aria-pressed=${this.below === "changes"} aria-label=${t("compare")} title=${t("compare")} @click=${() => (this.below === "changes" ? this.endBelow("compare") : this.compare())}>${icon("flip")}</button>`}
      <button class="bare" id="theme" aria-label=${t("theme")} title=${t("theme")} @click=${() => this.switchTheme()}>${icon(theme() === "dark" ? "sun" : "moon")}</button>
      ${
        languages.all.length > 2
          ? html`<select class="languages" id="languages" aria-label=${t("languages")} @change=${(e: Event) => void languages.choose((e.target as HTMLSelectElement).value)}>${languages.all.map(
              (listed) =>
                html`<option value=${listed.code} lang=${listed.code} ?selected=${listed.code === languages.current}>${listed.name}</option>`,
            )}</select>`
          : html`<button class="bare" id="language" lang=${other} aria-label=${t("language")} title=${t("language")} @click=${() => languages.speak(other)}>${other.toUpperCase()}</button>`
      }
      <button class="bare" id="help" aria-label=${t("help")} title="${t("help")} (?)" @click=${() => this.help()}>${icon("help")}</button>
    </header>`;
  }

  private toggle(name: IconName, panel: string, isOn: boolean, act: () => void) {
    return html`<button class="bare" aria-pressed=${isOn} aria-label=${t("showPanel", { panel })} title=${panel} @click=${act}>${icon(name)}</button>`;
  }

  private stepButton(which: "undo" | "redo", what: string | null, act: () => void) {
    const text = what === null ? t(`${which}Nothing`) : t(which, { what });
    return html`<button class="bare" id=${which} ?disabled=${what === null} aria-label=${text} title=${text} @click=${act}>${icon(which)}</button>`;
  }

  showSheet(which: "tree" | "selection"): void {
    const isTree = which === "tree";
    const isOn = isTree ? !this.isTreeShown : !this.isSelectionShown;
    if (this.isNarrow && isOn) {
      this.below = null;
      this.isTreeShown = this.isSelectionShown = false;
      this.session.view.tool = null;
    }
    if (isTree) this.isTreeShown = isOn;
    else this.isSelectionShown = isOn;
  }

  /**
   * The tree, the picture, and a column at the right with the tool and the selection. Without room for three columns, the
   * tool and the selection are below the tree.
   */
  private wide() {
    const { view, selection, volume } = this.session;
    const hasTree = this.isTreeShown && !volume.isServerOnly;
    const hasSelection = this.isSelectionShown && !(this.isSmall && selection.isEmpty);
    const isShared = this.isSmall && hasTree;
    const others =
      view.tool || hasSelection
        ? html`${view.tool ? this.card(view.tool) : nothing}
          ${hasSelection ? html`<aside aria-label=${t("panelProperties")}><svt-properties .session=${this.session}></svt-properties></aside>` : nothing}`
        : null;
    const picture = this.middle();
    const middle =
      others && !isShared
        ? html`<wa-split-panel position-in-pixels=${this.isHuge ? 420 : 320} primary="end"><div slot="start" class="middle">${picture}</div><div slot="end" class="side column">${others}</div></wa-split-panel>`
        : picture;
    if (!hasTree) return middle;
    return html`<wa-split-panel position-in-pixels=${this.isHuge ? 420 : this.isSmall && !view.tool ? 260 : 310} primary="start">
      <div slot="start" class="side column"><nav aria-label=${t("panelTree")}><svt-tree .session=${this.session}></svt-tree></nav>${isShared ? others : nothing}</div>
      <div slot="end" class="middle">${middle}</div></wa-split-panel>`;
  }

  private sheets() {
    const { session } = this;
    const sheet = (title: string, close: () => void, content: unknown) => html`<section class="sheet" aria-label=${title}>
      <div class="bar"><h2>${title}</h2><button class="bare" aria-label=${t("close")} @click=${close}>${icon("down")}</button></div><div>${content}</div></section>`;
    if (this.isTreeShown) return sheet(t("panelTree"), () => (this.isTreeShown = false), html`<svt-tree .session=${session}></svt-tree>`);
    if (this.isSelectionShown)
      return sheet(
        t("panelProperties"),
        () => (this.isSelectionShown = false),
        html`<svt-properties .session=${session}></svt-properties>`,
      );
    return nothing;
  }

  /** The picture with its overlays; in narrow pages, also the tool. */
  private middle() {
    const { session } = this;
    const { view, picture } = session;
    this.pictureTools ??= measuringOf(session);
    const isFour = this.isFourShown && session.volume.info !== null && !session.volume.isServerOnly;
    return html`<div class="middle ${isFour ? "four" : ""}">
      <svt-picture .session=${session} .canvas=${this.canvas} .tools=${this.pictureTools} @svt-pick=${this.pickedInPicture}></svt-picture>
      ${isFour ? html`<svt-section-panes .session=${session}></svt-section-panes>` : nothing}
      ${this.preview ? html`<img class="preview" id="preview" src=${this.preview} alt="" @error=${() => (this.preview = "")} />` : nothing}
      ${
        session.volume.info
          ? html`
        ${session.volume.isServerOnly ? nothing : html`<svt-view-cube .session=${session}></svt-view-cube>`}
        ${view.aim ? html`<svt-aim .session=${session} .tools=${this.pictureTools}></svt-aim>` : nothing}
        ${view.isWalking && isTouch() ? html`<svt-walk-pad .session=${session}></svt-walk-pad>` : nothing}
        <div class="corner">
          ${view.now.custom ? html`<div class="note">${t("customScene")}<button @click=${() => view.set(leaveCustom(view.state))}>${t("leaveCustom")}</button></div>` : nothing}
          ${session.volume.isServerOnly ? html`<div class="note">${t("serverPictures")}</div>` : nothing}
          ${session.model.refining.isCoarse ? this.coarse() : nothing}
          ${this.missingTiles()}
          ${view.now.colorBy || view.now.field ? html`<svt-color-legend .session=${session}></svt-color-legend>` : nothing}
          ${session.selection.isMore ? html`<div class="note" id="more">${toolText("moreNow")}<button @click=${() => (session.selection.isMore = false)}>${toolText("moreEnd")}</button></div>` : nothing}
          ${picture.moved.length && view.now.sections.length ? html`<div class="note" id="moved-plane">${movedText(picture.moved)}</div>` : nothing}
          ${view.isLegendShown ? html`<svt-legend .session=${session}></svt-legend>` : nothing}
        </div>
        ${this.status()}
        ${view.tool && this.isNarrow ? this.card(view.tool) : nothing}
        ${this.dock()}`
          : nothing
      }
    </div>`;
  }

  /** The state of a large model: its coarse first picture, and its refinement. */
  private coarse() {
    const { refining } = this.session.model;
    const { progress } = refining;
    return html`<div class="note" id="refining">${t("coarseNow", { spacing: number(refining.spacing, 2) })}
      ${
        progress
          ? html`<progress aria-label=${t("makingFiner")} max="1" value=${progress.share >= 0 ? progress.share : nothing}></progress><span>${progress.text}</span><button id="stay-coarse" @click=${() => refining.stop()}>${t("stayCoarse")}</button>`
          : html`<button id="refine" @click=${() => refining.again()}>${t("makeFiner")}</button>`
      }</div>`;
  }

  /** The tiles of a city that could not be fetched. */
  private missingTiles() {
    const { city } = this.session.model;
    if (!city || (!city.isStopped && !city.lacks.length)) return nothing;
    const n = city.lacks.length;
    const isBusy = city.isFetchingAgain;
    return html`<div class="note" id="missing-tiles"><strong>${n > 1 ? t("cityMissing", { n }) : t(n ? "cityMissingOne" : "cityMissingSome")}</strong>
      ${n ? html`<span class="quiet small">${city.lacks[0]}</span>` : nothing}
      <button id="fetch-again" aria-disabled=${isBusy} @click=${() => city.fetchAgain()}>${t(isBusy ? "cityFetchingAgain" : "cityFetchAgain")}</button></div>`;
  }

  private status() {
    const { report } = this.session.picture;
    if (!report) return nothing;
    const { width, height, milliseconds, engine } = report;
    return html`<div class="status">${t(engine === "cpu" ? "cpuKind" : "glKind")}<br />${t("frame", { width, height, ms: number(milliseconds, 0) })}</div>`;
  }

  private dock() {
    const { view } = this.session;
    const { now } = view;
    const used: Record<Tool, boolean> = {
      section: now.sections.length > 0,
      lens: now.effect === "lens",
      focus: now.effect === "highlight" || now.effect === "cutaway" || now.shell !== null,
      look: now.wireframe !== null || now.sun !== null,
      measure: now.measured.length > 0,
      views: view.isWalking,
      share: false,
    };
    return html`<div class="dock" role="toolbar" aria-label=${t("tools")} @keydown=${this.dockKey} @focusin=${(e: Event) => (this.dockAt = kTools.findIndex(({ tool }) => (e.target as HTMLElement).id === `tool-${tool}`))}>${kTools.map(
      (
        { tool, icon: name, key },
        n,
      ) => html`<button id="tool-${tool}" tabindex=${n === this.dockAt ? 0 : -1} class=${used[tool] ? "used" : ""} aria-expanded=${view.tool === tool} aria-keyshortcuts=${key}
        title="${t(tool)} (${key.toUpperCase()})" @click=${(e: MouseEvent) => (e.detail ? this.toggleTool(tool) : this.useTool(tool))}>${icon(name, 22)}<span>${t(tool)}</span></button>`,
    )}</div>`;
  }

  /** Arrow keys move along the tools, which are a single stop of the Tab key. */
  private readonly dockKey = (event: KeyboardEvent): void => {
    const last = kTools.length - 1;
    const next = { ArrowRight: this.dockAt + 1, ArrowLeft: this.dockAt - 1, Home: 0, End: last }[event.key];
    if (next === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    const { tool } = kTools[next > last ? 0 : next < 0 ? last : next]!;
    this.renderRoot.querySelector<HTMLElement>(`#tool-${tool}`)?.focus();
  };

  private card(tool: Tool) {
    const { session } = this;
    const content = {
      section: html`<svt-section-tool .session=${session}></svt-section-tool>`,
      lens: html`<svt-lens-tool .session=${session}></svt-lens-tool>`,
      focus: html`<svt-focus-tool .session=${session}></svt-focus-tool>`,
      look: html`<svt-look-tool .session=${session}></svt-look-tool>`,
      measure: html`<svt-measure-tool .session=${session}></svt-measure-tool>`,
      views: html`<svt-views-tool .session=${session}></svt-views-tool>`,
      share: html`<svt-share-tool .session=${session}></svt-share-tool>`,
    }[tool];
    return html`<section class="card" id="card" aria-label=${t(tool)}>
      <div class="bar"><h2>${t(tool)}</h2><button class="bare" aria-label=${t("close")} @click=${() => this.toggleTool(tool)}>${icon("close", 18)}</button></div>${content}</section>`;
  }

  useTool(tool: Tool): void {
    this.toggleTool(tool);
    void this.enterTool();
  }

  /** The focus goes to the open tool: for measuring, to a cross over the picture. */
  private async enterTool(): Promise<void> {
    const { view } = this.session;
    const { tool } = view;
    if (tool === "measure") view.aim = "point";
    await this.updateComplete;
    if (!tool) return this.picture?.focus();
    const part = this.renderRoot.querySelector<Part>(`#card svt-${tool}-tool`);
    await part?.updateComplete;
    if (!view.aim) part?.renderRoot.querySelector<HTMLElement>("svt-bookmark-list, button, input, select")?.focus();
  }

  private toggleTool(tool: Tool): void {
    const { session } = this;
    if (session.view.aim === "point") session.view.aim = null;
    session.view.tool = session.view.tool === tool ? null : tool;
    if (session.view.tool && this.isNarrow) this.clear();
    if (session.view.tool === "lens" && session.view.now.effect !== "lens")
      session.view.set({ effect: "lens", lens: { ...session.view.now.lens, pinned: false } });
  }

  /** Closes a tool, and ends its automatic actions: a lens that follows the mouse. */
  private endTool(tool: Tool): void {
    const { state } = this.session.view;
    const hadFocus = this.renderRoot.querySelector("#card:focus-within");
    this.toggleTool(tool);
    if (hadFocus) this.picture?.focus();
    if (tool === "lens" && state.effect === "lens" && !state.lens.pinned) this.session.view.set({ effect: "none" });
  }

  private progress() {
    const { text, share } = this.session.messages.progress!;
    return html`<div class="progress"><div><div role="status">${text}<progress aria-label=${text} max="1" value=${share >= 0 ? share : nothing}></progress></div>
      ${this.cancelButton()}</div></div>`;
  }

  /** The received share of library and model, at the lower border of the preview. */
  private arriving() {
    const share = this.arrival?.share ?? null;
    // Only whole bytes are all bytes.
    const percent = share === null ? nothing : Math.floor(100 * share);
    const text = t("loadingModel");
    return html`<div class="progress low"><div><div class="above">${text}${this.cancelButton()}</div>
      <div class="arriving" id="arriving" role="progressbar" aria-label=${text} aria-valuemin="0" aria-valuemax="100" aria-valuenow=${percent}>
        <progress aria-hidden="true" max="100" value=${percent}></progress>${share === null ? nothing : html`<span>${percentText(share)}</span>`}</div></div></div>`;
  }

  private cancelButton() {
    const { model } = this.session;
    return model.opening ? html`<button id="cancel" @click=${() => model.cancelOpening()}>${t("cancel")}</button>` : nothing;
  }

  private message() {
    const { title, text, isError, repairs = [] } = this.session.messages.message!;
    return html`<div class="message ${isError ? "bad" : ""}" id="message" role=${isError ? "alert" : "status"}>
      <div>${title ? html`<strong>${title}</strong><br />` : nothing}${text}${repairs.map(({ text: label, act }) => html` <button class="repair" @click=${act}>${label}</button>`)}</div>
      <button class="bare" aria-label=${t("dismiss")} @click=${() => this.dismiss()}>${icon("close", 18)}</button></div>`;
  }

  /** Removes the message once the user has made another choice, or has done something else. */
  private endMessage(): void {
    const { messages, view } = this.session;
    const { message } = messages;
    const seen = this.seenMessage;
    if (!message || seen?.message !== message)
      return void (this.seenMessage = { message, state: view.state, aim: view.aim, tool: view.tool });
    const isOther =
      message.until === "choice"
        ? !isSameChoice(view.state, seen.state)
        : message.until === "action" && !(isSameButCamera(view.state, seen.state) && view.aim === seen.aim && view.tool === seen.tool);
    if (isOther)
      queueMicrotask(() => {
        if (messages.message === message) this.dismiss();
      });
  }

  private dismiss(): void {
    this.session.messages.message = null;
  }

  private get picture(): PictureView | null {
    return this.renderRoot.querySelector("svt-picture");
  }

  help(): void {
    void this.loaded<HelpDialog>("svt-help", () => import("./panels/help_dialog")).then((dialog) => dialog?.show());
  }

  switchTheme(): void {
    const { session } = this;
    const now = toggleTheme();
    const { look } = session.view.now;
    // Light and dark looks follow the theme of the page; paper and blueprint are explicit choices.
    if (look === "plain" || look === "dark") session.view.set({ look: now === "dark" ? "dark" : "plain" });
    this.requestUpdate();
  }

  choose(): void {
    this.renderRoot.querySelector<HTMLInputElement>("#file")!.click();
  }

  private readonly chosen = (event: Event): void => {
    const input = event.target as HTMLInputElement;
    const files = [...(input.files ?? [])];
    input.value = "";
    if (files.length) this.onFiles(files);
  };

  private draggedOver(event: DragEvent): void {
    if (!event.dataTransfer?.types.includes("Files")) return;
    event.preventDefault();
    this.isDropping = true;
    const { info, isServerOnly, isCity } = this.session.volume;
    const n = [...event.dataTransfer.items].filter(({ kind }) => kind === "file").length;
    const isPair = n === 2 || (n === 1 && info !== null && !isCity);
    this.dropAt = isServerOnly || !isPair ? null : 2 * event.clientX > innerWidth ? "compare" : "open";
  }

  private dropZones() {
    const { dropAt } = this;
    if (!dropAt) return html`<div class="dropping">${t("dropNow")}</div>`;
    return html`<div class="dropping half ${dropAt === "open" ? "" : "off"}">${t("dropNow")}</div>
      <div class="dropping half at-end ${dropAt === "open" ? "off" : ""}">${t("dropCompare")}</div>`;
  }

  private dropped(event: DragEvent): void {
    event.preventDefault();
    this.isDropping = false;
    const files = [...(event.dataTransfer?.files ?? [])];
    if (files.length && this.dropAt === "compare") this.compare(files);
    else if (files.length) this.onFiles(files);
  }

  /** Shows the panel that compares two states. @param linked  names of the states, and the view of a link */
  compare(files: File[] = [], linked: Parameters<ChangesPanel["follow"]>[0] | null = null): void {
    if (this.session.volume.isServerOnly) return;
    this.show("changes");
    void this.loaded<ChangesPanel>("svt-changes", () => import("./comparing/changes_panel")).then(async (panel) => {
      await panel?.updateComplete;
      if (linked) panel?.follow(linked);
      else if (files.length) panel?.take(files);
      else panel?.focus();
    });
  }

  /** Shows a part below the picture. In narrow pages it takes the place of sheets and tools. */
  private show(below: NonNullable<App["below"]>): void {
    if (this.isNarrow) {
      this.clear();
      this.session.view.tool = null;
    }
    this.below = below;
  }

  private clear(): void {
    this.isTreeShown = this.isSelectionShown = false;
    this.below = null;
  }

  /** Closes the part below the picture, which stays. @param button  gets the focus */
  private endBelow(button: string): void {
    this.below = null;
    void this.updateComplete.then(() => (this.renderRoot.querySelector<HTMLElement>(`#${button}:not([hidden])`) ?? this.picture)?.focus());
  }

  /** Shows the quantities of the model, or closes them. */
  openQuantities(): void {
    if (this.below === "quantities") return this.endBelow("quantities");
    this.show("quantities");
    void this.loaded<QuantitiesPanel>("svt-quantities", () => import("./quantities/quantities_panel")).then(async (panel) => {
      await panel?.updateComplete;
      panel?.focus();
    });
  }

  private keyDown(event: KeyboardEvent): void {
    const dialogs = this.renderRoot.querySelectorAll<HelpDialog | CommandPalette | ContextMenu>("svt-help, svt-palette, svt-menu");
    if ([...dialogs].some((dialog) => dialog.isOpen)) return;
    const target = event.composedPath()[0] as HTMLElement;
    const isTyping = target.matches?.("input:not([type=checkbox]), textarea, select") || target.isContentEditable;
    if (event.key === "Escape") return this.leave(isTyping ? target : null);
    if (movedByArrow(event)) return event.preventDefault();
    if (event.altKey || event.defaultPrevented) return;
    const action = actionOfKey(actionsOf(this), event);
    // In fields, only the palette: all other keys are text, or steps of the field.
    if (!action || (isTyping && action.id !== "palette")) return;
    event.preventDefault();
    action.run();
  }

  /** The element that a part of the page becomes once its script has come. */
  private async loaded<Element extends HTMLElement>(name: string, script: () => Promise<unknown>): Promise<Element | null> {
    try {
      await script();
      return this.renderRoot.querySelector<Element>(name);
    } catch (error) {
      this.session.messages.fail(error);
      return null;
    }
  }

  openPalette(): void {
    void this.loaded<CommandPalette>("svt-palette", () => import("./panels/command_palette")).then((palette) =>
      palette?.show(actionsOf(this)),
    );
  }

  /** Shows the table of objects, or closes it. */
  openTable(): void {
    if (this.below === "table") return this.endBelow("table");
    this.show("table");
    void this.loaded("svt-table", () => import("./panels/object_table"));
  }

  openFour(): void {
    this.isFourShown = !this.isFourShown;
    if (this.isFourShown) void this.loaded("svt-section-panes", () => import("./canvas/section_panes"));
    else this.picture?.focus();
  }

  private readonly pickedInPicture = (event: PickEvent): void => {
    const { pick } = event.detail;
    const { selection } = this.session;
    if (selection.isMore) {
      event.preventDefault();
      selection.picked(pick, true);
    }
    const { x, y } = event.detail;
    if (this.session.view.state.field) void import("./fields/probe").then(({ probeOf }) => probeOf(this.session).take(x, y));
    if (pick) this.renderRoot.querySelector<SectionPanes>("svt-section-panes")?.moveTo?.(pick.point);
  };

  private async openMenu({ detail }: MenuRequest): Promise<void> {
    const { session } = this;
    const menu = await this.loaded<ContextMenu>("svt-menu", () => import("./panels/context_menu"));
    await menu?.show(menuActions(session, detail.inPicture ?? null), nameOfSelection(session), detail);
  }

  pressInTool(tool: Tool, selector: string): void {
    if (this.session.view.tool !== tool) this.toggleTool(tool);
    void this.updateComplete.then(async () => {
      const part = this.renderRoot.querySelector<Part>(`#card svt-${tool}-tool`);
      await part?.updateComplete;
      for (const root of part ? [part.renderRoot, ...nestedRoots(part.renderRoot)] : []) pressed(root.querySelector<HTMLElement>(selector));
    });
  }

  search(): void {
    if (!this.isTreeShown) this.showSheet("tree");
    void this.updateComplete.then(() => this.renderRoot.querySelector<TreePanel>("svt-tree")?.focusSearch());
  }

  private leave(typing: HTMLElement | null): void {
    const { session } = this;
    if (typing) {
      typing.blur();
      this.picture?.focus();
    } else if (session.model.opening) session.model.cancelOpening();
    else if (session.view.aim) session.view.aim = null;
    else if (session.messages.message) this.dismiss();
    else if (session.view.tool) this.endTool(session.view.tool);
    else if (this.isFourShown) this.openFour();
    else if (session.view.isWalking) setWalking(session, false);
    else if (session.model.refining.progress) session.model.refining.stop();
    else if (!this.session.selection.isEmpty) {
      session.selection.along = null;
      session.selection.select([]);
    }
  }
}
customElements.define("svt-app", App);

/** As by a key: the focus is there, too. */
function pressed(control: HTMLElement | null): void {
  control?.focus();
  control?.click();
}

const isTouch = () => matchMedia("(pointer: coarse)").matches;

/** Roots of the parts inside a part. */
function nestedRoots(root: ParentNode): ShadowRoot[] {
  return [...root.querySelectorAll("*")].flatMap((element) => element.shadowRoot ?? []);
}
