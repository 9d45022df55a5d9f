import type { EngineError } from "../engine";

/** True for an error of the library, false for a programming error. */
export function isEngineError(error: unknown): error is EngineError {
  return typeof error === "object" && error !== null && "code" in error && typeof error.code === "string";
}
