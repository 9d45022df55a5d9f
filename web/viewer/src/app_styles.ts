/** Layout of the page on large and small screens. */

import { css } from "lit";

export const appStyles = css`
  :host { display: grid; grid-template-rows: auto 1fr; height: 100dvh; overflow: hidden; }
  header { display: flex; align-items: center; gap: 6px; padding: 6px 10px; border-bottom: 1px solid var(--line); background: var(--panel); min-width: 0; position: relative; z-index: 6; }
  .brand { display: flex; align-items: center; gap: 8px; font-weight: 650; letter-spacing: 0.01em; margin-right: 6px; color: var(--text); }
  .brand svg { color: var(--accent); }
  .title { flex: 1; min-width: 0; display: flex; align-items: center; gap: 8px; }
  .title h1 { margin: 0; font-size: 14px; font-weight: 600; overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
  .title .quiet { overflow: hidden; text-overflow: ellipsis; white-space: nowrap; min-width: 0; }
  .title select { max-width: 260px; font-weight: 600; }
  header button.bare { min-width: 36px; min-height: 36px; }
  main { position: relative; min-height: 0; min-width: 0; overflow: hidden; }
  wa-split-panel { position: absolute; inset: 0; --divider-width: 1px; --divider-hit-area: 12px; --min: 200px; --max: 50%; --wa-color-surface-border: var(--line); }
  /* The future layout, until the component has loaded and measured itself: half a pixel of the divider belongs to the side. */
  wa-split-panel { --first: 309.5px; --second: minmax(0, 1fr); }
  wa-split-panel[position-in-pixels="260"] { --first: 259.5px; }
  wa-split-panel[position-in-pixels="420"] { --first: 419.5px; }
  wa-split-panel[primary="end"] { --first: minmax(0, 1fr); --second: 319.5px; }
  wa-split-panel[primary="end"][position-in-pixels="420"] { --second: 419.5px; }
  wa-split-panel:not(:defined) { display: grid; grid-template: minmax(0, 1fr) / var(--first) var(--second); column-gap: 1px; }
  /* A splitter inside another one has no width when it begins, and its share of it is infinite until the next frame. */
  wa-split-panel[position="Infinity"] { grid-template-columns: var(--first) 1px var(--second) !important; }
  wa-split-panel::part(divider) { background: var(--line); }
  wa-split-panel::part(divider):focus-visible { outline: 2px solid var(--focus); background: var(--focus); }
  .side { height: 100%; min-width: 0; overflow: hidden; background: var(--panel); }
  .column { display: flex; flex-direction: column; }
  .column nav, .column aside { flex: 1 1 0; min-height: 0; }
  .column > * + * { border-top: 1px solid var(--line-strong); }
  .middle { position: relative; height: 100%; min-width: 0; overflow: hidden; }
  /* The tools are below the four views. */
  svt-section-panes { position: absolute; inset: 0 0 80px; }
  .four svt-picture { position: absolute; left: 0; top: 0; width: 50%; height: calc(50% - 40px); }
  .four .status { right: calc(50% + 12px); }
  .sheet { position: absolute; left: 0; right: 0; bottom: 0; height: 62%; background: var(--panel); border-top: 1px solid var(--line); border-radius: 14px 14px 0 0; box-shadow: var(--shadow); z-index: 5; overflow: hidden; display: grid; grid-template: auto 1fr / minmax(0, 1fr); }
  .sheet > .bar { display: flex; justify-content: space-between; align-items: center; padding: 4px 6px 4px 14px; border-bottom: 1px solid var(--line); }
  .sheet > :last-child { min-height: 0; }
  .table { position: absolute; left: 0; right: 0; bottom: 0; height: 45%; border-top: 1px solid var(--line-strong); background: var(--panel); z-index: 5; }
  .with-table > wa-split-panel, .with-table > .middle { position: absolute; inset: 0 0 45%; height: auto; }
  .dock { position: absolute; left: 50%; bottom: 12px; transform: translateX(-50%); display: flex; gap: 2px; padding: 4px; border: 1px solid var(--line); border-radius: 14px; background: var(--panel); box-shadow: var(--shadow); z-index: 4; max-width: calc(100% - 12px); }
  .dock button { flex-direction: column; gap: 2px; font-size: 11px; padding: 5px 8px; min-width: 56px; border-color: transparent; background: transparent; border-radius: 10px; position: relative; }
  .dock button:hover { background: var(--hover); }
  .dock button[aria-expanded="true"] { background: var(--accent-soft); color: var(--accent-text); }
  .dock button.used::after { content: ""; position: absolute; top: 4px; right: 8px; width: 7px; height: 7px; border-radius: 50%; background: var(--accent); }
  .card { min-height: 0; overflow: auto; padding: 12px 14px 14px; background: var(--panel); font-size: 13px; }
  .column .card { flex: 0 1 auto; max-height: 66%; }
  .column .card:only-child { max-height: none; }
  .column nav + .card { max-height: 50%; }
  .column nav + .card:has(+ aside) { max-height: 36%; }
  .card > .bar { display: flex; justify-content: space-between; align-items: center; margin-bottom: 6px; }
  .corner { position: absolute; right: 10px; top: 46px; display: grid; gap: 8px; z-index: 2; max-width: 46%; justify-items: end; }
  .status { position: absolute; right: 12px; top: 8px; font-size: 11px; color: var(--stage-quiet); z-index: 1; font-variant-numeric: tabular-nums; pointer-events: none; text-align: right; }
  /* Above the tools: titles are at the top of the picture, legends at its right. */
  .message { position: absolute; left: 50%; bottom: 84px; transform: translateX(-50%); max-width: min(560px, calc(100% - 24px)); padding: 10px 8px 10px 14px; border-radius: 12px; border: 1px solid var(--line); background: var(--panel); box-shadow: var(--shadow); z-index: 8; display: flex; gap: 10px; align-items: start; font-size: 13px; line-height: 1.45; }
  .message .repair { display: block; margin-top: 6px; }
  .message.bad { border-color: var(--error); }
  .message div { overflow-wrap: anywhere; max-height: 40vh; overflow: auto; }
  .progress { position: absolute; inset: 0; display: grid; place-items: center; z-index: 7; pointer-events: none; }
  .progress > div { width: min(320px, calc(100% - 40px)); padding: 16px 18px; border-radius: 14px; background: var(--panel); border: 1px solid var(--line); box-shadow: var(--shadow); font-size: 13px; display: grid; gap: 8px; }
  .progress button { pointer-events: auto; justify-self: end; }
  .progress.low { place-items: end center; padding-bottom: 84px; }
  /* As high as its button, which comes later. */
  .progress .above { display: flex; justify-content: space-between; align-items: center; min-height: 44px; }
  .arriving { display: flex; min-height: 20px; align-items: center; gap: 10px; font-variant-numeric: tabular-nums; }
  .arriving span { min-width: 4ch; text-align: end; }
  .preview { position: absolute; inset: 0; width: 100%; height: 100%; object-fit: contain; background: #fff; filter: var(--preview, none); pointer-events: none; }
  progress { width: 100%; height: 6px; accent-color: var(--accent); }
  .dropping { position: absolute; inset: 10px; border: 3px dashed var(--accent); border-radius: 18px; display: grid; place-items: center; background: color-mix(in srgb, var(--panel) 75%, transparent); font-size: 20px; font-weight: 600; z-index: 9; pointer-events: none; }
  .dropping.half { right: calc(50% + 5px); }
  .dropping.at-end { left: calc(50% + 5px); right: 10px; }
  .dropping.off { border-color: var(--line-strong); font-weight: 400; }
  .skip { position: absolute; left: 8px; top: -60px; z-index: 20; }
  .skip:focus { top: 6px; }
  .note { padding: 6px 10px; border: 1px solid var(--line); border-radius: 10px; background: var(--panel); font-size: 12px; display: grid; gap: 6px; max-width: 300px; }
  @media (min-width: 2600px) {
    header, .dock, .card { zoom: 1.35; }
    svt-tree, svt-properties { font-size: 16px; }
  }
  @media (max-width: 759px) {
    main { grid-template: minmax(0, 1fr) auto auto / minmax(0, 1fr); }
    .message { position: static; transform: none; max-width: none; border-radius: 0; border-width: 1px 0 0; order: 3; }
    .message div { max-height: 20vh; }
    .table { position: static; height: 50dvh; }
    .with-table > .middle { position: relative; inset: auto; }
    .brand, .title .quiet, .status { display: none; }
    main { display: grid; }
    main > .middle { display: grid; grid-template-rows: minmax(0, 1fr) auto auto; }
    /* Over the picture only. */
    svt-aim, .preview, svt-section-panes, svt-walk-pad { grid-area: 1 / 1 / 2 / 2; }
    svt-section-panes { inset: 0; }
    .four svt-picture { position: relative; height: 50%; }
    .dock, .sheet { position: static; transform: none; max-width: none; width: auto; border-radius: 0; border-width: 1px 0 0; box-shadow: none; }
    .dock { order: 2; justify-content: space-between; }
    .dock button { min-width: 0; padding: 5px 2px; flex: 1; font-size: 10.5px; overflow: hidden; }
    .card { order: 1; max-height: 42dvh; border-top: 1px solid var(--line); }
    .sheet { height: 50dvh; position: relative; grid-template-rows: minmax(0, 1fr); --sheet-close: 48px; }
    .sheet > .bar { position: absolute; right: 0; top: 0; padding: 10px 6px; border: 0; z-index: 1; }
    .sheet h2 { position: absolute; clip-path: inset(50%); }
    main:has(> .sheet) svt-view-cube { display: none; }
    header { padding: 4px; gap: 0; }
    header button.bare { min-width: 44px; min-height: 44px; }
    .dock button { min-height: 48px; }
    .card, .sheet { overflow-x: hidden; }
    .note { max-width: min(300px, 80vw); }
  }
  @media (max-width: 479px) {
    header { flex-wrap: wrap; justify-content: space-between; }
    /* The list of actions has them. */
    #theme, #table, #four, #quantities, #compare { display: none; }
    .title { flex-basis: 100%; padding-left: 6px; }
    .title select { max-width: 100%; }
    header .languages { width: auto; }
  }
  @media (max-width: 759px) and (max-height: 480px) {
    .card { max-height: 55dvh; }
    .sheet { height: 60dvh; }
    .dock button span { display: none; }
  }
`;
