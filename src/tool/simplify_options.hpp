#pragma once
/// \file
/// The options of faqem simplify that say what the result is to be; faqem batch has the same.

#include <cstdint>
#include <optional>
#include <string>

#include "faqem/options.hpp"
#include "tool/simplify_rules.hpp"

namespace CLI {
class App;
}

namespace faqem::tool {

/// The command line as it was given.
struct SimplifyArguments {
    std::string preset, budget, bake, mapping, normal_map, normals, image_format;
    std::string virtual_edges;  ///< empty: off
    std::optional<std::string> max_error, prune;
    std::optional<double> ratio;
    std::uint64_t faces = 0;
    bool link = false, lock_border = false, keep_groups = false;
    bool strict = false, strict_target = false;
    Options options;  ///< those that need no translation

    Strictness strictness() const { return strict ? Strictness::strict : Strictness::lenient; }
};

/// Adds the options to a command; they are read into `arguments`, which has to live on.
void add_simplify_options(CLI::App& command, SimplifyArguments& arguments);

/// \throws OptionError  a value is unknown or out of range
Options make_options(const SimplifyArguments& arguments);

/// Everything in the options that the result depends on, as text: equal where the results are.
std::string options_text(const Options& options);

}  // namespace faqem::tool
