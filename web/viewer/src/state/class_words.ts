/** German words for classes of building models, so that a search in German finds them. */

const kWords: [pattern: RegExp, words: string][] = [
  [/^(GroundSurface|Footing|Pile)/, "Grundfläche Fundament Gründung"],
  [/Window/, "Fenster"],
  [/Door/, "Tür Türe"],
  [/(Wall|CurtainWall)/, "Wand Mauer"],
  [/(Slab|Ceiling|Floor)/, "Decke Boden Platte"],
  [/Roof/, "Dach"],
  [/(Room|Space|Zone|CellSpace)/, "Raum Zimmer"],
  [/(BuildingUnit|Unit)/, "Wohnung Einheit"],
  [/Storey/, "Geschoss Stockwerk Etage"],
  [/(Building|BuildingPart)$/, "Gebäude Haus"],
  [/(Stair|Ramp)/, "Treppe Rampe"],
  [/Railing/, "Geländer"],
  [/Column/, "Stütze Säule"],
  [/(Beam|Member)/, "Träger Balken Unterzug"],
  [/Furni/, "Möbel Einrichtung"],
  [/(Opening|Filling)/, "Öffnung"],
  [/Installation/, "Einbau Anbau"],
  [/Chimney/, "Schornstein Kamin"],
  [/(Covering|Closure)/, "Belag Abschluss"],
  [/Bridge/, "Brücke"],
  [/(Vegetation|Plant)/, "Pflanze Baum"],
];

/** German words for a class, separated by spaces; empty where there are none. */
export function classWords(className: string): string {
  return kWords.filter(([pattern]) => pattern.test(className)).map(([, words]) => words).join(" ");
}
