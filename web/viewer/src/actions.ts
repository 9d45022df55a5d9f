/** All actions of the page, in one list: keys, context menus and the command palette take them from here. */

import { movedByKey } from "./camera/view_keys";
import { selectionActions } from "./selection_actions";
import type { Session } from "./session";
import type { Tool } from "./session/view";
import { kViews } from "./state/member_controls";
import { spacesOf } from "./state/spaces";
import { areSpacesShown, showAll, showSpaces } from "./shown_spaces";
import { t } from "./texts";
import { toggleParallel } from "./camera/projection";
import { toolText } from "./tool_texts";
import { setWalking } from "./tools/views_tool";
import type { IconName } from "./ui/icons";

export interface Action {
  id: string;
  text: () => string;
  icon?: IconName;
  /** Such as `x`, `shift+h` or `ctrl+z`; the palette shows the first one. */
  keys?: readonly string[];
  /** Absent: always. */
  isEnabled?: () => boolean;
  run: () => void;
}

/** The page, as actions need it. */
export interface ActionHost {
  session: Session;
  /** Opens or closes a tool. The focus goes to its first control, or to the cross that takes points. */
  useTool(tool: Tool): void;
  /** Opens a tool and presses one of its controls. */
  pressInTool(tool: Tool, selector: string): void;
  showSheet(which: "tree" | "selection"): void;
  search(): void;
  help(): void;
  switchTheme(): void;
  choose(): void;
  /** Opens the panel that compares two states. */
  compare(): void;
  openPalette(): void;
  openTable(): void;
  /** Shows the quantities of the model, or closes them. */
  openQuantities(): void;
  /** Shows a plan and two sections beside the picture, or closes them. */
  openFour(): void;
}

export const kTools: readonly { tool: Tool; icon: IconName; key: string }[] = [
  { tool: "section", icon: "section", key: "x" },
  { tool: "lens", icon: "lens", key: "c" },
  { tool: "focus", icon: "focus", key: "v" },
  { tool: "look", icon: "look", key: "k" },
  { tool: "measure", icon: "measure", key: "m" },
  { tool: "views", icon: "view", key: "n" },
  { tool: "share", icon: "share", key: "b" },
];

/** The action of a key that is enabled now. */
export function actionOfKey(actions: readonly Action[], event: KeyboardEvent): Action | undefined {
  const key = event.key.toLowerCase();
  const control = event.ctrlKey || event.metaKey ? "ctrl+" : "";
  const find = (name: string) => actions.find(({ keys, isEnabled }) => keys?.includes(name) && (isEnabled?.() ?? true));
  // Shift is a part of signs such as `?`.
  return (event.shiftKey ? find(`${control}shift+${key}`) : undefined) ?? find(control + key);
}

export function actionsOf(host: ActionHost): Action[] {
  const { session } = host;
  const hasModel = () => session.volume.info !== null;
  const hasParts = () => hasModel() && !session.volume.isServerOnly;
  const ofModel = (action: Action): Action => ({ ...action, isEnabled: () => hasModel() && (action.isEnabled?.() ?? true) });
  return [
    ...selectionActions(session).map((action) => ({ ...action, isEnabled: () => hasParts() && (action.isEnabled?.() ?? true) })),
    ...kTools.map(({ tool, icon, key }) =>
      ofModel({ id: `tool-${tool}`, text: () => t(tool), icon, keys: [key], run: () => host.useTool(tool) }),
    ),
    ...viewActions(session).map(ofModel),
    ...pageActions(host, hasParts),
    ...toolActions(host).map(ofModel),
  ];
}

function viewActions(session: Session): Action[] {
  const { view } = session;
  return [
    ...kViews.map((name, n): Action => ({
      id: `view-${name}`,
      text: () => `${t("views")}: ${t(`view_${name}`)}`,
      icon: "view",
      keys: [String(n + 1)],
      run: () => void movedByKey(view, String(n + 1)),
    })),
    { id: "fit", text: () => t("fit"), icon: "fit", keys: ["0"], run: () => void movedByKey(view, "0") },
    { id: "walk", text: () => t("walk"), icon: "walk", keys: ["g"], run: () => setWalking(session, !view.isWalking) },
    {
      id: "parallel",
      text: () => t("parallel"),
      icon: "view",
      isEnabled: () => view.state.camera !== null && !view.isWalking,
      keys: ["p"],
      run: () => toggleParallel(view),
    },
    {
      id: "undo",
      text: () => t("undo", { what: "" }).replace(/:\s*$/, ""),
      icon: "undo",
      keys: ["ctrl+z"],
      isEnabled: () => view.undoable !== null,
      run: () => view.undo(),
    },
    {
      id: "redo",
      text: () => t("redo", { what: "" }).replace(/:\s*$/, ""),
      icon: "redo",
      keys: ["ctrl+shift+z", "ctrl+y"],
      isEnabled: () => view.history.next !== null,
      run: () => view.redo(),
    },
    {
      id: "remove-planes",
      text: () => toolText("removePlanes"),
      icon: "bin",
      isEnabled: () => view.state.sections.length > 0,
      run: () => view.set({ sections: [] }),
    },
    {
      id: "remove-points",
      text: () => `${t("measure")}: ${t("clear")}`,
      icon: "bin",
      isEnabled: () => view.state.measured.length > 0,
      run: () => view.set({ measured: [] }),
    },
    {
      id: "lens-off",
      text: () => `${t("focusEffect")}: ${t("effectNone")}`,
      icon: "close",
      isEnabled: () => view.state.effect !== "none",
      run: () => view.set({ effect: "none" }),
    },
  ];
}

