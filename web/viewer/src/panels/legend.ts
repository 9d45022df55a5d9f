/** The classes in the picture, with their colours. */

import { css, html } from "lit";
import { classText } from "../state/class_words";
import { ofClass } from "../state/queries";
import { t } from "../texts";
import { Part } from "../ui/part";

export class Legend extends Part {
  static override styles = css`
    :host { display: block; padding: 8px 12px; border: 1px solid var(--line); border-radius: 10px; background: var(--panel); font-size: 12px; max-height: 40vh; overflow: auto; }
    ul { list-style: none; margin: 0; padding: 0; display: grid; gap: 4px; }
    li { display: flex; gap: 8px; align-items: center; }
    .swatches { display: flex; gap: 2px; width: 54px; flex: none; justify-content: flex-end; }
    span.swatch { width: 12px; height: 12px; border-radius: 3px; border: 1px solid #0003; flex: none; }
  `;

  override render() {
    const { volume, view } = this.session;
    const { index } = volume;
    const { hidden, now } = view;
    const rows = [...index.classes].flatMap(([name, members]) => {
      const seen = members.filter((i) => index.features[i]!.count > 0 && !hidden[i]);
      if (!seen.length) return [];
      const style = now.styles.find((s) => s.select === ofClass(name) && s.color);
      const colors = style?.color ? [style.color] : mostUsed(seen.map((i) => index.features[i]!.color));
      return [{ name, colors }];
    });
    return html`<ul aria-label=${t("legend")}>${rows.map(
      ({ name, colors }) =>
        html`<li><span class="swatches">${colors.map((color) => html`<span class="swatch" data-color=${color}></span>`)}</span><span title=${name}>${classText(name)}</span></li>`,
    )}</ul>`;
  }

  override updated(): void {
    this.renderRoot.querySelectorAll<HTMLElement>("[data-color]").forEach((e) => (e.style.background = e.dataset["color"]!));
  }
}
customElements.define("svt-legend", Legend);

/** The most frequent colours first, as many as fit. */
function mostUsed(colors: string[]): string[] {
  const uses = new Map<string, number>();
  for (const color of colors) uses.set(color, (uses.get(color) ?? 0) + 1);
  return [...uses]
    .sort((a, b) => b[1] - a[1])
    .slice(0, 4)
    .map(([color]) => color);
}
