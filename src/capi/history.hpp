#pragma once
/// \file
/// What a faqem_history is inside.

#include <string>
#include <vector>

#include "faqem/faqem_levels.h"
#include "faqem/truncate.hpp"

struct faqem_history {
    /// \param histories  one per part, at least one
    explicit faqem_history(std::vector<faqem::ChainHistory> histories);

    std::vector<faqem::ChainHistory> parts;
    std::string bytes;  ///< made at once: getters only read
};

namespace faqem::capi {

/// truncate_to_faces() for all parts. \throws OptionError, InputError
std::vector<CollapseHistory> truncate_parts(const faqem_history* history, std::uint64_t faces);

}  // namespace faqem::capi
