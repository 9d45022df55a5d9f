// The WebAssembly module of reports for its tests, beside the command: `node TEST.mjs COMMAND MODULE_FOLDER [DATA_FOLDER]`.
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after } from "node:test";
import { pathToFileURL } from "node:url";

export const [command, moduleFolder, dataFolder] = process.argv.slice(2).map((path) => resolve(path));
if (!existsSync(join(moduleFolder, "svt_reports.js"))) {
  console.log(`no module at ${moduleFolder}; 'make web' builds it`);
  process.exit(77);
}
// The module reads its own address from a browser.
Object.assign(globalThis, { self: { location: { href: pathToFileURL(join(moduleFolder, "svt_reports.js")).href } } });
const { default: createSvt } = await import(self.location.href);

/** Folder of the test, which ends with it. */
export const folder = mkdtempSync(join(tmpdir(), "svt-reports-"));
after(() => rmSync(folder, { recursive: true }));
export const at = (name) => join(folder, name);
export const run = (...args) => execFileSync(command, args, { stdio: ["ignore", "pipe", "pipe"], maxBuffer: 1 << 28 });

/** The reported progress: step and share. */
export const steps = [];
export const svt = await createSvt({
  wasmBinary: readFileSync(join(moduleFolder, "svt_reports.wasm")),
  onProgress: (step, done) => steps.push([step, done]),
});
/** The answer of a call as JSON, or as bytes. */
export const ask = (name, args = [], content = undefined) => JSON.parse(new TextDecoder().decode(svt.call(name, args, content)));
export const bytes = (name, ...args) => Buffer.from(svt.call(name, args));
