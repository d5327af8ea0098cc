#pragma once
/// \file
/// The images of a page while its texels are written.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "bake/page/page_request.hpp"
#include "bake/source/source_sampler.hpp"
#include "faqem/bake.hpp"
#include "faqem/engine/mesh/vector.hpp"

namespace faqem::detail {

/// Sums over the samples of one texel.
struct TexelSums {
    explicit TexelSums(std::size_t layer_count) : layers(layer_count) {}

    LinearColor base{};
    Vec3f orm{};  ///< occlusion, roughness, metalness
    Vec3f emissive{};
    engine::Vector3 normal = engine::Vector3::Zero();  ///< in tangent space
    /// Of the page's own material; normals in tangent space in RGB.
    std::vector<LinearColor> layers;
    std::uint32_t layer_samples = 0;      ///< samples with values for `layers`
    std::array<std::uint8_t, 3> steps{};  ///< samples by MapStep
    TexelOrigin origin;  ///< of the sample closest to the centre, at squared_distance from it
    double squared_distance = std::numeric_limits<double>::infinity();

    /// Adds the values of a sample.
    /// \param share  of the sample in the texel
    void add(const Appearance& a, float share) {
        for (std::size_t k = 0; k < 4; ++k) base[k] += share * a.base[k];
        orm[0] += share * a.occlusion;
        orm[1] += share * a.roughness;
        orm[2] += share * a.metallic;
        for (std::size_t k = 0; k < 3; ++k) emissive[k] += share * a.emissive[k];
    }
    /// Adds a value of a layer.
    void add_layer(std::size_t layer, const LinearColor& value) {
        for (std::size_t k = 0; k < 4; ++k) layers[layer][k] += value[k];
    }
};

/// Encodes texels in the images of a page. Different texels can be written concurrently.
class PageCanvas {
public:
    /// \param page  must outlive this
    explicit PageCanvas(const PageRequest& page);

    /// Sets a texel to the mean of its samples.
    void write(std::uint32_t x, std::uint32_t y, const TexelSums& texel);

    /// The images, in which texels that were not written are filled by push_pull().
    PageImages finish(const Workers& workers) &&;

private:
    void write_base(std::size_t at, const TexelSums& texel);
    void keep_colors_of_hidden_materials();
    void run_last_steps(const Workers& workers);
    void count_samples();

    const PageRequest& page_;
    PageImages images_;
    // By texel: number of samples with MapStep::approximate and MapStep::closest.
    std::vector<std::uint8_t> approximate_samples_, closest_samples_;
    std::vector<std::uint8_t> is_covered_;         // by texel: in a cell or chart
    std::vector<std::uint8_t> has_color_;          // by texel: its colour is its own; empty without alpha
    std::vector<Index> material_;                  // by covered texel: in the source; empty without alpha
    std::vector<std::uint8_t> has_layer_samples_;  // by texel: has samples of the page's own material
};

}  // namespace faqem::detail
