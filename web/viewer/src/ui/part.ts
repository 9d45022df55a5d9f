/** A part of the page. It renders again when an observable value that its last rendering read changes. */

import { css, LitElement } from "lit";
import { effect } from "../observable";
import type { Session } from "../session";

export abstract class Part extends LitElement {
  static override properties = { session: { attribute: false } };
  declare session: Session;
  private unwatch: () => void = () => {};

  protected override performUpdate(): void {
    if (!this.isUpdatePending) return;
    this.unwatch();
    let isRendered = false;
    this.unwatch = effect(() => {
      if (isRendered) return this.requestUpdate();
      isRendered = true;
      super.performUpdate();
    });
    // A part that was removed before its rendering does not observe anything.
    if (!this.isConnected) this.unwatch();
  }

  override connectedCallback(): void {
    super.connectedCallback();
    this.requestUpdate();
  }
  override disconnectedCallback(): void {
    this.unwatch();
    super.disconnectedCallback();
  }
}

/** Common styles of controls in all parts. */
export const controls = css`
  :host { box-sizing: border-box; color: var(--text); }
  *, *::before, *::after { box-sizing: border-box; }
  [hidden] { display: none !important; }
  button, input, select, textarea { font: inherit; color: inherit; }
  input[type="number"] { appearance: textfield; }
  input[type="number"]::-webkit-inner-spin-button { appearance: none; margin: 0; }
  button {
    display: inline-flex; align-items: center; justify-content: center; gap: 6px; min-height: 32px; padding: 4px 10px;
    border: 1px solid var(--line); border-radius: 8px; background: var(--panel); cursor: pointer; white-space: nowrap;
  }
  button:hover { background: var(--hover); }
  button:disabled { opacity: 0.55; cursor: default; background: var(--panel); }
  button.bare { border-color: transparent; background: transparent; padding: 4px; min-width: 32px; }
  button.bare:hover { background: var(--hover); }
  button.loud { background: var(--accent); border-color: var(--accent); color: var(--on-accent); }
  button.loud:hover { filter: brightness(1.07); }
  button[aria-pressed="true"], button[aria-checked="true"], button[aria-selected="true"] {
    background: var(--accent-soft); border-color: var(--accent); color: var(--accent-text);
  }
  :focus-visible { outline: 2px solid var(--focus); outline-offset: 1px; }
  input:not([type="checkbox"], [type="range"]), select, textarea {
    width: 100%; min-height: 34px; padding: 5px 10px; border: 1px solid var(--line-strong); border-radius: 8px;
    background: var(--field);
  }
  ::placeholder { color: var(--quiet); opacity: 1; }
  select { padding-right: 6px; }
  textarea { font-family: var(--mono); font-size: 12px; line-height: 1.45; resize: vertical; }
  input[type="checkbox"] { width: 16px; height: 16px; margin: 0; accent-color: var(--accent); }
  label.check { display: flex; align-items: center; gap: 8px; min-height: 32px; cursor: pointer; }
  .row { display: flex; align-items: center; gap: 8px; flex-wrap: wrap; }
  .row > .grow { flex: 1; min-width: 0; }
  .quiet { color: var(--quiet); }
  .small { font-size: 12px; }
  .error { color: var(--error); font-size: 12px; overflow-wrap: anywhere; }
  h2, h3 { margin: 0; font-weight: 600; }
  h2 { font-size: 14px; }
  h3 { font-size: 12px; color: var(--quiet); font-weight: 600; margin: 14px 0 6px; }
  p { margin: 0; }
  .segments { display: inline-flex; border: 1px solid var(--line-strong); border-radius: 8px; overflow: hidden; max-width: 100%; }
  .segments button { border: 0; border-radius: 0; flex: 1; }
  .segments button + button { border-left: 1px solid var(--line); }
  .segments :focus-visible { outline-offset: -2px; }
  wa-slider::part(label) {
    position: absolute; width: 1px; height: 1px; margin: 0; overflow: hidden; clip-path: inset(50%); white-space: nowrap;
  }
  @media (max-width: 759px), (pointer: coarse) {
    button, select, input:not([type="checkbox"], [type="range"]), label.check { min-height: 44px; }
    button, button.bare, .segments button { min-width: 44px; }
    button.small, .drawings button, button.go { min-height: 44px !important; }
    input[type="checkbox"] { width: 22px; height: 22px; }
    wa-slider { min-height: 44px; display: grid; align-content: center; --thumb-width: 24px; --thumb-height: 24px; }
    wa-slider::part(slider) { margin-block: 0; padding-block: 20px; }
    .segments { display: flex; }
  }
  .visually-hidden { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap; }
`;
