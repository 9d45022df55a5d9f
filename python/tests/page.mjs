// Opens a page of svt.Volume.page() in Chromium: a file, or the frame of a notebook. Prints the result as JSON.
//   node page.mjs FILE.html PICTURE.png
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { fileURLToPath, pathToFileURL } from "node:url";

const [file, picture] = process.argv.slice(2);
const viewer = fileURLToPath(new URL("../../web/viewer/package.json", import.meta.url));
const executablePath = process.env.SVT_CHROMIUM ?? "/usr/bin/chromium-headless-shell";
let chromium;
try {
  ({ chromium } = createRequire(viewer)("playwright-core"));
} catch {
  console.log("no playwright-core (make viewer installs it)");
  process.exit(77);
}
if (!existsSync(executablePath)) {
  console.log(`no Chromium at ${executablePath} (scripts/setup.sh web installs it)`);
  process.exit(77);
}

const browser = await chromium.launch({
  executablePath,
  args: ["--no-sandbox", "--disable-background-networking", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  timeout: 0,
});
try {
  const page = await browser.newPage({ viewport: { width: 1100, height: 700 }, locale: "en-US", colorScheme: "light" });
  const errors = [];
  const requests = [];
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("request", (request) => !request.url().startsWith("blob:") && requests.push(request.url()));
  await page.goto(pathToFileURL(file).href);
  const frame = page.frames()[1];
  const fine = () =>
    frame.waitForFunction(() => document.querySelector("svt-app")?.session.picture.quality === "fine", null, { timeout: 120_000 });
  await fine();
  // A cut, names that need the font, and the parts that load after the first picture.
  await frame.evaluate(() => {
    const { session } = document.querySelector("svt-app");
    session.view.set({ hide: ["class=BuildingRoom"], sections: [{ axis: "y", at: 4, flip: true, turn: 0, tilt: 0 }] });
  });
  await page.waitForTimeout(300);
  await fine();
  await frame.waitForFunction(() => customElements.get("wa-dialog") !== undefined, null, { timeout: 60_000 });
  await page.screenshot({ path: picture });
  const state = await frame.evaluate(() => {
    const isClosed = (() => {
      try {
        return parent.document === null;
      } catch {
        return true;
      }
    })();
    const { session } = document.querySelector("svt-app");
    return { name: session.volume.info.name, dimension: session.volume.info.dimension, origin: self.origin, isClosed };
  });
  const reach = await frame.evaluate(() =>
    fetch("https://example.org/").then(
      () => true,
      () => false,
    ),
  );
  console.log(JSON.stringify({ ...state, reach, requests, errors: errors.filter((text) => !text.includes("example.org")) }));
} finally {
  await browser.close();
}
