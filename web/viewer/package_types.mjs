// Copies the declarations that an npm package needs: those of its entry, and all that they import. Programs that resolve modules as
// Node.js does need the endings of imported files.
//   node package_types.mjs DECLARATIONS TARGET ENTRY...   ENTRY as in DECLARATIONS, without .d.ts
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";

const kImported = /((?:from|import)\s*\(?\s*)"(\.{1,2}\/[^"]+)"/g;

const [declarations = "", target = "", ...entries] = process.argv.slice(2);
const wanted = [...entries];
const copied = new Set();
while (wanted.length) {
  const name = String(wanted.pop());
  if (copied.has(name)) continue;
  copied.add(name);
  const text = readFileSync(join(declarations, `${name}.d.ts`), "utf8").replace(kImported, (_, before, address) => {
    wanted.push(join(dirname(name), address));
    return `${before}"${address}.js"`;
  });
  mkdirSync(dirname(join(target, name)), { recursive: true });
  writeFileSync(join(target, `${name}.d.ts`), text);
}
