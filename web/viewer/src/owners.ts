/** A table of owners or parcels (CSV) that was dropped on the page: features have owners by it, for colours and queries. */

import type { Session } from "./session";
import { t } from "./texts";

export class Owners {
  /** Its name; empty: none. */
  file = "";
  private table: ArrayBuffer | null = null;

  constructor(private readonly session: Session) {}

  /** Colours by it at once. Rejects with an error of the library that names the line. */
  async give(table: ArrayBuffer, file: string): Promise<void> {
    const { session } = this;
    if (!session.engine || !session.info) return session.tell(t("ownersNeedModel", { name: file }));
    await session.engine.owners(table.slice(0), file);
    this.table = table;
    this.file = file;
    if (session.state.colorBy === "owner") session.redraw();
    else session.set({ colorBy: "owner" });
    session.tell(t("ownersGiven", { name: file }));
  }

  /** To a volume that took the place of another one of the same model. */
  async giveAgain(): Promise<void> {
    if (!this.table) return;
    await this.session.engine?.owners(this.table.slice(0), this.file).catch(() => this.forget());
    this.session.redraw();
  }

  forget(): void {
    this.file = "";
    this.table = null;
  }
}
