// The built page for all people: issue lists (BCF), links, languages, fingers, keys, zoom, screen readers.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { serve, svt, withModels } from "./harness.mjs";
import { scratch, Visit } from "./visit.mjs";

const { at, drop } = scratch("svt-people-test-");
const visit = new Visit();
const inPage = (body, value) => visit.inPage(body, value);
let server;

before(async () => {
  svt("sample", "house", "--format", "ifc", "-o", at("house.ifc"));
  svt("build", at("house.ifc"), "-o", at("house.svt"), "--spacing", "0.12", "--vectors", "edges,meshes");
  server = await serve({
    ...withModels([{ name: "house", path: at("house.svt"), title: "Sample house" }]),
    "languages/index.json": {
      languages: [
        { code: "tlh", name: "tlhIngan Hol" },
        { code: "../x", name: "Bad" },
        { code: "eo", name: "Esperanto" },
      ],
    },
    "languages/tlh.json": {
      texts: { addPlane: "beQ chenmoH", section: "pe'", found: "{n} tu'", view_front: 7 },
      classes: { Window: "Qorwagh" },
    },
    "languages/eo.json": { texts: 4 },
  });
  await visit.open(`${server.url}?model=house`);
});
after(async () => {
  await visit.close();
  await server?.close();
  drop();
});

