/** Sun and shadows: a switch, and sliders for the day and the hour; the place, if the model does not state it. */

import { css, html, nothing } from "lit";
import { rangeOfControl } from "../state/member_controls";
import { firstSun, sunTimeOf, textOfSunTime, type Sun, type SunTime } from "../state/sun";
import { language } from "../texts";
import { toolText } from "../tool_texts";
import { controls, Part } from "../ui/part";

const kPlace = ["latitude", "longitude"] as const;

export class SunChoice extends Part {
  static override properties = { ...Part.properties, needsPlace: { state: true } };
  /** The model does not state its place, and the user has not given one yet. */
  declare needsPlace: boolean;
  /** Numbers that the user has typed: latitude, longitude. */
  private typed: [number, number] = [NaN, NaN];
  private seenInfo: unknown = null;

  static override styles = [
    controls,
    css`
      .line { display: grid; grid-template-columns: 52px 1fr auto; gap: 10px; align-items: center; min-height: 34px; }
      output { min-width: 62px; text-align: right; font-variant-numeric: tabular-nums; }
      .place { display: grid; grid-template-columns: 1fr 1fr; gap: 6px 10px; margin-top: 4px; }
      .place p { grid-column: 1 / -1; }
    `,
  ];

  constructor() {
    super();
    this.needsPlace = false;
  }

  override willUpdate(): void {
    const { info } = this.session.volume;
    if (this.seenInfo === info) return;
    this.seenInfo = info;
    this.needsPlace = false;
    this.typed = [NaN, NaN];
  }

  override render() {
    const { sun } = this.session.view.now;
    const time = sun ? sunTimeOf(sun.time) : null;
    return html`<label class="check" title=${toolText("sunHint")}><input type="checkbox" id="sun" .checked=${sun !== null || this.needsPlace}
        @change=${(e: Event) => void this.turn((e.target as HTMLInputElement).checked)} />${toolText("sun")}</label>
      ${sun && time ? this.sliders(sun, time) : nothing}
      ${this.needsPlace || sun?.place ? this.place(sun) : nothing}`;
  }

  private sliders(sun: Sun, time: SunTime) {
    const set = (change: Partial<SunTime>) => this.session.view.set({ sun: { ...sun, time: textOfSunTime({ ...time, ...change }) } });
    const date = new Date(Date.UTC(time.year, 0, time.day)).toLocaleDateString(language(), {
      day: "numeric",
      month: "short",
      timeZone: "UTC",
    });
    const slider = (
      id: string,
      label: string,
      value: number,
      [low, high, step]: [number, number, number],
      text: string,
      change: (to: number) => void,
    ) =>
      html`<div class="line"><span class="quiet">${label}</span><wa-slider size="s" id=${id} label=${label} aria-label="${label}: ${text}" min=${low} max=${high} step=${step} .value=${value}
        @input=${(e: Event) => change(Number((e.target as HTMLInputElement).value))}></wa-slider><output>${text}</output></div>`;
    return html`${slider("sun-day", toolText("sunDay"), time.day, [1, 365, 1], date, (day) => set({ day }))}
      ${slider("sun-hour", toolText("sunHour"), time.hour, [0, 23.75, 0.25], textOfSunTime(time).slice(11), (hour) => set({ hour }))}`;
  }

  private place(sun: Sun | null) {
    const field = (axis: 0 | 1, label: string) => {
      const { minimum, maximum, step } = rangeOfControl(kPlace[axis]);
      const value = sun?.place?.[axis] ?? this.typed[axis]!;
      return html`<label class="small">${label}<input type="number" id=${kPlace[axis]} step=${step} min=${minimum} max=${maximum} title=${toolText("sunPlaceHint")}
        .value=${Number.isFinite(value) ? String(value) : ""} @change=${(e: Event) => this.placed(axis, e.target as HTMLInputElement)} /></label>`;
    };
    return html`<div class="place">${sun ? nothing : html`<p class="small" role="status">${toolText("sunPlace")}</p>`}
      ${field(0, toolText("latitude"))}${field(1, toolText("longitude"))}</div>`;
  }

  private async turn(isOn: boolean): Promise<void> {
    const { view, volume } = this.session;
    this.needsPlace = false;
    if (!isOn) return view.set({ sun: null });
    const sun = firstSun();
    // A small picture shows whether the model states its place.
    const scene = await view.composed([16, 9], 1, { ...view.state, sun });
    const isKnown = await volume.engine!.picture(scene).then(
      () => true,
      () => false,
    );
    if (isKnown) view.set({ sun });
    else this.needsPlace = true;
  }

  private placed(axis: 0 | 1, input: HTMLInputElement): void {
    const { view } = this.session;
    const { sun } = view.state;
    const value = input.valueAsNumber;
    const before = sun?.place?.[axis] ?? this.typed[axis]!;
    const { minimum, maximum } = rangeOfControl(kPlace[axis]);
    if (!(value >= minimum && value <= maximum)) {
      input.value = Number.isFinite(before) ? String(before) : "";
      return;
    }
    const place: [number, number] = [...(sun?.place ?? this.typed)];
    place[axis] = value;
    this.typed = place;
    if (!place.every(Number.isFinite)) return;
    this.needsPlace = false;
    view.set({ sun: { ...(sun ?? firstSun()), place } });
  }
}
customElements.define("svt-sun-choice", SunChoice);
