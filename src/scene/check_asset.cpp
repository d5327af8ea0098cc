#include "scene/check_asset.hpp"

#include "asset/scene/messages.hpp"

#include <cmath>
#include <string>

#include "asset/scene/material_textures.hpp"
#include "asset/scene/part_arrays.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

class PartChecker {
public:
    PartChecker(const Asset& asset, std::size_t part)
        : asset_(asset), part_(asset.parts[part]), title_(part_title(asset, part)) {}

    void operator()() const {
        visit_vertex_arrays([&](const VertexArray& array, const auto& values) { check(array, values); },
                            part_);
        check_faces();
    }

private:
    [[noreturn]] void fail(const std::string& element, const std::string& what) const {
        throw InputError(title_, element, what);
    }
    template <class T>
    void check(const VertexArray& array, const std::vector<T>& values) const {
        const std::string name = array.title();
        if (values.size() != part_.positions.size() && !(values.empty() && array.may_be_empty()))
            fail(name, "has " + std::to_string(values.size()) + " entries, expected one for each of " +
                           std::to_string(part_.positions.size()) + " vertices");
        for (std::size_t v = 0; v < values.size(); ++v)
            for (const auto x : values[v])
                if (!std::isfinite(x)) fail(name + ", vertex " + std::to_string(v), "is not finite");
        if (array.attribute && (array.attribute->components < 1 || array.attribute->components > 4))
            fail(name, "must have 1 to 4 components");
    }
    void check_faces() const {
        for (std::size_t f = 0; f < part_.triangles.size(); ++f)
            for (const Index v : part_.triangles[f])
                if (!(v < part_.positions.size()))
                    fail("face " + std::to_string(f), "vertex index out of range: " + std::to_string(v));
        for (const FaceArray& array : face_arrays) {
            const std::vector<Index>& values = part_.*array.values;
            const std::string kind(array.kind);
            if (!values.empty() && values.size() != part_.triangles.size())
                fail("face_" + kind, "needs one entry per face or none");
            const std::size_t count = array.names ? (part_.*array.names).size() : asset_.materials.size();
            for (std::size_t f = 0; f < values.size(); ++f)
                if (values[f] != no_index && !(values[f] < count))
                    fail("face " + std::to_string(f),
                         kind + " index out of range: " + std::to_string(values[f]));
        }
    }

    const Asset& asset_;
    const Part& part_;
    std::string title_;
};

void check_material(const Asset& asset, Index material) {
    const auto fail = [&](const char* what) { throw InputError("", material_title(asset, material), what); };
    const Material& m = asset.materials[material];
    for_each_texture(m, [&](const TextureRef& ref) {
        if (!ref) return;
        if (!(ref.image < asset.images.size())) fail("image index out of range");
        for (const float x : {ref.offset[0], ref.offset[1], ref.scale[0], ref.scale[1], ref.rotation})
            if (!std::isfinite(x)) fail("the transform of a texture is not finite");
    });
    for (const ExtensionTexture& texture : m.extension_textures)
        if (!std::isfinite(texture.normal_scale)) fail("the scale of a normal map is not finite");
    for (const float x : {m.base_color[0], m.base_color[1], m.base_color[2], m.base_color[3], m.metallic,
                          m.roughness, m.emissive[0], m.emissive[1], m.emissive[2], m.alpha_cutoff})
        if (!std::isfinite(x)) fail("a factor is not finite");
    for (const CoreSlot& slot : core_slots)
        if (slot.factor && !std::isfinite(m.*slot.factor)) fail("a factor is not finite");
}

}  // namespace

void check_asset(const Asset& asset) {
    for (std::size_t p = 0; p < asset.parts.size(); ++p) PartChecker(asset, p)();
    for (Index m = 0; m < asset.materials.size(); ++m) check_material(asset, m);
}

}  // namespace faqem::detail
