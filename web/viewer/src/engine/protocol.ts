/** Messages between page and worker. A request has one answer, matched by id; open() reports progress before it. */
import type { Effects, EngineError, EngineKind, Pick, Scene, SceneCamera, Stretch } from "../engine";
import type { DrawingFormat, DrawingParts, FeatureProperties, FileBytes, FrameReport, MovedPlane, OpenOptions, Point, VolumeInfo } from "../engine";

/** Arguments and result of each call. */
export interface Calls {
  start: { args: [wanted: EngineKind | null]; result: EngineKind };
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
  movedPlanes: { args: [scene: Scene]; result: MovedPlane[] };
  sheets: { args: [language: "en" | "de"]; result: string[] };
}

export interface Drawn {
  bitmap: ImageBitmap;
  report: FrameReport;
}

export type Request = { [Name in keyof Calls]: { id: number; name: Name; args: Calls[Name]["args"] } }[keyof Calls];

export type Answer =
  | { id: number; result: Calls[keyof Calls]["result"] }
  | { id: number; error: EngineError; isDead: boolean }
  | { id: number; step: string; done: number };
