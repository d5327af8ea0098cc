// Tests the installed npm package: results are the bytes of the native library. Usage: node test_package.mjs CASES
import assert from "node:assert";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { FaqemError, load, simplify, simplifyLevels } from "faqem";
import wasm from "faqem/inline";

const folder = process.argv[2];
const array = (Type, name) => new Type(new Uint8Array(readFileSync(`${folder}/${name}`)).buffer);
const grid = () => [array(Float32Array, "grid.positions"), array(Uint32Array, "grid.triangles")];
const camel = (name) => name.replace(/_./g, ([, letter]) => letter.toUpperCase());
const faqem = await load();

for (const file of readdirSync(folder).filter((name) => name.endsWith(".json"))) {
    const name = file.slice(0, -5);
    test(`${name} has the bytes of the native library`, () => {
        const { options, seconds } = JSON.parse(readFileSync(`${folder}/${file}`));
        const named = Object.fromEntries(Object.entries(options).map(([key, value]) => [camel(key), value]));
        const cornerValues = array(Float32Array, `${name}.values`);
        const corners = cornerValues.length ? { cornerValues, cornerWidth: 2 } : {};
        const out = faqem.simplify(array(Float32Array, `${name}.positions`), array(Uint32Array, `${name}.triangles`), { ...named, ...corners });
        console.log(`${name}: ${out.triangles.length / 3} faces, ${(out.report.seconds.total / seconds).toFixed(1)} times native's time`);
        for (const key of ["positions", "triangles", "vertexOrigin", "faceOrigin", "cornerValues"])
            assert.deepStrictEqual(Buffer.from(out[key].buffer), readFileSync(`${folder}/${name}.out-${key}`), key);
    });
}

test("levels have the faces and errors of the native library", async () => {
    const mesh = [array(Float64Array, "levels.positions"), array(Uint32Array, "levels.triangles")];
    const levels = await simplifyLevels(...mesh, [{ ratio: 0.5 }, { maxError: "1%" }]);
    assert.deepStrictEqual(levels.map((level) => [level.triangles.length / 3, level.error]), JSON.parse(readFileSync(`${folder}/levels.txt`)));
    assert(levels[0].positions instanceof Float64Array);
});

test("a worker makes the same, reports its progress and takes the module inlined", async () => {
    const shown = [];
    const [positions, triangles] = grid();
    const options = { ratio: 0.1, wasm, progress: (phase, fraction) => void shown.push([phase, fraction]) };
    const out = await simplify(positions, triangles, options);
    assert.deepStrictEqual(Buffer.from(out.positions.buffer), readFileSync(`${folder}/grid.out-positions`));
    assert(shown.length > 1 && shown.every(([, fraction], i) => fraction >= 0 && fraction <= 1 && (i === 0 || shown[i - 1][0] !== "simplify" || shown[i][1] >= shown[i - 1][1])));
    assert(positions.length > 0, "the arrays stay with the caller");
});

test("an AbortSignal ends a call", async () => {
    const controller = new AbortController();
    const ended = simplify(...grid(), { signal: controller.signal, progress: () => controller.abort() });
    await assert.rejects(ended, { name: "AbortError" });
    await assert.rejects(simplify(...grid(), { signal: AbortSignal.abort() }), { name: "AbortError" });
    assert.throws(() => faqem.simplify(...grid(), { progress: () => false }), { name: "AbortError" });
    assert.throws(() => faqem.simplify(...grid(), { signal: controller.signal }), { name: "AbortError" });
});

test("errors name what is wrong, and the instance is usable afterwards", async () => {
    const [positions] = grid();
    await assert.rejects(simplify(positions, Uint32Array.of(0, 1, 1e6)), { name: "FaqemError", status: 3, message: /1000000/ });
    assert.throws(() => faqem.simplify(...grid(), { ratoi: 0.5 }), new FaqemError("unknown option 'ratoi'; did you mean 'ratio'?", 2));
    assert.throws(() => faqem.simplify(positions, Uint32Array.of(0, 1)), RangeError);
    assert.throws(() => faqem.simplify([...positions], Uint32Array.of(0, 1, 2)), TypeError);
    assert.throws(() => faqem.simplifyLevels(...grid(), [{}]), TypeError);
    await assert.rejects(simplify(...grid(), { wasm: new URL("missing.wasm", import.meta.url) }), { code: "ENOENT" });
    assert.strictEqual(faqem.simplify(positions, Uint32Array.of(0, 1, 2), { ratio: 1 }).triangles.length, 3);
});
