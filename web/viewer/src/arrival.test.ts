import { createServer, type ServerResponse } from "node:http";
import { type AddressInfo } from "node:net";
import { afterEach, expect, test } from "vitest";
import { Arrival } from "./arrival";
import { Download, lengthOf } from "./download";

let close = () => {};
afterEach(() => close());

async function serverOf(answer: (response: ServerResponse) => void): Promise<string> {
  const server = createServer((_, response) => answer(response));
  await new Promise<void>((done) => server.listen(0, "127.0.0.1", done));
  close = () => (server.closeAllConnections(), void server.close());
  return `http://127.0.0.1:${(server.address() as AddressInfo).port}/a.svt`;
}

test("the share is that of the module and the volume together, and unknown without a length", () => {
  const arrival = new Arrival();
  arrival.module = { done: 30, all: 100 };
  expect(arrival.share).toBe(null);
  arrival.volume = { done: 30, all: 300 };
  expect(arrival.share).toBe(0.15);
  arrival.volume = { done: 30, all: 0 };
  expect(arrival.share).toBe(null);
  arrival.volume = null;
  expect(arrival.share).toBe(0.3);
  // More bytes than announced.
  arrival.module = { done: 130, all: 100 };
  expect(arrival.share).toBe(1);
  arrival.module = { done: 30, all: 0 };
  expect(arrival.share).toBe(null);
});

test("a download counts its bytes", async () => {
  let release = () => {};
  const address = await serverOf((response) => {
    response.writeHead(200, { "Content-Length": "8" });
    response.write("abcd");
    release = () => void response.end("efgh");
  });
  const download = new Download(address, 0);
  for (let n = 0; n < 200 && download.done < 4; ++n) await new Promise((done) => setTimeout(done, 10));
  expect([download.done, download.all]).toEqual([4, 8]);
  release();
  expect(await (await download.blob).text()).toBe("abcdefgh");
  expect([download.done, download.all]).toEqual([8, 8]);
});

test("a download names a missing file, a missing server, and ends when it is cancelled", async () => {
  const missing = await serverOf((response) => void response.writeHead(404).end());
  await expect(new Download(missing, 8).blob).rejects.toMatchObject({ message: expect.stringContaining("404") });
  close();
  const hanging = await serverOf((response) => void response.writeHead(200).write("ab"));
  const download = new Download(hanging, 8);
  for (let n = 0; n < 200 && download.done < 2; ++n) await new Promise((done) => setTimeout(done, 10));
  download.cancel();
  await expect(download.blob).rejects.toBeDefined();
  await expect(new Download("http://127.0.0.1:1/", 8).blob).rejects.toMatchObject({ message: expect.stringContaining("127.0.0.1:1") });
});

test("a compressed connection does not announce the number of bytes", () => {
  expect(lengthOf(new Headers({ "Content-Length": "12" }))).toBe(12);
  expect(lengthOf(new Headers({ "Content-Length": "12", "Content-Encoding": "gzip" }))).toBe(0);
  expect(lengthOf(new Headers())).toBe(0);
});
