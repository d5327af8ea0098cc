// Calls the installed npm package in headless Chromium, in a worker, and bakes CASES/baked/maps.glb.
// Usage: node test_browser.mjs CHROMIUM PROFILE CASES BROWSER.mjs, in the folder with node_modules
import assert from "node:assert";
import { readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { pathToFileURL } from "node:url";

const [executable, profile, cases, browser] = process.argv.slice(2);
const { openPage } = await import(pathToFileURL(browser));
const types = { js: "text/javascript", wasm: "application/wasm" };
const server = createServer(({ url }, response) => {
    if (url === "/") return response.setHeader("Content-Type", "text/html").end("<title>faqem</title>");
    try {
        const file = readFileSync(url.startsWith("/cases/") ? `${cases}/${url.slice(7)}` : `node_modules/faqem${url}`);
        response.setHeader("Content-Type", types[url.split(".").pop()] ?? "application/octet-stream").end(file);
    } catch {
        response.writeHead(404).end();
    }
}).listen(0, "127.0.0.1");
await new Promise((resolve) => server.once("listening", resolve));

const page = await openPage(executable, profile, { width: 640, height: 480 });
/** The value of a promise in the page. */
async function evaluate(expression) {
    const { result, exceptionDetails } = await page.send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
}
try {
    const loaded = new Promise((resolve) => page.on("Page.loadEventFired", resolve));
    await page.send("Page.enable");
    await page.send("Page.navigate", { url: `http://127.0.0.1:${server.address().port}/` });
    await loaded;
    const made = await evaluate(`(async () => {
        const { simplify } = await import("/faqem.js");
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
    const options = readFileSync(`${cases}/baked/maps.options`, "utf8");
    const bytes = await evaluate(`(async () => {
        const { simplifyGlb } = await import("/faqem.js");
        const file = new Uint8Array(await (await fetch("/cases/baked/maps.glb")).arrayBuffer());
        return [...(await simplifyGlb(file, ${options})).glb];
    })()`);
    writeFileSync(`${cases}/baked/maps.out.glb`, Uint8Array.from(bytes));  // baked.py compares it
} finally {
    await page.close();
    server.close();
}
