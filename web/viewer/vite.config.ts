import { defineConfig } from "vite";

// Relative addresses, so that the page works in any folder of any server.
export default defineConfig({
  base: "./",
  build: { target: "es2022", outDir: "../../build/release/share/svt/viewer", emptyOutDir: true, modulePreload: { polyfill: false }, assetsInlineLimit: 0 },
  worker: { format: "es" },
});
