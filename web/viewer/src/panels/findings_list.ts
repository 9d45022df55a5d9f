/** The findings in a model, grouped by code; a click selects the feature that a finding names. */

import { css, html, nothing } from "lit";
import { t } from "../texts";
import { lateText } from "../late_texts";
import { controls, Part } from "../ui/part";
import { findingGroups, type FindingGroup } from "./finding_groups";

/** Largest number of findings of one code that are listed. */
const kShown = 100;

export class FindingsList extends Part {
  static override styles = [
    controls,
    css`
      :host { display: block; }
      details { border-top: 1px solid var(--line); }
      summary { cursor: pointer; padding: 7px 0; overflow-wrap: anywhere; }
      ul { list-style: none; margin: 0 0 8px; padding: 0; font-size: 12px; }
      li { overflow-wrap: anywhere; padding: 3px 6px; }
      li button { width: 100%; white-space: normal; text-align: left; justify-content: flex-start; border-color: transparent; background: transparent; padding: 3px 0; overflow-wrap: anywhere; }
      @media (max-width: 759px), (pointer: coarse) { summary { min-height: 44px; padding: 12px 0; } }
    `,
  ];

  override render() {
    const { info, index } = this.session.volume;
    const { findings = [], spacingReason = "" } = info ?? {};
    const groups = findingGroups(findings, index);
    if (!groups.length && !spacingReason) return nothing;
    return html`<h3>${t("findingsTitle")}</h3>
      ${spacingReason ? html`<p class="small">${t("spacingTold", { reason: spacingReason })}</p>` : nothing}
      ${groups.map((group) => this.group(group, groups.length === 1))}`;
  }

  private group({ severity, code, findings }: FindingGroup, isOnly: boolean) {
    const title = code ? `${severity} ${code}` : findings[0]!.text;
    return html`<details data-code=${code.slice(0, 4)} ?open=${isOnly && findings.length <= kShown}>
      <summary>${code ? lateText("findingsOfCode", { code: title, n: findings.length }) : title}</summary>
      <ul>${findings
        .slice(0, kShown)
        .map(({ text, id }) => html`<li>${id === null ? text : html`<button @click=${() => this.select(id)}>${text}</button>`}</li>`)}
        ${findings.length > kShown ? html`<li class="quiet">${lateText("findingsMore", { n: findings.length - kShown })}</li>` : nothing}</ul>
    </details>`;
  }

  private select(id: string): void {
    this.session.selection.select([id]);
    void this.session.view.goToSelected();
  }
}
customElements.define("svt-findings", FindingsList);
