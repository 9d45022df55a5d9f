// A visit of the built page in a browser, for tests: its page, and what tests do again and again.
import { mkdirSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before } from "node:test";
import { endBrowser, newContext, repository, serve, svt, withModels } from "./harness.mjs";

/** Ends what hangs; no measure of speed: machines may be slow, and do other work besides. */
export const kHang = 240_000;
after(endBrowser);

/** A folder for files of a test; drop() removes it. */
export function scratch(prefix) {
  const folder = mkdtempSync(join(tmpdir(), prefix));
  return { at: (name) => join(folder, name), drop: () => rmSync(folder, { recursive: true, force: true }) };
}

/** What the tests of a file share: a folder for files, the generated house in it as model and volume, and the page with that volume. */
export function withHouse(name) {
  const { at, drop } = scratch(`svt-${name}-test-`);
  const visit = new Visit();
  let server;
  before(async () => {
    svt("sample", "house", "-o", at("house.gml"));
    svt("build", at("house.gml"), "-o", at("house.svt"), "--spacing", "0.12", "--vectors", "edges,meshes");
    server = await serve(withModels([{ name: "house", path: at("house.svt"), title: "Sample house" }]));
  });
  after(async () => {
    await visit.close();
    await server?.close();
    drop();
  });
  return {
    at,
    visit,
    address: (query = "?model=house") => server.url + query,
    open: (query = "?model=house", options = {}) => visit.open(server.url + query, options),
  };
}

export class Visit {
  page = null;
  problems = [];

  /** A new visitor at an address, at the first image. */
  open = async (url, options = {}) => {
    await this.begin(options);
    await this.page.goto(url);
    await this.firstImage();
  };
  /** A new visitor with an empty page, to whom nothing is animated: so it is known where a view ends. */
  begin = async (options = {}) => {
    await this.close();
    const context = await newContext({
      locale: "en-US",
      colorScheme: "light",
      reducedMotion: "reduce",
      permissions: ["clipboard-read", "clipboard-write"],
      ...options,
    });
    context.setDefaultTimeout(kHang);
    const page = (this.page = await context.newPage());
    this.problems = [];
    page.on("pageerror", (error) => this.problems.push(`error: ${error.message}`));
    page.on(
      "console",
      (message) => ["error", "warning"].includes(message.type()) && this.problems.push(`${message.type()}: ${message.text()}`),
    );
    page.on(
      "request",
      (request) => !/^(http:\/\/127\.0\.0\.1:|blob:|data:)/.test(request.url()) && this.problems.push(`asks ${request.url()}`),
    );
  };
  close = async () => {
    await this.page
      ?.context()
      .close()
      .catch(() => {});
    this.page = null;
  };

  /** In the page, with its session as `s`. */
  inPage = (body, value) =>
    this.page.evaluate(
      ([text, v]) => new Function("s", "v", `return (async () => (${text}))()`)(document.querySelector("svt-app").session, v),
      [body, value],
    );
  state = () => this.inPage("s.view.state");
  firstImage = () => this.page.waitForFunction(() => performance.getEntriesByName("svt-first-image").length > 0);
  /** The finest picture stands there, with the faces of the model if they can be drawn, and no movement of the camera is about to begin. */
  settled = () =>
    this.page.waitForFunction(() => {
      const { picture, view, volume } = document.querySelector("svt-app").session;
      const mayHaveFaces = volume.info?.hasMeshes && !volume.isCity && !volume.isServerOnly;
      return globalThis.svtAwaitedCameras === 0 && picture.quality === "fine" && (view.hasFaces !== null || !mayHaveFaces);
    });
  /** Where the picture is. */
  stage = () => this.page.locator("svt-picture").boundingBox();
  /** Waits until an expression of the session `s` holds. */
  until = (body) =>
    // Asked again and again by the debugger, since the page's policy allows no eval of its own.
    this.eventually(async () => {
      if (!(await this.inPage(`Boolean(${body})`))) throw new Error(`does not hold: ${body}`);
    });
  tool = async (name) => {
    if (!(await this.page.locator(`#tool-${name}[aria-expanded=true]`).count())) await this.page.click(`#tool-${name}`);
  };
  /** Tries again until it holds: what depends on a picture takes as long as the machine needs. */
  eventually = async (check) => {
    for (const end = Date.now() + kHang; ; await this.page.waitForTimeout(50)) {
      try {
        return await check();
      } catch (error) {
        if (Date.now() > end) throw error;
      }
    }
  };
  /** Files chosen as by the button with the folder. */
  choose = (...files) =>
    this.page
      .locator("#file")
      .setInputFiles(files.map(({ name, bytes }) => ({ name, mimeType: "application/octet-stream", buffer: bytes })));
  /** A file dropped onto the page. */
  drop = (name, bytes) =>
    this.page.evaluate(
      async ([fileName, base64]) => {
        const data = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
        const transfer = new DataTransfer();
        transfer.items.add(new File([data], fileName));
        for (const kind of ["dragover", "drop"])
          window.dispatchEvent(new DragEvent(kind, { dataTransfer: transfer, bubbles: true, cancelable: true }));
      },
      [name, bytes.toString("base64")],
    );
  /** A picture of the page, if SVT_SHOTS names a folder. */
  shot = async (name) => {
    const folder = process.env.SVT_SHOTS;
    if (!folder) return;
    mkdirSync(folder, { recursive: true });
    await this.page.screenshot({ path: join(folder, `${name}.png`) });
  };
  /** Serious findings of axe in the page. */
  findings = async () => {
    // Evaluated by the debugger, since the page's policy allows no foreign script.
    await this.page.evaluate(readFileSync(join(repository, "web/viewer/node_modules/axe-core/axe.min.js"), "utf8"));
    const { violations } = await this.page.evaluate(() => globalThis.axe.run(document, { resultTypes: ["violations"] }));
    // A page with several models has a choice in the place of its heading, which axe finds less serious.
    const serious = violations.filter((v) => ["serious", "critical"].includes(v.impact));
    return serious.map((v) => `${v.id}: ${v.nodes.map((n) => n.target.flat().join(" ")).join(" | ")}`);
  };
  /** Controls of a part of the page that are too small for fingers. */
  tooSmall = (name) =>
    this.page.evaluate((part) => {
      const root = document.querySelector("svt-app").renderRoot.querySelector(part).renderRoot;
      return [...root.querySelectorAll("button, select, summary, input:not([type=checkbox], [hidden])")]
        .map((e) => ({ id: e.id || e.textContent, ...e.getBoundingClientRect().toJSON() }))
        .filter((e) => e.height > 0 && e.height < 44)
        .map((e) => `${e.id}: ${e.height}`);
    }, name);
  message = (text) => this.page.locator("#message").getByText(text).waitFor();
  /** What a click saves. */
  saved = async (click) => {
    const [download] = await Promise.all([this.page.waitForEvent("download"), click()]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  };
}
