#pragma once
/// \file
/// What a faqem_history is inside.

#include <string>
#include <vector>

#include "faqem/cut.hpp"
#include "faqem/faqem_levels.h"

struct faqem_history {
    /// \param histories  one per part, at least one
    explicit faqem_history(std::vector<faqem::ChainHistory> histories);

    std::vector<faqem::ChainHistory> parts;
    std::string bytes;  ///< made at once: getters only read
};

namespace faqem::c {

/// cut_to() for all parts. \throws OptionError, InputError
std::vector<CollapseHistory> cut_parts(const faqem_history* history, std::uint64_t faces);

}  // namespace faqem::c
