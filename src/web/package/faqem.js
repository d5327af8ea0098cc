// Simplification of triangle meshes and textured models by faqem in WebAssembly. faqem.d.ts describes the interface.

import { browserCodecs, decodeImages, encodeImages } from "./glb.js";

const phases = ["load", "weld", "simplify", "map", "bake", "save"];
const OPTION = 2, CANCELLED = 8, NO_MEMORY = 11;  // of faqem_status
const kebab = (name) => name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);

export class FaqemError extends Error {
    name = "FaqemError";

    constructor(message, status) {
        super(message);
        this.status = status;
    }
}

const geometry = () => new URL("./faqem.wasm", import.meta.url);
const bake = () => new URL("./faqem-bake.wasm", import.meta.url);

/** Compiles the module of a URL, of bytes, or, without a source, of the file beside this one. */
async function compile(source) {
    if (source instanceof WebAssembly.Module) return source;
    source ??= geometry();
    if (typeof source !== "string" && !(source instanceof URL)) return WebAssembly.compile(source);
    const url = new URL(source, import.meta.url);
    if (url.protocol === "file:") {
        const { readFile } = await import(/* @vite-ignore */ /* webpackIgnore: true */ "node:fs/promises");
        return WebAssembly.compile(await readFile(url));
    }
    const response = await fetch(url);
    if (!response.ok) throw new FaqemError(`${url}: ${response.status} ${response.statusText}`);
    return WebAssembly.compile(await response.arrayBuffer());
}

/** The functions of one instance of the module, which run on the thread that calls them. */
class Faqem {
    #exports;
    #progress = null;

