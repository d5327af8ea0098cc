#pragma once
/// \file
/// The options of faqem simplify that say what the result is to be; faqem batch and faqem lod have the same.

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

/// The command line as it was given.
struct SimplifyArguments {
    std::string preset, budget, visibility, bake, mapping, normal_map, normals, image_format;
    std::string virtual_edges;  ///< empty: off
    std::optional<std::string> max_error, prune;
    std::optional<double> ratio;
    std::uint64_t faces = 0;
    bool link = false, lock_boundary = false, keep_groups = false;
    bool strict = false, strict_target = false;
    Options options;  ///< those that need no translation

    Strictness strictness() const { return strict ? Strictness::strict : Strictness::lenient; }
};

/// Adds the options to a command; they are read into `arguments`, which has to live on.
void add_simplify_options(CLI::App& command, SimplifyArguments& arguments);

/// Those that do not say how many faces or how close.
void add_level_options(CLI::App& command, SimplifyArguments& arguments);

/// Those that say what is baked.
void add_bake_options(CLI::App& command, SimplifyArguments& arguments);

/// `0.5`, a share of the faces; `5000`, a number of them; `error:0.01` in model units or `error:0.1%` of the
/// diagonal.
/// \throws OptionError
Level parse_level(const std::string& text);

/// \throws OptionError  a value is unknown or out of range
Options make_options(const SimplifyArguments& arguments);

/// Everything in the options that the result depends on, as text: equal where the results are.
std::string options_key(const Options& options);

}  // namespace faqem::cli
