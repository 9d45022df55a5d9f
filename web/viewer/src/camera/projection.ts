/** Parallel and perspective projection of the view. */

import type { View } from "../session/view";
import { withProjection } from "./camera";

/** Changes the projection. A view straight from above or below is fitted again, because its outline then has another size. */
export function toggleParallel(view: View): void {
  const { camera } = view.state;
  if (!camera || view.isWalking) return;
  const parallel = !camera.parallel;
  const [dx, dy, dz] = [0, 1, 2].map((i) => camera.eye[i]! - camera.target[i]!) as [number, number, number];
  if (Math.hypot(dx, dy) > 1e-4 * Math.abs(dz)) return view.turn(withProjection(camera, parallel));
  void view.goTo("", dz > 0 ? "top" : "bottom", true, { around: "", parallel, fieldOfView: camera.fieldOfView });
}
