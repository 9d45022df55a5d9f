/** Keys that colour a model. The choice of a key makes rooms solid if they have its values. */

import type { VolumeInfo } from "../engine";
import type { FeatureIndex } from "./feature_index";
import { ofClass } from "./queries";
import { hiddenSpaces, withoutSpaces } from "./spaces";
import { withStyle, type ViewState } from "./view_state";

export interface ColorKey {
  key: string;
  isNumber: boolean;
  /** Number of features with a value; null: unknown. */
  count: number | null;
  /** Whether rooms and other spaces have values. */
  spaces: "none" | "some" | "only";
}

/** Keys of the query language, then the attributes of the model. */
export interface ColorKeys {
  own: ColorKey[];
  attributes: ColorKey[];
}

export function colorKeys(info: VolumeInfo, index: FeatureIndex, hasOwners: boolean): ColorKeys {
  const solids = index.features.filter(({ count }) => count > 0);
  const named = solids.filter(({ name }) => name !== "").length;
  const rooms = solids.filter(({ isSpace }) => isSpace).length;
  const own: ColorKey[] = [
    { key: "class", isNumber: false, count: solids.length, spaces: "none" },
    { key: "name", isNumber: false, count: named, spaces: "none" },
    { key: "storey", isNumber: false, count: null, spaces: "none" },
    { key: "volume", isNumber: true, count: solids.length, spaces: rooms ? "some" : "none" },
    ...(rooms ? [{ key: "area", isNumber: true, count: rooms, spaces: "only" as const }] : []),
    ...(hasOwners ? [{ key: "owner", isNumber: false, count: null, spaces: "none" as const }] : []),
  ];
  const uses = info.attributeUses ?? info.attributes.map((name) => ({ name, count: 0, onSpaces: 0, isNumber: false }));
  const attributes = uses
    .filter(({ name }) => !own.some(({ key }) => key === name))
    .map(({ name, count, onSpaces, isNumber }): ColorKey => {
      const spaces = onSpaces === 0 ? "none" : onSpaces === count ? "only" : "some";
      return { key: name, isNumber, count: info.attributeUses ? count : null, spaces };
    });
  return { own, attributes };
}

/** Classes of rooms with voxels: the spaces that have floors. */
export function roomClasses(index: FeatureIndex): string[] {
  const spaces = [...index.classes].filter(([, members]) =>
    members.some((i) => index.features[i]!.isSpace && index.features[i]!.count > 0),
  );
  const rooms = spaces.filter(([name]) => /Room|Space|Zone/.test(name));
  return (rooms.length ? rooms : spaces).map(([name]) => name);
}

/** Colours by a key, with rooms drawn solid. @param isAlone  only rooms are shown, unless something is cut or chosen already */
export function withSolidRooms(state: ViewState, key: string, index: FeatureIndex, isAlone: boolean): Partial<ViewState> {
  const classes = roomClasses(index).map(ofClass);
  const isOpen = state.sections.length > 0 || state.regions.length > 0 || state.show.length > 0;
  return {
    colorBy: key,
    hide: isAlone && !isOpen ? withoutSpaces(state.hide, index) : state.hide.filter((query) => !classes.includes(query)),
    styles: classes.reduce((styles, select) => withStyle(styles, select, { opacity: 1 }), state.styles),
    ...(isAlone && !isOpen ? { show: classes } : {}),
  };
}

/** The view without the changes of withSolidRooms(). */
function withoutSolidRooms(state: ViewState, index: FeatureIndex): Partial<ViewState> {
  const classes = roomClasses(index).map(ofClass);
  const isSolid = (select: string) => state.styles.some((style) => style.select === select && style.opacity === 1);
  if (!state.colorBy || !classes.length || !classes.every(isSolid)) return {};
  const wereHidden = hiddenSpaces(index).filter((query) => !state.hide.includes(query));
  return {
    hide: [...state.hide, ...wereHidden],
    styles: classes.reduce((styles, select) => withStyle(styles, select, { opacity: undefined }), state.styles),
    ...(state.show.join() === classes.join() ? { show: [] } : {}),
  };
}

/** The change of the view if the user chooses a key. @param key  empty: no colours */
export function coloredBy(state: ViewState, key: string, keys: ColorKeys, index: FeatureIndex): Partial<ViewState> {
  const before: Partial<ViewState> = { ...withoutSolidRooms(state, index), field: null };
  const chosen = [...keys.own, ...keys.attributes].find((one) => one.key === key);
  if (!chosen || chosen.spaces === "none") return { ...before, colorBy: key };
  return { ...before, ...withSolidRooms({ ...state, ...before }, key, index, chosen.spaces === "only") };
}
