/** Two selected features side by side: measures and attributes, with the differences of numbers. */

import { html, nothing } from "lit";
import type { FeatureProperties } from "../engine";
import { labelOf } from "../state/feature_index";
import { dateText, number, t } from "../texts";

interface Row {
  name: string;
  values: [string, string];
  /** Second minus first; empty: they are not numbers, or have other units. */
  difference: string;
}

const kNone = "–";

export function volumeOf(p: FeatureProperties): number | null {
  return p.totalVolume ?? p.modelVolume ?? (p.voxelVolume > 0 ? p.voxelVolume : null);
}

function withSign(value: number, digits: number, unit: string): string {
  return `${value > 0 ? "+" : ""}${number(value, digits)} ${unit}`.trim();
}

function measured(name: string, [a, b]: [number | null, number | null], digits: number, unit: string): Row {
  const text = (value: number | null) => (value === null ? kNone : `${number(value, digits)} ${unit}`);
  return { name, values: [text(a), text(b)], difference: a !== null && b !== null ? withSign(b - a, digits, unit) : "" };
}

const digitsOf = (text: string | undefined) => Math.min(6, /\.(\d+)/.exec(text ?? "")?.[1]?.length ?? 0);

function attribute(name: string, pair: readonly [FeatureProperties, FeatureProperties]): Row {
  const [a, b] = pair.map((p) => p.numbers[name]);
  const digits = Math.max(...pair.map((p) => digitsOf(p.attributes[name])));
  if (a && b && a.unit === b.unit) return measured(name, [a.value, b.value], digits, a.unit);
  const [first, second] = pair.map((p) => dateText(p.attributes[name] ?? kNone)) as [string, string];
  return { name, values: [first, second], difference: "" };
}

export function comparisonRows(pair: readonly [FeatureProperties, FeatureProperties]): Row[] {
  const [a, b] = pair;
  const extent = (axis: number): Row => {
    const size = ({ box }: FeatureProperties) => box.high[axis]! - box.low[axis]!;
    return measured(`${t("extent")} ${"xyz"[axis]}`, [size(a), size(b)], 2, "m");
  };
  const names = [...new Set(pair.flatMap((p) => Object.keys(p.attributes)))];
  return [
    { name: t("key_class"), values: [a.class, b.class], difference: "" },
    measured(t("key_volume"), [volumeOf(a), volumeOf(b)], 3, "m³"),
    ...(a.floorArea !== null || b.floorArea !== null ? [measured(t("floorArea"), [a.floorArea, b.floorArea], 2, "m²")] : []),
    measured(t("surface"), [a.totalSurface || null, b.totalSurface || null], 2, "m²"),
    ...[0, 1, 2].map(extent),
    ...names.map((name) => attribute(name, pair)),
  ];
}

export function comparison(pair: readonly [FeatureProperties, FeatureProperties] | null) {
  if (!pair) return nothing;
  return html`<h3 id="comparison-title">${t("compared")}</h3>
    <div class="scroll"><table id="comparison" aria-labelledby="comparison-title">
      <thead><tr>${pair.map((p) => html`<th scope="col">${labelOf(p)}</th>`)}<th scope="col">${t("difference")}</th></tr></thead>
      <tbody>${comparisonRows(pair).map(
        ({ name, values, difference }) =>
          html`<tr class=${values[0] === values[1] ? "same" : ""}><th scope="row">${name}</th>${values.map((value) => html`<td>${value}</td>`)}<td>${difference}</td></tr>`,
      )}</tbody>
    </table></div>`;
}
