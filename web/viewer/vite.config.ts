import { statSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";
import { billOfMaterialsPlugin } from "./sbom_plugin";
import { basemapTemplate } from "./src/basemap/texts";
import { compareTemplate } from "./src/comparing/texts";
import { quantityTemplate } from "./src/quantities/texts";
import { fieldTemplate } from "./src/fields/texts";
import { fileTemplate } from "./src/reports/files";
import { template } from "./src/texts";
import { lateTemplate } from "./src/late_texts";
import { toolTemplate } from "./src/tool_texts";

// Servers that compress a module do not announce its size.
const modules = ["svt_view", "svt_view_threads"];
const moduleBytes = Object.fromEntries(
  modules.map((name) => [
    name,
    statSync(fileURLToPath(new URL(`../../build/web/${name}.wasm`, import.meta.url)), { throwIfNoEntry: false })?.size ?? 0,
  ]),
);

// Relative addresses, so that the page works in any folder of any server.
export default defineConfig({
  base: "./",
  define: { kModuleBytes: JSON.stringify(moduleBytes) },
  resolve: { alias: { "lit/directives/style-map.js": fileURLToPath(new URL("src/ui/style_map.ts", import.meta.url)) } },
  build: {
    target: "es2022",
    outDir: "../../build/release/share/svt/viewer",
    emptyOutDir: true,
    modulePreload: { polyfill: false },
    assetsInlineLimit: 0,
  },
  worker: { format: "es" },
  plugins: [
    {
      // What translators begin with, see src/languages.ts.
      name: "language-template",
      apply: "build",
      generateBundle() {
        this.emitFile({
          type: "asset",
          fileName: "languages/template.json",
          source: `${JSON.stringify({ texts: { ...template(), ...toolTemplate(), ...lateTemplate(), ...compareTemplate(), ...fileTemplate(), ...quantityTemplate(), ...basemapTemplate(), ...fieldTemplate() }, classes: {} }, null, 1)}\n`,
        });
      },
    },
    billOfMaterialsPlugin("svt-viewer"),
  ],
});
