/** The comparison of the page: its two states, its result, and the way back to the file before. */

import type { CityFiles } from "../city/city_files";
import { Download } from "../download";
import { kCancelled, type EngineError, type FileBytes } from "../engine";
import { effect, Observable, untracked } from "../observable";
import { filesOf } from "../reports/files";
import type { Session } from "../session";
import type { Source } from "../session/refining";
import type { Progress } from "../session/messages";
import { keptFile } from "../state/kept_files";
import type { ViewState } from "../state/view_state";
import { number, stageText, t } from "../texts";
import { kWish, type Compared, type Row, type Wish } from "./compared";
import { compareStates } from "./compare_states";
import { fileOf, partsOf, shareOf, withShare } from "./rows";
import { compareStage, compareText } from "./texts";

/** A state of the building. */
export interface State {
  name: string;
  /** Whether it is a model of the site, which links can name. */
  isListed: boolean;
  files: Source;
}

/** The state of the page before the comparison. */
interface Before {
  name: string;
  title: string;
  isLocal: boolean;
  state: ViewState;
  source: Source | null;
  city: CityFiles | null;
  owners: { table: ArrayBuffer; file: string } | null;
}

export class Comparison extends Observable {
  old: State | null = null;
  is: State | null = null;
  wish: Wish = kWish;
  /** null: nothing is in progress. */
  progress: Progress | null = null;
  /** null: nothing has been compared, or another model was opened since. */
  result: Compared | null = null;
  /** The names of the compared states. */
  names = { old: "", is: "" };
  /** A link that names files which are not here. */
  linked: { old: string; new: string } | null = null;
  /** Whether the picture shows both states. */
  isShown = false;
  private before: Before | null = null;
  private abort: AbortController | null = null;
  /** The model to which the result belongs: the volume of the difference, or without one the file that was open. */
  private shown: unknown = null;
  /** The open model when the states were last proposed. */
  private proposed: unknown = null;
  private isOpening = false;

  constructor(private readonly session: Session) {
    super();
    effect(() => {
      if (session.volume.info) untracked(() => this.forget());
    });
  }

  /** The panel opens: the open model is the old state, unless the user has chosen another one since it was opened. */
  begin(): void {
    const { info } = this.session.volume;
    const open = this.proposed === info ? null : this.openState();
    this.proposed = info;
    if (open) this.old = open;
  }

  /** The open model as a state; null: none that can be compared is open. */
  private openState(): State | null {
    const { volume, model } = this.session;
    const { source } = model;
    if (!volume.info || volume.isCity || volume.isServerOnly || volume.compared || !source) return null;
    return { name: volume.name || volume.fileNames.join(", "), isListed: volume.name !== "", files: source };
  }

  /** Ends the result after another model was opened. */
  private forget(): void {
    const { volume } = this.session;
    if (!this.result || this.isOpening || this.shown === (this.isShown ? volume.info : volume.file)) return;
    this.result = this.before = null;
    this.isShown = false;
  }

  /** A model of the site. */
  listed(name: string): State | null {
    const found = this.session.volume.models.find((model) => model.name === name && !model.city);
    if (!found) return null;
    const fileName = found.file.split("/").pop()!.split("?")[0]!;
    const files = async () => [{ name: fileName, bytes: await (await new Download(found.file, found.bytes).blob).arrayBuffer() }];
    return { name, isListed: true, files };
  }

  /** A file of the user, or several models that are one state. */
  static local(files: readonly File[]): State {
    const read = () => Promise.all(files.map(async (file) => ({ name: file.name, bytes: await file.arrayBuffer() })));
    return { name: files.map(({ name }) => name).join(", "), isListed: false, files: read };
  }

  /** Dropped or chosen files: one is the new state of the open model; of two, the older one is the old state. */
  async take(files: readonly File[]): Promise<void> {
    if (files.length === 2) {
      const [first, second] = [...files].sort((a, b) => a.lastModified - b.lastModified);
      this.old = Comparison.local([first!]);
      this.is = Comparison.local([second!]);
    } else if (files.length) {
      this.old = this.openState() ?? this.old;
      if (this.old) this.is = Comparison.local(files);
      else this.old = Comparison.local(files);
    }
    if (files.length && this.old && this.is) await this.run();
  }

  /** The states of a link: models of the site, or files that this browser has stored. */
  async follow(linked: { old: string; new: string }, state: ViewState | null): Promise<void> {
    const found = async (name: string): Promise<State | null> => {
      const listed = this.listed(name);
      const kept = listed ? null : await keptFile(name);
      return listed ?? (kept && Comparison.local([new File([kept], name)]));
    };
    [this.old, this.is] = await Promise.all([found(linked.old), found(linked.new)]);
    if (this.old && this.is) return this.run(state);
    this.linked = linked;
  }

  swap(): void {
    [this.old, this.is] = [this.is, this.old];
  }

  cancel(): void {
    this.abort?.abort();
    this.abort = null;
    this.progress = null;
  }

