/** Arrow keys within toolbars and groups of choices, as for native ones. */

const kGroups = "[role=radiogroup], [role=toolbar]";

/** True if the key moved the focus. A choice that gets the focus is chosen. */
export function movedByArrow(event: KeyboardEvent): boolean {
  const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
  const ends = { Home: 0, End: -1 }[event.key];
  if ((step === undefined && ends === undefined) || event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return false;
  const from = event.composedPath()[0] as HTMLElement;
  const group = from.closest?.(kGroups);
  if (!group || from.matches("input:not([type=checkbox]), select, textarea")) return false;
  const items = [
    ...group.querySelectorAll<HTMLElement>("button:not([disabled]), [role=radio], input[type=checkbox]:not([disabled])"),
  ].filter((item, n, all) => all.indexOf(item) === n);
  const at = items.indexOf(from);
  if (at < 0 || items.length < 2) return false;
  const next = items[step === undefined ? (ends! + items.length) % items.length : (at + step + items.length) % items.length]!;
  next.focus();
  if (group.getAttribute("role") === "radiogroup") next.click();
  return true;
}
