#pragma once
// Helpers for the tests of the file formats.

#include <filesystem>
#include <fstream>
#include <map>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/error.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"

namespace faqem::testing {

namespace fs = std::filesystem;

inline void put(const fs::path& file, const std::string& content) {
    std::ofstream(file, std::ios::binary) << content;
}

inline std::string get(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream content;
    content << in.rdbuf();
    return content.str();
}

/// Texts of files, by their path relative to a folder.
using Texts = std::map<std::string, std::string>;

/// All files below a folder.
inline Texts texts_in(const fs::path& folder) {
    Texts texts;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) texts[entry.path().lexically_relative(folder)] = get(entry.path());
    return texts;
}

/// The text with the first `what` replaced.
inline std::string with_first(std::string text, const std::string& what, const std::string& by) {
    return text.replace(text.find(what), what.size(), by);
}

/// The text with each `what` replaced.
inline std::string with_each(std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
        text.replace(at, what.size(), by);
    return text;
}

inline std::span<const std::uint8_t> bytes_of(std::string_view text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// Three vertices, as in OFF and ASCII PLY files.
inline const std::string three_vertices = "0 0 0\n1 0 0\n1 1 0\n";

/// Files whose format is detected, but which are not valid images.
inline const std::string png_signature = "\x89PNG\r\n\x1a\n and so on";
inline const std::string jpeg_signature = "\xFF\xD8\xFF and so on";

/// An image file in memory.
inline Image image_of(const std::string& bytes, const std::string& name = "") {
    Image image;
    image.name = name;
    image.encoded.assign(bytes.begin(), bytes.end());
    return image;
}

/// An asset of one part whose faces have no material.
inline Asset one_part(std::vector<Vec3> positions, std::vector<Triangle> triangles) {
    Asset asset;
    Part& part = asset.parts.emplace_back();
    part.face_material.assign(triangles.size(), no_index);
    part.positions = std::move(positions);
    part.triangles = std::move(triangles);
    return asset;
}

}  // namespace faqem::testing
