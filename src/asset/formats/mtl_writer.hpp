#pragma once
/// \file
/// Conversion of materials to an OBJ material library (MTL file).

#include <string>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// An image to be written to the folder of the library.
struct MtlImage {
    std::string name;        ///< file name
    Index image = no_index;  ///< index into Asset::images
};

/// A material library and its images.
struct MtlLibrary {
    std::string text;
    std::vector<std::string> names;  ///< unique names of the materials, in the given order
    std::vector<MtlImage> images;
};

/// The texture whose UV set and UV transform are used for the only UV set of the OBJ file: the base colour
/// texture if it is set, else the emissive texture, else the metallic-roughness texture, else the normal texture, set
/// or not.
const TextureRef& leading_texture(const Material& material);

/// Converts materials to a library: the inverse of read_mtl(), with Pr for roughness and Pm for metallic.
/// \param used    indices into asset.materials; no_index is the default material
/// \param stem    image i gets the file name `stem`_i with the extension of its type
/// \param losses  receives what a library cannot hold, one sentence each
MtlLibrary make_mtl(const Asset& asset, const std::vector<Index>& used, const std::string& stem,
                    std::vector<std::string>& losses);

/// Makes a name valid for a statement: control characters are replaced, blanks at both ends and trailing
/// backslashes are removed. Returns `fallback` if nothing is left.
std::string sanitized_name(const std::string& name, const std::string& fallback);

}  // namespace faqem::detail
