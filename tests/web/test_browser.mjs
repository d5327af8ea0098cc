// Calls the installed npm package in headless Chromium, in a worker, and bakes cases/baked/maps.glb.
// Usage: node test_browser.mjs CHROMIUM PROFILE BROWSER.mjs, in a folder with examples/web, node_modules and cases
import assert from "node:assert";
import { readFileSync, writeFileSync } from "node:fs";
import { open } from "./page.mjs";

const { evaluate, close } = await open(...process.argv.slice(2));
try {
    const made = await evaluate(`(async () => {
        const { simplify } = await import("faqem");
        const array = async (Type, name) => new Type(await (await fetch("/cases/" + name)).arrayBuffer());
        const mesh = [await array(Float32Array, "grid.positions"), await array(Uint32Array, "grid.triangles")];
        const phases = new Set(), controller = new AbortController();
        let frames = 0, ended = false;
        const count = () => { frames += 1; if (!ended) setTimeout(count, 5); };
        count();
        const out = await simplify(...mesh, { ratio: 0.1, progress: (phase) => void phases.add(phase) });
        ended = true;
        const abort = await simplify(...mesh, { signal: controller.signal, progress: () => controller.abort() }).catch(({ name }) => name);
        const expected = await array(Float32Array, "grid.out-positions");
        return { same: out.positions.length === expected.length && out.positions.every((x, i) => x === expected[i]),
                 phases: [...phases], abort, frames };
    })()`);
    assert(made.same, "the positions of the native library");
    assert(made.phases.includes("simplify") && made.frames > 5, "the page works meanwhile, and gets the progress");
    assert.strictEqual(made.abort, "AbortError");
    console.log("Chromium: the same, in a worker", made);
    const options = readFileSync("cases/baked/maps.options", "utf8");
    const bytes = await evaluate(`(async () => {
        const { simplifyGlb } = await import("faqem");
        const file = new Uint8Array(await (await fetch("/cases/baked/maps.glb")).arrayBuffer());
        return [...(await simplifyGlb(file, ${options})).glb];
    })()`);
    writeFileSync("cases/baked/maps.out.glb", Uint8Array.from(bytes));  // baked.py compares it
} finally {
    await close();
}
