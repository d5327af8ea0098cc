// Compiled, not run: what the types of the package allow.
import { Document } from "@gltf-transform/core";
import { load, simplify, simplifyGlb, simplifyLevels, type Simplified } from "faqem";
import { rebake } from "faqem/gltf-transform";
import wasm from "faqem/inline";

const positions = new Float32Array(9), triangles = new Uint16Array(3), { signal } = new AbortController();
const made: Simplified<Float32Array> = await simplify(positions, triangles, {
    preset: "best", maxError: "0.1%", history: true, wasm, signal, progress: (phase, fraction) => phase !== "weld" || fraction < 1 });
const levels = await simplifyLevels(new Float64Array(9), triangles, [{ ratio: 0.5 }, { maxError: 0.1 }], { threads: 1 });
const error: number = levels[0].error + (await load(new URL("faqem.wasm", "https://example.com"))).version.length;
// @ts-expect-error: no such preset
await simplify(made.positions, made.triangles, { preset: "better", faces: error });
const { glb }: { glb: Uint8Array } = await simplifyGlb(new Uint8Array(9), {
    faces: 9, textureSize: 64, signal, codecs: { decode: async (file, mimeType) => ({ width: 1, height: mimeType.length, data: file }), encode: ({ data }) => new Uint8Array(data) } });
await new Document().transform(rebake({ ratio: 0.1, textureSize: 64 }));
// @ts-expect-error: no option of the package
await simplifyGlb(glb, { maxBytes: 1000 });
