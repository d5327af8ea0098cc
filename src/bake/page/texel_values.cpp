#include "bake/page/texel_values.hpp"

#include <cstdlib>

namespace faqem::detail {
namespace {

bool differ(std::uint8_t a, std::uint8_t b) { return std::abs(int{a} - int{b}) > 1; }

// Whether any of the first values differ.
template <class Values>
bool differ(const Values& a, const Values& b, std::size_t count, std::uint8_t (*encode)(double)) {
    for (std::size_t k = 0; k < count; ++k)
        if (differ(encode(a[k]), encode(b[k]))) return true;
    return false;
}

bool differ(const Vector3& a, const Vector3& b) {
    std::array<std::uint8_t, 3> p, q;
    write_normal(a, p.data()), write_normal(b, q.data());
    return differ(p[0], q[0]) || differ(p[1], q[1]) || differ(p[2], q[2]);
}

bool differ(const ExtensionLayer& layer, const LinearColor& a, const LinearColor& b) {
    std::array<std::uint8_t, 4> p = {}, q = {};
    write_layer(layer, a, 1, p.data()), write_layer(layer, b, 1, q.data());
    return differ(p[0], q[0]) || differ(p[1], q[1]) || differ(p[2], q[2]) || differ(p[3], q[3]);
}

}  // namespace

void write_normal(const Vector3& sum, std::uint8_t* to) {
    const double length = sum.norm();
    const Vector3 n = length > 1e-6 ? Vector3(sum / length) : Vector3(0, 0, 1);
    for (Eigen::Index k = 0; k < 3; ++k) to[k] = linear_byte((n[k] + 1) / 2);
}

void write_layer(const ExtensionLayer& layer, const LinearColor& sum, float share, std::uint8_t* to) {
    if (layer.is_normal_map()) return write_normal(Vector3(sum[0], sum[1], sum[2]), to);
    const bool is_color = layer.encoding() == TexelEncoding::color_and_data_alpha;
    if (layer.has_color())
        for (std::size_t k = 0; k < 3; ++k)
            to[k] = is_color ? srgb_byte(sum[k] * share) : linear_byte(sum[k] * share);
    if (layer.has_alpha()) to[3] = linear_byte(sum[3] * share);
}

bool differ_visibly(const Channels& channels, std::span<const ExtensionLayer> layers, const SampleValues& a,
                    const SampleValues& b) {
    const Appearance &p = a.appearance, &q = b.appearance;
    if (channels[CoreTexture::base_color] &&
        (differ(p.base, q.base, 3, srgb_byte) || differ(linear_byte(p.base[3]), linear_byte(q.base[3]))))
        return true;
    for (std::size_t i = 0; i < plain_images.size(); ++i)
        if (channels.has_plain(i) && differ(p.plain[i], q.plain[i], 3, plain_encoder(i))) return true;
    if (channels[CoreTexture::normal] && differ(a.normal, b.normal)) return true;
    if (layers.empty()) return false;
    if (a.has_layers != b.has_layers) return true;
    for (std::size_t i = 0; i < layers.size() && a.has_layers; ++i)
        if (differ(layers[i], a.layers[i], b.layers[i])) return true;
    return false;
}

}  // namespace faqem::detail
