/**
 * All texts of the page, English and German side by side. `{x}` is a placeholder. Other languages come from files with
 * the same keys, see languages.ts.
 */

import { kSceneMembers, type SceneMember, type Unit } from "./generated/scene_members";
import { signal } from "./observable";

const kTexts = {
  appName: ["Viewer", "Betrachter"],
  tagline: ["Buildings, cut open", "Gebäude, aufgeschnitten"],
  open: ["Open a model", "Modell öffnen"],
  openHint: ["Open a file ({kinds})", "Datei öffnen ({kinds})"],
  models: ["Models", "Modelle"],
  model: ["Model", "Modell"],
  dropTitle: ["Drop a building here", "Ein Gebäude hierher ziehen"],
  dropText: [
    "A volume (.svt), or CityGML, CityJSON, IFC or IndoorGML ({kinds}), one or several. It stays on this computer.",
    "Ein Volumen (.svt) oder CityGML, CityJSON, IFC oder IndoorGML ({kinds}), eines oder mehrere. Es bleibt auf diesem Rechner.",
  ],
  dropNow: ["Drop to open", "Loslassen zum Öffnen"],
  dropCompare: ["Drop to compare", "Loslassen zum Vergleichen"],
  compare: ["Compare with …", "Vergleichen mit …"],
  choose: ["Choose a file", "Datei wählen"],
  startFeatures: [
    "Cut it along any plane, look through walls with a lens, find rooms and walls by name, and share the view as a link.",
    "Entlang jeder Ebene schneiden, mit einer Linse durch Wände sehen, Räume und Wände mit Namen suchen und die Ansicht als Link teilen.",
  ],
  starting: ["Starting", "Wird gestartet"],
  loadingFile: ["Loading {name}", "{name} wird geladen"],
  fourViews: ["Four views: 3D, plan and two sections", "Vier Ansichten: 3D, Grundriss und zwei Schnitte"],
  loadingModel: ["Loading the model", "Das Modell wird geladen"],
  cityLacks: [
    "{n} tiles of the city cannot be shown; all others are shown. {first}",
    "{n} Kacheln der Stadt lassen sich nicht zeigen; alle anderen sind da. {first}",
  ],
  cityMissing: ["{n} tiles are missing", "{n} Kacheln fehlen"],
  cityMissingOne: ["1 tile is missing", "1 Kachel fehlt"],
  cityMissingSome: ["Finer tiles are missing", "Feinere Kacheln fehlen"],
  cityFetchAgain: ["Fetch again", "Erneut holen"],
  cityFetchingAgain: ["Fetching again", "Wird erneut geholt"],
  cityAllThere: ["The missing tiles have come.", "Die fehlenden Kacheln sind da."],
  cityStopped: ["No finer tiles of the city", "Keine feineren Kacheln der Stadt"],
  cityNoRanges: [
    "{name}: the server sends whole files instead of parts. A city needs a server with range requests (svt serve, nginx, Apache, S3).",
    "{name}: Der Server sendet ganze Dateien statt Teilen. Eine Stadt braucht einen Server mit Bereichsanfragen (svt serve, nginx, Apache, S3).",
  ],
  cityWrongRange: [
    "{name}: the server sent other bytes than requested, or not all of them.",
    "{name}: Der Server sandte andere Bytes als angefordert, oder nicht alle.",
  ],
  cityChanged: [
    "{name}: the city has changed since it was opened; load the page again.",
    "{name}: Die Stadt hat sich seit dem Öffnen geändert; die Seite neu laden.",
  ],
  cityNoAnswer: ["{name}: the server does not answer ({reason}).", "{name}: Der Server antwortet nicht ({reason})."],
  loadedBytes: ["{done} of {all}", "{done} von {all}"],
  stepRead: ["Reading", "Wird gelesen"],
  stepOpen: ["Opening", "Wird geöffnet"],
  failedTitle: ["This file could not be opened", "Diese Datei konnte nicht geöffnet werden"],
  wrongKind: [
    "{name} is not a volume or building model. Their names end with {kinds}, optionally followed by .gz.",
    "{name} ist weder Volumen noch Gebäudemodell. Deren Namen enden auf {kinds}, wahlweise gefolgt von .gz.",
  ],
  noModel: ["There is no model '{name}' here; the first one is shown.", "Hier gibt es kein Modell '{name}'; das erste wird gezeigt."],
  notLoaded: ["{name} could not be loaded ({status}).", "{name} konnte nicht geladen werden ({status})."],
  notReached: [
    "{name} could not be fetched: the server does not answer, or does not let other sites read the file (CORS).",
    "{name} ließ sich nicht holen: Der Server antwortet nicht, oder er lässt andere Seiten die Datei nicht lesen (CORS).",
  ],
  cannotRun: [
    "The library cannot run in this browser: it needs WebAssembly with SIMD (Chrome 91, Firefox 89, Safari 16.4 or later).",
    "Die Bibliothek läuft in diesem Browser nicht: Sie braucht WebAssembly mit SIMD (ab Chrome 91, Firefox 89, Safari 16.4).",
  ],
  serverPictures: [
    "Pictures come from the server, because the library cannot run in this browser. Views, sections and looks work; tree and picking do not.",
    "Die Bilder kommen vom Server, weil die Bibliothek in diesem Browser nicht läuft. Ansichten, Schnitte und Stile gehen; Baum und Auswahl im Bild nicht.",
  ],
  cancel: ["Cancel", "Abbrechen"],
  cancelled: ["{name} was not opened: cancelled.", "{name} wurde nicht geöffnet: abgebrochen."],
  awaitsFile: [
    "This link shows {name}, a file that is not part of it. Open {name} here to see the view.",
    "Dieser Link zeigt {name}, eine Datei, die er nicht enthält. {name} hier öffnen, um die Ansicht zu sehen.",
  ],
  keepFile: ["Keep {name} in this browser", "{name} in diesem Browser behalten"],
  undo: ["Undo: {what}", "Zurücknehmen: {what}"],
  redo: ["Redo: {what}", "Wiederholen: {what}"],
  undoNothing: ["Nothing to undo", "Nichts zurückzunehmen"],
  redoNothing: ["Nothing to redo", "Nichts zu wiederholen"],
  undone: ["Undone: {what}", "Zurückgenommen: {what}"],
  redone: ["Redone: {what}", "Wiederholt: {what}"],
  stepCamera: ["Point of view", "Blick"],
  stepVisibility: ["Show or hide", "Zeigen oder verbergen"],
  stepStyles: ["Colour and opacity", "Farbe und Deckkraft"],
  reopened: [
    "The library had stopped and was started again. {error}",
    "Die Bibliothek war stehen geblieben und wurde neu gestartet. {error}",
  ],
  refused: ["This cannot be drawn; the last choice was taken back", "Das lässt sich nicht zeichnen; die letzte Wahl ist zurückgenommen"],
  makeRoomsSolid: ["Make rooms solid", "Räume undurchsichtig machen"],
  dismiss: ["Dismiss", "Schließen"],
  close: ["Close", "Schließen"],
  cpuKind: ["drawn without a graphics card", "ohne Grafikkarte gezeichnet"],
  glKind: ["drawn with WebGL 2", "mit WebGL 2 gezeichnet"],
  frame: ["{width} × {height}, {ms} ms", "{width} × {height}, {ms} ms"],
  findings: ["{n} findings", "{n} Befunde"],
  findingsTitle: ["Findings in the model", "Befunde im Modell"],
  theme: ["Dark or light", "Dunkel oder hell"],
  language: ["DE, Deutsch", "EN, English"],
  languages: ["Language", "Sprache"],
  noLanguage: ["{name} is not a language file.", "{name} ist keine Sprachdatei."],
  helpTitle: ["Mouse, touch and keys", "Maus, Finger und Tasten"],
  help: ["Help", "Hilfe"],
  panelTree: ["Parts", "Teile"],
  panelProperties: ["Selection", "Auswahl"],
  showPanel: ["Show or hide: {panel}", "Zeigen oder verbergen: {panel}"],
  resizeTree: ["Width of the parts panel", "Breite der Teileliste"],
  skipToPicture: ["To the picture", "Zum Bild"],

  structure: ["Structure", "Aufbau"],
  classes: ["Classes", "Klassen"],
  search: ["Search names and attributes", "Namen und Attribute suchen"],
  found: ["{n} found", "{n} gefunden"],
  nothingFound: ["Nothing found", "Nichts gefunden"],
  queryLabel: ["Query", "Abfrage"],
  queryPlaceholder: ["class=BuildingRoom and volume>20", "class=BuildingRoom and volume>20"],
  select: ["Select", "Auswählen"],
  selectedByQuery: ["{n} selected", "{n} ausgewählt"],
  showAll: ["Show all", "Alles zeigen"],
  hide: ["Hide", "Verbergen"],
  show: ["Show", "Zeigen"],
  onlyThis: ["Only this", "Nur dies"],
  isHidden: ["hidden", "verborgen"],
  hiddenCount: ["{n} hidden", "{n} verborgen"],
  filterNote: ["Shown: {name}", "Gezeigt: {name}"],
  shownOf_rooms: ["{n} rooms", "{n} Räume"],
  shownOf_flats: ["{n} flats", "{n} Wohnungen"],
  shownOf_walls: ["{n} walls", "{n} Wände"],
  shownOf_windows: ["{n} windows", "{n} Fenster"],
  shownOf_doors: ["{n} doors", "{n} Türen"],
  shownOf_parts: ["{n} parts", "{n} Teile"],
  parts: ["{n} parts", "{n} Teile"],
  onePart: ["1 part", "1 Teil"],
  colorOf: ["Colour of {name}", "Farbe von {name}"],
  opacityOf: ["Opacity of {name}", "Deckkraft von {name}"],
  color: ["Colour", "Farbe"],
  opacity: ["Opacity", "Deckkraft"],
  resetStyle: ["As in the model", "Wie im Modell"],
  styleOf: ["Colour and opacity of {name}", "Farbe und Deckkraft von {name}"],

  nothingSelected: ["Nothing selected", "Nichts ausgewählt"],
  severalSelected: ["{n} selected", "{n} ausgewählt"],
  floorArea: ["Floor area", "Grundfläche"],
  surface: ["Surface", "Oberfläche"],
  extent: ["Extent", "Ausdehnung"],
  outside: ["Outside air", "Außenluft"],
  noAttributes: ["none", "keine"],
  cutawayTo: ["Cut away to it", "Freischneiden"],
  highlightIt: ["Highlight", "Hervorheben"],
  deselect: ["Deselect", "Auswahl aufheben"],
  alongTitle: ["Along this ray", "Entlang dieses Strahls"],
  picked: ["Selected: {name}, {class}", "Ausgewählt: {name}, {class}"],
  pickedNothing: ["Nothing there", "Dort ist nichts"],
  showOthers: ["Show the others again", "Die anderen wieder zeigen"],
  zoomToIt: ["Zoom to it", "Heranzoomen"],
  sameType: ["Select all of this type ({type})", "Alle dieser Art auswählen ({type})"],
  sameStorey: ["Select all of this storey ({name})", "Alles in diesem Geschoss auswählen ({name})"],
  copyId: ["Copy the id", "Kennung kopieren"],
  actionsHint: ["Actions (Ctrl and K)", "Aktionen (Strg und K)"],
  tableHint: ["Table of objects", "Tabelle der Objekte"],
  quantities: ["Quantities", "Mengen"],
  storey: ["Storey", "Geschoss"],

  tools: ["Tools", "Werkzeuge"],
  section: ["Section", "Schnitt"],
  lens: ["Lens", "Linse"],
  focus: ["Focus", "Fokus"],
  look: ["Look", "Stil"],
  measure: ["Measure", "Messen"],
  views: ["Views", "Ansichten"],
  share: ["Keep", "Sichern"],

  coarseNow: ["Coarse for now: {spacing} m", "Vorerst grob: {spacing} m"],
  makingFiner: ["Refining", "Wird verfeinert"],
  makeFiner: ["Make it finer", "Verfeinern"],
  stayCoarse: ["Leave it so", "So lassen"],
  staysCoarse: ["The picture stays coarse: {spacing} m from voxel to voxel.", "Das Bild bleibt grob: {spacing} m von Voxel zu Voxel."],
  isFiner: ["Now fine: {spacing} m", "Jetzt fein: {spacing} m"],
  spacingTold: ["Voxels of {reason}", "Voxel von {reason}"],
  stage_read: ["Reading", "Wird gelesen"],
  stage_mesh: ["Faces", "Flächen"],
  stage_close: ["Closing shells", "Hüllen werden geschlossen"],
  stage_voxelize: ["Voxels", "Voxel"],
  stage_patterns: ["Patterns", "Muster"],
  stage_pack: ["Packing", "Wird verpackt"],
  stage_tiles: ["Tiles", "Kacheln"],
  ownersNeedModel: [
    "{name} is a table of owners: open the model first, or drop both together.",
    "{name} ist eine Tabelle von Eigentümern: erst das Modell öffnen, oder beide zusammen ablegen.",
  ],
  ownersGiven: [
    "The owners are from {name}; colours show them. Queries: owner=NAME.",
    "Eigentümer nach {name}; die Farben zeigen sie. Abfragen: owner=NAME.",
  ],
  ownersUnknown: [
    "Rows that name no feature have no effect: {n}. Line {first}",
    "Zeilen ohne Wirkung, weil sie kein Objekt nennen: {n}. Zeile {first}",
  ],
  movedPlane: [
    "{plane} lies in faces of the model and is drawn {mm} mm beside them, on the kept side.",
    "{plane} liegt in Flächen des Modells und ist {mm} mm daneben gezeichnet, auf der Seite, die bleibt.",
  ],
  moreStoreys: ["Storey", "Geschoss"],
  addPlane: ["Add a plane", "Ebene hinzufügen"],
  flip: ["Other side", "Andere Seite"],
  storeyCut: ["Cut {name} at 1.1 m", "{name} auf 1,1 m schneiden"],
  hatches: ["Hatches", "Schraffuren"],
  drawing: ["Drawing", "Zeichnung"],
  sheets: ["Sheets", "Blätter"],
  handleLabel: ["Plane {n}: arrow keys move it", "Ebene {n}: Pfeiltasten verschieben sie"],

  context: ["Around it", "Drumherum"],
  contextGhost: ["Ghost", "Geist"],
  contextShell: ["Hull", "Hülle"],
  contextSolid: ["Solid", "Fest"],
  contextNone: ["Nothing", "Nichts"],

  focusEffect: ["Effect", "Wirkung"],
  effectNone: ["Off", "Aus"],
  effectHighlight: ["Highlight", "Hervorheben"],
  effectCutaway: ["Cut away", "Freischneiden"],
  focusOn: ["On", "Worauf"],
  shell: ["Hulls only", "Nur Hüllen"],
  shellOff: ["All of it", "Alles"],
  shell_component: ["Components", "Bauteile"],
  shell_room: ["Rooms", "Räume"],
  shell_unit: ["Flats", "Wohnungen"],
  shell_storey: ["Storeys", "Geschosse"],
  shell_building: ["Building", "Gebäude"],

  look_plain: ["Plain", "Schlicht"],
  look_paper: ["Paper", "Papier"],
  look_blueprint: ["Blueprint", "Blaupause"],
  look_dark: ["Dark", "Dunkel"],
  wireframe: ["Edges of the model", "Kanten des Modells"],
  exactSurfaces: ["Exact surfaces", "Genaue Flächen"],
  wireframe_off: ["Off", "Aus"],
  wireframe_faint: ["Hidden faint", "Verdeckte blass"],
  wireframe_dashed: ["Hidden dashed", "Verdeckte gestrichelt"],
  wireframe_none: ["Visible only", "Nur sichtbare"],
  names: ["Names of the selection", "Namen der Auswahl"],
  colorBy: ["Colour by", "Farbe nach"],
  colorByNothing: ["The model's own colours", "Farben des Modells"],
  colorByFeatures: ["Of every component", "Von jedem Bauteil"],
  colorByAttributes: ["Attributes of the model", "Attribute des Modells"],
  colorKey: ["{key}: {kind}", "{key}: {kind}"],
  colorKeyCount: ["{key}: {kind}, {n} with a value", "{key}: {kind}, {n} mit Wert"],
  kindNumber: ["number", "Zahl"],
  kindText: ["text", "Text"],
  key_class: ["Class", "Klasse"],
  key_name: ["Name", "Name"],
  key_storey: ["Storey", "Geschoss"],
  key_volume: ["Volume", "Volumen"],
  key_area: ["Floor area of rooms", "Grundfläche der Räume"],
  key_owner: ["Owner", "Eigentümer"],
  compared: ["Comparison", "Vergleich"],
  difference: ["Difference", "Differenz"],
  label_title: ["Title", "Titel"],
  label_scaleBar: ["Scale bar", "Maßstab"],
  label_northArrow: ["North arrow", "Nordpfeil"],
  legend: ["Legend", "Legende"],
  legendRange: ["from {low} to {high}", "von {low} bis {high}"],
  legendMissing: ["without a value: {n}", "ohne Wert: {n}"],

  atCorner: ["at a corner", "an einer Ecke"],
  atEdge: ["on an edge", "auf einer Kante"],
  onFace: ["on a face", "auf einer Fläche"],
  measureOn: ["Measuring", "Messen"],
  distance: ["Length", "Länge"],
  area: ["Area", "Fläche"],
  points: ["Points", "Punkte"],
  lastStretch: ["Last stretch", "Letzte Strecke"],
  clear: ["Clear", "Leeren"],
  undoPoint: ["Remove the last point", "Letzten Punkt entfernen"],

  view_iso: ["Slanted", "Schräg"],
  view_front: ["Front", "Vorn"],
  view_back: ["Back", "Hinten"],
  view_left: ["Left", "Links"],
  view_right: ["Right", "Rechts"],
  view_top: ["Top", "Oben"],
  view_bottom: ["Bottom", "Unten"],
  fit: ["Show all of it", "Alles zeigen"],
  parallel: ["Parallel", "Parallel"],
  walk: ["Walk", "Gehen"],
  walkNowhere: ["There is no place to stand here.", "Hier ist kein Platz zum Stehen."],
  bcfExport: ["Save the bookmarks as BCF 3.0", "Die Lesezeichen als BCF 3.0 sichern"],
  fieldOfView: ["Field of view", "Blickwinkel"],

  keepView: ["Bookmark this view", "Lesezeichen setzen"],
  bookmarksExport: ["Save the bookmarks as a file", "Die Lesezeichen als Datei sichern"],
  bookmarksImport: ["Add bookmarks from a file (of this page, or BCF)", "Lesezeichen aus einer Datei hinzufügen (dieser Seite oder BCF)"],
  notKept: ["This browser does not store data for this page.", "Dieser Browser speichert nichts für diese Seite."],
  passOn: ["Pass on", "Weitergeben"],
  copyLink: ["Copy link", "Link kopieren"],
  copyCommand: ["Copy command", "Befehl kopieren"],
  copyEmbedding: ["Copy embedding code", "Code zum Einbetten kopieren"],
  sceneJson: ["Scene (JSON)", "Szene (JSON)"],
  apply: ["Apply", "Anwenden"],
  download: ["Download", "Herunterladen"],
  copy: ["Copy", "Kopieren"],
  copied: ["Copied", "Kopiert"],
  notCopied: ["The browser did not allow copying.", "Der Browser hat das Kopieren nicht erlaubt."],
  customScene: [
    "A scene is shown as written; tools that change parts are off.",
    "Eine Szene wird gezeigt, wie sie geschrieben ist; Werkzeuge für Teile sind aus.",
  ],
  leaveCustom: ["Back to the tools", "Zurück zu den Werkzeugen"],
  picture: ["Picture", "Bild"],
  pictureWidth: ["Width", "Breite"],
  pictureHeight: ["Height", "Höhe"],
  pictureSave: ["Save PNG", "PNG speichern"],
  pictureWorking: ["Drawing", "Wird gezeichnet"],
  badLink: ["The link is damaged; the model is shown as it is.", "Der Link ist beschädigt; das Modell wird gezeigt, wie es ist."],
  badJson: ["This is not JSON: {error}", "Das ist kein JSON: {error}"],
  stillLabel: ["Picture of {name}", "Bild von {name}"],
  pictureLabel: [
    "Picture of {name}. Arrow keys turn, Shift and arrow keys move, plus and minus zoom, Enter selects the object in the middle.",
    "Bild von {name}. Pfeiltasten drehen, Umschalt und Pfeiltasten verschieben, Plus und Minus zoomen, Eingabe wählt das Objekt in der Mitte.",
  ],

  keyAlong: ["List everything behind a point", "Alles hinter einem Punkt auflisten"],
} as const satisfies Record<string, readonly [string, string]>;

