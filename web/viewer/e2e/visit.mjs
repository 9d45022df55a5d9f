// A visit of the built page in a browser, for tests: its page, and what tests do again and again.
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { browse } from "./harness.mjs";

/** A folder for files of a test; drop() removes it. */
export function scratch(prefix) {
  const folder = mkdtempSync(join(tmpdir(), prefix));
  return { at: (name) => join(folder, name), drop: () => rmSync(folder, { recursive: true, force: true }) };
}

export class Visit {
  page = null;
  problems = [];
  #browser = null;

  /** A new browser at an address, at its first image. */
  async open(url, options = {}) {
    await this.close();
    this.#browser = await browse({ locale: "en-US", colorScheme: "light", permissions: ["clipboard-read", "clipboard-write"], ...options });
    const page = (this.page = await this.#browser.context.newPage());
    this.problems = [];
    page.on("pageerror", (error) => this.problems.push(`error: ${error.message}`));
    page.on(
      "console",
      (message) => ["error", "warning"].includes(message.type()) && this.problems.push(`${message.type()}: ${message.text()}`),
    );
    await page.goto(url);
    await this.firstImage();
  }
  async close() {
    await this.page
      ?.context()
      .close()
      .catch(() => {});
    await this.#browser?.close().catch(() => {});
    this.page = this.#browser = null;
  }

  /** In the page, with its session as `s`. */
  inPage(body, value) {
    return this.page.evaluate(
      ([text, v]) => new Function("s", "v", `return (async () => (${text}))()`)(document.querySelector("svt-app").session, v),
      [body, value],
    );
  }
  state() {
    return this.inPage("s.state");
  }
  firstImage() {
    return this.page.waitForFunction(() => performance.getEntriesByName("svt-first-image").length > 0, null, { timeout: 60_000 });
  }
  /** The finest picture of what is shown now stands there. */
  settled(timeout = 90_000) {
    return this.page.waitForFunction(() => document.querySelector("svt-app").session.quality === "fine", null, { timeout });
  }
  /** Waits until an expression of the session `s` holds. */
  async until(body, timeout = 60_000) {
    // Asked again and again by the debugger, since the page's policy allows no eval of its own.
    await this.eventually(async () => {
      if (!(await this.inPage(`Boolean(${body})`))) throw new Error(`does not hold: ${body}`);
    }, timeout / 1000);
  }
  async tool(name) {
    if (!(await this.page.locator(`#tool-${name}[aria-expanded=true]`).count())) await this.page.click(`#tool-${name}`);
  }
  /** Tries again until it holds. */
  async eventually(check, seconds = 30) {
    for (const end = Date.now() + seconds * 1000; ; await this.page.waitForTimeout(50)) {
      try {
        return await check();
      } catch (error) {
        if (Date.now() > end) throw error;
      }
    }
  }
  /** Files chosen as by the button with the folder. */
  choose(...files) {
    return this.page
      .locator("#file")
      .setInputFiles(files.map(({ name, bytes }) => ({ name, mimeType: "application/octet-stream", buffer: bytes })));
  }
  message(text) {
    return this.page.locator("#message").getByText(text).waitFor({ timeout: 30_000 });
  }
  /** What a click saves. */
  async saved(click) {
    const [download] = await Promise.all([this.page.waitForEvent("download"), click()]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  }
}
