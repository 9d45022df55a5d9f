/** Section planes: their positions and drawings. */

import { css, html, nothing } from "lit";
import type { DrawingFormat, DrawingParts, VolumeInfo } from "../engine";
import type { View } from "../session/view";
import { regionOf } from "../state/scene_of";
import type { Section, SectionAxis } from "../state/view_state";
import { help, language, number, t } from "../texts";
import { toolText } from "../tool_texts";
import { pngOf, save, zipOf } from "../ui/files";
import { icon } from "../ui/icons";
import { controls, Part } from "../ui/part";
import { keptApart, rangeOf } from "./plane_outline";
import { isSectionBox, placeOf, sectionBox } from "./section_box";

const kAxes: SectionAxis[] = ["x", "y", "z", "free"];
const kFormats = ["svg", "dxf", "png", "geojson", "csv"] as const;
type FileFormat = (typeof kFormats)[number];
/** Pixels of a PNG per CSS pixel of its SVG: 300 per inch. */
const kPngScale = 300 / 96;
const kParts = [
  ["beyond", "drawBeyond"],
  ["above", "drawAbove"],
  ["dimensions", "drawDimensions"],
] as const;
/** Height of the cut of plans above the floor: over window sills. */
const kPlanHeight = 1.1;
/** A larger number of storeys, as in a district, is shown as a list. */
const kMostChips = 14;

/** Storeys, or levels that the model does not name. Storeys of several buildings with the same name and height are one entry. */
export function levelsOf(storeys: VolumeInfo["storeys"]): { name: string; floor: number }[] {
  const levels = storeys.map(({ name, id, floor }) => ({ name: name || id || toolText("level", { height: number(floor, 2) }), floor }));
  const once = levels.filter(
    ({ name, floor }, n) => levels.findIndex((other) => other.name === name && Math.abs(other.floor - floor) < 0.05) === n,
  );
  const isAlone = (name: string) => once.filter((other) => other.name === name).length === 1;
  return once.map(({ name, floor }) => ({ name: isAlone(name) ? name : `${name} (${number(floor, 2)} m)`, floor }));
}

/** Cuts a storey as a plan does. */
export function cutStorey(view: View, floor: number): void {
  const others = view.now.sections.filter((section) => section.axis !== "z");
  view.set({ sections: [...others, { axis: "z", at: Number((floor + kPlanHeight).toFixed(3)), flip: false, turn: 0, tilt: 90 }] });
}

export class SectionTool extends Part {
  /** The parts of the next drawings beside the cut. */
  private parts: DrawingParts = { beyond: false, above: false, dimensions: false };
  private isDrawing = false;

  static override styles = [
    controls,
    css`
      .plane { border-top: 1px solid var(--line); padding: 10px 0; display: grid; gap: 6px; }
      .line { display: grid; grid-template-columns: 64px 1fr auto; gap: 10px; align-items: center; }
      output { text-align: right; min-width: 74px; font-variant-numeric: tabular-nums; }
      .typed { display: flex; gap: 4px; align-items: center; justify-content: flex-end; }
      .typed input { width: 82px; text-align: right; padding: 2px 4px; min-height: 28px; font-variant-numeric: tabular-nums; }
      @media (max-width: 759px), (pointer: coarse) { .typed input { min-height: 44px; } }
      .head { display: flex; gap: 6px; align-items: center; }
      .head .segments { flex: 1; }
      .drawings { gap: 4px 8px; }
      .drawings > .grow { flex-basis: 100%; }
      .drawings button { min-height: 28px; padding: 2px 7px; }
      .chips { display: flex; flex-wrap: wrap; gap: 6px; margin: 8px 0; }
    `,
  ];

  override render() {
    const { session } = this;
    const { sections, hatches, look } = session.view.now;
    const isBox = isSectionBox(sections);
    const isHatched = hatches ?? (look === "paper" || look === "blueprint");
    return html`
      ${sections.length ? nothing : html`<p class="quiet">${toolText("sectionHint")}</p>`}
      ${this.storeys()}
      ${isBox ? this.box(sections) : sections.map((section, n) => this.plane(section, n))}
      <div class="row">
        <button class=${sections.length ? "" : "loud"} id="add-plane" @click=${() => this.add()}>${icon("plus", 16)}${t("addPlane")}</button>
        <label class="check" title=${help("/hatches/show")}><input type="checkbox" id="hatches" .checked=${isHatched} @change=${(e: Event) => session.view.set({ hatches: (e.target as HTMLInputElement).checked })} />${t("hatches")}</label>
      </div>
      <div class="row">
        <button id="plane-by-face" aria-pressed=${session.view.aim === "face"} title=${toolText("faceHint")} @click=${() => (session.view.aim = session.view.aim === "face" ? null : "face")}>${icon("target", 16)}${toolText("planeByFace")}</button>
        <button id="section-box" aria-pressed=${isBox} title=${toolText("sectionBoxHint")} @click=${() => this.toggleBox(isBox)}>${icon("part", 16)}${toolText("sectionBox")}</button>
      </div>
      ${this.drawingParts()}
    `;
  }

