import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { expect, it } from "vitest";
import { Download } from "./download";

it("reports all bytes so far, also while no further ones come", async () => {
  let finish = (): void => {};
  const server = createServer((_, response) => {
    response.writeHead(200, { "Content-Length": 100 });
    response.write(Buffer.alloc(20));
    setTimeout(() => response.write(Buffer.alloc(30)), 30);
    finish = () => response.end(Buffer.alloc(50));
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", () => done(null)));
  const download = new Download(`http://127.0.0.1:${(server.address() as AddressInfo).port}/house.svt`, 0);
  await expect.poll(() => [download.done, download.all], { timeout: 20_000 }).toEqual([50, 100]);
  finish();
  expect((await download.blob).size).toBe(100);
  expect(download.done).toBe(100);
  await new Promise((done) => server.close(done));
});
