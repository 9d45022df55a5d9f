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

  keyOrbit: ["Turn", "Drehen"],
  keyOrbitHow: ["drag, one finger, arrow keys", "Ziehen, ein Finger, Pfeiltasten"],
  keyPan: ["Move", "Verschieben"],
  keyPanHow: [
    "right button or Shift and drag, two fingers, Shift and arrow keys",
    "rechte Taste oder Umschalt und Ziehen, zwei Finger, Umschalt und Pfeiltasten",
  ],
  keyZoom: ["Zoom to the pointer", "Zum Zeiger zoomen"],
  keyZoomHow: ["wheel, pinch, + and −", "Mausrad, zwei Finger, + und −"],
  keyPick: ["Select", "Auswählen"],
  keyPickHow: [
    "click; with Ctrl more than one; Enter: the object in the middle",
    "Klick; mit Strg mehrere; Eingabe: das Objekt in der Mitte",
  ],
  keyAlongHow: ["Alt-click, L", "Alt-Klick, L"],
  keyFrame: ["Frame", "Heranholen"],
  keyFrameHow: ["double click, F", "Doppelklick, F"],
  keyViews: ["Named views", "Benannte Ansichten"],
  keyViewsHow: ["1 to 7", "1 bis 7"],
  keyFit: ["Show all of it", "Alles zeigen"],
  keyFitHow: ["0", "0"],
  keyTools: ["Tools", "Werkzeuge"],
  keyToolsHow: [
    "X section, C lens, V focus, K look, M measure, N views, B keep",
    "X Schnitt, C Linse, V Fokus, K Stil, M Messen, N Ansichten, B Sichern",
  ],
  keyHide: ["Hide or show the selection", "Auswahl verbergen oder zeigen"],
  keyHideHow: ["H; Shift and H: show all", "H; Umschalt und H: alles zeigen"],
  keyUndo: ["Undo, redo", "Zurücknehmen, wiederholen"],
  keyUndoHow: ["Ctrl and Z; Ctrl, Shift and Z or Ctrl and Y", "Strg und Z; Strg, Umschalt und Z oder Strg und Y"],
  keySearch: ["Search", "Suchen"],
  keySearchHow: ["/", "/"],
  keyActions: ["All actions", "Alle Aktionen"],
  keyActionsHow: ["Ctrl and K", "Strg und K"],
  keyMenu: ["Menu of an object", "Menü eines Objekts"],
  keyMenuHow: ["right click, long press, Shift and F10", "Rechtsklick, langes Drücken, Umschalt und F10"],
  keyTable: ["Table of objects", "Tabelle der Objekte"],
  keyTableHow: ["T", "T"],
  keyLeave: ["Leave, deselect", "Verlassen, Auswahl aufheben"],
  keyLeaveHow: ["Esc", "Esc"],
  keyTree: ["In the list", "In der Liste"],
  keyTreeHow: ["arrow keys, Enter selects, Space hides, C colours", "Pfeiltasten, Eingabe wählt, Leertaste verbirgt, C färbt"],

  findingsOfCode: ["{code}: {n}", "{code}: {n}"],
  findingsMore: ["{n} more", "{n} weitere"],
} as const satisfies Record<string, readonly [string, string]>;

export type ToolTextKey = keyof typeof kToolTexts;

export function isToolText(key: string): key is ToolTextKey {
  return key in kToolTexts;
}

export function toolText(key: ToolTextKey, values: Record<string, string | number> = {}): string {
  return inLanguage(key, kToolTexts[key], values);
}

/** The English of these texts, for translation in a language file. */
export function toolTemplate(): Record<string, string> {
  return Object.fromEntries(Object.entries(kToolTexts).map(([key, [english]]) => [key, english]));
}
