#include "bake/simplify/check_asset.hpp"

#include "asset/scene/messages.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "asset/scene/material_textures.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

class PartChecker {
public:
    PartChecker(const Asset& asset, std::size_t part)
        : asset_(asset), part_(asset.parts[part]), title_(part_title(asset, part)) {}

    void operator()() const {
        for (std::size_t set = 0; set < part_.uvs.size(); ++set) {
            const std::string name = "uvs " + std::to_string(set);
            check_size(part_.uvs[set], name);
            check_finite(part_.uvs[set], name);
        }
        check(part_.positions, "positions");
        check(part_.normals, "normals");
        check(part_.tangents, "tangents");
        check(part_.colors, "colors");
        check(part_.weights, "weights");
        check_size_or_empty(part_.joints, "joints");
        for (const MorphTarget& target : part_.morph_targets) {
            check(target.positions, "positions of a morph target");
            check(target.normals, "normals of a morph target");
        }
        for (const CustomAttribute& attribute : part_.custom_attributes) {
            check_size(attribute.values, attribute.name);
            check_finite(attribute.values, attribute.name);
            if (attribute.components < 1 || attribute.components > 4)
                fail(attribute.name, "must have 1 to 4 components");
        }
        check_faces();
    }

private:
    [[noreturn]] void fail(const std::string& element, const std::string& what) const {
        throw InputError(title_, element, what);
    }
    template <class T>
    void check_size(const std::vector<T>& values, const std::string& name) const {
        if (values.size() != part_.positions.size())
            fail(name, "has " + std::to_string(values.size()) + " entries, expected one for each of " +
                           std::to_string(part_.positions.size()) + " vertices");
    }
    template <class T>
    void check_size_or_empty(const std::vector<T>& values, const std::string& name) const {
        if (!values.empty()) check_size(values, name);
    }
    template <class T>
    void check_finite(const std::vector<T>& values, const std::string& name) const {
        for (std::size_t v = 0; v < values.size(); ++v)
            for (const auto x : values[v])
                if (!std::isfinite(x)) fail(name + ", vertex " + std::to_string(v), "is not finite");
    }
    template <class T>
    void check(const std::vector<T>& values, const std::string& name) const {
        check_size_or_empty(values, name);
        check_finite(values, name);
    }
    void check_faces() const {
        for (std::size_t f = 0; f < part_.triangles.size(); ++f)
            for (const Index v : part_.triangles[f])
                if (!(v < part_.positions.size()))
                    fail("face " + std::to_string(f), "vertex index out of range");
        const std::vector<Index>& materials = part_.face_material;
        if (!materials.empty() && materials.size() != part_.triangles.size())
            fail("face_material", "needs one entry per face or none");
        for (std::size_t f = 0; f < materials.size(); ++f)
            if (materials[f] != no_index && !(materials[f] < asset_.materials.size()))
                fail("face " + std::to_string(f), "material index out of range");
        check_names(part_.face_object, part_.object_names, "object");
        check_names(part_.face_group, part_.group_names, "group");
    }
    // Checks the objects or groups of the faces.
    void check_names(const std::vector<Index>& of_face, const std::vector<std::string>& names,
                     const std::string& kind) const {
        if (!of_face.empty() && of_face.size() != part_.triangles.size())
            fail("face_" + kind, "needs one entry per face or none");
        for (std::size_t f = 0; f < of_face.size(); ++f)
            if (of_face[f] != no_index && !(of_face[f] < names.size()))
                fail("face " + std::to_string(f), kind + " index out of range");
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
    for (const float x :
         {m.base_color[0], m.base_color[1], m.base_color[2], m.base_color[3], m.metallic, m.roughness,
          m.normal_scale, m.occlusion_strength, m.emissive[0], m.emissive[1], m.emissive[2], m.alpha_cutoff})
        if (!std::isfinite(x)) fail("a factor is not finite");
}

}  // namespace

void check_asset(const Asset& asset) {
    for (std::size_t p = 0; p < asset.parts.size(); ++p) PartChecker(asset, p)();
    for (Index m = 0; m < asset.materials.size(); ++m) check_material(asset, m);
}

}  // namespace faqem::detail
