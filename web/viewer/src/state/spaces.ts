/**
 * Rooms and other spaces: pictures leave them out where there is anything else to see. So the page hides them at first,
 * and asks for those that the user shows.
 */

import type { ScenePass } from "../engine";
import type { FeatureIndex } from "./feature_index";
import { ofClass } from "./queries";

/** Classes of spaces with voxels; none if the model consists of spaces. */
function spaceClasses(index: FeatureIndex): string[] {
  const solids = index.features.filter(({ count }) => count > 0);
  if (solids.every((feature) => feature.isSpace || feature.class === "ClosureSurface")) return [];
  return [...new Set(solids.flatMap((feature) => (feature.isSpace ? [feature.class] : [])))];
}

/** Queries that hide the spaces of a model that was just opened. */
export function hiddenSpaces(index: FeatureIndex): string[] {
  return spaceClasses(index).map(ofClass);
}

/** The pass, with styles that ask for the classes of spaces of which a member is not hidden. */
export function withSpaces(pass: ScenePass, index: FeatureIndex, hidden: Uint8Array): ScenePass {
  if (pass.show || pass.shell) return pass;
  const asked = (pass.styles ?? []).map((style) => style.select);
  const styles = spaceClasses(index).flatMap((name) => {
    const first = index.classes.get(name)!.find((i) => index.features[i]!.count > 0 && !hidden[i]);
    const select = ofClass(name);
    return first === undefined || asked.includes(select) ? [] : [{ select, opacity: index.features[first]!.opacity }];
  });
  return styles.length ? { ...pass, styles: [...styles, ...(pass.styles ?? [])] } : pass;
}
