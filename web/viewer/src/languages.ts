/**
 * Languages besides English and German, from files next to the page: `languages/index.json` lists them
 * (`{"languages": [{"code": "fr", "name": "Français"}]}`), `languages/fr.json` has the texts
 * (`{"texts": {"addPlane": "..."}, "classes": {"Window": "fenêtre"}}`). An invalid file has no effect.
 */

import { Observable } from "./observable";
import type { Messages } from "./session/messages";
import { browserLanguage, language, setLanguage, t, type Language, type LanguageTexts } from "./texts";

export interface ListedLanguage {
  code: string;
  name: string;
}

const kBuiltIn: ListedLanguage[] = [
  { code: "en", name: "English" },
  { code: "de", name: "Deutsch" },
];

/** Whether a code is a language tag, such as `fr`: it becomes part of an address. */
function isTag(code: unknown): code is string {
  try {
    return typeof code === "string" && /^[A-Za-z]{2,8}(-[A-Za-z0-9]{2,8})*$/.test(code) && Intl.getCanonicalLocales(code).length === 1;
  } catch {
    return false;
  }
}

async function fetched(file: string): Promise<unknown> {
  try {
    const response = await fetch(`languages/${file}.json`);
    return response.ok ? await response.json() : null;
  } catch {
    return null;
  }
}

async function moreLanguages(): Promise<ListedLanguage[]> {
  const { languages } = ((await fetched("index")) ?? {}) as { languages?: unknown };
  if (!Array.isArray(languages)) return [];
  return languages.filter(
    (l): l is ListedLanguage => isTag(l?.code) && typeof l.name === "string" && !kBuiltIn.some(({ code }) => code === l.code),
  );
}

/** The texts of a language; null if the file is invalid. */
async function textsOf(code: string): Promise<LanguageTexts | null> {
  const { texts, classes } = ((await fetched(code)) ?? {}) as { texts?: unknown; classes?: unknown };
  if (typeof texts !== "object" || texts === null) return null;
  return { texts: strings(texts), ...(typeof classes === "object" && classes !== null ? { classes: strings(classes) } : {}) };
}

function strings(of: object): Record<string, string> {
  return Object.fromEntries(Object.entries(of).filter((entry): entry is [string, string] => typeof entry[1] === "string"));
}

/** The first available language that the browser prefers, or null. */
function wantedOf(all: ListedLanguage[]): string | null {
  for (const tag of navigator.languages ?? [navigator.language]) {
    const found =
      all.find(({ code }) => tag.toLowerCase() === code.toLowerCase()) ??
      all.find(({ code }) => tag.slice(0, 2).toLowerCase() === code.slice(0, 2).toLowerCase());
    if (found) return found.code;
  }
  return null;
}

export class Languages extends Observable {
  /** English and German, and the languages next to the page. */
  all: ListedLanguage[] = kBuiltIn;

  constructor(private readonly messages: Messages) {
    super();
  }

  get current(): Language {
    return language();
  }

  speak(wanted: Language = browserLanguage(), texts: LanguageTexts | null = null): void {
    setLanguage(wanted, texts);
    document.documentElement.lang = wanted;
  }

  /** One of `all`; its file is fetched if it has one. */
  async choose(code: Language): Promise<void> {
    const isBuiltIn = kBuiltIn.some((listed) => listed.code === code);
    const texts = isBuiltIn ? null : await textsOf(code);
    if (isBuiltIn || texts) this.speak(code, texts);
    else this.messages.tell(t("noLanguage", { name: `languages/${code}.json` }));
  }

  /** Searches for more languages next to the page, and selects the one of the address or of the browser. */
  async find(): Promise<void> {
    this.all = [...kBuiltIn, ...(await moreLanguages())];
    const asked = new URLSearchParams(location.search).get("language") ?? wantedOf(this.all);
    if (asked && asked !== this.current && this.all.some(({ code }) => code === asked)) await this.choose(asked);
  }
}
