#pragma once
/// \file
/// Reading and writing of Wavefront OBJ files.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "asset/io/encoded_model.hpp"
#include "asset/io/reference_list.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// The group of faces before the first `g`.
inline constexpr const char* default_group_name = "default";

/// Reads an OBJ file.
///
/// All objects are read as one part, so that no cracks open between them; the part has the name of the first
/// object, Part::face_object if several have faces, and Part::face_group. Vertex i of the part is position i (`v`) with
/// the vt and vn of its first corner. Corners of position i with another vt or vn get additional vertices after all
/// positions, in the order of the faces. Polygons are split by triangulate(). Colours after a position are sRGB values
/// and are converted to linear: see ObjColors. UVs are converted by v' = 1 - v. Corners without a normal after an `s`
/// get one by add_smoothed_normals(). See read_mtl() for materials, and divide_into_tiles() for UDIM; a missing library
/// or material is a warning. Lines, points, unknown statements and faces with fewer than three corners are skipped with
/// a counted warning.
/// \param text  content of the file, borrowed
/// \param file  path; material libraries and images are searched in its folder
/// \return an asset with one part, and warnings
/// \throws InputError  with the line, if a number or an index is invalid; or if there are no faces
Asset read_obj(std::span<const std::uint8_t> text, const std::filesystem::path& file);

/// Adds the libraries of an OBJ file, every texture statement of these, and other files that it names. Of the files,
/// only libraries in the folder of the model or below it are read.
/// \param model  path of a regular file, which may be larger than the memory
void list_obj_references(const std::filesystem::path& model, ReferenceList& files);

/// Adds the library itself and its textures.
/// \param library  path of a regular file
void list_library_references(const std::filesystem::path& library, ReferenceList& files);

/// Encodes an asset as NAME.obj, and as NAME.mtl and NAME_0.png ... if it has materials and images. The OBJ
/// file is the last. The scene is flattened to world space. Positions are written in float precision if
/// all are representable as float, else in double precision. Equal positions, UVs and normals share a line.
/// \param file  name of the OBJ file
EncodedModel encode_obj(const Asset& asset, const std::filesystem::path& file);

}  // namespace faqem::detail
