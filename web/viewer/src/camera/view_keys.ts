/** Keys that move the camera to a view of the model. */

import type { View } from "../session/view";
import { kViews } from "../state/member_controls";
import { ofSubtree } from "../state/queries";

/** True if the key is one of them. */
export function movedByKey(view: View, key: string): boolean {
  const named = kViews[Number(key) - 1];
  if (named) void view.goTo("", named);
  else if (key === "0") {
    view.isWalking = false;
    void view.goTo("", null);
  } else if (key === "f") void view.goTo(view.now.selection.map(ofSubtree).join(" or "), null);
  else return false;
  return true;
}
