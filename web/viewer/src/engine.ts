/**
 * The interface of the library as used by the page. The library runs as WebAssembly in a worker (`web/wasm`); the page
 * has no geometry, query or drawing code of its own. Lengths are metres; points are metres from the grid's lower
 * corner in world axes, as in scenes; pixel coordinates start at the top left.
 */

import type { ChoiceOf, Scene } from "./generated/scene_members";

export type { Scene } from "./generated/scene_members";
/** Rays per pixel. */
export type Samples = ChoiceOf<"/samples">;
export type Look = ChoiceOf<"/look">;
export type SceneCamera = NonNullable<Scene["camera"]>;
export type CameraPreset = ChoiceOf<"/camera/preset">;
export type ScenePass = NonNullable<Scene["passes"]>[number];
export type ShellLevel = ChoiceOf<"/passes/*/shell">;
/** The drawing of edges behind something opaque. */
export type HiddenLines = ChoiceOf<"/passes/*/lines/*/hidden">;
export type SceneStyle = NonNullable<ScenePass["styles"]>[number];

export type Point = [number, number, number];

/** Turns a scene of one pass into a lens, a highlight or a cutaway, as `svt render` does. */
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
  /** Depth below the root. */
  depth: number;
  /** Own scalars [first, first + count); count 0: no voxels of its own. */
  first: number;
  count: number;
  /** Type in the model's own format: IfcWall. */
  type?: string;
  /** sRGB from the volume's style, `#rrggbb`; opacity as in styles. */
  color: string;
  opacity: number;
  /** A room, flat or storey: pictures leave it out unless a query asks for it. Absent: false. */
  isSpace?: boolean;
  /** Positions, in this list of features, of storeys, flats and groups that have it as a member. Absent: none. */
  groups?: number[];
}

/** The features with an attribute. */
export interface AttributeUse {
  name: string;
  /** Number of features, and of rooms and other spaces among them. */
  count: number;
  onSpaces: number;
  /** Whether all values are numbers. */
  isNumber: boolean;
}

export interface VolumeInfo {
  name: string;
  source: string;
  crs: string;
  dimension: Point;
  spacing: Point;
  /** The grid's lower corner in the coordinates of the model. */
  origin: Point;
  /** Edge lengths of the grid's box in world axes. */
  size: Point;
  /** The grid's axes in world axes; absent if they coincide. Sections along x, y and z follow the grid. */
  axes?: [Point, Point, Point];
  /** Storeys of the model; without them, levels derived from rooms and slabs, with an empty id. */
  storeys: { id: string; name: string; floor: number; top: number }[];
  /** The reason for the spacing of a model; empty for a `.svt`. */
  spacingReason: string;
  /** Number of other volumes that are drawn together with it. */
  details: number;
  /** Names of attributes, the most frequent ones first. */
  attributes: string[];
  /** The same attributes with their features. Absent: unknown. */
  attributeUses?: AttributeUse[];
  features: Feature[];
  /** Number of all buildings of a city, visible or not. */
  buildings?: number;
  /** Whether wireframes and meshes can be drawn. */
  hasEdges: boolean;
  hasMeshes: boolean;
  /** Whether the volume has fields. Absent: no. */
  hasFields?: boolean;
  /** Findings of building a model, worst first; empty for a `.svt`. */
  findings: string[];
}

/** All properties of a feature. */
export interface FeatureProperties {
  id: string;
  class: string;
  name: string;
  attributes: Record<string, string>;
  /** Attributes that are measured, or counted with fractions. */
  numbers: Record<string, { value: number; unit: string }>;
  /** From voxels, m3; the model's own volume if its solid is closed. */
  voxelVolume: number;
  /** By how much voxelVolume may be off, m3: half a voxel along the surface. */
  voxelBound: number;
  modelVolume: number | null;
  /** Floor area of a room, m2; null: not a room, or the model has no levels. */
  floorArea: number | null;
  /** By voxels, m2. */
  surface: number;
  /** Volume and surface of the feature with its parts: a flat with its rooms. */
  totalVolume: number | null;
  totalSurface: number;
  /** The box of the feature with its parts; the neighbours are those of both. */
  box: { low: Point; high: Point };
  neighbours: { id: string; class: string; name: string; area: number }[];
}

