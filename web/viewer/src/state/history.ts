/** Undo and redo of the view. States never change, so a step is two references. */

import { Observable } from "../observable";
import type { ViewState } from "./view_state";

/** The members of the view that a step changed, for its name. */
export type Changed = (keyof ViewState)[];

interface Step {
  before: ViewState;
  after: ViewState;
  changed: Changed;
  /** Milliseconds; changes of the same members that follow soon belong to the same step: a drag, a slider. */
  at: number;
}

const kSameStep = 800;
const kMaxSteps = 200;
/** Members without steps: the selection is not drawn, and the preset only gives the first camera. */
const kUncounted = new Set<keyof ViewState>(["selection", "selectedBy", "preset"]);

export class History extends Observable {
  private done: readonly Step[] = [];
  private undone: readonly Step[] = [];
  private isSealed = true;

  /** @param now  milliseconds, on any clock that only grows */
  record(before: ViewState, after: ViewState, now: number): void {
    const isCounted = (key: keyof ViewState) => !kUncounted.has(key) && !(key === "camera" && before.camera === null);
    const changed = (Object.keys(after) as Changed).filter((key) => before[key] !== after[key] && isCounted(key));
    if (!changed.length || isHovering(before, after, changed)) return;
    const last = this.done.at(-1);
    if (this.undone.length) this.undone = [];
    if (last && !this.isSealed && now - last.at < kSameStep && last.changed.join() === changed.join()) {
      last.after = after;
      last.at = now;
      return;
    }
    this.isSealed = false;
    this.done = [...this.done, { before, after, changed, at: now }].slice(-kMaxSteps);
  }

  /** The next change begins a new step. */
  seal(): void {
    this.isSealed = true;
  }

  /** Applies a change to all views of all steps. */
  change(of: (state: ViewState) => ViewState): void {
    for (const step of [...this.done, ...this.undone]) {
      step.before = of(step.before);
      step.after = of(step.after);
    }
  }

  /**
   * Drops the last step that led to a view that cannot be drawn.
   * @return the values before that step; an empty object if no step matches
   */
  refuse(state: ViewState): Partial<ViewState> {
    for (let n = this.done.length - 1; n >= 0; --n) {
      const { before, after, changed } = this.done[n]!;
      if (changed.every((key) => key === "camera") || !changed.every((key) => after[key] === state[key])) continue;
      this.done = this.done.filter((_, other) => other !== n);
      return Object.fromEntries(changed.filter((key) => key !== "camera").map((key) => [key, before[key]]));
    }
    return {};
  }

  clear(): void {
    this.done = [];
    this.undone = [];
    this.isSealed = true;
  }

  /** The changes that undo() would revert and redo() would repeat; null: nothing. */
  get last(): Changed | null {
    return this.done.at(-1)?.changed ?? null;
  }
  get next(): Changed | null {
    return this.undone.at(-1)?.changed ?? null;
  }

  /** The view before the last step, keeping the current values of members without steps; null without a step. */
  undo(now: ViewState): ViewState | null {
    const step = this.done.at(-1);
    if (!step) return null;
    this.done = this.done.slice(0, -1);
    this.undone = [...this.undone, step];
    this.isSealed = true;
    return restoredTo(step.before, step.changed, now);
  }

  redo(now: ViewState): ViewState | null {
    const step = this.undone.at(-1);
    if (!step) return null;
    this.undone = this.undone.slice(0, -1);
    this.done = [...this.done, step];
    this.isSealed = true;
    return restoredTo(step.after, step.changed, now);
  }
}

/** Restores only the changes of the step: a lens that followed the mouse meanwhile keeps its place. */
function restoredTo(state: ViewState, changed: Changed, now: ViewState): ViewState {
  return { ...now, ...Object.fromEntries(changed.map((key) => [key, state[key]])) };
}

/** A lens that follows the mouse: each movement would be a step. */
function isHovering(before: ViewState, after: ViewState, changed: Changed): boolean {
  return (
    changed.length === 1 && changed[0] === "lens" && !before.lens.pinned && !after.lens.pinned && before.lens.radius === after.lens.radius
  );
}
