/** The command palette: all actions that are possible now, with a search. */

import { css, html, nothing } from "lit";
import type { Action } from "../actions";
import { lateText } from "../late_texts";
import { moreActions } from "../more_actions";
import { icon } from "../ui/icons";
import { controls, Part } from "../ui/part";
import { keyText } from "./key_text";

export class CommandPalette extends Part {
  static override properties = { ...Part.properties, search: { state: true }, active: { state: true }, actions: { state: true } };
  declare search: string;
  declare active: number;
  declare actions: readonly Action[];

  static override styles = [
    controls,
    css`
      dialog { width: min(560px, calc(100vw - 24px)); max-height: min(70dvh, 620px); margin: 8dvh auto auto; padding: 0; border: 1px solid var(--line); border-radius: 14px; background: var(--panel); color: var(--text); box-shadow: var(--shadow); overflow: hidden; }
      dialog[open] { display: grid; grid-template-rows: auto minmax(0, 1fr); }
      dialog::backdrop { background: #0005; }
      .field { padding: 10px; border-bottom: 1px solid var(--line); }
      ul { list-style: none; margin: 0; padding: 6px; overflow: auto; }
      li { display: flex; gap: 10px; align-items: center; min-height: 34px; padding: 4px 8px; border-radius: 8px; cursor: default; font-size: 13px; }
      li .text { flex: 1; min-width: 0; overflow-wrap: anywhere; }
      li[aria-selected="true"] { background: var(--accent-soft); color: var(--accent-text); }
      kbd { font: inherit; font-size: 11px; border: 1px solid var(--line-strong); border-radius: 5px; padding: 0 5px; white-space: nowrap; }
      .none { padding: 14px; }
      svg { flex: none; }
      @media (pointer: coarse) { kbd { display: none; } }
      @media (max-width: 759px), (pointer: coarse) { li { min-height: 44px; } }
    `,
  ];

  constructor() {
    super();
    this.search = "";
    this.active = 0;
    this.actions = [];
  }

  private get dialog(): HTMLDialogElement {
    return this.renderRoot.querySelector("dialog")!;
  }
  get isOpen(): boolean {
    return this.hasUpdated && this.dialog.open;
  }

  async show(actions: readonly Action[]): Promise<void> {
    this.actions = [...actions, ...moreActions(this.session)].filter(({ id, isEnabled }) => id !== "palette" && (isEnabled?.() ?? true));
    this.search = "";
    this.active = 0;
    await this.updateComplete;
    this.dialog.showModal();
    this.renderRoot.querySelector("input")!.focus();
  }

  /** Actions with all words; first those in which each begins a word. */
  private get found(): Action[] {
    const words = this.search.toLowerCase().split(/\s+/).filter(Boolean);
    const found = this.actions.filter((action) => words.every((word) => action.text().toLowerCase().includes(word)));
    const begins = (action: Action) =>
      words.every((word) => ` ${action.text().toLowerCase()}`.replace(/[^\p{L}\p{N}]+/gu, " ").includes(` ${word}`));
    return [...found.filter(begins), ...found.filter((action) => !begins(action))];
  }

  override render() {
    const { found } = this;
    const active = found.length ? `action-${found[Math.min(this.active, found.length - 1)]!.id}` : nothing;
    return html`<dialog aria-label=${lateText("palette")} @click=${(e: Event) => e.target === this.dialog && this.close()} @close=${() => this.requestUpdate()}>
      <div class="field"><input type="search" role="combobox" autocomplete="off" spellcheck="false" aria-label=${lateText("paletteSearch")} placeholder=${lateText("paletteSearch")}
        aria-expanded="true" aria-controls="found" aria-activedescendant=${active} .value=${this.search}
        @input=${(e: Event) => ((this.search = (e.target as HTMLInputElement).value), (this.active = 0))} @keydown=${this.key} />
        <div class="visually-hidden" role="status">${found.length ? lateText("paletteFound", { n: found.length }) : lateText("paletteNothing")}</div></div>
      <ul id="found" role="listbox" tabindex="-1" aria-label=${lateText("palette")}>${
        found.length
          ? found.map((action) => this.row(action, `action-${action.id}` === active))
          : html`<li class="none quiet" role="option" aria-selected="false" aria-disabled="true">${lateText("paletteNothing")}</li>`
      }</ul></dialog>`;
  }

  private row(action: Action, isActive: boolean) {
    const [key] = action.keys ?? [];
    return html`<li id="action-${action.id}" role="option" aria-selected=${isActive} @click=${() => this.run(action)}>
      ${icon(action.icon ?? "part", 16)}<span class="text">${action.text()}</span>${key ? html`<kbd>${keyText(key)}</kbd>` : nothing}</li>`;
  }

  private readonly key = (event: KeyboardEvent): void => {
    // The page's own keys must not act behind the dialog.
    event.stopPropagation();
    const { found } = this;
    const last = found.length - 1;
    const to = {
      ArrowDown: this.active + 1,
      ArrowUp: this.active - 1,
      PageDown: Math.min(last, this.active + 8),
      PageUp: Math.max(0, this.active - 8),
    }[event.key];
    if (event.key === "Escape") this.close();
    else if (event.key === "Enter" && found[this.active]) this.run(found[this.active]!);
    else if (to !== undefined) this.active = to > last ? 0 : to < 0 ? last : to;
    else return;
    event.preventDefault();
  };

  override updated(): void {
    this.renderRoot.querySelector("[aria-selected=true]")?.scrollIntoView({ block: "nearest" });
  }

  private close(): void {
    // The field must not take keys until the browser notices that it is hidden.
    this.renderRoot.querySelector("input")!.blur();
    this.dialog.close();
    // Without an element that had the focus before, keys are for the picture.
    if (document.activeElement === document.body) (this.getRootNode() as ShadowRoot).querySelector<HTMLElement>("svt-picture")?.focus();
  }

  private run(action: Action): void {
    this.close();
    action.run();
  }
}
customElements.define("svt-palette", CommandPalette);
