/** Calls of the library that need bytes of a city: fetches the bytes, and repeats the call. */

import type { CityBytes } from "../engine";
import type { Calls, CityNeeds, GivenRow } from "./protocol";

type OnProgress = (step: string, done: number) => void;

interface Asked {
  ask<N extends keyof Calls>(
    name: N,
    args: Calls[N]["args"],
    transfer?: Transferable[],
    onProgress?: OnProgress,
  ): Promise<Calls[N]["result"]>;
}

/** A call reads page after page of an index, which has few levels; then it requests tiles. */
const kMostRounds = 60;

export async function withBytes<N extends "cityLook" | "cityFind" | "citySearch" | "cityDrawing">(
  worker: Asked,
  files: CityBytes,
  name: N,
  argsOf: (round: number) => Calls[N]["args"],
  onProgress?: OnProgress,
): Promise<Exclude<Calls[N]["result"], CityNeeds>> {
  for (let round = 0; round < kMostRounds; ++round) {
    const reply = await worker.ask(name, argsOf(round), [], onProgress);
    if (!("needs" in reply)) return reply as Exclude<Calls[N]["result"], CityNeeds>;
    const given = await files.get(reply.needs);
    const all = new Uint8Array(given.reduce((sum, { bytes }) => sum + bytes.length, 0));
    let at = 0;
    for (const { bytes } of given) {
      all.set(bytes, at);
      at += bytes.length;
    }
    const rows = given.map(({ range, bytes, total, error }): GivenRow => [...range, bytes.length, total, error]);
    await worker.ask("cityGive", [rows, all.buffer], [all.buffer]);
  }
  throw { code: "E999", message: "the index of the city comes to no end" };
}
