/** Graphics over the picture: section planes with their handles, the box of the selection, measured points. */

import { svg, nothing, type SVGTemplateResult } from "lit";
import { project } from "../camera/camera";
import { add, distance, scale } from "../camera/vec";
import type { Point } from "../engine";
import type { Session } from "../session";
import { boxEdges, keptInside, middleOf, normalOf, planeOutline } from "../tools/plane_outline";
import { polygonArea } from "../tools/measure";
import { number } from "../texts";

export interface View {
  session: Session;
  width: number;
  height: number;
}

type Seen = { x: number; y: number };

export function place({ session, width, height }: View, p: Point): Seen | null {
  const camera = session.picture.camera;
  const seen = camera && project(camera, width / height, p, session.volume.box.axes);
  return seen && { x: seen.x * width, y: seen.y * height };
}

function pathOf(view: View, points: Point[], isClosed: boolean): string | null {
  const seen = points.map((p) => place(view, p));
  if (seen.some((p) => p === null)) return null;
  const text = (seen as Seen[]).map((p) => `${p.x.toFixed(1)},${p.y.toFixed(1)}`).join("L");
  return `M${text}${isClosed ? "Z" : ""}`;
}

export function planes(view: View): SVGTemplateResult[] {
  const { box } = view.session.volume;
  return view.session.view.now.sections.map((section) => {
    const path = pathOf(view, planeOutline(keptInside(section, box), box), true);
    return path ? svg`<path class="plane" d=${path}></path>` : svg``;
  });
}

/** Position of the handle of a plane: at the centre of its outline, or right of it if a tool card covers the left. */
export function handleOf(session: Session, n: number): { at: Point; normal: Point } | null {
  const section = session.view.now.sections[n];
  if (!section) return null;
  const outline = planeOutline(keptInside(section, session.volume.box), session.volume.box);
  if (!outline.length) return null;
  const normal = normalOf(section, session.volume.box),
    middle = middleOf(outline);
  const camera = session.picture.camera;
  if (!session.view.tool || !camera) return { at: middle, normal };
  const across = (p: Point) => project(camera, 1, p, session.volume.box.axes)?.x ?? -1;
  const right = outline.reduce((a, b) => (across(a) > across(b) ? a : b));
  return { at: add(scale(middle, 0.4), scale(right, 0.6)), normal };
}

export function selectionBox(view: View): SVGTemplateResult | typeof nothing {
  const box = view.session.selection.properties?.box;
  if (!box) return nothing;
  const lines = boxEdges(box).map(([a, b]) => pathOf(view, [a, b], false));
  if (lines.some((line) => line === null)) return nothing;
  const d = lines.join("");
  return svg`<path class="box-under" d=${d}></path><path class="box" d=${d}></path>`;
}

export function measure(view: View): SVGTemplateResult | typeof nothing {
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
