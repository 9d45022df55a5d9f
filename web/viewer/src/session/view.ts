/** The view of the open model: its state, its undo steps, the animation of its camera, and its scene. */

import { between, withProjection } from "../camera/camera";
import type { CameraPreset, Samples, Scene, SceneCamera } from "../engine";
import { kSceneMembers } from "../generated/scene_members";
import { computed, membersOf, Observable } from "../observable";
import { History, type Changed } from "../state/history";
import { sceneCamera, sceneOf, type Described } from "../state/scene_of";
import { withSpaces } from "../state/spaces";
import { initialState, type Camera, type ViewState } from "../state/view_state";
import { hiddenFlags, hideQueries, switched } from "../state/visibility";
import { t, type TextKey } from "../texts";
import type { Messages } from "./messages";
import type { OpenVolume } from "./open_volume";

type Projection = Pick<Camera, "parallel" | "fieldOfView">;
export type Tool = "section" | "lens" | "focus" | "look" | "measure" | "views" | "share";

/** A view that is fitted to features, beside its direction. */
export interface Framing {
  /** Query of the features; empty: all. */
  around: string;
  parallel: boolean;
  /** Degrees. */
  fieldOfView: number;
}

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
  private readonly hiddenNow = computed(() => hiddenFlags(this.volume.index, this.now.hide));
  readonly history = new History();
  /** Size of the picture area in device pixels. */
  size: [number, number] = [640, 360];
  tool: Tool | null = null;
  isWalking = false;
  isLegendShown = false;
  /** Grows with each change that redraws the picture. */
  revision = 0;
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
  private flight = 0;
  /** The view fitted to the whole building, and its aspect ratio; it is recomputed for another aspect ratio. */
  private fitted: { camera: Camera; aspect: number } | null = null;

  constructor(
    private readonly volume: OpenVolume,
    private readonly messages: Messages,
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

  describe(size: [number, number], samples?: Samples): Described {
    const described = sceneOf(this.state, this.volume.box, size, samples);
    if (this.hasSwitches && !this.state.custom)
      described.scene.passes = described.scene.passes!.map((pass) => withSpaces(pass, this.volume.index, this.hidden));
    // Tiles of a city fit the pixels. Levels of detail of the tiles would cost time and memory without benefit.
    if (this.volume.isCity) described.scene.passes = described.scene.passes!.map((pass) => ({ level: 0, ...pass }));
    return described;
  }

  /** The scene for `svt render --scene`, with effects. */
  async composed(size: [number, number], samples?: Samples): Promise<Scene> {
    const { scene, effects } = this.describe(size, samples);
    const { engine } = this.volume;
    return engine && Object.keys(effects).length ? engine.compose(scene, effects) : scene;
  }

  /** Changes the view; the picture follows. */
  set(change: Partial<ViewState>): void {
    const before = this.state;
    this.become({ ...before, ...change });
    this.history.record(before, this.state, performance.now());
  }

  private become(state: ViewState): void {
    const before = this.state;
    this.state = state;
    if (isDrawnDifferently(before, state)) this.redraw();
  }

  /** Starts the view of another model, without an undo step. */
  begin(state: ViewState): void {
    this.history.clear();
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

  /** Takes the last step back, or repeats it. */
  undo(): void {
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

  resize(size: [number, number]): void {
    if (size[0] === this.size[0] && size[1] === this.size[1]) return;
    this.size = size;
    this.redraw();
  }

  hide(members: Iterable<number>, hidden: boolean): void {
    const flags = switched(this.hidden, members, hidden);
    this.set({ hide: hideQueries(this.volume.index, flags, this.state.hide) });
  }

  /**
   * Moves the camera so that the features of a query fill the picture; from a named view, or from the current direction.
   * @param projection  null: that of the current camera
   */
  async goTo(query: string, preset: CameraPreset | null, isFollowed = true, projection: Framing | null = null): Promise<void> {
    const { engine, info, isServerOnly, box } = this.volume;
    if (!engine || !info) return;
    if (isServerOnly) return this.set({ camera: null, preset: preset ?? this.state.preset });
    const now = this.state.camera;
    const seen = now ? withProjection(now, false) : null;
    const from: SceneCamera = seen ? sceneCamera(seen, box, this.aspect) : { preset: kSceneMembers["/camera/preset"].default };
    if (projection) from.fieldOfView = projection.fieldOfView;
    try {
      const found = await engine.view(query, preset, from);
      // Automatic fitting must not override a view that the user chose meanwhile.
      if (!isFollowed && this.state.camera !== now) return;
      this.moveToFound(found, projection ?? now, isFollowed);
    } catch (error) {
      this.messages.fail(error);
    }
  }

  /** Moves to a camera that the library has found, with the projection of another one. */
  moveToFound({ eye, target, fieldOfView }: SceneCamera, like: Projection | null = this.state.camera, isFollowed = true): void {
    if (!eye || !target) return;
    const degrees = fieldOfView ?? like?.fieldOfView ?? kSceneMembers["/camera/fieldOfView"].default;
    const camera: Camera = { eye, target, parallel: false, height: 10, fieldOfView: degrees };
    this.moveTo(withProjection(camera, like?.parallel ?? false), isFollowed);
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
    if (key !== "selection" || b.names || ((b.effect === "highlight" || b.effect === "cutaway") && b.focus.query === "")) return true;
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
  wireframe: "wireframe",
  names: "names",
  named: "names",
  colorBy: "colorBy",
  picture: "picture",
  hatches: "hatches",
  measured: "measure",
  custom: "sceneJson",
};
