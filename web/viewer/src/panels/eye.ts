/** The icon for the visible portion of a feature with its parts, or of a group. */

import type { Seen } from "../state/visibility";
import { icon } from "../ui/icons";

export function eyeOf(seen: Seen) {
  return icon(seen === "all" ? "eye" : seen === "none" ? "eyeOff" : "eyePart", 16);
}
