// The host converts every path that the command opens. It knows drives and backslashes (web/npm/lib/host.mjs).
SYSCALLS.calculateAt = (_folder, path, allowEmpty) => {
  if (path === '' && !allowEmpty) throw new FS.ErrnoError(44 /* ENOENT */);
  return path === '' ? path : Module['host']['path'](path);
};
// The libc of the module treats a partial write as complete.
const writeSome = FS.write;
FS.write = (stream, buffer, offset, length, position, canOwn) => {
  const at = (done) => (position === undefined ? undefined : position + done);
  const write = (done) => writeSome(stream, buffer, offset + done, length - done, at(done), canOwn);
  try {
    return Module['host']['writeAll'](write, length, (error) => error.errno === 6 /* EAGAIN */);
  } catch (error) {
    if (error.errno === 64 /* EPIPE */) Module['host']['endWithoutReader']();
    throw error;
  }
};
