/** Choice of the context around a lens or a highlight. */

import { html } from "lit";
import type { Context } from "../engine";
import { t } from "../texts";

const kTexts = { ghost: "contextGhost", shell: "contextShell", solid: "contextSolid", none: "contextNone" } as const;

export function contextChoice(value: Context, change: (context: Context) => void) {
  return html`<h3 id="context">${t("context")}</h3>
    <div class="segments" role="radiogroup" aria-labelledby="context">${(["ghost", "shell", "solid", "none"] as const).map(
      (context) =>
        html`<button role="radio" aria-checked=${value === context} @click=${() => change(context)}>${t(kTexts[context])}</button>`,
    )}</div>`;
}