describe("BCF 3.0", () => {
  const kView = {
    hide: ["class=BuildingRoom"],
    sections: [
      { axis: "y", at: 5, flip: true, turn: 45, tilt: 0 },
      { axis: "free", at: 6, flip: false, turn: 30, tilt: 20 },
    ],
  };

  it("takes views out as topics that keep to the schemas, and back in as they were", async (t) => {
    const [wall, door] = await inPage(
      "Promise.all(['IfcWall', 'IfcDoor'].map(async (type) => (await s.volume.engine.select('class=' + type))[0]))",
    );
    await inPage("s.view.set(v)", { ...kView, selection: [wall], styles: [{ select: `id="${door}"`, color: "#ff0080" }] });
    await visit.tool("share");
    await visit.page.click("#keep-view");
    await inPage(
      "(async () => { await s.view.goTo('', 'top'); const c = s.view.state.camera; s.view.turn({ ...c, parallel: true, height: 17.5 }); s.view.set({ hide: [], show: [v], sections: [], styles: [] }); })()",
      `id="${wall}"`,
    );
    const list = visit.page.locator("svt-bookmark-list li");
    await visit.eventually(async () => assert.equal(await list.count(), 1));
    await visit.page.click("#keep-view");
    await visit.eventually(async () => assert.equal(await list.count(), 2));
    await visit.page.getByRole("button", { name: "Comment and status of View 1" }).click();
    await visit.page.getByRole("textbox", { name: "Comment", exact: true }).fill("The lintel <is> missing");
    await visit.page.getByRole("textbox", { name: "Author", exact: true }).fill("Ada");
    await visit.page.getByRole("combobox", { name: "Status", exact: true }).selectOption("In Progress");
    const kept = await inPage(
      "document.querySelector('svt-app').shadowRoot.querySelector('svt-share-tool').shadowRoot.querySelector('svt-bookmark-list').views",
    );
    const { name, bytes } = await visit.saved(() => visit.page.click("#export-bcf"));
    assert.equal(name, "views.bcf");
    const folder = at("bcf");
    mkdirSync(folder);
    writeFileSync(at("views.bcf"), bytes);
    execFileSync("python3", ["-m", "zipfile", "-e", at("views.bcf"), folder]);
    const names = execFileSync("find", [folder, "-type", "f", "-printf", "%P\n"], { encoding: "utf8" }).trim().split("\n").sort();
    assert.equal(names.filter((n) => n.endsWith("/markup.bcf")).length, 2);
    assert.equal(names.filter((n) => n.endsWith("/snapshot.png")).length, 2);
    assert.ok(names.includes("bcf.version") && names.includes("extensions.xml"));
    for (const snapshot of names.filter((n) => n.endsWith("/snapshot.png"))) {
      const png = readFileSync(join(folder, snapshot));
      assert.deepEqual([png.readUInt32BE(16), png.readUInt32BE(20)], [1280, 720], "pictures for reading, not for a list");
    }
    const topics = names.filter((n) => n.endsWith("/markup.bcf")).map((n) => readFileSync(join(folder, n), "utf8"));
    const commented = topics.find((xml) => xml.includes("<Comments>"));
    assert.match(
      commented,
      /TopicStatus="In Progress".*<CreationAuthor>Ada<.*<Author>Ada<.*<Comment>The lintel &#60;is&#62; missing<\/Comment>/,
    );
    assert.match(readFileSync(join(folder, "extensions.xml"), "utf8"), /<TopicStatus>In Progress<.*<User>Ada</);
    // With the schemas of buildingSMART (BCF-XML, release 3.0) at hand, by them.
    const schemas = process.env.SVT_BCF_SCHEMAS ?? "";
    const kinds = [
      ["bcf.version", "version"],
      ["extensions.xml", "extensions"],
      [/markup\.bcf$/, "markup"],
      [/\.bcfv$/, "visinfo"],
    ];
    if (existsSync(join(schemas, "markup.xsd")))
      for (const file of names)
        for (const [pattern, schema] of kinds) {
          if (!(pattern instanceof RegExp ? pattern.test(file) : file === pattern)) continue;
          const checked = spawnSync("xmllint", ["--noout", "--schema", join(schemas, `${schema}.xsd`), join(folder, file)], {
            encoding: "utf8",
          });
          assert.equal(checked.status, 0, `${file}: ${checked.stderr}`);
        }
    else t.diagnostic("not held against the schemas: SVT_BCF_SCHEMAS names no folder with markup.xsd");
    // Where things are: in coordinates of the model.
    const info = await inPage("s.volume.info");
    const views = names.filter((n) => n.endsWith(".bcfv")).map((n) => readFileSync(join(folder, n), "utf8"));
    const numbers = (xml, tag) => [...new RegExp(`<${tag}><X>([^<]*)</X><Y>([^<]*)</Y><Z>([^<]*)</Z>`).exec(xml).slice(1)].map(Number);
    const first = views.find((xml) => xml.includes("ClippingPlane")),
      second = views.find((xml) => xml.includes("OrthogonalCamera"));
    numbers(first, "CameraViewPoint").forEach((value, i) =>
      assert.ok(Math.abs(value - kept[0].state.camera.eye[i] - info.origin[i]) < 1e-6),
    );
    // The first plane takes away what lies before y = 5: its direction points there.
    numbers(first, "Direction").forEach((value, i) => assert.ok(Math.abs(value - [0, -1, 0][i]) < 1e-9));
    assert.ok(Math.abs(numbers(first, "Location")[1] - info.origin[1] - 5) < 1e-6);
    assert.ok(first.includes(`<Selection><Component IfcGuid="${wall}"/>`) && first.includes('Color="FF0080"'));
    assert.match(second, /<ViewToWorldScale>17\.5</);
    // Back.
    for (let n = 0; n < 2; ++n)
      await visit.page
        .getByRole("button", { name: /^Remove View/ })
        .first()
        .click();
    await visit.page.locator("#views-file").setInputFiles({ name: "views.bcf", mimeType: "application/octet-stream", buffer: bytes });
    await visit.message("2 bookmarks added");
    const back = await inPage(
      "document.querySelector('svt-app').shadowRoot.querySelector('svt-share-tool').shadowRoot.querySelector('svt-bookmark-list').views",
    );
    assert.deepEqual(
      back.map((view) => view.name),
      kept.map((view) => view.name),
    );
    assert.deepEqual(
      ["comment", "author", "status"].map((key) => back[0][key]),
      ["The lintel <is> missing", "Ada", "In Progress"],
    );
    for (const [n, { state }] of back.entries()) {
      const was = kept[n].state;
      state.camera.eye.forEach((value, i) => assert.ok(Math.abs(value - was.camera.eye[i]) < 1e-6));
      assert.equal(state.camera.parallel, was.camera.parallel);
      assert.deepEqual(state.selection, was.selection);
      const seen = (queries) =>
        inPage(
          "(async () => { const all = new Set(); for (const q of v) for (const id of await s.volume.engine.select(q)) all.add(id); return [...all].sort(); })()",
          queries,
        );
      if (n === 0) {
        assert.deepEqual(await seen(state.hide), (await seen(was.hide)).filter(Boolean));
        for (const [i, section] of state.sections.entries())
          for (const key of ["at", "turn", "tilt"])
            if (section.axis === "free" || key === "at")
              assert.ok(
                Math.abs(section[key] - was.sections[i][key]) < 1e-5,
                `${key} of plane ${i}: ${section[key]}, was ${was.sections[i][key]}`,
              );
        assert.deepEqual(
          state.sections.map(({ axis, flip }) => [axis, flip]),
          was.sections.map(({ axis, flip }) => [axis, flip]),
        );
        assert.deepEqual(
          state.styles.map(({ color }) => color),
          ["#ff0080"],
        );
      } else assert.deepEqual(state.show, was.show);
    }
    assert.ok(back.every(({ picture }) => picture.startsWith("data:image/png")));
  });

  it("says what is missing, and what is no BCF", async () => {
    const guid = "0123456789ABCDEFGHIJ$_";
    const xml = (text) => `<?xml version="1.0"?>${text}`;
    mkdirSync(at("foreign/t"), { recursive: true });
    writeFileSync(
      at("foreign/t/markup.bcf"),
      xml(
        `<Markup><Topic Guid="x" TopicType="a" TopicStatus="b"><Title>From elsewhere</Title><Viewpoints><ViewPoint Guid="y"><Viewpoint>v.bcfv</Viewpoint></ViewPoint></Viewpoints></Topic></Markup>`,
      ),
    );
    writeFileSync(
      at("foreign/t/v.bcfv"),
      xml(
        `<VisualizationInfo Guid="y"><Components><Selection><Component IfcGuid="${guid}"/></Selection><Visibility DefaultVisibility="true"/></Components><PerspectiveCamera><CameraViewPoint><X>1</X><Y>2</Y><Z>3</Z></CameraViewPoint><CameraDirection><X>0</X><Y>1</Y><Z>0</Z></CameraDirection><CameraUpVector><X>0</X><Y>0</Y><Z>1</Z></CameraUpVector><FieldOfView>60</FieldOfView><AspectRatio>1</AspectRatio></PerspectiveCamera></VisualizationInfo>`,
      ),
    );
    // Deflated, as other programs do.
    execFileSync("python3", [
      "-c",
      "import sys, zipfile; z = zipfile.ZipFile(sys.argv[1], 'w', zipfile.ZIP_DEFLATED); [z.write(sys.argv[2] + '/t/' + n, 't/' + n) for n in ('markup.bcf', 'v.bcfv')]; z.close()",
      at("foreign.bcfzip"),
      at("foreign"),
    ]);
    await visit.page.locator("#views-file").setInputFiles(at("foreign.bcfzip"));
    await visit.message("1 components of the file are not in this model");
    await visit.page.locator("svt-bookmark-list button.go[aria-label='From elsewhere']").waitFor();
    await visit.page
      .locator("#views-file")
      .setInputFiles({ name: "noise.bcf", mimeType: "application/octet-stream", buffer: Buffer.from("noise") });
    await visit.message("noise.bcf is not a readable BCF file");
  });
});

