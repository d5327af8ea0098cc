// The controls of the page: a GLB file is dropped or chosen, simplified in a worker, shown and offered for download.
import { simplifyGlb } from "faqem";
import { View } from "./view.js";

const element = (id) => document.getElementById(id);
const view = new View(document.querySelector("canvas"));
let source = null;   // name and bytes of the file
let running = null;  // the AbortController of the call

function say(text, isError = false) {
    element("status").textContent = text;
    element("status").classList.toggle("error", isError);
}

/** Encodes pixels as JPEG if none of them is transparent, otherwise as PNG. */
async function encodeJpeg({ width, height, data }) {
    const canvas = new OffscreenCanvas(width, height);
    canvas.getContext("2d").putImageData(new ImageData(data, width, height), 0, 0);
    let opaque = true;
    for (let i = 3; i < data.length && opaque; i += 4) opaque = data[i] === 255;
    const blob = await canvas.convertToBlob(opaque ? { type: "image/jpeg", quality: 0.9 } : { type: "image/png" });
    return new Uint8Array(await blob.arrayBuffer());
}

/** The options of simplifyGlb() that the controls stand for. */
function options() {
    const amount = element("amount").valueAsNumber;
    return {
        ...{ percent: { ratio: amount / 100 }, faces: { faces: amount }, error: { maxError: `${amount}%` } }[element("target").value],
        textureSize: element("texture-size").value || undefined,
        codecs: element("jpeg").checked ? { encode: encodeJpeg } : undefined,
    };
}

function showNumbers({ faces_in, faces_out }, glb) {
    const numbers = { "faces-before": faces_in, "bytes-before": source.bytes.length, "faces-after": faces_out, "bytes-after": glb.length };
    for (const [id, value] of Object.entries(numbers)) element(id).textContent = value.toLocaleString("en");
    URL.revokeObjectURL(element("download").href);
    element("download").href = URL.createObjectURL(new Blob([glb], { type: "model/gltf-binary" }));
    element("download").download = source.name.replace(/(\.glb)?$/i, "-simplified.glb");
    element("numbers").hidden = element("download").hidden = false;
}

async function run() {
    const controller = new AbortController(), start = performance.now();
    running?.abort();
    running = controller;
    element("cancel").disabled = element("progress").hidden = false;
    element("progress").value = 0;
    say("Images are decoded.");
    try {
        const { glb, report } = await simplifyGlb(source.bytes, {
            ...options(),
            signal: controller.signal,
            progress: (phase, fraction) => {
                element("progress").value = fraction;
                say(`${phase}: ${Math.round(100 * fraction)}%`);
            },
        });
        const seconds = ((performance.now() - start) / 1000).toFixed(1);
        await view.show(1, glb);
        showNumbers(report, glb);
        say(`Simplified in ${seconds} s.`);
    } catch (error) {
        if (running !== controller) return;  // the message is that of the next call
        if (error.name === "AbortError") say("Cancelled.");
        else say(error.message, true);
    } finally {
        if (running === controller) {
            element("cancel").disabled = element("progress").hidden = true;
            running = null;
        }
    }
}

async function open(file) {
    running?.abort();
    source = { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) };
    element("simplify").disabled = false;
    element("numbers").hidden = element("download").hidden = true;
    await Promise.all([0, 1].map((side) => view.show(side, null)));
    await view.show(0, source.bytes).catch(() => {});  // what cannot be shown may still be simplified, which gives a message
    await run();
}

element("options").addEventListener("submit", (event) => {
    event.preventDefault();
    run();
});
element("cancel").addEventListener("click", () => running?.abort());
element("file").addEventListener("change", ({ target }) => target.files.length && open(target.files[0]));
element("divider").addEventListener("input", ({ target }) => (view.divider = target.valueAsNumber));
element("wireframe").addEventListener("change", ({ target }) => (view.wireframe = target.checked));
for (const name of ["dragover", "dragleave", "drop"]) {
    document.addEventListener(name, (event) => {
        event.preventDefault();
        document.body.classList.toggle("over", name === "dragover");
        if (name === "drop" && event.dataTransfer.files.length) open(event.dataTransfer.files[0]);
    });
}
