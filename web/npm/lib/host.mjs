// What the WebAssembly command asks of Node.js: paths of this system, the terminal, pipes, the server.
import path from "node:path";

/**
 * A path as the command sees it, as a path for Node.js.
 *
 * The command knows only '/'. On Windows a path may begin with a drive ("C:/models/a.gml"), which the command takes for
 * a folder and may therefore put behind another one ("scenes/C:/models/a.gml"): what follows the last drive counts, for no
 * name contains a colon there. "//server/share/a.gml" is a network path.
 * @param {string} given
 * @param {string} folder  the current folder, as Node.js names it
 * @param {boolean} isWindows
 * @returns {string} absolute, "." and ".." resolved
 */
export function hostPath(given, folder, isWindows) {
  if (!isWindows) return path.posix.resolve(folder, given);
  const drive = given.match(/.*(?:^|\/)([A-Za-z]:)(?=\/|$)(.*)/s);
  // "C:" alone would be that drive's current folder.
  const whole = drive ? `${drive[1]}${drive[2] || "/"}` : given;
  return path.win32.resolve(folder, whole);
}

/**
 * A path of Node.js as the command wants it: with '/'.
 * @param {string} given
 * @param {boolean} isWindows
 */
export function commandPath(given, isWindows) {
  return isWindows ? given.replaceAll("\\", "/") : given;
}

/**
 * The environment for the command: its temporary folder is where this system has one.
 * @param {Record<string, string | undefined>} environment
 * @param {string} temporaryFolder  os.tmpdir()
 * @param {boolean} isWindows
 * @returns {Record<string, string | undefined>}
 */
export function commandEnvironment(environment, temporaryFolder, isWindows) {
  return { ...environment, TMPDIR: commandPath(temporaryFolder, isWindows) };
}

/**
 * Writes all, however little is taken at once: a pipe takes at most what its buffer has room for, and where it is
 * non-blocking, none of it for a while (EAGAIN).
 * @param {(done: number) => number} writeSome  writes what comes after the first `done` bytes, returns how many it wrote
 * @param {number} length  of all, in bytes
 * @param {(error: unknown) => boolean} isBusy  whether an error means to try again
 * @returns {number} length
 */
export function writeAll(writeSome, length, isBusy) {
  let done = 0;
  while (done < length) {
    try {
      done += writeSome(done);
    } catch (error) {
      if (!isBusy(error)) throw error;
      // The command runs in one go, so nothing else could be done in the meantime.
      Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, 5 /* ms */);
    }
  }
  return done;
}
