/** Messages to the user: one at a time, the progress of a long task, and text for a live region. */

import { kCancelled, type EngineError } from "../engine";
import { Observable } from "../observable";

/** A message at the lower border of the page. */
export interface Message {
  title?: string;
  text: string;
  isError: boolean;
  /** The error itself; its code may be empty. */
  error?: EngineError;
}

export interface Progress {
  text: string;
  /** 0 to 1; negative: unknown. */
  share: number;
}

export class Messages extends Observable {
  message: Message | null = null;
  progress: Progress | null = null;
  /** Text for screen readers. */
  said = "";

  fail(error: unknown, title?: string): void {
    const { code, message } = error as Partial<EngineError>;
    if (code === kCancelled) return;
    const text = message ?? String(error);
    const given = { code: code ?? "", message: text };
    this.message = { ...(title ? { title } : {}), text: code ? `${text} (${code})` : text, isError: true, error: given };
  }

  tell(text: string): void {
    this.message = { text, isError: false };
    this.say(text);
  }

  say(text: string): void {
    this.said = text;
  }
}