/**
 * German help of scene members whose controls show it; the English help is the declared one. A key that is not declared
 * does not compile, so that a change of a help text cannot leave an old translation behind.
 */
export const kGermanHelp = {
  "draw a scale bar; parallel projection only, because no other picture has a single scale":
    "zeichnet einen Maßstab; nur bei Parallelprojektion, denn kein anderes Bild hat einen einzigen Maßstab",
  "draw an arrow to true north": "zeichnet einen Pfeil nach geographisch Nord",
  "colour visible components by class, name, storey, volume, area of rooms, owner, voxels or an attribute, with a legend":
    "färbt sichtbare Bauteile nach class, name, storey, volume, area (Fläche von Räumen), owner, voxels oder einem Attribut, mit Legende",
  "width and height": "Breite und Höhe",
  "colours, lines and hatches of the whole picture: plain, paper (for print), blueprint or dark (for slides)":
    "Farben, Linien und Schraffuren des ganzen Bildes: schlicht, Papier (für den Druck), Blaupause oder dunkel (für Folien)",
  "the source of the labels: the voxels, or the faces of the model, which are exact at any spacing, but take up to a few times as long":
    "woraus das Bild entsteht: aus den Voxeln oder aus den Flächen des Modells, die bei jeder Auflösung genau sind, aber bis zu einige Male so lange dauern",
  "named view from which the picture is taken": "benannte Ansicht, aus der das Bild aufgenommen wird",
  "write a title into the picture": "schreibt einen Titel ins Bild",
  "parallel projection": "Parallelprojektion",
  "vertical field of view": "senkrechter Blickwinkel",
  "hatch cut faces, by material or class": "schraffiert Schnittflächen, nach Material oder Klasse",
  "name the visible labels that the query selects: inside them if the text fits, otherwise at the sides of the picture, with leader lines":
    "benennt die sichtbaren Teile der Auswahl: darin, wenn der Text passt, sonst an den Seiten des Bildes, mit Hinweislinien",
  "#rrggbb, #rgb or a colour name": "#rrggbb, #rgb oder ein englischer Farbname",
  "share of light stopped by 1 m; 1: solid, 0: hidden": "Anteil des Lichts, den 1 m aufhält; 1: undurchsichtig, 0: verborgen",
  "draw only the hulls of components, rooms, units, storeys or the building":
    "zeichnet nur die Hüllen von Bauteilen, Räumen, Wohnungen, Geschossen oder des Gebäudes",
  "lines behind opaque objects": "Linien hinter Undurchsichtigem",
} as const satisfies { [Help in HelpOf<SceneMember>]?: string };

