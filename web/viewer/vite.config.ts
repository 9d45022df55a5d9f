import { fileURLToPath } from "node:url";
import { defineConfig, type Plugin } from "vite";

/** The module and its worker are asked for with the page, not when its scripts have run. */
function preloadModule(): Plugin {
  return {
    name: "svt-preload-module",
    transformIndexHtml: {
      order: "post",
      handler: (_, { bundle }) =>
        Object.keys(bundle ?? {})
          .filter((name) => /\/(worker-.*\.js|svt-.*\.wasm)$/.test(name))
          .map((name) => ({
            tag: "link",
            injectTo: "head-prepend",
            attrs: name.endsWith(".wasm") ? { rel: "preload", as: "fetch", type: "application/wasm", crossorigin: "anonymous", href: `./${name}` } : { rel: "modulepreload", href: `./${name}` },
          })),
    },
  };
}

// Relative addresses, so that the page works in any folder of any server.
export default defineConfig({
  base: "./",
  plugins: [preloadModule()],
  resolve: { alias: { "lit/directives/style-map.js": fileURLToPath(new URL("src/ui/style_map.ts", import.meta.url)) } },
  build: {
    target: "es2022",
    outDir: "../../build/release/share/svt/viewer",
    emptyOutDir: true,
    modulePreload: { polyfill: false },
    assetsInlineLimit: 0,
  },
  worker: { format: "es" },
});
