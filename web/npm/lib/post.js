// Every path that the command opens goes through the host, which knows drives and backslashes (web/npm/lib/host.mjs).
SYSCALLS.calculateAt = (_folder, path, allowEmpty) => {
  if (path === '' && !allowEmpty) throw new FS.ErrnoError(44 /* ENOENT */);
  return path === '' ? path : Module['host']['path'](path);
};
