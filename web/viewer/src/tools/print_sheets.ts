/** Sheets on paper, or as PDF: by the print dialog of the browser. */

import { t } from "../texts";
import { withTiles } from "./hatch_tiles";

/** Millimetres of a sheet, as its SVG states them. Null: it states none. */
export function paperOf(sheet: string): { width: number; height: number } | null {
  const side = (name: string) => Number(new RegExp(`<svg[^>]*\\s${name}="([\\d.]+)mm"`).exec(sheet)?.[1]);
  const [width, height] = [side("width"), side("height")];
  return width > 0 && height > 0 ? { width, height } : null;
}

/** A page of the sheet's size for each sheet, and nothing else of the page. */
export function printRules(sheets: readonly string[]): string {
  const pages = sheets.map((sheet, n) => {
    const paper = paperOf(sheet);
    const size = paper ? `${paper.width}mm ${paper.height}mm` : "A4 landscape";
    return `@page sheet-${n} { size: ${size}; margin: 0; } #printed > :nth-child(${n + 1}) { page: sheet-${n}; }`;
  });
  return `#printed { display: none; }
@media print {
  html, body { height: auto; overflow: visible; background: #fff; }
  body > :not(#printed) { display: none !important; }
  #printed { display: block; }
  #printed > img { display: block; width: 100vw; height: 100vh; object-fit: contain; break-after: page; break-inside: avoid; }
  #printed > img:last-child { break-after: auto; }
  ${pages.join("\n  ")}
}`;
}

let last = (): void => {};

/** Opens the print dialog. The sheets stay in the page, invisibly, until the next ones: some browsers print after the call. */
export async function printSheets(sheets: readonly string[]): Promise<void> {
  last();
  const addresses = sheets.map((sheet) => URL.createObjectURL(new Blob([withTiles(sheet)], { type: "image/svg+xml" })));
  const images = addresses.map((address, n) => Object.assign(new Image(), { src: address, alt: `${t("sheets")} ${n + 1}` }));
  const printed = document.createElement("div");
  printed.id = "printed";
  printed.append(...images);
  const rules = new CSSStyleSheet();
  rules.replaceSync(printRules(sheets));
  document.adoptedStyleSheets.push(rules);
  document.body.append(printed);
  last = () => {
    printed.remove();
    document.adoptedStyleSheets = document.adoptedStyleSheets.filter((other) => other !== rules);
    addresses.forEach((address) => URL.revokeObjectURL(address));
    last = () => {};
  };
  await Promise.all(images.map((image) => image.decode().catch(() => undefined)));
  window.print();
}
