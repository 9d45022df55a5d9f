/** Keys that move the camera to a view of the model. */

import type { View } from "../session/view";
import { kViews } from "../state/member_controls";

/** True if the key is one of them. */
export function movedByKey(view: View, key: string): boolean {
  const named = kViews[Number(key) - 1];
  if (named) void view.goTo("", named);
  else if (key === "0") {
    void view.goTo("", null, true, view.endWalking());
  } else if (key === "f") void view.goToSelected();
  else return false;
  return true;
}
