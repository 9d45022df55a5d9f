/**
 * Draws the open volume with the CPU caster or with WebGL2. Both give the same picture. A trial finds the faster one,
 * when the page has been idle for a moment after its first picture. It draws the last scene at a small size, twice with
 * WebGL2, because the first time compiles the shaders, and once with the CPU. The trial compares the later times. If
 * WebGL2 runs in software, which is slower (see web/wasm/README.md) and compiles shaders for seconds, there is no
 * trial.
 */
import type { SvtModule } from "../../../../build/web/svt.js";
import type { EngineError, EngineKind, Scene } from "../engine";
import { hasWords } from "./calls";
import { isEngineError } from "./errors";
import type { Drawn } from "./protocol";

/** Names of drivers without a graphics card. */
const softwareNames = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/** Maximum width of a trial in pixels. */
const trialWidth = 320;

interface Last {
  scene: Scene;
  width: number;
  height: number;
}

export class Drawer {
  kind: EngineKind = "cpu";
  private gl: WebGL2RenderingContext | null = null;
  private canvas: OffscreenCanvas | null = null;
  private last: Last | null = null;
  private font: Uint8Array | null = null;
  private hasFont = false;

  /** @param wanted  use only this renderer, if possible; null: the faster one */
  constructor(
    private svt: SvtModule,
    private readonly wanted: EngineKind | null,
  ) {
    if (wanted === "webgl2" && this.startGl()) this.kind = "webgl2";
  }

  /** Whether there is work to do while the page is idle. */
  get isWaiting(): boolean {
    return this.draft !== null || this.isTrialDue;
  }
  private get isTrialDue(): boolean {
    return this.wanted === null && !this.isDecided && this.last !== null;
  }
  private isDecided = false;
  /** The first picture of the volume; the data for a moving picture of its size is not prepared yet. */
  private draft: Last | null = null;

  async draw(scene: Scene, width: number, height: number): Promise<Drawn> {
    await this.prepare(scene);
    const byGl = this.kind === "webgl2" ? this.drawGl(scene, width, height) : null;
    // The first picture of a volume should appear quickly; data for later ones is prepared after it.
    const isDraft = this.last === null;
    this.last = { scene, width, height };
    if (isDraft && !byGl) this.draft = this.last;
    return byGl ?? (await this.drawCpu(scene, width, height, isDraft));
  }

  /** The font is fetched when words are first drawn. */
  private async prepare(scene: Scene): Promise<void> {
    if (hasWords(scene)) await this.fetchFont();
  }

  async fetchFont(): Promise<void> {
    if (this.hasFont) return;
    this.svt.call("font", [], await this.fontBytes());
    this.hasFont = true;
  }

  /** Fetches the font once. */
  async fontBytes(): Promise<Uint8Array> {
    if (this.font) return this.font;
    try {
      const response = await fetch(new URL("../../../../build/web/DejaVuSans.ttf", import.meta.url));
      if (!response.ok) throw new Error(String(response.status));
      return (this.font = new Uint8Array(await response.arrayBuffer()));
    } catch (error) {
      const message = `the font of names cannot be loaded (${(error as Error).message}); check the connection and try again`;
      throw { code: "E101", message } satisfies EngineError;
    }
  }

  /** Takes another module, with the same volume, and draws its last picture there, for picking. */
  async moveTo(svt: SvtModule): Promise<void> {
    this.stopGl();
    this.svt = svt;
    this.hasFont = false;
    this.isDecided = false;
    if (this.wanted === "webgl2" && this.startGl()) this.kind = "webgl2";
    const { last } = this;
    if (!last) return;
    try {
      (await this.draw(last.scene, last.width, last.height)).bitmap.close();
    } catch (error) {
      if (!isEngineError(error)) throw error; // the next picture reports it
    }
  }

  /** Called when another volume is opened. */
  forgetPicture(): void {
    this.last = null;
    this.draft = null;
  }

  /** Called when the page is idle: chooses the renderer, and prepares the data for the first movement. */
  onIdle(): void {
    if (this.isTrialDue) this.decide();
    const draft = this.draft;
    this.draft = null;
    if (draft && this.kind === "cpu") this.drawUnseen({ ...draft.scene, size: [draft.width, draft.height] });
  }

  private decide(): void {
    this.isDecided = true;
    if (this.last && this.startGl() && !this.isSoftware() && this.isGlFaster(this.last)) this.kind = "webgl2";
    else this.stopGl();
  }

  /** Draws the label image of a picture as a file, without affecting picking. */
  private drawUnseen(scene: Scene): void {
    try {
      this.svt.call("labels", [scene]);
    } catch (error) {
      if (!isEngineError(error)) throw error; // other errors are reported when such a picture is requested
    }
  }

  private isSoftware(): boolean {
    const info = this.gl?.getExtension("WEBGL_debug_renderer_info");
    return info ? softwareNames.test(String(this.gl?.getParameter(info.UNMASKED_RENDERER_WEBGL))) : false;
  }

  private isGlFaster({ scene, width, height }: Last): boolean {
    const scale = Math.min(1, trialWidth / width);
    const size: [number, number] = [Math.max(1, Math.round(width * scale)), Math.max(1, Math.round(height * scale))];
    const small: Scene = { ...scene, surfaces: "voxels", samples: 1, size };
    if (!this.drawGl(small, ...size, true)) return false;
    const byGl = this.drawGl(small, ...size, true);
    const start = performance.now();
    this.drawUnseen(small);
    return byGl !== null && byGl.report.milliseconds < performance.now() - start;
  }

  private startGl(): boolean {
    const canvas = new OffscreenCanvas(1, 1);
    if (!this.svt.startGl(canvas)) return false;
    this.canvas = canvas;
    this.gl = canvas.getContext("webgl2");
    canvas.addEventListener("webglcontextlost", () => this.stopGl());
    return this.gl !== null;
  }

  private stopGl(): void {
    if (!this.gl) return;
    this.kind = "cpu";
    const loss = this.gl.isContextLost() ? null : this.gl.getExtension("WEBGL_lose_context");
    this.gl = this.canvas = null;
    this.svt.call("dropGl", []);
    loss?.loseContext();
  }

  private async drawCpu(scene: Scene, width: number, height: number, isDraft: boolean): Promise<Drawn> {
    const start = performance.now();
    const pixels = new Uint8ClampedArray(this.svt.call("draw", [scene, width, height, isDraft]));
    const bitmap = await createImageBitmap(new ImageData(pixels, width, height));
    return { bitmap, report: { width, height, milliseconds: performance.now() - start, engine: "cpu" } };
  }

  /** Null if the CPU must draw: for a scene that WebGL2 does not support, or after context loss. */
  private drawGl(scene: Scene, width: number, height: number, isTrial = false): Drawn | null {
    if (!this.gl || !this.canvas) return null;
    const start = performance.now();
    try {
      if (this.canvas.width !== width) this.canvas.width = width;
      if (this.canvas.height !== height) this.canvas.height = height;
      this.svt.call("drawGl", [scene, width, height, isTrial]);
    } catch (error) {
      if (!isEngineError(error)) throw error;
      return null;
    }
    // Reading back waits for the GPU, so that the time includes drawing.
    const pixel = new Uint8Array(4);
    this.gl.readPixels(0, 0, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, pixel);
    if (this.gl.isContextLost()) {
      this.stopGl();
      return null;
    }
    const bitmap = this.canvas.transferToImageBitmap();
    return { bitmap, report: { width, height, milliseconds: performance.now() - start, engine: "webgl2" } };
  }
}
