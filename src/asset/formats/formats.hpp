#pragma once
/// \file
/// Reading and writing of the formats other than glTF.

#include <cstdint>
#include <filesystem>
#include <span>

#include "asset/io/encoded_model.hpp"
#include "asset/io/file_finder.hpp"
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

/// Reads an ASCII or binary PLY file of either byte order as one part.
///
/// Supported properties:
/// - `vertex`: x y z; nx ny nz; red green blue [alpha] (also r g b a, diffuse_red ...), as integers over
///   their full range or floats in [0, 1], where the colour is sRGB and converted to linear, and alpha is
///   linear; s t (also u v, texture_u texture_v) with v' = 1 - v
/// - `face`: the list vertex_indices or vertex_index; polygons are split by triangulate(). The list texcoord, two
///   numbers for each corner, texnumber, and red green blue [alpha]: see polygon_asset(), also for `comment TextureFile`
/// - `tristrips`: the same list, with -1 between strips
///
/// Float colours above 2 are taken as 0 to 255, with a warning. Everything else is ignored. Faces with fewer than three
/// corners are left out with a warning. Counts are checked against the size of the file before memory is allocated.
/// \param bytes  content of the file, borrowed
/// \param file   path, for messages
/// \return an asset with one part, and warnings
/// \throws InputError  with the element and its index starting at 0 (`face 17`) or the line of the header, if
///                     the file is invalid; or if there are no faces
Asset read_ply(std::span<const std::uint8_t> bytes, const std::filesystem::path& file);

/// Encodes an asset as binary little-endian PLY. The scene is flattened to world space. Positions are floats
/// if all of them are representable as float, otherwise doubles; colours are 8-bit sRGB; the first UV set is
/// written as s t.
/// \param file  its name
EncodedModel encode_ply(const Asset& asset, const std::filesystem::path& file);

/// Adds the files of the comments `TextureFile` in the header.
/// \param model  path of a regular file, which may be damaged
void list_ply_references(const std::filesystem::path& model, ReferenceList& files);

/// Reads an STL file as one part.
///
/// The file is binary if its size is 84 + 50 n bytes, where n is the facet count at byte 80, or if there is a
/// zero among the first 512 bytes; otherwise it is read as ASCII. If a count is 0, or more than there is room for, all
/// whole facets are read, with a warning. Colours of facets in the attributes of Magics, VisCAM and SolidView become vertex
/// colours; other attributes are ignored with a warning, and bytes after the last facet, too. Corners at equal positions share a vertex (-0 equals 0) if
/// they have the same colour; vertices are in the order of their first use. Facet normals are ignored, since
/// they follow from the positions. The solids of an ASCII file become objects of the part. Text after the last
/// solid is ignored with a warning.
/// \param bytes  content of the file, borrowed
/// \param file   path, for messages
/// \return an asset with one part, and warnings
/// \throws InputError  with the line, if an ASCII file is invalid; if a binary file is too short for a facet, or its count is
///     wrong and a coordinate not finite; if there are no faces
Asset read_stl(std::span<const std::uint8_t> bytes, const std::filesystem::path& file);

/// Encodes an asset as binary STL. The scene is flattened to world space.
/// \param file  its name
/// \throws WriteError  a coordinate exceeds the range of float
EncodedModel encode_stl(const Asset& asset, const std::filesystem::path& file);

/// Reads an ASCII OFF file as one part: OFF, STOFF, COFF, NOFF and their combinations (ST, then C, then N).
///
/// The keyword and the number of edges may be missing, the counts may be on the line of the keyword, and
/// comments (`#`) may be anywhere. A vertex line holds x y z, then the normal (N), then the colour (C: three or
/// four integers in [0, 255] or floats in [0, 1]; sRGB, converted to linear), then s t (ST; v' = 1 - v).
/// Colours of faces, likewise with three or four components, become vertex colours unless vertices have
/// colours; faces without one are white. Indices into a colour map are ignored with a warning. Polygons are
/// split by triangulate(). Faces with fewer than three corners are left out with a warning. Source: Geomview
/// manual, "OFF Files".
/// \param text  content of the file, borrowed
/// \param file  path, for messages
/// \return an asset with one part, and warnings
/// \throws InputError        with the line, if the file is invalid; or if there are no faces
/// \throws UnsupportedError  4OFF, nOFF or binary OFF
Asset read_off(std::span<const std::uint8_t> text, const std::filesystem::path& file);

}  // namespace faqem::detail
