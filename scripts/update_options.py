#!/usr/bin/env python3
"""Writes what is made from the declarations of options (`svt describe json`): the tables of options in docs/user,
the table of formats in docs/user/convert.md, the options of projects in docs/user/configuration.md,
docs/formats/scene.schema.json, docs/formats/sheets.schema.json, and in web/viewer/src/generated scene_members.ts, from
which the viewer page has the ranges, choices, defaults and help of its controls, model_endings.ts, the endings of
files that it opens, and class_terms.ts, the words for classes.

    scripts/update_options.py [--svt build/release/bin/svt] [--check]

A page docs/user/<command>.md has the lines `<!-- BEGIN options -->` and `<!-- END options -->`; what stands between
them is replaced. With --check nothing is written, and the exit code is 1 where a file is stale or missing.
"""
import argparse
import difflib
import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BEGIN, END = "<!-- BEGIN options -->", "<!-- END options -->"
PROJECT_ROW = 15  # options per row of the table of options of projects
PROJECT_BEGIN, PROJECT_END = "<!-- BEGIN project options -->", "<!-- END project options -->"
FORMATS_BEGIN, FORMATS_END = "<!-- BEGIN formats -->", "<!-- END formats -->"
PLAIN_KINDS = {"whole": "whole number", "number": "number", "text": "text"}
PAGE_ENDINGS = """\
/**
 * The endings of model files, as the readers of the library declare them.
 * scripts/update_options.py generates this file; manual changes are lost.
 */

export const kModelEndings = %s as const;
"""
PAGE_CLASSES = """\
/**
 * Words for classes and types, without the prefix Ifc, in English and German: those of svt/writers/sheets/class_words.cpp.
 * An empty English word is the name itself. scripts/update_options.py generates this file; manual changes are lost.
 */

export const kClassTerms: Readonly<Record<string, readonly [english: string, german: string]>> = {
%s};
"""
PAGE_MEMBERS_BEGIN = """\
/**
 * The members of a scene as svt/illustrate/scene/scene_members.cpp declares them, by JSON pointer with * for any index.
 * scripts/update_options.py generates this file; manual changes are lost.
 */

export const kSceneMembers = {
"""
PAGE_MEMBERS_END = """\
} as const;

/** A `*.scene.json`: docs/formats/scene.schema.json. The page edits it, the library draws it. */
export interface Scene %s

export type SceneMember = keyof typeof kSceneMembers;

/** The members of a declaration. */
export interface DeclaredMember {
  readonly type: "flag" | "whole" | "number" | "text" | "object" | "list";
  readonly unit?: string;
  readonly minimum?: number;
  readonly maximum?: number;
  readonly choices?: readonly (string | number)[];
  readonly default?: string | number | boolean | readonly number[];
  /** Takes an array of such values. */
  readonly repeats?: true;
  /** The option of `svt render` for this member; `group` is its heading in help. */
  readonly option?: string;
  readonly group?: string;
  readonly help: string;
}

/** The members that declare something: SceneMemberWith<"minimum" | "maximum"> are those with a range. */
export type SceneMemberWith<Key extends string> = {
  [Name in SceneMember]: (typeof kSceneMembers)[Name] extends Record<Key, unknown> ? Name : never;
}[SceneMember];

/** The values of a member that has choices. */
export type ChoiceOf<Name extends SceneMemberWith<"choices">> = (typeof kSceneMembers)[Name]["choices"][number];

export type Unit = (typeof kSceneMembers)[SceneMemberWith<"unit">]["unit"];
"""


def range_text(option: dict) -> str:
    low, high = option.get("minimum"), option.get("maximum")
    if low is None and high is None or high is not None and high >= 1e9:
        return ""
    if None not in (low, high):
        return f"{low:.9g} to {high:.9g}"
    return f"at least {low:.9g}" if high is None else f"at most {high:.9g}"


def value_cell(option: dict) -> str:
    if option["kind"] == "flag":
        return ""
    if "choices" in option:
        return ", ".join(f"`{choice}`" for choice in option["choices"])
    value = option.get("value", PLAIN_KINDS[option["kind"]])
    return ", ".join(filter(None, (value, option.get("unit", ""), range_text(option))))


def default_cell(option: dict) -> str:
    if option.get("required"):
        return "required"
    return f"`{option['default']}`" if "default" in option else option.get("otherwise", "")


def options_table(command: dict) -> str:
    groups: dict[str, list[dict]] = {}
    for option in command["options"]:
        is_argument = not option["name"].startswith("-")
        groups.setdefault("Arguments" if is_argument else option.get("group", "General"), []).append(option)
    lines = []
    for group, options in groups.items():
        lines += ["", f"### {group}", "", "| option | value | default | what it does |", "|---|---|---|---|"]
        for option in options:
            names = ", ".join(f"`{name}`" for name in option["name"].split(","))
            said = option["help"] + ("; may be repeated" if option.get("repeats") else "")
            cells = (names, value_cell(option), default_cell(option), said)
            lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    return "\n".join(lines[1:])


