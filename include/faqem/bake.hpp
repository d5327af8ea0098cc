#pragma once
/// \file
/// Entry point for textured assets: simplification, and baking of the appearance into new textures.
/// Needs only the standard library.

#include <filesystem>
#include <iosfwd>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"
#include "faqem/simplify.hpp"
#include "faqem/surface_map.hpp"

namespace faqem {

/// Result of the geometry stage, simplify_parts().
struct SimplifiedParts {
    std::vector<SimplifyResult> parts;  ///< one per part of the source, in its order, each with a history
    Report report;                      ///< sums over the parts
    /// For Bake::automatic: the same parts, simplified to the same face counts with the source's UVs and vertex colours
    /// as attributes. bake() chooses among both for each part. Empty: all parts are those without UVs.
    std::vector<SimplifyResult> with_uvs;
};

/// Point of the original surface that a texel corresponds to: that of the sample nearest to the texel centre.
struct TexelOrigin {
    Index part = no_index;  ///< index into Asset::parts of the source; no_index: the texel shows no triangle
    SurfacePoint point;     ///< on a face of that part
};

/// Correspondence of all texels of one page, top row first.
struct PageOrigins {
    Index material = no_index;  ///< material of the result whose images the page holds
    std::uint32_t width = 0, height = 0;
    std::vector<TexelOrigin> texels;  ///< width * height
};

/// Writes the correspondence of all pages in the binary little-endian format of
/// docs/history-format.md.
/// \param out  a binary stream; the caller checks its state afterwards
/// Complexity: O(texels).
FAQEM_EXPORT void write(const std::vector<PageOrigins>& pages, std::ostream& out);

/// A simplified asset, with the report and the records of the run.
struct SimplifiedAsset {
    Asset asset;
    Report report;
    std::vector<CollapseHistory> histories;  ///< one per part; empty unless Options::history is on
    /// One per page of a new atlas; empty unless BakeOptions::correspondence is on.
    std::vector<PageOrigins> correspondence;
};

/// Geometry stage: simplifies each part in its own coordinates. The target is the total over all parts.
///
/// With Budget::scene the target is distributed by error: every part is simplified as far as possible, and
/// the collapses of least cost in the scene, over all parts, determine how many faces each part keeps. With
/// Budget::mesh it is distributed in proportion to the parts' face counts. If the target is large enough,
/// each part then gets at least 4 faces (or all it has) for each of its connected components. In both cases
/// no part gets fewer than 4 faces (or all it has), so the total may exceed the target.
///
/// If the asset is a glTF scene with coarser levels of detail (MSFT_lod), these are left out, with a warning in the
/// report: their parts get no faces, and what save() writes of a result has neither their nodes nor the extension.
///
/// For Options::max_error every part is measured against its original, in scene units: a part counts at the
/// largest scale of its instances, and at scale 1 if it has none.
///
/// \param source   the asset; read only during the call
/// \param options  BakeOptions::kind determines which attributes and material boundaries are preserved
/// \return one result per part. If the progress callback cancels, report.stop is StopReason::cancelled
/// \throws OptionError  an option is out of range
/// \throws InputError  arrays or indices of the asset are inconsistent, or a number is not finite; the
///                     message names the part or material
/// Complexity: the sum of simplify(const MeshView&, const Options&) over the parts. Budget::scene adds one
/// run with Preset::fast per part if several parts have faces, and Bake::automatic a second simplification of each
/// part if SimplifiedParts::with_uvs is made.
FAQEM_EXPORT SimplifiedParts simplify_parts(const Asset& source, const Options& options);

/// Appearance stage: gives the simplified parts normals, UVs, materials and images. If Options::max_seconds, which
/// counts from the start of the call, is over before new textures are complete, the parts have the images of the
/// source and UVs that are read from it; the report has a warning. The rules about the size of results (docs/assets.md)
/// are applied to the images; the faces stay. The report begins with the warnings of the source.
/// \param source      the asset that `simplified` was made from
/// \param simplified  result of simplify_parts() with the same options
/// \param options     see Options::bake
/// \return the asset. If the progress callback cancels, report.stop is StopReason::cancelled and the asset is
///         empty
/// \throws OptionError  an option is out of range, or a correspondence is requested without a new atlas
/// \throws InputError  an image is damaged, or `simplified` does not match `source`
/// \throws UnsupportedError  an image that is needed has a format that decode() does not support
/// \throws TimeLimitError  max_seconds was over before the texture of a requested correspondence was complete
/// \throws ByteLimitError  even the smallest images exceed Options::max_bytes
FAQEM_EXPORT SimplifiedAsset bake(const Asset& source, const SimplifiedParts& simplified,
                                  const Options& options);

/// Simplifies an asset and bakes its appearance: simplify_parts(), then bake(), with parts that share boundary edges as
/// one (docs/method.md). Options::max_seconds holds for both. Options::max_bytes: docs/assets.md, "Size of results".
/// \throws OptionError, InputError, UnsupportedError, TimeLimitError  as both stages
/// \throws ByteLimitError  no result has at most Options::max_bytes
FAQEM_EXPORT SimplifiedAsset simplify(const Asset& source, const Options& options = {});

/// Loads a model, simplifies it, and saves the result: load(), simplify() and save() within one Options::max_seconds.
/// \param file       of the model
/// \param out        file of the result, another one than `file`; its extension determines Options::format
/// \param options    as for simplify(const Asset&, const Options&)
/// \param overwrite  whether existing files may be replaced; that of `out` is looked for before the work
/// \return the report, with the sizes of the files and the warnings of all steps. If the progress callback cancels,
///         nothing is left of the model, or Options::max_error is exceeded, nothing is saved, and Report::bytes_out is 0
/// \throws OptionError, InputError, UnsupportedError, TimeLimitError, ByteLimitError, WriteError  as the three steps; an
///     InputError also if the model has no triangles
FAQEM_EXPORT Report simplify(const std::filesystem::path& file, const std::filesystem::path& out,
                             const Options& options = {}, Overwrite overwrite = Overwrite::no);

}  // namespace faqem
