/**
 * A view as a link: `#scene=...&view=...`, each JSON, deflated, base64url. `scene` is the drawn scene as in a scene
 * file; `view` is the page's state, which restores the tools. A link with only a scene works as well.
 */

import type { Scene } from "../engine";
import { kSceneMembers, type SceneMember } from "../generated/scene_members";
import { compacted } from "./compact";
import type { FeatureIndex } from "./feature_index";
import { isAllowed, isValueOf, kPlainMembers } from "./member_controls";
import { isSun } from "./sun";
import { initialState, type ViewState } from "./view_state";

const kMaxBytes = 4 << 20;

async function through(bytes: Uint8Array, stream: GenericTransformStream, maxBytes: number): Promise<Uint8Array> {
  const reader = new Blob([bytes as Uint8Array<ArrayBuffer>])
    .stream()
    .pipeThrough(stream as ReadableWritablePair<Uint8Array, Uint8Array>)
    .getReader();
  const parts: Uint8Array[] = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > maxBytes) throw new Error("too long");
    parts.push(value);
  }
  const all = new Uint8Array(size);
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

export async function packed(value: unknown): Promise<string> {
  const bytes = await through(new TextEncoder().encode(JSON.stringify(value)), new CompressionStream("deflate-raw"), kMaxBytes);
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}

/** Rejects text that was not made by packed(). */
export async function unpacked(text: string): Promise<unknown> {
  const binary = atob(text.replace(/-/g, "+").replace(/_/g, "/"));
  const bytes = Uint8Array.from(binary, (c) => c.charCodeAt(0));
  return JSON.parse(new TextDecoder().decode(await through(bytes, new DecompressionStream("deflate-raw"), kMaxBytes)));
}

/** Characters of a link that servers and programs take. */
const kMostCharacters = 7_500;

/**
 * A link that is not too long: the scene is left out if necessary, then the selection, then what is hidden or shown.
 * @param index  of the model, for short sets of features; null: the features of the model change, as in a city
 */
export async function hashOf(scene: Scene, state: ViewState, index: FeatureIndex | null = null): Promise<string> {
  const short = index ? compacted(state, index) : state;
  const withScene = async (view: string) => {
    const all = `#scene=${await packed(scene)}&view=${view}`;
    return all.length > kMostCharacters ? `#view=${view}` : all;
  };
  const attempts: Partial<ViewState>[] = [{}, { selection: [], selectedBy: "" }, { selection: [], selectedBy: "", hide: [], show: [] }];
  let hash = "";
  for (const change of attempts) {
    hash = await withScene(await packed(changes({ ...short, ...change })));
    if (hash.length <= kMostCharacters) break;
  }
  return hash;
}

/** The state of a link; null if the link has no state. Rejects if it is damaged. */
export async function stateOfHash(hash: string, base: ViewState): Promise<ViewState | null> {
  const parts = new URLSearchParams(hash.replace(/^#/, ""));
  const view = parts.get("view"),
    scene = parts.get("scene");
  if (view) return restored(await unpacked(view));
  if (scene) return ofScene((await unpacked(scene)) as Scene, base);
  return null;
}

/** Differences from the initial state. */
function changes(state: ViewState): Partial<ViewState> {
  const initial = initialState();
  const entries = Object.entries(state).filter(([key, value]) => JSON.stringify(value) !== JSON.stringify(initial[key as keyof ViewState]));
  return Object.fromEntries(entries) as Partial<ViewState>;
}

/** Members of the wrong type get their initial value, so that no link can break the page. */
export function restored(value: unknown): ViewState {
  const initial = initialState();
  if (typeof value !== "object" || value === null) return initial;
  const given = value as Record<string, unknown>;
  const state: Record<string, unknown> = { ...initial };
  for (const key of Object.keys(initial))
    if (key in given && isLike(initial[key as keyof ViewState], given[key], key)) state[key] = given[key];
  const picture = (typeof given.picture === "object" && given.picture) || given; // older links have these members at the top level
  state.picture = Object.fromEntries(
    kPlainMembers
      .map((name) => [name.slice(1), (picture as Record<string, unknown>)[name.slice(1)]] as const)
      .filter(([key, member]) => member !== undefined && member !== false && isValueOf(`/${key}` as SceneMember, member)),
  );
  return state as unknown as ViewState;
}

const kNullable: Record<string, string> = {
  camera: "object",
  hatches: "boolean",
  shell: "string",
  surfaces: "string",
  wireframe: "string",
  custom: "object",
};

function isLike(initial: unknown, given: unknown, key: string): boolean {
  if (key === "field") return given === null || isField(given);
  if (key === "sun") return given === null || isSun(given);
  if (key in kNullable) return given === null || (typeof given === kNullable[key] && (key !== "camera" || isCamera(given)));
  if (key === "measured") return Array.isArray(given) && given.every(isPoint);
  if (Array.isArray(initial))
    return Array.isArray(given) && given.every((item) => typeof item === (key === "styles" || key === "sections" ? "object" : "string"));
  if (typeof initial === "object" && initial !== null)
    return (
      typeof given === "object" &&
      given !== null &&
      Object.entries(initial).every(([k, v]) => typeof (given as Record<string, unknown>)[k] === typeof v)
    );
  return typeof given === typeof initial;
}

/** Whether a link's field has the right types; the library checks values. */
function isField(given: unknown): boolean {
  if (typeof given !== "object" || given === null) return false;
  const { name, time, range, isolines, map, per } = given as Record<string, unknown>;
  const isNumber = (value: unknown) => value === undefined || Number.isFinite(value);
  const isChoice = (member: "/field/map" | "/field/per", value: unknown) => value === undefined || isValueOf(member, value);
  const isRange = range === undefined || (Array.isArray(range) && range.length === 2 && range.every(Number.isFinite));
  return (
    typeof name === "string" &&
    name !== "" &&
    isNumber(time) &&
    isNumber(isolines) &&
    isRange &&
    isChoice("/field/map", map) &&
    isChoice("/field/per", per)
  );
}

const isPoint = (p: unknown) => Array.isArray(p) && p.length === 3 && p.every(Number.isFinite);

function isCamera(given: unknown): boolean {
  const { eye, target, height, fieldOfView } = given as Record<string, unknown>;
  return isPoint(eye) && isPoint(target) && Number(height) > 0 && isAllowed("/camera/fieldOfView", Number(fieldOfView));
}

/** A scene file as state: its passes are drawn unchanged; camera, look and hatches become the page's own. */
export function ofScene(scene: Scene, base: ViewState): ViewState {
  const { eye, target, parallel } = scene.camera ?? {};
  const fieldOfView = scene.camera?.fieldOfView ?? kSceneMembers["/camera/fieldOfView"].default;
  const camera = eye && target && !parallel ? { eye, target, parallel: false, height: 10, fieldOfView } : base.camera;
  return {
    ...initialState(scene.look ?? kSceneMembers["/look"].default),
    camera,
    hatches: scene.hatches?.show ?? null,
    custom: scene,
  };
}
