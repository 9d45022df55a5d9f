/** Arrows over the picture that walk as long as they are held: for fingers, which have no keys. */

import { css, html } from "lit";
import { pressOnPicture } from "../canvas/picture_keys";
import { lateText, type LateTextKey } from "../late_texts";
import { icon, type IconName } from "../ui/icons";
import { controls, Part } from "../ui/part";

/** Milliseconds of a step by a key or a screen reader. */
const kStep = 300;
/** In the order of the grid. */
const kArrows: readonly { key: string; text: LateTextKey; name: IconName }[] = [
  { key: "e", text: "walkUp", name: "plus" },
  { key: "w", text: "walkForward", name: "down" },
  { key: "q", text: "walkDown", name: "down" },
  { key: "a", text: "walkLeft", name: "previous" },
  { key: "s", text: "walkBack", name: "down" },
  { key: "d", text: "walkRight", name: "right" },
];

export class WalkPad extends Part {
  private held = new Map<number, string>();

  static override styles = [
    controls,
    css`
      :host { position: absolute; right: 10px; bottom: 90px; z-index: 3; }
      @media (max-width: 759px) { :host { bottom: 10px; } }
      div { display: grid; grid-template-columns: repeat(3, 52px); gap: 4px; }
      button { min-height: 52px; border-radius: 12px; padding: 0; touch-action: none; user-select: none; -webkit-touch-callout: none; box-shadow: var(--shadow); }
      button:active { background: var(--accent-soft); }
      [data-key="w"] svg { transform: rotate(180deg); }
      .far { font-size: 12px; }
    `,
  ];

  override disconnectedCallback(): void {
    for (const key of this.held.values()) pressOnPicture(this, "keyup", key);
    super.disconnectedCallback();
  }

  override render() {
    return html`<div role="group" aria-label=${lateText("walkPad")} @contextmenu=${(e: Event) => e.preventDefault()}>${kArrows.map(
      ({ key, text, name }) => html`<button aria-label=${lateText(text)} title=${lateText(text)} data-key=${key}
        @pointerdown=${(e: PointerEvent) => this.press(e, key)} @pointerup=${this.release} @pointercancel=${this.release} @lostpointercapture=${this.release}
        @click=${(e: MouseEvent) => e.detail === 0 && this.step(key)}>${key === "e" || key === "q" ? html`<span class="far">${lateText(text)}</span>` : icon(name, 22)}</button>`,
    )}</div>`;
  }

  private press(event: PointerEvent, key: string): void {
    // The picture keeps the focus: without it, walking would end.
    event.preventDefault();
    try {
      (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
    } catch {
      // A pointer that is already gone cannot be captured.
    }
    this.held.set(event.pointerId, key);
    pressOnPicture(this, "keydown", key);
  }

  private readonly release = (event: PointerEvent): void => {
    const key = this.held.get(event.pointerId);
    this.held.delete(event.pointerId);
    if (key) pressOnPicture(this, "keyup", key);
  };

  private step(key: string): void {
    pressOnPicture(this, "keydown", key);
    setTimeout(() => pressOnPicture(this, "keyup", key), kStep);
  }
}
customElements.define("svt-walk-pad", WalkPad);
