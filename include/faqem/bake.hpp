#pragma once
/// \file
/// Door (c): a textured asset in, a simplified one with a new texture out. Needs the standard library only.

#include <iosfwd>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"
#include "faqem/simplify.hpp"
#include "faqem/surface_map.hpp"

namespace faqem {

/// The geometry stage's result: one SimplifyResult per part of the source, in its order, history on.
struct SimplifiedParts {
    std::vector<SimplifyResult> parts;
    Report report;  ///< sums over the parts
};

/// Where a texel lies on the original: the sample of it next to its middle.
struct TexelOrigin {
    Index part = no_index;  ///< into Asset::parts of the source; no_index: the texel shows no triangle
    SurfacePoint point;     ///< on a face of that part
};

/// The map of one page, by texel, row 0 at the top.
struct PageOrigins {
    Index material = no_index;  ///< of the result, whose images the page holds
    std::uint32_t width = 0, height = 0;
    std::vector<TexelOrigin> texels;  ///< width * height
};

/// Writes the maps of all pages in the format of docs/correspondence-format.md, little-endian on any machine.
/// The caller checks the stream. O(texels)
FAQEM_EXPORT void write(const std::vector<PageOrigins>& pages, std::ostream& out);

/// An asset and what was done to make it.
struct SimplifiedAsset {
    Asset asset;
    Report report;
    std::vector<CollapseHistory> histories;  ///< one per part; empty unless options.history is on
    /// One per page of a new atlas; empty unless options.bake.correspondence is on.
    std::vector<PageOrigins> correspondence;
};

/// Stage one: simplifies every part by itself, in its own coordinates. The target counts for the whole asset.
/// With Budget::scene it is shared out by error: the parts are simplified as far as they go, and the
/// collapses that cost least in the scene, whichever part they are in, say how many faces each keeps. With
/// Budget::mesh it is shared out in proportion to the parts' faces; where it has room for them, a part gets
/// no fewer than 4 faces (or all it has) for each of its connected components, at the others' cost. No part
/// gets fewer than 4, or all it has. For Options::max_error every part is measured against its original, in
/// the units of the scene: a part that the scene shows several times counts at its largest scale, one that it
/// does not show as it is.
///
/// \throws as simplify(const MeshView&, ...), and InputError naming the part or material where the asset's
///         arrays and indices do not fit each other or a number is not finite
FAQEM_EXPORT SimplifiedParts simplify_parts(const Asset& source, const Options& options);

/// Stage two: gives the simplified parts normals, UVs, materials and images.
/// \param source   the asset that `simplified` was made from
/// \param simplified    result of simplify_parts() with the same options
/// \return report.stop is `cancelled`, and the asset has no parts, if the progress callback cancelled
/// \throws InputError        an image is damaged
/// \throws UnsupportedError  an image that is needed is neither PNG nor JPEG
FAQEM_EXPORT SimplifiedAsset bake(const Asset& source, const SimplifiedParts& simplified,
                                  const Options& options);

/// Both stages in one call.
/// \throws OptionError, InputError, UnsupportedError
FAQEM_EXPORT SimplifiedAsset simplify(const Asset& source, const Options& options = {});

}  // namespace faqem