describe("links that cannot be made good", () => {
  it("say so", async () => {
    await visit.tool("share");
    await visit.page.click("#copy-link");
    await visit.message("The address works only on this computer");
    await visit.page.goto("about:blank");
    await visit.page.goto(`${server.url}?model=house#view=damaged`);
    await visit.firstImage();
    await visit.message("The link is damaged");
    await visit.page.goto("about:blank");
    await visit.page.goto(`${server.url}?model=gone`);
    await visit.firstImage();
    await visit.message("There is no model 'gone' here");
  });
});

describe("languages", () => {
  it("come from files, which may be incomplete or bad; search and numbers follow", async () => {
    await visit.open(`${server.url}?model=house`);
    const choice = visit.page.locator("#languages");
    await choice.waitFor();
    assert.deepEqual(await choice.locator("option").evaluateAll((options) => options.map((option) => option.value)), [
      "en",
      "de",
      "tlh",
      "eo",
    ]);
    await choice.selectOption("tlh");
    await visit.tool("section");
    await visit.page.getByRole("button", { name: "beQ chenmoH" }).waitFor();
    assert.equal(await visit.page.evaluate(() => document.documentElement.lang), "tlh");
    assert.equal(await visit.page.locator("#tool-section span").innerText(), "pe'");
    assert.equal(await visit.page.locator("#tool-lens span").innerText(), "Lens", "what is missing is English");
    const windows = (await inPage("s.volume.engine.select('class=IfcWindow or class=WindowPhase')")).length;
    await visit.page.fill("#search", "qorwagh");
    await visit.eventually(async () =>
      assert.equal(await visit.page.locator("svt-tree [role=status]").first().innerText(), `${windows} tu'`),
    );
    await visit.page.fill("#search", "");
    await choice.selectOption("eo");
    await visit.message("languages/eo.json");
    assert.equal(await inPage("s.languages.current"), "tlh");
    await choice.selectOption("de");
    await visit.until("s.languages.current === 'de'");
    const [id] = await inPage("s.volume.engine.select('class=IfcDoor')");
    await inPage("s.selection.select([v])", id);
    await visit.until("s.selection.properties");
    const properties = await inPage("s.selection.properties");
    // The attributes come with a later script.
    await visit.eventually(async () => {
      const text = (await visit.page.locator("svt-properties dl, svt-properties table").allInnerTexts()).join("\n");
      assert.ok(text.includes(`${properties.surface.toFixed(2).replace(".", ",")} m²`), text);
      for (const [key, { value }] of Object.entries(properties.numbers)) {
        const digits = Math.min(6, /\.(\d+)/.exec(properties.attributes[key])?.[1].length ?? 0);
        const expected = value.toLocaleString("de", { minimumFractionDigits: digits, maximumFractionDigits: digits });
        assert.ok(text.includes(expected), `${key}: ${expected} in ${text}`);
      }
    });
    await visit.tool("share");
    await visit.page.click("#keep-view");
    const title = await visit.page.locator("svt-bookmark-list li input").first().getAttribute("title");
    assert.match(title, /^\d\d\.\d\d\.\d{4}$|^\d{1,2}\. \p{L}+\.? \d{4}$/u);
    assert.deepEqual(visit.problems, []);
  });

  it("are those that the address and the browser ask for", async () => {
    await visit.open(`${server.url}?model=house&language=tlh`);
    await visit.until("s.languages.current === 'tlh'");
    await visit.open(`${server.url}?model=house`, { locale: "de-DE" });
    await visit.page.getByRole("tab", { name: "Aufbau" }).waitFor();
  });
});

