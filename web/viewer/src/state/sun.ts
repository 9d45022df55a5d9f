/** The sun of a view as date and hour, which sliders change. */

import type { Scene } from "../engine";

export type Sun = NonNullable<Scene["sun"]>;

export interface SunTime {
  year: number;
  /** 1 to 366. */
  day: number;
  /** 0 up to 24, with fractions; the time of the meridian unless `zone` is given. */
  hour: number;
  /** `Z` or an offset such as `+02:00`, as in the scene; empty: none. */
  zone: string;
}

const kTime = /^(\d{4})-(\d\d)-(\d\d)[ T](\d\d):(\d\d)(?::\d\d)?(Z|[+-]\d\d:\d\d)?$/;
const kDay = 86_400_000;

/** Null: the scene has another form of time, which stays as it is. */
export function sunTimeOf(text: string): SunTime | null {
  const [, year, month, day, hour, minute, zone = ""] = kTime.exec(text) ?? [];
  if (!year) return null;
  const date = Date.UTC(Number(year), Number(month) - 1, Number(day));
  return {
    year: Number(year),
    day: Math.round((date - Date.UTC(Number(year), 0, 1)) / kDay) + 1,
    hour: Number(hour) + Number(minute) / 60,
    zone,
  };
}

export function textOfSunTime({ year, day, hour, zone }: SunTime): string {
  const date = new Date(Date.UTC(year, 0, day)).toISOString().slice(0, 10);
  const minutes = Math.min(1439, Math.round(hour * 60));
  const two = (value: number) => String(value).padStart(2, "0");
  return `${date} ${two(Math.floor(minutes / 60))}:${two(minutes % 60)}${zone}`;
}

/** The afternoon of a long day, in the time of the meridian. */
export function firstSun(year = new Date().getFullYear()): Sun {
  return { time: `${year}-06-21 15:00` };
}

/** A sun from outside, if it is one. */
export function isSun(value: unknown): value is Sun {
  const { time, place, size } = (value ?? {}) as Record<string, unknown>;
  const isPlace = Array.isArray(place) && place.length === 2 && place.every(Number.isFinite);
  return typeof time === "string" && (place === undefined || isPlace) && (size === undefined || Number.isFinite(size));
}