  private toggleBox(isBox: boolean): void {
    const { session } = this;
    session.view.set({ sections: isBox ? [] : sectionBox(session) });
    if (!isBox && session.view.state.selection.length) void session.view.goToSelected();
  }

  /** A section box: from and to along each axis. */
  private box(sections: readonly Section[]) {
    const side = (axis: SectionAxis, flip: boolean) => {
      const n = sections.findIndex((section) => section.axis === axis && section.flip === flip);
      const section = sections[n]!;
      const [low, high] = rangeOf(section, this.session.volume.box);
      const label = toolText(flip ? "boxFrom" : "boxTo", { axis });
      return this.slider(label, section.at, low, high, 0.01, `${number(section.at, 2)} m`, (at) => this.change(n, { at }));
    };
    return html`<div class="plane" role="group" aria-label=${toolText("sectionBox")}>${(["x", "y", "z"] as const).map((axis) => [side(axis, true), side(axis, false)])}</div>`;
  }

  private drawingParts() {
    const { info, isCity } = this.session.volume;
    if (!info) return nothing;
    if (isCity) return html`<p class="quiet small">${toolText("cityDrawings")}</p>`;
    const lacks = !info.hasMeshes;
    return html`<div class="row small drawings" role="group" aria-label=${toolText("drawnToo")}><span class="quiet grow">${toolText("drawnToo")}</span>${kParts.map(
      ([
        part,
        text,
      ]) => html`<label class="check"><input type="checkbox" id="draw-${part}" ?disabled=${lacks && part !== "dimensions"} .checked=${this.parts[part]}
        @change=${(e: Event) => {
          this.parts = { ...this.parts, [part]: (e.target as HTMLInputElement).checked };
        }} />${toolText(text)}</label>`,
    )}</div>
    <div class="row"><button id="draw-sheets" title=${toolText("sheetsHint")} ?disabled=${this.isDrawing} @click=${() => void this.sheets((sheets) => save(zipOf(sheets.map((text, n) => ({ name: `sheet-${n + 1}.svg`, text }))), "sheets.zip"))}>${t("sheets")}</button>
      <button id="print-sheets" title=${toolText("printHint")} ?disabled=${this.isDrawing} @click=${() => void this.sheets(async (sheets) => (await import("./print_sheets")).printSheets(sheets))}>${toolText("print")}</button></div>`;
  }

  private async sheets(use: (sheets: string[]) => unknown): Promise<void> {
    const { session } = this;
    this.isDrawing = true;
    this.requestUpdate();
    try {
      await use(await session.volume.engine!.sheets(language() === "de" ? "de" : "en"));
    } catch (error) {
      session.messages.fail(error);
    } finally {
      this.isDrawing = false;
      this.requestUpdate();
    }
  }

  private storeys() {
    const levels = levelsOf(this.session.volume.info?.storeys ?? []);
    if (!levels.length) return nothing;
    if (levels.length > kMostChips)
      return html`<select id="storeys" aria-label=${toolText("storeys")} @change=${(e: Event) => cutStorey(this.session.view, levels[(e.target as HTMLSelectElement).selectedIndex - 1]!.floor)}>
        <option selected disabled>${toolText("storeys")}</option>${levels.map(({ name }) => html`<option>${name}</option>`)}</select>`;
    return html`<div class="chips" role="group" aria-label=${toolText("storeys")}>${levels.map(
      ({ name, floor }) =>
        html`<button aria-label=${t("storeyCut", { name })} @click=${() => cutStorey(this.session.view, floor)}>${name}</button>`,
    )}</div>`;
  }

  private plane(section: Section, n: number) {
    const [low, high] = rangeOf(section, this.session.volume.box);
    return html`<div class="plane" role="group" aria-label=${toolText("planeNumber", { n: n + 1 })}>
      <div class="head">
        <div class="segments" role="radiogroup" aria-label=${toolText("axis")}>${kAxes.map(
          (axis) =>
            html`<button role="radio" aria-checked=${section.axis === axis} title=${axisText(axis)} aria-label=${axisText(axis)} @click=${() => this.turnTo(n, axis)}>${axis === "free" ? toolText("axisFree") : axis}</button>`,
        )}</div>
        <button aria-pressed=${section.flip} aria-label=${t("flip")} title=${t("flip")} @click=${() => this.change(n, { flip: !section.flip })}>${icon("flip", 16)}</button>
        <button class="bare" aria-label=${toolText("removePlane", { n: n + 1 })} title=${toolText("removePlane", { n: n + 1 })} @click=${() => this.removePlane(n)}>${icon("bin", 16)}</button>
      </div>
      ${this.slider(
        toolText("position"),
        section.at,
        low,
        high,
        0.01,
        html`<span class="typed"><input type="number" class="at" step="0.01" aria-label=${toolText("positionTyped")} .value=${section.at.toFixed(2)}
        @change=${(e: Event) => this.typed(n, (e.target as HTMLInputElement).valueAsNumber)} />m</span>`,
        (at) => this.change(n, { at }),
      )}
      ${this.inTheWorld(section, n)}
      ${
        section.axis === "free"
          ? html`${this.slider(toolText("turn"), section.turn, -180, 180, 1, `${number(section.turn, 0)}°`, (turn) => this.change(n, { turn }))}
            ${this.slider(toolText("tilt"), section.tilt, -90, 90, 1, `${number(section.tilt, 0)}°`, (tilt) => this.change(n, { tilt }))}`
          : nothing
      }
      <div class="row small drawings" role="toolbar" aria-label=${t("drawing")}><span class="quiet grow">${t("drawing")}</span>${kFormats.map(
        (format) =>
          html`<button class="small" aria-label=${toolText("exportAs", { format: format.toUpperCase() })} @click=${() => void this.export(n, format)}>${format.toUpperCase()}</button>`,
      )}</div>
    </div>`;
  }

