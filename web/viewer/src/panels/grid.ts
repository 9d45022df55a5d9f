/** Styles, sizes and steps of the keyboard that the tables of objects and of quantities share. */

import { css, unsafeCSS } from "lit";

export const kGridRow = matchMedia("(max-width: 759px), (pointer: coarse)").matches ? 44 : 28;
/** Rows in the page above and below those that are visible. */
const kSpare = 8;

/** The rows in the page, out of `n`. */
export function rowsAt(top: number, height: number, n: number): [from: number, to: number] {
  return [Math.max(0, Math.floor(top / kGridRow) - kSpare), Math.min(n, Math.ceil((top + height) / kGridRow) + kSpare)];
}

/** The row that a key leads to; null: the key has another purpose. */
export function rowOfKey(key: string, row: number, n: number, height: number): number | null {
  const page = Math.max(1, Math.floor(height / kGridRow) - 2);
  const steps: Record<string, number> = { ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page, Home: -Infinity, End: Infinity };
  const step = steps[key];
  return step === undefined ? null : Math.min(n - 1, Math.max(0, row + step));
}

/** Scrolls a row into view, below the head and above the foot of the grid. */
export function reveal(scroller: HTMLElement, row: number, foot = 0): void {
  const head = scroller.querySelector<HTMLElement>(".head")!.offsetHeight;
  const top = row * kGridRow;
  if (top < scroller.scrollTop) scroller.scrollTop = top;
  else if (top + kGridRow + head + foot > scroller.scrollTop + scroller.clientHeight)
    scroller.scrollTop = top + kGridRow + head + foot - scroller.clientHeight;
}

/** Places the lines that are in the page, which has no styles in attributes. */
export function placeLines(root: ParentNode): void {
  root.querySelectorAll<HTMLElement>("[data-top]").forEach((e) => (e.style.transform = `translateY(${e.dataset["top"]}px)`));
  root.querySelectorAll<HTMLElement>("[data-height]").forEach((e) => (e.style.height = `${e.dataset["height"]}px`));
}

export const gridStyles = css`
  .scroll { overflow: auto; min-height: 0; outline-offset: -2px !important; overscroll-behavior: contain; position: relative; }
  .head { position: sticky; top: 0; z-index: 1; display: flex; background: var(--panel); border-bottom: 1px solid var(--line-strong); width: max-content; min-width: 100%; }
  .space { position: relative; width: max-content; min-width: 100%; }
  .line { position: absolute; left: 0; right: 0; display: flex; height: ${unsafeCSS(`${kGridRow}px`)}; align-items: center; cursor: default; }
  .line:hover { background: var(--hover); }
  .line[aria-selected="true"] { background: var(--accent-soft); color: var(--accent-text); }
  .scroll:focus-visible .line.active { box-shadow: inset 0 0 0 2px var(--focus); }
  [role="gridcell"], [role="columnheader"] { width: var(--cell); flex: none; padding: 0 8px; overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
  [role="columnheader"] { display: flex; padding: 0; align-items: center; }
  [role="columnheader"] button { border-color: transparent; background: transparent; min-width: 28px; padding: 4px 8px; }
  [role="columnheader"] .sort { flex: 1; justify-content: flex-start; font-weight: 600; overflow: hidden; }
  .sort span { overflow: hidden; text-overflow: ellipsis; }
  .number { text-align: right; font-variant-numeric: tabular-nums; }
`;
