// Uses the page of examples/web in headless Chromium: cases/baked/maps.glb is dropped on it.
// Usage: node test_example.mjs CHROMIUM PROFILE BROWSER.mjs, in a folder with examples/web, node_modules and cases
import assert from "node:assert";
import { readFileSync } from "node:fs";
import { PNG } from "pngjs";
import { open } from "./page.mjs";

const { send, evaluate, until, close } = await open(...process.argv.slice(2));
const text = (id) => evaluate(`document.getElementById("${id}").innerText`);
const set = (id, value) => evaluate(`document.getElementById("${id}").value = ${JSON.stringify(value)}`);
const click = (id) => evaluate(`document.getElementById("${id}").click()`);
const says = (pattern) => until(`${pattern}.test(document.getElementById("status").innerText)`, 60);
const drop = (content, name) => evaluate(`(async () => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([${content}], "${name}"));
    document.querySelector("main").dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
})()`);

/** The pixels of the model on one side alone: those that have not the colour of the background. */
async function covered(divider) {
    await evaluate(`new Promise((done) => {
        const input = document.getElementById("divider");
        input.value = ${divider};
        input.dispatchEvent(new Event("input"));
        requestAnimationFrame(() => requestAnimationFrame(done));
    })`);
    const { data } = await send("Page.captureScreenshot", { format: "png" });
    const clip = await evaluate(`JSON.parse(JSON.stringify(document.querySelector("canvas").getBoundingClientRect()))`);
    const { width, data: pixels } = PNG.sync.read(Buffer.from(data, "base64")), colours = [];
    for (let y = Math.ceil(clip.top) + 40; y < clip.bottom - 4; ++y)
        for (let x = 4; x < width - 4; ++x) colours.push(pixels.readUInt32BE(4 * (y * width + x)));
    return colours.map((colour) => (colour === colours[0] ? 0 : colour));
}

try {
    await drop('await (await fetch("/cases/baked/maps.glb")).arrayBuffer()', "maps.glb");
    await says("/^Simplified in/");
    const source = readFileSync("cases/baked/maps.glb");
    assert.deepStrictEqual([await text("faces-before"), await text("faces-after")], ["800", "80"]);
    assert.strictEqual(await text("bytes-before"), source.length.toLocaleString("en"));
    const [glb, name] = await evaluate(`(async () => {
        const link = document.getElementById("download");
        return [[...new Uint8Array(await (await fetch(link.href)).arrayBuffer())], link.download];
    })()`);
    assert.strictEqual(name, "maps-simplified.glb");
    assert.strictEqual(await text("bytes-after"), glb.length.toLocaleString("en"));
    const { images } = JSON.parse(Buffer.from(glb).toString("utf8", 20, 20 + Buffer.from(glb).readUInt32LE(12)));
    assert.deepStrictEqual(images.map(({ mimeType }) => mimeType), Array(3).fill("image/jpeg"));
    const before = await covered(1), after = await covered(0);
    const [most, common, same] = [(i) => before[i] || after[i], (i) => before[i] && after[i], (i) => before[i] && before[i] === after[i]].map(
        (holds) => before.filter((_, i) => holds(i)).length);
    console.log(`example: the model covers ${most} of ${before.length} pixels, ${common} on both sides, ${same} equally`);
    assert(most > before.length / 20 && common > 0.95 * most && same < common, "both models are shown");

    await set("target", "faces");
    await set("amount", 200);
    await click("simplify");
    await until(`document.getElementById("faces-after").innerText === "200"`, 60);
    await set("texture-size", "4096");
    await evaluate(`["simplify", "cancel"].forEach((id) => document.getElementById(id).click())`);
    await says("/^Cancelled/");
    assert.strictEqual(await text("faces-after"), "200", "the result before it stays");
    await drop("new Uint8Array(20)", "zeros.glb");
    await until(`document.querySelector("#status.error")?.innerText.includes("GLB")`, 60);
    assert(await evaluate(`document.getElementById("download").hidden`));
} finally {
    await close();
}
