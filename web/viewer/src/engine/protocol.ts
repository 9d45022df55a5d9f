/** Messages between page and worker. A request has one answer, matched by id; open() reports progress before it. */
import type { CityLook, CityOptions, ColorScale, Effects, EngineError, EngineKind, Pick, Scene, SceneCamera, Stretch } from "../engine";
import type {
  DrawingFormat,
  DrawingParts,
  FeatureProperties,
  FileBytes,
  FrameReport,
  MovedPlane,
  OpenOptions,
  Point,
  VolumeInfo,
} from "../engine";

/** The name of a worker that is to use no threads. */
export const kWithoutThreads = "svt without threads";

/** Arguments and result of each call. */
export interface Calls {
  start: { args: [wanted: EngineKind | null]; result: { kind: EngineKind; threads: number } };
  open: { args: [files: FileBytes[], options: OpenOptions]; result: VolumeInfo };
  draw: { args: [scene: Scene, width: number, height: number]; result: Drawn };
  compose: { args: [scene: Scene, effects: Effects]; result: Scene };
  pick: { args: [x: number, y: number, reach: number]; result: Pick | null };
  along: { args: [x: number, y: number]; result: Stretch[] };
  select: { args: [query: string]; result: string[] };
  findInAttributes: { args: [words: string]; result: string[] };
  properties: { args: [id: string]; result: FeatureProperties };
  view: { args: [query: string, preset: string | null, camera: SceneCamera]; result: SceneCamera };
  picture: { args: [scene: Scene]; result: ArrayBuffer };
  drawing: { args: [plane: string, format: DrawingFormat, parts: DrawingParts | null]; result: ArrayBuffer };
  owners: { args: [table: ArrayBuffer, fileName: string]; result: null };
  stand: { args: [near: Point]; result: Point | null };
  step: { args: [eye: Point, by: Point]; result: Point };
  legend: { args: [scene: Scene]; result: ColorScale };
  movedPlanes: { args: [scene: Scene]; result: MovedPlane[] };
  cityLook: {
    args: [isNew: boolean, scene: Scene | null, width: number, height: number, options: CityOptions];
    result: CityLook | CityNeeds;
  };
  cityFind: { args: [id: string, camera: SceneCamera, aspect: number]; result: SceneCamera | CityNeeds };
  cityGive: { args: [given: GivenRow[], bytes: ArrayBuffer]; result: null };
  cityInfo: { args: []; result: VolumeInfo | null };
  cityDrop: { args: []; result: null };
  sheets: { args: [language: "en" | "de"]; result: string[] };
}

/** Ranges of a city's files that a call needs: give them, and call again. */
export interface CityNeeds {
  needs: [file: string, offset: number, size: number][];
}

/** A range, how many bytes of it are given, the size of the file, and why the range cannot be had. */
export type GivenRow = [file: string, offset: number, size: number, given: number, total: number, error: string | null];

export interface Drawn {
  bitmap: ImageBitmap;
  report: FrameReport;
}

export type Request = { [Name in keyof Calls]: { id: number; name: Name; args: Calls[Name]["args"] } }[keyof Calls];

export type Answer =
  | { id: number; result: Calls[keyof Calls]["result"] }
  | { id: number; error: EngineError; isDead: boolean }
  | { id: number; step: string; done: number };
