#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "faqem/bake.hpp"
#include "faqem/error.hpp"
#include "stopwatch.hpp"
#include "tool/commands.hpp"
#include "tool/exit_code.hpp"
#include "tool/interrupt.hpp"
#include "tool/output.hpp"
#include "tool/progress_bar.hpp"
#include "tool/strict.hpp"

namespace faqem::tool {

namespace {

using detail::Stopwatch;

constexpr std::array<std::pair<std::string_view, Bake>, 4> bakes = {{{"per-triangle", Bake::per_triangle},
                                                                     {"vertex", Bake::vertex},
                                                                     {"keep", Bake::keep},
                                                                     {"none", Bake::none}}};
constexpr std::array<std::pair<std::string_view, Mapping>, 2> mappings = {
    {{"projection", Mapping::projection}, {"lineage", Mapping::lineage}}};

constexpr std::array<std::pair<std::string_view, Budget>, 2> budgets = {
    {{"scene", Budget::scene}, {"mesh", Budget::mesh}}};

template <class Value, std::size_t n>
Value named(const std::array<std::pair<std::string_view, Value>, n>& names, const std::string& text,
            const char* option) {
    std::string known;
    for (const auto& [name, value] : names) {
        if (name == text) return value;
        known += (known.empty() ? "" : ", ") + std::string(name);
    }
    throw OptionError(std::string(option) + ": unknown value '" + text + "' (known: " + known + ")");
}

double number(const std::string& text, const char* option) {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end)
        throw OptionError(std::string(option) + ": '" + text + "' is no number");
    return value;
}

/// `0.01` in model units, or `0.1%` of the diagonal.
Length length(const std::string& text, const char* option) {
    if (!text.ends_with('%')) return model_units(number(text, option));
    return of_diagonal(number(text.substr(0, text.size() - 1), option) / 100);
}

/// The command line as it was given.
struct Arguments {
    std::string in, out, report, history;
    std::string preset, budget, bake, mapping;
    std::string virtual_edges;  ///< empty: off
    std::optional<std::string> max_error, prune;
    std::optional<double> ratio;
    std::uint64_t faces = 0;
    bool link = false, lock_border = false, keep_groups = false;
    bool strict = false, strict_target = false, force = false, quiet = false;
    Options options;

