/** Texts about fields, in English and German. */

import { inLanguage } from "../texts";

const kFieldTexts = {
  field: ["Field", "Feld"],
  fieldNone: ["none", "keines"],
  fieldTime: ["Time of the field", "Zeit des Feldes"],
  fieldPlay: ["Play", "Abspielen"],
  fieldPause: ["Stop", "Anhalten"],
  fieldIsolines: ["Lines every", "Linien alle"],
  fieldFrom: ["from", "von"],
  fieldTo: ["to", "bis"],
  fieldMap: ["Colours", "Farben"],
  fieldPer: ["Values", "Werte"],
  fieldPer_place: ["by place", "je Ort"],
  fieldPer_mean: ["mean per component", "Mittel je Bauteil"],
  fieldPer_max: ["maximum per component", "Maximum je Bauteil"],
  fieldPer_min: ["minimum per component", "Minimum je Bauteil"],
  fieldHint: [
    "Click a place in the picture for its value. Values never cross a wall.",
    "Ein Klick in das Bild nennt den Wert dort. Werte reichen nie durch eine Wand.",
  ],
  fieldProbe: ["{name}: {value}", "{name}: {value}"],
  fieldNoValue: ["{name}: no value here", "{name}: kein Wert an dieser Stelle"],
  fieldSeries: ["Values over time at {name}: {low} to {high}", "Werte über die Zeit bei {name}: {low} bis {high}"],
  fieldRows: ["Components by value", "Bauteile nach Wert"],
  fieldMean: ["Mean", "Mittel"],
  fieldRange: ["Range", "Bereich"],
  fieldMore: ["{n} more", "{n} weitere"],
  fieldUnknown: ["unknown", "unbekannt"],
} as const satisfies Record<string, readonly [string, string]>;

export type FieldTextKey = keyof typeof kFieldTexts;

export function fieldText(key: FieldTextKey, values: Record<string, string | number> = {}): string {
  return inLanguage(key, kFieldTexts[key], values);
}

/** The English of these texts, for translation in a language file. */
export function fieldTemplate(): Record<string, string> {
  return Object.fromEntries(Object.entries(kFieldTexts).map(([key, [english]]) => [key, english]));
}
