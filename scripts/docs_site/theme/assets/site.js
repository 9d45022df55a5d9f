// Pictures of the gallery open in the viewer: a button over the picture replaces it by the published page.
// Tables and code that are wider than the page can be scrolled by keyboard.
"use strict";
function makeScrollable() {
  for (const box of document.querySelectorAll(".svt-table, .md-typeset pre > code"))
    if (box.scrollWidth > box.clientWidth) box.tabIndex = 0;
    else box.removeAttribute("tabindex");
}
makeScrollable();
window.addEventListener("resize", makeScrollable);

for (const place of document.querySelectorAll(".svt-live")) {
  const link = place.querySelector(".svt-live__link");
  const picture = place.querySelector("img");
  if (!link || !picture) continue;
  const button = document.createElement("button");
  button.type = "button";
  button.className = "svt-live__open";
  button.append(...link.childNodes);
  button.addEventListener("click", () => {
    const frame = document.createElement("iframe");
    frame.src = link.href;
    frame.title = `Viewer: ${picture.alt}`;
    frame.allow = "fullscreen";
    place.replaceChildren(frame);
    frame.focus();
  });
  link.replaceWith(button);
}
