/** File downloads, and text for the clipboard. */

const kKinds: Record<string, string> = {
  svg: "image/svg+xml", png: "image/png", csv: "text/csv", json: "application/json", geojson: "application/geo+json",
};

export function save(data: ArrayBuffer | string, name: string): void {
  const kind = kKinds[name.split(".").pop() ?? ""] ?? "application/octet-stream";
  const url = URL.createObjectURL(new Blob([data], { type: kind }));
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 30_000);
}

/** False if the browser does not allow it. */
export async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}
