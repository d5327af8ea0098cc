#pragma once
/// \file
/// The rows of the benchmark: one line of JSON per mesh, ratio and simplifier, written when it is measured.

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>

#include "child.hpp"

namespace faqem::bench {

/// An input mesh.
struct Subject {
    std::string name;
    TriangleMesh mesh;
};

struct RowKey {
    std::string mesh;
    double ratio = 0;
    std::string simplifier;
    auto operator<=>(const RowKey&) const = default;
};

/// Returns the keys of the rows in a file; empty if there is no file. Truncated lines are ignored.
std::set<RowKey> keys_in(const std::filesystem::path& file);

/// Measures one result and returns its row as a line of JSON.
/// \param target   target face count
/// \param samples  number of samples per direction; the same samples are used in every run
std::string make_row(const RowKey& key, const Subject& subject, std::size_t target, const ChildResult& result,
                     std::uint64_t samples);

}  // namespace faqem::bench
