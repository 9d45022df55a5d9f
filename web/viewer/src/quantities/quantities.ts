/** The quantities of the open model: measured in a worker, which keeps the model until the panel closes. */

import { kCancelled, type EngineError } from "../engine";
import { effect, Observable, untracked } from "../observable";
import { filesOf } from "../reports/files";
import { ReportsModule } from "../reports/reports_module";
import type { Session } from "../session";
import type { Progress } from "../session/messages";
import { isFatal } from "../session/model";
import type { Source } from "../session/refining";
import { number, stageText } from "../texts";
import { save } from "../ui/files";
import { fileOf, keysOf, kWish, type ModelReport, type Sums, type TakeOff, type Wish } from "./take_off";
import { quantityStage, quantityText, type QuantityTextKey } from "./texts";

export class Quantities extends Observable {
  wish: Wish = kWish;
  /** Keys of the sums, the most important one first. */
  keys: readonly string[] = [];
  /** null: nothing is in progress. */
  progress: Progress | null = null;
  /** null: no model is read. */
  model: ModelReport | null = null;
  /** null: nothing is measured. */
  result: TakeOff | null = null;
  /** The sums by `keys`; null: there are none. */
  sums: Sums | null = null;
  /** The user has stopped the work. */
  isStopped = false;
  /** The panel is open. */
  private isOpen = false;
  /** The read model. */
  private source: Source | null = null;
  private reports: { module: ReportsModule; abort: AbortController } | null = null;
  /** Marks the latest work; results of earlier work are dropped. */
  private token = {};

  constructor(private readonly session: Session) {
    super();
    // Another model has been opened. A finer volume of the same model measures the same.
    effect(() => {
      if (session.volume.info) untracked(() => this.isOpen && session.model.source !== this.source && this.begin());
    });
  }

  /** Why the open model cannot be measured; null: it can. */
  get obstacle(): QuantityTextKey | null {
    const { volume, model } = this.session;
    if (!volume.info) return "quantitiesNone";
    if (volume.isCity) return "quantitiesCity";
    if (volume.compared) return "quantitiesCompared";
    return model.source ? null : "quantitiesLost";
  }

  /** The panel opens, or shows another model. */
  begin(): void {
    this.end();
    this.isOpen = true;
    const possible = keysOf(this.session.volume.info?.attributes ?? []);
    this.keys = this.keys.filter((key) => possible.includes(key));
    void this.run();
  }

  /** Ends the worker with its model. */
  end(): void {
    this.isOpen = this.isStopped = false;
    this.forget();
  }

  private forget(): void {
    this.reports?.abort.abort();
    this.reports = this.source = this.progress = this.model = this.result = this.sums = null;
    this.token = {};
  }

  cancel(): void {
    this.forget();
    this.isStopped = true;
  }

  get name(): string {
    const { name, fileNames } = this.session.volume;
    return name || fileNames.join(", ");
  }

  /** Measures the open model, which is read first unless it is read already. On failure, the last figures stay. */
  async run(): Promise<void> {
    const { model, messages } = this.session;
    const { source } = model;
    if (this.obstacle || !source) return;
    this.isStopped = false;
    if (this.source !== source) this.forget();
    this.source = source;
    const token = (this.token = {});
    const isOver = () => this.token !== token;
    this.progress = { text: quantityText("quantitiesReading", { name: this.name }), share: -1 };
    messages.message = null;
    messages.say(this.progress.text);
    try {
      if (!this.reports) {
        const files = await filesOf(source, this.name);
        if (isOver()) return;
        const abort = new AbortController();
        const module = new ReportsModule((step, share) => this.tell(step, share), abort.signal);
        this.reports = { module, abort };
        const sizes = files.map(({ bytes }) => bytes.byteLength);
        const report = await module.json<ModelReport>("readModel", [files.map(({ name }) => name), sizes, { memory: model.memory }], files);
        if (isOver()) return;
        this.model = report;
      }
      const { module } = this.reports;
      const result = await module.json<TakeOff>("measure", [this.wish]);
      if (isOver()) return;
      this.result = result;
      await this.add(module, this.keys);
      if (!isOver()) messages.say(quantityText("quantitiesDone", { n: number(result.rows.length, 0) }));
    } catch (error) {
      this.failed(error as EngineError, isOver());
    } finally {
      if (!isOver()) this.progress = null;
    }
  }

  private tell(step: string, share: number): void {
    const own = quantityStage(step);
    this.progress = { text: own ?? stageText(step), share: own ? -1 : share };
  }

  private failed(error: EngineError, isOver: boolean): void {
    if (isOver || error.code === kCancelled) return;
    // Without a read model, the next attempt begins anew.
    if (!this.model || isFatal(error)) this.forget();
    this.session.messages.fail(error, quantityText("quantitiesFailed"));
  }

  /** Sums by other keys; the figures stay. */
  async setKeys(keys: readonly string[]): Promise<void> {
    this.keys = keys;
    if (!this.reports || !this.result) return;
    try {
      await this.add(this.reports.module, keys);
    } catch (error) {
      this.failed(error as EngineError, false);
    }
  }

  private async add(module: ReportsModule, keys: readonly string[]): Promise<void> {
    const sums = keys.length ? await module.json<Sums>("sums", [keys.join(",")]) : null;
    // Other keys may have been chosen meanwhile.
    if (this.keys === keys) this.sums = sums;
  }

  /** Saves a file as `svt quantities` writes it. @param table  rows or sums; JSON has both */
  async save(ending: "csv" | "json", table: "quantities" | "sums"): Promise<void> {
    if (!this.reports || !this.result) return;
    const { name } = this;
    const keys = ending === "csv" && table === "quantities" ? "" : this.keys.join(",");
    try {
      save(await this.reports.module.call(ending === "csv" ? "quantitiesCsv" : "quantitiesJson", [keys]), fileOf(name, table, ending));
    } catch (error) {
      this.failed(error as EngineError, false);
    }
  }

  /** Selects objects in the picture. */
  select(ids: readonly string[], isAdded: boolean): void {
    const { volume, selection, messages } = this.session;
    const here = ids.filter((id) => volume.index.byId.has(id));
    if (!here.length && ids.length) return messages.tell(quantityText("quantitiesNotHere"));
    selection.select(here, isAdded);
  }
}

const known = new WeakMap<Session, Quantities>();
/** The one take-off of a session, which keeps its options after the panel was closed. */
export function quantitiesOf(session: Session): Quantities {
  const quantities = known.get(session) ?? new Quantities(session);
  known.set(session, quantities);
  return quantities;
}
