#pragma once
/// \file
/// Reading and writing of glTF 2.0 files (.glb and .gltf).

#include <cstdint>
#include <filesystem>
#include <span>

#include "asset/io/encoded_model.hpp"
#include "asset/io/file_finder.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// Reads a GLB or a JSON glTF file, which are distinguished by their content. The asset has one part per
/// mesh, in the order of the meshes.
/// \param bytes  content of the file, borrowed
/// \param file   path; buffers and images are searched in its folder. Empty: there are no files
/// \throws ReadError         if a buffer cannot be read
/// \throws InputError        if the file is invalid
/// \throws UnsupportedError  if it requires an extension or an image format that is not supported
Asset read_gltf(std::span<const std::uint8_t> bytes, const std::filesystem::path& file);

/// Adds every `uri` of the document, also of extensions and extras. Those of buffers and images may be read.
/// \param model  path of a regular file, which may be damaged: the references before the damage
void list_gltf_references(const std::filesystem::path& model, ReferenceList& files);

/// An upper estimate, in bytes, of the memory for the JSON of a file while it is loaded and saved, from the numbers of its
/// values: each number of one byte becomes an object. Needs no memory itself.
/// \param model    a regular file. Of a file that is damaged or no glTF, the part before the error is counted
/// \param allowed  bytes; the estimate ends when it exceeds them
std::uint64_t gltf_document_memory(const std::filesystem::path& model, std::uint64_t allowed);

/// An upper estimate, in bytes, of the memory for the meshes, decompressed buffers and repeated files of a model, in
/// addition to that for its JSON and for the bytes of its files. A small file can need much: each use of an accessor by
/// a mesh, and of a file or view by an image, is a copy of its own. The JSON is parsed and validated, as by read_gltf();
/// buffers and images are not read.
/// \param model         a regular file
/// \param stored_bytes  of all files of the model
/// \return 0 if read_gltf() reports an error before it decodes anything
/// \pre there is memory for the JSON (gltf_document_memory())
std::uint64_t gltf_decoding_memory(const std::filesystem::path& model, std::uint64_t stored_bytes);

/// Encodes an asset as GLB or, if the name ends in .gltf, as JSON with NAME.bin and NAME_0.png ...
/// The output is deterministic.
/// \param file  its name
/// \throws WriteError  if the GLB exceeds 4 GiB, or a position exceeds the range of float
EncodedModel encode_gltf(const Asset& asset, const std::filesystem::path& file);

}  // namespace faqem::detail
