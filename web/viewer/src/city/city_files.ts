/**
 * The files of a city on a web server, fetched by single ranges (docs/formats/city.md). Ranges that are near each other
 * are one request. Fetched ranges are kept up to a limit, so that several workers do not request them twice.
 */

import { t } from "../texts";
import { askedMs, kMostAttempts, retryMs } from "./retry";

export type WantedRange = readonly [file: string, offset: number, size: number];

/** Bytes of a range, fewer if the file ends in it; or the reason why they are unavailable. */
export interface GivenRange {
  range: WantedRange;
  bytes: Uint8Array;
  /** Size of the file; 0: the file does not exist. */
  total: number;
  error: string | null;
}

interface Block {
  file: string;
  offset: number;
  bytes: Uint8Array;
  total: number;
}

interface Answer {
  block: Block | null;
  error: string | null;
}

interface Coming {
  file: string;
  offset: number;
  size: number;
  answer: Promise<Answer>;
}

/** Maximum gap in bytes between two ranges that one request fetches. */
const kGap = 32 << 10;
const kLargestRequest = 1 << 20;
const kAtOnce = 6;
/** Bytes of the first request of these files: the whole file, or the part for a first view. */
const kBegin: Record<string, number> = { "index.bin": 48 << 10, "ids.bin": 64 << 10 };
const kIndexAhead = 64 << 10;
/** The size of a file whose server does not send it (CORS). */
const kUnknown = Number.MAX_SAFE_INTEGER;

export class CityFiles {
  /** The requests so far. */
  readonly traffic = { requests: 0, bytes: 0 };
  /** Until this time the server asks for no further request, milliseconds since 1970. */
  askedUntil = 0;
  private blocks: Block[] = [];
  private coming: Coming[] = [];
  private readonly sizes = new Map<string, number>();
  private running = 0;
  private readonly waiting: (() => void)[] = [];

  /** @param address  of the folder; @param keptBytes  limit of stored bytes; @param wait  between two attempts */
  constructor(
    private readonly address: string,
    private readonly keptBytes = 16e6,
    private readonly wait = (ms: number) => new Promise<void>((done) => setTimeout(done, ms)),
  ) {}

  /** Fetches the files for a first picture: city.json, then the begin of the index and the tile of the coarsest detail. */
  async begin(): Promise<void> {
    const json = await this.need("city.json", 0, 1 << 20);
    if (!json.block) return;
    try {
      const { top } = JSON.parse(new TextDecoder().decode(json.block.bytes)) as { top: { pack: number; offset: number; bytes: number } };
      const pack = `packs/${String(top.pack).padStart(5, "0")}.svtp`;
      await Promise.all([this.need("index.bin", 0, kBegin["index.bin"]!), this.need(pack, top.offset, top.bytes)]);
    } catch {
      // The library reads it again, and reports the error.
    }
  }

  /** All of `wanted`, with as few requests as possible. */
  async get(wanted: readonly WantedRange[]): Promise<GivenRange[]> {
    const missing = wanted.filter((range) => !this.find(range));
    const answers = await Promise.all(
      requestsFor(missing).map(([file, offset, size]) => this.need(file, offset, size).then((answer) => ({ file, offset, size, answer }))),
    );
    const given = wanted.map((range): GivenRange => {
      const found = this.find(range);
      if (found) return found;
      const [file, offset] = range;
      const own = answers.find((a) => a.file === file && a.offset <= offset && offset < a.offset + a.size)?.answer;
      // A block may have been dropped again if the request exceeds the limit.
      return (
        (own?.block && partOf(own.block, range)) || {
          range,
          bytes: new Uint8Array(0),
          total: 0,
          error: own?.error ?? t("cityWrongRange", { name: file }),
        }
      );
    });
    this.trim();
    return given;
  }

  /** Forgets the bytes of some files, which may be damaged, and all files that did not exist. */
  forget(names: readonly string[]): void {
    this.blocks = this.blocks.filter(({ file, total }) => total > 0 && !names.includes(file));
    for (const name of names) this.sizes.delete(name);
  }

  private find(range: WantedRange): GivenRange | null {
    for (let n = this.blocks.length - 1; n >= 0; --n) {
      const block = this.blocks[n]!;
      const part = block.file === range[0] ? partOf(block, range) : null;
      if (!part) continue;
      this.blocks.push(...this.blocks.splice(n, 1));
      return part;
    }
    return null;
  }

  /** Drops the least recently used blocks. */
  private trim(): void {
    let kept = this.blocks.reduce((sum, { bytes }) => sum + bytes.length, 0);
    this.blocks = this.blocks.filter((block) => {
      const isDropped = kept > this.keptBytes && block.file !== "city.json" && block.file !== "index.bin";
      if (isDropped) kept -= block.bytes.length;
      return !isDropped;
    });
  }

  private need(file: string, offset: number, size: number): Promise<Answer> {
    const same = this.coming.find((c) => c.file === file && c.offset <= offset && c.offset + c.size >= offset + size);
    if (same) return same.answer;
    const answer = this.fetched(file, offset, size);
    const coming: Coming = { file, offset, size, answer };
    this.coming.push(coming);
    const end = () => (this.coming = this.coming.filter((c) => c !== coming));
    answer.then(end, end);
    return answer;
  }

