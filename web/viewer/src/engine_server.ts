/**
 * Engine for browsers that cannot run the library, with a server that draws (`svt serve`, POST /api/picture): pictures
 * only. Functions that need the volume in the page are rejected with a clear error.
 */

import { callsBy, type Engine, type EngineError, type Scene } from "./engine";

const kNotHere: EngineError = { code: "E904", message: "only pictures come from the server" };

/** The engine, or null without such a server. */
export async function createServerEngine(canvas: HTMLCanvasElement): Promise<Engine | null> {
  // The context type used by the engine in the worker: a canvas can have only one.
  const screen = canvas.getContext("bitmaprenderer");
  if (!screen) return null;
  let model = "";
  const drawn = async (scene: Scene): Promise<Blob> => {
    const response = await fetch("api/picture", {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify({ model, scene }),
    });
    if (response.ok) return response.blob();
    const error = (await response.json().catch(() => null)) as EngineError | null;
    throw error ?? { code: "E999", message: `the server answers ${response.status}` };
  };
  const probe = await fetch("api/picture", { method: "POST", headers: { "Content-Type": "application/json" }, body: "{}" }).catch(
    () => null,
  );
  if (!probe || probe.status === 404 || probe.status === 405 || probe.status === 501) return null;

  const refuse = () => Promise.reject(kNotHere);
  return {
    ...callsBy(refuse),
    kind: "cpu",
    threads: 1,
    async open([file]) {
      const fileName = file!.name;
      model = fileName.replace(/\.[^.]+$/, "");
      return {
        name: fileName,
        source: fileName,
        crs: "",
        dimension: [2, 2, 2],
        spacing: [1, 1, 1],
        origin: [0, 0, 0],
        size: [10, 10, 10],
        storeys: [],
        spacingReason: "",
        details: 0,
        attributes: [],
        features: [],
        hasEdges: true,
        hasMeshes: false,
        findings: [],
      };
    },
    async draw(scene, width, height) {
      const start = performance.now();
      const bitmap = await createImageBitmap(await drawn({ ...scene, size: [width, height] }));
      screen.transferFromImageBitmap(bitmap);
      return { width, height, milliseconds: performance.now() - start, engine: "cpu" };
    },
    cancel: () => undefined,
    close: () => undefined,
    cancelRefining: () => undefined,
    refine: refuse,
    openCity: refuse,
    followCity: refuse,
    findInCity: refuse,
    searchCity: refuse,
    drawCity: refuse,
    compose: (scene) => Promise.resolve(scene),
    pick: () => Promise.resolve(null),
    along: () => Promise.resolve([]),
    findInAttributes: () => Promise.resolve([]),
    attributeValues: () => Promise.resolve({ values: [], unit: "" }),
    picture: async (scene) => (await drawn(scene)).arrayBuffer(),
    step: (eye) => Promise.resolve(eye),
    movedPlanes: () => Promise.resolve([]),
  };
}