describe("fingers", () => {
  const kTools = ["section", "lens", "focus", "look", "measure", "views", "share"];
  /** Controls that are seen: their sizes, and where they reach. */
  const targets = () =>
    visit.page.evaluate(() => {
      const found = [];
      const walk = (root) => {
        for (const e of root.querySelectorAll("*")) {
          if (e.shadowRoot) walk(e.shadowRoot);
          // Of foreign parts, sliders: what a finger may move them by.
          const isOwn =
            !e.getRootNode().host?.localName.startsWith("wa-") &&
            e.matches("button, select, input:not([type=checkbox], [type=file], [type=hidden]), label.check, a[href]");
          if (!isOwn && !e.matches("[part~=slider]")) continue;
          const box = e.getBoundingClientRect();
          if (!box.width || !box.height || e.matches(".skip, .twist") || !e.checkVisibility()) continue;
          found.push({
            what: `${e.localName}#${e.id}.${e.className} ${e.getAttribute("aria-label") ?? e.textContent.trim().slice(0, 20)}`,
            width: box.width,
            height: box.height,
            left: box.left,
            right: box.right,
          });
        }
      };
      walk(document);
      return found;
    });

  for (const width of [360, 390])
    it(`reach everything at ${width} px: targets of 44 px, nothing beyond the border`, async () => {
      await visit.open(`${server.url}?model=house`, { hasTouch: true, isMobile: true, viewport: { width, height: 760 } });
      const bad = new Set();
      const check = async (where) => {
        for (const { what, width: w, height: h, left, right } of await targets()) {
          if (w < 43.5 || h < 43.5) bad.add(`${where}: ${what} is ${w.toFixed(0)} x ${h.toFixed(0)}`);
          if (left < -1 || right > width + 1) bad.add(`${where}: ${what} reaches from ${left.toFixed(0)} to ${right.toFixed(0)}`);
        }
        const over = await visit.page.evaluate(() => document.documentElement.scrollWidth);
        if (over > width) bad.add(`${where}: the page is ${over} px wide`);
      };
      await check("page");
      for (const name of kTools) {
        await visit.tool(name);
        if (name === "section") await visit.page.click("#add-plane");
        if (name === "look") {
          await visit.page.click("#basemap");
          await visit.page.locator("#basemap-show").waitFor();
          await visit.inPage("s.view.set({ colorBy: 'class' })");
          // The legend is legible, and leaves more than half of the picture free.
          const legend = await visit.page.locator("#color-scale li").first();
          await legend.waitFor();
          assert.ok((await legend.evaluate((e) => parseFloat(getComputedStyle(e).fontSize))) >= 12);
          const [box, picture] = [await visit.page.locator("svt-color-legend").boundingBox(), await visit.stage()];
          assert.ok(box.width < picture.width / 2 && box.x + box.width <= picture.x + picture.width, "beside the model");
        }
        await visit.page.waitForTimeout(80);
        await check(name);
        await visit.inPage("s.view.set({ colorBy: '' })");
        await visit.page.click(`#tool-${name}`);
      }
      await visit.page.getByRole("button", { name: "Show or hide: Parts" }).click();
      await visit.page.waitForTimeout(80);
      await check("parts");
      // The list reaches its last row.
      await visit.page.evaluate(() => {
        const list = document.querySelector("svt-app").shadowRoot.querySelector("svt-tree").shadowRoot.querySelector(".list");
        list.scrollTop = list.scrollHeight;
      });
      const last = visit.page.locator("[role=treeitem]").last();
      await last.click();
      await visit.until("s.view.state.selection.length === 1");
      const sheet = await visit.page.locator(".sheet").boundingBox();
      assert.ok(sheet.x >= 0 && sheet.x + sheet.width <= width + 0.5);
      await visit.page.getByRole("button", { name: "Show or hide: Selection" }).click();
      await check("selection");
      assert.deepEqual([...bad], []);
    });

  it("and eyes at 200 %: each control can be brought into view", async () => {
    // A screen of 1280 x 720 at 200 % has 640 x 360 CSS pixels.
    await visit.open(`${server.url}?model=house`, { viewport: { width: 640, height: 360 }, deviceScaleFactor: 2 });
    for (const name of kTools) {
      await visit.tool(name);
      await visit.page.waitForTimeout(80);
      const unreached = await visit.page.evaluate(async () => {
        const bad = [];
        const card = document.querySelector("svt-app").shadowRoot.querySelector("#card");
        const all = [];
        const walk = (root) => {
          for (const e of root.querySelectorAll("*")) {
            if (e.shadowRoot) walk(e.shadowRoot);
            if (
              e.matches("button, select, input:not([type=file], [type=hidden])") &&
              e.checkVisibility() &&
              !e.getRootNode().host?.localName.startsWith("wa-")
            )
              all.push(e);
          }
        };
        walk(card);
        for (const e of all) {
          e.scrollIntoView({ block: "nearest" });
          const box = e.getBoundingClientRect();
          const hit = document.elementFromPoint(box.left + box.width / 2, box.top + box.height / 2);
          if (!hit || box.bottom > innerHeight + 1 || box.right > innerWidth + 1 || box.left < -1 || box.top < -1)
            bad.push(`${e.id || e.textContent} ${JSON.stringify(box)}`);
        }
        return bad;
      });
      assert.deepEqual(unreached, [], name);
      await visit.page.click(`#tool-${name}`);
    }
    const stage = await visit.page.locator("svt-picture").boundingBox();
    assert.ok(stage.height > 120, `the picture keeps ${stage.height} px`);
  });
});

