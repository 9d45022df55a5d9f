import { fileURLToPath } from "node:url";
import { defineConfig, type Plugin, type Rollup } from "vite";
import { billOfMaterialsPlugin } from "./sbom_plugin";

/**
 * Scripts of the npm packages (scripts/npm.sh). The mode is what to build: `element`, the web component with its worker; `browser`
 * and `node`, the library. Names of files have no hash, because a package has a version, and programs that bundle it read them.
 */
const kEntries: Record<string, Record<string, string>> = {
  element: { "svt-viewer": "src/element/svt_viewer.ts" },
  browser: { browser: "src/library/browser.ts" },
  node: { node: "src/library/node.ts" },
};

/**
 * Makes scripts readable for programs that bundle the package. Vite writes addresses of files as
 * new URL("" + new URL("x", import.meta.url).href, import.meta.url); bundlers find a file only by new URL("x", import.meta.url). They
 * must not follow imports of addresses that are known only when the script runs.
 */
function readableForBundlers(): Plugin {
  const nested = /new URL\((?:\/\*.*?\*\/\s*)?""\s*\+\s*new URL\(("[^"]+"),\s*import\.meta\.url\)\.href,\s*import\.meta\.url\)/g;
  const unknown = /\bimport\((?=[\w$])/g;
  const readable = (code: string) =>
    code.replace(nested, "new URL($1,import.meta.url)").replace(unknown, "import(/* @vite-ignore */ /* webpackIgnore: true */ ");
  return {
    name: "readable-for-bundlers",
    enforce: "post",
    generateBundle(_, bundle: Rollup.OutputBundle) {
      for (const file of Object.values(bundle)) {
        if (file.type === "chunk") file.code = readable(file.code);
        else if (file.fileName === "worker.js" && typeof file.source === "string") file.source = readable(file.source);
      }
    },
  };
}

const names = { entryFileNames: "[name].js", chunkFileNames: "[name].js", assetFileNames: "[name][extname]" };

export default defineConfig(({ mode }) => ({
  base: "./",
  publicDir: false,
  build: {
    target: "es2022",
    outDir: process.env.SVT_PACKAGE_OUT ?? "../../build/npm/scripts",
    emptyOutDir: false,
    modulePreload: false,
    assetsInlineLimit: 0,
    rollupOptions: {
      input: Object.fromEntries(
        Object.entries(kEntries[mode] ?? {}).map(([name, file]) => [name, fileURLToPath(new URL(file, import.meta.url))]),
      ),
      preserveEntrySignatures: "strict",
      external: [/^node:/],
      output: names,
    },
  },
  worker: { format: "es", plugins: () => [readableForBundlers()], rollupOptions: { output: { ...names, entryFileNames: "worker.js" } } },
  plugins: [readableForBundlers(), ...(mode === "element" ? [billOfMaterialsPlugin("svt-viewer-element")] : [])],
}));
