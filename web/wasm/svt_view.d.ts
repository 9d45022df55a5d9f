/** The types of svt_view.js are those of svt.js. Calls that read models or make drawings and sheets fail with E904. */
export * from "./svt.js";
export { default } from "./svt.js";
