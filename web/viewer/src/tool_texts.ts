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

  cube: ["View cube", "Ansichtswürfel"],
  cubeHint: [
    "View cube. Arrow keys turn the view by 45 degrees, Enter shows all of it, Home shows it slanted.",
    "Ansichtswürfel. Pfeiltasten drehen um 45 Grad, Eingabe zeigt alles, Pos1 zeigt es schräg.",
  ],
  cubeFit: ["The whole model", "Das ganze Modell"],
  rectangle: ["Select in a rectangle", "Im Rechteck auswählen"],
  rectangleHint: [
    "Drag a rectangle. To the right, it selects what is completely inside; to the left, all that it touches.",
    "Ein Rechteck ziehen. Nach rechts wählt es, was ganz darin liegt; nach links alles, was es berührt.",
  ],
  rectangleKeys: [
    "Arrow keys change its size, with Shift its place; Enter selects, with Ctrl in addition.",
    "Pfeiltasten ändern die Größe, mit Umschalt die Lage; Eingabe wählt aus, mit Strg zusätzlich.",
  ],
  planeByFace: ["Through a face", "Durch eine Fläche"],
  faceHint: ["Click a face: the plane goes through it.", "Eine Fläche anklicken: Die Ebene geht durch sie."],
  faceKeys: ["Enter takes the face in the middle.", "Eingabe nimmt die Fläche in der Mitte."],
  facePlane: ["Plane {n} goes through the face.", "Ebene {n} geht durch die Fläche."],
  faceNothing: ["Click a face of the model.", "Klicken Sie auf eine Fläche des Modells."],
  sectionBox: ["Section box", "Schnittkasten"],
  sectionBoxHint: [
    "Six planes around the selection, or around the middle of the building. They replace other planes.",
    "Sechs Ebenen um die Auswahl oder die Mitte des Gebäudes. Sie ersetzen andere Ebenen.",
  ],
  boxFrom: ["{axis} from", "{axis} von"],
  boxTo: ["{axis} to", "{axis} bis"],

  square: ["Right angles", "Rechte Winkel"],
  squareHint: [
    "Each point lies along x, y or z from the point before. Shift and click does the same for one point.",
    "Jeder Punkt liegt vom vorigen aus entlang x, y oder z. Umschalt und Klick tut dasselbe für einen Punkt.",
  ],
  onGround: ["On the ground", "Am Boden"],
  atCutCorner: ["at a corner of the cut", "an einer Ecke des Schnitts"],
  atCutEdge: ["on an edge of the cut", "auf einer Kante des Schnitts"],

  sun: ["Sun and shadows", "Sonne und Schatten"],
  sunHint: ["Light by the sun, with shadows", "Licht der Sonne, mit Schatten"],
  sunDay: ["Day", "Tag"],
  sunHour: ["Hour", "Uhrzeit"],
  sunPlace: [
    "The model does not state its place on earth. Enter its latitude and longitude.",
    "Das Modell nennt seinen Ort auf der Erde nicht. Breite und Länge eingeben.",
  ],
  sunPlaceHint: ["Degrees: north and east are positive", "Grad: Nord und Ost sind positiv"],
  latitude: ["Latitude", "Breite"],
  longitude: ["Longitude", "Länge"],

  walkThrough: ["Walk through the views", "Ansichten durchgehen"],
  previousView: ["Previous view", "Vorige Ansicht"],
  nextView: ["Next view", "Nächste Ansicht"],
  viewOf: ["{n} of {all}: {name}", "{n} von {all}: {name}"],
  viewDetails: ["Comment and status of {name}", "Kommentar und Status von {name}"],
  comment: ["Comment", "Kommentar"],
  author: ["Author", "Von"],
  status: ["Status", "Status"],
  statusOpen: ["Open", "Offen"],
  statusInProgress: ["In progress", "In Arbeit"],
  statusClosed: ["Closed", "Erledigt"],

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
