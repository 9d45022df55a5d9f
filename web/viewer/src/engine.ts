/**
 * What the page asks of the library. The library runs as WebAssembly in a worker (`web/wasm`); the page holds no
 * geometry, no query and no drawing code of its own. Lengths are metres; points are metres from the grid's lower
 * corner in world axes, as in scenes; pixels count from the top left.
 */

/** A `*.scene.json`: docs/formats/scene.schema.json. The page edits it, the library draws it. */
export interface Scene {
  format?: "svt-scene";
  version?: 1;
  size?: [number, number];
  samples?: 1 | 4 | 9 | 16;
  look?: "plain" | "paper" | "blueprint" | "dark";
  camera?: SceneCamera;
  background?: string;
  transparent?: boolean;
  lines?: { strength?: number; width?: number; cutWidth?: number; color?: string };
  hatches?: { show?: boolean; spacing?: number };
  ambientOcclusion?: number;
  names?: string[];
  passes?: ScenePass[];
}

export interface SceneCamera {
  preset?: string;
  around?: string;
  parallel?: boolean;
  fieldOfView?: number;
  zoom?: number;
  eye?: Point;
  target?: Point;
}

export interface ScenePass {
  show?: string[];
  hide?: string[];
  styles?: SceneStyle[];
  cut?: string;
  keep?: string;
  join?: "over" | "replace" | "depth";
  lines?: { select?: string; width?: number; color?: string; hidden?: string }[];
  meshes?: string[];
  /** Only the hulls of groups at this level of the tree, as `svt shell` makes them. */
  shell?: ShellLevel;
  /** Level of detail, 0 (finest) to 6; by default as fine as the pixels show. */
  level?: number;
}
export type ShellLevel = "component" | "room" | "unit" | "storey" | "building";

export interface SceneStyle {
  select: string;
  color?: string;
  opacity?: number;
  hatch?: string;
  ghost?: boolean;
}

export type Point = [number, number, number];

/** What turns a scene of one pass into a lens, a highlight or a cutaway; each as `svt render` does it. */
export interface Effects {
  lens?: { region: string; cut: string; context: Context };
  highlight?: { queries: string[]; context: Context };
  cutaway?: { query: string; margin: number };
}
/** `shell`: the outer hull of the building as glass. */
export type Context = "ghost" | "solid" | "shell" | "none";

/** A feature of the model, with or without voxels; in tree order. */
export interface Feature {
  id: string;
  class: string;
  name: string;
  parent: string;
  /** How far below the root. */
  depth: number;
  /** Own scalars [first, first + count); count 0: no voxels of its own. */
  first: number;
  count: number;
  /** sRGB as the volume's style has it, `#rrggbb`; opacity as in styles. */
  color: string;
  opacity: number;
}

export interface VolumeInfo {
  name: string;
  source: string;
  crs: string;
  dimension: Point;
  spacing: Point;
  /** Edge lengths of the grid's box in world axes. */
  size: Point;
  /** The grid's axes in world axes; without them they are the same. Sections along x, y and z follow the grid. */
  axes?: [Point, Point, Point];
  storeys: { id: string; name: string; floor: number; top: number }[];
  features: Feature[];
  /** Whether wireframes and meshes can be drawn. */
  hasEdges: boolean;
  hasMeshes: boolean;
  /** Findings of building a model, worst first; empty for a `.svt`. */
  findings: string[];
}

/** All that is known of a feature. */
export interface FeatureProperties {
  id: string;
  class: string;
  name: string;
  attributes: Record<string, string>;
  /** By voxels, m3; the model's own volume where its solid is closed. */
  voxelVolume: number;
  modelVolume: number | null;
  /** m2. */
  surface: number;
  box: { low: Point; high: Point };
  neighbours: { id: string; class: string; name: string; area: number }[];
}

/** What lies under a pixel of the last picture; null: nothing. */
export interface Pick {
  scalar: number;
  id: string;
  class: string;
  name: string;
  /** Where the ray meets it. */
  point: Point;
}

/** A stretch of a ray through one object. */
export interface Stretch {
  id: string;
  class: string;
  name: string;
  from: number;
  to: number;
}

export type DrawingFormat = "svg" | "dxf" | "geojson" | "csv";
export type EngineKind = "webgl2" | "cpu";

export interface FrameReport {
  /** Pixels drawn, which may be fewer than asked for while moving. */
  width: number;
  height: number;
  milliseconds: number;
  engine: EngineKind;
}

/** An error of the library: `code` as in docs/errors, `message` names place and remedy. */
export interface EngineError {
  code: string;
  message: string;
}

/** Rejected promises carry an EngineError. One volume is open at a time. */
export interface Engine {
  readonly kind: EngineKind;

  /** Opens a `.svt` or a model file by its bytes, which are given away. */
  open(bytes: ArrayBuffer, fileName: string, onProgress: (step: string, done: number) => void): Promise<VolumeInfo>;

  /**
   * Draws into the canvas that the engine was made with, at `width` x `height` pixels (the canvas is scaled by CSS).
   * Only the newest request waits: one that is overtaken resolves to null.
   */
  draw(scene: Scene, width: number, height: number): Promise<FrameReport | null>;

  /** The scene with effects, as `svt render --lens/--highlight/--cutaway` make it. */
  compose(scene: Scene, effects: Effects): Promise<Scene>;

  /** x and y in 0..1 of the picture that was drawn last. */
  pick(x: number, y: number): Promise<Pick | null>;
  /** Everything along the ray through a pixel, nearest first, hidden or not. */
  along(x: number, y: number): Promise<Stretch[]>;

  /** Ids of the features that a query selects. */
  select(query: string): Promise<string[]>;
  properties(id: string): Promise<FeatureProperties>;
  /** Eye and target that show what a query selects (empty: all) from a named view or, without one, from where the camera looks now. */
  view(query: string, preset: string | null, camera: SceneCamera): Promise<SceneCamera>;

  /** A picture as PNG, drawn by the CPU caster as `svt render` does, bit for bit. */
  picture(scene: Scene): Promise<ArrayBuffer>;
  /** The cut through the volume as `svt section` draws it. */
  drawing(plane: string, format: DrawingFormat): Promise<ArrayBuffer>;
}
