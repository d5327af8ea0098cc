#include "cli/options/simplify_options.hpp"

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "cli/options/common_options.hpp"
#include "faqem/detail/options/option_table.hpp"
#include "faqem/error.hpp"
#include "faqem/report.hpp"

namespace faqem::cli {

namespace {

constexpr std::array<std::pair<std::string_view, Bake>, 6> bakes = {{{"auto", Bake::automatic},
                                                                     {"atlas", Bake::atlas},
                                                                     {"per-triangle", Bake::per_triangle},
                                                                     {"vertex", Bake::vertex},
                                                                     {"keep", Bake::keep},
                                                                     {"none", Bake::none}}};
constexpr std::array<std::pair<std::string_view, Mapping>, 3> mappings = {
    {{"projection", Mapping::projection}, {"lineage", Mapping::lineage}, {"closest", Mapping::closest}}};

constexpr std::array<std::pair<std::string_view, NormalMap>, 3> normal_maps = {
    {{"auto", NormalMap::automatic}, {"on", NormalMap::on}, {"off", NormalMap::off}}};

constexpr std::array<std::pair<std::string_view, Normals>, 4> normals = {{{"transfer", Normals::transfer},
                                                                          {"smooth", Normals::smooth},
                                                                          {"flat", Normals::flat},
                                                                          {"none", Normals::none}}};
constexpr std::array<std::pair<std::string_view, ImageFormat>, 3> image_formats = {
    {{"png", ImageFormat::png}, {"jpeg", ImageFormat::jpeg}, {"source", ImageFormat::source}}};

constexpr std::array<std::pair<std::string_view, Budget>, 2> budgets = {
    {{"scene", Budget::scene}, {"mesh", Budget::mesh}}};

constexpr std::array<std::pair<std::string_view, Visibility>, 2> visibilities = {
    {{"ignored", Visibility::ignored}, {"weighted", Visibility::weighted}}};

template <class Value, std::size_t n>
Value parse_enum(const std::array<std::pair<std::string_view, Value>, n>& names, const std::string& text,
                 const char* option) {
    std::string known;
    for (const auto& [name, value] : names) {
        if (name == text) return value;
        known += (known.empty() ? "" : ", ") + std::string(name);
    }
    throw OptionError(std::string(option) + ": unknown value '" + text + "' (known: " + known + ")");
}

double parse_number(const std::string& text, const char* option) {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end)
        throw OptionError(std::string(option) + ": '" + text + "' is not a number");
    return value;
}

/// Parses `0.1` or `10%`, which is 0.1.
double parse_ratio(const std::string& text, const char* option) {
    if (!text.ends_with('%')) return parse_number(text, option);
    return parse_number(text.substr(0, text.size() - 1), option) / 100;
}

/// Parses `0.01` (model units) or `0.1%` (of the diagonal).
Length parse_length(const std::string& text, const char* option) {
    const double value = parse_ratio(text, option);
    return text.ends_with('%') ? of_diagonal(value) : model_units(value);
}

/// Parses `kind:NUMBER`, removes the suffix from the text and returns the number. Returns nothing for other
/// texts.
std::optional<double> take_suffix_number(std::string& text, std::string_view kind, const char* option) {
    if (text.compare(0, kind.size() + 1, std::string(kind) + ":") != 0) return std::nullopt;
    const double value = parse_number(text.substr(kind.size() + 1), option);
    text = kind;
    return value;
}

void read_normals(std::string text, BakeOptions& bake) {
    if (const auto angle = take_suffix_number(text, "smooth", "--normals")) bake.crease_angle = *angle;
    bake.normals = parse_enum(normals, text, "--normals");
}

void read_image_format(std::string text, BakeOptions& bake) {
    if (const auto quality = take_suffix_number(text, "jpeg", "--image-format")) {
        if (!(*quality >= 1 && *quality <= 100 && *quality == std::floor(*quality)))
            throw OptionError("--image-format: the quality must be a whole number from 1 to 100");
        bake.jpeg_quality = static_cast<std::uint32_t>(*quality);
    }
    bake.image_format = parse_enum(image_formats, text, "--image-format");
}

std::string preset_names() {
    std::string all;
    for (const Preset preset : all_presets) {
        if (!all.empty()) all += ", ";
        all += name(preset);
    }
    return all;
}

void add_target_options(CLI::App& command, SimplifyArguments& a) {
    auto* ratio =
        command.add_option("--ratio", a.ratio, "Ratio of faces to keep, in (0, 1] or as 10% (default 0.1)");
    auto* faces = command.add_option("--faces", a.faces, "Number of faces to keep")->check(positive_number());
    ratio->excludes(faces);
    command.add_option("--max-error", a.max_error,
                       "Maximum distance from the original, in model units or with % of the diagonal. Finds "
                       "the smallest mesh within it; with --ratio or --faces the distance is only checked");
}

void add_metric_options(CLI::App& command, SimplifyArguments& a) {
    command.add_option("--budget", a.budget,
                       "How the faces are distributed among the meshes of a scene: scene (by error, "
                       "default), mesh (in proportion to their face counts)");
    command.add_option("--visibility", a.visibility,
                       "Errors on hidden surface: ignored (visibility has no effect, default), weighted "
                       "(they count less)");
    command.add_option(
        "--preset", a.preset,
        "Metric and rules: " + preset_names() + " (default " + std::string(name(Options{}.preset)) + ")");
    command.add_option("--w-area", a.options.weights.area, "Weight of the boundary area term");
    command.add_option("--w-boundary", a.options.weights.boundary, "Weight of the boundary curvature term");
    command.add_option("--w-normal", a.options.weights.normal, "Weight of the normal term");
    command.add_option("--w-uv", a.options.weights.uv, "Factor on quadrics at preserved UV seams");
    command.add_option("--w-plane-area", a.options.weights.plane_area,
                       "Inverse-area weight of planes; 0: unweighted");
}

void add_topology_options(CLI::App& command, SimplifyArguments& a) {
    command.add_flag_callback(
        "--link", [&a] { a.link = true; }, "Enforce the link condition while the target can be reached");
    command.add_flag("--lock-boundary", a.lock_boundary, "Do not move boundary vertices");
    command.add_flag("--keep-groups", a.keep_groups,
                     "Preserve boundaries between materials, even if the target is missed");
    command.add_option("--weld", a.options.topology.weld_distance,
                       "Weld vertices that are at most this far apart, model units");
    command.add_option("--prune", a.prune,
                       "Delete connected components whose bounding box has a smaller diagonal, in model "
                       "units or with % of the scene's diagonal; the largest of each mesh is kept");
    // A flag with an optional value: an option would take a file name that follows as its value.
    command.add_flag("--virtual-edges{0.01}", a.virtual_edges,
                     "Connect boundaries of different components; =TAU: across gaps of at most TAU times "
                     "the diagonal (default 0.01)");
}

}  // namespace

