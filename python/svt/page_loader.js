// Starts the viewer from one HTML file: gives its modules, its workers and fetch() the files that the HTML contains.
// The page runs in the frame of a notebook or from a local file, and has no server and no origin of its own.
(async () => {
  // Addresses of the files. No request goes to them. The page treats those of http as another site.
  const base = "svt-page://files/";
  const { main, files } = JSON.parse(document.getElementById("svt-files").textContent);
  const types = { js: "text/javascript", json: "application/json", svg: "image/svg+xml", wasm: "application/wasm" };
  const typeOf = (path) => types[path.split(".").pop()] ?? "application/octet-stream";

  async function unpacked(text) {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
  }

  const scripts = {};
  const addresses = {};
  await Promise.all(
    Object.entries(files).map(async ([path, text]) => {
      const bytes = await unpacked(text);
      if (path.endsWith(".js")) scripts[path] = new TextDecoder().decode(bytes);
      else addresses[path] = URL.createObjectURL(new Blob([bytes], { type: typeOf(path) }));
    }),
  );

  // The page and its workers, which get the text of this function, ask for files by their address on the server, or by
  // one beside the document.
  function serve(known, root) {
    const { fetch } = self;
    self.fetch = (asked, options) => {
      const address = new URL(asked.url ?? asked, root).href;
      const path = Object.keys(known).find((one) => address.endsWith(`/${one}`));
      return fetch.call(self, path === undefined ? address : known[path], options);
    };
  }
  const serving = `"use strict"; (${serve})(${JSON.stringify(addresses)}, ${JSON.stringify(base)});`;

  const made = {};
  function moduleOf(path, begin = "") {
    if (!(path in scripts)) throw new Error(`the page has no script ${path}`);
    const folder = path.slice(0, path.lastIndexOf("/") + 1);
    return (made[path] ??= URL.createObjectURL(
      new Blob(
        [
          begin,
          scripts[path]
            .replaceAll("import.meta.url", JSON.stringify(base + path))
            .replace(/\bfrom"\.\/([^"]+)"/g, (_, name) => `from"${moduleOf(folder + name)}"`)
            .replace(/\bimport\("\.\/([^"]+)"\)/g, (_, name) => `import(svtModuleOf(${JSON.stringify(folder + name)}))`),
        ],
        { type: types.js },
      ),
    ));
  }
  self.svtModuleOf = moduleOf;
  self.Worker = class extends Worker {
    constructor(address, options) {
      // Browsers load no module into a worker of a page without origin. The worker has no static import, so it is a script.
      super(moduleOf(String(address).slice(base.length), serving), { name: options.name });
    }
  };

  // Storage and history of the browser are closed to a page without origin. Settings then last as long as the page.
  try {
    void localStorage;
  } catch {
    const kept = new Map();
    const storage = {
      getItem: (key) => kept.get(key) ?? null,
      setItem: (key, value) => void kept.set(key, String(value)),
      removeItem: (key) => void kept.delete(key),
    };
    Object.defineProperty(self, "localStorage", { value: storage });
  }
  serve(addresses, base);
  await import(moduleOf(main));
})();
