/**
 * Large models: a coarse volume is the first picture; a finer one is made in a second worker meanwhile, and takes its place
 * at the end. Whoever stops that, or has no memory for it, keeps the coarse one and is told.
 */

import { kCancelled } from "./engine";
import type { EngineError, FileBytes } from "./engine";
import type { Session } from "./session";
import { number, stageText, t } from "./texts";

/** Fetches the files of a model again. */
export type Source = () => Promise<FileBytes[]>;

/** Smaller models are built finely about as soon as coarsely. */
const kLargeBytes = 8e6;
/** What gzip makes of models, about. */
const kPacked = 10;

export function wantsDraft(files: FileBytes[]): boolean {
  if (files.some(({ name }) => /\.svt$/i.test(name))) return false;
  const bytes = files.reduce((sum, { name, bytes }) => sum + bytes.byteLength * (/\.(gz|ifczip)$/i.test(name) ? kPacked : 1), 0);
  return bytes >= kLargeBytes;
}

/** `?memory=MB` or else a quarter of the device's memory, at most 1 GB: what a volume may take that is built here. */
export function memoryOfPage(): number {
  const asked = Number(new URLSearchParams(location.search).get("memory"));
  if (asked > 0) return Math.max(16, asked) * 1e6;
  const device = (navigator as { deviceMemory?: number }).deviceMemory ?? 4;
  return Math.min(1e9, device * 0.25e9);
}

export class Refining {
  /** null: nothing is being made finer. */
  progress: { text: string; share: number } | null = null;
  private source: Source | null = null;
  private memory = 0;
  private token = {};

  constructor(private readonly session: Session) {}

  /** What is open is a draft, and stays so unless it is begun again. */
  get isCoarse(): boolean {
    return this.source !== null;
  }

  /** Samples are so far apart, metres. */
  get spacing(): number {
    return this.session.info?.spacing[0] ?? 0;
  }

  begin(source: Source, memory: number): void {
    this.source = source;
    this.memory = memory;
    void this.run();
  }

  again(): void {
    if (this.source && !this.progress) void this.run();
  }

  /** Ends it, as another model is opened. */
  cancel(): void {
    this.source = this.progress = null;
    this.token = {};
    this.session.engine?.cancelRefining();
  }

  /** Keeps the coarse volume. */
  stop(): void {
    if (!this.progress) return;
    this.progress = null;
    this.token = {};
    this.session.engine?.cancelRefining();
    this.session.tell(t("staysCoarse", { spacing: number(this.spacing, 2) }));
  }

  private async run(): Promise<void> {
    const { session, source } = this;
    const token = (this.token = {});
    this.tell(t("makingFiner"), -1);
    try {
      await this.firstPicture();
      const files = await source!();
      if (this.token !== token) return;
      const info = await session.engine!.refine(files, (step, share) => this.token === token && this.tell(stageText(step), share), {
        memory: this.memory,
      });
      if (this.token !== token) return;
      this.source = this.progress = null;
      session.takeFiner(info, this.memory);
      await session.owners.giveAgain();
      session.say(t("isFiner", { spacing: number(this.spacing, 2) }));
    } catch (error) {
      if (this.token !== token) return;
      this.progress = null;
      const { code, message } = error as EngineError;
      if (code !== kCancelled) session.tell(`${t("staysCoarse", { spacing: number(this.spacing, 2) })} ${message ?? String(error)}`);
      session.changed();
    }
  }

  private tell(text: string, share: number): void {
    this.progress = { text, share };
    this.session.changed();
  }

  /** The draft is seen first: both at once would take each other's time. */
  private firstPicture(): Promise<void> {
    const { session } = this;
    return new Promise((resolve) => {
      const look = () => {
        if (!session.report) return;
        session.removeEventListener("change", look);
        resolve();
      };
      session.addEventListener("change", look);
      look();
    });
  }
}
