import type { NamedOptions } from "./options.js";

export type { NamedOptions };
export type Phase = "load" | "weld" | "simplify" | "map" | "bake" | "save";
/** Where the WebAssembly module is; by default the file `faqem.wasm` beside `faqem.js`. */
export type Wasm = string | URL | BufferSource | WebAssembly.Module;

/** How a function is called. The other options are those of the C interface, with names in camel case. */
export interface RunOptions extends NamedOptions {
    /** Called with the completed share of a phase, in [0, 1]. `false` cancels. */
    progress?: (phase: Phase, fraction: number) => boolean | void;
    /** Cancels. The call then throws the reason of the signal. */
    signal?: AbortSignal;
    wasm?: Wasm;
}

export interface MeshOptions extends RunOptions {
    /** A group (material) for each face. */
    faceGroups?: Uint32Array;
    /** A flag for each vertex; nonzero: it must not move. */
    vertexLocks?: Uint8Array;
    /** A factor on the costs for each vertex, in [1e-6, 1e6]. */
    vertexWeights?: Float32Array;
    /** `cornerWidth` attributes, such as UVs, for each of the three corners of each face; preserved. */
    cornerValues?: Float32Array;
    cornerWidth?: number;
}

export type Positions = Float32Array | Float64Array;

export interface Simplified<P extends Positions> {
    /** Three coordinates for each vertex. A vertex that did not move has those of the input, bit by bit. */
    positions: P;
    triangles: Uint32Array;
    /** For each vertex, an input vertex that was collapsed into it. */
    vertexOrigin: Uint32Array;
    /** For each face, the input face. */
    faceOrigin: Uint32Array;
    /** Empty without groups. */
    faceGroups: Uint32Array;
    /** Empty without corner values. */
    cornerValues: Float32Array;
    /** The report, see docs/reference.md. With `maxError` it has the distance from the original. */
    report: Record<string, any>;
}

/** One target. `maxError` is in model units, or with `%` of the diagonal of the bounding box. */
export type LevelTarget = { ratio: number } | { faces: number } | { maxError: number | string };
export type SimplifiedLevel<P extends Positions> = Simplified<P> & {
    /** Upper bound of the distance from the original, model units. */
    error: number;
};

/** An error of faqem: its status is that of the C interface. */
export class FaqemError extends Error {
    status?: number;
}

/** The functions below on the thread that calls them. */
export interface Faqem {
    readonly version: string;
    /** Name and help text of each option of the C interface. */
    optionHelp(): [string, string][];
    simplify<P extends Positions>(positions: P, triangles: Uint32Array | Uint16Array, options?: MeshOptions): Simplified<P>;
    simplifyLevels<P extends Positions>(
        positions: P, triangles: Uint32Array | Uint16Array, levels: LevelTarget[], options?: MeshOptions): SimplifiedLevel<P>[];
}
export function load(wasm?: Wasm): Promise<Faqem>;

/**
 * Simplifies a mesh in a worker.
 * @param positions  three coordinates for each vertex, finite
 * @param triangles  three vertices for each face, counter-clockwise as seen from outside
 * @throws FaqemError  the input or an option is invalid, or the memory does not suffice
 */
export function simplify<P extends Positions>(
    positions: P, triangles: Uint32Array | Uint16Array, options?: MeshOptions): Promise<Simplified<P>>;
/** Simplifies a mesh to several levels of detail in a worker; each continues from the one before it. */
export function simplifyLevels<P extends Positions>(
    positions: P, triangles: Uint32Array | Uint16Array, levels: LevelTarget[], options?: MeshOptions): Promise<SimplifiedLevel<P>[]>;

/** RGBA, top row first, sRGB as in the image file. */
export interface Pixels {
    width: number;
    height: number;
    data: Uint8Array | Uint8ClampedArray;
}
/** Codecs of images, which the module does not have. In browsers, each has a default. */
export interface Codecs {
    /** @param mimeType  image/png, image/jpeg or image/webp */
    decode?(file: Uint8Array, mimeType: string): Pixels | Promise<Pixels>;
    /** Gives a PNG or JPEG; the default a PNG. */
    encode?(pixels: Pixels & { data: Uint8ClampedArray }): Uint8Array | Promise<Uint8Array>;
}
export interface GlbOptions extends Omit<RunOptions, "allowLarger" | "imageFormat" | "imageQuality" | "jpegQuality" | "maxBytes"> {
    /** Needed outside of browsers. */
    codecs?: Codecs;
}
/**
 * Simplifies a GLB file and bakes its appearance into new textures, in a worker.
 * @param bytes  the file, with its images
 * @returns a GLB file, and the report, whose sizes of images are those of pixels
 * @throws FaqemError  the file or an option is invalid, a codec is missing, or the memory does not suffice
 */
export function simplifyGlb(bytes: Uint8Array, options?: GlbOptions): Promise<{ glb: Uint8Array; report: Record<string, any> }>;
