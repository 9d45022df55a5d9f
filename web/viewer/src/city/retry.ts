/** The time at which a failed request is repeated: later each time, or when the server asks for it; as in svt/city/store/retry.hpp. */

/** Maximum number of requests for one range, including the first one. */
export const kMostAttempts = 4;
const kFirstRetryMs = 250;
/** The page does not wait longer than this on behalf of a server. */
const kLongestRetryMs = 60_000;

/**
 * Milliseconds until the next request; null: the server asks for more than the page waits.
 * @param attempt  number of requests so far, from 1
 * @param retryAfter  value of the header Retry-After: seconds or a date; null or malformed: ignored
 * @param now  milliseconds since 1970
 */
export function retryMs(attempt: number, retryAfter: string | null, now: number): number | null {
  const wait = Math.max(kFirstRetryMs * 2 ** (attempt - 1), askedMs(retryAfter, now));
  return wait > kLongestRetryMs ? null : wait;
}

/** Milliseconds that a header Retry-After asks for; 0: none. */
export function askedMs(retryAfter: string | null, now: number): number {
  const text = retryAfter?.trim() ?? "";
  const date = /^[A-Z][a-z]{2}, \d{2} [A-Z][a-z]{2} \d{4} \d{2}:\d{2}:\d{2} GMT$/.test(text) ? Date.parse(text) : NaN;
  return /^\d{1,9}$/.test(text) ? 1000 * Number(text) : Number.isNaN(date) ? 0 : Math.max(0, date - now);
}

/** Maximum number of rounds in which the page fetches missing tiles again by itself. */
export const kMostRounds = 5;
const kFirstRoundMs = 2000;
/** A round may wait longer than a request, because the page goes on meanwhile. */
const kLongestRoundMs = 600_000;

/**
 * Milliseconds until missing tiles are fetched again; null: only when the user asks for it.
 * @param rounds  number of rounds so far, from 0
 * @param asked  milliseconds that the server asks for
 */
export function roundMs(rounds: number, asked: number): number | null {
  const wait = Math.max(kFirstRoundMs * 2 ** rounds, asked);
  return rounds >= kMostRounds || wait > kLongestRoundMs ? null : wait;
}