    constructor(module) {
        // Without files and threads, the C library needs nothing but the time; all else fails (52 is ENOSYS of WASI).
        const imports = { env: { faqem_web_progress: (phase, fraction) => (this.#progress?.(phase, fraction) ? 1 : 0) } };
        for (const { module: from, name } of WebAssembly.Module.imports(module)) (imports[from] ??= {})[name] ??= () => 52;
        imports.wasi_snapshot_preview1.clock_time_get = (_clock, _precision, time) => {
            const nanoseconds = BigInt(Math.round(performance.now() * 1e6));
            new DataView(this.#exports.memory.buffer).setBigUint64(time, nanoseconds, true);
            return 0;
        };
        this.#exports = new WebAssembly.Instance(module, imports).exports;
        this.#exports._initialize?.();
    }

    get version() {
        return this.#text(this.#exports.faqem_version());
    }

    /** Names and help texts of all options, as in the C interface. */
    optionHelp() {
        const { faqem_option_count: count, faqem_option_name: name, faqem_option_help: help } = this.#exports;
        return Array.from({ length: count() }, (_, i) => [this.#text(name(i)), this.#text(help(i))]);
    }

    simplify(positions, triangles, options = {}) {
        return this.#run(options, ({ call, space, mesh, settings }) => {
            const out = space(4);
            call("faqem_simplify", mesh(positions, triangles), settings, out);
            return this.#result(this.#word(out), positions.constructor);
        });
    }

    simplifyLevels(positions, triangles, levels, options = {}) {
        return this.#run(options, ({ call, space, mesh, settings }) => {
            const targets = space(16 * levels.length);
            levels.forEach((level, i) => {
                const [kind, value] = levelTarget(level, i);
                const view = new DataView(this.#exports.memory.buffer, targets + 16 * i);
                view.setInt32(0, kind, true);
                view.setFloat64(8, value, true);
            });
            const out = space(4 * levels.length);
            call("faqem_simplify_levels", mesh(positions, triangles), settings, targets, levels.length, out);
            return levels.map((_, i) => {
                const error = this.#exports.faqem_result_level_error(this.#word(out + 4 * i));
                return { ...this.#result(this.#word(out + 4 * i), positions.constructor), error };
            });
        });
    }

    /** As simplifyGlb() below, for a file whose images are pixels (glb.js). */
    simplifyGlb(bytes, options = {}) {
        return this.#run({ ...options, imageFormat: "png", allowLarger: true }, ({ call, space, copy, settings }) => {
            const c = this.#exports, out = space(4), made = [];
            const make = (type, name, ...values) => {
                call(name, ...values, out);
                made.push([type, this.#word(out)]);
                return this.#word(out);
            };
            try {
                const source = make("asset", "faqem_asset_from_glb", copy(Uint8Array, bytes, "bytes"), bytes.length);
                const asset = make("asset", "faqem_asset_simplify", source, settings);
                const address = c.faqem_glb_bytes(make("glb", "faqem_asset_to_glb", asset), out) >>> 0;
                const glb = new Uint8Array(c.memory.buffer, address, this.#word(out)).slice();
                return { glb, report: JSON.parse(this.#text(c.faqem_asset_report_json(asset))) };
            } finally {
                made.forEach(([type, object]) => c[`faqem_${type}_destroy`](object));
            }
        });
    }

    /** Calls work() with functions for one call of the C interface, and frees afterwards what they allocated. */
    #run({ progress, signal, faceGroups, vertexLocks, vertexWeights, cornerValues, cornerWidth, wasm, ...named }, work) {
        const c = this.#exports, allocated = [];
        const space = (bytes) => {
            const address = c.malloc(Math.max(bytes, 8)) >>> 0;  // WebAssembly gives signed numbers
            if (!address) throw new FaqemError(`${bytes} bytes of memory are not available`, NO_MEMORY);
            allocated.push(address);
            return address;
        };
        const copy = (Type, values, name, length) => {
            if (values === undefined) return 0;
            if (!(values instanceof Type)) throw new TypeError(`${name}: not a ${Type.name}`);
            if (length !== undefined && values.length !== length) throw new RangeError(`${name}: ${values.length} values, not ${length}`);
            const address = space(values.byteLength);
            new Uint8Array(c.memory.buffer).set(new Uint8Array(values.buffer, values.byteOffset, values.byteLength), address);
            return address;
        };
        const error = space(2048);
        const call = (name, ...values) => {
            const status = c[name](...values, error);
            if (status === CANCELLED) throw signal?.aborted ? signal.reason : new DOMException("cancelled", "AbortError");
            if (status !== 0) throw new FaqemError(this.#text(error + 4), status);
        };
        const mesh = (positions, triangles) => {
            if (positions.length % 3 || triangles.length % 3) throw new RangeError("positions and triangles: not three numbers each");
            const vertices = positions.length / 3, faces = triangles.length / 3;
            const isDouble = positions instanceof Float64Array, isShort = triangles instanceof Uint16Array;
            const places = copy(isDouble ? Float64Array : Float32Array, positions, "positions");
            const indices = copy(isShort ? Uint16Array : Uint32Array, triangles, "triangles");
            const fields = Uint32Array.of(
                isDouble ? 0 : places, isDouble ? places : 0, vertices, isShort ? 0 : indices, isShort ? indices : 0, faces,
                copy(Uint32Array, faceGroups, "faceGroups", faces), copy(Uint8Array, vertexLocks, "vertexLocks", vertices),
                copy(Float32Array, vertexWeights, "vertexWeights", vertices),
                copy(Float32Array, cornerValues, "cornerValues", 3 * faces * cornerWidth), cornerValues ? cornerWidth : 0, 0, 0, 0, 0);
            return copy(Uint32Array, fields, "mesh");
        };
        const settings = c.faqem_options_create();
        try {
            for (const [name, value] of Object.entries(named)) {
                if (value === undefined) continue;
                const text = new TextEncoder().encode(`${kebab(name)}\0${value === true ? "on" : value === false ? "off" : value}\0`);
                const address = copy(Uint8Array, text);
                call("faqem_options_set", settings, address, address + text.indexOf(0) + 1);
            }
            if (progress || signal) c.faqem_web_watch(settings);
            this.#progress = (phase, fraction) => progress?.(phases[phase], fraction) === false || signal?.aborted;
            return work({ call, space, copy, mesh, settings });
        } finally {
            this.#progress = null;
            c.faqem_options_destroy(settings);
            allocated.forEach((address) => c.free(address));
        }
    }

    /** Copies a result of the C interface and destroys it. */
    #result(result, Positions) {
        const c = this.#exports;
        const copy = (Type, name, length) => {
            const address = c[`faqem_result_${name}`](result) >>> 0;
            return new Type(c.memory.buffer, address, address ? length : 0).slice();
        };
        const vertices = c.faqem_result_vertex_count(result), faces = c.faqem_result_face_count(result);
        const made = {
            positions: Positions.from(copy(Float64Array, "positions", 3 * vertices)),
            triangles: copy(Uint32Array, "triangles", 3 * faces),
            vertexOrigin: copy(Uint32Array, "vertex_origin", vertices),
            faceOrigin: copy(Uint32Array, "face_origin", faces),
            faceGroups: copy(Uint32Array, "face_groups", faces),
            cornerValues: copy(Float32Array, "corner_values", 3 * faces * c.faqem_result_corner_width(result)),
            report: JSON.parse(this.#text(c.faqem_result_report_json(result))),
        };
        c.faqem_result_destroy(result);
        return made;
    }

    #word(address) {
        return new Uint32Array(this.#exports.memory.buffer, address, 1)[0];
    }

    #text(address) {
        const bytes = new Uint8Array(this.#exports.memory.buffer, address >>> 0);
        return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
    }
}

/** Kind and value of struct faqem_level. */
function levelTarget({ ratio, faces, maxError }, index) {
    if (ratio !== undefined) return [0, ratio];
    if (faces !== undefined) return [1, faces];
    if (maxError === undefined) throw new TypeError(`level ${index}: neither ratio nor faces nor maxError`);
    return String(maxError).endsWith("%") ? [3, parseFloat(maxError) / 100] : [2, Number(maxError)];
}

export async function load(wasm) {
    return new Faqem(await compile(wasm));
}

const byDefault = new Map();  // the modules of files beside this one, compiled once

/** Calls a function of Faqem in a worker of its own, which an AbortSignal ends. */
async function inWorker(method, values, { progress, signal, wasm, ...options } = {}, file = geometry) {
    signal?.throwIfAborted();
    if (wasm === undefined && !byDefault.has(file)) byDefault.set(file, compile(file()));
    const module = await (wasm === undefined ? byDefault.get(file) : compile(wasm));
    const worker = globalThis.Worker
        ? new Worker(new URL("./worker.js", import.meta.url), { type: "module" })
        : new (await import(/* @vite-ignore */ /* webpackIgnore: true */ "node:worker_threads")).Worker(new URL("./worker.js", import.meta.url));
    const ended = new AbortController();
    try {
        return await new Promise((resolve, reject) => {
            const listen = (name, to) => (worker.on ? worker.on(name, (data) => to({ data, message: data.message })) : worker.addEventListener(name, to));
            signal?.throwIfAborted();
            signal?.addEventListener("abort", () => reject(signal.reason), { signal: ended.signal });
            listen("error", ({ message }) => reject(new FaqemError(message)));
            listen("message", ({ data }) => {
                if (data.error) reject(Object.assign(new FaqemError(data.error.message), data.error));
                else if (data.result) resolve(data.result);
                else if (progress(...data.progress) === false) reject(new DOMException("cancelled", "AbortError"));
            });
            worker.postMessage({ module, method, values, options, reports: Boolean(progress) });
        });
    } finally {
        ended.abort();
        worker.terminate();
    }
}

export const simplify = (positions, triangles, options) => inWorker("simplify", [positions, triangles], options);
export const simplifyLevels = (positions, triangles, levels, options) => inWorker("simplifyLevels", [positions, triangles, levels], options);

export async function simplifyGlb(bytes, { codecs, ...options } = {}) {
    const { decode, encode } = { ...(globalThis.OffscreenCanvas && browserCodecs), ...codecs };
    if (!decode || !encode) throw new FaqemError("codecs: outside of browsers, decode() and encode() are needed", OPTION);
    if (!(bytes instanceof Uint8Array)) throw new TypeError("bytes: not a Uint8Array");
    for (const name of ["allowLarger", "imageFormat", "imageQuality", "jpegQuality", "maxBytes"])
        if (options[name] !== undefined) throw new FaqemError(`${name}: codecs.encode() decides on the encoding of images`, OPTION);
    const originals = [];
    const pixels = await decodeImages(bytes, decode, originals, options.signal);
    const { glb, report } = await inWorker("simplifyGlb", [pixels], options, bake);
    return { glb: await encodeImages(glb, encode, originals, options.signal), report };
}