/** A field of the volume, such as temperature: values beside the labels, over time. */
export interface FieldInfo {
  name: string;
  kind: "grid" | "label" | "points";
  quantity: string;
  /** UCUM code: `Cel`. */
  unit: string;
  components: number;
  medium: string;
  /** Seconds, ascending. */
  times: number[];
  /** Date and time of 0 s, ISO 8601 with zone; null: unknown. */
  epoch: string | null;
  /** The least and the largest value of all times; null: all are missing. */
  range: [number, number] | null;
}

/** The values of a field at a place, at all of its times; null: missing. */
export interface FieldSeries {
  id: string;
  class: string;
  name: string;
  values: (number | null)[];
}

/** Values of a field in a component at one time; null: unknown. Volumes, in m3, with values and without. */
export interface FieldRow {
  id: string;
  class: string;
  name: string;
  mean: number | null;
  min: number | null;
  max: number | null;
  volume: number;
  missing: number;
}

/** Values of one attribute. Null: the feature does not have it. Numbers in another unit than the first one are text. */
export interface AttributeValues {
  values: (number | string | null)[];
  /** The unit of the numbers; empty: none. */
  unit: string;
}

/** The hit at a pixel of the last picture; null: nothing. */
export interface Pick {
  scalar: number;
  id: string;
  class: string;
  name: string;
  /** The point where the ray hits it. */
  point: Point;
  /** The corner, or else the point of an edge of the model, within the requested reach. */
  snapped?: { point: Point; to: "corner" | "edge" };
}

/** An interval of a ray inside one object. */
export interface Stretch {
  id: string;
  class: string;
  name: string;
  from: number;
  to: number;
}

export type DrawingFormat = "svg" | "dxf" | "geojson" | "csv";

/** Parts of a drawing beside the cut: edges behind it, parts that are cut away, dimension chains (in plans). */
export interface DrawingParts {
  beyond: boolean;
  above: boolean;
  dimensions: boolean;
}
export type EngineKind = "webgl2" | "cpu";

export interface FrameReport {
  /** Size in pixels, which may be smaller than requested while moving. */
  width: number;
  height: number;
  milliseconds: number;
  engine: EngineKind;
}

/** An error of the library: `code` as in docs/errors; `message` states location and remedy. */
export interface EngineError {
  code: string;
  message: string;
}

/** A file of the user or the site. */
export interface FileBytes {
  name: string;
  bytes: ArrayBuffer;
}

export interface OpenOptions {
  /** Models: coarse voxels without edges, for a first picture. */
  draft?: boolean;
  /** Models: size limit of a volume without a given spacing, bytes. */
  memory?: number;
}

/** The visible part of a city, as tiles of several levels of detail. */
export interface CityLook {
  /** null: the visible tiles are sufficient. */
  info: VolumeInfo | null;
  /** Identifies the chosen tiles. */
  key: string;
  tiles: number;
  /** Size of the tiles' members. */
  bytes: number;
  /** Maximum width of voxels in pixels. */
  pixels: number;
  finest: number;
  coarsest: number;
  /** The reason for each unavailable tile. */
  lacks: string[];
  /** Bytes of the library's memory. */
  heap: number;
}

/** Buildings of a city that a search found. */
export interface CityFound {
  /** Number of all buildings that were found. */
  count: number;
  /** The first ones. */
  buildings: { id: string; name: string; class: string; address: string }[];
}

export interface CityOptions {
  /** Permitted width of voxels in pixels. */
  pixels: number;
  /** Approximate limit of decoded tiles, bytes. */
  memory: number;
  /** CityLook.key of the tiles that are already visible. */
  shown: string;
  /** Omits the features, because there may be tens of thousands; cityInfo() returns them. */
  isMoving?: boolean;
}

/** Fetches bytes of a city's files. */
export interface CityBytes {
  get(
    wanted: readonly (readonly [file: string, offset: number, size: number])[],
  ): Promise<{ range: readonly [file: string, offset: number, size: number]; bytes: Uint8Array; total: number; error: string | null }[]>;
}

