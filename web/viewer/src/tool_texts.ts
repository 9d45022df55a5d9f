/**
 * Texts of tools, English and German, as in texts.ts. Language files have them under the same keys.
 */

import { inLanguage } from "./texts";

const kToolTexts = {
  linkNeedsFile: [
    "Copied. The link does not contain {name}. To see the view, open that file there too.",
    "Kopiert. Der Link enthält {name} nicht. Um die Ansicht zu sehen, auch dort diese Datei öffnen.",
  ],
  level: ["Level at {height} m", "Ebene auf {height} m"],
  planeNumber: ["Plane {n}", "Ebene {n}"],
  removePlane: ["Remove plane {n}", "Ebene {n} entfernen"],
  axis: ["Direction", "Richtung"],
  axisX: ["x, from the side", "x, von der Seite"],
  axisY: ["y, from the front", "y, von vorn"],
  axisZ: ["z, from above", "z, von oben"],
  axisFree: ["Free", "Frei"],
  position: ["Position", "Lage"],
  positionTyped: ["Position in metres from the lower corner", "Lage in Metern von der unteren Ecke"],
  positionInTheWorld: ["In {crs}", "In {crs}"],
  heightInTheWorld: ["Height in {crs}", "Höhe in {crs}"],
  theModel: ["the model", "dem Modell"],
  turn: ["Turn", "Drehung"],
  tilt: ["Tilt", "Neigung"],
  storeys: ["At a storey", "In einem Geschoss"],
  drawnToo: ["Also drawn", "Auch gezeichnet"],
  drawBeyond: ["behind the cut", "hinter dem Schnitt"],
  drawAbove: ["cut away", "Weggeschnittenes"],
  drawDimensions: ["dimensions", "Maße"],
  exportAs: ["Export as {format}", "Als {format} ausgeben"],
  lensOn: ["Lens on", "Linse an"],
  lensSize: ["Size", "Größe"],
  lensPinned: ["Pinned", "Festgehalten"],
  lensX: ["Across", "Waagrecht"],
  lensY: ["Down", "Senkrecht"],
  focusQuery: ["Query (empty: the selection)", "Abfrage (leer: die Auswahl)"],
  focusEmpty: ["Select something, or write a query.", "Etwas auswählen oder eine Abfrage schreiben."],
  margin: ["Margin", "Rand"],
  bcfMissing: ["{n} components of the file are not in this model.", "{n} Bauteile daraus sind nicht in diesem Modell."],
  notBcf: ["{name} is not a readable BCF file: {error}.", "{name} ist keine lesbare BCF-Datei: {error}."],
  bookmarks: ["Bookmarks", "Lesezeichen"],
  bookmarkName: ["View {n}", "Ansicht {n}"],
  bookmarkRename: ["Name of the bookmark", "Name des Lesezeichens"],
  bookmarkRemove: ["Remove {name}", "{name} entfernen"],
  bookmarkExport: ["{name} as scene JSON", "{name} als Szenen-JSON"],
  bookmarkUp: ["{name} one place up", "{name} einen Platz nach oben"],
  bookmarksAdded: ["{n} bookmarks added", "{n} Lesezeichen hinzugefügt"],
  noViews: ["{name} contains no bookmarks.", "{name} enthält keine Lesezeichen."],
  selectHint: [
    "Click something in the picture or in the list. Alt-click lists everything behind a point.",
    "Etwas im Bild oder in der Liste anklicken. Alt-Klick zeigt alles, was hinter einem Punkt liegt.",
  ],
  byVoxels: ["{value} by voxels", "{value} nach Voxeln"],
  totalVolume: ["Volume with parts", "Volumen mit Teilen"],
  totalSurface: ["Surface with parts", "Oberfläche mit Teilen"],
  attributes: ["Attributes", "Attribute"],
  neighbours: ["Touches", "Berührt"],
  frameIt: ["Frame", "Heranholen"],
  alongAt: ["{from} to {to} m", "{from} bis {to} m"],
  alongNothing: ["Nothing lies along this ray.", "Entlang dieses Strahls liegt nichts."],
  pathOf: ["Where it is", "Wo es liegt"],
  sheetsHint: [
    "Plans, sections, elevations and tables on paper, as SVG in a ZIP archive",
    "Grundrisse, Schnitte, Ansichten und Tabellen auf Papier, als SVG in einem ZIP-Archiv",
  ],
  sectionHint: [
    "Removes everything beyond a plane. Drag its handle in the picture.",
    "Entfernt alles jenseits einer Ebene. Ihr Griff lässt sich im Bild ziehen.",
  ],
  keepFileHint: [
    "A reload and your own links find it again. It is not uploaded.",
    "Neu laden und eigene Links finden sie wieder. Sie wird nicht hochgeladen.",
  ],
  cube: ["View cube", "Ansichtswürfel"],
  cubeHint: [
    "View cube. Arrow keys turn the view by 45 degrees, Enter shows all of it, Home shows it slanted.",
    "Ansichtswürfel. Pfeiltasten drehen um 45 Grad, Eingabe zeigt alles, Pos1 zeigt es schräg.",
  ],
  cubeFit: ["The whole model", "Das ganze Modell"],
  lensHint: [
    "The lens follows the mouse and is cut by the section planes (or through the middle). The wheel with Shift changes its size, a click pins it.",
    "Die Linse folgt der Maus; in ihr schneiden die Schnittebenen (oder die Mitte). Mausrad mit Umschalt ändert die Größe, ein Klick hält sie fest.",
  ],
  lensTouch: [
    "A tap moves the lens there and pins it. The section planes cut inside it, or a plane through the middle.",
    "Tippen setzt die Linse dorthin und hält sie fest. In ihr schneiden die Schnittebenen oder die Mitte.",
  ],
  walkHint: [
    "W A S D walk, around walls and up stairs; Q and E go down and up, dragging looks around, 0 ends it.",
    "W A S D gehen, an Wänden entlang und Treppen hinauf; Q und E runter und rauf, Ziehen blickt umher, 0 beendet es.",
  ],
  walkTouch: [
    "Hold an arrow to walk, around walls and up stairs. Dragging looks around.",
    "Einen Pfeil gedrückt halten, um zu gehen, an Wänden entlang und Treppen hinauf. Ziehen blickt umher.",
  ],
  measureHint: [
    "Click points in the picture. Near a corner or an edge of the model, the point snaps to it; with Ctrl it does not.",
    "Punkte im Bild anklicken. Nahe einer Ecke oder Kante des Modells liegt der Punkt genau dort; mit Strg nicht.",
  ],
  measureTouch: [
    "Tap points in the picture. Near a corner or an edge of the model, the point snaps to it.",
    "Punkte im Bild antippen. Nahe einer Ecke oder Kante des Modells liegt der Punkt genau dort.",
  ],
  print: ["Print, PDF", "Drucken, PDF"],
  cityCover: [
    "Lists and counts cover {n} of {all} buildings: those near the camera.",
    "Listen und Zahlen umfassen {n} von {all} Gebäuden: die nahe der Kamera.",
  ],
  cityDrawings: [
    "A drawing shows the buildings of the whole city that the plane cuts. Sheets need a building: svt city extract.",
    "Eine Zeichnung zeigt die Gebäude der ganzen Stadt, die die Ebene schneidet. Blätter brauchen ein Gebäude: svt city extract.",
  ],
  noValue: ["no value", "kein Wert"],
  groupBy: ["Group by", "Gruppieren nach"],
  groupsMore: ["{n} more values", "{n} weitere Werte"],
  removePlanes: ["Remove all section planes", "Alle Schnittebenen entfernen"],
  spaces: ["Rooms and other spaces: {n}", "Räume und andere Bereiche: {n}"],
  showSpaces: ["Show rooms and other spaces", "Räume und andere Bereiche zeigen"],
  hideSpaces: ["Hide rooms and other spaces", "Räume und andere Bereiche verbergen"],
  printHint: ["Prints the sheets. The browser also saves them as PDF.", "Druckt die Blätter. Der Browser speichert sie auch als PDF."],
  more: ["Select several", "Mehrere auswählen"],
  moreNow: ["Each tap or click adds an object.", "Jedes Tippen oder Klicken fügt ein Objekt hinzu."],
  moreEnd: ["Done", "Fertig"],

  rectangle: ["Select in a rectangle", "Im Rechteck auswählen"],
  planeByFace: ["Through a face", "Durch eine Fläche"],
  faceHint: ["Click a face: the plane goes through it.", "Eine Fläche anklicken: Die Ebene geht durch sie."],
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

  basemap: ["Basemap", "Grundkarte"],

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
  noEdges: [
    "This volume was built without edges (svt build --vectors edges).",
    "Dieses Volumen wurde ohne Kanten gebaut (svt build --vectors edges).",
  ],
  copyEmbeddingHint: [
    "An iframe with this view, for pages that may show this site: a published folder may be shown anywhere.",
    "Ein iframe mit dieser Ansicht, für Seiten, die diese zeigen dürfen: Ein veröffentlichter Ordner darf überall gezeigt werden.",
  ],
  linkOnThisMachine: [
    "Copied. The address works only on this computer: others cannot open it.",
    "Kopiert. Die Adresse gilt nur auf diesem Rechner: Andere können sie nicht öffnen.",
  ],
  linkTooLong: [
    "Copied. The link has {n} characters; some programs shorten such links. A file of bookmarks is safer.",
    "Kopiert. Der Link hat {n} Zeichen; manche Programme kürzen solche Links. Eine Datei mit Lesezeichen ist sicherer.",
  ],
  cityFound: ["{n} in the whole city", "{n} in der ganzen Stadt"],
  cityFoundFirst: ["{n} in the whole city; these are the first {most}", "{n} in der ganzen Stadt; dies sind die ersten {most}"],
  cityNone: [
    "No building of the city has these words; Enter searches for an id.",
    "Kein Gebäude der Stadt hat diese Wörter; die Eingabetaste sucht nach einer Kennung.",
  ],
  cityHits: ["Buildings that were found", "Gefundene Gebäude"],
} as const satisfies Record<string, readonly [string, string]>;

export type ToolTextKey = keyof typeof kToolTexts;

export function toolText(key: ToolTextKey, values: Record<string, string | number> = {}): string {
  return inLanguage(key, kToolTexts[key], values);
}

/** The hint of a tool, for a mouse or for fingers. */
export function toolHint(tool: "lens" | "walk" | "measure"): string {
  return toolText(`${tool}${matchMedia("(pointer: coarse)").matches ? "Touch" : "Hint"}`);
}

/** The English of these texts, for translation in a language file. */
export function toolTemplate(): Record<string, string> {
  return Object.fromEntries(Object.entries(kToolTexts).map(([key, [english]]) => [key, english]));
}
