/** Measuring in the picture of the page: its clicks and its graphics. */

import { nothing, svg, type SVGTemplateResult } from "lit";
import { halfHeight } from "../camera/camera";
import { distance, dot, scale, sub, add } from "../camera/vec";
import { pathOf, place, type PictureTools, type Seen, type View } from "../canvas/overlay";
import type { Pick, Point } from "../engine";
import type { Session } from "../session";
import { number, t } from "../texts";
import { toolText } from "../tool_texts";
import { CutSnap } from "./cut_snap";
import { polygonArea } from "./measure";
import { middleOf } from "./plane_outline";

/** Maximum distance from a click to a corner or an edge that it snaps to. */
const kSnapPixels = 9;

export function measuringOf(session: Session): PictureTools {
  const cuts = new CutSnap(session);
  return {
    graphics,
    click: (x, y, event, size) => {
      if (session.view.tool !== "measure") return false;
      void measureAt(session, cuts, [x, y], event, size).catch((error: unknown) => session.messages.fail(error));
      return true;
    },
  };
}

async function measureAt(
  session: Session,
  cuts: CutSnap,
  [x, y]: [number, number],
  event: PointerEvent,
  size: [number, number],
): Promise<void> {
  const { view, volume, messages } = session;
  const isSnapped = !event.ctrlKey && !event.metaKey;
  const pick = await volume.engine!.pick(x, y, isSnapped ? snapReach(session, size[1]) : 0);
  if (!pick) return messages.say(t("pickedNothing"));
  const cut = isSnapped ? await cuts.near(pick.point, size, kSnapPixels) : null;
  view.history.seal();
  messages.say(placeText(pick, cut !== null, cut?.to));
  const { measured } = view.state;
  const before = measured.at(-1);
  const point = cut?.point ?? pick.snapped?.point ?? pick.point;
  const isSquare = before && (view.isSquare || event.shiftKey);
  view.set({ measured: [...measured, isSquare ? alongAxis(before, point, volume.box.axes) : point] });
}

function placeText(pick: Pick, isAtCut: boolean, to: "corner" | "edge" | undefined): string {
  if (isAtCut) return toolText(to === "corner" ? "atCutCorner" : "atCutEdge");
  return t(pick.snapped ? (pick.snapped.to === "corner" ? "atCorner" : "atEdge") : "onFace");
}

/** The point at the same distance along the axis that has the largest part of the way to it. */
export function alongAxis(from: Point, to: Point, axes: readonly Point[]): Point {
  const way = sub(to, from);
  const parts = axes.map((axis) => dot(axis, way));
  const most = parts.reduce((best, part, i) => (Math.abs(part) > Math.abs(parts[best]!) ? i : best), 0);
  return add(from, scale(axes[most]!, parts[most]!));
}

/** Metres of a few pixels at the camera's target. */
function snapReach({ view }: Session, height: number): number {
  const { camera } = view.state;
  if (!camera) return 0;
  const depth = camera.parallel ? 1 : distance(camera.eye, camera.target);
  return (kSnapPixels * 2 * halfHeight(camera) * depth) / Math.max(1, height);
}

function graphics(view: View): SVGTemplateResult | typeof nothing {
  const points = view.session.view.now.measured;
  if (!points.length) return nothing;
  const path = pathOf(view, points, points.length > 2);
  const dots = points.map((p) => place(view, p)).filter((p) => p !== null);
  const texts = points.slice(1).map((p, i) => ({ of: [points[i]!, p], text: `${number(distance(points[i]!, p), 3)} m` }));
  if (points.length > 2) texts.push({ of: points, text: `${number(polygonArea(points), 2)} m²` });
  return svg`${path ? svg`<path class="measure" d=${path}></path>` : nothing}
    ${dots.map((p) => svg`<circle class="dot" cx=${p.x} cy=${p.y} r="4"></circle>`)}${labels(view, texts)}`;
}

/** Size of a label with its text, pixels. */
const kLabelWidth = 68,
  kLabelHeight = 16;

/** Places each label at the middle of its points, below labels that are already there. */
function labels(view: View, texts: { of: Point[]; text: string }[]): SVGTemplateResult[] {
  const taken: Seen[] = [];
  return texts.map(({ of, text }) => {
    const middle = place(view, middleOf(of));
    if (!middle) return svg``;
    const at = { x: middle.x, y: middle.y - 7 };
    for (const other of [...taken].sort((a, b) => a.y - b.y))
      if (Math.abs(other.x - at.x) < kLabelWidth && Math.abs(other.y - at.y) < kLabelHeight) at.y = other.y + kLabelHeight;
    taken.push(at);
    return svg`<text x=${at.x} y=${at.y} text-anchor="middle">${text}</text>`;
  });
}
