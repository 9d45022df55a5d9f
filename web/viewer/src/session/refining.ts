/**
 * Large models: a coarse volume is the first picture. Meanwhile a second worker builds a finer one, which replaces the
 * coarse one at the end. If the user stops that, or the memory is not sufficient, the coarse one stays, with a message.
 */

import { kCancelled } from "../engine";
import type { EngineError, FileBytes, VolumeInfo } from "../engine";
import { Observable } from "../observable";
import { number, stageText, t } from "../texts";
import type { Messages, Progress } from "./messages";
import type { OpenVolume } from "./open_volume";

/** Fetches the files of a model again. */
export type Source = () => Promise<FileBytes[]>;

/** The fine volume of a smaller model takes about as long as its draft. */
const kLargeBytes = 8e6;
/** Approximate ratio by which gzip compresses models. */
const kPacked = 10;

export function wantsDraft(files: FileBytes[]): boolean {
  if (files.some(({ name }) => /\.svt$/i.test(name))) return false;
  const bytes = files.reduce((sum, { name, bytes }) => sum + bytes.byteLength * (/\.(gz|ifczip)$/i.test(name) ? kPacked : 1), 0);
  return bytes >= kLargeBytes;
}

/** A quarter of the device's memory, at most 1 GB, in bytes. */
export function memoryOfDevice(): number {
  const device = (navigator as { deviceMemory?: number }).deviceMemory ?? 4;
  return Math.min(1e9, device * 0.25e9);
}

export interface RefiningHost {
  /** Resolves when the page shows the coarse volume. Before, the second worker would slow down that picture. */
  firstPicture(): Promise<void>;
  /** The finer volume has replaced the coarse one. */
  take(info: VolumeInfo, memory: number): Promise<void>;
}

export class Refining extends Observable {
  /** null: no refinement is in progress. */
  progress: Progress | null = null;
  /** null: the open volume is fine, or no finer one is possible. */
  private wanted: { source: Source; memory: number } | null = null;
  private token = {};

  constructor(
    private readonly volume: OpenVolume,
    private readonly messages: Messages,
    private readonly host: RefiningHost,
  ) {
    super();
  }

  /** The open volume is a draft. */
  get isCoarse(): boolean {
    return this.wanted !== null;
  }

  /** Distance between samples, metres. */
  get spacing(): number {
    return this.volume.info?.spacing[0] ?? 0;
  }

  begin(source: Source, memory: number): void {
    this.wanted = { source, memory };
    void this.run(source, memory);
  }

  again(): void {
    if (this.wanted && !this.progress) this.begin(this.wanted.source, this.wanted.memory);
  }

  /** Ends the refinement when another model is opened. */
  cancel(): void {
    this.wanted = null;
    this.end();
  }

  /** Keeps the coarse volume. */
  stop(): void {
    if (!this.progress) return;
    this.end();
    this.messages.tell(this.staysCoarse());
  }

  private end(): void {
    this.progress = null;
    this.token = {};
    this.volume.engine?.cancelRefining();
  }

  private staysCoarse(): string {
    return t("staysCoarse", { spacing: number(this.spacing, 2) });
  }

  private async run(source: Source, memory: number): Promise<void> {
    const token = (this.token = {});
    const isOver = () => this.token !== token;
    this.progress = { text: t("makingFiner"), share: -1 };
    try {
      await this.host.firstPicture();
      const files = await source();
      if (isOver()) return;
      const tell = (step: string, share: number) => {
        if (!isOver()) this.progress = { text: stageText(step), share };
      };
      const info = await this.volume.engine!.refine(files, tell, { memory });
      if (isOver()) return;
      this.wanted = this.progress = null;
      await this.host.take(info, memory);
      this.messages.say(t("isFiner", { spacing: number(this.spacing, 2) }));
    } catch (error) {
      if (isOver()) return;
      this.progress = null;
      const { code, message } = error as EngineError;
      if (code !== kCancelled) this.messages.tell(`${this.staysCoarse()} ${message ?? String(error)}`);
    }
  }
}
