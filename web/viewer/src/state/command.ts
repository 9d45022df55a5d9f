/** A view as shell commands: they make or fetch its model, then run `svt render`, with options if these suffice, else with a scene file. */

import type { Scene } from "../engine";
import { kSceneMembers, type DeclaredMember, type SceneMember } from "../generated/scene_members";
import { focusQueries, regionOf, type Described } from "./scene_of";
import type { ViewState } from "./view_state";

/** Quotes one word for a POSIX shell. */
export function shellWord(text: string): string {
  return /^[\w@%+=:,./-]+$/.test(text) ? text : `'${text.replace(/'/g, "'\\''")}'`;
}

/** Whether options of `svt render` can express the whole view. */
function isExpressibleAsOptions(state: ViewState): boolean {
  if (state.custom || state.hatches === false) return false;
  if (state.effect === "cutaway" && (state.focus.margin !== 0.15 || focusQueries(state).length !== 1)) return false;
  return state.styles.every((style) => !style.hatch && !style.ghost);
}

/** The inputs of a command, which its reader has or fetches. */
export interface Inputs {
  /** Names of the open files, the main one first. */
  files: string[];
  /** Name of the table of owners; empty: none. */
  owners: string;
  /** Address of the first file; empty: the reader has the file. */
  address: string;
}

/** The commands that draw the view, in order. */
export function commandOf(state: ViewState, { scene, effects }: Described, { files, owners, address }: Inputs): string {
  const [first = "", ...others] = files;
  const isJoined = others.length > 0 && !files.some((file) => /\.svt$/i.test(file));
  const model = isJoined ? "model.svt" : first;
  const words = ["svt", "render", model, "-o", "view.png"];
  if (isExpressibleAsOptions(state)) words.push(...options(state, scene, effects));
  else words.push("--scene", "view.scene.json");
  if (!isJoined) for (const other of others) words.push("--with", other);
  if (owners) words.push("--owners", owners);
  const commands = [words];
  if (isJoined) commands.unshift(["svt", "build", ...files, "-o", model, "--vectors", "edges,meshes"]);
  if (address) commands.unshift(["curl", "-fLo", first, address]);
  return commands.map((command) => command.map(shellWord).join(" ")).join(" && ");
}

/** The value at a pointer whose * is the first element. */
function valueAt(scene: Scene, pointer: SceneMember): unknown {
  let value: unknown = scene;
  for (const step of pointer.slice(1).split("/")) value = (value as Record<string, unknown> | undefined)?.[step === "*" ? "0" : step];
  return value;
}

/** The words that set a member; none for its default. */
function optionWords({ type, option = "", repeats, default: byDefault }: DeclaredMember, value: unknown): string[] {
  if (value === undefined || value === byDefault) return [];
  if (type === "flag") return [option];
  const values = repeats ? (value as unknown[]) : [value];
  return values.flatMap((one) => [option, Array.isArray(one) ? one.join(",") : String(one)]);
}

/** Omits members with their default values: the options of `svt render` have the same defaults. */
function options(state: ViewState, scene: Scene, effects: Described["effects"]): string[] {
  const words = ["--size", (scene.size ?? kSceneMembers["/size"].default).join("x")];
  const add = (option: string, ...values: string[]) => values.forEach((value) => words.push(option, value));
  for (const [name, member] of Object.entries(kSceneMembers) as [SceneMember, DeclaredMember][])
    if (member.option) words.push(...optionWords(member, valueAt(scene, name)));
  for (const style of state.styles) if (style.color) add("--color", `${style.select}:${style.color}`);
  for (const style of state.styles) if (style.opacity !== undefined) add("--opacity", `${style.select}:${style.opacity}`);
  if (effects.lens) {
    add("--lens", effects.lens.region);
    if (!state.sections.length && !state.regions.length) add("--section", effects.lens.cut);
  }
  add("--section", ...state.sections.map(regionOf));
  if (state.regions.length) add("--cut", state.regions.join(" or "));
  add("--highlight", ...(effects.highlight?.queries ?? []));
  if (effects.cutaway) add("--cutaway", effects.cutaway.query);
  const context = effects.lens?.context ?? effects.highlight?.context;
  if (context && context !== "ghost") add("--context", context);
  // Last, because its query is optional.
  if (state.wireframe) {
    if (state.wireframe !== kSceneMembers["/passes/*/lines/*/hidden"].default) add("--hidden-lines", state.wireframe);
    words.push("--wireframe");
  }
  return words;
}

/** The HTML that shows a view within another page. */
export function embeddingOf(address: string, title: string, [width, height]: [number, number]): string {
  const attribute = (text: string) => text.replace(/&/g, "&amp;").replace(/"/g, "&quot;").replace(/</g, "&lt;");
  return `<iframe src="${attribute(address)}" title="${attribute(title)}" width="${width}" height="${height}" style="border: 0" loading="lazy" allow="fullscreen"></iframe>`;
}
