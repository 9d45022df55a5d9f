/** The types of svt_reports.js are those of svt.js. Its calls are those of web/wasm/reports. */
export * from "./svt.js";
export { default } from "./svt.js";
