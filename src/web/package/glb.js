// GLB files whose images are pixels: codecs of JavaScript decode them before a call of the module and encode them after it.
import { FaqemError } from "./faqem.js";

const GLB = 0x46546c67, JSON_CHUNK = 0x4e4f534a, BIN_CHUNK = 0x004e4942;
const HEADER = 33;  // signature and IHDR of a PNG, after which raw_images.cpp has the pixels
const INPUT = 3;    // of faqem_status

const viewOf = (bytes) => new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
const contentOf = (bin, { byteOffset = 0, byteLength }) => bin.subarray(byteOffset, byteOffset + byteLength);

/** The media type of a file that begins like an image of the kinds that codecs decode. */
function mediaType(file) {
    const begin = file?.length >= 12 ? viewOf(file).getUint32(0) : 0;
    if (begin === 0x89504e47) return "image/png";
    if (begin >>> 8 === 0xffd8ff) return "image/jpeg";
    return begin === 0x52494646 && viewOf(file).getUint32(8) === 0x57454250 ? "image/webp" : undefined;
}

/** The document and the binary chunk of a GLB file with images; nothing of others, and of damaged ones: the module tells more. */
function parse(bytes) {
    const view = viewOf(bytes), chunks = {};
    for (let at = 12; at + 8 <= bytes.length; at += 8 + view.getUint32(at, true))
        chunks[view.getUint32(at + 4, true)] ??= bytes.subarray(at + 8, at + 8 + view.getUint32(at, true));
    try {
        const json = JSON.parse(new TextDecoder().decode(chunks[JSON_CHUNK]));
        const isPlain = view.getUint32(0, true) === GLB && Array.isArray(json.images) && json.buffers?.[0]?.uri === undefined;
        return isPlain ? { json, bin: chunks[BIN_CHUNK] ?? new Uint8Array(0) } : undefined;
    } catch {
        return undefined;
    }
}

/** A GLB file with pieces of the binary chunk, whose places `view`, if there is one, receives. */
function assemble(json, pieces) {
    let length = 0;
    const aligned = (size) => size + (-size & 3);
    const offsets = pieces.map(({ bytes, view }) => {
        const byteOffset = length;
        length = aligned(length + bytes.length);
        if (view) Object.assign(view, { byteOffset, byteLength: bytes.length });
        return byteOffset;
    });
    json.buffers = [{ ...json.buffers?.[0], byteLength: length }, ...(json.buffers ?? []).slice(1)];
    const text = new TextEncoder().encode(JSON.stringify(json)), start = 28 + aligned(text.length);
    const file = new Uint8Array(start + length).fill(32, 20, start), view = viewOf(file);
    [GLB, 2, file.length, start - 28, JSON_CHUNK].forEach((word, i) => view.setUint32(4 * i, word, true));
    [length, BIN_CHUNK].forEach((word, i) => view.setUint32(start - 8 + 4 * i, word, true));
    file.set(text, 20);
    pieces.forEach(({ bytes }, i) => file.set(bytes, start + offsets[i]));
    return file;
}

/** The pixels of an image after the header of a PNG. */
async function decoded(decode, file, type, name) {
    try {
        const { width, height, data } = await decode(file, type), raw = new Uint8Array(HEADER + 4 * width * height);
        if (data.length !== raw.length - HEADER) throw new RangeError(`decode() gave ${data.length} bytes for ${width} x ${height} pixels`);
        [0x89504e47, 0x0d0a1a0a, 13, 0x49484452, width, height, 0x08060000].forEach((word, i) => viewOf(raw).setUint32(4 * i, word));
        raw.set(data, HEADER);
        return raw;
    } catch (cause) {
        throw Object.assign(new FaqemError(`image '${name}': ${cause?.message ?? cause}`, INPUT), { cause });
    }
}

/** Adds the pixels of the images to a GLB file. `originals` receives these and the images. */
export async function decodeImages(bytes, decode, originals, signal) {
    const { json, bin } = parse(bytes) ?? {};
    if (!json) return bytes;
    const pieces = [{ bytes: bin }], views = new Map();
    for (const [index, image] of json.images.entries()) {
        const source = image?.uri ?? json.bufferViews?.[image?.bufferView];
        let file = source?.buffer === 0 ? contentOf(bin, source) : undefined;
        if (image?.uri?.startsWith?.("data:")) file = new Uint8Array(await (await fetch(image.uri)).arrayBuffer());
        const type = mediaType(file);
        if (!type) continue;
        signal?.throwIfAborted();
        if (!views.has(source)) {
            const raw = await decoded(decode, file, type, image.name ?? index), view = { buffer: 0 };
            pieces.push({ bytes: raw, view });
            originals.push({ raw, file, type });
            views.set(source, (json.bufferViews ??= []).push(view) - 1);
        }
        delete image.uri;
        Object.assign(image, { bufferView: views.get(source), mimeType: "image/png" });
    }
    return assemble(json, pieces);
}

/** Encodes the pixels in a GLB file of the module; unchanged ones are the images that they come from. */
export async function encodeImages(bytes, encode, originals, signal) {
    const { json, bin } = parse(bytes) ?? {};
    if (!json) return bytes;
    const pieces = json.bufferViews.map((view) => ({ bytes: contentOf(bin, view), view }));
    for (const image of json.images) {
        const piece = pieces[image.bufferView], raw = piece?.bytes;
        const [width, height] = mediaType(raw) === "image/png" ? [viewOf(raw).getUint32(16), viewOf(raw).getUint32(20)] : [];
        if (raw?.length !== HEADER + 4 * width * height) continue;
        signal?.throwIfAborted();
        const original = originals.find((one) => one.type !== "image/webp" && one.raw.length === raw.length && one.raw.every((value, i) => value === raw[i]));
        piece.bytes = original?.file ?? (await encode({ width, height, data: new Uint8ClampedArray(raw.subarray(HEADER)) }));
        image.mimeType = mediaType(piece.bytes);
        if (!["image/png", "image/jpeg"].includes(image.mimeType)) throw new FaqemError("encode() gave neither a PNG nor a JPEG");
    }
    return assemble(json, pieces);
}

/** The codecs of browsers. A canvas multiplies colours by alpha, so those under low alpha lose precision. */
export const browserCodecs = {
    async decode(file, type) {
        const bitmap = await createImageBitmap(new Blob([file], { type }), { premultiplyAlpha: "none", colorSpaceConversion: "none" });
        const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
        context.drawImage(bitmap, 0, 0);
        return context.getImageData(0, 0, bitmap.width, bitmap.height);
    },
    async encode({ width, height, data }) {
        const canvas = new OffscreenCanvas(width, height);
        canvas.getContext("2d").putImageData(new ImageData(data, width, height), 0, 0);
        return new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
    },
};
