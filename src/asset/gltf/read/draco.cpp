#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>

#include <cstring>

#include "asset/gltf/read/compressed.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

/// Decoder of one Draco mesh. Errors name the file and the primitive.
struct DracoReader {
    std::span<const std::uint8_t> bytes;
    const std::string &file, &where;

    /// Compares the counts in the header with those of the accessors. Draco allocates memory according to the
    /// header, so this is checked before decoding.
    void check_counts(std::uint64_t vertices, std::uint64_t corners) const {
        draco::DecoderBuffer buffer = open();
        draco::DracoHeader header;
        if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) fail("the header is damaged");
        if (header.encoder_type != draco::TRIANGULAR_MESH) fail("is not a triangle mesh");
        buffer.set_bitstream_version(DRACO_BITSTREAM_VERSION(header.version_major, header.version_minor));
        if (buffer.bitstream_version() < DRACO_BITSTREAM_VERSION(2, 2))
            throw UnsupportedError(
                file, where, std::string(draco_name) + ": bitstream versions before 2.2 are not supported");
        if (header.flags & METADATA_FLAG_MASK) {
            draco::GeometryMetadata metadata;
            if (!draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata))
                fail("the metadata is damaged");
        }
        std::uint32_t points = 0, faces = 0;
        std::uint8_t traversal = 0;
        const bool is_edgebreaker = header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING;
        const bool read = is_edgebreaker
                              ? buffer.Decode(&traversal) && draco::DecodeVarint(&points, &buffer) &&
                                    draco::DecodeVarint(&faces, &buffer)
                              : draco::DecodeVarint(&faces, &buffer) && draco::DecodeVarint(&points, &buffer);
        if (!read) fail("the data is truncated");
        if (std::uint64_t{faces} * 3 != corners)
            fail("has " + std::to_string(faces) + " faces, the number of indices is " +
                 std::to_string(corners));
        // The header of Edgebreaker has the number of vertices; seams of attributes add more points.
        if (points > vertices)
            fail("has " + std::to_string(points) + " vertices, the accessors have " +
                 std::to_string(vertices));
    }

    std::unique_ptr<draco::Mesh> decode() const {
        draco::DecoderBuffer buffer = open();
        draco::Decoder decoder;
        auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
        if (!mesh.ok() || !mesh.value()) fail("the data is damaged");
        return std::move(mesh).value();
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(file, where, std::string(draco_name) + ": " + what);
    }

    draco::DecoderBuffer open() const {
        draco::DecoderBuffer buffer;
        buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        return buffer;
    }
};

/// Reads the values of an attribute by point of the mesh, converted to T. Returns false if one is missing or
/// cannot be converted.
template <class T>
bool convert(const draco::Mesh& mesh, const draco::PointAttribute& from, DracoAttribute& to) {
    to.bytes.resize(std::size_t{mesh.num_points()} * to.components * sizeof(T));
    std::vector<T> value(to.components);
    for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
        const draco::AttributeValueIndex at = from.mapped_index(draco::PointIndex(i));
        if (at.value() >= from.size() ||
            !from.ConvertValue<T>(at, static_cast<std::int8_t>(to.components), value.data()))
            return false;
        std::memcpy(&to.bytes[std::size_t{i} * to.components * sizeof(T)], value.data(),
                    to.components * sizeof(T));
    }
    return true;
}

}  // namespace

std::vector<std::uint32_t> decode_draco(std::span<const std::uint8_t> bytes, std::uint64_t vertices,
                                        std::uint64_t corners, std::vector<DracoAttribute>& attributes,
                                        const std::string& file, const std::string& where) {
    const DracoReader reader{bytes, file, where};
    reader.check_counts(vertices, corners);
    const std::unique_ptr<draco::Mesh> mesh = reader.decode();
    if (mesh->num_points() != vertices || std::uint64_t{mesh->num_faces()} * 3 != corners)
        reader.fail("has " + std::to_string(mesh->num_points()) + " vertices and " +
                    std::to_string(mesh->num_faces()) + " faces, which differs from the accessors");
    for (DracoAttribute& attribute : attributes) {
        const draco::PointAttribute* from = mesh->GetAttributeByUniqueId(attribute.id);
        if (!from) reader.fail("has no attribute " + std::to_string(attribute.id));
        // glTF has no boolean type, and converting a bool that is neither 0 nor 1 is undefined behaviour.
        if (from->data_type() == draco::DT_BOOL)
            reader.fail("attribute " + std::to_string(attribute.id) +
                        " has a boolean type, which glTF does not have");
        const bool is_converted = visit_type(
            attribute.type, [&](auto number) { return convert<decltype(number)>(*mesh, *from, attribute); });
        if (!is_converted) reader.fail("attribute " + std::to_string(attribute.id) + " is damaged");
    }
    std::vector<std::uint32_t> result;
    result.reserve(corners);
    for (std::uint32_t f = 0; f < mesh->num_faces(); ++f)
        for (const draco::PointIndex& p : mesh->face(draco::FaceIndex(f))) result.push_back(p.value());
    return result;
}

}  // namespace faqem::detail
