// What eslint holds against TypeScript and JavaScript of the whole tree; scripts/check.sh runs it from the root of the repository.
import eslint from "@eslint/js";
import tseslint from "typescript-eslint";

export default tseslint.config(
  { ignores: ["**/node_modules/", "build/", "web/viewer/src/generated/", "web/wasm/*.js", "web/npm/lib/*.js"] },
  { linterOptions: { reportUnusedDisableDirectives: "error" } },
  eslint.configs.recommended,
  tseslint.configs.recommended,
  {
    rules: {
      // tsc reports unknown names, of JavaScript too, and knows those of browser and Node.js.
      "no-undef": "off",
      // A parameter that an overridden function has, and this one does not need.
      "@typescript-eslint/no-unused-vars": ["error", { argsIgnorePattern: "^_" }],
      "@typescript-eslint/no-explicit-any": "error",
      eqeqeq: ["error", "always", { null: "ignore" }],
      "no-var": "error",
      "prefer-const": "error",
    },
  },
);
