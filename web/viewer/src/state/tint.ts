/** The tint of selected features on the screen. Saved pictures, scenes and commands do not have it. */

import type { SceneStyle } from "../engine";
import type { FeatureIndex } from "./feature_index";
import { quoted } from "./queries";

/** Share of the mark in the colour of a selected feature. */
const kShare = 0.55;
/** Larger models have one tint, because each class takes another pass over all features. */
const kMostFeatures = 20_000;
const kMostClasses = 12;
const kMostCharacters = 15_000;

/**
 * Styles that tint features.
 * @param queries  that select them
 * @param members  the visible ones
 * @param mark  the colour of the outline, `#rrggbb`
 */
export function tintStyles(index: FeatureIndex, queries: readonly string[], members: readonly number[], mark: string): SceneStyle[] {
  const colors = new Map<string, string>();
  for (const i of members) {
    const feature = index.features[i]!;
    if (feature.count > 0 && !colors.has(feature.class)) colors.set(feature.class, feature.color);
  }
  if (!colors.size) return [];
  const color = [...colors.values()][0]!;
  const any = queries.map((query) => `(${query})`).join(" or ");
  if (colors.size === 1 || colors.size > kMostClasses || index.features.length > kMostFeatures || any.length > kMostCharacters)
    return queries.map((select) => ({ select, color: mixed(color, mark) }));
  return [...colors].map(([name, own]) => ({ select: `(${any}) and class=${quoted(name)}`, color: mixed(own, mark) }));
}

export function mixed(a: string, b: string): string {
  const channel = (color: string, at: number) => parseInt(color.slice(at, at + 2), 16);
  const mix = (at: number) => Math.round(channel(a, at) * (1 - kShare) + channel(b, at) * kShare);
  return `#${[1, 3, 5].map((at) => mix(at).toString(16).padStart(2, "0")).join("")}`;
}
