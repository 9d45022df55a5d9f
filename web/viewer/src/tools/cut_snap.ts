/** Snapping of measured points to the outlines of cut faces, from the drawings of the planes. */

import { project } from "../camera/camera";
import { add, dot, scale, sub } from "../camera/vec";
import type { Point } from "../engine";
import type { Session } from "../session";
import { regionOf } from "../state/scene_of";
import { normalOf } from "./plane_outline";

/** Outlines of the cut faces of a feature: points in metres from the grid's lower corner. */
export interface CutOutline {
  id: string;
  points: Point[];
}

export interface Snapped {
  point: Point;
  to: "corner" | "edge";
}

interface GeoJson {
  features?: { properties?: { id?: string }; geometry?: Geometry | null }[];
}
type Geometry =
  | { type: "MultiPolygon"; coordinates: Point[][][] }
  | { type: "MultiLineString"; coordinates: Point[][] }
  | { type: "GeometryCollection"; geometries: Geometry[] };

/** The outlines in the drawing of a section. @param origin  of the grid, in the coordinates of the model */
export function outlinesOf(drawing: string, origin: Point): CutOutline[] {
  const rings = (geometry: Geometry | null | undefined): Point[][] => {
    if (!geometry) return [];
    if (geometry.type === "MultiPolygon") return geometry.coordinates.flat();
    return geometry.type === "GeometryCollection" ? geometry.geometries.flatMap(rings) : geometry.coordinates;
  };
  return ((JSON.parse(drawing) as GeoJson).features ?? []).flatMap(({ properties, geometry }) =>
    rings(geometry).map((ring) => ({ id: properties?.id ?? "", points: ring.map((p) => sub([p[0], p[1], p[2] ?? origin[2]], origin)) })),
  );
}

/** The nearest corner of outlines, or else the nearest point of their edges. @param pixels  distance in the picture from the point */
export function nearestOf(outlines: readonly CutOutline[], at: Point, pixels: (p: Point) => number, most: number): Snapped | null {
  let best: Snapped | null = null,
    least = most;
  const consider = (point: Point, to: Snapped["to"]) => {
    const away = pixels(point);
    if (away <= least) [best, least] = [{ point, to }, away];
  };
  for (const { points } of outlines) for (const point of points) consider(point, "corner");
  if (best) return best;
  for (const { points } of outlines)
    for (let i = 1; i < points.length; ++i) {
      const [a, b] = [points[i - 1]!, points[i]!];
      const along = sub(b, a);
      const share = dot(sub(at, a), along) / (dot(along, along) || 1);
      if (share > 0 && share < 1) consider(add(a, scale(along, share)), "edge");
    }
  return best;
}

export class CutSnap {
  /** Outlines by the region that the plane removes. */
  private readonly known = new Map<string, Promise<CutOutline[]>>();
  private of: unknown = null;

  constructor(private readonly session: Session) {}

  /** The point of a cut outline near a picked point of the cut; null: it is not on a cut, or no outline is near. */
  async near(picked: Point, size: [number, number], most: number): Promise<Snapped | null> {
    const { view, volume } = this.session;
    const { info, box, index } = volume;
    const { camera, sections } = view.state;
    if (!info || !camera) return null;
    if (this.of !== info) this.known.clear();
    this.of = info;
    const tolerance = Math.max(...info.spacing);
    const found = sections.find((section) => Math.abs(dot(normalOf(section, box), picked) - section.at) < tolerance);
    if (!found) return null;
    const region = regionOf(found);
    if (!this.known.has(region)) this.known.set(region, this.read(region, info.origin));
    const outlines = (await this.known.get(region)!).filter(({ id }) => !view.hidden[index.byId.get(id) ?? -1]);
    const place = (p: Point) => project(camera, size[0] / size[1], p, box.axes);
    const from = place(picked);
    const pixels = (p: Point) => {
      const seen = place(p);
      return seen && from ? Math.hypot((seen.x - from.x) * size[0], (seen.y - from.y) * size[1]) : Infinity;
    };
    return nearestOf(outlines, picked, pixels, most);
  }

  /** A drawing that cannot be made has no outlines. */
  private async read(region: string, origin: Point): Promise<CutOutline[]> {
    const drawing = await this.session.volume.engine?.drawing(region, "geojson").catch(() => null);
    return drawing ? outlinesOf(new TextDecoder().decode(drawing), origin) : [];
  }
}
