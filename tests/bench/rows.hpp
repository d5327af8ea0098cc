#pragma once
/// \file
/// The rows of the benchmark: JSON lines, one per mesh, ratio and simplifier, written as they are ready.

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <tuple>

#include "child.hpp"

namespace faqem::bench {

/// A mesh and what is known of it before anything is simplified.
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

/// The keys of the rows in a file; empty where there is no file. A last line that is cut off is not a row.
std::set<RowKey> keys_in(const std::filesystem::path& file);

/// Measures one result with `samples` samples a side, always the same ones, and gives the row as a line.
std::string make_row(const RowKey& key, const Subject& subject, std::size_t target, const ChildResult& result,
                     std::uint64_t samples);

}  // namespace faqem::bench