type HelpOf<Name extends SceneMember> = (typeof kSceneMembers)[Name]["help"];

const kUnitSigns: Record<Unit, string> = { pixels: " px", degrees: "°", metres: " m", seconds: " s" };

export type TextKey = keyof typeof kTexts;
/** `en`, `de`, or the code of a language file: a BCP 47 tag. */
export type Language = string;

/** Texts of another language, by key; help of scene members by its English text. Missing texts are English. */
export interface LanguageTexts {
  texts: Record<string, string>;
  /** Words that find a class: `{"Window": "fenêtre"}`. */
  classes?: Record<string, string>;
}

/** Observable: a part that renders a text renders again when the language changes. */
const spoken = signal<{ language: Language; other: LanguageTexts | null }>({ language: "en", other: null });

export function language(): Language {
  return spoken.value.language;
}
export function otherTexts(): LanguageTexts | null {
  return spoken.value.other;
}
/** @param texts  of a language that is not built in */
export function setLanguage(wanted: Language, texts: LanguageTexts | null = null): void {
  spoken.value = { language: wanted, other: texts };
}
export function browserLanguage(): Language {
  return (navigator.languages ?? [navigator.language])
    .find((l) => /^(en|de)/i.test(l))
    ?.slice(0, 2)
    .toLowerCase() === "de"
    ? "de"
    : "en";
}