def formats_table(formats: list[dict]) -> str:
    lines = ["| extension | format | who reads it |", "|---|---|---|"]
    for row in formats:
        endings = ", ".join(f"`{ending}`" for ending in row["endings"])
        lines.append(f"| {endings} | {row['holds']} | {row['readers']} |")
    return "\n".join(lines)


def project_table(commands: list[dict]) -> str:
    """The options that a file beside a model may set, and their commands."""
    commands_of: dict[str, list[str]] = {}
    for command in commands:
        for option in command["options"]:
            if option.get("project"):
                name = option["name"].split(",")[-1].lstrip("-")
                commands_of.setdefault(name, []).append(command["name"])
    rows: dict[str, list[str]] = {}
    for name, names in commands_of.items():
        rows.setdefault(", ".join(names), []).append(name)
    lines = ["| commands | options |", "|---|---|"]
    for names_text, options in rows.items():
        for first in range(0, len(options), PROJECT_ROW):
            row = ", ".join(f"`{option}`" for option in options[first : first + PROJECT_ROW])
            lines.append(f"| {names_text} | {row} |")
    return "\n".join(lines)


def page_with(page: str, table: str, name: str, first: str = BEGIN, last: str = END) -> str:
    begin, end = page.find(first), page.find(last)
    if begin < 0 or end < begin:
        sys.exit(f"{name}: needs the lines '{first}' and '{last}'")
    return page[: begin + len(first)] + "\n" + table + "\n" + page[end:]


def plain_number(value: float):
    return int(value) if value == int(value) else value


def choice_values(member: dict) -> list:
    return [int(choice) if member["kind"] == "whole" else choice for choice in member["choices"]]


def value_schema(member: dict) -> dict:
    """The schema of one value of a member, without its description and default."""
    if member["kind"] == "flag":
        return {"type": "boolean"}
    if "choices" in member:
        choices = choice_values(member)
        return {"const": choices[0]} if len(choices) == 1 else {"enum": choices}
    if member["kind"] == "text":
        return {"type": "string"}
    if "minimum" in member and member["minimum"] == member.get("maximum"):
        return {"const": int(member["minimum"])}
    number = {"type": "integer" if member["kind"] == "whole" else "number"}
    for bound in ("minimum", "maximum"):
        if bound in member:
            number[bound] = plain_number(member[bound])
    return number


def default_value(member: dict):
    values = []
    for text in member["default"].split(","):
        numeric = member["kind"] in ("whole", "number")
        values.append(text == "true" if member["kind"] == "flag" else json.loads(text) if numeric else text)
    return values if member.get("count", 1) > 1 else values[0]


def member_schema(members: dict[str, dict], pointer: str) -> dict:
    """The schema of a member with all that is below it."""
    member = members[pointer]
    said = ", ".join(filter(None, (member.get("help", ""), member.get("unit", ""))))
    if "otherwise" in member:
        said += f"; default: {member['otherwise']}"
    schema: dict = {"description": said} if said else {}
    if member["kind"] == "object" and pointer == "/motion/keys/*/scene":
        return schema | {"$ref": "#"}  # members of the scene itself
    if member["kind"] == "object":
        return schema | object_schema(members, pointer)
    if member["kind"] == "list":
        schema |= {"type": "array", "items": object_schema(members, pointer + "/*")}
        return schema | (
            {"minItems": int(member["minimum"]), "maxItems": int(member["maximum"])} if "minimum" in member else {}
        )
    if member.get("repeats"):
        schema |= {"type": "array", "items": value_schema(member)}
    elif member.get("count", 1) > 1:
        schema |= {
            "type": "array",
            "items": value_schema(member),
            "minItems": member["count"],
            "maxItems": member["count"],
        }
    else:
        schema |= value_schema(member)
    return schema | ({"default": default_value(member)} if "default" in member else {})


def object_schema(members: dict[str, dict], pointer: str) -> dict:
    own = [name for name in members if name.rpartition("/")[0] == pointer]
    schema = {"type": "object", "additionalProperties": False}
    required = [name.rpartition("/")[2] for name in own if members[name].get("required")]
    if required:
        schema["required"] = required
    return schema | {"properties": {name.rpartition("/")[2]: member_schema(members, name) for name in own}}


def scene_schema(described: dict) -> str:
    members = {member["name"]: member for member in described["sceneMembers"]}
    schema = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "SVT scene",
        "description": "The content of a picture, in queries and regions (docs/user/query-language.md, docs/user/regions.md). "
        "`svt render --scene` draws it, `--write-scene` writes one. Lengths are metres.",
    }
    return json.dumps(schema | object_schema(members, ""), indent=2, ensure_ascii=False) + "\n"