  /** Compares the two states and shows both. On failure and cancellation, the picture stays. @param state  the view of a link */
  async run(state: ViewState | null = null): Promise<void> {
    const { old, is, session } = this;
    if (!old || !is) return;
    this.cancel();
    this.linked = null;
    const abort = (this.abort = new AbortController());
    const isOver = () => this.abort !== abort;
    const names = { old: old.name, is: is.name };
    this.progress = { text: compareText("compareWorking", { old: names.old, new: names.is }), share: -1 };
    session.messages.message = null;
    session.messages.say(this.progress.text);
    try {
      const states: [FileBytes[], FileBytes[]] = [await filesOf(old.files, old.name), await filesOf(is.files, is.name)];
      if (isOver()) return;
      const tell = (step: string, share: number) => {
        if (!isOver()) this.progress = { text: compareStage(step) ?? stageText(step), share };
      };
      const compared = await compareStates(states, { ...this.wish, memory: session.model.memory }, tell, abort.signal);
      if (isOver()) return;
      await this.show(compared, old, is, state);
      if (isOver()) return;
      const text = compared.summary.different ? "compareDone" : "compareEqual";
      session.messages.say(compareText(text, { n: number(compared.order.length, 0), old: names.old, new: names.is }));
    } catch (error) {
      if (!isOver() && (error as EngineError).code !== kCancelled) session.messages.fail(error, compareText("compareFailed"));
    } finally {
      if (!isOver()) {
        this.abort = null;
        this.progress = null;
      }
    }
  }

  private async show(compared: Compared, old: State, is: State, state: ViewState | null): Promise<void> {
    const { model, volume, view } = this.session;
    const { volume: bytes } = compared;
    const names = { old: old.name, is: is.name };
    if (!bytes) {
      // The difference of two other states must not stay behind this list.
      if (this.isShown && this.before) await this.back();
      this.names = names;
      this.result = compared;
      this.isShown = false;
      this.shown = volume.file;
      return;
    }
    const before = this.isShown ? this.before : this.present();
    const name = fileOf(old.name, is.name);
    const source = async () => [{ name, bytes: await bytes.arrayBuffer() }];
    // If this fails, the model before stays, and a message gives the reason.
    this.isOpening = true;
    const isOpen = await model.open(name, source, source, state).finally(() => (this.isOpening = false));
    if (!isOpen) return;
    volume.name = "";
    volume.isLocal = !(old.isListed && is.isListed);
    volume.compared = { old: old.name, new: is.name };
    view.before = before && { text: compareText("compareBackTo"), act: () => void this.back() };
    this.before = before;
    this.names = names;
    this.result = compared;
    this.isShown = true;
    this.shown = volume.info;
  }

  /** The name of the file before; null: nothing was open. */
  get backTo(): string | null {
    return this.before?.title ?? null;
  }

  private present(): Before | null {
    const { model, volume, view } = this.session;
    const { source, city, owners } = model;
    if (!volume.info || (!source && !city)) return null;
    return {
      name: volume.name,
      title: volume.name || volume.fileNames.join(", "),
      isLocal: volume.isLocal,
      state: view.state,
      source,
      city: city?.files ?? null,
      owners: owners.table && { table: owners.table, file: owners.file },
    };
  }

  /** Opens the file before with its view; the panel keeps the two states. */
  async back(): Promise<void> {
    const { before, session } = this;
    if (!before) return;
    const { model, volume } = session;
    this.cancel();
    const { title, source, city, state } = before;
    const isOpen = city ? await model.openCity(title, city, state) : await model.open(title, () => source!(), source!, state);
    if (!isOpen) return;
    volume.name = before.name;
    volume.isLocal = before.isLocal;
    this.result = this.before = null;
    this.isShown = false;
    if (before.owners) await model.owners.give(before.owners.table, before.owners.file).catch(() => undefined);
    session.messages.tell(t("undone", { what: compareText("compareBackTo") }));
  }

  /** The shown state: 0 is the old one, 1 the new one. */
  get share(): number {
    const { view, volume } = this.session;
    return shareOf(view.now.styles, volume.index);
  }
  setShare(share: number): void {
    const { view, volume } = this.session;
    view.set({ styles: withShare(view.state.styles, share, volume.index) });
  }

  /** Selects the object of a row, in the shown state or in both, and flies there. */
  async goTo(row: Row): Promise<void> {
    const { view, volume, selection, messages } = this.session;
    const ids = partsOf(row, volume.index);
    if (!ids.length) return messages.tell(compareText("rowNotHere"));
    const isGone = this.isShown && ((row.change === "removed" && this.share === 1) || (row.change === "added" && this.share === 0));
    if (isGone) this.setShare(0.5);
    selection.select(ids);
    if (view.isSelectionHidden) view.hideSelected(false);
    await view.goToSelected();
  }
}

const comparisons = new WeakMap<Session, Comparison>();
/** The one comparison of a session, also after its panel was closed. */
export function comparisonOf(session: Session): Comparison {
  const known = comparisons.get(session) ?? new Comparison(session);
  comparisons.set(session, known);
  return known;
}
