/** A part asks the page for the context menu of the selection. */

export interface MenuPlace {
  /** Position in the window, pixels. */
  x: number;
  y: number;
  /** The point in the picture, as fractions of its size. Absent: not in the picture. */
  inPicture?: [x: number, y: number];
}
export type MenuRequest = CustomEvent<MenuPlace>;

export function askForMenu(from: HTMLElement, detail: MenuPlace): void {
  from.dispatchEvent(new CustomEvent("svt-menu", { detail, bubbles: true, composed: true }));
}

/** Whether a key opens context menus. */
export function isMenuKey({ key, shiftKey }: KeyboardEvent): boolean {
  return key === "ContextMenu" || (key === "F10" && shiftKey);
}