/** A section plane that lies in faces of the model, and is drawn `by` metres beside them, on the kept side. */
export interface MovedPlane {
  text: string;
  by: number;
}

/** The meaning of the colours of `colorBy`: numbers from low to high, or entries. */
export interface ColorScale {
  title: string;
  isRamp: boolean;
  low: number;
  high: number;
  /** Colours at equal steps from low to high, `#rrggbb`. Absent: unknown. */
  ramp?: string[];
  entries: { text: string; count: number; color?: string }[];
  /** Further lines. Absent: none. */
  notes?: string[];
  /** Whether places without a value have missingColor. Absent: no. */
  hasUnknown?: boolean;
  /** Components without a value, and their colour. */
  missing: number;
  missingColor?: string;
}

/** The type of a call: its arguments and its result. */
const call = <Signature extends (...args: never[]) => unknown>() => undefined as unknown as Signature;

/**
 * The calls that the page passes to the worker unchanged, by name. Those of the library are rows of `web/wasm/module.cpp`: a new
 * call needs a row in each of the two tables. The worker becomes the owner of a buffer among the arguments.
 */
export const kCalls = {
  /** The scene with effects, as in `svt render --lens/--highlight/--cutaway`. */
  compose: call<(scene: Scene, effects: Effects) => Scene>(),
  /**
   * x and y in 0..1 of the last picture.
   * @param reach  maximum distance, metres, to snap to corners and edges of the model; 0: no snapping
   */
  pick: call<(x: number, y: number, reach?: number) => Pick | null>(),
  /** Everything along the ray through a pixel, nearest first, hidden or not. */
  along: call<(x: number, y: number) => Stretch[]>(),
  /** Ids of the features that a query selects. */
  select: call<(query: string) => string[]>(),
  /** Ids of features with an attribute that contains all words, in its name or value. */
  findInAttributes: call<(words: string) => string[]>(),
  properties: call<(id: string) => FeatureProperties>(),
  /** The values of one attribute, in the order of VolumeInfo.features. */
  attributeValues: call<(name: string) => AttributeValues>(),
  /**
   * Eye and target that show the features selected by a query (empty: all), from a named view or else from the
   * current view direction.
   */
  view: call<(query: string, preset: string | null, camera: SceneCamera) => SceneCamera>(),
  /** A picture as PNG, drawn by the CPU caster, bit-identical to `svt render`. */
  picture: call<(scene: Scene) => ArrayBuffer>(),
  /** The label image of a picture as PNG with 16 bits, as `svt render --labels` writes it. */
  labels: call<(scene: Scene) => ArrayBuffer>(),
  /** The section through the volume as drawn by `svt section`. */
  drawing: call<(plane: string, format: DrawingFormat, parts?: DrawingParts) => ArrayBuffer>(),
  /**
   * Sets the owners of features, as attributes `owner`, from a table (CSV). Replaces an earlier table. Resolves to messages on the
   * first rows that name no feature, with their lines; at most 1000.
   */
  owners: call<(table: ArrayBuffer, fileName: string) => string[]>(),
  /** The eye of a person standing near a point, inside if possible; null: there is no place to stand. */
  stand: call<(near: Point) => Point | null>(),
  /** The eye after a step, which glides along obstacles. */
  step: call<(eye: Point, by: Point) => Point>(),
  /** The fields of the open `.svt`; empty for other files, and for several. */
  fieldList: call<() => FieldInfo[]>(),
  /** The values of a field at a place of the last picture, fractions of its size; null: nothing is there. */
  fieldAt: call<(field: string, x: number, y: number) => FieldSeries | null>(),
  /** The values of a field by component at one of its times, an index. */
  fieldRows: call<(field: string, time: number) => FieldRow[]>(),
  /** The meaning of the colours of a scene with colorBy or a field. */
  legend: call<(scene: Scene) => ColorScale>(),
  /** Longitude and latitude, degrees, of points in coordinates of the model: east and north. */
  places: call<(points: [number, number][]) => [number, number][]>(),
  /** The planes of the scene that lie in faces of the model. */
  movedPlanes: call<(scene: Scene) => MovedPlane[]>(),
  /** Plans, sections, elevations and tables on sheets, as SVG documents; as in `svt sheets`. */
  sheets: call<(language: "en" | "de") => string[]>(),
  /**
   * Loads the font, and the part of the library that reads models, draws exact surfaces, and makes drawings and sheets, for
   * later calls, also without a connection. Without this call they are loaded when they are needed. Resolves to whether the
   * part is there: not if the browser is to save data. Other calls are answered meanwhile.
   */
  prepare: call<() => boolean>(),
  /** The volume that followCity() has opened, with its features; null: nothing is open. The worker answers without the library. */
  cityInfo: call<() => VolumeInfo | null>(),
};

