/** Values and times of fields as text. */

import { language } from "../texts";
import type { FieldInfo } from "../engine";

/** Units of UCUM as people write them. */
const kUnits: Record<string, string> = {
  Cel: "°C",
  "[degF]": "°F",
  "%": "%",
  "1": "",
  m2: "m²",
  m3: "m³",
  "kg/m3": "kg/m³",
  "W/m2": "W/m²",
  "m/s": "m/s",
};
const kDigits = 4;

export function unitText(unit: string): string {
  return kUnits[unit] ?? unit;
}

/** A value with its unit. */
export function valueText(value: number, unit: string): string {
  const text = value.toLocaleString(language(), { maximumSignificantDigits: kDigits });
  const shown = unitText(unit);
  return shown ? `${text} ${shown}` : text;
}

/** A time of a field: date and hour if the field states when it begins, else hours, minutes and seconds. */
export function timeText({ epoch }: Pick<FieldInfo, "epoch">, seconds: number): string {
  const begin = epoch === null ? NaN : Date.parse(epoch);
  if (Number.isFinite(begin)) {
    // The zone is that of the field: its clock is the one of the building.
    const zone = /([+-])(\d\d):?(\d\d)$/.exec(epoch!);
    const minutes = zone ? (zone[1] === "-" ? -1 : 1) * (60 * Number(zone[2]) + Number(zone[3])) : 0;
    return new Date(begin + 1000 * seconds + 60_000 * minutes).toLocaleString(language(), {
      timeZone: "UTC",
      dateStyle: "medium",
      timeStyle: "short",
    });
  }
  const whole = Math.floor(Math.abs(seconds));
  const two = (n: number) => String(n).padStart(2, "0");
  const rest = Math.abs(seconds) - whole;
  const decimals = rest > 1e-9 ? rest.toLocaleString(language(), { maximumFractionDigits: 2 }).slice(1) : "";
  return `${seconds < 0 ? "−" : ""}${Math.floor(whole / 3600)}:${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)}${decimals}`;
}

/** The index of the last time that is not after `seconds`; without a time, the first. */
export function timeIndex(times: readonly number[], seconds: number | undefined): number {
  if (seconds === undefined) return 0;
  let at = 0;
  while (at + 1 < times.length && times[at + 1]! <= seconds + 1e-9) ++at;
  return at;
}

/** The value at a time, linear between two times, as in pictures; null: one of both is missing. Outside of the times: that of the nearest. */
export function valueAt(times: readonly number[], values: readonly (number | null)[], seconds: number): number | null {
  const at = timeIndex(times, seconds);
  const value = values[at] ?? null,
    next = values[at + 1] ?? null;
  const share = at + 1 < times.length ? (seconds - times[at]!) / (times[at + 1]! - times[at]!) : 0;
  if (share <= 1e-9) return value;
  return value === null || next === null ? null : value + share * (next - value);
}

/** The points of a line through a series, in a box of 100 by 30 with y downwards; null values interrupt it. */
export function seriesPath(times: readonly number[], values: readonly (number | null)[]): string {
  const known = values.filter((value): value is number => value !== null);
  if (known.length < 2 || times.length < 2) return "";
  const low = Math.min(...known),
    high = Math.max(...known);
  const x = (n: number) => (100 * (times[n]! - times[0]!)) / (times.at(-1)! - times[0]!);
  const y = (value: number) => (high > low ? 29 - (28 * (value - low)) / (high - low) : 15);
  let path = "",
    isDown = false;
  values.forEach((value, n) => {
    if (value === null) return void (isDown = false);
    path += `${isDown ? "L" : "M"}${x(n).toFixed(2)} ${y(value).toFixed(2)}`;
    isDown = true;
  });
  return path;
}
