/** The engine on the page's side: passes requests to the worker and shows its pictures on the canvas. */
import { callsBy, kCancelled } from "../engine";
import type {
  CityBytes,
  CityFound,
  CityLook,
  CityOptions,
  DrawingFormat,
  Engine,
  EngineError,
  EngineKind,
  FileBytes,
  FrameReport,
  LibraryCalls,
  OpenOptions,
  Scene,
  SceneCamera,
  VolumeInfo,
} from "../engine";
import { withBytes } from "./city_calls";
import { startWorker, type WorkerPlace } from "./start_worker";
import type { OnReceived } from "./module";
import type { Answer, Calls, Request } from "./protocol";

type Name = keyof Calls;
type OnProgress = (step: string, done: number) => void;

/** A request waiting for its answer. */
interface Waiting {
  resolve: (result: never) => void;
  reject: (error: EngineError) => void;
  onProgress?: OnProgress;
}

/** A picture requested while another is being drawn. */
interface WaitingDraw {
  args: Calls["draw"]["args"];
  resolve: (report: FrameReport | null) => void;
  reject: (error: EngineError) => void;
}

/** One worker with the library and one volume. */
class Connection {
  private readonly worker: Worker;
  private readonly waiting = new Map<number, Waiting>();
  private lastId = 0;
  /** Why it has ended; null: it has not. */
  private ended: EngineError | null = null;
  /** Whether the worker has ever answered: one without any answer would fail again. */
  isAlive = false;

  /**
   * @param died  called when the library has stopped; close() is up to the caller
   * @param received  called with the bytes of the module, of how many
   */
  constructor(
    place: WorkerPlace,
    private readonly died: (error: EngineError) => void,
    private readonly received: OnReceived = () => {},
  ) {
    this.worker = startWorker(place);
    this.worker.onmessage = (event: MessageEvent<Answer>) => this.take(event.data);
    this.worker.onerror = (event) => {
      event.preventDefault();
      this.died({ code: "E999", message: `the library cannot run here (${event.message})` });
    };
  }

  ask<N extends Name>(
    name: N,
    args: Calls[N]["args"],
    transfer: Transferable[] = [],
    onProgress?: OnProgress,
  ): Promise<Calls[N]["result"]> {
    if (this.ended) return Promise.reject(this.ended);
    return new Promise((resolve, reject) => {
      const id = ++this.lastId;
      this.waiting.set(id, { resolve, reject, ...(onProgress ? { onProgress } : {}) });
      this.worker.postMessage({ id, name, args } as Request, transfer);
    });
  }

  open(files: FileBytes[], onProgress: OnProgress, options: OpenOptions): Promise<VolumeInfo> {
    const buffers = files.map(({ bytes }) => bytes);
    return this.ask("open", [files, options], buffers, onProgress);
  }

  /** Ends it with all its requests. */
  close(error: EngineError): void {
    this.ended = error;
    this.worker.terminate();
    const lost = [...this.waiting.values()];
    this.waiting.clear();
    for (const request of lost) request.reject(error);
  }

  private take(answer: Answer): void {
    if ("received" in answer) return this.received(answer.received, answer.all);
    this.isAlive = this.isAlive || !("error" in answer);
    const request = this.waiting.get(answer.id);
    if (!request) return;
    if ("step" in answer) return request.onProgress?.(answer.step, answer.done);
    this.waiting.delete(answer.id);
    if ("result" in answer) return request.resolve(answer.result as never);
    request.reject(answer.error);
    if (answer.isDead) this.died(answer.error);
  }
}

/** Pixels of an invisible picture. */
const kUnseen = [48, 27] as const;

const kGivenUp: EngineError = { code: kCancelled, message: kCancelled };
const kNoCanvas: EngineError = { code: "E904", message: "the engine has no canvas to draw into; use picture() instead" };

/** The calls that are not passed on unchanged. */
class WorkerEngine {
  kind: EngineKind = "cpu";
  threads = 1;
  private main: Connection;
  /** Worker that opens a finer volume meanwhile. */
  private second: Connection | null = null;
  /** Second worker on the same city; prepares the next visible tiles. */
  private spare: Connection | null = null;
  /** Workers that draw sections of a city. */
  private readonly drawings = new Set<Connection>();
  private isDrawing = false;
  private nextDraw: WaitingDraw | null = null;
  private readonly screen: ImageBitmapRenderingContext | null;
  private isClosed = false;

  constructor(
    canvas: HTMLCanvasElement | null,
    private readonly wanted: EngineKind | null,
    private readonly place: WorkerPlace,
    onReceived?: OnReceived,
  ) {
    this.screen = canvas?.getContext("bitmaprenderer") ?? null;
    if (canvas && !this.screen) throw { code: "E904", message: "the canvas has another context already" } satisfies EngineError;
    this.main = this.connect(onReceived);
  }

  /** Resolves when the library is loaded. */
  async start(): Promise<void> {
    ({ kind: this.kind, threads: this.threads } = await this.main.ask("start", [this.wanted]));
  }

  private connect(onReceived?: OnReceived): Connection {
    const made: Connection = new Connection(
      this.place,
      (error) => {
        if (made === this.main) this.restart(error);
        else if (made === this.second) this.endSecond(error);
        else if (made === this.spare) this.endSpare(error);
        else made.close(error);
      },
      onReceived,
    );
    return made;
  }

  /** Passes a call on unchanged. */
  call(name: keyof LibraryCalls, args: unknown[]): Promise<unknown> {
    const buffers = args.filter((arg): arg is ArrayBuffer => arg instanceof ArrayBuffer);
    return this.main.ask(name, args as Calls[typeof name]["args"], buffers);
  }