def sheets_schema(described: dict) -> str:
    members = {member["name"]: member for member in described["sheetMembers"]}
    schema = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "SVT sheets",
        "description": "The drawings on each sheet of paper. `svt sheets --from` draws them, `--write-sheets` "
        "writes one. Lengths are metres.",
    }
    return json.dumps(schema | object_schema(members, ""), indent=2, ensure_ascii=False) + "\n"


def value_type(member: dict) -> str:
    """The TypeScript type of one value of a member."""
    if "choices" in member:
        return " | ".join(json.dumps(choice) for choice in choice_values(member))
    return {"flag": "boolean", "whole": "number", "number": "number"}.get(member["kind"], "string")


def member_type(members: dict[str, dict], pointer: str) -> str:
    """The TypeScript type of a member with all that is below it."""
    member = members[pointer]
    below = [name for name in members if name.startswith(pointer + "/")]
    if member["kind"] == "object":
        return object_type(members, pointer) if below else "Scene"
    if member["kind"] == "list":
        return f"{object_type(members, pointer + '/*')}[]"
    if member.get("repeats"):
        return f"{value_type(member)}[]"
    if member.get("count", 1) > 1:
        return f"[{', '.join([value_type(member)] * member['count'])}]"
    return value_type(member)


def object_type(members: dict[str, dict], pointer: str) -> str:
    own = [name for name in members if name.rpartition("/")[0] == pointer and not name.endswith("*")]
    rows = [
        f"{name.rpartition('/')[2]}{'' if members[name].get('required') else '?'}: {member_type(members, name)};"
        for name in own
    ]
    return "{ " + " ".join(rows) + " }"


def page_member(member: dict) -> str:
    """The line of a member for the page."""
    values = {"type": member["kind"]}
    if "unit" in member:
        values["unit"] = member["unit"]
    values |= {bound: plain_number(member[bound]) for bound in ("minimum", "maximum") if bound in member}
    if "choices" in member:
        values["choices"] = choice_values(member)
    if "default" in member:
        values["default"] = default_value(member)
    values |= {key: member[key] for key in ("repeats", "option", "group") if key in member}
    values["help"] = member.get("help", "")
    said = ", ".join(f"{key}: {json.dumps(value, ensure_ascii=False)}" for key, value in values.items())
    return f"  {json.dumps(member['name'])}: {{ {said} }},\n"


def page_members(described: dict) -> str:
    members = {member["name"]: member for member in described["sceneMembers"]}
    table = "".join(map(page_member, members.values()))
    return PAGE_MEMBERS_BEGIN + table + PAGE_MEMBERS_END % object_type(members, "").replace("; ", ";\n  ")


def page_endings(described: dict) -> str:
    endings = dict.fromkeys(ending for row in described["modelFormats"] for ending in row["endings"])
    return PAGE_ENDINGS % json.dumps(list(endings))


def page_classes(described: dict) -> str:
    rows = [
        f"  {row['name']}: [{json.dumps(row['english'])}, {json.dumps(row['german'], ensure_ascii=False)}],\n"
        for row in described["classes"]
    ]
    return PAGE_CLASSES % "".join(rows)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--svt", default=str(ROOT / "build/release/bin/svt"))
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    described = json.loads(
        subprocess.run(
            [arguments.svt, "describe", "json"], capture_output=True, text=True, check=True, timeout=30
        ).stdout
    )

    wanted = {
        ROOT / "docs/formats/scene.schema.json": scene_schema(described),
        ROOT / "docs/formats/sheets.schema.json": sheets_schema(described),
        ROOT / "web/viewer/src/generated/scene_members.ts": page_members(described),
        ROOT / "web/viewer/src/generated/model_endings.ts": page_endings(described),
        ROOT / "web/viewer/src/generated/class_terms.ts": page_classes(described),
    }
    for command in described["commands"]:
        path = ROOT / "docs/user" / f"{command['name']}.md"
        if not path.exists():
            print(f"{path.relative_to(ROOT)}: missing, the page of svt {command['name']}", file=sys.stderr)
            return 1
        wanted[path] = page_with(path.read_text(encoding="utf-8"), options_table(command), path.name)
        if command["name"] == "convert":
            formats = formats_table(described["volumeFormats"])
            wanted[path] = page_with(wanted[path], formats, path.name, FORMATS_BEGIN, FORMATS_END)
    configuration = ROOT / "docs/user/configuration.md"
    wanted[configuration] = page_with(
        configuration.read_text(encoding="utf-8"),
        project_table(described["commands"]),
        configuration.name,
        PROJECT_BEGIN,
        PROJECT_END,
    )
    stale = 0
    for path, new in wanted.items():
        old = path.read_text(encoding="utf-8") if path.exists() else ""
        if new == old:
            continue
        stale += 1
        if arguments.check:
            sys.stderr.writelines(
                difflib.unified_diff(old.splitlines(True), new.splitlines(True), path.name, "svt describe")
            )
        else:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(new, encoding="utf-8")
            print(f"updated {path.relative_to(ROOT)}")
    if arguments.check and stale:
        print("options: files are stale; run scripts/update_options.py", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
