import type { Transform } from "@gltf-transform/core";
import type { GlbOptions } from "./faqem.js";

/**
 * A transform of glTF-Transform 4 that replaces the content of a document by what simplifyGlb() makes of it, without
 * compression of meshes. After an error the document is as before.
 */
export function rebake(options?: GlbOptions): Transform;
