/** Actions that change the look of the picture: the choices of the tools Look and Highlight, without their sliders. */

import type { Action } from "./actions";
import { kSceneMembers, type DeclaredMember } from "./generated/scene_members";
import type { Session } from "./session";
import { kPlainMembers, type PlainMember } from "./state/member_controls";
import { withMember } from "./state/view_state";
import { memberLabel, t } from "./texts";

const kLines = ["off", ...kSceneMembers["/passes/*/lines/*/hidden"].choices] as const;
const kShells = ["off", ...kSceneMembers["/passes/*/shell"].choices] as const;

export function lookActions({ view, volume }: Session): Action[] {
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
