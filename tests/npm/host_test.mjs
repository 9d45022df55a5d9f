// Paths of Windows and of other systems, and what the server of the package answers. node --test tests/npm/host_test.mjs
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import http from "node:http";
import os from "node:os";
import path from "node:path";
import test from "node:test";

import { commandEnvironment, commandPath, hostPath, writeAll } from "../../web/npm/lib/host.mjs";
import { byteRange, handler, isKnownHost, readSite } from "../../web/npm/lib/server.mjs";

test("on Windows drives, folders and spaces are kept", () => {
  const at = (given, folder = "C:\\Users\\Ada Lovelace") => hostPath(given, folder, true);
  assert.equal(at("house.gml"), "C:\\Users\\Ada Lovelace\\house.gml");
  assert.equal(at("my models/house 1.gml"), "C:\\Users\\Ada Lovelace\\my models\\house 1.gml");
  assert.equal(at("../house.gml"), "C:\\Users\\house.gml");
  assert.equal(at("./a/../house.gml"), "C:\\Users\\Ada Lovelace\\house.gml");
  assert.equal(at("D:/models/house.gml"), "D:\\models\\house.gml");
  assert.equal(at("d:/"), "d:\\");
  assert.equal(at("D:"), "D:\\");
  assert.equal(at("/models/house.gml"), "C:\\models\\house.gml");
  assert.equal(at("//server/share/house.gml"), "\\\\server\\share\\house.gml");
  assert.equal(at("."), "C:\\Users\\Ada Lovelace");
});

test("on Windows a drive behind a folder begins the path anew", () => {
  assert.equal(hostPath("scenes/D:/textures/brick.png", "C:\\x", true), "D:\\textures\\brick.png");
  assert.equal(hostPath("C:/scenes/D:/brick.png", "C:\\x", true), "D:\\brick.png");
  assert.equal(hostPath("C:/scenes/brick.png", "D:\\x", true), "C:\\scenes\\brick.png");
});

test("elsewhere colons and backslashes are letters", () => {
  assert.equal(hostPath("a.gml", "/home/ada", false), "/home/ada/a.gml");
  assert.equal(hostPath("../b/a.gml", "/home/ada", false), "/home/b/a.gml");
  assert.equal(hostPath("/tmp/a b.gml", "/home/ada", false), "/tmp/a b.gml");
  assert.equal(hostPath("x/C:/a.gml", "/home", false), "/home/x/C:/a.gml");
  assert.equal(hostPath("a\\b.gml", "/home", false), "/home/a\\b.gml");
  assert.equal(commandPath("a\\b.gml", false), "a\\b.gml");
});

test("the command sees paths with slashes", () => {
  assert.equal(commandPath("C:\\Users\\Ada\\svt.mjs", true), "C:/Users/Ada/svt.mjs");
  assert.equal(commandEnvironment({ A: "1" }, "C:\\Temp", true).TMPDIR, "C:/Temp");
  assert.equal(commandEnvironment({ A: "1" }, "C:\\Temp", true).A, "1");
});

test("ranges of bytes", () => {
  assert.deepEqual(byteRange("bytes=0-9", 100), { first: 0, last: 9 });
  assert.deepEqual(byteRange("bytes=90-", 100), { first: 90, last: 99 });
  assert.deepEqual(byteRange("bytes=-10", 100), { first: 90, last: 99 });
  assert.deepEqual(byteRange("bytes=50-500", 100), { first: 50, last: 99 });
  assert.equal(byteRange("bytes=100-", 100), "none");
  assert.equal(byteRange("bytes=-0", 100), "none");
  for (const whole of [undefined, "", "bytes=-", "bytes=9-3", "bytes=0-1,5-6", "lines=1-2"]) assert.equal(byteRange(whole, 100), "whole");
});

test("hosts", () => {
  for (const known of ["localhost", "localhost:8080", "127.0.0.1:1", "[::1]:8080", "models.example"])
    assert.ok(isKnownHost(known, ["models.example"]), known);
  for (const unknown of [undefined, "", "evil.example", "localhost.evil.example"]) assert.ok(!isKnownHost(unknown, []), unknown);
});

