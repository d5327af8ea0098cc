#pragma once
/// \file
/// Values of the samples of a texel, and the bytes that the images of a page store for them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "bake/source/extension_layers.hpp"
#include "bake/source/source_sampler.hpp"
#include "faqem/bake.hpp"
#include "faqem/detail/base/vector.hpp"

namespace faqem::detail {

/// The source at a sample of a texel.
struct SampleValues {
    Appearance appearance;
    Vector3 normal = Vector3::Zero();  ///< in tangent space
    /// By layer of the page; normals in tangent space in RGB.
    std::vector<LinearColor> layers;
    bool has_layers = false;  ///< whether the sample is of the page's own material
    TexelOrigin origin;
    double squared_distance = 0;  ///< from the centre of the texel
};

/// Sums over the samples of one texel.
struct TexelSums {
    explicit TexelSums(std::size_t layer_count) : layers(layer_count) {}

    LinearColor base{};
    std::array<Vec3f, plain_images.size()> plain{};
    Vector3 normal = Vector3::Zero();
    std::vector<LinearColor> layers;
    std::uint32_t samples = 0, layer_samples = 0;
    std::array<std::uint8_t, 3> steps{};  ///< samples by MapStep
    TexelOrigin origin;  ///< of the sample closest to the centre, at squared_distance from it
    double squared_distance = std::numeric_limits<double>::infinity();

    /// Adds the values of a sample.
    void add(const SampleValues& sample);
};

inline void TexelSums::add(const SampleValues& sample) {
    const Appearance& a = sample.appearance;
    for (std::size_t k = 0; k < 4; ++k) base[k] += a.base[k];
    for (std::size_t i = 0; i < plain.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) plain[i][k] += a.plain[i][k];
    normal += sample.normal;
    ++samples;
    ++steps[static_cast<std::size_t>(sample.origin.point.step)];
    if (sample.squared_distance < squared_distance) {
        squared_distance = sample.squared_distance;
        origin = sample.origin;
    }
    if (!sample.has_layers) return;
    ++layer_samples;
    for (std::size_t i = 0; i < layers.size(); ++i)
        for (std::size_t k = 0; k < 4; ++k) layers[i][k] += sample.layers[i][k];
}

/// The encoding of an image of `plain_images`.
inline auto plain_encoder(std::size_t image) {
    return is_color(plain_images[image]) ? srgb_byte : linear_byte;
}

/// Encodes the direction of `sum` in three bytes; (0, 0, 1) if its length is zero.
void write_normal(const Vector3& sum, std::uint8_t* to);

/// Encodes `share` times `sum`, the value of a layer, in those of four bytes that it has.
void write_layer(const ExtensionLayer& layer, const LinearColor& sum, float share, std::uint8_t* to);

/// Whether two samples differ by more than one in a byte of an image of their page.
/// \param channels  those with an image
/// \param layers    those of the page, each with an image
bool differ_visibly(const Channels& channels, std::span<const ExtensionLayer> layers, const SampleValues& a,
                    const SampleValues& b);

}  // namespace faqem::detail
