import type { Plugin } from "vite";
import { billOfMaterials, componentsOfModules, npmComponents, ownVersion } from "./sbom.mjs";

/** Writes what a bundle holds of others, with versions: the packages whose files were read for it, and the libraries of the modules. */
export function billOfMaterialsPlugin(name: string): Plugin {
  return {
    name: "bill-of-materials",
    apply: "build",
    generateBundle() {
      const components = [
        ...npmComponents(this.getModuleIds()),
        ...componentsOfModules().filter((component) => component.name !== "cli11"),
      ];
      this.emitFile({ type: "asset", fileName: "sbom.cdx.json", source: billOfMaterials(name, ownVersion(), components) });
    },
  };
}
