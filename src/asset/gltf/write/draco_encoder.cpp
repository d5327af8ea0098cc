#include "asset/gltf/write/draco_encoder.hpp"

#ifdef FAQEM_WITH_DRACO
#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>

namespace faqem::detail {

std::optional<DracoRounding> rounding_to_steps(const std::vector<float>& values, std::size_t components,
                                               double spacing) {
    constexpr double max_step = (1 << 24) - 1;  // floats hold them exactly
    if (values.empty() || !(spacing > 0)) return std::nullopt;
    std::vector<double> low(components, INFINITY), high(components, -INFINITY);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double step = std::round(double{values[i]} / spacing);
        low[i % components] = std::min(low[i % components], step);
        high[i % components] = std::max(high[i % components], step);
    }
    double extent = 1;
    for (std::size_t c = 0; c < components; ++c) extent = std::max({extent, high[c] - low[c]});
    DracoRounding rounding;
    for (std::size_t c = 0; c < components; ++c) {
        if (!(std::abs(low[c]) <= max_step && std::abs(high[c]) <= max_step)) return std::nullopt;
        rounding.origin.push_back(static_cast<float>(low[c] * spacing));
    }
    rounding.bits = 1;
    while (std::ldexp(1.0, static_cast<int>(rounding.bits)) - 1 < extent) ++rounding.bits;
    rounding.range = static_cast<float>(spacing * (std::ldexp(1.0, static_cast<int>(rounding.bits)) - 1));
    return rounding;
}

#ifdef FAQEM_WITH_DRACO

namespace {

draco::GeometryAttribute::Type attribute_type(const std::string& name) {
    if (name == "POSITION") return draco::GeometryAttribute::POSITION;
    if (name == "NORMAL") return draco::GeometryAttribute::NORMAL;
    if (name.starts_with("TEXCOORD_")) return draco::GeometryAttribute::TEX_COORD;
    if (name.starts_with("COLOR_")) return draco::GeometryAttribute::COLOR;
    return draco::GeometryAttribute::GENERIC;
}

draco::DataType data_type(NumberType type) {
    constexpr std::array types = {draco::DT_INT8,  draco::DT_UINT8,  draco::DT_INT16,  draco::DT_UINT16,
                                  draco::DT_INT32, draco::DT_UINT32, draco::DT_FLOAT32};
    return types[static_cast<std::size_t>(type) - static_cast<std::size_t>(NumberType::i8)];
}

void add_attribute(draco::Mesh& mesh, const DracoValues& values) {
    const Json& accessor = values.description;
    const std::size_t size = element_size(accessor);
    const std::uint32_t components = component_count(string_member(accessor, "type"));
    draco::GeometryAttribute attribute;
    attribute.Init(attribute_type(values.name), nullptr, static_cast<std::int8_t>(components),
                   data_type(component_type(accessor)), member(accessor, "normalized") == true,
                   static_cast<std::int64_t>(size), 0);
    const int id = mesh.AddAttribute(attribute, true, mesh.num_points());
    for (std::uint32_t i = 0; i < mesh.num_points(); ++i)
        mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &values.bytes[i * size]);
}

void set_rounding(draco::ExpertEncoder& encoder, int id, const DracoRounding& rounding) {
    const auto bits = static_cast<int>(rounding.bits);
    if (rounding.is_octahedral)
        encoder.SetAttributeQuantization(id, bits);
    else
        encoder.SetAttributeExplicitQuantization(id, bits, static_cast<int>(rounding.origin.size()),
                                                 rounding.origin.data(), rounding.range);
}

}  // namespace

std::optional<DracoBytes> encode_draco(const std::vector<DracoValues>& attributes,
                                       const std::vector<Index>& corners, bool keeps_order) {
    draco::Mesh mesh;
    mesh.set_num_points(
        static_cast<std::uint32_t>(unsigned_member(attributes.at(0).description, "count", 0)));
    mesh.SetNumFaces(corners.size() / 3);
    for (std::uint32_t f = 0; f < mesh.num_faces(); ++f) {
        draco::Mesh::Face face;
        for (std::size_t k = 0; k < 3; ++k) face[k] = draco::PointIndex(corners[3 * f + k]);
        mesh.SetFace(draco::FaceIndex(f), face);
    }
    for (const DracoValues& values : attributes) add_attribute(mesh, values);
    draco::ExpertEncoder encoder(mesh);
    for (std::size_t i = 0; i < attributes.size(); ++i)
        if (attributes[i].rounding) set_rounding(encoder, static_cast<int>(i), *attributes[i].rounding);
    encoder.SetSpeedOptions(3, 5);
    encoder.SetTrackEncodedProperties(true);
    encoder.SetEncodingMethod(keeps_order ? draco::MESH_SEQUENTIAL_ENCODING
                                          : draco::MESH_EDGEBREAKER_ENCODING);
    draco::EncoderBuffer buffer;
    if (!encoder.EncodeToBuffer(&buffer).ok()) return std::nullopt;
    return DracoBytes{{buffer.data(), buffer.data() + buffer.size()},
                      encoder.num_encoded_points(),
                      std::uint64_t{3} * encoder.num_encoded_faces()};
}

#else

std::optional<DracoBytes> encode_draco(const std::vector<DracoValues>&, const std::vector<Index>&, bool) {
    return std::nullopt;
}

#endif

}  // namespace faqem::detail
