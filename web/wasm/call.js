// Added to svt.js: how a page makes a call. See module.cpp for the calls.

/** Makes a call; the reply is in the module's memory until the next call. Throws { code, message } on failure. */
Module["call"] = (name, args, bytes) => {
  const held = [];
  const hold = (size) => {
    const at = _malloc(size);
    if (at === 0) throw { code: "E104", message: "the file and its volume need more memory than a page has" };
    held.push(at);
    return at;
  };
  const holdText = (text) => {
    const size = lengthBytesUTF8(text) + 1;
    const at = hold(size);
    stringToUTF8(text, at, size);
    return at;
  };
  try {
    const size = bytes ? bytes.byteLength : 0;
    const data = hold(Math.max(size, 1));
    if (bytes) HEAPU8.set(bytes, data);
    const failed = _svt_call(holdText(name), holdText(JSON.stringify(args)), data, size);
    const at = _svt_reply();
    // Many functions of browsers refuse memory that threads share.
    const isShared = !(HEAPU8.buffer instanceof ArrayBuffer);
    const reply = isShared ? HEAPU8.slice(at, at + _svt_reply_size()) : HEAPU8.subarray(at, at + _svt_reply_size());
    if (failed) throw JSON.parse(new TextDecoder().decode(reply));
    return reply;
  } finally {
    for (const at of held) _free(at);
  }
};

/** Creates a WebGL2 context on an OffscreenCanvas and makes it current; false if WebGL2 is unavailable. */
Module["startGl"] = (canvas) => {
  const attributes = { majorVersion: 2, alpha: true, antialias: false, depth: false, stencil: false,
                       premultipliedAlpha: false, powerPreference: "high-performance" };
  const context = GL.createContext(canvas, attributes);
  return context > 0 && GL.makeContextCurrent(context);
};

/** Ends the threads of the module. It cannot be used afterwards. */
Module["close"] = () => {
  if (typeof PThread !== "undefined") PThread.terminateAllThreads();
};
