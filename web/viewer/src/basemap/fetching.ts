/** Fetches pictures from addresses of the user, and states why one does not come. */

import { basemapText } from "./texts";
import { canvasOf, drawn, readPicture, type PlacedPicture } from "./image_files";
import { addressOf, isTemplate, kTile, mercatorOf, tilesOf, zoomOf, type Tile } from "./mercator";
import type { Pair } from "./ground";
import { meshOf, warped } from "./warp";

/** Milliseconds until the browser has reported that its policy refused an address. */
const kUntilReport = 60;
/** The finest tiles of most servers. */
const kFinest = 19,
  kCoarsest = 12;

/** The source that pictures from well-known servers must name. */
const kKnown: readonly (readonly [host: string, attribution: string])[] = [
  ["openstreetmap.org", "© OpenStreetMap contributors"],
  ["openstreetmap.de", "© OpenStreetMap contributors"],
  ["opentopomap.org", "© OpenStreetMap contributors, SRTM; OpenTopoMap (CC-BY-SA)"],
  ["cartocdn.com", "© OpenStreetMap contributors, © CARTO"],
  ["basemap.at", "basemap.at"],
  ["basemap.de", "© basemap.de / BKG"],
];

export function attributionOf(address: string): string {
  const host = hostOf(address);
  return kKnown.find(([name]) => host === name || host.endsWith(`.${name}`))?.[1] ?? host;
}

function urlOf(address: string): URL {
  try {
    return new URL(address, location.href);
  } catch {
    throw { message: basemapText("badAddress", { address }) };
  }
}
function hostOf(address: string): string {
  return urlOf(address.replace(/[{}]/g, "")).host;
}

/** The addresses that the policy of the page has refused. */
const refused = new Set<string>();
let isWatching = false;
function watchPolicy(): void {
  if (isWatching) return;
  isWatching = true;
  document.addEventListener("securitypolicyviolation", ({ blockedURI }) => refused.add(blockedURI));
}

/** The reason why nothing came from an address. */
async function reasonOf(url: URL): Promise<string> {
  await new Promise((done) => setTimeout(done, kUntilReport));
  const { origin } = url;
  if ([...refused].some((address) => address.startsWith(origin))) return basemapText("policy", { origin });
  return basemapText(origin === location.origin ? "noAnswer" : "noAnswerElsewhere", { origin });
}

async function imageOf(url: URL): Promise<HTMLImageElement> {
  watchPolicy();
  const image = new Image();
  // An isolated page may show pictures of other sites only if these allow it.
  if (crossOriginIsolated && url.origin !== location.origin) image.crossOrigin = "anonymous";
  // Servers of maps refuse requests of unknown pages.
  image.referrerPolicy = "origin";
  image.src = url.href;
  await image.decode();
  return image;
}

/** A picture at an address. */
export async function fetchPicture(address: string): Promise<PlacedPicture> {
  const url = urlOf(address);
  const name = url.pathname.split("/").pop()!;
  try {
    if (/\.tiff?$/i.test(url.pathname)) {
      watchPolicy();
      const response = await fetch(url);
      if (!response.ok) throw new Error(String(response.status));
      return await readPicture([{ name, arrayBuffer: () => response.arrayBuffer() }]);
    }
    const image = await imageOf(url);
    return { name, picture: drawn(image, image.naturalWidth, image.naturalHeight).picture, place: null, epsg: null };
  } catch (error) {
    throw isOwn(error) ? error : { message: await reasonOf(url) };
  }
}

const isOwn = (error: unknown): boolean => !(error instanceof Error) && !(error instanceof DOMException);

/**
 * Tiles of a part of the ground, as one picture that fills it.
 * @param bounds  west, south, east and north, in coordinates of the model
 * @param places  longitude and latitude of coordinates of the model
 */
export async function fetchTiles(
  template: string,
  bounds: readonly number[],
  places: (points: Pair[]) => Promise<Pair[]>,
): Promise<HTMLCanvasElement> {
  if (!isTemplate(template)) throw { message: basemapText("badAddress", { address: template }) };
  const mesh = (await places(meshOf(bounds))).map(mercatorOf);
  const of = (i: 0 | 1, pick: (...values: number[]) => number) => pick(...mesh.map((p) => p[i]));
  const low: Pair = [of(0, Math.min), of(1, Math.min)],
    high: Pair = [of(0, Math.max), of(1, Math.max)];
  let failed: Tile | null = null;
  for (let z = zoomOf(low, high, kFinest); z >= Math.min(kCoarsest, zoomOf(low, high, kFinest)); --z) {
    const { tiles, first, count } = tilesOf(low, high, z);
    const joined = canvasOf(count[0] * kTile, count[1] * kTile);
    const context = joined.getContext("2d")!;
    let missing = 0;
    await Promise.all(
      tiles.map(async (tile) => {
        try {
          const image = await imageOf(urlOf(addressOf(template, tile)));
          context.drawImage(image, (tile.x - first[0]) * kTile, (tile.y - first[1]) * kTile, kTile, kTile);
        } catch {
          ++missing;
          failed = tile;
        }
      }),
    );
    // Near the border of a map, some are missing; where all are, the server may have only coarser ones.
    if (missing < tiles.length) {
      const pixel = ([x, y]: Pair): Pair => [(x * 2 ** z - first[0]) * kTile, (y * 2 ** z - first[1]) * kTile];
      return warped(joined, bounds, mesh.map(pixel));
    }
    if (refused.size) break;
  }
  throw { message: await reasonOf(urlOf(addressOf(template, failed!))) };
}