function pageActions(host: ActionHost, hasParts: () => boolean): Action[] {
  const { session } = host;
  const { languages, volume, model } = session;
  const hasModel = () => volume.info !== null;
  return [
    {
      id: "show-all",
      text: () => t("showAll"),
      icon: "eye",
      keys: ["shift+h"],
      isEnabled: hasParts,
      run: () => showAll(session),
    },
    {
      id: "spaces",
      text: () => toolText(areSpacesShown(session) ? "hideSpaces" : "showSpaces"),
      icon: "room",
      isEnabled: () => hasParts() && spacesOf(volume.index).length > 0,
      run: () => showSpaces(session, !areSpacesShown(session)),
    },
    { id: "search", text: () => t("search"), icon: "search", keys: ["/"], isEnabled: hasParts, run: () => host.search() },
    {
      id: "rectangle",
      text: () => toolText("rectangle"),
      icon: "rectangle",
      keys: ["r"],
      isEnabled: hasParts,
      run: () => (session.view.aim = "rectangle"),
    },
    { id: "four", text: () => t("fourViews"), icon: "four", keys: ["j"], isEnabled: hasParts, run: () => host.openFour() },
    { id: "table", text: () => t("tableHint"), icon: "table", keys: ["t"], isEnabled: hasParts, run: () => host.openTable() },
    { id: "quantities", text: () => t("quantities"), icon: "sum", isEnabled: hasParts, run: () => host.openQuantities() },
    {
      id: "panel-tree",
      text: () => t("showPanel", { panel: t("panelTree") }),
      icon: "tree",
      isEnabled: hasParts,
      run: () => host.showSheet("tree"),
    },
    {
      id: "panel-selection",
      text: () => t("showPanel", { panel: t("panelProperties") }),
      icon: "info",
      isEnabled: hasModel,
      run: () => host.showSheet("selection"),
    },
    { id: "refine", text: () => t("makeFiner"), icon: "plus", isEnabled: () => model.refining.isCoarse, run: () => model.refining.again() },
    { id: "open", text: () => t("open"), icon: "open", run: () => host.choose() },
    { id: "compare", text: () => t("compare"), icon: "flip", isEnabled: () => !volume.isServerOnly, run: () => host.compare() },
    { id: "theme", text: () => t("theme"), icon: "moon", run: () => host.switchTheme() },
    ...languages.all.map(({ code, name }): Action => ({
      id: `language-${code}`,
      text: () => `${t("languages")}: ${name}`,
      icon: "info",
      run: () => void languages.choose(code),
    })),
    { id: "help", text: () => t("helpTitle"), icon: "help", keys: ["?"], run: () => host.help() },
    { id: "palette", text: () => t("actionsHint"), icon: "menu", keys: ["ctrl+k"], run: () => host.openPalette() },
  ];
}

/** Controls of the tools. */
function toolActions(host: ActionHost): Action[] {
  const press = (id: string, text: () => string, icon: IconName, tool: Tool, selector: string): Action => ({
    id,
    text,
    icon,
    run: () => host.pressInTool(tool, selector),
  });
  return [
    press("add-plane", () => t("addPlane"), "section", "section", "#add-plane"),
    press("plane-by-face", () => `${t("section")}: ${toolText("planeByFace")}`, "section", "section", "#plane-by-face"),
    press("section-box", () => toolText("sectionBox"), "section", "section", "#section-box"),
    press("hatches", () => `${t("section")}: ${t("hatches")}`, "section", "section", "#hatches"),
    press("sun", () => toolText("sun"), "sun", "look", "#sun"),
    press("basemap", () => toolText("basemap"), "image", "look", "#basemap"),
    press("next-view", () => toolText("nextView"), "bookmark", "share", "#next-view"),
    press("sheets", () => t("sheets"), "section", "section", "#draw-sheets"),
    press("print-sheets", () => `${t("sheets")}: ${toolText("print")}`, "section", "section", "#print-sheets"),
    press("keep-view", () => t("keepView"), "bookmark", "share", "#keep-view"),
    press("copy-link", () => t("copyLink"), "copy", "share", "#copy-link"),
    press("copy-command", () => t("copyCommand"), "code", "share", "#copy-command"),
    press("copy-embedding", () => t("copyEmbedding"), "code", "share", "#copy-embedding"),
    press("scene-json", () => t("sceneJson"), "code", "share", "#show-scene"),
    press("save-picture", () => t("pictureSave"), "image", "share", "#save-picture"),
    press("export-views", () => t("bookmarksExport"), "bookmark", "share", "#export-views"),
    press("import-views", () => t("bookmarksImport"), "bookmark", "share", "#import-views"),
    press("export-bcf", () => t("bcfExport"), "bookmark", "share", "#export-bcf"),
  ];
}
