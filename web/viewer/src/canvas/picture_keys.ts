/** Keys for the picture, from parts over it. */

/** Acts as if a key were pressed, or released, on the picture beside an element. */
export function pressOnPicture(beside: HTMLElement, kind: "keydown" | "keyup", key: string): void {
  const picture = beside.parentElement?.querySelector("svt-picture");
  picture?.shadowRoot?.querySelector("[data-picture]")?.dispatchEvent(new KeyboardEvent(kind, { key }));
}
