// Functions of Node.js for the WebAssembly command: paths of this system, the environment, and writing to pipes.
import path from "node:path";

/**
 * Converts a path of the command to a path for Node.js.
 *
 * The command knows only '/'. On Windows a path may begin with a drive ("C:/models/a.gml"). The command treats a drive
 * as a folder, and may append it to another folder ("scenes/C:/models/a.gml"). Therefore the part from the last drive
 * on is used, because names on Windows cannot contain a colon. "//server/share/a.gml" is a network path.
 * @param {string} given
 * @param {string} folder  the current folder, in the notation of Node.js
 * @param {boolean} isWindows
 * @returns {string} absolute, "." and ".." resolved
 */
export function hostPath(given, folder, isWindows) {
  if (!isWindows) return path.posix.resolve(folder, given);
  const drive = given.match(/.*(?:^|\/)([A-Za-z]:)(?=\/|$)(.*)/s);
  // Without a slash, "C:" would be the drive's current folder.
  const whole = drive ? `${drive[1]}${drive[2] || "/"}` : given;
  return path.win32.resolve(folder, whole);
}

/**
 * Converts a path of Node.js to a path of the command, with '/'.
 * @param {string} given
 * @param {boolean} isWindows
 */
export function commandPath(given, isWindows) {
  return isWindows ? given.replaceAll("\\", "/") : given;
}

/**
 * The environment of the command, with the temporary folder of this system.
 * @param {Record<string, string | undefined>} environment
 * @param {string} temporaryFolder  os.tmpdir()
 * @param {boolean} isWindows
 * @returns {Record<string, string | undefined>}
 */
export function commandEnvironment(environment, temporaryFolder, isWindows) {
  return { ...environment, TMPDIR: commandPath(temporaryFolder, isWindows) };
}

/**
 * Writes all bytes, in as many parts as needed: a pipe takes only as many bytes as its buffer has room for, and a
 * non-blocking pipe may take none for a while (EAGAIN).
 * @param {(done: number) => number} writeSome  writes bytes after the first `done` bytes, returns their number
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
      // The command runs synchronously, so there is no other work to do meanwhile.
      Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, 5 /* ms */);
    }
  }
  return done;
}
