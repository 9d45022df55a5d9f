import type { EngineError } from "../engine";

/** Whether it is an error of the library, not one of the program. */
export function isEngineError(error: unknown): error is EngineError {
  return typeof error === "object" && error !== null && "code" in error && typeof error.code === "string";
}