  private async fetched(file: string, offset: number, size: number): Promise<Answer> {
    while (this.running >= kAtOnce) await new Promise<void>((done) => this.waiting.push(done));
    ++this.running;
    try {
      for (let attempt = 1; ; ++attempt) {
        const { answer, mayTryAgain, retryAfter } = await this.ask(file, offset, size);
        if (answer.block) this.blocks.push(answer.block);
        const now = Date.now();
        if (mayTryAgain) this.askedUntil = Math.max(this.askedUntil, now + askedMs(retryAfter, now));
        if (!mayTryAgain || attempt === kMostAttempts) return answer;
        const ms = retryMs(attempt, retryAfter, now);
        if (ms === null) return answer;
        await this.wait(ms);
      }
    } finally {
      --this.running;
      this.waiting.shift()?.();
    }
  }

  private async ask(
    file: string,
    offset: number,
    size: number,
  ): Promise<{ answer: Answer; mayTryAgain: boolean; retryAfter: string | null }> {
    const failed = (error: string, mayTryAgain = false, retryAfter: string | null = null) => ({
      answer: { block: null, error },
      mayTryAgain,
      retryAfter,
    });
    const given = (block: Block) => ({ answer: { block, error: null }, mayTryAgain: false, retryAfter: null });
    ++this.traffic.requests;
    let response: Response, bytes: Uint8Array | null;
    try {
      response = await fetch(new URL(file, this.address), {
        headers: { Range: `bytes=${offset}-${offset + size - 1}` },
        cache: "no-store",
      });
      if (response.status === 404 || response.status === 410 || response.status === 416) {
        await response.body?.cancel();
        return given({ file, offset, bytes: new Uint8Array(0), total: response.status === 416 ? offset : 0 });
      }
      if (!response.ok)
        return failed(
          t("notLoaded", { name: file, status: response.status }),
          response.status === 429 || response.status >= 500,
          response.headers.get("Retry-After"),
        );
      if (response.status === 200 && offset > 0) {
        await response.body?.cancel();
        return failed(t("cityNoRanges", { name: file }));
      }
      bytes = await atMost(response, size);
    } catch (error) {
      return failed(t("cityNoAnswer", { name: file, reason: (error as Error).message }), true);
    }
    this.traffic.bytes += bytes?.length ?? 0;
    if (!bytes) return failed(response.status === 200 ? t("cityNoRanges", { name: file }) : t("cityWrongRange", { name: file }));
    const total = totalOf(response, offset, size, bytes.length);
    if (total === null) return failed(t("cityWrongRange", { name: file }));
    const known = this.sizes.get(file);
    if (known !== undefined && known !== total) return failed(t("cityChanged", { name: file }));
    if (total !== kUnknown) this.sizes.set(file, total);
    return given({ file, offset, bytes, total });
  }
}

/** Ranges as requests: near ranges of a file together, and longer ranges of indexes. */
function requestsFor(missing: readonly WantedRange[]): WantedRange[] {
  const ordered = [...missing].sort((a, b) => (a[0] < b[0] ? -1 : a[0] > b[0] ? 1 : a[1] - b[1]));
  const requests: [string, number, number][] = [];
  for (const [file, offset, size] of ordered) {
    const least = offset === 0 ? (kBegin[file] ?? 0) : file === "index.bin" ? kIndexAhead : 0;
    const end = offset + Math.max(size, least);
    const last = requests.at(-1);
    const isNear = last !== undefined && last[0] === file && offset - (last[1] + last[2]) <= kGap && end - last[1] <= kLargestRequest;
    if (isNear) last[2] = Math.max(last[2], end - last[1]);
    else requests.push([file, offset, end - offset]);
  }
  return requests;
}

function partOf(block: Block, range: WantedRange): GivenRange | null {
  const [, offset, size] = range;
  const end = block.offset + block.bytes.length;
  const isWhole = offset >= block.offset && (offset + size <= end || (end >= block.total && block.total !== kUnknown));
  if (!isWhole) return null;
  return {
    range,
    bytes: block.bytes.subarray(offset - block.offset, Math.min(block.bytes.length, offset - block.offset + size)),
    total: block.total,
    error: null,
  };
}

/** The body; null if it is longer than `most`. Stops reading there. */
async function atMost(response: Response, most: number): Promise<Uint8Array | null> {
  const reader = response.body!.getReader();
  const parts: Uint8Array<ArrayBuffer>[] = [];
  for (let size = 0; ;) {
    const { done, value } = await reader.read();
    if (done) return new Uint8Array(await new Blob(parts).arrayBuffer());
    size += value.length;
    if (size > most) {
      await reader.cancel();
      return null;
    }
    parts.push(value as Uint8Array<ArrayBuffer>);
  }
}

/** Size of the file by the headers of the response; null: the server sent another range than requested, or not all of it. */
function totalOf(response: Response, offset: number, size: number, given: number): number | null {
  if (response.status === 200) return given;
  const text = response.headers.get("Content-Range");
  // Servers of other sites may not expose it.
  if (text === null) return given === size ? kUnknown : offset + given;
  const range = /^bytes (\d+)-(\d+)\/(\d+)$/.exec(text);
  if (!range) return null;
  const [first, last, total] = range.slice(1).map(Number) as [number, number, number];
  const isMeant = first === offset && last - first + 1 === given && (given === size || last + 1 === total);
  return isMeant ? total : null;
}
