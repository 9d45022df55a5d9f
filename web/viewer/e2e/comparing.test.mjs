// Two states of a building in the page: dropped, chosen and linked; the list, the switch, the way back; against `svt diff`.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { after, before, describe, it } from "node:test";
import { command, serve, svt, withModels } from "./harness.mjs";
import { scratch, Visit } from "./visit.mjs";

const { at, drop: dropFolder } = scratch("svt-comparing-test-");
const visit = new Visit();
const { inPage, state, settled, eventually, saved, until } = visit;
let server;
const open = (query = "?model=old", options = {}) => visit.open(server.url + query, options);
const panel = () => visit.page.locator("svt-changes");
/** The comparison of the page. */
const comparison = (body) => inPage(`(document.querySelector("svt-app").renderRoot.querySelector("svt-changes").comparison)${body}`);
const compared = () => panel().locator("#changes-summary").waitFor();
const lines = () => panel().locator("[role=option]");

before(async () => {
  svt("sample", "house", "-o", at("old.gml"));
  svt("sample", "house", "-o", at("new.gml"), "--change", "4");
  for (const name of ["old", "new"])
    svt("build", at(`${name}.gml`), "-o", at(`${name}.svt`), "--spacing", "0.2", "--vectors", "edges,meshes");
  server = await serve(
    withModels([
      { name: "old", path: at("old.svt"), title: "House as it was" },
      { name: "new", path: at("new.svt"), title: "House as it is" },
    ]),
  );
});
after(async () => {
  await visit.close();
  await server?.close();
  dropFolder();
});

/** Files dropped onto the right half of the page, which compares them. */
async function dropToCompare(...files) {
  await visit.page.evaluate(
    async (given) => {
      const transfer = new DataTransfer();
      for (const { name, base64, lastModified } of given) {
        const data = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
        transfer.items.add(new File([data], name, { lastModified }));
      }
      const options = { dataTransfer: transfer, bubbles: true, cancelable: true, clientX: innerWidth - 20 };
      for (const kind of ["dragover", "drop"]) window.dispatchEvent(new DragEvent(kind, options));
    },
    files.map(({ name, bytes, lastModified = 0 }) => ({ name, base64: bytes.toString("base64"), lastModified })),
  );
}

function diff(old, is) {
  const done = spawnSync(command, ["diff", at(old), at(is), "-q", "-o", at("diff.json"), "-o", at("diff.svt")]);
  assert.equal(done.status, 7, String(done.stderr));
  return { json: readFileSync(at("diff.json")), svt: readFileSync(at("diff.svt")) };
}

