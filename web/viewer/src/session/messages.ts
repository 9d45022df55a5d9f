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
  /** The message ends with the next choice for the picture, with any next action of the user, or when it is closed. */
  until: "choice" | "action" | "closed";
  /** Buttons that repair it. */
  repairs?: { text: string; act: () => void }[];
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

  /** With a title, the message stays until it is closed. @param log  where the error is also written, with its title */
  fail(error: unknown, title?: string, log: (text: string) => void = console.error): void {
    const { code, message } = error as Partial<EngineError>;
    if (code === kCancelled) return;
    const text = message ?? String(error);
    log(`svt: ${title ? `${title}: ` : ""}${code ? `${code}: ` : ""}${text}`);
    const given = { code: code ?? "", message: text };
    this.message = {
      ...(title ? { title } : {}),
      text: code ? `${text} (${code})` : text,
      isError: true,
      error: given,
      until: title ? "closed" : "action",
    };
  }

  /** A choice that cannot be drawn, and was taken back. */
  refuse(error: EngineError, title: string, repairs: NonNullable<Message["repairs"]>): void {
    this.fail(error, title, console.warn);
    if (this.message) this.message = { ...this.message, until: "choice", ...(repairs.length ? { repairs } : {}) };
  }

  tell(text: string, until: Message["until"] = "action"): void {
    this.message = { text, isError: false, until };
    this.say(text);
  }

  say(text: string): void {
    this.said = text;
  }
}
