import type { EngineError } from "../engine";

/** An error of the packages: `code` as in docs/errors. */
export class SvtError extends Error {
  override readonly name = "SvtError";

  constructor(
    readonly code: string,
    message: string,
  ) {
    super(message);
  }
}

/** The error that programs catch, from that of the library. */
export function errorOf(error: unknown): Error {
  if (error instanceof Error) return error;
  return isEngineError(error) ? new SvtError(error.code, error.message) : new Error(String(error));
}

/** True for an error of the library, false for a programming error. */
export function isEngineError(error: unknown): error is EngineError {
  return typeof error === "object" && error !== null && "code" in error && typeof error.code === "string";
}
