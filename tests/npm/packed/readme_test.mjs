// The examples of the packages' READMEs and of the manual work as they are written.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, rmSync } from "node:fs";
import { before, describe, it } from "node:test";
import { browserPath, repository } from "../../../web/viewer/e2e/harness.mjs";
import { at, eventually, kElement, makeHouse, put, serve, Visitor } from "./site.mjs";

/** The blocks of a language in a page. */
const blocks = (text, language) => [...text.matchAll(new RegExp(`^\`\`\`${language}\\n([^]*?)^\`\`\``, "gm"))].map((match) => match[1]);
const readme = (name) => readFileSync(at(`node_modules/@semantic-volume-texture/${name}/README.md`), "utf8");

before(makeHouse);

describe("examples", () => {
  it("of the library run in Node.js", () => {
    const found = blocks(readme("svt"), "js");
    assert.equal(found.length, 2);
    for (const name of ["house.png", "plan.svg"]) rmSync(at(name), { force: true });
    found.forEach((code, n) => put(`readme${n}.mjs`, code));
    assert.ok(Number(execFileSync(process.execPath, ["readme0.mjs"], { cwd: at(""), encoding: "utf8" })) > 1);
    assert.ok(existsSync(at("house.png")) && readFileSync(at("plan.svg"), "utf8").includes("<svg"));
    assert.match(execFileSync(process.execPath, ["readme1.mjs"], { cwd: at(""), encoding: "utf8" }), /^0 id,class,name/);
  });
});

describe("pages", { skip: existsSync(browserPath) ? false : "chromium is missing (scripts/setup.sh web)" }, () => {
  const visitor = new Visitor();

  it("of the element show the house", async () => {
    const manual = readFileSync(`${repository}/docs/user/web-component.md`, "utf8");
    const found = [...blocks(readme("viewer"), "html"), ...blocks(manual, "html")];
    assert.equal(found.length, 3);
    const site = await serve();
    for (const html of found) {
      const script = html.includes("dist/svt-viewer.js") ? "" : `<script type="module" src="${kElement}"></script>`;
      put("page.html", `<!doctype html><link rel="icon" href="data:,">${script}${html}`);
      await visitor.visit(`${site.url}page.html`);
      await visitor.page.waitForFunction(() => /** @type {any} */ (document.querySelector("svt-viewer")).loaded);
      const box = await visitor.page.locator("svt-viewer").boundingBox();
      assert.ok(box.width > 900 && box.height > 400, JSON.stringify(box));
      assert.deepEqual(visitor.problems, []);
    }
    // The last one writes the name of a clicked part.
    const box = await visitor.page.locator("svt-viewer").boundingBox();
    await visitor.page.mouse.click(box.x + box.width / 2 + 40, box.y + box.height / 2);
    await eventually(async () => assert.match(await visitor.page.locator("#name").innerText(), /^\w+:/));
    await site.close();
  });
});
