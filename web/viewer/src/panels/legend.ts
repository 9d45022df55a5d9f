/** The classes that the picture shows, with their colours. */

import { css, html } from "lit";
import { ofClass } from "../state/queries";
import { SeenCounts } from "../state/visibility";
import { t } from "../texts";
import { Part } from "../ui/part";

export class Legend extends Part {
  static override styles = css`
    :host { display: block; padding: 8px 12px; border: 1px solid var(--line); border-radius: 10px; background: var(--panel); font-size: 12px; max-height: 40vh; overflow: auto; }
    ul { list-style: none; margin: 0; padding: 0; display: grid; gap: 4px; }
    li { display: flex; gap: 8px; align-items: center; }
    span.swatch { width: 12px; height: 12px; border-radius: 3px; border: 1px solid #0003; flex: none; }
  `;

  protected override uses() {
    const { index, hidden, state } = this.session;
    return [index, hidden, state.styles];
  }

  override render() {
    const { index, hidden, state } = this.session;
    const counts = new SeenCounts(index, hidden);
    const rows = [...index.classes].flatMap(([name, members]) => {
      const first = members.find((i) => index.features[i]!.count > 0);
      if (first === undefined || counts.ofMembers(members) === "none") return [];
      const style = state.styles.find((s) => s.select === ofClass(name) && s.color);
      return [{ name, color: style?.color ?? index.features[first]!.color }];
    });
    return html`<ul aria-label=${t("legend")}>${rows.map(({ name, color }) => html`<li><span class="swatch" data-color=${color}></span>${name}</li>`)}</ul>`;
  }

  override updated(): void {
    this.renderRoot.querySelectorAll<HTMLElement>("[data-color]").forEach((e) => (e.style.background = e.dataset["color"]!));
  }
}
customElements.define("svt-legend", Legend);