test("the server gives its files and nothing else", async () => {
  const folder = mkdtempSync(path.join(os.tmpdir(), "svt-test-"));
  writeFileSync(path.join(folder, "index.html"), "<p>page</p>");
  writeFileSync(path.join(folder, "a b.svt"), Buffer.from([0, 1, 2, 3]));
  const server = http.createServer(handler(readSite(folder), [])).listen(0, "127.0.0.1");
  await new Promise((resolve) => server.on("listening", resolve));
  const ask = (name, headers = {}, method = "GET") =>
    new Promise((resolve, reject) => {
      const request = http.request(
        { port: /** @type {import("node:net").AddressInfo} */ (server.address()).port, host: "127.0.0.1", path: name, headers, method },
        (reply) => {
          const parts = [];
          reply.on("data", (part) => parts.push(part));
          reply.on("end", () => resolve({ status: reply.statusCode, headers: reply.headers, body: Buffer.concat(parts) }));
        },
      );
      request.on("error", reject);
      request.end();
    });
  const page = await ask("/");
  assert.equal(page.status, 200);
  assert.equal(page.body.toString(), "<p>page</p>");
  assert.match(page.headers["content-type"], /text\/html/);
  assert.equal((await ask("/", { "If-None-Match": page.headers.etag })).status, 304);
  const part = await ask("/a%20b.svt", { Range: "bytes=1-2" });
  assert.equal(part.status, 206);
  assert.deepEqual([...part.body], [1, 2]);
  assert.equal(part.headers["content-range"], "bytes 1-2/4");
  assert.equal((await ask("/a%20b.svt", { Range: "bytes=9-" })).status, 416);
  assert.equal((await ask("/a%20b.svt", {}, "HEAD")).headers["content-length"], "4");
  for (const outside of ["/../etc/passwd", "/%2e%2e/etc/passwd", "//etc/passwd", "/..%2f..%2fetc/passwd", "/none"])
    assert.equal((await ask(outside)).status, 404, outside);
  assert.equal((await ask("/%ff")).status, 400);
  assert.equal((await ask("/", {}, "POST")).status, 405);
  assert.equal((await ask("/", { Host: "evil.example" })).status, 421);
  server.close();
  server.closeAllConnections?.();
  rmSync(folder, { recursive: true });
});

test("all is written, however little is taken at once", () => {
  const text = "abcdefghij";
  let taken = "";
  let calls = 0;
  const writeSome = (done) => {
    calls += 1;
    if (calls % 2 === 0) throw Object.assign(new Error("busy"), { code: "EAGAIN" });
    taken += text.slice(done, done + 3);
    return Math.min(3, text.length - done);
  };
  const isBusy = (error) => error.code === "EAGAIN";
  assert.equal(writeAll(writeSome, text.length, isBusy), text.length);
  assert.equal(taken, text);
  const broken = () => {
    throw Object.assign(new Error("closed"), { code: "EPIPE" });
  };
  assert.throws(() => writeAll(broken, 1, isBusy), { code: "EPIPE" });
});

test("a slow reader of a pipe gets everything", async () => {
  const host = new URL("../../web/npm/lib/host.mjs", import.meta.url).href;
  // process.stdout makes the pipe non-blocking, so that writeSync() takes 64 KiB and then throws EAGAIN.
  const script = `import { writeSync } from 'node:fs'; import { writeAll } from '${host}';
    process.stdout; const bytes = Buffer.alloc(1000000, 'x');
    writeAll((done) => writeSync(1, bytes, done), bytes.length, (error) => error.code === 'EAGAIN');`;
  const shell = spawn("sh", ["-c", '"$0" --input-type=module -e "$1" | (sleep 0.5; wc -c)', process.execPath, script]);
  let counted = "";
  for await (const piece of shell.stdout) counted += piece;
  assert.equal(Number(counted), 1000000);
});

test("the file system of the module writes all, and ends quietly without a reader", () => {
  const post = readFileSync(new URL("../../web/npm/lib/post.js", import.meta.url), "utf8");
  let isOpen = true;
  let ended = 0;
  let taken = "";
  let isBusy = false;
  // As Emscripten's NODERAWFS: takes what the system takes, numbers for errors.
  const FS = {
    ErrnoError: class extends Error {},
    write: (_stream, buffer, offset, length, position) => {
      if (!isOpen) throw Object.assign(new Error("no reader"), { errno: 64 });
      isBusy = !isBusy;
      if (isBusy) throw Object.assign(new Error("busy"), { errno: 6 });
      assert.equal(position, taken.length);
      taken += buffer.slice(offset, offset + Math.min(4, length));
      return Math.min(4, length);
    },
  };
  const host = { path: (given) => given, environment: {}, writeAll, endWithoutReader: () => (ended += 1) };
  new Function("FS", "SYSCALLS", "Module", "ENV", post)(FS, {}, { host }, {});
  assert.equal(FS.write({ fd: 1 }, "..abcdefghij", 2, 10, 0), 10);
  assert.equal(taken, "abcdefghij");
  isOpen = false;
  assert.throws(() => FS.write({ fd: 1 }, "x", 0, 1), { errno: 64 });
  assert.equal(ended, 1);
});
