// Completes the folder of the npm package: types of the options from their table, and the module as text.
// Usage: node pack.mjs FOLDER
import { readFile, writeFile } from "node:fs/promises";
import { pathToFileURL } from "node:url";

const folder = pathToFileURL(`${process.argv[2]}/`);
const { load } = await import(new URL("faqem.js", folder));
const wasm = await readFile(new URL("faqem.wasm", folder));
const faqem = await load(wasm);

const members = faqem.optionHelp().map(([name, help]) => {
    const choices = /^([\w-]+(?:\|[\w-]+)+): /.exec(help)?.[1].split("|") ?? [];
    const type = choices.length ? choices.map((word) => `"${word}"`).join(" | ") : "number | string";
    const isSwitch = choices.includes("on") || help.includes("off");
    const member = name.replace(/-./g, ([, letter]) => letter.toUpperCase());
    return `    /** ${help} */\n    ${member}?: ${type}${isSwitch ? " | boolean" : ""};\n`;
});
await writeFile(new URL("options.d.ts", folder), `export interface NamedOptions {\n${members.join("")}}\n`);
await writeFile(new URL("inline.js", folder),
    `export default Uint8Array.from(atob("${wasm.toString("base64")}"), (c) => c.charCodeAt(0));\n`);
await writeFile(new URL("inline.d.ts", folder), "declare const wasm: Uint8Array;\nexport default wasm;\n");
const manifest = new URL("package.json", folder);
const fields = JSON.parse(await readFile(manifest));
await writeFile(manifest, `${JSON.stringify({ ...fields, version: faqem.version }, null, 4)}\n`);
