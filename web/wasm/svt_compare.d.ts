/** The types of svt_compare.js are those of svt.js. Its calls are those of web/wasm/compare.cpp. */
export * from "./svt.js";
export { default } from "./svt.js";
