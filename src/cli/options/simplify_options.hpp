#pragma once
/// \file
/// Options that determine the result, shared by `faqem simplify`, `batch`, `lod` and `truncate`.

#include <cstdint>
#include <optional>
#include <string>

#include "cli/simplify_model.hpp"
#include "faqem/levels.hpp"
#include "faqem/options.hpp"

namespace CLI {
class App;
}

namespace faqem::cli {

/// Values of the options as parsed from the command line.
struct SimplifyArguments {
    std::string preset, budget, visibility, bake, mapping, normal_map, normals, image_format;
    std::string virtual_edges;  ///< empty: off
    std::optional<std::string> max_error, prune;
    std::optional<std::string> ratio;
    std::uint64_t faces = 0;
    bool link = false, lock_boundary = false, keep_groups = false;
    bool strict = false, strict_target = false;
    Options options;  ///< options whose values are parsed directly into their member

    Strictness strictness() const { return strict ? Strictness::strict : Strictness::lenient; }
};

/// Adds all options of SimplifyArguments to a command.
/// \param arguments  receives the values; must outlive the command
void add_simplify_options(CLI::App& command, SimplifyArguments& arguments);

/// Adds all options except the targets (--ratio, --faces and --max-error). \param arguments  as above
void add_options_without_targets(CLI::App& command, SimplifyArguments& arguments);

/// Adds only the options of baking. \param arguments  as above
void add_bake_options(CLI::App& command, SimplifyArguments& arguments);

/// Parses one level: `0.5` (ratio of faces), `5000` (number of faces), `error:0.01` (distance in model units)
/// or `error:0.1%` (distance relative to the diagonal).
/// \throws OptionError  the text has another form
Level parse_level(const std::string& text);

/// Converts and validates the arguments. \throws OptionError  a value is unknown or out of range
Options make_options(const SimplifyArguments& arguments);

}  // namespace faqem::cli
