// node simplify.mjs INDEX IN OUT FACES [update]: simplifies a mesh with the meshoptimizer package whose main
// file is INDEX, and prints elapsed time and CPU time in seconds. Format of IN and OUT, all values with 32
// bits: numbers of vertices and triangles, x y z of each vertex (float), the three vertices of each triangle.
// With `update` vertices are moved.
import { readFileSync, writeFileSync } from "node:fs";
import { performance } from "node:perf_hooks";
import { pathToFileURL } from "node:url";

const [index, input, output, faces, update] = process.argv.slice(2);
const loaded = await import(pathToFileURL(index));
const simplifier = (loaded.MeshoptSimplifier ? loaded : loaded.default).MeshoptSimplifier;
await simplifier.ready;
simplifier.useExperimentalFeatures = true; // required by version 0.18

const { buffer, byteOffset } = readFileSync(input);
const [vertices, triangles] = new Uint32Array(buffer, byteOffset, 2);
const original = {
  positions: new Float32Array(buffer, byteOffset + 8, 3 * vertices),
  indices: new Uint32Array(buffer, byteOffset + 8 + 12 * vertices, 3 * triangles),
};
const limit = 3.4e38; // unlimited error

function simplify({ positions, indices }) {
  if (!update) {
    const [kept] = simplifier.simplify(indices, positions, 3, 3 * faces, limit);
    return { positions, indices: kept };
  }
  // It modifies its arguments and returns the number of remaining indices.
  const none = new Float32Array(0);
  const [count] = simplifier.simplifyWithUpdate(indices, positions, 3, none, 0, [], null, 3 * faces, limit);
  return { positions, indices: indices.slice(0, count) };
}

let result, seconds, cpu;
for (let run = 0; run < 2; ++run) { // the first run is for the just-in-time compiler
  const mesh = { positions: original.positions.slice(), indices: original.indices.slice() };
  const start = performance.now();
  const used = process.cpuUsage();
  result = simplify(mesh);
  seconds = (performance.now() - start) / 1000;
  const { user, system } = process.cpuUsage(used);
  cpu = (user + system) / 1e6;
}
const counts = new Uint32Array([result.positions.length / 3, result.indices.length / 3]);
writeFileSync(output, Buffer.concat([counts, result.positions, result.indices].map(
  (array) => Buffer.from(array.buffer, array.byteOffset, array.byteLength))));
console.log(seconds, cpu);
