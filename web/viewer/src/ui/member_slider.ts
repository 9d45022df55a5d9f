/** A slider for a member of a scene, with the declared range, and the declared help as its tooltip. */

import { html } from "lit";
import { kRanges, rangeOfControl } from "../state/member_controls";
import { help } from "../texts";

export function memberSlider(control: "opacity" | "fieldOfView", label: string, value: number, change: (value: number) => void) {
  const { minimum, maximum, step } = rangeOfControl(control);
  return html`<wa-slider size="s" label=${label} aria-label=${label} title=${help(kRanges[control].member)} min=${minimum} max=${maximum} step=${step} .value=${value}
    @input=${(e: Event) => change(Number((e.target as HTMLInputElement).value))}></wa-slider>`;
}
