/** The view of the open model: its state, its undo steps, the animation of its camera, and its scene. */

import type { Ground } from "../basemap/ground";
import { between, withProjection } from "../camera/camera";
import type { CameraPreset, Samples, Scene, SceneCamera, SceneStyle } from "../engine";
import { kSceneMembers } from "../generated/scene_members";
import { computed, membersOf, Observable } from "../observable";
import { History, type Changed } from "../state/history";
import { sceneCamera, sceneOf, selectionQueries, type Described } from "../state/scene_of";
import { hiddenSpaces, withoutSpaces, withSpaces } from "../state/spaces";
import { tintStyles } from "../state/tint";
import { initialState, isSameChoice, type Camera, type ViewState } from "../state/view_state";
import { hiddenFlags, hideQueries, switched, withMembersOf } from "../state/visibility";
import { t, type TextKey } from "../texts";
import type { Answers } from "./answers";
import type { Messages } from "./messages";
import type { OpenVolume } from "./open_volume";

type Projection = Pick<Camera, "parallel" | "fieldOfView">;
export type Tool = "section" | "lens" | "focus" | "look" | "measure" | "views" | "share";
/** The choice by the next click or drag in the picture: a rectangle of objects, a face for a plane; or points by a cross, which keys move. */
export type Aim = "rectangle" | "face" | "point";

/** A view that is fitted to features, beside its direction. */
export interface Framing {
  /** Query of the features; empty: all. */
  around: string;
  parallel: boolean;
  /** Degrees. */
  fieldOfView: number;
}

/** Joined queries, each of up to 20,000 characters; the library takes 65,536 bytes. */
const kMostFramed = 16;

/** The field of view, degrees, in which the library fits a parallel view. */
const kAlmostParallel = 0.5;

/** Milliseconds from one view to another. */
const kFlight = 350;

export class View extends Observable {
  state: ViewState = initialState();
  /** The members of `state`, each observable separately: a part that shows the look does not render again when the camera moves. */
  readonly now = membersOf(() => this.state);
  /** The projection of the camera, which does not change as the camera moves. */
  readonly projection = membersOf(() => {
    const { parallel = kSceneMembers["/camera/parallel"].default, fieldOfView = null } = this.state.camera ?? {};
    return { parallel, fieldOfView };
  });
  private readonly hiddenNow = computed(() => hiddenFlags(this.volume.index, this.now.hide, this.answers.of));
  private readonly selectedNow = computed(() => withMembersOf(this.volume.index, this.now.selection, this.now.selectedBy !== ""));
  readonly history = new History();
  /** Size of the picture area in device pixels. */
  size: [number, number] = [640, 360];
  /** The step before the first one: it opens another model. null: there is none. */
  before: { text: string; act: () => void } | null = null;
  tool: Tool | null = null;
  aim: Aim | null = null;
  /** A picture below the model, only on the screen; null: none. */
  ground: Ground | null = null;
  /** Measured points lie along an axis from the point before. */
  isSquare = false;
  isWalking = false;
  isLegendShown = false;
  /** The part of the library that draws the faces of the model is there; null: it may come. */
  hasFaces: boolean | null = null;
  /** Grows with each change that redraws the picture. */
  revision = 0;
  /** Counts changes of data on which colours depend, such as owners. */
  dataRevision = 0;
  /** How the first camera is fitted, from the direction of `state.preset`. */
  framing: Framing = {
    around: "",
    parallel: kSceneMembers["/camera/parallel"].default,
    fieldOfView: kSceneMembers["/camera/fieldOfView"].default,
  };
  /**
   * Spaces that are not hidden are drawn, because the page has a switch for each. Without switches, as in the web component,
   * spaces are drawn where a query asks for them, as by the command.
   */
  hasSwitches = true;
  /** Colour of the outline of selected features; empty: these have no tint. */
  mark = "";
  /** A selection whose tint cannot be drawn. */
  private untinted: readonly string[] | null = null;
  /** Queries of hidden spaces, which showOnlySelected() has removed. */
  private spacesBefore: string[] | null = null;
  private beforeWalking: Projection | null = null;
  private flight = 0;
  /** The view fitted to the whole building, and its aspect ratio; it is recomputed for another aspect ratio. */
  private fitted: { camera: Camera; aspect: number } | null = null;

  constructor(
    private readonly volume: OpenVolume,
    private readonly messages: Messages,
    readonly answers: Answers,
  ) {
    super();
  }

