/** Hatches of an SVG drawing as lines: browsers print each surface with a pattern as a large picture. */

const kSvg = "http://www.w3.org/2000/svg";

interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

/** Boxes of the rings of a path of absolute points; null: it has other commands. */
export function ringBoxes(path: string): Box[] | null {
  if (!/^[MLZ\d\s.,-]*$/.test(path)) return null;
  return path
    .split("M")
    .filter((ring) => /\d/.test(ring))
    .map((ring) => {
      const numbers = [...ring.matchAll(/-?[\d.]+/g)].map(Number);
      const [xs, ys] = [0, 1].map((axis) => numbers.filter((_, n) => n % 2 === axis)) as [number[], number[]];
      return { left: Math.min(...xs), top: Math.min(...ys), right: Math.max(...xs), bottom: Math.max(...ys) };
    });
}

/** Columns and rows of the tiles of a turned grid that may touch boxes. @param degrees  of the grid, as in rotate() */
export function tilesOver(boxes: readonly Box[], [width, height]: readonly [number, number], degrees: number): [number, number][] {
  const [cos, sin] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
  const found = new Map<string, [number, number]>();
  for (const { left, top, right, bottom } of boxes) {
    // The box as it is seen from the grid: its middle, and half of its extent along the axes of the grid.
    const [x, y] = [(left + right) / 2, (top + bottom) / 2];
    const [across, along] = [(right - left) / 2, (bottom - top) / 2];
    const [u, v] = [x * cos + y * sin, y * cos - x * sin];
    const [du, dv] = [across * Math.abs(cos) + along * Math.abs(sin), across * Math.abs(sin) + along * Math.abs(cos)];
    // Half of a tile, as it is seen from the box.
    const reach = [(Math.abs(width * cos) + Math.abs(height * sin)) / 2, (Math.abs(width * sin) + Math.abs(height * cos)) / 2] as const;
    for (let column = Math.floor((u - du) / width); column * width < u + du; ++column)
      for (let row = Math.floor((v - dv) / height); row * height < v + dv; ++row) {
        const [p, q] = [(column + 0.5) * width, (row + 0.5) * height];
        const away = [Math.abs(p * cos - q * sin - x), Math.abs(p * sin + q * cos - y)] as const;
        if (away[0] <= across + reach[0] && away[1] <= along + reach[1]) found.set(`${column} ${row}`, [column, row]);
      }
  }
  return [...found.values()];
}

/** The drawing with lines instead of patterns. A surface whose path is not made of points keeps its pattern. */
export function withTiles(drawing: string): string {
  // The policy of the page forbids styles in a document, but not in an image.
  const unstyled = drawing.replace(/<(\/?)style>/g, "<$1kept-style>").replaceAll(' style="', ' kept-style="');
  const document = new DOMParser().parseFromString(unstyled, "image/svg+xml");
  let clips = 0;
  const make = (name: string, attributes: Record<string, string>, children: readonly Node[] = []) => {
    const element = document.createElementNS(kSvg, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    element.append(...children);
    return element;
  };
  for (const pattern of document.querySelectorAll("pattern")) {
    const { id } = pattern;
    const side = (name: string) => Number(pattern.getAttribute(name));
    const turn = pattern.getAttribute("patternTransform") ?? "rotate(0)";
    const degrees = Number(/^rotate\((-?[\d.]+)\)$/.exec(turn)?.[1] ?? NaN);
    const ground = pattern.querySelector("rect")?.getAttribute("fill");
    if (!ground || !(side("width") > 0) || !(side("height") > 0) || Number.isNaN(degrees)) continue;
    const marks = [...pattern.children].filter((child) => child.localName !== "rect").map((child) => child.cloneNode(true));
    pattern.after(make("g", { id: `tile-${id}` }, marks));
    for (const surface of document.querySelectorAll(`path[fill="url(#${id})"]`)) {
      const path = surface.getAttribute("d") ?? "";
      const boxes = ringBoxes(path);
      if (!boxes) continue;
      const rule = surface.getAttribute("fill-rule") ?? "nonzero";
      const clip = make("clipPath", { id: `clip-${++clips}` }, [make("path", { d: path, "clip-rule": rule })]);
      const tiles = tilesOver(boxes, [side("width"), side("height")], degrees).map(([column, row]) =>
        make("use", { href: `#tile-${id}`, x: (column * side("width")).toFixed(3), y: (row * side("height")).toFixed(3) }),
      );
      surface.setAttribute("fill", ground);
      surface.after(clip, make("g", { "clip-path": `url(#clip-${clips})` }, [make("g", { transform: turn }, tiles)]));
    }
  }
  return new XMLSerializer().serializeToString(document).replaceAll("kept-style", "style");
}
