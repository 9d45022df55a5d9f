/** Actions on the selected features: in the panel, in context menus and in the command palette. */

import type { Action } from "./actions";
import { nameOf, storeyOf } from "./panels/feature_path";
import type { Session } from "./session";
import { hasHiddenParts, showAll } from "./shown_spaces";
import { classText } from "./state/class_words";
import { withMembers, type FeatureIndex } from "./state/feature_index";
import { ofClass, ofSubtree, quoted } from "./state/queries";
import { t } from "./texts";
import { toolText } from "./tool_texts";
import { copy } from "./ui/files";

export function selectionActions(session: Session): Action[] {
  const { view, volume } = session;
  const isAny = () => view.state.selection.length > 0;
  const first = () => volume.index.byId.get(view.state.selection[0] ?? "") ?? -1;
  const effect = (wanted: "highlight" | "cutaway") => () =>
    view.set({ effect: view.state.effect === wanted ? "none" : wanted, focus: { ...view.state.focus, query: "" } });
  return [
    { id: "zoom", text: () => t("zoomToIt"), icon: "fit", keys: ["f"], run: () => void view.goToSelected() },
    {
      id: "hide",
      text: () => t(view.isSelectionHidden ? "show" : "hide"),
      icon: "eyeOff",
      keys: ["h"],
      isEnabled: isAny,
      run: () => view.hideSelected(view.selected.some((i) => !view.hidden[i])),
    },
    {
      id: "isolate",
      text: () => t(view.state.show.length ? "showOthers" : "onlyThis"),
      icon: "only",
      isEnabled: () => isAny() || view.state.show.length > 0,
      run: () => (view.state.show.length ? view.showOthers() : view.showOnlySelected()),
    },
    { id: "highlight", text: () => t("highlightIt"), icon: "focus", isEnabled: isAny, run: effect("highlight") },
    { id: "cutaway", text: () => t("cutawayTo"), icon: "target", isEnabled: () => isAny() && !volume.isCity, run: effect("cutaway") },
    {
      id: "same-type",
      text: () => t("sameType", { type: classText(typeAt(volume.index, first())) }),
      icon: "part",
      isEnabled: () => first() >= 0,
      run: () => selectSameType(session, first()),
    },
    {
      id: "same-storey",
      text: () => t("sameStorey", { name: storeyName(volume.index, first()) }),
      icon: "storey",
      isEnabled: () => first() >= 0 && storeyOf(volume.index, first()) >= 0,
      run: () => selectStorey(session, first()),
    },
    {
      id: "more",
      text: () => toolText(session.selection.isMore ? "moreEnd" : "more"),
      icon: "plus",
      isEnabled: isAny,
      run: () => (session.selection.isMore = !session.selection.isMore),
    },
    { id: "copy-id", text: () => t("copyId"), icon: "copy", isEnabled: isAny, run: () => void copyIds(session) },
    { id: "deselect", text: () => t("deselect"), icon: "close", isEnabled: isAny, run: () => session.selection.select([]) },
  ];
}

/** The actions of a context menu. @param at  point in the picture, as fractions of its size; null: elsewhere */
export function menuActions(session: Session, at: [number, number] | null): Action[] {
  const { view, selection } = session;
  const actions = selectionActions(session).filter(({ id, isEnabled }) => kInMenu.has(id) && (isEnabled?.() ?? true));
  if (at) actions.push({ id: "behind", text: () => t("keyAlong"), icon: "lens", run: () => void selection.listAlong(...at) });
  if (view.state.show.length || hasHiddenParts(session))
    actions.push({ id: "show-all", text: () => t("showAll"), icon: "eye", run: () => showAll(session) });
  return actions;
}

export function nameOfSelection({ volume, view }: Session): string {
  const { selection } = view.state;
  const only = selection.length === 1 ? volume.index.features[volume.index.byId.get(selection[0]!) ?? -1] : undefined;
  if (only) return nameOf(volume.index, only);
  return selection.length ? t("severalSelected", { n: selection.length }) : t("nothingSelected");
}

const kInMenu = new Set(["zoom", "hide", "isolate", "highlight", "cutaway", "same-type", "same-storey", "more", "copy-id"]);

/** The type in the model's own format, else the class. */
function typeAt(index: FeatureIndex, i: number): string {
  const feature = index.features[i];
  return feature ? feature.type || feature.class : "";
}

function selectSameType({ volume, selection }: Session, i: number): void {
  const { features, classes } = volume.index;
  const { type, class: name } = features[i]!;
  const members = type ? features.flatMap((feature, at) => (feature.type === type ? [at] : [])) : (classes.get(name) ?? []);
  selection.select(
    members.map((at) => features[at]!.id),
    false,
    type ? `ifcType=${quoted(type)}` : ofClass(name),
  );
}

function storeyName(index: FeatureIndex, i: number): string {
  const storey = i < 0 ? -1 : storeyOf(index, i);
  return storey < 0 ? "" : nameOf(index, index.features[storey]!);
}

function selectStorey({ volume, selection }: Session, i: number): void {
  const { index } = volume;
  const storey = storeyOf(index, i);
  const members = withMembers(index, [storey]).map((at) => index.features[at]!.id);
  selection.select(members, false, ofSubtree(index.features[storey]!.id));
}

async function copyIds({ view, messages }: Session): Promise<void> {
  const ids = view.state.selection;
  const isCopied = await copy(ids.join("\n"));
  messages.tell(isCopied ? `${t("copied")}: ${ids.length === 1 ? ids[0] : ids.length}` : t("notCopied"));
}