  /** A flag per feature: whether it is hidden. */
  get hidden(): Uint8Array {
    return this.hiddenNow.value;
  }
  get aspect(): number {
    return this.size[0] / this.size[1];
  }

  /** The selected features with all below them and their members; of a query, only the features that it selects. */
  get selected(): readonly number[] {
    return this.selectedNow.value;
  }

  /**
   * @param isOnScreen  selected features are tinted, colours have the legend of the page, and the ground is visible: as nowhere
   *     else. The faces of the model are visible only if `hasFaces`; saved pictures load the whole module for them.
   */
  describe(size: [number, number], samples?: Samples, isOnScreen = false, state = this.state): Described {
    const described = sceneOf(state, this.volume.box, size, samples);
    if (this.hasSwitches && !state.custom) {
      const tint = isOnScreen ? this.tint() : [];
      const hidden = state === this.state ? this.hidden : hiddenFlags(this.volume.index, state.hide, this.answers.of);
      const isFocused = state.effect === "highlight" || state.effect === "cutaway";
      const isAsked = !isFocused && (state.styles.length + state.named.length + tint.length > 0 || state.names);
      described.scene.passes = described.scene.passes!.map((pass) => {
        const styled = tint.length ? { ...pass, styles: [...(pass.styles ?? []), ...tint] } : pass;
        return withSpaces(styled, this.volume.index, hidden, isAsked);
      });
    }
    if (isOnScreen && !this.showsFaces) described.scene.surfaces = "voxels";
    if (isOnScreen) {
      // The page has its own legend, whose text does not depend on the number of pixels.
      if (this.hasSwitches && (state.colorBy || state.field) && !state.custom) described.scene.legend = false;
      this.ground?.show(described.scene, state, this.volume);
    }
    // Tiles of a city fit the pixels. Levels of detail of the tiles would cost time and memory without benefit.
    if (this.volume.isCity) described.scene.passes = described.scene.passes!.map((pass) => ({ level: 0, ...pass }));
    return described;
  }

  /** Whether the open model has faces to draw. */
  get mayHaveFaces(): boolean {
    const { info, isCity } = this.volume;
    return !isCity && (info?.hasMeshes ?? false);
  }

  private get showsFaces(): boolean {
    return this.hasFaces === true && this.mayHaveFaces;
  }

  /** Whether selected features are tinted: not in effects, and not over colours that have a meaning. */
  private get isTinted(): boolean {
    const { effect, colorBy, field, custom, selection } = this.state;
    return (
      this.mark !== "" &&
      selection !== this.untinted &&
      selection.length > 0 &&
      (effect === "none" || effect === "lens") &&
      !colorBy &&
      !field &&
      !custom
    );
  }

  private tint(): SceneStyle[] {
    if (!this.isTinted) return [];
    const visible = this.selected.filter((i) => !this.hidden[i]);
    return tintStyles(this.volume.index, selectionQueries(this.state), visible, this.mark);
  }

  /** The scene for `svt render --scene`, with effects. */
  async composed(size: [number, number], samples?: Samples, state = this.state): Promise<Scene> {
    const { scene, effects } = this.describe(size, samples, false, state);
    const { engine } = this.volume;
    return engine && Object.keys(effects).length ? engine.compose(scene, effects) : scene;
  }

  /** Changes the view; the picture follows. */
  set(change: Partial<ViewState>): void {
    const before = this.state;
    const selectedBy = change.selection && change.selectedBy === undefined ? { selectedBy: "" } : {};
    this.become({ ...before, ...change, ...selectedBy });
    this.history.record(before, this.state, performance.now());
  }

  private become(state: ViewState): void {
    const before = this.state;
    this.state = state;
    if (isDrawnDifferently(before, state) || (before.selection !== state.selection && this.mark !== "")) this.redraw();
  }

  /**
   * Takes a choice back, because the view cannot be drawn: its step is dropped. The camera, the selection and measured points
   * stay.
   * @param drawable  the last view that was drawn; null: none yet
   * @param isAgain  the view before the last step cannot be drawn, either
   */
  refuse(refused: ViewState, drawable: ViewState | null, isAgain: boolean): void {
    const before = this.history.refuse(refused);
    if (!isAgain && Object.keys(before).length) return this.become({ ...this.state, ...before });
    const { camera, preset, selection, selectedBy, measured } = this.state;
    const kept = { camera, preset, selection, selectedBy, measured };
    const isSame = drawable !== null && isSameChoice(refused, drawable);
    // The same choice was drawn before: effects and names do not suit the current selection or camera.
    if (isSame) this.untinted = selection;
    this.become({
      ...(drawable ?? initialState(this.state.look)),
      ...kept,
      ...(isSame ? { effect: "none" as const, names: false } : {}),
    });
  }

