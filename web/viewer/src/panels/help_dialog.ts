/** Mouse, touch and keys. */

import { css, html } from "lit";
import { isLateText, lateText, type LateTextKey } from "../late_texts";
import { t, type TextKey } from "../texts";
import { toolText } from "../tool_texts";
import { controls, Part } from "../ui/part";

const kRows = [
  ["keyOrbit", "keyOrbitHow"],
  ["keyPan", "keyPanHow"],
  ["keyZoom", "keyZoomHow"],
  ["keyPick", "keyPickHow"],
  ["keyRectangle", "keyRectangleHow"],
  ["keyAlong", "keyAlongHow"],
  ["keyMenu", "keyMenuHow"],
  ["keyFrame", "keyFrameHow"],
  ["keyFit", "keyFitHow"],
  ["keyViews", "keyViewsHow"],
  ["keyCube", "keyCubeHow"],
  ["keyTools", "keyToolsHow"],
  ["keyCross", "keyCrossHow"],
  ["keyHide", "keyHideHow"],
  ["keyUndo", "keyUndoHow"],
  ["keySearch", "keySearchHow"],
  ["keyTree", "keyTreeHow"],
  ["keyActions", "keyActionsHow"],
  ["keyTable", "keyTableHow"],
  ["keyFour", "keyFourHow"],
  ["walk", "walkHint"],
  ["keyLeave", "keyLeaveHow"],
] as const;

const textOf = (key: TextKey | LateTextKey | "walkHint"): string =>
  key === "walkHint" ? toolText(key) : isLateText(key) ? lateText(key) : t(key);

export class HelpDialog extends Part {
  static override styles = [
    controls,
    css`
    dl { display: grid; grid-template-columns: minmax(110px, auto) 1fr; gap: 8px 18px; margin: 0; font-size: 13px; line-height: 1.45; }
    dt { font-weight: 600; }
    dd { margin: 0; color: var(--quiet); }
    wa-dialog { --width: 560px; }
    wa-dialog:not(:defined) { display: none; }
  `,
  ];

  private get dialog() {
    return this.renderRoot.querySelector<HTMLElement & { open: boolean }>("wa-dialog");
  }
  get isOpen(): boolean {
    return this.dialog?.open ?? false;
  }
  async show(): Promise<void> {
    await this.updateComplete;
    if (this.dialog) this.dialog.open = true;
  }

  override render() {
    return html`<wa-dialog label=${t("helpTitle")} light-dismiss>
      <dl>${kRows.map(([what, how]) => html`<dt>${textOf(what)}</dt><dd>${textOf(how)}</dd>`)}</dl>
    </wa-dialog>`;
  }
}
customElements.define("svt-help", HelpDialog);