  private slider(label: string, value: number, low: number, high: number, step: number, text: unknown, change: (value: number) => void) {
    return html`<div class="line"><span class="quiet">${label}</span>
      <wa-slider size="s" label=${label} aria-label=${label} min=${low.toFixed(3)} max=${high.toFixed(3)} step=${step} .value=${value}
        @input=${(e: Event) => change(Number((e.target as HTMLInputElement).value))}></wa-slider>
      ${typeof text === "string" ? html`<output>${text}</output>` : text}</div>`;
  }

  /** The position in the model's own coordinates, if the plane is perpendicular to one of their axes. */
  private inTheWorld(section: Section, n: number) {
    const { info } = this.session.volume;
    const axis = { x: 0, y: 1, z: 2, free: -1 }[section.axis];
    const offset = info?.origin[axis];
    const isAlong = info && axis >= 0 && (!info.axes || Math.abs(info.axes[axis]![axis]! - 1) < 1e-9);
    if (!isAlong || offset === undefined || Math.abs(offset) < 1e-6) return nothing;
    const text = toolText(section.axis === "z" ? "heightInTheWorld" : "positionInTheWorld", {
      crs: info.crs ? crsText(info.crs) : toolText("theModel"),
    });
    return html`<div class="typed small"><span class="quiet grow">${text}</span><input type="number" class="world" step="0.01" aria-label=${text} .value=${(section.at + offset).toFixed(2)}
      @change=${(e: Event) => this.typed(n, (e.target as HTMLInputElement).valueAsNumber - offset)} />m</div>`;
  }

  private typed(n: number, value: number): void {
    const [low, high] = rangeOf(this.session.view.now.sections[n]!, this.session.volume.box);
    if (Number.isFinite(value)) this.change(n, { at: Math.min(high, Math.max(low, value)) });
    this.requestUpdate(); // resets the text of a refused value
  }

  private add(): void {
    const { sections } = this.session.view.now;
    const axis = (["y", "z", "x"] as const).find((wanted) => !sections.some((section) => section.axis === wanted)) ?? "free";
    const plane = this.placed({ axis, at: 0, flip: axis === "y", turn: 45, tilt: 0 });
    this.session.view.set({ sections: [...sections, keptApart(plane, sections, this.session.volume.box)] });
  }

  private placed(section: Section): Section {
    return { ...section, at: placeOf(section, this.session) };
  }

  private turnTo(n: number, axis: SectionAxis): void {
    const section = this.session.view.now.sections[n]!;
    if (section.axis !== axis) this.change(n, this.placed({ ...section, axis, flip: axis === "y" }));
  }

  private change(n: number, change: Partial<Section>): void {
    this.session.view.set({
      sections: this.session.view.now.sections.map((section, i) => (i === n ? { ...section, ...change } : section)),
    });
  }

  private removePlane(n: number): void {
    this.session.view.set({ sections: this.session.view.now.sections.filter((_, i) => i !== n) });
  }

  private async export(n: number, format: FileFormat): Promise<void> {
    const { session } = this;
    const drawn: DrawingFormat = format === "png" ? "svg" : format;
    try {
      const plane = regionOf(session.view.now.sections[n]!);
      const { city } = session.model;
      const bytes = await (city ? city.draw(plane, drawn) : session.volume.engine!.drawing(plane, drawn, this.parts));
      save(format === "png" ? await pngOf(bytes, kPngScale) : bytes, `section-${n + 1}.${format}`);
    } catch (error) {
      session.messages.fail(error);
    }
  }
}
customElements.define("svt-section-tool", SectionTool);

/** The code of the first part of a CRS, which is the horizontal one: EPSG:25832. */
function crsText(crs: string): string {
  const found = /EPSG[:/]+(?:[\d.]*[:/])?(\d+)/i.exec(crs);
  return found ? `EPSG:${found[1]}` : crs;
}

function axisText(axis: SectionAxis): string {
  return toolText(({ x: "axisX", y: "axisY", z: "axisZ", free: "axisFree" } as const)[axis]);
}
