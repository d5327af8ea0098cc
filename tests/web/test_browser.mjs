// Uses examples/web in headless Chromium, calls the npm package in a worker from it, and bakes cases/baked/maps.glb.
// Usage: node test_browser.mjs CHROMIUM PROFILE BROWSER.mjs, in a folder with examples/web, node_modules and cases
import assert from "node:assert";
import { readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { setTimeout } from "node:timers/promises";
import { pathToFileURL } from "node:url";
import { PNG } from "pngjs";

const [executable, profile, browser] = process.argv.slice(2);
const { openPage } = await import(pathToFileURL(browser));
const types = { html: "text/html", js: "text/javascript", wasm: "application/wasm" };
const server = createServer(({ url }, response) => {
    try {
        response.setHeader("Content-Type", types[url.split(".").pop()] ?? "application/octet-stream").end(readFileSync(`.${url}`));
    } catch {
        response.writeHead(404).end();
    }
}).listen(0, "127.0.0.1");
await new Promise((resolve) => server.once("listening", resolve));

const page = await openPage(executable, profile, { width: 1000, height: 700 });
/** The value of an expression, or of its promise, in the page. */
async function evaluate(expression) {
    const { result, exceptionDetails } = await page.send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
}
/** Waits until the text of an element matches. */
async function until(selector, pattern) {
    for (const end = Date.now() + 60_000; !pattern.test(await text(selector)); await setTimeout(50))
        assert(Date.now() < end, `${selector}: not ${pattern}: ${await text("body")}`);
}
const text = (selector) => evaluate(`document.querySelector("${selector}")?.innerText ?? ""`);
const drop = (content) => evaluate(`(async () => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([${content}], "maps.glb"));
    document.querySelector("main").dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
})()`);

/** The colours in the view with the divider at a place, 0 for the background. */
async function view(divider) {
    const { top, bottom } = await evaluate(`new Promise((done) => {
        Object.assign(document.querySelector("#divider"), { value: ${divider} }).dispatchEvent(new Event("input"));
        requestAnimationFrame(() => requestAnimationFrame(() => done(document.querySelector("canvas").getBoundingClientRect().toJSON())));
    })`);
    const { data: png } = await page.send("Page.captureScreenshot", { format: "png" });
    const { width, data } = PNG.sync.read(Buffer.from(png, "base64")), rows = Math.floor(bottom - top - 40);  // below the captions
    const colours = Array.from({ length: rows * (width - 2) }, (_, i) => {
        const x = 1 + i % (width - 2), y = Math.ceil(top) + 35 + Math.floor(i / (width - 2));
        return data.readUInt32BE(4 * (y * width + x));
    });
    return colours.map((colour) => (colour === colours[0] ? 0 : colour));
}

try {
    const loaded = new Promise((resolve) => page.on("Page.loadEventFired", resolve));
    await page.send("Page.enable");
    await page.send("Page.navigate", { url: `http://127.0.0.1:${server.address().port}/index.html` });
    await loaded;
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

    await drop('await (await fetch("/cases/baked/maps.glb")).blob()');
    await until("#status", /^Simplified in/);
    const [name, glb] = await evaluate(`(async ({ download, href }) => [download, [...new Uint8Array(await (await fetch(href)).arrayBuffer())]])(
        document.querySelector("#download"))`);
    assert.strictEqual(name, "maps-simplified.glb");
    assert.deepStrictEqual([await text("#faces-before"), await text("#faces-after")], ["800", "80"]);
    assert.strictEqual(await text("#bytes-after"), glb.length.toLocaleString("en"));
    assert.strictEqual(Buffer.from(glb).toString("latin1").match(/"image\/jpeg"/g).length, 3);
    const before = await view(1), after = await view(0), count = (holds) => before.filter((colour, i) => holds(colour, after[i])).length;
    const shown = { either: count((a, b) => a || b), both: count((a, b) => a && b), equal: count((a, b) => a && a === b) };
    console.log(`The example shows the model before and after, of ${before.length} pixels:`, shown);
    assert(shown.either > before.length / 10 && shown.both > 0.95 * shown.either && shown.equal < shown.both);

    await evaluate(`document.querySelector("#target").value = "faces", document.querySelector("#amount").value = 200,
        document.querySelector("#simplify").click()`);
    await until("#faces-after", /^200$/);
    await evaluate(`document.querySelector("#simplify").click(), document.querySelector("#cancel").click()`);
    await until("#status", /^Cancelled/);
    assert.strictEqual(await text("#faces-after"), "200", "the result before it stays");
    await drop("new Uint8Array(20)");
    await until("#status.error", /GLB/);
    assert.strictEqual(await text("#download:not([hidden])"), "", "no result");
} finally {
    await page.close();
    server.close();
}