describe("keys", () => {
  it("arrow keys move in toolbars and choose in groups", async () => {
    await visit.open(`${server.url}?model=house`);
    await visit.tool("section");
    await visit.page.click("#add-plane");
    await visit.page.getByRole("radio", { name: "y, from the front" }).focus();
    await visit.page.keyboard.press("ArrowRight");
    assert.equal((await visit.state()).sections[0].axis, "z");
    await visit.page.keyboard.press("ArrowLeft");
    await visit.page.keyboard.press("ArrowLeft");
    assert.equal((await visit.state()).sections[0].axis, "x");
    await visit.page.getByRole("button", { name: "Export as SVG" }).focus();
    await visit.page.keyboard.press("ArrowRight");
    const focused = () =>
      visit.page.evaluate(() => {
        let active = document.activeElement;
        while (active?.shadowRoot?.activeElement) active = active.shadowRoot.activeElement;
        return active.getAttribute("aria-label") ?? active.textContent.trim();
      });
    assert.equal(await focused(), "Export as DXF");
    await visit.page.keyboard.press("End");
    assert.equal(await focused(), "Export as CSV");
    await visit.tool("look");
    await visit.page.getByRole("radio", { name: "Plain" }).focus();
    await visit.page.keyboard.press("ArrowRight");
    assert.equal((await visit.state()).look, "paper");
  });
});