void add_simplify_options(CLI::App& command, SimplifyArguments& a) {
    add_target_options(command, a);
    add_options_without_targets(command, a);
}

void add_bake_options(CLI::App& command, SimplifyArguments& a) {
    command.add_option(
        "--bake", a.bake,
        "Where colours are stored: auto (default: atlas or per-triangle, see docs/baking.md), atlas "
        "(charts), per-triangle, vertex, keep, none");
    command.add_option("--texture-size", a.options.bake.texture_size,
                       "Maximum side of a baked image, a power of two from 64 to 16384 (default 2048)");
    command.add_option("--texel-density", a.options.bake.texel_density,
                       "Texels per length of a new texture, relative to the source, 0.125 to 8 (default 1; "
                       "more on small pages)");
    command.add_option("--normal-map", a.normal_map,
                       "Normal map of a new texture: auto (if the source has one or its normals differ; "
                       "default), on, off");
    command.add_option("--normals", a.normals,
                       "Vertex normals: transfer (from the original; default), smooth or smooth:ANGLE "
                       "(averaged below ANGLE degrees, default 40), flat, none (only with --bake none)");
    command.add_option("--image-format", a.image_format,
                       "Format of baked images: png (default), jpeg or jpeg:QUALITY (1 to 100, default "
                       "90), source (that of the images they are baked from)");
    command.add_option("--mapping", a.mapping, "Map to the original: projection (default), lineage, closest");
}

void add_options_without_targets(CLI::App& command, SimplifyArguments& a) {
    add_metric_options(command, a);
    add_bake_options(command, a);
    add_topology_options(command, a);
    command.add_flag("--strict", a.strict,
                     "Exit with 3 if the input would be repaired: invalid elements, faces of zero area, "
                     "duplicate faces");
    command.add_flag("--strict-target", a.strict_target,
                     "Exit with 5, and write no model, if the target is missed");
}

Options make_options(const SimplifyArguments& arguments) {
    Options options = arguments.options;
    if (arguments.faces > 0) options.target = faces(arguments.faces);
    if (arguments.ratio) options.target = ratio(parse_ratio(*arguments.ratio, "--ratio"));
    if (arguments.max_error) options.max_error = parse_length(*arguments.max_error, "--max-error");
    if (!arguments.preset.empty()) options.preset = preset_named(arguments.preset);
    if (!arguments.budget.empty()) options.budget = parse_enum(budgets, arguments.budget, "--budget");
    if (!arguments.visibility.empty())
        options.visibility = parse_enum(visibilities, arguments.visibility, "--visibility");
    if (!arguments.bake.empty()) options.bake.kind = parse_enum(bakes, arguments.bake, "--bake");
    if (!arguments.normal_map.empty()) {
        options.bake.normal_map = parse_enum(normal_maps, arguments.normal_map, "--normal-map");
    }
    if (!arguments.normals.empty()) read_normals(arguments.normals, options.bake);
    if (!arguments.image_format.empty()) read_image_format(arguments.image_format, options.bake);
    if (!arguments.mapping.empty())
        options.bake.mapping = parse_enum(mappings, arguments.mapping, "--mapping");
    if (arguments.link) options.topology.link = LinkCondition::on;
    if (arguments.lock_boundary) options.topology.boundary = Boundary::locked;
    if (arguments.keep_groups) options.topology.group_boundaries = GroupBoundaries::kept;
    if (arguments.prune) options.topology.prune = parse_length(*arguments.prune, "--prune");
    if (!arguments.virtual_edges.empty()) {
        options.topology.virtual_edges = VirtualEdges::on;
        options.topology.virtual_edge_distance = parse_number(arguments.virtual_edges, "--virtual-edges");
    }
    detail::check_options(options, detail::command_spelling);
    return options;
}

Level parse_level(const std::string& text) {
    constexpr std::string_view distance = "error:";
    if (text.starts_with(distance)) return parse_length(text.substr(distance.size()), "--levels");
    const double value = parse_number(text, "--levels");
    if (value > 0 && value <= 1) return ratio(value);
    if (!(value > 1 && value < 1e15 && value == std::floor(value)))
        throw OptionError("--levels: '" + text + "' is neither a ratio in (0, 1] nor a number of faces");
    return faces(static_cast<std::uint64_t>(value));
}

}  // namespace faqem::cli
