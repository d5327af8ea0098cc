#pragma once
/// \file
/// Definition of faqem_history.

#include <string>
#include <vector>

#include "faqem/faqem_levels.h"
#include "faqem/truncate.hpp"

struct faqem_history {
    /// \param histories  one per part, at least one
    explicit faqem_history(std::vector<faqem::ChainHistory> histories);

    std::vector<faqem::ChainHistory> parts;
    std::string bytes;  ///< serialised in the constructor, so that getters are thread-safe
};

namespace faqem::capi {

/// truncate_to_faces() for all parts.
/// \throws OptionError  `history` is null, or `faces` is 0
/// \throws InputError  as truncate_to_faces()
std::vector<CollapseHistory> truncate_parts(const faqem_history* history, std::uint64_t faces);

}  // namespace faqem::capi
