/** The page's icons: lines on a 24 x 24 grid, in the text colour. */

import { html, svg, type SVGTemplateResult, type TemplateResult } from "lit";

const kPaths = {
  tree: "M5 4v13h5M5 9h5M13 9h7M13 17h7M4 4h7",
  eye: "M2 12s3.6-6.5 10-6.5S22 12 22 12s-3.6 6.5-10 6.5S2 12 2 12Zm10 3a3 3 0 1 0 0-6 3 3 0 0 0 0 6Z",
  eyeOff:
    "M3 3l18 18M10 5.7c.6-.1 1.300-.2 2-.2 6.400 0 10 6.500 10 6.500a17 17 0 0 1-3.200 3.800M6.300 7.500A16 16 0 0 0 2 12s3.600 6.500 10 6.500c1.700 0 3.200-.4 4.500-1.100",
  eyePart: "M2 12s3.6-6.5 10-6.5S22 12 22 12M9 12a3 3 0 0 1 6 0",
  section: "M3 8l9-5 9 5v8l-9 5-9-5V8Zm0 0l18 8",
  lens: "M10.500 17a6.500 6.500 0 1 0 0-13 6.500 6.500 0 0 0 0 13ZM15.300 15.300 21 21M6 10.500h9",
  focus: "M4 8V4h4M16 4h4v4M20 16v4h-4M8 20H4v-4M9 12a3 3 0 1 0 6 0 3 3 0 0 0-6 0",
  look: "M12 3a9 9 0 1 0 0 18c1.500 0 2-1 1.500-2.200-.6-1.500.3-2.800 2-2.800H18a3 3 0 0 0 3-3.200C20.600 7.200 16.700 3 12 3ZM7.500 12h.01M9.500 8h.01M14.500 7.500h.01",
  measure: "M3 16 16 3l5 5L8 21l-5-5Zm3.500-3.500 2 2M9.500 9.500l2 2M12.500 6.500l2 2",
  view: "M12 3 4 7.500v9L12 21l8-4.500v-9L12 3Zm0 0v9m0 9v-9m0 0L4 7.500M12 12l8-4.500",
  share: "M12 15V3m0 0L8 7m4-4 4 4M5 12v8h14v-8",
  open: "M3 19V5h6l2 3h10v11H3Z",
  help: "M12 21a9 9 0 1 0 0-18 9 9 0 0 0 0 18ZM9.500 9.500a2.500 2.500 0 1 1 3.500 2.300c-.7.3-1 .8-1 1.700M12 17h.01",
  play: "M7 4v16l13-8Z",
  pause: "M7 5v14M17 5v14",
  sun: "M12 16a4 4 0 1 0 0-8 4 4 0 0 0 0 8ZM12 2v2M12 20v2M2 12h2M20 12h2M4.900 4.900l1.400 1.400M17.700 17.700l1.400 1.400M4.900 19.100l1.400-1.400M17.700 6.300l1.400-1.400",
  moon: "M20 14.500A8.500 8.500 0 0 1 9.500 4 8.500 8.500 0 1 0 20 14.500Z",
  close: "M6 6l12 12M18 6 6 18",
  right: "M9 5l7 7-7 7",
  down: "M5 9l7 7 7-7",
  plus: "M12 5v14M5 12h14",
  bin: "M4 7h16M9 7V4h6v3M6.500 7l1 13h9l1-13",
  flip: "M12 3v18M8 7l-5 5 5 5M16 7l5 5-5 5",
  pin: "M9 4h6l-1 6 3 3H7l3-3-1-6ZM12 13v8",
  info: "M12 21a9 9 0 1 0 0-18 9 9 0 0 0 0 18ZM12 11v6M12 7.500h.01",
  search: "M10.500 17a6.500 6.500 0 1 0 0-13 6.500 6.500 0 0 0 0 13ZM15.300 15.300 21 21",
  fit: "M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5",
  walk: "M13 5.500a1.500 1.500 0 1 0 0-3 1.500 1.500 0 0 0 0 3ZM8 21l2.500-6L9 12l2-4 3 1 1.500 3 3 1M10.500 15l3 2 .5 4",
  copy: "M8 8h12v12H8zM4 16V4h12",
  image: "M3 5h18v14H3zM3 16l5-5 4 4 3-3 6 6M15.500 9.500h.01",
  bookmark: "M6 3h12v18l-6-4.500L6 21V3Z",
  code: "M8 7l-5 5 5 5M16 7l5 5-5 5",
  target: "M12 20a8 8 0 1 0 0-16 8 8 0 0 0 0 16ZM12 2v4M12 18v4M2 12h4M18 12h4",
  undo: "M9 14 4 9l5-5M4 9h10a6 6 0 0 1 0 12h-3",
  redo: "M15 14l5-5-5-5M20 9H10a6 6 0 0 0 0 12h3",
  up: "M12 19V5M6 11l6-6 6 6",
  only: "M12 15a3 3 0 1 0 0-6 3 3 0 0 0 0 6ZM4 4l3 3M20 4l-3 3M4 20l3-3M20 20l-3-3",
  table: "M3 5h18v14H3ZM3 10h18M3 14.500h18M9 5v14",
  sum: "M18 5H6l6 7-6 7h12",
  four: "M3 4h18v16H3ZM12 4v16M3 12h18",
  menu: "M4 7h16M4 12h16M4 17h16",
  parallel: "M4 8l8-5 8 5v8l-8 5-8-5ZM4 8l8 5 8-5M12 13v8",
  rectangle: "M3 8V4h4M10 4h4M17 4h4v4M21 11v2M3 11v4M3 17v3h4M10 20h2M14 14l7 3-3 1-1 3Z",
  previous: "M15 5l-7 7 7 7",
  building: "M5 21V4h14v17M2 21h20M9 8h2M13 8h2M9 12h2M13 12h2M10 21v-5h4v5",
  storey: "M3 17l9 4 9-4M3 12l9 4 9-4M3 7l9 4 9-4-9-4-9 4Z",
  unit: "M4 4h16v16H4ZM4 13h9M13 4v16",
  room: "M4 20V4h16v16h-7M4 20h4M8 20a5 5 0 0 1 5-5v5",
  window: "M5 3h14v18H5ZM12 3v18M5 12h14",
  door: "M6 21V3h12v18M3 21h18M14.500 12h.01",
  roof: "M2 13 12 4l10 9M6 12v8h12v-8",
  stair: "M3 20h4v-4h4v-4h4V8h4V4h2",
  wall: "M3 5h18v14H3ZM3 9.700h18M3 14.300h18M9 5v4.700M15 9.700v4.600M9 14.300V19",
  slab: "M2 12l10-5 10 5-10 5-10-5ZM2 12v3l10 5 10-5v-3",
  beam: "M6 4h12M6 20h12M12 4v16",
  furniture: "M6 4v9h12V4M4 11v6h16v-6M6 17v3M18 17v3",
  pipe: "M3 9h8a4 4 0 0 1 4 4v8M3 5h10a6 6 0 0 1 6 6v10",
  part: "M12 3 4 7.500v9L12 21l8-4.500v-9L12 3Z",
} as const;

export type IconName = keyof typeof kPaths;

export function icon(name: IconName, size = 20): TemplateResult {
  return html`<svg viewBox="0 0 24 24" width=${size} height=${size} fill="none" stroke="currentColor" stroke-width="1.6" stroke-linecap="round" stroke-linejoin="round" aria-hidden="true">${pathOf(name)}</svg>`;
}

export function pathOf(name: IconName): SVGTemplateResult {
  return svg`<path d=${kPaths[name]}></path>`;
}
