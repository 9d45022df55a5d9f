import { createServer, type IncomingMessage, type ServerResponse } from "node:http";
import { type AddressInfo } from "node:net";
import { afterEach, expect, test } from "vitest";
import { CityFiles } from "./city_files";
import { kMostAttempts, retryMs } from "./retry";

let close = () => {};
afterEach(() => close());

/** A server that answers each request by the next of `answers`, and the last one again and again. */
async function serverOf(...answers: ((response: ServerResponse) => void)[]): Promise<{ address: string; requests: () => number }> {
  let requests = 0;
  const server = createServer((_request: IncomingMessage, response) => answers[Math.min(requests++, answers.length - 1)]!(response));
  await new Promise<void>((done) => server.listen(0, "127.0.0.1", done));
  close = () => void server.close();
  return { address: `http://127.0.0.1:${(server.address() as AddressInfo).port}/town/`, requests: () => requests };
}

const busy =
  (status: number, headers: Record<string, string> = {}) =>
  (response: ServerResponse) =>
    void response.writeHead(status, { Connection: "close", ...headers }).end();
const bytes = (response: ServerResponse) =>
  void response.writeHead(206, { Connection: "close", "Content-Range": "bytes 0-3/100" }).end("abcd");

/** Half of what its head promises. */
const brokenOff = (response: ServerResponse) => {
  response.writeHead(206, { Connection: "close", "Content-Range": "bytes 0-3/100", "Content-Length": "4" });
  response.write("ab", () => response.destroy());
};

/** A city whose waits are noted, not waited for. */
function cityAt(address: string): { files: CityFiles; waits: number[] } {
  const waits: number[] = [];
  return { files: new CityFiles(address, 16e6, (ms) => (waits.push(ms), Promise.resolve())), waits };
}

test("a busy server is asked again, later each time", async () => {
  for (const status of [429, 503]) {
    const server = await serverOf(busy(status), busy(status), bytes);
    const { files, waits } = cityAt(server.address);
    const [given] = await files.get([["packs/00000.svtp", 0, 4]]);
    expect(new TextDecoder().decode(given!.bytes)).toBe("abcd");
    expect(server.requests()).toBe(3);
    expect(waits).toEqual([250, 500]);
    close();
  }
});

test("a body that breaks off is asked for again, and named where it always does", async () => {
  const once = await serverOf(brokenOff, brokenOff, bytes);
  const city = cityAt(once.address);
  const [whole] = await city.files.get([["packs/00000.svtp", 0, 4]]);
  expect(new TextDecoder().decode(whole!.bytes)).toBe("abcd");
  expect(once.requests()).toBe(3);
  expect(city.waits).toEqual([250, 500]);
  close();

  const always = await serverOf(brokenOff);
  const [broken] = await cityAt(always.address).files.get([["packs/00000.svtp", 0, 4]]);
  expect(broken!.error).toContain("packs/00000.svtp");
  expect(broken!.bytes).toHaveLength(0);
  expect(always.requests()).toBe(kMostAttempts);
});

test("what Retry-After says is waited for", async () => {
  const server = await serverOf(busy(503, { "Retry-After": "7" }), bytes);
  const { files, waits } = cityAt(server.address);
  await files.get([["packs/00000.svtp", 0, 4]]);
  expect(waits).toEqual([7000]);
});

test("requests end after some attempts, at refusals, and where the wait would be long", async () => {
  const cases: [() => (response: ServerResponse) => void, number][] = [
    [() => busy(500), kMostAttempts],
    [() => busy(403, { "Retry-After": "1" }), 1],
    [() => busy(503, { "Retry-After": "3600" }), 1],
  ];
  for (const [answer, requests] of cases) {
    const server = await serverOf(answer());
    const { files, waits } = cityAt(server.address);
    const [given] = await files.get([["packs/00000.svtp", 0, 4]]);
    expect(given!.error).not.toBeNull();
    expect(server.requests()).toBe(requests);
    expect(waits).toHaveLength(requests - 1);
    close();
  }
});

test("Retry-After is read as seconds or a date", () => {
  const now = Date.UTC(1994, 10, 6, 8, 49, 37);
  expect(retryMs(1, null, now)).toBe(250);
  expect(retryMs(3, null, now)).toBe(1000);
  expect(retryMs(1, "0", now)).toBe(250);
  expect(retryMs(1, " 12 ", now)).toBe(12_000);
  expect(retryMs(1, "Sun, 06 Nov 1994 08:49:49 GMT", now)).toBe(12_000);
  expect(retryMs(1, "Sun, 06 Nov 1994 08:49:36 GMT", now)).toBe(250);
  expect(retryMs(1, "Mon, 07 Nov 1994 08:49:37 GMT", now)).toBeNull();
  for (const bad of ["", "-5", "1.5", "soon", "5 s", "Sun, 06 Now 1994 08:49:50 GMT"]) expect(retryMs(1, bad, now)).toBe(250);
});

test("a city forgets missing and damaged files, and remembers how long a server asks to wait", async () => {
  const gone = (response: ServerResponse) => void response.writeHead(404, { Connection: "close" }).end();
  const server = await serverOf(gone, bytes, busy(503, { "Retry-After": "3600" }), bytes);
  const { files } = cityAt(server.address);
  const get = () => files.get([["packs/00000.svtp", 0, 4]]).then(([given]) => given!.total);
  expect(await get()).toBe(0);
  expect(await get()).toBe(0);
  files.forget([]);
  expect(await get()).toBe(100);
  files.forget(["packs/00001.svtp"]);
  expect(await get()).toBe(100);
  expect(server.requests()).toBe(2);
  files.forget(["packs/00000.svtp"]);
  const start = Date.now();
  expect(await get()).toBe(0);
  expect(files.askedUntil - start).toBeGreaterThan(3_590_000);
  expect(await get()).toBe(100);
});
