import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { SvtViewer } from "./svt_viewer";

const read = (name: string) => readFileSync(new URL(`../../../../${name}`, import.meta.url), "utf8");
const [described] = JSON.parse(read("web/npm/viewer/custom-elements.json")).modules[0].declarations;
const manual = read("docs/user/web-component.md");
const attributes = SvtViewer.observedAttributes.filter((name) => name !== "lang");
const namesOf = (list: { name: string }[]) => list.map(({ name }) => name).sort();

/** The names in the first column of a table of the manual. */
function listed(title: string): string[] {
  const section = manual.split(`## ${title}\n`)[1]!.split("\n## ")[0]!;
  const cells = section.split("\n").filter((line) => line.startsWith("| `"));
  return cells.flatMap((line) => [...line.split(" | ")[0]!.matchAll(/`(?:SvtViewer\.)?([\w-]+)/g)].map((match) => match[1]!)).sort();
}

describe("the element", () => {
  it("has the attributes of the manual and of the manifest for editors", () => {
    expect(listed("Attributes")).toEqual([...attributes].sort());
    expect(namesOf(described.attributes)).toEqual([...attributes].sort());
  });

  it("has the members and events of the manual and of the manifest", () => {
    const own = described.members.filter((member: { attribute?: string }) => !member.attribute);
    expect(listed("Methods and properties")).toEqual(namesOf(own));
    for (const { name, static: isStatic } of own) expect(name in (isStatic ? SvtViewer : SvtViewer.prototype), name).toBe(true);
    expect(listed("Events")).toEqual(namesOf(described.events));
    const types = read("web/viewer/src/element/types.ts").split("SvtViewerEventMap {")[1]!.split("}")[0]!;
    expect([...types.matchAll(/^ {2}(\w+):/gm)].map((match) => match[1]!).sort()).toEqual(namesOf(described.events));
  });
});
