/** The switch for rooms and other spaces, which pictures leave out at first. */

import type { Session } from "./session";
import { hiddenSpaces, spacesOf } from "./state/spaces";

/** Whether any rooms and other spaces are visible; not while only some features are shown. */
export function areSpacesShown({ volume, view }: Session): boolean {
  return !view.state.show.length && spacesOf(volume.index).some((i) => !view.hidden[i]);
}

/** Whether anything but spaces is hidden. */
export function hasHiddenParts({ volume, view }: Session): boolean {
  const { features } = volume.index;
  const spaces = new Set(spacesOf(volume.index));
  return features.some(({ count }, i) => count > 0 && view.hidden[i] && !spaces.has(i));
}

export function showSpaces({ volume, view }: Session, isShown: boolean): void {
  view.hide(spacesOf(volume.index), !isShown, hiddenSpaces(volume.index));
}

/** Shows everything; spaces only if some of them are visible already. */
export function showAll(session: Session): void {
  const { view, volume } = session;
  // Spaces that were hidden before only some features were shown are hidden again.
  if (view.state.show.length) view.showOthers();
  const hide = areSpacesShown(session) ? [] : hiddenSpaces(volume.index);
  if (hide.join() !== view.state.hide.join()) view.set({ hide });
}
