/** The inside of the element before and around the picture: poster, progress, message. It needs no other module. */

import palette from "../ui/palette.css?inline";

const kStyles = `
  :host { display: block; position: relative; overflow: hidden; aspect-ratio: 16 / 9; min-width: 0; contain: content; }
  :host([hidden]) { display: none; }
  .svt-frame { position: absolute; inset: 0; font: 14px/1.4 var(--sans); color: var(--text); background: var(--stage); }
  .svt-frame.clear { background: none; }
  .svt-frame > * { position: absolute; box-sizing: border-box; }
  [hidden] { display: none !important; }
  .stage { inset: 0; opacity: 0; }
  .stage.shown { opacity: 1; }
  .poster { inset: 0; width: 100%; height: 100%; object-fit: contain; }
  .progress { left: 50%; bottom: 16px; transform: translateX(-50%); width: min(280px, calc(100% - 32px)); padding: 10px 14px; border-radius: 12px; background: var(--panel); border: 1px solid var(--line); box-shadow: var(--shadow); font-size: 13px; overflow-wrap: anywhere; }
  .progress progress { display: block; width: 100%; height: 6px; margin-top: 6px; accent-color: var(--accent); }
  .message { left: 50%; bottom: 16px; transform: translateX(-50%); width: max-content; max-width: min(560px, calc(100% - 24px)); max-height: calc(100% - 24px); overflow: auto; padding: 10px 8px 10px 14px; border-radius: 12px; background: var(--panel); border: 1px solid var(--line); box-shadow: var(--shadow); font-size: 13px; display: flex; gap: 10px; align-items: start; overflow-wrap: anywhere; }
  .message.bad { border-color: var(--error); }
  .message button { font: inherit; color: inherit; background: none; border: 0; border-radius: 8px; min-width: 28px; min-height: 28px; cursor: pointer; }
  .message button:hover { background: var(--hover); }
  .message button:focus-visible { outline: 2px solid var(--focus); }
  .over { inset: 0; pointer-events: none; }
  ::slotted(*) { pointer-events: auto; }
  .said { width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap; }
`;

export interface ShownProgress {
  text: string;
  /** 0 to 1; negative: unknown. */
  share: number;
}

let sheet: CSSStyleSheet | null = null;

/** One sheet for all elements of the page. A content security policy does not concern such sheets. */
function sharedSheet(): CSSStyleSheet {
  if (sheet) return sheet;
  sheet = new CSSStyleSheet();
  sheet.replaceSync(palette + kStyles);
  return sheet;
}

function made<Name extends keyof HTMLElementTagNameMap>(name: Name, part: string): HTMLElementTagNameMap[Name] {
  const element = document.createElement(name);
  element.className = part;
  return element;
}

export class Frame {
  /** The place of the picture. */
  readonly stage = made("div", "stage");
  private readonly frame = made("div", "svt-frame");
  private readonly poster = made("img", "poster");
  private readonly progress = made("div", "progress");
  private readonly message = made("div", "message");
  private readonly said = made("div", "said");

  constructor(root: ShadowRoot) {
    root.adoptedStyleSheets = [sharedSheet()];
    const over = made("div", "over");
    over.append(document.createElement("slot"));
    for (const name of ["stage", "poster", "progress", "message"] as const)
      this[name].setAttribute("part", name === "stage" ? "picture" : name);
    this.progress.setAttribute("role", "status");
    this.said.setAttribute("role", "status");
    this.poster.alt = "";
    this.poster.hidden = this.progress.hidden = this.message.hidden = true;
    this.frame.append(this.poster, this.stage, over, this.progress, this.message, this.said);
    root.append(this.frame);
  }

  set isDark(isDark: boolean) {
    this.frame.classList.toggle("dark", isDark);
  }
  /** The page behind the element is visible where the picture is transparent. */
  set isClear(isClear: boolean) {
    this.frame.classList.toggle("clear", isClear);
  }

  /** The picture replaces the poster. */
  set isShown(isShown: boolean) {
    this.stage.classList.toggle("shown", isShown);
    this.poster.hidden = isShown || !this.poster.hasAttribute("src");
  }

  setPoster(address: string, alt: string): void {
    if (address) this.poster.src = address;
    else this.poster.removeAttribute("src");
    this.poster.alt = alt;
    this.poster.hidden = !address || this.stage.classList.contains("shown");
  }

  showProgress(now: ShownProgress | null): void {
    this.progress.hidden = now === null;
    if (!now) return this.progress.replaceChildren();
    const bar = document.createElement("progress");
    bar.max = 1;
    bar.setAttribute("aria-label", now.text);
    if (now.share >= 0) bar.value = now.share;
    this.progress.replaceChildren(now.text, bar);
  }

  /** @param closed  called by the button that closes the message */
  showMessage(now: { title?: string; text: string; isError: boolean } | null, closeLabel = "Close", closed: () => void = () => {}): void {
    this.message.hidden = now === null;
    if (!now) return this.message.replaceChildren();
    const text = document.createElement("div");
    if (now.title) {
      const title = document.createElement("strong");
      title.append(now.title);
      text.append(title, document.createElement("br"));
    }
    text.append(now.text);
    const close = document.createElement("button");
    close.type = "button";
    close.setAttribute("aria-label", closeLabel);
    close.append("✕");
    close.addEventListener("click", closed);
    this.message.classList.toggle("bad", now.isError);
    this.message.setAttribute("role", now.isError ? "alert" : "status");
    this.message.replaceChildren(text, close);
  }

  /** Text for screen readers. */
  say(text: string): void {
    if (this.said.textContent !== text) this.said.textContent = text;
  }
}
