#include "bake/page/page_canvas.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "bake/page/push_pull.hpp"

namespace faqem::detail {
namespace {

// Texels with a lower alpha take their colour from the texels around them, if their material has visible ones.
constexpr float min_visible_alpha = 1.0f / 512;

Pixels blank(const PageRequest& page, bool wanted, bool has_alpha) {
    if (!wanted) return {};
    const Atlas& atlas = page.layout.atlas;
    return {atlas.width, atlas.height, std::vector<std::uint8_t>(4 * page.texels(), 255), has_alpha};
}

void write_rgb(const Vec3f& sum, float share, std::uint8_t (*encode)(double), std::size_t at, Pixels& image) {
    if (image.rgba.empty()) return;
    for (std::size_t k = 0; k < 3; ++k) image.rgba[4 * at + k] = encode(sum[k] * share);
}

// Index of the texel that contains a coordinate.
std::uint32_t texel_at(double coordinate, std::uint32_t size) {
    return static_cast<std::uint32_t>(std::clamp(coordinate, 0.0, size - 1.0));
}

// Marks the texels of a row whose centres are between the edges of a triangle.
void mark_row(const Triangle2& t, std::uint32_t y, std::uint32_t width, std::uint8_t* row) {
    const auto [left, right] = crossing_range(t, y + 0.5);
    if (!(left <= right)) return;
    const double first = std::max(std::ceil(left - 0.5), 0.0);
    const double last = std::min(std::floor(right - 0.5), width - 1.0);
    for (double x = first; x <= last; ++x) row[static_cast<std::size_t>(x)] = 1;
}

}  // namespace

std::vector<std::uint8_t> shown_texels(const Atlas& atlas) {
    std::vector<std::uint8_t> shown(std::size_t{atlas.width} * atlas.height, 0);
    for (const Triangle2& t : atlas.placements) {
        const auto [low, high] = std::minmax({t[0].y, t[1].y, t[2].y});
        if (!std::isfinite(low) || !std::isfinite(high)) continue;
        for (std::uint32_t y = texel_at(low, atlas.height); y <= texel_at(high, atlas.height); ++y)
            mark_row(t, y, atlas.width, &shown[std::size_t{y} * atlas.width]);
        const double x = (t[0].x + t[1].x + t[2].x) / 3, y = (t[0].y + t[1].y + t[2].y) / 3;
        if (!std::isfinite(x)) continue;
        shown[std::size_t{texel_at(y, atlas.height)} * atlas.width + texel_at(x, atlas.width)] = 1;
    }
    return shown;
}

PageCanvas::PageCanvas(const PageRequest& page) : page_(page) {
    const Channels& channels = page.channels;
    images_.base = blank(page, channels[CoreTexture::base_color], page.alpha_mode != AlphaMode::opaque);
    for (std::size_t i = 0; i < plain_images.size(); ++i)
        images_.plain[i] = blank(page, channels.has_plain(i), false);
    images_.normal = blank(page, channels[CoreTexture::normal], false);
    for (const ExtensionLayer& layer : page.layers)
        images_.layers.push_back(blank(page, true, layer.has_alpha()));
    is_covered_.assign(page.texels(), 0);
    approximate_samples_.assign(page.texels(), 0);
    closest_samples_.assign(page.texels(), 0);
    if (page.records_origins) images_.origins.resize(page.texels());
    if (images_.base.has_alpha) {
        has_color_.assign(page.texels(), 0);
        material_.resize(page.texels());
    }
    if (!page.layers.empty()) has_layer_samples_.assign(page.texels(), 0);
}

void PageCanvas::write(std::uint32_t x, std::uint32_t y, const TexelSums& texel) {
    const std::size_t at = std::size_t{y} * page_.layout.atlas.width + x;
    is_covered_[at] = 1;
    // The samples that were not taken count like the others.
    const auto samples_by = [&](MapStep step) {
        const std::uint32_t taken = texel.steps[static_cast<std::size_t>(step)];
        return static_cast<std::uint8_t>(taken * page_.samples * page_.samples / texel.samples);
    };
    approximate_samples_[at] = samples_by(MapStep::approximate);
    closest_samples_[at] = samples_by(MapStep::closest);
    if (!images_.origins.empty()) images_.origins[at] = texel.origin;
    const float share = 1.0f / static_cast<float>(texel.samples);
    if (page_.channels[CoreTexture::base_color]) write_base(at, texel, share);
    for (std::size_t i = 0; i < plain_images.size(); ++i)
        write_rgb(texel.plain[i], share, plain_encoder(i), at, images_.plain[i]);
    if (page_.channels[CoreTexture::normal]) write_normal(texel.normal, &images_.normal.rgba[4 * at]);
    if (texel.layer_samples == 0) return;
    has_layer_samples_[at] = 1;
    for (std::size_t i = 0; i < page_.layers.size(); ++i)
        write_layer(page_.layers[i], texel.layers[i], 1.0f / static_cast<float>(texel.layer_samples),
                    &images_.layers[i].rgba[4 * at]);
}

void PageCanvas::write_base(std::size_t at, const TexelSums& texel, float share) {
    const auto& [part, point] = texel.origin;
    const float alpha = texel.base[3] * share;
    const bool is_visible = alpha > min_visible_alpha;
    std::uint8_t* p = &images_.base.rgba[4 * at];
    if (is_visible) {
        for (std::size_t k = 0; k < 3; ++k) p[k] = srgb_byte(texel.base[k] * share / alpha);
    } else {
        const Vec3f stored = page_.sampler.stored_base_color(part, point);
        for (std::size_t k = 0; k < 3; ++k) p[k] = srgb_byte(stored[k]);
    }
    p[3] = linear_byte(alpha);
    if (has_color_.empty()) return;
    has_color_[at] = is_visible;
    material_[at] = page_.sampler.material(part, point);
}

// The texels of a material without any visible texel keep the colours that were stored under its alpha.
void PageCanvas::keep_colors_of_hidden_materials() {
    std::vector<std::uint8_t> is_visible;  // the default material first
    const auto slot = [](Index material) { return material == no_index ? 0 : std::size_t{material} + 1; };
    for (std::size_t i = 0; i < has_color_.size(); ++i) {
        if (!is_covered_[i]) continue;
        is_visible.resize(std::max(is_visible.size(), slot(material_[i]) + 1), 0);
        if (has_color_[i]) is_visible[slot(material_[i])] = 1;
    }
    for (std::size_t i = 0; i < has_color_.size(); ++i)
        if (is_covered_[i] && !is_visible[slot(material_[i])]) has_color_[i] = 1;
}

// The steps after the last sample, several at a time.
void PageCanvas::run_last_steps(const RunContext& context) {
    std::vector<std::function<void()>> steps;
    const auto add_fill = [&](Pixels& image, const std::vector<std::uint8_t>& known,
                              const std::vector<std::uint8_t>& known_alpha) {
        if (image.rgba.empty()) return;
        steps.emplace_back([&] {
            push_pull(image, known, {0, 3});
            if (image.has_alpha) push_pull(image, known_alpha, {3, 4});
        });
    };
    add_fill(images_.base, images_.base.has_alpha ? has_color_ : is_covered_, is_covered_);
    for (Pixels& image : images_.plain) add_fill(image, is_covered_, is_covered_);
    add_fill(images_.normal, is_covered_, is_covered_);
    for (Pixels& layer : images_.layers) add_fill(layer, has_layer_samples_, has_layer_samples_);
    steps.emplace_back([&] { images_.known = shown_texels(page_.layout.atlas); });
    steps.emplace_back([&] { count_samples(); });
    parallel_blocks(steps.size(), 1, context, [&](std::size_t i, std::size_t) { steps[i](); });
}

void PageCanvas::count_samples() {
    const std::uint64_t samples = std::uint64_t{page_.samples} * page_.samples;
    auto& [history, approximate, closest] = images_.samples;
    for (std::size_t i = 0; i < is_covered_.size(); ++i) {
        images_.texels += is_covered_[i];
        history += is_covered_[i] * (samples - approximate_samples_[i] - closest_samples_[i]);
        approximate += approximate_samples_[i];
        closest += closest_samples_[i];
        images_.uncertain_texels += approximate_samples_[i] + closest_samples_[i] > 0;
    }
}

PageImages PageCanvas::finish(const RunContext& context) && {
    keep_colors_of_hidden_materials();
    run_last_steps(context);
    for (std::size_t i = 0; i < is_covered_.size(); ++i)
        images_.missing_texels += images_.known[i] && !is_covered_[i];
    images_.known_layers = std::move(has_layer_samples_);
    for (std::size_t i = 0; i < images_.known_layers.size(); ++i)
        images_.known_layers[i] = images_.known_layers[i] && images_.known[i];
    return std::move(images_);
}

}  // namespace faqem::detail
