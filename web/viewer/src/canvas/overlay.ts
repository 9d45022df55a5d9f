/** Graphics over the picture: section planes with their handles, the box of the selection, axes. */

import { svg, nothing, type SVGTemplateResult } from "lit";
import { project } from "../camera/camera";
import { distance } from "../camera/vec";
import type { Point } from "../engine";
import type { Session } from "../session";
import { boxEdges, keptBox, keptInside, middleOf, normalOf, planeOutline } from "../tools/plane_outline";

export interface View {
  session: Session;
  width: number;
  height: number;
}

export type Seen = { x: number; y: number };

/** Parts of the page over the picture. In other pages, pictures lack them. */
export interface PictureTools {
  graphics(view: View): unknown;
  /** Takes a click at fractions of the picture; false: the click selects. @param size  of the picture, CSS pixels */
  click(x: number, y: number, event: PointerEvent, size: [number, number]): boolean;
}

export function place({ session, width, height }: View, p: Point): Seen | null {
  const camera = session.picture.camera;
  const seen = camera && project(camera, width / height, p, session.volume.box.axes);
  return seen && { x: seen.x * width, y: seen.y * height };
}

export function pathOf(view: View, points: Point[], isClosed: boolean): string | null {
  const seen = points.map((p) => place(view, p));
  if (seen.some((p) => p === null)) return null;
  const text = (seen as Seen[]).map((p) => `${p.x.toFixed(1)},${p.y.toFixed(1)}`).join("L");
  return `M${text}${isClosed ? "Z" : ""}`;
}

/** The outline of a plane within the part of the box that the other planes keep. */
function outlineOf({ volume, view }: Session, n: number): Point[] {
  const { sections } = view.now;
  return planeOutline(keptInside(sections[n]!, volume.box), keptBox(volume.box, sections, n));
}

export function planes(view: View): SVGTemplateResult[] {
  return view.session.view.now.sections.map((_, n) => {
    const path = pathOf(view, outlineOf(view.session, n), true);
    return path ? svg`<path class="plane" d=${path}></path>` : svg``;
  });
}

/** Position of the handle of a plane: at the centre of its outline. */
export function handleOf(session: Session, n: number): { at: Point; normal: Point } | null {
  const section = session.view.now.sections[n];
  const outline = section ? outlineOf(session, n) : [];
  return section && outline.length ? { at: middleOf(outline), normal: normalOf(section, session.volume.box) } : null;
}

export function selectionBox(view: View): SVGTemplateResult | typeof nothing {
  const box = view.session.selection.properties?.box;
  if (!box) return nothing;
  const lines = boxEdges(box).map(([a, b]) => pathOf(view, [a, b], false));
  if (lines.some((line) => line === null)) return nothing;
  const d = lines.join("");
  return svg`<path class="box-under" d=${d}></path><path class="box" d=${d}></path>`;
}

/** Pixels of a scale bar below the axes. */
const kScaleBar = 44;

/** The grid's axes as arrows in the corner. */
export function compass(view: View): SVGTemplateResult | typeof nothing {
  const camera = view.session.picture.camera;
  if (!camera) return nothing;
  const { axes } = view.session.volume.box;
  const at: Point = camera.target;
  const from = project(camera, 1, at, axes);
  const reach = camera.parallel ? camera.height * 0.1 : distance(camera.eye, camera.target) * 0.05;
  if (!from) return nothing;
  const arms = (["x", "y", "z"] as const).map((name, i) => {
    const to = project(camera, 1, at.map((v, k) => v + axes[i]![k]! * reach) as Point, axes);
    return { name, dx: (to?.x ?? 0) - from.x, dy: (to?.y ?? 0) - from.y };
  });
  const longest = Math.max(1e-9, ...arms.map((arm) => Math.hypot(arm.dx, arm.dy)));
  const lift = camera.parallel && view.session.view.now.picture.scaleBar ? kScaleBar : 0;
  return svg`<g class="compass" transform="translate(34 ${view.height - 34 - lift})">${arms.map(({ name, dx, dy }) => {
    const [x, y] = [(dx / longest) * 20, (dy / longest) * 20];
    return Math.hypot(x, y) < 4
      ? nothing
      : svg`<line x1="0" y1="0" x2=${x} y2=${y}></line><text x=${x * 1.4} y=${y * 1.4 + 3.5} text-anchor="middle">${name}</text>`;
  })}</g>`;
}
