/** The value of the shown field at the place that the user has clicked last. */

import type { FieldSeries } from "../engine";
import { Observable } from "../observable";
import type { Session } from "../session";

export class FieldProbe extends Observable {
  /** null: no place, or nothing there. */
  series: FieldSeries | null = null;
  private field = "";
  private info: unknown = null;

  constructor(private readonly session: Session) {
    super();
  }

  /** The series of a field of the open model; null: none. */
  of(field: string): FieldSeries | null {
    return this.field === field && this.info === this.session.volume.info ? this.series : null;
  }

  /** @param x, y  fractions of the picture */
  async take(x: number, y: number): Promise<void> {
    const { view, volume, messages } = this.session;
    const { field } = view.state;
    const { info } = volume;
    if (!field || !volume.engine) return;
    try {
      const series = await volume.engine.fieldAt(field.name, x, y);
      this.field = field.name;
      this.info = info;
      this.series = series;
    } catch (error) {
      messages.fail(error);
    }
  }
}

const kProbes = new WeakMap<Session, FieldProbe>();

export function probeOf(session: Session): FieldProbe {
  let probe = kProbes.get(session);
  if (!probe) kProbes.set(session, (probe = new FieldProbe(session)));
  return probe;
}
