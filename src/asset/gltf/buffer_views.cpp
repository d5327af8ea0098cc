#include "asset/gltf/buffer_views.hpp"

#include <cstdint>
#include <set>
#include <string>

#include "asset/gltf/scene.hpp"

namespace faqem::detail {
namespace {

// What the views of a document store, by index. A view of several accessors has several contents.
class ViewContents {
public:
    explicit ViewContents(const Json& document)
        : document_(document), contents_(array_size(document, "bufferViews")) {
        for (const Json& mesh : member(document, "meshes"))
            for (const Json& primitive : member(mesh, "primitives")) add_primitive(primitive);
        for (const Json& skin : member(document, "skins"))
            add(skin, "inverseBindMatrices", "inverse bind matrices");
        for (const Json& animation : member(document, "animations")) {
            for (const Json& sampler : member(animation, "samplers")) {
                add(sampler, "input", "animation");
                add(sampler, "output", "animation");
            }
        }
        for (const Json& node : member(document, "nodes"))
            add_all(member(node, "extensions", instancing_name, "attributes"), "instance ");
        for (const Json& image : member(document, "images"))
            is_image_.insert(index_member(image, "bufferView"));
    }

    bool is_image(Index view) const { return is_image_.contains(view); }

    std::string operator()(Index view) const {
        std::string result;
        for (const std::string& content : contents_[view]) result += (result.empty() ? "" : ", ") + content;
        return result.empty() ? "other" : result;
    }

private:
    void add_primitive(const Json& primitive) {
        add(primitive, "indices", "indices");
        add_all(member(primitive, "attributes"), "");
        for (const Json& target : member(primitive, "targets")) add_all(target, "target ");
    }

    void add_all(const Json& attributes, const std::string& prefix) {
        for (auto it = attributes.begin(); it != attributes.end(); ++it)
            add(attributes, it.key().c_str(), prefix + it.key());
    }

    void add(const Json& owner, const char* key, const std::string& content) {
        const Index accessor = index_member(owner, key);
        if (accessor == no_index) return;
        const Index view = index_member(member(document_, "accessors")[accessor], "bufferView");
        if (view != no_index) contents_[view].insert(content);
    }

    const Json& document_;
    std::vector<std::set<std::string>> contents_;
    std::set<Index> is_image_;
};

std::uint64_t stored_bytes(const Json& view) {
    const Json& compressed = member(view, "extensions", meshopt_name);
    return unsigned_member(compressed.is_object() ? compressed : view, "byteLength", 0);
}

}  // namespace

std::vector<ResultView> buffer_views(const Json& document) {
    const ViewContents contents(document);
    std::vector<ResultView> result;
    const Json& views = member(document, "bufferViews");
    for (Index i = 0; i < views.size(); ++i)
        if (!contents.is_image(i)) result.push_back({contents(i), stored_bytes(views[i])});
    return result;
}

}  // namespace faqem::detail
