/** Texts of the quantities, English and German, as in texts.ts. Language files have them under the same keys. */

import { inLanguage } from "../texts";

const kQuantityTexts = {
  quantitiesHint: [
    "Measured from the model file, as by svt quantities. The file stays on this computer.",
    "Gemessen aus der Modelldatei, wie mit svt quantities. Die Datei bleibt auf diesem Rechner.",
  ],
  quantitiesReading: ["{name} is being read", "{name} wird gelesen"],
  quantityStage_measure: ["Measuring objects", "Objekte werden gemessen"],
  quantityStage_share: ["Finding space that objects share", "Gemeinsamer Raum wird gesucht"],
  quantityStage_touch: ["Finding neighbours of faces", "Nachbarn der Flächen werden gesucht"],
  quantitiesFailed: ["The quantities cannot be measured", "Die Mengen lassen sich nicht messen"],
  quantitiesDone: ["{n} objects are measured", "{n} Objekte sind gemessen"],
  quantitiesStopped: ["Stopped.", "Abgebrochen."],
  quantitiesNone: ["Open a model to measure it.", "Öffnen Sie ein Modell, um es zu messen."],
  quantitiesCity: [
    "The page measures single models. The command measures a city: svt quantities TOWN. Or open a part of it (svt city extract).",
    "Die Seite misst einzelne Modelle. Der Befehl misst eine Stadt: svt quantities TOWN. Oder öffnen Sie einen Teil (svt city extract).",
  ],
  quantitiesCompared: [
    "The open volume has two states. Go back to one of them to measure it.",
    "Das offene Volumen hat zwei Stände. Gehen Sie zu einem zurück, um ihn zu messen.",
  ],
  quantitiesLost: [
    "The file of the open model is not available. Open it again.",
    "Die Datei des offenen Modells fehlt. Öffnen Sie sie erneut.",
  ],

  quantitiesOptions: ["Options", "Optionen"],
  quantitiesWhere: ["Objects of a query", "Objekte einer Abfrage"],
  quantitiesAll: ["all components", "alle Bauteile"],
  quantitiesFormwork: ["Formwork of a query", "Schalung einer Abfrage"],
  quantitiesNoFormwork: ["none", "keine"],
  quantitiesExterior: ["Exterior area by orientation", "Außenfläche nach Richtung"],
  quantitiesRun: ["Measure", "Messen"],
  quantitiesBy: ["Sums by", "Summen nach"],
  quantitiesThenBy: ["then by", "dann nach"],
  quantitiesNoKey: ["no key", "keinem Merkmal"],
  quantitiesShown: ["Shown table", "Gezeigte Tabelle"],
  quantitiesObjects: ["Objects", "Objekte"],
  quantitiesSums: ["Sums", "Summen"],
  quantitiesFilter: ["Filter: words in all columns", "Filter: Wörter in allen Spalten"],
  quantitiesCount: ["{n} of {all}", "{n} von {all}"],
  quantitiesNoRow: ["No row matches.", "Keine Zeile passt."],
  quantitiesTotal: ["All {n} objects", "Alle {n} Objekte"],
  quantitiesUnknown: ["unknown", "unbekannt"],
  quantitiesPartial: ["{value}, without {n} objects whose figure is unknown", "{value}, ohne {n} Objekte mit unbekanntem Wert"],
  quantitiesSpacing: [
    "Samples every {m} m. Volumes from voxels and areas by neighbours depend on it.",
    "Abtastpunkte alle {m} m. Volumen aus Voxeln und Flächen nach Nachbarn hängen davon ab.",
  ],
  quantitiesLegend: [
    "– is unknown or not defined, never 0. * leaves out objects whose figure is unknown.",
    "– ist unbekannt oder nicht definiert, nie 0. * lässt Objekte mit unbekanntem Wert aus.",
  ],
  quantitiesAssumptions: ["Assumptions", "Annahmen"],
  quantitiesFindings: ["{n} findings in the model", "{n} Befunde im Modell"],
  quantitiesSaveCsv: ["Save the shown table as CSV", "Gezeigte Tabelle als CSV speichern"],
  quantitiesSaveJson: ["Save rows and sums as JSON", "Zeilen und Summen als JSON speichern"],
  quantitiesNotHere: ["This object has no space in the picture.", "Dieses Objekt hat im Bild keinen Raum."],
  quantitiesSort: ["Sort by {name}", "Nach {name} sortieren"],

  trust_exact: ["exact", "exakt"],
  trust_tight: ["tight", "dicht"],
  trust_caps: ["closed by caps", "mit Deckeln geschlossen"],
  trust_voxels: ["voxels", "Voxel"],
  trust_assumed: ["assumed material", "angenommenes Material"],

  column_id: ["ID", "Kennung"],
  column_class: ["Class", "Klasse"],
  column_name: ["Name", "Name"],
  column_storey: ["Storey", "Geschoss"],
  column_material: ["Material", "Material"],
  column_color: ["Colour", "Farbe"],
  column_objects: ["Objects", "Objekte"],
  column_netVolume: ["Net volume", "Nettovolumen"],
  column_grossVolume: ["Gross volume", "Bruttovolumen"],
  column_sideArea: ["Side area", "Seitenfläche"],
  column_topArea: ["Top area", "Fläche oben"],
  column_bottomArea: ["Bottom area", "Fläche unten"],
  column_outerArea: ["Outer area", "Oberfläche"],
  column_exteriorArea: ["Exterior area", "Außenfläche"],
  column_openingArea: ["Opening area", "Öffnungsfläche"],
  column_formworkArea: ["Formwork area", "Schalfläche"],
  column_formworkTopArea: ["Formwork on top", "Schalfläche oben"],
  column_thickness: ["Thickness", "Dicke"],
  column_length: ["Length", "Länge"],
  column_width: ["Width", "Breite"],
  column_height: ["Height", "Höhe"],
  column_perimeter: ["Perimeter", "Umfang"],
  column_exteriorCountedArea: ["Exterior area, divided by points", "Außenfläche, durch Punkte geteilt"],
  column_exterior_n: ["Exterior, north", "Außen, Nord"],
  column_exterior_ne: ["Exterior, north-east", "Außen, Nordost"],
  column_exterior_e: ["Exterior, east", "Außen, Ost"],
  column_exterior_se: ["Exterior, south-east", "Außen, Südost"],
  column_exterior_s: ["Exterior, south", "Außen, Süd"],
  column_exterior_sw: ["Exterior, south-west", "Außen, Südwest"],
  column_exterior_w: ["Exterior, west", "Außen, West"],
  column_exterior_nw: ["Exterior, north-west", "Außen, Nordwest"],
  column_exterior_top: ["Exterior, top", "Außen, oben"],
  column_exterior_bottom: ["Exterior, bottom", "Außen, unten"],
  column_openings: ["Openings", "Öffnungen"],
  column_trust: ["Source", "Quelle"],
  column_bound: ["Net volume ±", "Nettovolumen ±"],
  column_grossBound: ["Gross volume, further ±", "Bruttovolumen, weitere ±"],
} as const satisfies Record<string, readonly [string, string]>;

export type QuantityTextKey = keyof typeof kQuantityTexts;

export function quantityText(key: QuantityTextKey, values: Record<string, string | number> = {}): string {
  return inLanguage(key, kQuantityTexts[key], values);
}

/** The title of a column; a key of sums, such as an attribute, is its own title. */
export function columnText(column: string): string {
  const key = `column_${column}`;
  return key in kQuantityTexts ? quantityText(key as QuantityTextKey) : column;
}

/** The source of a volume, or the library's own word. */
export function trustText(trust: string): string {
  const key = `trust_${trust}`;
  return key in kQuantityTexts ? quantityText(key as QuantityTextKey) : trust;
}

/** The name of a stage of measuring; null: unknown here. */
export function quantityStage(stage: string): string | null {
  const key = `quantityStage_${stage}`;
  return key in kQuantityTexts ? quantityText(key as QuantityTextKey) : null;
}

/** The English of these texts, for translation in a language file. */
export function quantityTemplate(): Record<string, string> {
  return Object.fromEntries(Object.entries(kQuantityTexts).map(([key, [english]]) => [key, english]));
}
