/** Buildings of the whole city whose names and attributes have the words of the search field. Loaded for the first search. */

import { css, html, nothing } from "lit";
import { kCancelled, type CityFound, type EngineError } from "../engine";
import { number } from "../texts";
import { toolText } from "../tool_texts";
import { controls, Part } from "../ui/part";

/** Milliseconds after the last key. */
const kAfter = 200;
/** Maximum number of listed buildings. */
const kMost = 50;

export class CitySearch extends Part {
  static override properties = {
    ...Part.properties,
    words: { attribute: false },
    found: { state: true },
    error: { state: true },
  };
  declare words: string;
  /** null: no answer yet. */
  declare found: CityFound | null;
  declare error: string;
  private timer = 0;
  private asked = "";
  /** The words to which `found` and `error` belong. */
  private answered = "";

  static override styles = [
    controls,
    css`
      ul { list-style: none; margin: 6px 0 0; padding: 0; max-height: 34vh; overflow: auto; overscroll-behavior: contain; }
      li button { width: 100%; justify-content: flex-start; gap: 8px; min-height: 30px; padding: 2px 6px; overflow: hidden; }
      @media (max-width: 759px), (pointer: coarse) { li button { min-height: 44px; } }
      .name { overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
      .name .quiet { font-size: 12px; margin-left: 6px; }
    `,
  ];

  constructor() {
    super();
    this.words = this.error = "";
    this.found = null;
  }

  override disconnectedCallback(): void {
    clearTimeout(this.timer);
    super.disconnectedCallback();
  }

  override willUpdate(changed: Map<string, unknown>): void {
    if (!changed.has("words")) return;
    clearTimeout(this.timer);
    if (this.words === this.asked) return;
    this.timer = window.setTimeout(() => void this.ask(), kAfter);
  }

  private async ask(): Promise<void> {
    const { words, session } = this;
    const { city } = session.model;
    if (!city) return;
    clearTimeout(this.timer);
    this.asked = words;
    const result = await city.search(words, kMost).catch((error: EngineError) => error);
    // Another search has begun meanwhile.
    if (this.asked !== words) return;
    this.answered = words;
    const isError = "code" in result;
    this.found = isError ? null : result;
    this.error = isError && result.code !== kCancelled ? result.message : "";
  }

  /** Shows the first building of the present words. Resolves to false if there is none. */
  async goToFirst(): Promise<boolean> {
    if (this.answered !== this.words) await this.ask();
    const [first] = this.found?.buildings ?? [];
    if (first) this.goTo(first.id);
    return first !== undefined;
  }

  private goTo(id: string): void {
    void this.session.model.city?.find(id);
  }

  override render() {
    const { found, error } = this;
    if (error) return html`<div class="small error" role="status">${error}</div>`;
    if (!found) return nothing;
    const { count, buildings } = found;
    const values = { n: number(count, 0), most: number(kMost, 0) };
    const said = toolText(count === 0 ? "cityNone" : count > buildings.length ? "cityFoundFirst" : "cityFound", values);
    return html`<div class="small quiet" role="status" id="city-found">${said}</div>
      ${count === 0 ? nothing : this.list(buildings)}`;
  }

  private list(buildings: CityFound["buildings"]) {
    return html`<ul aria-label=${toolText("cityHits")}>
      ${buildings.map(
        ({ id, name, class: className, address }) =>
          html`<li><button class="bare" title=${id} @click=${() => this.goTo(id)}>
            <span class="name">${name || address || id} <span class="quiet">${name && address ? address : className}</span></span></button></li>`,
      )}
    </ul>`;
  }
}

customElements.define("svt-city-search", CitySearch);