    Overwrite overwrite() const { return force ? Overwrite::yes : Overwrite::no; }
};

Options make_options(const Arguments& arguments) {
    Options options = arguments.options;
    if (arguments.faces > 0) options.target = faces(arguments.faces);
    if (arguments.ratio) options.target = ratio(*arguments.ratio);
    if (arguments.max_error) options.max_error = length(*arguments.max_error, "--max-error");
    if (!arguments.preset.empty()) options.preset = preset_named(arguments.preset);
    if (!arguments.budget.empty()) options.budget = named(budgets, arguments.budget, "--budget");
    if (!arguments.bake.empty()) options.bake.kind = named(bakes, arguments.bake, "--bake");
    if (!arguments.mapping.empty()) options.bake.mapping = named(mappings, arguments.mapping, "--mapping");
    if (arguments.link) options.topology.link = LinkCondition::on;
    if (arguments.lock_border) options.topology.border = Border::locked;
    if (arguments.keep_groups) options.topology.group_borders = GroupBorders::kept;
    if (arguments.prune) options.topology.prune = length(*arguments.prune, "--prune");
    if (!arguments.virtual_edges.empty()) {
        options.topology.virtual_edges = VirtualEdges::on;
        options.topology.virtual_edge_distance = number(arguments.virtual_edges, "--virtual-edges");
    }
    if (!arguments.history.empty()) options.history = Recording::on;
    validate(options);
    return options;
}

/// Everything that can be wrong about the output, before hours of work go into it.
void check_outputs(const Arguments& arguments) {
    check_ending(arguments.out, {".glb", ".gltf", ".obj", ".ply", ".stl"});
    std::vector<std::filesystem::path> taken = {arguments.in};
    for (const std::string& file : {arguments.out, arguments.report, arguments.history}) {
        if (file.empty()) continue;
        check_output(file, taken, arguments.overwrite());
        for (const auto& other : taken) {
            if (std::filesystem::path(file).lexically_normal() == other.lexically_normal()) {
                throw OptionError(file + ": is named twice");
            }
        }
        taken.emplace_back(file);
    }
}

void write_histories(const Arguments& arguments, const std::vector<CollapseHistory>& histories) {
    std::ostringstream out;
    for (const CollapseHistory& history : histories) write(history, out);
    write_output(arguments.history, out.view(), arguments.overwrite());
}

void print_counts(std::ostream& out, const Report& report) {
    std::string_view separator = "refused: ";
    for (std::size_t i = 0; i < refusal_kinds; ++i) {
        if (report.refusals[i] == 0) continue;
        out << separator << report.refusals[i] << " " << name(static_cast<Refusal>(i));
        separator = ", ";
    }
    if (separator == ", ") out << "\n";
    separator = "rungs taken: ";
    for (std::size_t i = 0; i < rung_kinds; ++i) {
        if (report.rungs[i] == 0) continue;
        out << separator << name(static_cast<Rung>(i)) << " " << report.rungs[i] << " times";
        separator = ", ";
    }
    if (separator == ", ") out << "\n";
}

void print_summary(const Arguments& arguments, const Report& report) {
    std::ostringstream out;
    out << arguments.in << " -> " << arguments.out << "\n"
        << report.faces_in << " -> " << report.faces_out << " faces (target " << report.target_faces << "), "
        << name(report.stop) << ", preset " << name(report.preset) << "\n";
    if (report.max_error) {
        const MeasuredError& error = *report.max_error;
        out << "distance: " << error.value << " found, at most " << error.bound << " (allowed "
            << error.allowed << "), " << error.runs << (error.runs == 1 ? " run\n" : " runs\n");
    }
    print_counts(out, report);
    out << report.warnings.size() << (report.warnings.size() == 1 ? " warning\n" : " warnings\n");
    for (const std::string& warning : report.warnings) out << "  " << warning << "\n";
    const PhaseSeconds& s = report.seconds;
    out << std::fixed << std::setprecision(2) << "seconds: load " << s.load << ", simplify " << s.simplify
        << ", map " << s.map << ", bake " << s.bake << ", save " << s.save << ", total " << s.total << "\n";
    std::cout << out.str();
}

Asset load_input(const Arguments& arguments, PhaseSeconds& seconds) {
    const Unattended unattended;
    const Stopwatch watch;
    const std::string& file = arguments.in;
    Asset asset = load(file);
    seconds.load = watch.seconds();
    std::uint64_t faces = 0;
    for (const Part& part : asset.parts) faces += part.triangles.size();
    if (faces == 0) throw InputError(file, "", "has no triangles");
    if (arguments.strict) require_clean(asset, file);
    return asset;
}

/// What is wrong with an asset is said with the name of its file.
LightAsset simplify_input(const Asset& source, const Arguments& arguments, const Options& options) {
    try {
        return simplify(source, options);
    } catch (const UnsupportedError& error) {
        throw UnsupportedError(arguments.in, "", error.what());
    } catch (const InputError& error) {
        throw InputError(arguments.in, "", error.what());
    }
}

int cancelled() {
    std::cerr << "faqem: cancelled\n";
    return exit_cancelled;
}

/// Writes the model last but for the report, which tells how long that took.
void save_result(const Arguments& arguments, LightAsset& light) {
    const Unattended unattended;
    const Stopwatch watch;
    if (!arguments.history.empty()) write_histories(arguments, light.histories);
    const std::vector<std::string> losses = save(light.asset, arguments.out, arguments.overwrite());
    light.report.warnings.insert(light.report.warnings.end(), losses.begin(), losses.end());
    light.report.seconds.save = watch.seconds();
}

/// Why the model is not to be written, or exit_ok.
ExitCode why_refused(const Arguments& arguments, const Report& report) {
    if (arguments.strict_target && report.faces_out > report.target_faces) return exit_target_missed;
    if (report.max_error && !report.max_error->within()) return exit_error_exceeded;
    return exit_ok;
}

void explain(ExitCode refusal, const Arguments& arguments, const Report& report) {
    if (refusal == exit_target_missed) {
        std::cerr << "faqem: target missed: " << report.faces_out << " faces, " << report.target_faces
                  << " wanted; ";
    } else {
        std::cerr << "faqem: max error exceeded: " << report.faces_out << " faces are up to "
                  << report.max_error->bound << " from the original, " << report.max_error->allowed
                  << " allowed; ";
    }
    std::cerr << arguments.out << " was not written\n";
}

int run(const Arguments& arguments) {
    Options options = make_options(arguments);
    check_outputs(arguments);
    handle_interrupts();
    const Stopwatch watch;
    LightAsset light;
    {
        ProgressBar bar(arguments.quiet ? Bar::hidden : Bar::shown);
        options.progress = [&bar](Phase phase, double fraction) {
            bar.show(phase, fraction);
            return interrupted() ? Continue::cancel : Continue::yes;
        };
        PhaseSeconds seconds;
        bar.show(Phase::load, 0);
        const Asset source = load_input(arguments, seconds);
        light = simplify_input(source, arguments, options);
        light.report.seconds.load = seconds.load;
        light.report.warnings.insert(light.report.warnings.begin(), source.warnings.begin(),
                                     source.warnings.end());
        if (interrupted() || light.report.stop == StopReason::cancelled) return cancelled();
    }
    const ExitCode refusal = why_refused(arguments, light.report);
    if (refusal == exit_ok) save_result(arguments, light);
    light.report.seconds.total = watch.seconds();
    if (!arguments.report.empty()) {
        const Unattended unattended;
        write_output(arguments.report, to_json(light.report), arguments.overwrite());
    }
    if (!arguments.quiet) print_summary(arguments, light.report);
    if (refusal != exit_ok) explain(refusal, arguments, light.report);
    return refusal;
}

std::string preset_names() {
    std::string all;
    for (const Preset preset : all_presets) {
        if (!all.empty()) all += ", ";
        all += name(preset);
    }
    return all;
}

void add_target_options(CLI::App& command, Arguments& a) {
    auto* ratio =
        command.add_option("--ratio", a.ratio, "Share of the faces to keep, in (0, 1] (default 0.1)");
    auto* faces =
        command.add_option("--faces", a.faces, "Number of faces to keep")->check(CLI::PositiveNumber);
    ratio->excludes(faces);
    command.add_option("--max-error", a.max_error,
                       "Largest distance from the original, in model units or with % of the diagonal: the "
                       "smallest mesh found within it; with --ratio or --faces: a condition");
    command.add_option("--budget", a.budget,
                       "How the meshes of a scene share the faces: scene (by error, default), mesh (in "
                       "proportion to their faces)");
    command.add_option(
        "--preset", a.preset,
        "Metric and rules: " + preset_names() + " (default " + std::string(name(Options{}.preset)) + ")");
    command.add_option("--w-area", a.options.weights.area, "Weight of the boundary area term");
    command.add_option("--w-boundary", a.options.weights.boundary, "Weight of the boundary curvature term");
    command.add_option("--w-normal", a.options.weights.normal, "Weight of the normal term");
    command.add_option("--w-uv", a.options.weights.uv, "Factor on quadrics at UV seams, where UVs are kept");
    command.add_option("--w-plane-area", a.options.weights.plane_area,
                       "Inverse-area weight of planes; 0: unweighted");
}

void add_look_options(CLI::App& command, Arguments& a) {
    command.add_option("--bake", a.bake, "Where colours go: per-triangle (default), vertex, keep, none");
    command.add_option("--texture-size", a.options.bake.texture_size,
                       "Largest side of a baked image, a power of two from 64 to 16384 (default 2048)");
    command.add_option("--mapping", a.mapping, "Way back to the original: projection (default), lineage");
}

void add_topology_options(CLI::App& command, Arguments& a) {
    command.add_flag_callback(
        "--link", [&a] { a.link = true; }, "Keep the topology (link condition)");
    command.add_flag("--lock-border", a.lock_border, "Open borders stay where they are");
    command.add_flag("--keep-groups", a.keep_groups,
                     "Borders between materials stay where they are, even if the target is missed");
    command.add_option("--weld", a.options.topology.weld_distance, "Join vertices at most this far apart");
    command.add_option("--prune", a.prune,
                       "Delete connected components whose box has a smaller diagonal, in model units or "
                       "with % of the scene's diagonal; never the largest of a mesh");
    // A flag, not an option: an option would take the file name that may follow for its value.
    command.add_flag(
        "--virtual-edges{0.01}", a.virtual_edges,
        "Join parts that do not touch; =TAU: over gaps up to TAU of the diagonal (default 0.01)");
}

void add_run_options(CLI::App& command, Arguments& a) {
    command.add_option("--threads", a.options.threads, "Threads at most; the result does not depend on it")
        ->check(CLI::Range(0, 1024));
    command.add_option("--report", a.report, "Write counts, warnings and times to this JSON file");
    command.add_option("--history", a.history, "Write the collapse history to this file");
    command.add_flag("--strict", a.strict,
                     "Exit with 3 where the input would be repaired: nothing left out, every face with area "
                     "and once");
    command.add_flag("--strict-target", a.strict_target,
                     "Exit with 5, and write no model, when the target is missed");
    command.add_flag("--force", a.force, "Replace files that exist");
    command.add_flag("--quiet", a.quiet, "No summary, no progress bar");
}

}  // namespace

void add_simplify_command(CLI::App& app, Action& action) {
    const auto arguments = std::make_shared<Arguments>();
    CLI::App* command =
        app.add_subcommand("simplify", "Make a model lighter and bake its look into a new texture");
    command->add_option("IN", arguments->in, ".glb, .gltf, .obj, .ply, .stl or .off")->required();
    command->add_option("OUT", arguments->out, ".glb, .gltf, .obj, .ply or .stl")->required();
    add_target_options(*command, *arguments);
    add_look_options(*command, *arguments);
    add_topology_options(*command, *arguments);
    add_run_options(*command, *arguments);
    command->final_callback([arguments, &action] { action = [arguments] { return run(*arguments); }; });
}

}  // namespace faqem::tool
