/** Choice of the value that colours the components, with its kind and the number of components that have it. */

import { html, nothing } from "lit";
import type { Session } from "../session";
import { coloredBy, colorKeys, type ColorKey } from "../state/color_keys";
import { help, number, t, type TextKey } from "../texts";

function textOf({ key, isNumber, count }: ColorKey, isOwn: boolean): string {
  const name = isOwn ? t(`key_${key}` as TextKey) : key;
  const kind = t(isNumber ? "kindNumber" : "kindText");
  return count === null ? t("colorKey", { key: name, kind }) : t("colorKeyCount", { key: name, kind, n: number(count, 0) });
}

export function colorChoice(session: Session) {
  const { view, volume, model } = session;
  const { info, index } = volume;
  if (!info) return nothing;
  const { colorBy } = view.now;
  const keys = colorKeys(info, index, model.owners.file !== "");
  const isListed = !colorBy || [...keys.own, ...keys.attributes].some(({ key }) => key === colorBy);
  const options = (list: ColorKey[], isOwn: boolean) =>
    list.map((key) => html`<option value=${key.key} ?selected=${key.key === colorBy}>${textOf(key, isOwn)}</option>`);
  const choose = (event: Event) => view.set(coloredBy(view.state, (event.target as HTMLSelectElement).value, keys, index));
  return html`<h3 id="color-by-title">${t("colorBy")}</h3>
    <select id="color-by" aria-labelledby="color-by-title" title=${help("/colorBy")} .value=${colorBy} @change=${choose}>
      <option value="" ?selected=${!colorBy}>${t("colorByNothing")}</option>
      ${isListed ? nothing : html`<option value=${colorBy} selected>${colorBy}</option>`}
      <optgroup label=${t("colorByFeatures")}>${options(keys.own, true)}</optgroup>
      ${keys.attributes.length ? html`<optgroup label=${t("colorByAttributes")}>${options(keys.attributes, false)}</optgroup>` : nothing}
    </select>`;
}
