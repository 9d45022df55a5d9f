/** State to scene: a pure function, the only place that determines the picture. */

import type { CameraPreset, Effects, Point, Samples, Scene, SceneCamera, ScenePass } from "../engine";
import { parallelZoom, type Box } from "../camera/camera";
import { add, distance, normalized, scale, sub } from "../camera/vec";
import { kSceneMembers } from "../generated/scene_members";
import { joined, ofId, ofSubtree } from "./queries";
import type { Camera, Section, ViewState } from "./view_state";

/** A scene of one pass, and the effects to apply with `Engine.compose()`. */
export interface Described {
  scene: Scene;
  effects: Effects;
}

/** At most this many decimals: tenths of a millimetre, which keeps links short. */
function round(value: number, digits = 4): number {
  const rounded = Number(value.toFixed(digits));
  return Object.is(rounded, -0) ? 0 : rounded;
}
const roundPoint = (p: Point): Point => [round(p[0]), round(p[1]), round(p[2])];

/** The unit vector towards the side that a free plane removes. */
export function freeNormal(section: Section): Point {
  const turn = (section.turn * Math.PI) / 180;
  const tilt = (section.tilt * Math.PI) / 180;
  return [Math.cos(turn) * Math.cos(tilt), Math.sin(turn) * Math.cos(tilt), Math.sin(tilt)];
}

/** The region that a plane removes (docs/user/regions.md); also the argument of `svt section --plane`. */
export function regionOf(section: Section): string {
  if (section.axis !== "free") return `${section.axis}${section.flip ? "<" : ">"}${round(section.at)}`;
  const sign = section.flip ? -1 : 1;
  const [a, b, c] = freeNormal(section).map((v) => round(v * sign, 6)) as Point;
  return `${a},${b},${c},${round(-section.at * sign)}`;
}

export function cutOf(sections: Section[], regions: string[] = []): string {
  return [...sections.map(regionOf), ...regions].join(" or ");
}

/** The queries of the selected features, each with all below it and its members. */
export function selectionQueries({ selection, selectedBy }: Pick<ViewState, "selection" | "selectedBy">): string[] {
  return selectedBy ? [selectedBy] : joined(selection.map(ofSubtree));
}

/** The queries for highlight or cutaway; empty: nothing to show. */
export function focusQueries(state: ViewState): string[] {
  return state.focus.query.trim() !== "" ? [state.focus.query.trim()] : selectionQueries(state);
}

export function sceneCamera(
  camera: Camera | null,
  box: Box,
  aspect: number,
  named: CameraPreset = kSceneMembers["/camera/preset"].default,
): SceneCamera {
  if (!camera) return { preset: named };
  const preset = presetFor(camera);
  if (!camera.parallel)
    return {
      preset,
      eye: roundPoint(camera.eye),
      target: roundPoint(camera.target),
      fieldOfView: round(camera.fieldOfView, 3),
    };
  // Scenes express the height of a parallel view as zoom relative to the named view, and zooming moves the eye closer.
  // Rays begin at the eye, so it is placed outside of the whole scene.
  const zoom = Number(parallelZoom(preset, box, aspect, camera.height).toPrecision(6));
  const away = normalized(sub(camera.eye, camera.target));
  const reach = 2 * distance(box.low, box.high) + distance(camera.target, box.low);
  const eye = add(camera.target, scale(away, reach * zoom));
  return { preset, parallel: true, zoom, eye: roundPoint(eye), target: roundPoint(camera.target) };
}

function presetFor(camera: Camera): "iso" | "top" | "bottom" {
  const [dx, dy, dz] = camera.target.map((t, i) => t - camera.eye[i]!) as Point;
  if (Math.hypot(dx, dy) > 1e-4 * Math.abs(dz)) return "iso";
  return dz < 0 ? "top" : "bottom";
}

function passOf(state: ViewState): ScenePass {
  const pass: ScenePass = {};
  if (state.show.length) pass.show = state.show;
  if (state.hide.length) pass.hide = state.hide;
  if (state.styles.length) pass.styles = state.styles;
  const cut = cutOf(state.sections, state.regions);
  if (cut && state.effect !== "lens") pass.cut = cut;
  if (state.wireframe) pass.lines = [{ hidden: state.wireframe }];
  if (state.shell) pass.shell = state.shell;
  return pass;
}

/** Default section of the lens if nothing is cut: removes the nearer half of the building. */
export function lensCut(state: ViewState, box: Box): string {
  return cutOf(state.sections, state.regions) || `y<${round((box.low[1] + box.high[1]) / 2, 2)}`;
}

function effectsOf(state: ViewState, box: Box): Effects {
  if (state.custom) return {};
  const { lens, focus } = state;
  if (state.effect === "lens") {
    const region = `view(${round(lens.x)},${round(lens.y)},${round(lens.radius)})`;
    return { lens: { region, cut: lensCut(state, box), context: lens.context } };
  }
  const queries = focusQueries(state);
  if (!queries.length) return {};
  if (state.effect === "highlight") return { highlight: { queries, context: focus.context } };
  if (state.effect === "cutaway") return { cutaway: { query: queries.join(" or "), margin: focus.margin } };
  return {};
}

/**
 * @param box   of the grid, metres from its lower corner along its axes
 * @param size  of the picture, pixels
 */
export function sceneOf(
  state: ViewState,
  box: Box,
  size: [number, number],
  samples: Samples = kSceneMembers["/samples"].default,
): Described {
  const scene: Scene = { format: "svt-scene", version: 1, size, samples };
  if (state.look !== kSceneMembers["/look"].default) scene.look = state.look;
  if (state.surfaces) scene.surfaces = state.surfaces;
  const camera = sceneCamera(state.camera, box, size[0] / size[1], state.preset);
  scene.camera = camera;
  if (state.hatches !== null) scene.hatches = { show: state.hatches };
  const named = [...state.named, ...(state.names ? (state.selectedBy ? [state.selectedBy] : joined(state.selection.map(ofId))) : [])];
  if (named.length) scene.names = named;
  if (state.field) scene.field = state.field;
  else if (state.colorBy) scene.colorBy = state.colorBy;
  Object.assign(scene, state.picture);
  if (state.sun) scene.sun = state.sun;
  if (!camera.parallel) delete scene.scaleBar;
  scene.passes = [passOf(state)];
  if (state.custom) return { scene: { ...state.custom, ...scene, passes: state.custom.passes ?? [{}] }, effects: {} };
  return { scene, effects: effectsOf(state, box) };
}