  open(files: FileBytes[], onProgress: OnProgress, options: OpenOptions = {}): Promise<VolumeInfo> {
    this.cancelRefining();
    this.endSpare();
    return this.main.open(files, onProgress, options);
  }

  async refine(files: FileBytes[], onProgress: OnProgress, options: OpenOptions = {}): Promise<VolumeInfo> {
    this.cancelRefining();
    const second = (this.second = this.connect());
    try {
      await second.ask("start", [this.wanted]);
      const info = await second.open(files, onProgress, options);
      const before = this.main;
      this.main = second;
      this.second = null;
      before.close(kGivenUp);
      return info;
    } catch (error) {
      if (this.second === second) this.endSecond(kGivenUp);
      throw error;
    }
  }

  openCity(files: CityBytes, options: CityOptions): Promise<CityLook> {
    this.cancelRefining();
    this.endSpare();
    return withBytes(this.main, files, "cityLook", (round) => [round === 0, null, 0, 0, options]);
  }

  async followCity(files: CityBytes, scene: Scene, [width, height]: [number, number], options: CityOptions): Promise<CityLook> {
    const spare = this.spare ?? (await this.startSpare());
    let look: CityLook;
    try {
      look = await withBytes(spare, files, "cityLook", () => [false, scene, width, height, options]);
      if (!look.info || this.spare !== spare) return { ...look, info: null };
      // Draws once invisibly, so that the first visible picture does not wait for bricks.
      const { bitmap } = await spare.ask("draw", [scene, ...kUnseen]);
      bitmap.close();
    } catch (error) {
      // A new worker starts from the beginning.
      if (this.spare === spare) this.endSpare();
      throw error;
    }
    if (this.spare !== spare) return { ...look, info: null };
    this.spare = this.main;
    this.main = spare;
    this.spare.ask("cityDrop", []).catch(() => undefined);
    return look;
  }

  findInCity(files: CityBytes, id: string, camera: SceneCamera, aspect: number): Promise<SceneCamera> {
    return withBytes(this.main, files, "cityFind", () => [id, camera, aspect]);
  }

  searchCity(files: CityBytes, words: string, most: number): Promise<CityFound> {
    return withBytes(this.main, files, "citySearch", () => [words, most]);
  }

  async drawCity(files: CityBytes, plane: string, format: DrawingFormat, most: number, onProgress: OnProgress): Promise<ArrayBuffer> {
    const own = this.connect();
    this.drawings.add(own);
    try {
      const { text } = await withBytes(own, files, "cityDrawing", () => [plane, format, most], onProgress);
      return new TextEncoder().encode(text).buffer;
    } finally {
      this.drawings.delete(own);
      own.close(kGivenUp);
    }
  }

  private async startSpare(): Promise<Connection> {
    const spare = (this.spare = this.connect());
    await spare.ask("start", ["cpu"]);
    return spare;
  }

  private endSpare(error: EngineError = kGivenUp): void {
    const { spare } = this;
    this.spare = null;
    spare?.close(error);
  }

  cancelRefining(): void {
    this.endSecond(kGivenUp);
  }

  private endSecond(error: EngineError): void {
    const { second } = this;
    this.second = null;
    second?.close(error);
  }

  draw(scene: Scene, width: number, height: number): Promise<FrameReport | null> {
    if (!this.screen) return Promise.reject(kNoCanvas);
    return new Promise((resolve, reject) => {
      this.nextDraw?.resolve(null);
      this.nextDraw = { args: [scene, width, height], resolve, reject };
      this.drawNext();
    });
  }

  /** Replaces the worker, because it cannot be interrupted. */
  cancel(): void {
    this.cancelRefining();
    this.endSpare();
    this.restart(kGivenUp);
  }

  close(): void {
    this.isClosed = true;
    this.nextDraw?.resolve(null);
    this.nextDraw = null;
    this.cancelRefining();
    this.endSpare();
    for (const own of this.drawings) own.close(kGivenUp);
    this.main.close(kGivenUp);
  }

  private drawNext(): void {
    const next = this.nextDraw;
    if (this.isDrawing || !next) return;
    this.nextDraw = null;
    this.isDrawing = true;
    this.main
      .ask("draw", next.args)
      .then(({ bitmap, report }) => {
        this.kind = report.engine;
        this.screen!.transferFromImageBitmap(bitmap);
        next.resolve(report);
      }, next.reject)
      .finally(() => {
        this.isDrawing = false;
        this.drawNext();
      });
  }

  /** Discards a failed worker with all its requests; the new one has no volume. */
  private restart(error: EngineError): void {
    const before = this.main;
    if (before.isAlive && !this.isClosed) {
      this.main = this.connect();
      this.start().catch(() => undefined);
    }
    before.close(error);
  }
}

/**
 * The library in its own worker, drawing into `canvas`. Rejects with an EngineError if it cannot run.
 * @param canvas  null: draw() is not available
 * @param wanted  the renderer, for tests and measurements; null: the faster one, see drawer.ts
 * @param signal  closes the engine, also while it starts
 * @param onReceived  called while the library is being loaded
 */
export async function createEngine(
  canvas: HTMLCanvasElement | null,
  wanted: EngineKind | null = null,
  place: WorkerPlace = { mayUseThreads: true },
  signal: AbortSignal | null = null,
  onReceived?: OnReceived,
): Promise<Engine> {
  if (signal?.aborted) throw kGivenUp;
  const engine = new WorkerEngine(canvas, wanted, place, onReceived);
  signal?.addEventListener("abort", () => engine.close());
  try {
    await engine.start();
  } catch (error) {
    engine.close();
    throw error;
  }
  return Object.assign(
    engine,
    callsBy((name, args) => engine.call(name, args)),
  );
}