  /** Starts the view of another model, without an undo step. */
  begin(state: ViewState): void {
    this.history.clear();
    this.before = this.aim = this.ground = null;
    this.state = state;
    this.redraw();
  }

  /** The same view in other coordinates, with all steps to it. */
  shift(move: (state: ViewState) => ViewState): void {
    this.history.change(move);
    this.state = move(this.state);
    this.fitted = null;
    this.redraw();
  }

  /** The names of the steps that undo() and redo() would take; null: there is none. */
  get undoable(): string | null {
    const { last } = this.history;
    return last ? stepText(last) : (this.before?.text ?? null);
  }
  get redoable(): string | null {
    const { next } = this.history;
    return next && stepText(next);
  }

  /** Takes the last step back, or repeats it. */
  undo(): void {
    if (!this.history.last && this.before) return this.before.act();
    this.step("undone", this.history.last, (now) => this.history.undo(now));
  }
  redo(): void {
    this.step("redone", this.history.next, (now) => this.history.redo(now));
  }

  private step(said: "undone" | "redone", changed: Changed | null, find: (now: ViewState) => ViewState | null): void {
    cancelAnimationFrame(this.flight);
    const found = find(this.state);
    if (!found || !changed) return;
    this.messages.say(t(said, { what: stepText(changed) }));
    this.become(found);
  }

  redraw(): void {
    ++this.revision;
  }

  /** Redraws after a change of data on which the colours depend. */
  recolor(): void {
    ++this.dataRevision;
    this.redraw();
  }

  /** Lays a picture below the model. null: removes it. */
  lay(ground: Ground | null): void {
    this.ground = ground;
    this.redraw();
  }

  resize(size: [number, number]): void {
    if (size[0] === this.size[0] && size[1] === this.size[1]) return;
    this.size = size;
    this.redraw();
  }

  /** @param queries  that select the members, if they are known */
  hide(members: Iterable<number>, hidden: boolean, queries: readonly string[] = []): void {
    const flags = switched(this.hidden, members, hidden);
    this.set({ hide: hideQueries(this.volume.index, flags, this.state.hide, this.answers.of, hidden ? queries : []) });
  }

  hideSelected(hidden: boolean): void {
    if (this.selected.length) this.hide(this.selected, hidden, selectionQueries(this.state));
  }

  /** Whether there are selected features with voxels, and all of them are hidden. */
  get isSelectionHidden(): boolean {
    const { features } = this.volume.index;
    const solids = this.selected.filter((i) => features[i]!.count > 0);
    return solids.length > 0 && solids.every((i) => this.hidden[i]);
  }

  /** Shows only the selected features, hidden spaces among them. */
  showOnlySelected(): void {
    const { hide } = this.state;
    const others = withoutSpaces(hide, this.volume.index);
    this.spacesBefore = hide.filter((query) => !others.includes(query));
    this.set({ show: selectionQueries(this.state), hide: others });
  }

  /** Ends showOnlySelected(). */
  showOthers(): void {
    const { hide } = this.state;
    const spaces = this.spacesBefore ?? hiddenSpaces(this.volume.index);
    this.spacesBefore = null;
    this.set({ show: [], hide: [...hide, ...spaces.filter((query) => !hide.includes(query))] });
  }

  /**
   * Moves the camera so that the features of a query fill the picture; from a named view, or from the current direction.
   * @param projection  null: that of the current camera
   * @param like  a camera with the direction; null: the current one
   */
  async goTo(
    query: string,
    preset: CameraPreset | null,
    isFollowed = true,
    projection: Framing | null = null,
    like: Camera | null = null,
  ): Promise<void> {
    const { engine, info, isServerOnly, box } = this.volume;
    if (!engine || !info) return;
    if (isServerOnly) return this.set({ camera: null, preset: preset ?? this.state.preset });
    const now = this.state.camera;
    const seen = like ?? now;
    const from: SceneCamera = seen
      ? sceneCamera(withProjection(seen, false), box, this.aspect)
      : { preset: kSceneMembers["/camera/preset"].default };
    const wanted = projection ?? now;
    if (wanted) from.fieldOfView = wanted.parallel ? kAlmostParallel : wanted.fieldOfView;
    try {
      const found = await engine.view(query, preset, from);
      // Automatic fitting must not override a view that the user chose meanwhile.
      if (!isFollowed && this.state.camera !== now) return;
      this.moveToFound(found, wanted, isFollowed);
    } catch (error) {
      this.messages.fail(error);
    }
  }

