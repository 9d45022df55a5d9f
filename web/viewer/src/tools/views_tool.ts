/** Named views, projection, walking. */

import { css, html, nothing } from "lit";
import { withProjection } from "../camera/camera";
import { standAt } from "../camera/controls";
import { kSceneMembers } from "../generated/scene_members";
import type { Session } from "../session";
import { kViews } from "../state/member_controls";
import type { Camera } from "../state/view_state";
import { help, t, withUnit } from "../texts";
import { toolHint } from "../tool_texts";
import { icon } from "../ui/icons";
import { memberSlider } from "../ui/member_slider";
import { controls, Part } from "../ui/part";

/** Metres from the floor to the eye. */
const kEyeHeight = 1.65;

/** Walking begins in air, on the storey that contains the height of the view's target; else on the lowest. */
export function setWalking(session: Session, isWalking: boolean): void {
  const { view } = session;
  if (isWalking) view.beginWalking();
  const before = isWalking ? null : view.endWalking();
  if (!view.now.camera) return;
  if (isWalking) void enter(session);
  else void view.goTo("", kSceneMembers["/camera/preset"].default, true, before);
}

async function enter(session: Session): Promise<void> {
  const { info, box, engine } = session.volume;
  const { target } = session.view.state.camera!;
  const storeys = info?.storeys ?? [];
  const storey = storeys.find(({ floor, top }) => target[2] >= floor && target[2] < top) ?? storeys[0];
  const floor = storey?.floor ?? box.low[2];
  const eye = await engine?.stand([target[0], target[1], floor + kEyeHeight]).catch(() => null);
  const { camera } = session.view.state;
  if (!session.view.isWalking || !camera) return;
  if (eye) {
    const standing = await standAt(withProjection(camera, false), eye, (from, by) => engine!.step(from, by));
    return session.view.isWalking ? session.view.moveTo(standing) : undefined;
  }
  session.view.isWalking = false;
  session.messages.tell(t("walkNowhere"));
}

export class ViewsTool extends Part {
  static override styles = [
    controls,
    css`
    .views { display: grid; grid-template-columns: repeat(4, minmax(0, 1fr)); gap: 5px; margin-bottom: 6px; }
    .views button { padding: 4px 2px; gap: 4px; }
    .views kbd { font: inherit; font-size: 11px; color: var(--quiet); }
    @media (pointer: coarse) { .views kbd { display: none; } }
    .line { display: grid; grid-template-columns: 84px 1fr 44px; gap: 10px; align-items: center; min-height: 36px; }
    output { text-align: right; font-variant-numeric: tabular-nums; }
  `,
  ];

  override render() {
    const { session } = this;
    const { parallel, fieldOfView } = session.view.projection;
    return html`
      <div class="views" role="toolbar" aria-label=${t("views")}>${kViews.map(
        (view, n) =>
          html`<button title=${help("/camera/preset")} @click=${() => void session.view.goTo("", view)}>${t(`view_${view}`)} <kbd>${n + 1}</kbd></button>`,
      )}<button @click=${() => void session.view.goTo("", null)}>${icon("fit", 16)} <kbd>0</kbd><span class="visually-hidden">${t("fit")}</span></button></div>
      <div class="row">
        <label class="check" title=${help("/camera/parallel")}><input type="checkbox" id="parallel" .checked=${parallel} ?disabled=${session.view.isWalking}
          @change=${(e: Event) => this.change((camera) => withProjection(camera, (e.target as HTMLInputElement).checked))} />${t("parallel")}</label>
        <label class="check"><input type="checkbox" id="walk" .checked=${session.view.isWalking} @change=${(e: Event) => setWalking(session, (e.target as HTMLInputElement).checked)} />${t("walk")}</label>
      </div>
      ${
        fieldOfView !== null && !parallel
          ? html`<div class="line"><span class="quiet">${t("fieldOfView")}</span>
            ${memberSlider("fieldOfView", t("fieldOfView"), Math.round(fieldOfView), (wanted) => this.change((camera) => ({ ...camera, fieldOfView: wanted })))}
            <output>${withUnit(fieldOfView, 0, kSceneMembers["/camera/fieldOfView"].unit)}</output></div>`
          : nothing
      }
      ${session.view.isWalking ? html`<p class="small quiet">${toolHint("walk")}</p>` : nothing}
    `;
  }

  private change(of: (camera: Camera) => Camera): void {
    const { view } = this.session;
    if (view.state.camera) view.turn(of(view.state.camera));
  }
}
customElements.define("svt-views-tool", ViewsTool);
