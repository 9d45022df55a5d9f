/** The context menu of the selected features, in the picture and in the tree. */

import { css, html, nothing } from "lit";
import type { Action } from "../actions";
import { lateText } from "../late_texts";
import { icon } from "../ui/icons";
import { controls, Part } from "../ui/part";
import { keyText } from "./key_text";

/** Distance to the borders of the window, pixels. */
const kBorder = 6;

export class ContextMenu extends Part {
  static override properties = { ...Part.properties, actions: { state: true }, name: { state: true } };
  declare actions: readonly Action[];
  /** Name of the features. */
  declare name: string;
  private focusedBefore: HTMLElement | null = null;
  /** The pointer was pressed inside the menu: the lifted finger of the long press that opened it chooses nothing. */
  private isPressed = false;

  static override styles = [
    controls,
    css`
      :host { position: static; }
      [role="menu"] { position: fixed; inset: auto; margin: 0; padding: 5px; min-width: 220px; max-width: min(340px, calc(100vw - 12px)); max-height: calc(100dvh - 12px); overflow: auto; border: 1px solid var(--line); border-radius: 10px; background: var(--panel); color: var(--text); box-shadow: var(--shadow); font-size: 13px; }
      .title { padding: 4px 8px 6px; font-size: 12px; color: var(--quiet); overflow-wrap: anywhere; border-bottom: 1px solid var(--line); margin-bottom: 4px; }
      button { width: 100%; justify-content: flex-start; gap: 10px; border-color: transparent; background: transparent; white-space: normal; text-align: left; }
      button span { flex: 1; overflow-wrap: anywhere; }
      button:focus { background: var(--accent-soft); color: var(--accent-text); outline: none; }
      kbd { font: inherit; font-size: 11px; color: var(--quiet); }
      @media (pointer: coarse) { kbd { display: none; } }
      svg { flex: none; }
    `,
  ];

  constructor() {
    super();
    this.actions = [];
    this.name = "";
  }

  override connectedCallback(): void {
    super.connectedCallback();
    addEventListener("pointerdown", this.pressedElsewhere, true);
  }
  override disconnectedCallback(): void {
    removeEventListener("pointerdown", this.pressedElsewhere, true);
    super.disconnectedCallback();
  }

  /** A popover that closes itself would close when the finger of a long press is lifted. */
  private readonly pressedElsewhere = (event: Event): void => {
    this.isPressed = this.isOpen && event.composedPath().includes(this.menu);
    if (!this.isOpen || this.isPressed) return;
    // As with menus of the system, this press only closes the menu.
    event.stopPropagation();
    this.menu.hidePopover();
  };

  private get menu(): HTMLElement {
    return this.renderRoot.querySelector("[role=menu]")!;
  }
  get isOpen(): boolean {
    return this.hasUpdated && this.menu.matches(":popover-open");
  }

  /** @param at  position in the window, pixels */
  async show(actions: readonly Action[], name: string, at: { x: number; y: number }): Promise<void> {
    if (!this.isOpen) this.focusedBefore = focused();
    this.isPressed = false;
    this.actions = actions;
    this.name = name;
    await this.updateComplete;
    const { menu } = this;
    if (!this.isOpen) menu.showPopover();
    const { width, height } = menu.getBoundingClientRect();
    menu.style.left = `${Math.max(kBorder, Math.min(at.x, innerWidth - width - kBorder))}px`;
    menu.style.top = `${Math.max(kBorder, Math.min(at.y, innerHeight - height - kBorder))}px`;
    this.items[0]?.focus();
  }

  private get items(): HTMLElement[] {
    return [...this.renderRoot.querySelectorAll<HTMLElement>("[role=menuitem]")];
  }

  override render() {
    return html`<div role="menu" popover="manual" aria-label=${lateText("menuOf", { name: this.name })} @keydown=${this.key}>
      <div class="title" role="presentation">${this.name}</div>
      ${this.actions.map(
        (
          action,
        ) => html`<button role="menuitem" tabindex="-1" data-action=${action.id} @click=${(e: MouseEvent) => (e.detail === 0 || this.isPressed) && this.run(action)}>
          ${icon(action.icon ?? "part", 16)}<span>${action.text()}</span>${action.keys?.[0] ? html`<kbd>${keyText(action.keys[0])}</kbd>` : nothing}</button>`,
      )}</div>`;
  }

  private readonly key = (event: KeyboardEvent): void => {
    // The page's own keys must not act behind the menu.
    event.stopPropagation();
    const { items } = this;
    const at = items.findIndex((item) => item.matches(":focus"));
    const to = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: items.length - 1 }[event.key];
    if (to !== undefined) items[(to + items.length) % items.length]!.focus();
    else if (event.key === "Escape" || event.key === "Tab") this.close();
    else return;
    event.preventDefault();
  };

  private close(): void {
    this.menu.hidePopover();
    this.focusedBefore?.focus();
  }

  private run(action: Action): void {
    this.close();
    action.run();
  }
}
customElements.define("svt-menu", ContextMenu);

function focused(): HTMLElement | null {
  let active = document.activeElement;
  while (active?.shadowRoot?.activeElement) active = active.shadowRoot.activeElement;
  return active instanceof HTMLElement ? active : null;
}
