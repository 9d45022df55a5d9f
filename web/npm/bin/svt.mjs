#!/usr/bin/env node
// The command svt: the program of apps/cli as WebAssembly, with access to the files of this system.
import { spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import os from "node:os";
import path from "node:path";
import process from "node:process";
import tty from "node:tty";
import { fileURLToPath } from "node:url";

import { commandEnvironment, commandPath, hostPath, writeAll } from "../lib/host.mjs";
import { serve } from "../lib/server.mjs";

if (Number(process.versions.node.split(".")[0]) < 18) {
  process.stderr.write(`svt: Node.js 18 or newer is needed; this is ${process.versions.node}\n`);
  process.exit(1);
}

/** @param {string} address */
function openBrowser(address) {
  const program = { win32: "cmd", darwin: "open" }[String(process.platform)] ?? "xdg-open";
  const first = process.platform === "win32" ? ["/c", "start", ""] : [];
  const child = spawn(program, [...first, address], { stdio: "ignore", detached: true });
  child.on("error", () => process.stderr.write("svt: no browser could be started; open the address yourself\n"));
  child.unref();
}

const isWindows = process.platform === "win32";
/** @type {Promise<number> | undefined} */
let serving;
const createSvtCommand = createRequire(import.meta.url)("../lib/svt_node.cjs");
const command = await createSvtCommand({
  wasmBinary: readFileSync(new URL("../lib/svt_node.wasm", import.meta.url)),
  host: {
    isWindows,
    // Not process.stderr.isTTY: reading it makes a pipe non-blocking, and with 2>&1 stdout too.
    isErrorTerminal: tty.isatty(2),
    isOutputTerminal: tty.isatty(1),
    hasDesktop: isWindows || process.platform === "darwin" || Boolean(process.env.DISPLAY || process.env.WAYLAND_DISPLAY),
    // The command searches the page next to the program: ../share/svt/viewer.
    program: commandPath(path.resolve(fileURLToPath(import.meta.url)), isWindows),
    environment: commandEnvironment(process.env, os.tmpdir(), isWindows),
    path: (/** @type {string} */ given) => hostPath(given, process.cwd(), isWindows),
    writeAll,
    // Ends without a message, like the signal SIGPIPE, because the reader of the output is gone.
    endWithoutReader: () => process.exit(141),
    serve: (/** @type {Parameters<typeof serve>[0]} */ orders) => {
      serving = serve(orders, openBrowser);
    },
  },
});
let code = command.callMain(process.argv.slice(2));
if (serving) code = await serving;
process.exitCode = code;
