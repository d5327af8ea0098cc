#include "bake/scene/unencoded_result.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "asset/image/image.hpp"
#include "asset/image/image_size.hpp"
#include "asset/scene/material_textures.hpp"
#include "asset/scene/source_traits.hpp"
#include "bake/source/extension_layers.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "scene/material_groups.hpp"

namespace faqem::detail {
namespace {

void report_images(const Asset& asset, Report& report) {
    report.images.clear();
    for (const Image& image : asset.images) {
        const std::optional<ImageSize> size = declared_size(image);
        const auto side = [&](std::uint64_t ImageSize::*member) {
            return size ? static_cast<std::uint32_t>(*size.*member) : 0;
        };
        report.images.push_back({image.name, media_type(image), side(&ImageSize::width),
                                 side(&ImageSize::height), image.encoded.size()});
    }
}

// Removes images, and gives the others and the references to them their new numbers.
void remove_images(UnencodedResult& result, const std::vector<std::uint8_t>& removed) {
    Asset& asset = result.asset.asset;
    std::vector<Index> number(asset.images.size(), no_index);
    Index count = 0;
    for (std::size_t i = 0; i < number.size(); ++i)
        if (!removed[i]) number[i] = count++;
    for (std::size_t i = 0; i < number.size(); ++i)
        if (!removed[i] && number[i] != i) asset.images[number[i]] = std::move(asset.images[i]);
    asset.images.resize(count);
    for (Material& material : asset.materials) {
        for_each_texture(material, [&](TextureRef& texture) {
            if (!texture) return;
            texture.image = number[texture.image];
            if (!texture) texture = {};
        });
    }
    std::erase_if(result.pending, [&](const PendingImage& pending) { return removed[pending.image] != 0; });
    for (PendingImage& pending : result.pending) pending.image = number[pending.image];
}

bool needs_tangents(const Asset& asset, const Part& part) {
    return std::any_of(part.face_material.begin(), part.face_material.end(),
                       [&](Index m) { return tangent_texture(material_or_default(asset, m)) != nullptr; });
}

// Encodes the pending images. Without time for the choice of ImageFormat::automatic, they get the format of the source.
void encode_in_time(UnencodedResult& result, BakeOptions bake, const RunContext& context) {
    const auto encode = [&](const RunContext& own) {
        encode_pending_images(result.pending, bake, own, result.asset.asset.images);
    };
    if (bake.image_format != ImageFormat::automatic) return encode(context.untimed());
    if (context.in_time([&] { encode(context); })) return;
    bake.image_format = ImageFormat::source;
    encode(context.untimed());
    result.asset.report.warnings.push_back(
        "max_seconds was over before the smallest images were found: they have the formats of the source");
}

}  // namespace

void add_histories(const SimplifiedParts& simplified, const Options& options, SimplifiedAsset& result) {
    if (options.history != Recording::on) return;
    for (const SimplifyResult& part : simplified.parts) result.histories.push_back(part.history);
}

void encode_images(UnencodedResult& result, const Options& options, const RunContext& context) {
    Report& report = result.asset.report;
    const Stopwatch watch;
    context.show(Phase::bake, 1);
    encode_in_time(result, options.bake, context);
    report_images(result.asset.asset, report);
    report.seconds.bake += watch.seconds();
    report.seconds.total += watch.seconds();
}

bool remove_new_normal_maps(UnencodedResult& result) {
    Asset& asset = result.asset.asset;
    std::vector<std::uint8_t> removed(asset.images.size(), 0);
    for (const PendingImage& pending : result.pending)
        if (pending.is_new_map) removed[pending.image] = 1;
    if (std::ranges::find(removed, 1) == removed.end()) return false;
    remove_images(result, removed);
    for (Part& part : asset.parts)
        if (!needs_tangents(asset, part)) part.tangents.clear();
    return true;
}

void limit_image_sides(UnencodedResult& result, std::uint32_t side) {
    const auto exceeds = [&](const PendingImage& pending) {
        const Pixels& at = pending.pixels;
        return pending.may_shrink && std::max(at.width, at.height) > side && can_be_halved(at);
    };
    for (PendingImage& pending : result.pending)
        while (exceeds(pending)) halve(pending);
}

void remove_unused_materials(UnencodedResult& result) {
    Asset& asset = result.asset.asset;
    std::vector<Index> number(asset.materials.size(), no_index);
    for (const Part& part : asset.parts) {
        for (const Index m : part.face_material)
            if (m < number.size()) number[m] = 0;
        for (const Index m : variant_materials(asset, part)) number[m] = 0;
    }
    std::vector<std::uint8_t> removed(asset.images.size(), 1);
    Index count = 0;
    for (std::size_t m = 0; m < number.size(); ++m) {
        if (number[m] == no_index) continue;
        if (count != m) asset.materials[count] = std::move(asset.materials[m]);
        for_each_texture(asset.materials[count], [&](const TextureRef& texture) {
            if (texture) removed[texture.image] = 0;
        });
        number[m] = count++;
    }
    asset.materials.resize(count);
    for (Part& part : asset.parts)
        for (Index& m : part.face_material)
            if (m < number.size()) m = number[m];
    remove_images(result, removed);
}

}  // namespace faqem::detail
