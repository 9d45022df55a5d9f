// Writes the package.json of a package: with the version of SVT, and with the addresses of its repository, if that is known.
//   node web/npm/complete.mjs PACKAGE_JSON FOLDER [REPOSITORY]   FOLDER: of the package in the repository
import { readFileSync } from "node:fs";
import process from "node:process";
import { ownVersion } from "../viewer/sbom.mjs";

const [file = "", directory = "", given = ""] = process.argv.slice(2);
const described = JSON.parse(readFileSync(file, "utf8"));
const repository = given.replace(/\.git$|\/+$/g, "");
const addresses = repository && {
  repository: { type: "git", url: `git+${repository}.git`, directory },
  homepage: `${repository}#readme`,
  bugs: { url: `${repository}/issues` },
};
const { name, description, license, author, keywords, ...others } = described;
const complete = { name, ...others, version: ownVersion(), description, license, author, ...addresses, keywords };
process.stdout.write(`${JSON.stringify({ name, version: complete.version, ...complete }, null, 2)}\n`);
