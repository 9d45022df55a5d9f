/** Texts of the comparison, English and German, as in texts.ts. Language files have them under the same keys. */

import { inLanguage } from "../texts";
import type { Change } from "./compared";

const kCompareTexts = {
  compareTitle: ["Comparison", "Vergleich"],
  compareOld: ["Old state", "Alter Stand"],
  compareNew: ["New state", "Neuer Stand"],
  compareNone: ["Choose a model", "Modell wählen"],
  compareFile: ["{state}: choose a file", "{state}: Datei wählen"],
  compareSwap: ["Swap old and new", "Alt und neu tauschen"],
  compareRun: ["Compare", "Vergleichen"],
  compareAgain: ["Compare again", "Erneut vergleichen"],
  compareStates: ["Files and options", "Dateien und Optionen"],
  compareHint: [
    "Choose an old and a new state: a volume (.svt) or a model, also in different formats. Objects are matched by the space that they occupy. The files stay on this computer.",
    "Wählen Sie einen alten und einen neuen Stand: ein Volumen (.svt) oder ein Modell, auch in verschiedenen Formaten. Objekte werden über den Raum zugeordnet, den sie einnehmen. Die Dateien bleiben auf diesem Rechner.",
  ],
  compareLinked: [
    "This link compares {old} with {new}. Choose the files that are missing here.",
    "Dieser Link vergleicht {old} mit {new}. Wählen Sie die Dateien, die hier fehlen.",
  ],
  compareTolerance: ["Tolerance, mm", "Toleranz, mm"],
  compareMatch: ["Match by", "Zuordnen nach"],
  match_both: ["space and ids", "Raum und Kennung"],
  match_space: ["space", "Raum"],
  match_id: ["ids", "Kennung"],
  compareProperties: ["Properties", "Eigenschaften"],
  properties_all: ["all", "alle"],
  properties_names: ["class, name, storey", "Klasse, Name, Geschoss"],
  properties_none: ["none", "keine"],
  compareAlign: ["Move the new model to the old one", "Das neue Modell auf das alte schieben"],
  compareWorking: ["{old} and {new} are being compared", "{old} und {new} werden verglichen"],
  stage_match: ["Matching objects", "Objekte werden zugeordnet"],
  stage_compare: ["Measuring changes", "Änderungen werden gemessen"],
  compareFailed: ["The files cannot be compared", "Die Dateien lassen sich nicht vergleichen"],
  compareDone: ["{n} changes between {old} and {new}", "{n} Änderungen zwischen {old} und {new}"],
  compareEqual: ["{old} and {new} have no differences.", "{old} und {new} haben keine Unterschiede."],
  compareBack: ["Back to {name}", "Zurück zu {name}"],
  compareBackTo: ["Comparison", "Vergleich"],
  compareSaveJson: ["Save the rows as JSON", "Zeilen als JSON speichern"],
  compareSaveSvt: ["Save the difference volume as SVT", "Differenzvolumen als SVT speichern"],

  compareShown: ["Shown state", "Gezeigter Stand"],
  shownOld: ["Old", "Alt"],
  shownBoth: ["Both", "Beide"],
  shownNew: ["New", "Neu"],
  compareSlider: ["From old to new", "Von alt nach neu"],

  compareLegend: ["Legend", "Legende"],
  legendAdded: ["added: {m3}", "neu: {m3}"],
  legendRemoved: ["removed: {m3}", "entfallen: {m3}"],
  legendMoved: ["moved: {n}", "verschoben: {n}"],
  legendChanged: ["remaining part of other changes: {n}", "bleibender Teil anderer Änderungen: {n}"],
  legendSame: ["unchanged: {n}", "unverändert: {n}"],
  legendSum: [
    "Components; rooms and buildings are not counted. Each sum ± {bound}.",
    "Bauteile; Räume und Gebäude zählen nicht mit. Jede Summe ± {bound}.",
  ],
  legendUnknown: ["{n} of {all} components have unknown volumes.", "{n} von {all} Bauteilen haben unbekannte Volumen."],
  compareClasses: ["By class", "Nach Klasse"],
  classHeading: ["Class", "Klasse"],
  addedHeading: ["added m³", "neu m³"],
  removedHeading: ["removed m³", "entfallen m³"],
  boundHeading: ["each ± m³", "je ± m³"],
  unknownHeading: ["unknown", "unbekannt"],

  change_same: ["other properties", "andere Eigenschaften"],
  change_moved: ["moved", "verschoben"],
  change_changed: ["changed", "geändert"],
  change_split: ["split", "geteilt"],
  change_merged: ["merged", "vereinigt"],
  change_reassigned: ["reassigned", "neu zugeordnet"],
  change_added: ["added", "neu"],
  change_removed: ["removed", "entfallen"],

  changes: ["Changes, largest first", "Änderungen, größte zuerst"],
  changesFilter: ["Filter: words", "Filter: Wörter"],
  changesKinds: ["Kinds of changes", "Arten der Änderungen"],
  changesCount: ["{n} of {all}", "{n} von {all}"],
  changesNone: ["No change matches.", "Keine Änderung passt."],
  unknown: ["unknown", "unbekannt"],
  rowAdded: ["+{m3} m³", "+{m3} m³"],
  rowRemoved: ["−{m3} m³", "−{m3} m³"],
  rowUnknown: ["volume unknown", "Volumen unbekannt"],
  rowExact: ["exact (± {bound} m³)", "exakt (± {bound} m³)"],
  rowVoxels: ["from voxels, ± {bound} m³", "aus Voxeln, ± {bound} m³"],
  rowNoBound: ["bound unknown", "Schranke unbekannt"],
  rowDistance: ["at least {m} m", "mindestens {m} m"],
  rowMoved: ["by ({x}; {y}; {z}) m", "um ({x}; {y}; {z}) m"],
  rowProperties: ["other: {names}", "anders: {names}"],
  rowNoSpace: ["no space of its own", "ohne eigenen Raum"],
  rowNotHere: ["This object has no space in the picture.", "Dieses Objekt hat im Bild keinen Raum."],

  noteShift: [
    "The new model is moved by ({x}; {y}; {z}) m for the comparison.",
    "Das neue Modell ist für den Vergleich um ({x}; {y}; {z}) m verschoben.",
  ],
  noteAligned: ["The models are aligned. No translation is applied.", "Die Modelle liegen richtig. Nichts wurde verschoben."],
  noteNotFound: [
    "No common translation is found. The models stay in their places.",
    "Keine gemeinsame Verschiebung gefunden. Die Modelle bleiben an ihrem Ort.",
  ],
  noteApart: ["The models do not overlap in space.", "Die Modelle überlappen sich nicht im Raum."],
  noteAlign: ["Move the new model and compare again", "Neues Modell verschieben und erneut vergleichen"],
  noteCrs: [
    "The reference system of a model is unknown. The coordinates are compared as they are.",
    "Das Bezugssystem eines Modells ist unbekannt. Die Koordinaten werden verglichen, wie sie sind.",
  ],
  noteMeshes: [
    "A volume has no meshes, so voxels decide. Changes smaller than a voxel may be missing. Volumes need --vectors meshes for exact values.",
    "Ein Volumen hat keine Netze, also entscheiden Voxel. Änderungen unter Voxelgröße können fehlen. Genaue Werte brauchen Volumen mit --vectors meshes.",
  ],
  noteLattice: [
    "The two volumes have different sample positions. The volumes of objects without closed meshes are unknown, and the page cannot draw both states. Give one state as a model.",
    "Die beiden Volumen haben verschiedene Abtastpunkte. Objekte ohne geschlossene Netze haben keine Volumen, und es gibt kein Bild beider Stände. Geben Sie einen Stand als Modell.",
  ],
  noteIncomplete: [
    "Some pairs of objects have too many faces for exact volumes. Their volumes come from voxels.",
    "Einige Paare von Objekten haben zu viele Flächen für genaue Volumen. Deren Volumen kommen aus Voxeln.",
  ],
  noteNoPicture: ["The page cannot draw both states: {reason}", "Es gibt kein Bild beider Stände: {reason}"],
  noteFindings: ["{n} findings in the models", "{n} Befunde in den Modellen"],
} as const satisfies Record<string, readonly [string, string]>;

export type CompareTextKey = keyof typeof kCompareTexts;

export function compareText(key: CompareTextKey, values: Record<string, string | number> = {}): string {
  return inLanguage(key, kCompareTexts[key], values);
}

export const changeText = (change: Change): string => compareText(`change_${change}`);

/** The name of a stage of the comparison; null: unknown here. */
export function compareStage(stage: string): string | null {
  return stage === "match" || stage === "compare" ? compareText(`stage_${stage}`) : null;
}

/** The English of these texts, for translation in a language file. */
export function compareTemplate(): Record<string, string> {
  return Object.fromEntries(Object.entries(kCompareTexts).map(([key, [english]]) => [key, english]));
}
