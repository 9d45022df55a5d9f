/** Words for classes of building models and types of IFC: to show, and for a search in the page's language. */

import { signal } from "../observable";
import { language, otherTexts } from "../texts";

type Terms = Readonly<Record<string, readonly [english: string, german: string]>>;

/** The words of the library, which come when they are first needed; null: not yet. */
const terms = signal<Terms | null>(null);

/** Resolves when the words are there, or cannot be loaded. */
export async function loadTerms(): Promise<void> {
  terms.value ??= await import("../generated/class_terms").then(
    ({ kClassTerms }) => kClassTerms,
    () => null,
  );
}

function termOf(name: string): readonly [english: string, german: string] | undefined {
  if (!terms.value) void loadTerms();
  return terms.value?.[bareName(name)];
}

/** The name in the tables of words: without its namespace, the prefix Ifc, and the endings of IFC for the same thing. */
function bareName(name: string): string {
  return name
    .replace(/^.*:/, "")
    .replace(/^Ifc(?=[A-Z])/, "")
    .replace(/(Standard|Elemented)Case$/, "");
}

/** The word for a class or a type in the language of the page. English pages show the name itself, and so do others without a word. */
export function classText(name: string): string {
  const other = otherTexts()?.classes;
  if (other) return other[name] ?? other[bareName(name)] ?? name;
  return (language() === "de" ? termOf(name)?.[1] : undefined) ?? name;
}

/** More words, for a search. */
const kWords: [pattern: RegExp, german: string, english: string][] = [
  [/^(GroundSurface|Footing|Pile)|Footing|Pile$/, "Grundfläche Fundament Gründung", "foundation"],
  [/Window/, "Fenster", "window glazing"],
  [/Door/, "Tür Türe", "door"],
  [/(Wall|CurtainWall)/, "Wand Mauer Fassade", "wall facade"],
  [/(Slab|Ceiling|Floor)/, "Decke Boden Platte", "slab floor ceiling"],
  [/Roof/, "Dach", "roof"],
  [/(Room|Space|Zone|CellSpace)/, "Raum Zimmer", "room space"],
  [/(BuildingUnit|Unit)/, "Wohnung Einheit", "flat apartment unit"],
  [/Storey/, "Geschoss Stockwerk Etage", "storey story level"],
  [/(Building|BuildingPart)$/, "Gebäude Haus", "building house"],
  [/(Stair|Ramp)/, "Treppe Rampe", "stairs ramp"],
  [/Railing/, "Geländer", "railing balustrade"],
  [/Column/, "Stütze Säule", "column pillar"],
  [/(Beam|Member)/, "Träger Balken Unterzug", "beam girder"],
  [/Furni/, "Möbel Einrichtung", "furniture"],
  [/(Opening|Filling)/, "Öffnung", "opening"],
  [/Installation/, "Einbau Anbau", "installation"],
  [/Chimney/, "Schornstein Kamin", "chimney"],
  [/(Covering|Closure)/, "Belag Abschluss", "covering finish"],
  [/Bridge/, "Brücke", "bridge"],
  [/(Vegetation|Plant)/, "Pflanze Baum", "plant tree"],
  [/(Pipe|FlowSegment|Duct)/, "Rohr Leitung Kanal", "pipe duct"],
];

/** Words for a class and a type of IFC, separated by spaces: German, English, and those of the page's own language. */
export function classWords(className: string, type = ""): string {
  const isFor = (pattern: RegExp) => pattern.test(className) || pattern.test(type);
  const words = kWords.filter(([pattern]) => isFor(pattern)).map(([, german, english]) => `${german} ${english}`);
  const listed = [className, type].flatMap((name) => termOf(name) ?? []);
  const own = Object.entries(otherTexts()?.classes ?? {})
    .filter(([name]) => className.includes(name) || type.includes(name))
    .map(([, word]) => word);
  return [...words, ...listed, ...own].join(" ");
}
