#include "capi/c_asset.hpp"

#include "capi/c_mesh.hpp"
#include "faqem/bake_onto.hpp"
#include "scene/check_asset.hpp"
#include "scene/resolved_options.hpp"

namespace {

using namespace faqem;

Part make_part(const MeshView& mesh) {
    Part part;
    part.positions.reserve(mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) part.positions.push_back(mesh.positions[v]);
    part.triangles.reserve(mesh.triangles.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) part.triangles.push_back(mesh.triangles[f]);
    part.face_material.assign(part.triangles.size(), no_index);
    return part;
}

}  // namespace

void capi::warn_of_idle_options(const faqem_options* options, const Asset& source, Report& report) {
    if (!options) return;
    for (std::string& idle :
         detail::idle_options(source, options->options, options->named, detail::member_spelling))
        report.warnings.push_back(std::move(idle));
}

faqem_status faqem_asset_load(const char* path, faqem_asset** asset, faqem_error* error) {
    return capi::catch_exceptions(error, {{path, "path"}, {asset, "asset"}},
                                  [&] { *asset = new faqem_asset(load(path)); });
}

struct faqem_glb {
    std::vector<std::uint8_t> bytes;
};

faqem_status faqem_asset_to_glb(faqem_asset* asset, faqem_glb** glb, faqem_error* error) {
    return capi::catch_exceptions(error, {{asset, "asset"}, {glb, "glb"}}, [&] {
        std::vector<std::string> losses;
        *glb = new faqem_glb{to_glb(asset->asset, &losses)};
        asset->save_warnings.add(losses);
    });
}

const uint8_t* faqem_glb_bytes(const faqem_glb* glb, size_t* size) {
    if (size) *size = glb ? glb->bytes.size() : 0;
    return glb ? glb->bytes.data() : nullptr;
}

void faqem_glb_destroy(faqem_glb* glb) { delete glb; }

faqem_status faqem_asset_from_glb(const void* bytes, size_t size, faqem_asset** asset, faqem_error* error) {
    return capi::catch_exceptions(error, {{bytes, "bytes"}, {asset, "asset"}}, [&] {
        *asset = new faqem_asset(from_glb({static_cast<const std::uint8_t*>(bytes), size}));
    });
}

faqem_status faqem_asset_create(const faqem_mesh* mesh, faqem_asset** asset, faqem_error* error) {
    return capi::catch_exceptions(error, {{mesh, "mesh"}, {asset, "asset"}}, [&] {
        Asset whole;
        whole.parts.push_back(make_part(capi::MeshArrays(*mesh).view));
        detail::check_asset(whole);  // a model can be saved without simplify()
        *asset = new faqem_asset(std::move(whole));
    });
}

faqem_status faqem_asset_simplify(const faqem_asset* asset, const faqem_options* options,
                                  faqem_asset** simplified, faqem_error* error) {
    return capi::catch_exceptions(error, {{asset, "asset"}, {simplified, "simplified"}}, [&] {
        SimplifiedAsset made = simplify(asset->asset, capi::options_or_defaults(options));
        capi::warn_of_idle_options(options, asset->asset, made.report);
        *simplified = new faqem_asset(std::move(made));
    });
}

faqem_status faqem_asset_bake_onto(const faqem_asset* source, const faqem_asset* target, const char* uvs,
                                   const char* max_distance, const faqem_options* options,
                                   faqem_asset** baked, faqem_error* error) {
    return capi::catch_exceptions(error, {{source, "source"}, {target, "target"}, {baked, "baked"}}, [&] {
        const OntoOptions onto = onto_options(uvs ? uvs : "", max_distance ? max_distance : "");
        SimplifiedAsset made =
            bake_onto(source->asset, target->asset, capi::options_or_defaults(options), onto);
        capi::warn_of_idle_options(options, target->asset, made.report);
        *baked = new faqem_asset(std::move(made));
    });
}

faqem_status faqem_asset_save(faqem_asset* asset, const char* path, faqem_overwrite overwrite,
                              faqem_error* error) {
    return capi::catch_exceptions(error, {{asset, "asset"}, {path, "path"}}, [&] {
        asset->save_warnings.add(save(asset->asset, path, capi::to_overwrite(overwrite)));
    });
}

void faqem_asset_destroy(faqem_asset* asset) { delete asset; }

size_t faqem_asset_part_count(const faqem_asset* asset) { return asset ? asset->asset.parts.size() : 0; }

const char* faqem_asset_part_name(const faqem_asset* asset, size_t part) {
    const Part* p = capi::find(asset, &Asset::parts, part);
    return p ? p->name.c_str() : nullptr;
}

size_t faqem_asset_vertex_count(const faqem_asset* asset, size_t part) {
    const Part* p = capi::find(asset, &Asset::parts, part);
    return p ? p->positions.size() : 0;
}

size_t faqem_asset_face_count(const faqem_asset* asset, size_t part) {
    const Part* p = capi::find(asset, &Asset::parts, part);
    return p ? p->triangles.size() : 0;
}

const double* faqem_asset_positions(const faqem_asset* asset, size_t part) {
    const Part* p = capi::find(asset, &Asset::parts, part);
    return p && !p->positions.empty() ? p->positions.front().data() : nullptr;
}

const uint32_t* faqem_asset_triangles(const faqem_asset* asset, size_t part) {
    const Part* p = capi::find(asset, &Asset::parts, part);
    return p && !p->triangles.empty() ? p->triangles.front().data() : nullptr;
}

size_t faqem_asset_warning_count(const faqem_asset* asset) {
    return asset ? asset->asset.warnings.size() + asset->save_warnings.size() : 0;
}

const char* faqem_asset_warning(const faqem_asset* asset, size_t index) {
    if (!asset) return nullptr;
    const auto& found = asset->asset.warnings;
    return index < found.size() ? found[index].c_str() : asset->save_warnings.at(index - found.size());
}

size_t faqem_asset_not_understood_count(const faqem_asset* asset) {
    return asset ? asset->asset.not_understood.size() : 0;
}

const char* faqem_asset_not_understood(const faqem_asset* asset, size_t index) {
    return index < faqem_asset_not_understood_count(asset) ? asset->asset.not_understood[index].c_str()
                                                           : nullptr;
}

faqem_status faqem_asset_report(const faqem_asset* asset, faqem_report* report) {
    if (!asset || !asset->stored_report || !report) return FAQEM_ERROR_OPTION;
    *report = capi::to_c_report(asset->stored_report->report);
    return FAQEM_OK;
}

const char* faqem_asset_report_json(const faqem_asset* asset) {
    return asset && asset->stored_report ? asset->stored_report->json.c_str() : nullptr;
}
