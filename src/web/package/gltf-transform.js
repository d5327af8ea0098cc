// A transform of glTF-Transform. gltf-transform.d.ts describes it.
import { WebIO } from "@gltf-transform/core";
import { cloneDocument, mergeDocuments, unpartition } from "@gltf-transform/functions";
import { simplifyGlb } from "./faqem.js";

const compressions = ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"];

export const rebake = (options) => async function rebake(document) {
    const copy = cloneDocument(document), root = document.getRoot();
    compressions.forEach((name) => copy.disposeExtension(name));  // the module does not read them, a document has no compressed data
    await copy.transform(unpartition());                          // a GLB has one buffer
    const extensions = copy.getRoot().listExtensionsUsed().map((extension) => extension.constructor);
    const io = new WebIO().setLogger(document.getLogger()).registerExtensions(extensions);
    const { glb } = await simplifyGlb(await io.writeBinary(copy), options);
    const made = await io.readBinary(glb);
    for (const edge of document.getGraph().listEdges()) edge.getChild().dispose();
    for (const extension of root.listExtensionsUsed()) extension.dispose();
    const copies = mergeDocuments(document, made), scene = made.getRoot().getDefaultScene();
    root.setDefaultScene(scene && copies.get(scene));
};
