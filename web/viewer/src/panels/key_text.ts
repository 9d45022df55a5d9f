/** Names of keys in the language of the page. */

import { language } from "../texts";

const kGerman: Record<string, string> = { ctrl: "Strg", shift: "Umschalt" };
const kEnglish: Record<string, string> = { ctrl: "Ctrl", shift: "Shift" };

/** `Ctrl Z` for `ctrl+z`. */
export function keyText(key: string): string {
  const names = language() === "de" ? kGerman : kEnglish;
  return key
    .split("+")
    .map((part) => names[part] ?? part.toUpperCase())
    .join(" ");
}
