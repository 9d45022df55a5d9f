// The built documentation site in a browser: accessible in light and dark, small, on its own host, searchable; pictures open in the viewer.
// Each check is also run on a damaged page, on which it must fail.
import assert from "node:assert/strict";
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { endBrowser, newContext, repository } from "../../web/viewer/e2e/harness.mjs";
import { serveSite } from "./site_server.mjs";

const site = process.env.SVT_SITE ?? join(repository, "build/site");
/** Looks only at pages whose address matches; default: all. */
const only = new RegExp(process.env.SVT_SITE_PAGES ?? "");
const kMostBytes = 300_000;
const axe = readFileSync(join(repository, "web/viewer/node_modules/axe-core/axe.min.js"), "utf8");

/** The addresses of all pages in a folder of the site. */
function pagesIn(folder = "") {
  return readdirSync(join(site, folder), { withFileTypes: true })
    .flatMap((entry) => {
      const path = `${folder}${entry.name}`;
      if (["cpp", "live", "assets", "search"].includes(path)) return [];
      return entry.isDirectory() ? pagesIn(`${path}/`) : entry.name === "index.html" ? [folder] : [];
    })
    .sort();
}

/** Pages of Doxygen: the lists, and a part of the others, which have the same parts. */
function pagesOfCpp() {
  const all = readdirSync(join(site, "cpp")).filter((name) => name.endsWith(".html") && !name.startsWith("search"));
  const lists = ["index", "annotated", "files", "namespaces", "classes", "functions", "functions_vars", "globals", "namespacemembers"];
  return [...lists.map((name) => `${name}.html`), ...all.filter((_, number) => number % 150 === 0)].map((name) => `cpp/${name}`);
}

/** Calls work(item, page) for all items, with several pages at once. */
async function withPages(items, options, work) {
  const waiting = [...items];
  await Promise.all(
    Array.from({ length: 3 }, async () => {
      const context = await newContext({ reducedMotion: "reduce", ...options });
      const page = await context.newPage();
      for (let item = waiting.shift(); item !== undefined; item = waiting.shift()) await work(item, page);
      await context.close();
    }),
  );
}

/** What axe finds on the open page. */
async function accessFindings(page) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => globalThis.axe.run(document, { resultTypes: ["violations"], iframes: false }));
  return violations.map(
    (found) =>
      `${found.id}: ${found.nodes
        .map((node) => node.target.flat().join(" "))
        .slice(0, 3)
        .join(" | ")}`,
  );
}

/** Opens a page and scrolls to its end. Resolves to the bytes that it transferred, and to the addresses on other hosts. */
async function loaded(page, url) {
  let bytes = 0;
  const foreign = [];
  const count = (response) => {
    if (!response.url().startsWith(new URL(url).origin)) return;
    bytes += Number(response.headers()["content-length"] ?? 0);
  };
  const ask = (request) => {
    if (!request.url().startsWith(new URL(url).origin) && !/^(data|blob):/.test(request.url())) foreign.push(request.url());
  };
  page.on("response", count).on("request", ask);
  await page.goto(url, { waitUntil: "load" });
  await page.evaluate(async () => {
    for (const picture of document.images) {
      picture.loading = "eager";
      await picture.decode().catch(() => {});
    }
  });
  await page.waitForLoadState("networkidle");
  page.off("response", count).off("request", ask);
  return { bytes, foreign };
}

/** Opens a live picture of a page, and waits for its finest picture. Resolves to the frame and the error that the viewer shows, or null. */
async function opened(page, url, number) {
  await page.goto(url, { waitUntil: "load" });
  await page.locator(".svt-live__open").nth(number).click();
  const frame = await (await page.locator(".svt-live iframe").elementHandle()).contentFrame();
  await frame.waitForFunction(() => document.querySelector("svt-app")?.session?.picture?.quality === "fine");
  const error = await frame.evaluate(() => {
    const { message } = document.querySelector("svt-app").session.messages;
    return message?.isError ? message.text : null;
  });
  return { frame, error };
}

