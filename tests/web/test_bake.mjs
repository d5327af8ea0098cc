// Tests the baking of the installed npm package. Usage: node test_bake.mjs FOLDER, with the files that baked.py writes
import assert from "node:assert";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { test } from "node:test";
import { FaqemError, simplifyGlb } from "faqem";
import { PNG } from "pngjs";

const folder = process.argv[2];
const codecs = {
    decode: (file) => PNG.sync.read(Buffer.from(file)),
    encode: async (pixels) => new Uint8Array(PNG.sync.write({ ...pixels, data: Buffer.from(pixels.data) })),
};
const colours = new Uint8Array(readFileSync(`${folder}/colours.glb`));
const fails = (expected, { file = colours, ...options }) => assert.rejects(simplifyGlb(file, { codecs, ...options }), expected);

for (const name of readdirSync(folder).filter((file) => file.endsWith(".options")).map((file) => file.slice(0, -8))) {
    test(`${name} is baked`, async () => {
        const phases = new Set(), options = JSON.parse(readFileSync(`${folder}/${name}.options`));
        const file = new Uint8Array(readFileSync(`${folder}/${name}.glb`));
        const { glb, report } = await simplifyGlb(file, { codecs, progress: (phase) => void phases.add(phase), ...options });
        assert(report.faces_out > 0 && phases.size > 0);
        writeFileSync(`${folder}/${name}.out.glb`, glb);  // baked.py compares it
    });
}

test("a codec that is missing or fails is an error", async () => {
    const broken = () => { throw new Error("no such codec"); };
    await fails(new FaqemError("codecs: outside of browsers, decode() and encode() are needed", 2), { codecs: { decode: codecs.decode } });
    await fails({ name: "FaqemError", status: 3, message: "image '0': no such codec" }, { codecs: { ...codecs, decode: broken } });
    await fails({ message: "no such codec" }, { bake: "atlas", codecs: { ...codecs, encode: broken } });
    await fails({ status: 3, message: /4 bytes for 2 x 2/ }, { codecs: { ...codecs, decode: () => ({ width: 2, height: 2, data: new Uint8Array(4) }) } });
    await fails({ message: /neither a PNG nor a JPEG/ }, { bake: "atlas", codecs: { ...codecs, encode: () => new Uint8Array(20) } });
});

test("damaged files and options without effect are errors", async () => {
    for (const size of [0, 11, 19, 200, colours.length - 900])
        await fails({ name: "FaqemError", status: 3 }, { file: colours.slice(0, size) });
    await fails({ name: "FaqemError", status: 3, message: /^image '0'/ }, { file: colours.slice().fill(0, colours.length - 700) });  // in the PNG
    await fails({ name: "FaqemError", status: 2, message: /^maxBytes/ }, { maxBytes: 1000 });
    await fails({ name: "FaqemError", status: 2, message: /texture-size/ }, { textureSize: -1 });
});

test("an AbortSignal ends the baking, also while images are decoded", async () => {
    const during = new AbortController(), decoding = new AbortController();
    await fails({ name: "AbortError" }, { signal: during.signal, progress: () => during.abort() });
    await fails({ name: "AbortError" }, { signal: decoding.signal, codecs: { ...codecs, decode: (file) => (decoding.abort(), codecs.decode(file)) } });
});