describe("comparing", () => {
  it("loads its module only for a comparison where the browser is to save data", async () => {
    const asked = [];
    await open();
    await visit.page.addInitScript(() => Object.defineProperty(navigator, "connection", { value: { saveData: true } }));
    await visit.page.reload();
    await visit.firstImage();
    visit.page.on("request", (request) => asked.push(request.url()));
    const isOfComparison = (url) => /svt_reports|reports_worker|changes_panel|quantities_panel/.test(url);
    await settled();
    await visit.page.waitForLoadState("networkidle");
    assert.deepEqual(asked.filter(isOfComparison), []);
    await visit.page.click("#compare");
    await panel().locator("#compare-is").selectOption("new");
    assert.ok(!asked.some((url) => /svt_reports/.test(url)));
    await panel().locator("#compare-run").click();
    await compared();
    assert.ok(asked.some((url) => /\/svt_reports-[^/]*\.wasm$/.test(url)));
  });

  it("compares a dropped model with the open one, and has the files of the command", async () => {
    await open();
    await dropToCompare({ name: "new.gml", bytes: readFileSync(at("new.gml")) });
    await compared();
    const expected = diff("old.svt", "new.gml");
    const json = await saved(() => panel().locator("#changes-save-json").click());
    assert.equal(json.name, "changes.json");
    assert.ok(json.bytes.equals(expected.json), "rows");
    const volume = await saved(() => panel().locator("#changes-save-svt").click());
    // The command adds both states behind the entries of the volume, so both are equal up to the central directory.
    const directory = volume.bytes.readUInt32LE(volume.bytes.length - 6);
    assert.ok(directory > 0 && volume.bytes.subarray(0, directory).equals(expected.svt.subarray(0, directory)), "volume");
    assert.equal(await inPage("s.volume.file"), "old_new.svt");
    await settled();
    await visit.shot("comparison-desktop");
    assert.deepEqual(visit.problems, []);
  });

  it("lists changes by m3, filters them, and goes to the object of a row", async () => {
    await open("?old=old&new=new");
    await compared();
    const { rows } = JSON.parse(diff("old.svt", "new.svt").json.toString());
    const m3 = ({ added, removed }) => (added ?? 0) + (removed ?? 0);
    const largest = rows
      .filter(({ geometry, change }) => geometry && !["same", "reassigned"].includes(change))
      .reduce((a, b) => (m3(b) > m3(a) ? b : a));
    const first = await lines().first().innerText();
    assert.ok(first.includes(largest.name || (largest.new[0] ?? largest.old[0])), first);
    const text = largest.removed > 0 ? `−${largest.removed.toFixed(4)} m³` : `+${largest.added.toFixed(4)} m³`;
    assert.ok(first.includes(text), `${first} has ${text}`);
    const all = Number(await panel().locator("#changes-list .line").first().getAttribute("aria-setsize"));
    const [kind] = (await panel().locator(".filters button").first().getAttribute("id")).split("-").slice(1);
    await panel().locator(`#kind-${kind}`).click();
    const n = rows.filter(({ change, attributes, properties }) =>
      kind === "same"
        ? change === kind && (Object.keys(attributes).length || Object.keys(properties).some((name) => name !== "id"))
        : change === kind,
    ).length;
    assert.equal(await panel().locator("#changes-count").innerText(), `${n} of ${all}`);
    await panel().locator(`#kind-${kind}`).click();
    const before = (await state()).camera;
    const removed = rows.find(({ change, geometry }) => change === "removed" && geometry);
    assert.ok(removed, "the sample removes an object");
    await panel()
      .locator("#changes-filter")
      .fill(removed.name || removed.old[0]);
    await panel().locator("#shown-new").click();
    await lines().first().click();
    await until(`s.view.state.selection.includes(${JSON.stringify(removed.old[0])})`);
    await eventually(async () => assert.notDeepEqual((await state()).camera, before));
    assert.equal(await comparison(".share"), 0.5, "what the new state does not have is shown with both");
    await panel().locator("#changes-filter").fill("nowhere at all");
    assert.equal(await lines().first().innerText(), "No change matches.");
  });

  it("shows the old state, the new one, or both; undo takes it back, and ends at the file before", async () => {
    await open();
    // A camera of the user, which is not fitted again when the panel makes the picture lower.
    await inPage("(s.view.set({ look: 'paper' }), s.view.turn({ ...s.view.state.camera, eye: [30, -20, 25] }))");
    await settled();
    const before = await state();
    await dropToCompare({ name: "new.svt", bytes: readFileSync(at("new.svt")) });
    await compared();
    const is = 'under "added" or id~"/added$"';
    await panel().locator("#shown-old").click();
    assert.deepEqual((await state()).styles, [{ select: is, opacity: 0 }]);
    await settled();
    await visit.shot("comparison-old");
    await visit.page.click("#undo");
    assert.deepEqual((await state()).styles, []);
    assert.equal(await panel().locator("#shown-both").getAttribute("aria-checked"), "true");
    assert.equal(await visit.page.locator("#undo").getAttribute("aria-label"), "Undo: Comparison");
    await visit.page.click("#undo");
    await until("s.volume.file === 'old.svt' && s.volume.name === 'old'");
    assert.deepEqual(await state(), before);
    await panel().locator("#changes-summary").waitFor({ state: "detached" });
    await eventually(async () => assert.ok(!/[?&](old|new)=/.test(visit.page.url()), visit.page.url()));
  });

  it("keeps the comparison in the address, with what is shown", async () => {
    await open("?old=old&new=new");
    await compared();
    await panel().locator("#shown-new").click();
    await settled();
    await eventually(async () => assert.match(visit.page.url(), /\?old=old&new=new#/));
    const address = await eventually(async () => {
      await inPage("s.address.write()");
      const url = visit.page.url();
      assert.match(url, /view=/);
      return url;
    });
    await visit.page.goto("about:blank");
    await visit.page.goto(address);
    await compared();
    assert.equal(await panel().locator("#shown-new").getAttribute("aria-checked"), "true");
    await panel().locator("#changes-back").click();
    await until("s.volume.file === 'old.svt'");
    // Files of this computer have no address: the page states which ones are missing.
    await visit.page.goto(`${server.url}?old=old&new=elsewhere.ifc`);
    await panel().getByText("This link compares old with elsewhere.ifc.").waitFor();
    assert.equal(await panel().locator("#compare-old").inputValue(), "old");
    assert.ok(await panel().locator("#compare-run").isDisabled());
  });

  it("takes two files without an open model, the older one as the old state", async () => {
    await open();
    const empty = await serve();
    await visit.page.goto(empty.url);
    await visit.page.getByRole("heading", { name: "Drop a building here" }).waitFor();
    await dropToCompare(
      { name: "b.gml", bytes: readFileSync(at("new.gml")), lastModified: 2000 },
      { name: "a.gml", bytes: readFileSync(at("old.gml")), lastModified: 1000 },
    );
    await compared();
    assert.deepEqual(await comparison(".names"), { old: "a.gml", is: "b.gml" });
    assert.ok(diff("old.gml", "new.gml").json.equals((await saved(() => panel().locator("#changes-save-json").click())).bytes));
    assert.equal(await panel().locator("#changes-back").count(), 0, "nothing was open before");
    await empty.close();
  });

  it("ends when another model is opened, which is then the old state", async () => {
    await open("?old=old&new=new");
    await compared();
    await visit.drop("own.svt", readFileSync(at("new.svt")));
    await until("s.volume.file === 'own.svt'");
    await panel().locator("#changes-summary").waitFor({ state: "detached" });
    await dropToCompare({ name: "new.gml", bytes: readFileSync(at("new.gml")) });
    await compared();
    assert.deepEqual(await comparison(".names"), { old: "own.svt", is: "new.gml" });
    assert.equal(await panel().locator("#changes-summary").innerText(), "own.svt and new.gml have no differences.");
    assert.equal(await panel().locator("#changes-back").innerText(), "Back to own.svt");
  });

  it("works by keyboard alone", async () => {
    await open();
    await visit.page.keyboard.press("Control+k");
    await visit.page.locator("svt-palette input:focus").waitFor();
    await visit.page.keyboard.type("compare with");
    await visit.page.keyboard.press("Enter");
    await panel().locator("#compare-is").waitFor();
    await panel().locator("#compare-is").focus();
    await visit.page.keyboard.type("House as it is");
    for (let n = 0; n < 20 && !(await panel().locator("#compare-run:focus").count()); ++n) await visit.page.keyboard.press("Tab");
    await visit.page.keyboard.press("Enter");
    await compared();
    await panel().locator("#changes-list").focus();
    await visit.page.keyboard.press("ArrowDown");
    await visit.page.keyboard.press("Enter");
    await until("s.view.state.selection.length > 0");
    assert.equal(await panel().locator(".line.active").getAttribute("aria-posinset"), "2");
  });

  it("gives reasons: empty, damaged and unreadable files, models apart, equal ones", async () => {
    await open();
    for (const { name, bytes, reason } of [
      { name: "empty.gml", bytes: Buffer.alloc(0), reason: /empty\.gml: the file is empty/ },
      { name: "noise.gml", bytes: Buffer.from("this is no XML"), reason: /noise\.gml.*\(E\d+\)/s },
      { name: "cut.svt", bytes: readFileSync(at("new.svt")).subarray(0, 4000), reason: /cut\.svt.*\(E\d+\)/s },
    ]) {
      await dropToCompare({ name, bytes });
      await eventually(async () => assert.match(await visit.page.locator("#message").innerText(), reason));
      assert.equal(await inPage("s.volume.file"), "old.svt");
      await visit.page.getByRole("button", { name: "Dismiss" }).click();
    }
    const shifted = readFileSync(at("new.gml"), "utf8").replace(
      /(<gml:(?:posList|lowerCorner|upperCorner|pos)[^>]*>)([^<]*)/g,
      (_, tag, text) => {
        const moved = text
          .trim()
          .split(/\s+/)
          .map((value, n) => (n % 3 === 0 ? String(Number(value) + 60) : value));
        return tag + moved.join(" ");
      },
    );
    await dropToCompare({ name: "apart.gml", bytes: Buffer.from(shifted) });
    await panel().getByText("The models do not overlap in space.").waitFor();
    await settled();
    await visit.shot("comparison-apart");
    await panel().locator("#changes-align").click();
    await panel().getByText("The new model is moved by (-60.0000; 0.0000; 0.0000) m").waitFor();
    await dropToCompare({ name: "same.svt", bytes: readFileSync(at("old.svt")) });
    await panel().getByRole("heading", { name: "old → same.svt" }).waitFor();
    assert.equal(await panel().locator("#changes-summary").innerText(), "old and same.svt have no differences.");
  });

  it("states that the module could not be loaded, and tries again", async () => {
    await open("?old=old&new=other");
    await visit.page.context().route(/svt_reports-/, (route) => route.abort());
    await visit.page.reload();
    await visit.firstImage();
    await panel().locator("#compare-is").selectOption("new");
    await panel().locator("#compare-run").click();
    await visit.message("cannot be loaded");
    await visit.page.context().unroute(/svt_reports-/);
    await panel().locator("#compare-run").click();
    await compared();
  });

  for (const { colorScheme, width, height, locale } of [
    { colorScheme: "light", width: 1440, height: 900, locale: "en-US" },
    { colorScheme: "dark", width: 1440, height: 900, locale: "de-DE" },
    { colorScheme: "light", width: 390, height: 844, locale: "de-DE" },
    { colorScheme: "dark", width: 390, height: 844, locale: "en-US" },
  ])
    it(`is accessible in ${colorScheme} at ${width} px`, async () => {
      await open("?old=old&new=other", { colorScheme, viewport: { width, height }, locale, hasTouch: width < 700 });
      await panel().locator("#compare-is").waitFor();
      await visit.page.waitForTimeout(300);
      await visit.shot(`choice-${colorScheme}-${width}`);
      const found = await visit.findings();
      await panel().locator("#compare-is").selectOption("new");
      await panel().locator("#compare-run").click();
      await compared();
      await lines().first().click();
      await settled();
      await visit.shot(`changes-${colorScheme}-${width}`);
      found.push(...(await visit.findings()));
      for (const summary of await panel().locator("summary").all()) await summary.click();
      await panel().locator("#changes-classes").scrollIntoViewIfNeeded();
      await visit.shot(`classes-${colorScheme}-${width}`);
      found.push(...(await visit.findings()));
      assert.deepEqual(found, []);
      if (width > 700) return;
      assert.deepEqual(await visit.tooSmall("svt-changes"), []);
    });
});