  /** Shows the selected features; all features, if there are too many for one query. */
  async goToSelected(): Promise<void> {
    const queries = selectionQueries(this.state);
    await this.goTo(queries.length > kMostFramed ? "" : queries.join(" or "), null);
  }

  /** Moves to a camera that the library has found, with the projection of another one. */
  moveToFound({ eye, target, fieldOfView }: SceneCamera, like: Projection | null = this.state.camera, isFollowed = true): void {
    if (!eye || !target) return;
    const degrees = fieldOfView ?? like?.fieldOfView ?? kSceneMembers["/camera/fieldOfView"].default;
    const camera = withProjection({ eye, target, parallel: false, height: 10, fieldOfView: degrees }, like?.parallel ?? false);
    this.moveTo(camera.parallel && like ? { ...camera, fieldOfView: like.fieldOfView } : camera, isFollowed);
  }

  beginWalking(): void {
    const { camera } = this.state;
    if (!this.isWalking && camera) this.beforeWalking = { parallel: camera.parallel, fieldOfView: camera.fieldOfView };
    this.isWalking = true;
  }

  /** The projection before, which has a narrower field of view; null: nobody was walking. */
  endWalking(): Framing | null {
    const { isWalking, beforeWalking } = this;
    this.isWalking = false;
    return isWalking && beforeWalking ? { around: "", ...beforeWalking } : null;
  }

  /** Animated, unless the user prefers reduced motion. */
  moveTo(camera: Camera, isFollowed = true): void {
    cancelAnimationFrame(this.flight);
    if (!isFollowed) return this.become({ ...this.state, camera });
    this.history.seal();
    const from = this.state.camera;
    if (!from || matchMedia("(prefers-reduced-motion: reduce)").matches) return this.set({ camera });
    const start = performance.now();
    const step = () => {
      const share = Math.min(1, (performance.now() - start) / kFlight);
      const eased = share * share * (3 - 2 * share);
      this.set({ camera: share === 1 ? camera : between(from, camera, eased) });
      if (share < 1) this.flight = requestAnimationFrame(step);
    };
    step();
  }

  /** Camera movement by the user: ends an animation. */
  turn(camera: Camera): void {
    cancelAnimationFrame(this.flight);
    this.set({ camera });
  }

  /** Shows the building as `framing` states, without an undo step. */
  async fit(aspect: number): Promise<void> {
    await this.goTo(this.framing.around, this.state.preset, false, this.framing);
    if (this.state.camera) this.fitted = { camera: this.state.camera, aspect };
  }

  /** Fits again if the picture has another aspect ratio and the camera has not moved since. */
  refit(aspect: number): void {
    // This picture still has the old size; one of the new size follows.
    if (!isSameAspect(aspect, this.aspect)) return;
    if (!this.fitted || this.fitted.camera !== this.state.camera || isSameAspect(this.fitted.aspect, aspect)) return;
    this.fitted = null;
    void this.fit(aspect);
  }
}

function isSameAspect(a: number, b: number): boolean {
  return Math.abs(a / b - 1) < 0.02;
}

function isDrawnDifferently(a: ViewState, b: ViewState): boolean {
  for (const key of Object.keys(b) as (keyof ViewState)[]) {
    if (a[key] === b[key]) continue;
    if (key === "measured") continue;
    const isOfSelection = key === "selection" || key === "selectedBy";
    if (!isOfSelection || b.names || ((b.effect === "highlight" || b.effect === "cutaway") && b.focus.query === "")) return true;
  }
  return false;
}

/** The name of a step, by its most important change. */
export function stepText(changed: Changed): string {
  return t(kStepNames[changed.find((key) => key !== "camera") ?? "camera"] ?? "look");
}

const kStepNames: Partial<Record<keyof ViewState, TextKey>> = {
  camera: "stepCamera",
  hide: "stepVisibility",
  show: "stepVisibility",
  styles: "stepStyles",
  sections: "section",
  regions: "section",
  effect: "focusEffect",
  lens: "lens",
  focus: "focus",
  shell: "shell",
  surfaces: "exactSurfaces",
  wireframe: "wireframe",
  names: "names",
  named: "names",
  colorBy: "colorBy",
  picture: "picture",
  sun: "look",
  field: "colorBy",
  hatches: "hatches",
  measured: "measure",
  custom: "sceneJson",
};
