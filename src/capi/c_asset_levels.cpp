#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "capi/c_asset.hpp"
#include "capi/c_history.hpp"
#include "faqem/bake_levels.hpp"
#include "scene/parts/parts_from_histories.hpp"

namespace {

using namespace faqem;

void check_levels(const faqem_asset* const* levels, std::size_t count) {
    if (count == 0) throw OptionError("levels: at least one is required");
    for (std::size_t i = 0; i < count; ++i)
        capi::require_argument(levels[i], ("level " + std::to_string(i)).c_str());
}

}  // namespace

faqem_status faqem_asset_simplify_levels(const faqem_asset* asset, const faqem_options* options,
                                         const faqem_level* levels, size_t level_count,
                                         faqem_level_textures textures, faqem_asset** results,
                                         faqem_error* error) {
    return capi::catch_exceptions(error, {{asset, "asset"}, {levels, "levels"}, {results, "results"}}, [&] {
        if (textures != FAQEM_LEVEL_TEXTURES_EACH && textures != FAQEM_LEVEL_TEXTURES_SHARED)
            throw OptionError("textures: unknown enumerator");
        std::vector<std::unique_ptr<faqem_asset>> objects;
        for (SimplifiedAssetLevel& level : simplify_levels(
                 asset->asset, capi::to_levels(levels, level_count), capi::options_or_defaults(options),
                 textures == FAQEM_LEVEL_TEXTURES_SHARED ? LevelTextures::shared : LevelTextures::each)) {
            if (objects.empty()) capi::warn_of_idle_options(options, asset->asset, level.result.report);
            objects.push_back(std::make_unique<faqem_asset>(std::move(level.result), level.error));
        }
        for (std::size_t i = 0; i < level_count; ++i) results[i] = objects.at(i).release();
    });
}

double faqem_asset_level_error(const faqem_asset* asset) {
    return asset ? asset->level_error : std::numeric_limits<double>::quiet_NaN();
}

faqem_status faqem_asset_save_levels(faqem_asset* const* levels, size_t level_count, double screen_error,
                                     const char* path, faqem_overwrite overwrite, faqem_error* error) {
    return capi::catch_exceptions(error, {{levels, "levels"}, {path, "path"}}, [&] {
        check_levels(levels, level_count);
        std::vector<SimplifiedAssetLevel> saved(level_count);
        for (std::size_t i = 0; i < level_count; ++i) {
            saved[i].result.asset = levels[i]->asset;
            saved[i].error = levels[i]->level_error;
        }
        levels[0]->save_warnings.add(
            save_levels(std::move(saved), path, capi::to_overwrite(overwrite), screen_error));
    });
}

faqem_status faqem_asset_history_create(const faqem_asset* const* levels, size_t level_count,
                                        faqem_history** history, faqem_error* error) {
    return capi::catch_exceptions(error, {{levels, "levels"}, {history, "history"}}, [&] {
        check_levels(levels, level_count);
        const std::size_t count = levels[0]->histories.size();
        for (std::size_t i = 0; i < level_count; ++i) {
            const std::string where = "level " + std::to_string(i);
            if (levels[i]->histories.empty())
                throw OptionError(where + " has no history: set the option history");
            if (levels[i]->histories.size() != count)
                throw InputError("", where, "the number of parts differs from that of level 0");
        }
        std::vector<ChainHistory> parts;
        for (std::size_t p = 0; p < count; ++p) {
            std::vector<CollapseHistory> of_part;
            for (std::size_t i = 0; i < level_count; ++i) of_part.push_back(levels[i]->histories[p]);
            parts.push_back(join(of_part));
        }
        *history = new faqem_history(std::move(parts));
    });
}

faqem_status faqem_asset_bake_truncated(const faqem_asset* source, const faqem_history* history,
                                        uint64_t faces, const faqem_options* options,
                                        faqem_asset** simplified, faqem_error* error) {
    return capi::catch_exceptions(error, {{source, "source"}, {simplified, "simplified"}}, [&] {
        const Options bake_options = capi::options_or_defaults(options);
        if (bake_options.bake.kind == Bake::keep)
            throw OptionError("bake: `keep` is not possible, because a history has no UVs");
        const SimplifiedParts simplified_parts =
            detail::parts_from_histories(capi::truncate_parts(history, faces));
        detail::check_source_matches_histories(source->asset, simplified_parts);
        SimplifiedAsset made = bake(source->asset, simplified_parts, bake_options);
        capi::warn_of_idle_options(options, source->asset, made.report);
        *simplified = new faqem_asset(std::move(made));
    });
}
