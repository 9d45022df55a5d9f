// Runs the command svt from a program: a process of its own, which cannot stop the program.
import { spawn } from "node:child_process";
import process from "node:process";
import { fileURLToPath } from "node:url";

/**
 * The result of a command.
 * @typedef {object} Finished
 * @property {number} code    exit code, 0: done; see the manual
 * @property {Uint8Array} stdout
 * @property {string} stderr  messages
 */

/**
 * Runs `svt` with the given words, such as ["build", "house.gml", "-o", "house.svt"]. Rejects only if it cannot be started.
 * @param {readonly string[]} words
 * @param {{cwd?: string, env?: Record<string, string | undefined>, signal?: AbortSignal}} [options]  signal: ends it
 * @returns {Promise<Finished>}
 */
export function run(words, { cwd, env, signal } = {}) {
  const program = fileURLToPath(new URL("../bin/svt.mjs", import.meta.url));
  return new Promise((resolve, reject) => {
    const child = spawn(process.execPath, [program, ...words], { cwd, env: env ?? process.env, signal, stdio: ["ignore", "pipe", "pipe"] });
    /** @type {Buffer[]} */
    const out = [];
    /** @type {Buffer[]} */
    const messages = [];
    child.stdout.on("data", (part) => out.push(part));
    child.stderr.on("data", (part) => messages.push(part));
    child.on("error", reject);
    child.on("close", (code) => resolve({ code: code ?? 1, stdout: Buffer.concat(out), stderr: Buffer.concat(messages).toString() }));
  });
}
