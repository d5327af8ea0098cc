#pragma once
/// \file
/// Materials to an OBJ material library.

#include <string>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// An image to be written beside the library.
struct MtlImage {
    std::string name;        ///< of the file
    Index image = no_index;  ///< into Asset::images
};

/// A library and what belongs to it.
struct MtlLibrary {
    std::string text;
    std::vector<std::string> names;  ///< of the materials, unique, in the order given
    std::vector<MtlImage> images;
};

/// The texture whose UV set and transform the OBJ file's only UVs are made for: that of the base colour, or
/// the first other one there is. May have no image.
const TextureRef& leading_texture(const Material& material);

/// Writes materials: the reverse of read_mtl(), with Pr and Pm for roughness and metallic.
/// \param used    into asset.materials, or no_index for the default material
/// \param stem    image i is called `stem`_i with the ending of its type
/// \param losses  receives what a library cannot hold
MtlLibrary make_mtl(const Asset& asset, const std::vector<Index>& used, const std::string& stem,
                    std::vector<std::string>& losses);

/// A name that fits in one statement: no control characters, no blanks at the ends, not empty.
std::string sanitized_name(const std::string& name, const std::string& fallback);

}  // namespace faqem::detail