describe("site", () => {
  let server;
  const all = existsSync(site) ? [...pagesIn(), ...pagesOfCpp()] : [];
  const pages = all.filter((path) => only.test(path));
  before(async () => {
    assert.ok(all.length > 200, `${site} has ${all.length} pages; 'make site' builds them`);
    server = await serveSite(site);
  });
  after(async () => {
    await server?.close();
    await endBrowser();
  });

  for (const colorScheme of ["light", "dark"])
    it(`has nothing that axe finds, ${colorScheme}`, async () => {
      const found = [];
      await withPages(pages, { colorScheme }, async (path, page) => {
        await page.goto(server.url + path, { waitUntil: "load" });
        for (const finding of await accessFindings(page)) found.push(`${path}: ${finding}`);
      });
      assert.deepEqual(found, []);
    });

  it("transfers less than 300 kB for each page, and asks no other host", async () => {
    const large = [];
    const foreign = [];
    await withPages(pages, {}, async (path, page) => {
      const { bytes, foreign: others } = await loaded(page, server.url + path);
      if (bytes > kMostBytes) large.push(`${path}: ${bytes} bytes`);
      foreign.push(...others.map((address) => `${path}: ${address}`));
    });
    assert.deepEqual(large, []);
    assert.deepEqual(foreign, []);
  });

  it("fits on a phone", async () => {
    const wide = [];
    await withPages(pages, { viewport: { width: 390, height: 844 }, isMobile: true }, async (path, page) => {
      await page.goto(server.url + path, { waitUntil: "load" });
      const width = await page.evaluate(() => document.documentElement.scrollWidth);
      if (width > 392) wide.push(`${path}: ${width} pixels`);
    });
    assert.deepEqual(wide, []);
  });

  it("finds words, and loads the index only then", async () => {
    const context = await newContext();
    const page = await context.newPage();
    const asked = [];
    page.on("request", (request) => asked.push(request.url()));
    await page.goto(server.url, { waitUntil: "networkidle" });
    assert.ok(!asked.some((address) => address.includes("search_index")), "the index is not loaded with the page");
    await page.fill("[name=query]", "cutaway");
    await page.locator(".md-search-result__item a").first().waitFor();
    assert.ok(asked.some((address) => address.includes("search_index")));
    await context.close();
  });

  it("remembers the chosen colours, in the C++ API as well", async () => {
    const context = await newContext({ colorScheme: "light" });
    const page = await context.newPage();
    await page.goto(server.url, { waitUntil: "load" });
    await page.locator("label[title='Switch to dark colours']").click();
    await page.goto(`${server.url}cpp/index.html`, { waitUntil: "load" });
    assert.equal(await page.evaluate(() => document.documentElement.className), "dark-mode");
    await context.close();
  });

  it("opens each picture of the gallery in the viewer", { timeout: 600_000 }, async () => {
    const context = await newContext({ viewport: { width: 1280, height: 900 }, locale: "en-US" });
    const page = await context.newPage();
    page.setDefaultTimeout(240_000);
    for (const path of ["", "gallery/"]) {
      await page.goto(server.url + path, { waitUntil: "load" });
      const count = await page.locator(".svt-live").count();
      assert.ok(count > 0, `${path}: there are live pictures`);
      for (let number = 0; number < count; ++number) {
        const { frame, error } = await opened(page, server.url + path, number);
        assert.equal(error, null, `${path} picture ${number}`);
        const isChanged = await frame.evaluate(() => {
          const { hide, show, sections, styles, effect, camera } = document.querySelector("svt-app").session.view.state;
          return hide.length + show.length + sections.length + styles.length > 0 || effect !== "none" || camera !== null;
        });
        assert.ok(isChanged, `${path} picture ${number} has the state of its link`);
        if (process.env.SVT_SITE_PICTURES)
          await page
            .locator(".svt-live iframe")
            .screenshot({ path: join(process.env.SVT_SITE_PICTURES, `live-${path.slice(0, -1)}${number}.png`) });
      }
    }
    await context.close();
  });
});

describe("the checks of the site", () => {
  const damaged = (/** @type {string} */ html) =>
    `<!doctype html><html lang="en"><head><title>Damaged</title></head><body><main><h1>Damaged</h1>${html}</main></body></html>`;
  let server, context, page;
  before(async () => {
    server = await serveSite(site, {
      "planted/picture.html": damaged('<img src="x.webp">'),
      "planted/pale.html": damaged('<p style="color: #ccc; background: #fff">pale</p>'),
      "planted/large.html": damaged(`<p>${Array.from({ length: 80_000 }, () => Math.random().toString(36)).join(" ")}</p>`),
      "planted/live.html": damaged(
        '<div class="svt-live"><img alt="house" src="../assets/logo.svg"><a class="svt-live__link" href="../live/?model=house#view=damaged">Open</a></div><script src="../assets/site.js"></script>',
      ),
      "planted/foreign.html": damaged('<img alt="foreign" src="http://127.0.0.2:9/x.png">'),
    });
    context = await newContext();
    page = await context.newPage();
  });
  after(async () => {
    await context.close();
    await server.close();
    await endBrowser();
  });

  it("find a picture without text, and pale text", async () => {
    await page.goto(`${server.url}planted/picture.html`);
    assert.match((await accessFindings(page)).join(), /image-alt/);
    await page.goto(`${server.url}planted/pale.html`);
    assert.match((await accessFindings(page)).join(), /color-contrast/);
  });
  it("find a link to the viewer that is damaged", { timeout: 300_000 }, async () => {
    page.setDefaultTimeout(240_000);
    assert.notEqual((await opened(page, `${server.url}planted/live.html`, 0)).error, null);
  });
  it("find a large page", async () => {
    assert.ok((await loaded(page, `${server.url}planted/large.html`)).bytes > kMostBytes);
  });
  it("find a picture of another host", async () => {
    assert.deepEqual((await loaded(page, `${server.url}planted/foreign.html`)).foreign, ["http://127.0.0.2:9/x.png"]);
  });
});