export function t(key: TextKey, values: Record<string, string | number> = {}): string {
  return inLanguage(key, kTexts[key], values);
}

/** @param key  of the text in a language file */
export function inLanguage(key: string, builtIn: readonly [string, string], values: Record<string, string | number> = {}): string {
  const { language, other } = spoken.value;
  const text: string = other?.texts[key] ?? builtIn[language === "de" ? 1 : 0];
  return text.replace(/\{(\w+)\}/g, (whole, name: string) => (name in values ? String(values[name]) : whole));
}

/** The English of all texts, for translation in a language file. */
export function template(): Record<string, string> {
  return Object.fromEntries([
    ...Object.entries(kTexts).map(([key, [english]]) => [key, english]),
    ...Object.keys(kGermanHelp).map((help) => [help, help]),
  ]);
}

/** The name of a stage of the library, or the library's own word. */
export function stageText(stage: string): string {
  const key = `stage_${stage}`;
  return key in kTexts ? t(key as TextKey) : stage;
}

export function movedText(planes: { text: string; by: number }[]): string {
  return planes.map(({ text, by }) => t("movedPlane", { plane: text, mm: number(1000 * by, 1) })).join(" ");
}

/** The label of a control for a member of a scene; without a text, the words of its name. */
export function memberLabel(member: SceneMember): string {
  const name = member.slice(member.lastIndexOf("/") + 1);
  const words = name.replace(/[A-Z]/g, (letter) => ` ${letter.toLowerCase()}`);
  return `label_${name}` in kTexts ? t(`label_${name}` as TextKey) : words.charAt(0).toUpperCase() + words.slice(1);
}

