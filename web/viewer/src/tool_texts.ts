/**
 * Texts of the parts that load when they are first used, English and German, as in texts.ts. Language files have them under
 * the same keys.
 */

import { inLanguage } from "./texts";

const kToolTexts = {
  filterAttributes: ["Filter attributes", "Attribute filtern"],
  noSuchAttribute: ["No attribute matches.", "Kein Attribut passt."],
  group_general: ["General", "Allgemein"],
  group_material: ["Materials", "Materialien"],
  group_classification: ["Classification", "Klassifikation"],
  group_quantities: ["Quantities", "Mengen"],
  group_set: ["Properties", "Eigenschaften"],
  quantity: ["Quantity", "Menge"],
  stated: ["Stated in the model", "Im Modell angegeben"],
  measured: ["Measured", "Gemessen"],

  palette: ["Actions", "Aktionen"],
  paletteSearch: ["Search actions", "Aktionen suchen"],
  paletteFound: ["{n} actions", "{n} Aktionen"],
  paletteNothing: ["No action matches.", "Keine Aktion passt."],

  menuOf: ["Menu of {name}", "Menü von {name}"],

  table: ["Table of objects", "Tabelle der Objekte"],
  tableFilter: ["Filter: words in all columns", "Filter: Wörter in allen Spalten"],
  tableClass: ["Class", "Klasse"],
  tableAllClasses: ["All classes", "Alle Klassen"],
  tableColumn: ["Add a column", "Spalte hinzufügen"],
  tableRemove: ["Remove the column {name}", "Spalte {name} entfernen"],
  tableSort: ["Sort by {name}", "Nach {name} sortieren"],
  tableCount: ["{n} of {all} objects", "{n} von {all} Objekten"],
  tableSave: ["Save as CSV", "Als CSV speichern"],
  tableSelect: ["Select all rows", "Alle Zeilen auswählen"],
  tableName: ["Name", "Name"],
  tableType: ["Type", "Typ"],
  tableStorey: ["Storey", "Geschoss"],
  tableId: ["Id", "Kennung"],

  findingsOfCode: ["{code}: {n}", "{code}: {n}"],
  findingsMore: ["{n} more", "{n} weitere"],
} as const satisfies Record<string, readonly [string, string]>;

export type ToolTextKey = keyof typeof kToolTexts;

export function toolText(key: ToolTextKey, values: Record<string, string | number> = {}): string {
  return inLanguage(key, kToolTexts[key], values);
}

/** The English of these texts, for translation in a language file. */
export function toolTemplate(): Record<string, string> {
  return Object.fromEntries(Object.entries(kToolTexts).map(([key, [english]]) => [key, english]));
}
