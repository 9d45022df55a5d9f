/**
 * Actions without keys, for the list of actions only: the choices of the tools *Look* and *Highlight*, colours by each key, and
 * sections at the storeys. A district has thousands of them.
 */

import type { Action } from "./actions";
import { kSceneMembers, type DeclaredMember } from "./generated/scene_members";
import type { Session } from "./session";
import { coloredBy, colorKeys } from "./state/color_keys";
import { kPlainMembers, type PlainMember } from "./state/member_controls";
import { withMember } from "./state/view_state";
import { memberLabel, t, type TextKey } from "./texts";
import { cutStorey, levelsOf } from "./tools/section_tool";

const kLines = ["off", ...kSceneMembers["/passes/*/lines/*/hidden"].choices] as const;
const kShells = ["off", ...kSceneMembers["/passes/*/shell"].choices] as const;

const kMostStoreys = 200;
const kMostAttributes = 100;

/** None without a model. */
export function moreActions(session: Session): Action[] {
  return session.volume.info ? [...lookActions(session), ...colorActions(session), ...storeyActions(session)] : [];
}

function lookActions({ view, volume }: Session): Action[] {
  const hasMeshes = () => !volume.isCity && (volume.info?.hasMeshes ?? false);
  const look = (id: string, text: () => string, run: () => void, isEnabled?: () => boolean): Action => ({
    id,
    text,
    icon: "look",
    run,
    ...(isEnabled ? { isEnabled } : {}),
  });
  return [
    ...kSceneMembers["/look"].choices.map((wanted) =>
      look(
        `look-${wanted}`,
        () => `${t("look")}: ${t(`look_${wanted}`)}`,
        () => view.set({ look: wanted }),
      ),
    ),
    ...kLines.map((line) =>
      look(
        `wireframe-${line}`,
        () => `${t("wireframe")}: ${t(`wireframe_${line}`)}`,
        () => view.set({ wireframe: line === "off" ? null : line }),
        () => volume.info?.hasEdges ?? false,
      ),
    ),
    ...kShells.map((shell) =>
      look(
        `shell-${shell}`,
        () => `${t("shell")}: ${t(shell === "off" ? "shellOff" : `shell_${shell}`)}`,
        () => view.set({ shell: shell === "off" ? null : shell }),
      ),
    ),
    look(
      "names",
      () => t("names"),
      () => view.set({ names: !view.state.names }),
    ),
    look(
      "legend",
      () => t("legend"),
      () => (view.isLegendShown = !view.isLegendShown),
    ),
    look(
      "exact-surfaces",
      () => t("exactSurfaces"),
      () => view.set({ surfaces: view.state.surfaces === "voxels" ? null : "voxels" }),
      hasMeshes,
    ),
    ...kPlainMembers
      .filter((name) => (kSceneMembers[name] as DeclaredMember).type === "flag")
      .map((name) => {
        const isOn = () => view.state.picture[name.slice(1) as PlainMember] ?? (kSceneMembers[name] as DeclaredMember).default ?? false;
        return look(
          `switch-${name.slice(1)}`,
          () => memberLabel(name),
          () => view.set({ picture: withMember(view.state.picture, name, !isOn()) }),
        );
      }),
  ];
}

/** Colours by each key. */
function colorActions({ model, view, volume }: Session): Action[] {
  const { info, index } = volume;
  if (!info) return [];
  const keys = colorKeys(info, index, model.owners.file !== "");
  const action = (key: string, name: string): Action => ({
    id: `color-${key}`,
    text: () => `${t("colorBy")}: ${name}`,
    icon: "look",
    run: () => view.set(coloredBy(view.state, key, keys, index)),
  });
  return [
    ...keys.own.map(({ key }) => action(key, t(`key_${key}` as TextKey))),
    ...keys.attributes.slice(0, kMostAttributes).map(({ key }) => action(key, key)),
    {
      id: "color-none",
      text: () => `${t("colorBy")}: ${t("colorByNothing")}`,
      icon: "look",
      run: () => view.set(coloredBy(view.state, "", keys, index)),
    },
  ];
}

/** Sections at the storeys. */
function storeyActions({ volume, view }: Session): Action[] {
  return levelsOf(volume.info?.storeys ?? [])
    .slice(0, kMostStoreys)
    .map(({ name, floor }, n) => ({
      id: `storey-${n}`,
      text: () => t("storeyCut", { name }),
      icon: "section",
      run: () => cutStorey(view, floor),
    }));
}
