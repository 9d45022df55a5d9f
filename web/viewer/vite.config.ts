import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";

// Relative addresses, so that the page works in any folder of any server.
export default defineConfig({
  base: "./",
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
