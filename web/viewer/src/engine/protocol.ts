/** Messages between page and worker. A request has one answer, matched by id; open() reports progress before it. */
import type {
  CityFound,
  CityLook,
  CityOptions,
  DrawingFormat,
  EngineError,
  EngineKind,
  FileBytes,
  FrameReport,
  OpenOptions,
  Scene,
  SceneCamera,
  VolumeInfo,
  kCalls,
} from "../engine";

/** The name of a worker that must not use threads. */
export const kWithoutThreads = "svt without threads";

/** Calls for which the worker or the client makes several calls of the library. */
interface OwnCalls {
  start(wanted: EngineKind | null): { kind: EngineKind; threads: number };
  open(files: FileBytes[], options: OpenOptions): VolumeInfo;
  draw(scene: Scene, width: number, height: number): Drawn;
  cityLook(isNew: boolean, scene: Scene | null, width: number, height: number, options: CityOptions): CityLook | CityNeeds;
  cityFind(id: string, camera: SceneCamera, aspect: number): SceneCamera | CityNeeds;
  citySearch(words: string, most: number): CityFound | CityNeeds;
  /** In a worker of its own, because the whole module forgets the open part of a city. */
  cityDrawing(plane: string, format: DrawingFormat, most: number): { text: string } | CityNeeds;
  cityGive(given: GivenRow[], bytes: ArrayBuffer): null;
  cityDrop(): null;
}

type All = OwnCalls & typeof kCalls;
/** Arguments and result of each call. */
export type Calls = { [Name in keyof All]: { args: Parameters<All[Name]>; result: ReturnType<All[Name]> } };

/** Ranges of a city's files that a call needs: give them, and call again. */
export interface CityNeeds {
  needs: [file: string, offset: number, size: number][];
}

/** A range, the number of its given bytes, the size of the file, and the reason if the range is unavailable. */
export type GivenRow = [file: string, offset: number, size: number, given: number, total: number, error: string | null];

export interface Drawn {
  bitmap: ImageBitmap;
  report: FrameReport;
}

export type Request = { [Name in keyof Calls]: { id: number; name: Name; args: Calls[Name]["args"] } }[keyof Calls];

export type Answer =
  | { id: number; result: Calls[keyof Calls]["result"] }
  | { id: number; error: EngineError; isDead: boolean }
  | { id: number; step: string; done: number }
  /** Bytes of the first module, of how many; before any request. */
  | { received: number; all: number };
