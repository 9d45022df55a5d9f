/** The picture of the ground behind the picture of the model, as the camera sees it, and its source. */

import { css, html, nothing } from "lit";
import { Part } from "../ui/part";
import { groundMatrix, isAbove, type Ground } from "./ground";

/** Colours of the background of each look at the top and at the bottom (applyLook() in svt/illustrate/scene/scene.cpp). */
const kBackgrounds = {
  plain: ["#fff", "#fff"],
  paper: ["#fff", "#fff"],
  blueprint: ["#133873", "#0e2b5e"],
  dark: ["#17191f", "#0d0e11"],
} as const;

export class GroundLayer extends Part {
  static override styles = css`
    :host { position: absolute; inset: 0; overflow: hidden; pointer-events: none; }
    canvas { position: absolute; left: 0; top: 0; transform-origin: 0 0; backface-visibility: visible; }
    /* Above the tools. */
    .source { position: absolute; right: 12px; bottom: 84px; max-width: calc(100% - 24px); padding: 1px 6px; border-radius: 4px; background: #fffc; color: #333; font: 11px var(--sans); overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
    @media (max-width: 759px) { .source { right: 6px; bottom: 4px; max-width: calc(100% - 76px); } }
  `;

  override render() {
    const { view, picture } = this.session;
    const { ground } = view;
    if (!ground) return nothing;
    // Read here, so that the layer follows the picture and the look.
    void [picture.camera, view.now.look, view.size];
    return html`${ground.picture}<div class="source" id="ground-source">${ground.attribution}</div>`;
  }

  override updated(): void {
    const { view } = this.session;
    const { ground } = view;
    const [top, bottom] = kBackgrounds[view.now.look];
    this.style.background = `linear-gradient(${top}, ${bottom})`;
    if (ground) this.place(ground);
  }

  private place(ground: Ground): void {
    const { picture, volume } = this.session;
    const { camera } = picture;
    const origin = volume.info?.origin;
    const { style } = ground.picture;
    style.display = origin && isAbove(camera, ground.height - origin[2]) ? "" : "none";
    if (!origin || !camera) return;
    const { clientWidth, clientHeight } = this;
    style.transform = `matrix3d(${groundMatrix(ground, origin, camera, [clientWidth, clientHeight], volume.box.axes).join()})`;
  }
}
customElements.define("svt-ground", GroundLayer);