type CallsOfLibrary = typeof kCalls;
/** The same calls with their answers as promises. */
export type LibraryCalls = {
  [Name in keyof CallsOfLibrary]: (...args: Parameters<CallsOfLibrary[Name]>) => Promise<ReturnType<CallsOfLibrary[Name]>>;
};

/** All the calls, each made by one function. */
export function callsBy(make: (name: keyof LibraryCalls, args: unknown[]) => Promise<unknown>): LibraryCalls {
  const names = Object.keys(kCalls) as (keyof LibraryCalls)[];
  return Object.fromEntries(names.map((name) => [name, (...args: unknown[]) => make(name, args)])) as unknown as LibraryCalls;
}

/** The code of an opening that was cancelled. */
export const kCancelled = "cancelled";

/** Rejected promises carry an EngineError. One volume is open at a time. */
export interface Engine extends LibraryCalls {
  readonly kind: EngineKind;
  /** Threads that draw together; 1 if the site does not isolate the page (COOP, COEP). */
  readonly threads: number;

  /** Opens files from their bytes, whose ownership is transferred: several models become one; other volumes are drawn with the first file. */
  open(files: FileBytes[], onProgress: (step: string, done: number) => void, options?: OpenOptions): Promise<VolumeInfo>;
  /** Ends an opening, and rejects its promise with kCancelled. Afterwards, no volume is open. */
  cancel(): void;

  /** Opens files while the open volume can still be drawn and queried, and replaces that volume at the end. */
  refine(files: FileBytes[], onProgress: (step: string, done: number) => void, options?: OpenOptions): Promise<VolumeInfo>;
  /** Ends refine(), and rejects its promise with kCancelled. The open volume stays. */
  cancelRefining(): void;

  /** Opens a city with the one tile of its coarsest detail. */
  openCity(files: CityBytes, options: CityOptions): Promise<CityLook>;
  /** Fetches the tiles that a scene's camera sees. Meanwhile the open tiles can be drawn and queried; they are replaced at the end. */
  followCity(files: CityBytes, scene: Scene, size: [number, number], options: CityOptions): Promise<CityLook>;
  /** A camera that shows a building of the open city. Reads two ranges of ids.bin, and the building's tile. */
  findInCity(files: CityBytes, id: string, camera: SceneCamera, aspect: number): Promise<SceneCamera>;
  /** Buildings of the open city with all words in their names and attributes. Reads pages of words.bin. */
  searchCity(files: CityBytes, words: string, most: number): Promise<CityFound>;

  /**
   * The section through the open city as drawn by `svt section CITY`. Reads the tiles of detail 0 that the plane meets.
   * @param most  limit of their bytes; rejects if they have more
   */
  drawCity(
    files: CityBytes,
    plane: string,
    format: DrawingFormat,
    most: number,
    onProgress: (step: string, done: number) => void,
  ): Promise<ArrayBuffer>;

  /**
   * Draws into the engine's canvas at `width` x `height` pixels (the canvas is scaled by CSS).
   * Only the newest request is queued: a superseded one resolves to null.
   */
  draw(scene: Scene, width: number, height: number): Promise<FrameReport | null>;

  /** Ends the library with its memory and its WebGL context. Pending and later calls are rejected with kCancelled. */
  close(): void;
}
