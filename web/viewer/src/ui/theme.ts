/** Dark or light: follows the system until the user chooses. */

export type Theme = "dark" | "light";
const kKey = "svt-theme";
const system = matchMedia("(prefers-color-scheme: dark)");

export function theme(): Theme {
  return document.documentElement.classList.contains("wa-dark") ? "dark" : "light";
}

function wanted(): Theme {
  const kept = stored();
  return kept ?? (system.matches ? "dark" : "light");
}

function stored(): Theme | null {
  try {
    const kept = localStorage.getItem(kKey);
    return kept === "dark" || kept === "light" ? kept : null;
  } catch {
    return null;
  }
}

function apply(now: Theme): void {
  document.documentElement.classList.toggle("wa-dark", now === "dark");
  document.documentElement.classList.toggle("wa-light", now === "light");
}

/** @param changed  called when the system theme changes and the user has not chosen one */
export function startTheme(changed: () => void): void {
  apply(wanted());
  system.addEventListener("change", () => {
    apply(wanted());
    changed();
  });
}

export function toggleTheme(): Theme {
  const now: Theme = theme() === "dark" ? "light" : "dark";
  apply(now);
  try {
    localStorage.setItem(kKey, now);
  } catch {
    // The choice then applies to this page only.
  }
  return now;
}
