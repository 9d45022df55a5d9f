/** The Web Awesome components used by the page; loaded after the first picture. */

import "@awesome.me/webawesome/dist/components/dialog/dialog.js";
import "@awesome.me/webawesome/dist/components/slider/slider.js";
import "@awesome.me/webawesome/dist/components/split-panel/split-panel.js";
import "@awesome.me/webawesome/dist/translations/de.js";
import { registerIconLibrary } from "@awesome.me/webawesome/dist/components/icon/library.js";

// Icons come from the page's own folder, never from other origins.
for (const library of ["default", "system"])
  registerIconLibrary(library, { resolver: (name: string) => new URL(`icons/${name}.svg`, document.baseURI).href });
