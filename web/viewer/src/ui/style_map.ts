/**
 * Lit's `styleMap` for pages with a strict content security policy: the original writes a `style` attribute on first
 * render, which such a policy forbids; this one always sets the properties. vite.config.ts substitutes it.
 */

import { noChange } from "lit";
import { Directive, directive, type AttributePart } from "lit/directive.js";

export type StyleInfo = Readonly<Record<string, string | number | undefined | null>>;

class StyleMapDirective extends Directive {
  private before = new Set<string>();

  override render(_: StyleInfo) {
    return noChange;
  }

  override update(part: AttributePart, [info]: [StyleInfo]) {
    const { style } = part.element as HTMLElement;
    for (const name of this.before) if (info[name] == null) set(style, name, "");
    for (const [name, value] of Object.entries(info)) if (value != null) set(style, name, String(value));
    this.before = new Set(Object.keys(info));
    return noChange;
  }
}

function set(style: CSSStyleDeclaration, name: string, value: string): void {
  const isImportant = value.endsWith(" !important");
  if (name.includes("-") || isImportant) style.setProperty(name, isImportant ? value.slice(0, -11) : value, isImportant ? "important" : "");
  else (style as unknown as Record<string, string>)[name] = value;
}

export const styleMap = directive(StyleMapDirective);
