/** A basemap below the model: a picture of the user, or tiles from an address of the user. Nothing is fetched before. */

import { css, html, nothing } from "lit";
import { corners } from "../camera/camera";
import { number } from "../texts";
import { controls, Part } from "../ui/part";
import { attributionOf, fetchPicture, fetchTiles } from "./fetching";
import { boundsOf, Ground, groundAround, lowestOf, pixelAt, placeIn, type Pair, type Place } from "./ground";
import "./ground_layer";
import { kPictureKinds, kWorldFileKinds, readPicture, type PlacedPicture } from "./image_files";
import { isTemplate, metresOf } from "./mercator";
import { basemapText } from "./texts";
import { meshOf, warped } from "./warp";

const kSystems = ["model", "3857", "4326"] as const;
type System = (typeof kSystems)[number];

export class BasemapChoice extends Part {
  static override properties = { ...Part.properties, system: { state: true }, isBusy: { state: true }, note: { state: true } };
  declare system: System;
  declare isBusy: boolean;
  /** The missing information; empty: none. */
  declare note: string;
  /** A chosen picture whose place is not known yet. */
  private chosen: PlacedPicture | null = null;

  static override styles = [
    controls,
    css`
      :host { display: grid; gap: 8px; }
      label.field { display: grid; gap: 3px; font-size: 12px; color: var(--quiet); }
      .line { display: grid; grid-template-columns: 52px 1fr auto; gap: 10px; align-items: center; min-height: 34px; }
      output { min-width: 62px; text-align: right; font-variant-numeric: tabular-nums; }
    `,
  ];

  constructor() {
    super();
    this.system = "model";
    this.isBusy = false;
    this.note = "";
  }

  override render() {
    const { ground } = this.session.view;
    const crs = this.session.volume.info?.crs;
    return html`<button id="basemap-files" title=${basemapText("basemapFilesHint")} ?disabled=${this.isBusy} @click=${() => this.input("file").click()}>${basemapText("basemapFiles")}</button>
      <input id="basemap-file" type="file" hidden multiple accept="${kPictureKinds},${kWorldFileKinds}" aria-label=${basemapText("basemapFilesHint")} @change=${this.filesChosen} />
      ${this.field("address", basemapText("basemapAddress", { x: "{x}", y: "{y}", z: "{z}" }), "https://…/{z}/{x}/{y}.png")}
      ${this.field("extent", basemapText("basemapExtent"), "")}
      <label class="field">${basemapText("basemapSystem")}<select id="basemap-system" @change=${(e: Event) => (this.system = (e.target as HTMLSelectElement).value as System)}>${kSystems.map(
        (system) =>
          html`<option value=${system} ?selected=${system === this.system}>${basemapText(`system_${system}`, { crs: crs ? ` (${crs})` : "" })}</option>`,
      )}</select></label>
      ${this.field("attribution", basemapText("basemapAttribution"), "")}
      ${this.note ? html`<p class="small" role="status" id="basemap-note">${this.note}</p>` : nothing}
      <div class="row"><button id="basemap-show" class="loud" ?disabled=${this.isBusy} @click=${() => void this.show()}>${basemapText(this.isBusy ? "basemapBusy" : "basemapShow")}</button>
        ${ground ? html`<button id="basemap-remove" @click=${() => this.session.view.lay(null)}>${basemapText("basemapRemove")}</button>` : nothing}</div>
      ${ground ? this.height() : nothing}
      <p class="small quiet">${basemapText("basemapPrivacy")}</p>`;
  }

  private field(name: string, label: string, placeholder: string) {
    return html`<label class="field">${label}<input id="basemap-${name}" placeholder=${placeholder} spellcheck="false" autocomplete="off" @keydown=${(
      e: KeyboardEvent,
    ) => {
      if (e.key === "Enter") void this.show();
    }} /></label>`;
  }

  private height() {
    const { view, volume } = this.session;
    const { ground } = view;
    const { origin } = volume.info!;
    const all = corners(volume.box).map((p) => p[2] + origin[2]);
    const [low, high] = [Math.min(...all), Math.max(...all)];
    const label = basemapText("basemapHeight"),
      text = `${number(ground!.height, 2)} m`;
    return html`<div class="line" title=${basemapText("basemapHeightHint")}><span class="quiet">${label}</span>
      <wa-slider size="s" id="basemap-height" label=${label} aria-label="${label}: ${text}" min=${low} max=${high} step=${(high - low) / 200} .value=${ground!.height}
        @input=${(e: Event) => view.lay(view.ground!.at(Number((e.target as HTMLInputElement).value)))}></wa-slider><output>${text}</output></div>`;
  }

  private input(name: string): HTMLInputElement {
    return this.renderRoot.querySelector(`#basemap-${name}`)!;
  }
  private typed(name: string): string {
    return this.input(name).value.trim();
  }

