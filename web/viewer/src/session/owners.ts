/** A table of owners or parcels (CSV) that was dropped on the page. It sets owners of features, for colours and queries. */

import { t } from "../texts";
import { ViewPart } from "./view_part";

/** Maximum number of messages on rows. */
const kMostMessages = 1000;

export class Owners extends ViewPart {
  /** Name of the table; empty: no table. */
  file = "";
  table: ArrayBuffer | null = null;

  /** Applies a table, and colours features by it at once. Rejects with an error of the library that names the line. */
  async give(table: ArrayBuffer, file: string): Promise<void> {
    const { engine, info } = this.volume;
    if (!engine || !info) return this.messages.tell(t("ownersNeedModel", { name: file }), "closed");
    const unknown = await engine.owners(table.slice(0), file);
    this.table = table;
    this.file = file;
    if (this.view.state.colorBy === "owner" && !this.view.state.field) this.view.recolor();
    else this.view.set({ colorBy: "owner", field: null });
    const given = t("ownersGiven", { name: file });
    const [first] = unknown;
    this.messages.tell(
      first
        ? `${given} ${t("ownersUnknown", { n: unknown.length < kMostMessages ? unknown.length : `≥ ${kMostMessages}`, first })}`
        : given,
      first ? "closed" : "action",
    );
  }

  /** Applies the table to a volume that replaced another one of the same model. */
  async giveAgain(): Promise<void> {
    if (!this.table) return;
    await this.volume.engine?.owners(this.table.slice(0), this.file).catch(() => this.forget());
    this.view.recolor();
  }

  forget(): void {
    this.file = "";
    this.table = null;
  }
}
