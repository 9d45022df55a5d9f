/**
 * Texts of the parts whose scripts load when they are first used, English and German, as in texts.ts. Language files have them
 * under the same keys.
 */

import { inLanguage } from "./texts";

const kLateTexts = {
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
  keyCross: ["Point without a mouse", "Zeigen ohne Maus"],
  keyCrossHow: [
    "M, then arrow keys move a cross, with Shift finely; Enter",
    "M, dann bewegen Pfeiltasten ein Kreuz, mit Umschalt fein; Eingabe",
  ],
  keyTree: ["In the list", "In der Liste"],
  keyTreeHow: ["arrow keys, Enter selects, Space hides, C colours", "Pfeiltasten, Eingabe wählt, Leertaste verbirgt, C färbt"],

  rectangleHint: [
    "Drag a rectangle. To the right, it selects what is completely inside; to the left, all that it touches.",
    "Ein Rechteck ziehen. Nach rechts wählt es, was ganz darin liegt; nach links alles, was es berührt.",
  ],
  rectangleKeys: [
    "Arrow keys change its size, with Shift its place; Enter selects, with Ctrl in addition.",
    "Pfeiltasten ändern die Größe, mit Umschalt die Lage; Eingabe wählt aus, mit Strg zusätzlich.",
  ],
  faceKeys: [
    "Arrow keys move the cross, with Shift finely; Enter takes the face there.",
    "Pfeiltasten bewegen das Kreuz, mit Umschalt fein; Eingabe nimmt die Fläche dort.",
  ],
  pointHint: [
    "Arrow keys move the cross, with Shift finely. Enter sets a point, + and - zoom, Esc ends.",
    "Pfeiltasten bewegen das Kreuz, mit Umschalt fein. Eingabe setzt einen Punkt, + und - zoomen, Esc beendet.",
  ],
  walkPad: ["Walk", "Gehen"],
  walkForward: ["Forward", "Vor"],
  walkBack: ["Back", "Zurück"],
  walkLeft: ["To the left", "Nach links"],
  walkRight: ["To the right", "Nach rechts"],
  walkUp: ["Up", "Auf"],
  walkDown: ["Down", "Ab"],
  facePlane: ["Plane {n} goes through the face.", "Ebene {n} geht durch die Fläche."],
  faceNothing: ["Click a face of the model.", "Klicken Sie auf eine Fläche des Modells."],

  pane_plan: ["Plan", "Grundriss"],
  pane_front: ["Section from the front", "Schnitt von vorn"],
  pane_side: ["Section from the right", "Schnitt von rechts"],
  paneKeys: [
    "A click or the arrow keys move the other sections, Page Up and Page Down this one. Shift and arrow keys pan, + and - zoom, 0 shows all.",
    "Ein Klick oder die Pfeiltasten verschieben die anderen Schnitte, Bild auf und Bild ab diesen. Umschalt und Pfeiltasten verschieben das Bild, + und - vergrößern und verkleinern, 0 zeigt alles.",
  ],
  paneFailed: ["This section cannot be drawn.", "Dieser Schnitt lässt sich nicht zeichnen."],
  keyFour: ["Four views", "Vier Ansichten"],
  keyFourHow: [
    "J; a click in a view moves the sections; drag, wheel or + and -; arrow keys, Page Up, Page Down",
    "J; ein Klick in eine Ansicht verschiebt die Schnitte; ziehen, Rad oder + und -; Pfeiltasten, Bild auf, Bild ab",
  ],
  keyCube: ["View cube", "Ansichtswürfel"],
  keyCubeHow: [
    "click a face, an edge or a corner; drag; arrow keys turn by 45 degrees; P: parallel",
    "Fläche, Kante oder Ecke anklicken; ziehen; Pfeiltasten drehen um 45 Grad; P: parallel",
  ],
  keyRectangle: ["Select in a rectangle", "Im Rechteck auswählen"],
  keyRectangleHow: [
    "R, then drag; in the list: Shift and click, Shift and arrow keys",
    "R, dann ziehen; in der Liste: Umschalt und Klick, Umschalt und Pfeiltasten",
  ],

  findingsOfCode: ["{code}: {n}", "{code}: {n}"],
  findingsMore: ["{n} more", "{n} weitere"],
} as const satisfies Record<string, readonly [string, string]>;

export type LateTextKey = keyof typeof kLateTexts;

export function isLateText(key: string): key is LateTextKey {
  return key in kLateTexts;
}

export function lateText(key: LateTextKey, values: Record<string, string | number> = {}): string {
  return inLanguage(key, kLateTexts[key], values);
}

/** The English of these texts, for translation in a language file. */
export function lateTemplate(): Record<string, string> {
  return Object.fromEntries(Object.entries(kLateTexts).map(([key, [english]]) => [key, english]));
}