  private readonly filesChosen = (event: Event): void => {
    const input = event.target as HTMLInputElement;
    const files = [...(input.files ?? [])];
    input.value = "";
    if (!files.length) return;
    void this.busy(async () => {
      this.chosen = await readPicture(files);
      this.input("address").value = "";
      await this.layPicture(this.chosen, this.typed("attribution") || this.chosen.name);
    });
  };

  private async busy(work: () => Promise<void>): Promise<void> {
    if (this.isBusy) return;
    this.isBusy = true;
    this.note = "";
    const { messages } = this.session;
    messages.message = null;
    try {
      await work();
    } catch (error) {
      messages.fail(error, basemapText("basemapFailed"));
    } finally {
      this.isBusy = false;
    }
  }

  private show(): Promise<void> {
    return this.busy(async () => {
      const address = this.typed("address");
      if (!address && this.chosen) return this.layPicture(this.chosen, this.typed("attribution") || this.chosen.name);
      if (!address) throw { message: basemapText("badAddress", { address }) };
      const attribution = this.typed("attribution") || attributionOf(address);
      if (!isTemplate(address)) return this.layPicture(await fetchPicture(address), attribution);
      const bounds = this.around();
      const picture = await fetchTiles(address, bounds, (points) => this.places(points));
      this.lay(picture, placeIn(bounds, [picture.width, picture.height]), attribution);
    });
  }

  private around(): [number, number, number, number] {
    const { box, info } = this.session.volume;
    return groundAround(corners(box), info!.origin);
  }

  /** Longitude and latitude of coordinates of the model. */
  private async places(points: Pair[]): Promise<Pair[]> {
    try {
      return await this.session.volume.engine!.places(points);
    } catch (error) {
      throw { message: basemapText("noSystem", { reason: (error as { message: string }).message }) };
    }
  }

  private async layPicture(found: PlacedPicture, attribution: string): Promise<void> {
    const { picture, name } = found;
    const size: Pair = [picture.width, picture.height];
    const extent = this.typed("extent");
    const place = extent ? placeIn(numbersOf(extent), size) : found.place;
    if (!place) {
      this.note = basemapText("needsExtent", { name });
      await this.updateComplete;
      this.input("extent").focus();
      return;
    }
    const system = extent || !found.epsg ? this.system : this.systemOf(found.epsg);
    if (system === "model") return this.lay(picture, place, attribution);
    const bounds = this.around();
    const mesh = await this.places(meshOf(bounds));
    const pixels = mesh.map((at) => pixelAt(place, system === "3857" ? metresOf(at) : at));
    this.checkNear(boundsOf(place, size), system === "3857" ? metresOf(mesh[mesh.length >> 1]!) : mesh[mesh.length >> 1]!);
    const drawn = warped(picture, bounds, pixels);
    this.lay(drawn, placeIn(bounds, [drawn.width, drawn.height]), attribution);
  }

  /** The system of a picture that states its code. */
  private systemOf(epsg: number): System {
    if (epsg === 3857 || epsg === 4326) return `${epsg}`;
    const crs = this.session.volume.info?.crs ?? "";
    // A compound has the code of the plane first.
    const own = /(?:EPSG|epsg)[:/\d.]*?[:/](\d{4,6})\b|^(\d{4,6})\b/.exec(crs);
    const code = Number(own?.[1] ?? own?.[2] ?? 0);
    if (code && code !== epsg) throw { message: basemapText("otherSystem", { epsg, crs }) };
    return "model";
  }

  private checkNear([west, south, east, north]: readonly [number, number, number, number], [x, y]: Pair): void {
    const by = Math.max(east - west, north - south);
    if (x > west - by && x < east + by && y > south - by && y < north + by) return;
    const text = (v: number) => number(v, Math.abs(v) > 1000 ? 0 : 5);
    throw {
      message: basemapText("notNear", {
        west: text(west),
        south: text(south),
        east: text(east),
        north: text(north),
        x: text(x),
        y: text(y),
      }),
    };
  }

  private lay(picture: HTMLCanvasElement, place: Place, attribution: string): void {
    const { view, volume, messages } = this.session;
    const { box, info } = volume;
    const [west, south, east, north] = this.around();
    this.checkNear(boundsOf(place, [picture.width, picture.height]), [(west + east) / 2, (south + north) / 2]);
    const height = view.ground?.height ?? lowestOf(box) + info!.origin[2];
    view.lay(new Ground(picture, place, height, attribution));
    messages.say(basemapText("basemapShown"));
  }
}
customElements.define("svt-basemap", BasemapChoice);

function numbersOf(text: string): number[] {
  const numbers = text
    .split(/[\s,;]+/)
    .filter(Boolean)
    .map(Number);
  const [west, south, east, north] = numbers;
  if (numbers.length !== 4 || !numbers.every(Number.isFinite) || east! <= west! || north! <= south!)
    throw { message: basemapText("badExtent") };
  return numbers;
}
