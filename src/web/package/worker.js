// A worker that calls one function of faqem.js and posts its progress, and then its result or error.
import { load } from "./faqem.js";

const milliseconds = 50;  // between two reports

function serve(port) {
    port.onmessage = async ({ data: { module, method, values, options, reports } }) => {
        try {
            const faqem = await load(module);
            let last = 0;
            const progress = reports && ((phase, fraction) => {
                const now = performance.now();
                if (now - last < milliseconds) return;
                last = now;
                port.postMessage({ progress: [phase, fraction] });
            });
            const result = faqem[method](...values, { ...options, progress });
            port.postMessage({ result }, buffersOf(result));
        } catch ({ name, message, status }) {
            port.postMessage({ error: { name, message, status } });
        }
    };
}

/** The buffers of all typed arrays in a value, which are moved instead of copied. */
function buffersOf(value) {
    if (ArrayBuffer.isView(value)) return [value.buffer];
    return value && typeof value === "object" ? Object.values(value).flatMap(buffersOf) : [];
}

if (globalThis.postMessage) serve(globalThis);
else import(/* @vite-ignore */ /* webpackIgnore: true */ "node:worker_threads").then(({ parentPort }) => serve(parentPort));