describe("screen reader", () => {
  /** What Chromium tells it: role, name and state of what is not ignored. */
  const tree = async () => {
    const client = await visit.page.context().newCDPSession(visit.page);
    const { nodes } = await client.send("Accessibility.getFullAXTree");
    await client.detach();
    return nodes
      .filter((node) => !node.ignored)
      .map((node) => ({
        role: node.role?.value,
        name: node.name?.value ?? "",
        ...Object.fromEntries((node.properties ?? []).map(({ name, value }) => [name, value.value])),
      }));
  };

  const kWords = {
    "en-US": {
      parts: "Parts",
      section: "Section",
      picture: "Picture of",
      search: "Search names and attributes",
      plane: "Plane 1",
      position: "Position",
    },
    "de-DE": {
      parts: "Teile",
      section: "Schnitt",
      picture: "Bild von",
      search: "Namen und Attribute suchen",
      plane: "Ebene 1",
      position: "Lage",
    },
  };
  for (const [locale, words] of Object.entries(kWords))
    it(`is told what everything is, in ${locale}`, async () => {
      await visit.open(`${server.url}?model=house`, { locale });
      await visit.page.waitForFunction(() => customElements.get("wa-slider"));
      await visit.tool("section");
      await visit.page.click("#add-plane");
      const [id] = await inPage("s.volume.engine.select('class=IfcDoor')");
      await inPage("s.selection.select([v])", id);
      const nodes = await visit.eventually(async () => {
        const all = await tree();
        assert.equal(all.filter((node) => node.role === "treeitem" && node.selected).length, 1);
        return all;
      });
      const has = (role, name) => nodes.find((node) => node.role === role && node.name.startsWith(name));
      for (const [role, name] of [
        ["navigation", words.parts],
        ["toolbar", ""],
        ["button", words.section],
        ["tree", ""],
        ["searchbox", words.search],
        ["group", words.plane],
        ["slider", words.position],
        ["radiogroup", ""],
        ["main", ""],
      ])
        assert.ok(has(role, name), `no ${role} '${name}'`);
      assert.equal(nodes.find((node) => node.role === "button" && node.name === words.section)?.expanded, true);
      assert.ok(
        nodes.some((node) => node.name.startsWith(words.picture)),
        "the picture says what it is",
      );
      const selected = nodes.filter((node) => node.role === "treeitem" && node.selected);
      assert.ok(selected[0].name.length > 0 && selected[0].level > 1);
      const nameless = nodes.filter(
        (node) =>
          [
            "button",
            "slider",
            "checkbox",
            "radio",
            "combobox",
            "textbox",
            "searchbox",
            "spinbutton",
            "treeitem",
            "tab",
            "dialog",
            "switch",
          ].includes(node.role) && !node.name.trim(),
      );
      assert.deepEqual(nameless, []);
      assert.ok(
        nodes.some((node) => node.role === "status"),
        "selections are announced",
      );
    });
});
