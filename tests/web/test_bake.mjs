// Tests the baking of the installed npm package. Usage: node test_bake.mjs FOLDER, with the files that baked.py writes
import assert from "node:assert";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { test } from "node:test";
import { WebIO } from "@gltf-transform/core";
import { KHRMaterialsClearcoat } from "@gltf-transform/extensions";
import { FaqemError, simplifyGlb } from "faqem";
import { rebake } from "faqem/gltf-transform";
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

test("rebake() makes of a glTF-Transform document what simplifyGlb() makes of its file", async () => {
    const io = new WebIO().registerExtensions([KHRMaterialsClearcoat]), options = { codecs, faces: 150, bake: "atlas", textureSize: 64 };
    const document = await io.readBinary(new Uint8Array(readFileSync(`${folder}/maps.glb`))), root = document.getRoot();
    const coat = document.createExtension(KHRMaterialsClearcoat).createClearcoat().setClearcoatFactor(0.5);
    root.listMaterials()[0].setExtension(coat.extensionName, coat);
    root.setExtras({ of: "the document" });
    const before = await io.writeBinary(document), made = await simplifyGlb(before, options);
    root.listAccessors()[0].setBuffer(document.createBuffer());
    await assert.rejects(document.transform(rebake({ ...options, textureSize: -1 })), { name: "FaqemError", status: 2 });
    assert.strictEqual(root.listBuffers().length, 2, "an error leaves the document unchanged");
    await document.transform(rebake(options));
    assert.deepStrictEqual(root.getExtras(), { of: "the document" });
    const expected = await io.readBinary(made.glb);
    expected.getRoot().setExtras(root.getExtras());
    assert(expected.getRoot().listMaterials()[0].getExtension(coat.extensionName), "with the extension");
    assert.deepStrictEqual(await io.writeBinary(document), await io.writeBinary(expected));
});

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
