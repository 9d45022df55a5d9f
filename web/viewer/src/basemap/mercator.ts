/** Tiles of Web Mercator (EPSG:3857) by the numbering of OpenStreetMap: x to the east and y to the south from the north-west corner. */

import type { Pair } from "./ground";

/** Half the width of the map in metres. */
const kHalfWorld = 20037508.342789244;
export const kTile = 256;

/** Share of the world's square, 0 to 1 from its north-west corner. */
export function mercatorOf([longitude, latitude]: Pair): Pair {
  const sine = Math.sin((latitude * Math.PI) / 180);
  return [(longitude + 180) / 360, 0.5 - Math.log((1 + sine) / (1 - sine)) / (4 * Math.PI)];
}

/** Metres of EPSG:3857. */
export function metresOf(degrees: Pair): Pair {
  const [x, y] = mercatorOf(degrees);
  return [(2 * x - 1) * kHalfWorld, (1 - 2 * y) * kHalfWorld];
}

export interface Tile {
  z: number;
  x: number;
  y: number;
}

/** Longest side of the joined tiles, in tiles. */
const kMostTiles = 8;

/** The detail in which a part of the world has at most 8 x 8 tiles. */
export function zoomOf(low: Pair, high: Pair, most: number): number {
  const share = Math.max(high[0] - low[0], high[1] - low[1]);
  return Math.max(0, Math.min(most, Math.floor(Math.log2((kMostTiles - 1) / share))));
}

/** The tiles of a part of the world, and the first and the number of them along x and y. */
export function tilesOf(low: Pair, high: Pair, z: number): { tiles: Tile[]; first: Pair; count: Pair } {
  const n = 2 ** z;
  const at = (share: number) => Math.min(n - 1, Math.max(0, Math.floor(share * n)));
  const first: Pair = [at(low[0]), at(low[1])];
  const count: Pair = [at(high[0]) - first[0] + 1, at(high[1]) - first[1] + 1];
  const tiles = Array.from({ length: count[0] * count[1] }, (_, i) => ({
    z,
    x: first[0] + (i % count[0]),
    y: first[1] + Math.floor(i / count[0]),
  }));
  return { tiles, first, count };
}

/** Whether an address has places for the numbers of a tile. */
export function isTemplate(address: string): boolean {
  return /\{z\}/.test(address) && /\{x\}/.test(address) && /\{-?y\}/.test(address);
}

export function addressOf(template: string, { z, x, y }: Tile): string {
  const names: Record<string, string> = { z: `${z}`, x: `${x}`, y: `${y}`, "-y": `${2 ** z - 1 - y}`, s: "abc"[(x + y) % 3]!, r: "" };
  return template.replace(/\{(-?\w+)\}/g, (whole, name: string) => names[name] ?? whole);
}