/** The help of a member of a scene, with its unit: the tooltip of its control. */
export function help(member: SceneMember): string {
  const declared: { help: string; unit?: Unit } = kSceneMembers[member];
  const german: Partial<Record<string, string>> = kGermanHelp;
  const text = otherTexts()?.texts[declared.help] ?? (language() === "de" ? german[declared.help] : undefined) ?? declared.help;
  const unit = declared.unit ? ` (${kUnitSigns[declared.unit].trim()})` : "";
  return text.charAt(0).toUpperCase() + text.slice(1) + unit;
}

/** Formats numbers in the chosen language. */
export function number(value: number, digits: number): string {
  const shown = Math.abs(value) < 0.5 * 10 ** -digits ? 0 : value; // not "-0.0"
  return shown.toLocaleString(language(), { minimumFractionDigits: digits, maximumFractionDigits: digits });
}
/** A share as whole per cent, rounded down: 100% is all of it. */
export function percentText(share: number): string {
  return (Math.floor(100 * share) / 100).toLocaleString(language(), { style: "percent" });
}
/** A day, from ISO 8601, in the chosen language; other text unchanged. */
export function dateText(text: string): string {
  const found = /^(\d{4})-(\d\d)-(\d\d)(T[\d:.]+(Z|[+-][\d:]+)?)?$/.exec(text);
  const date = found && new Date(Date.UTC(Number(found[1]), Number(found[2]) - 1, Number(found[3])));
  return date && !Number.isNaN(date.getTime()) ? date.toLocaleDateString(language(), { dateStyle: "medium", timeZone: "UTC" }) : text;
}
export function withUnit(value: number, digits: number, unit: Unit): string {
  return number(value, digits) + kUnitSigns[unit];
}
export function bytes(value: number): string {
  return value < 1e6 ? `${number(value / 1e3, 0)} kB` : `${number(value / 1e6, 1)} MB`;
}
