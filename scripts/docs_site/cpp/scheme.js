// The colours of these pages are those that the reader chose on the other pages of the site, else those of the system.
"use strict";
{
  const root = new URL("..", document.currentScript.src).pathname;
  let chosen = null;
  try {
    chosen = JSON.parse(localStorage.getItem(`${root}.__palette`));
  } catch {
    chosen = null; // no storage, or other content
  }
  const scheme = chosen?.color?.scheme ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "slate" : "default");
  document.documentElement.classList.add(scheme === "slate" ? "dark-mode" : "light-mode");
}
