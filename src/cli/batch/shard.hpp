#pragma once
/// \file
/// Shards: the part of a list that one process works on.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace faqem::cli {

/// A shard and the number of shards. \invariant index < count
struct Shard {
    std::uint64_t index = 0, count = 1;

    /// Whether a model belongs to the shard: the first 8 bytes of the SHA-256 of its id, as a big-endian number, modulo
    /// `count`. A list that grows does not change the shard of a model.
    bool contains(const std::string& id) const;
    /// `3-of-100`.
    std::string name() const;
};

/// Value of an environment variable; nothing if it is not set.
using Environment = std::function<std::optional<std::string>(const std::string& name)>;

/// The environment of this process.
std::optional<std::string> environment_variable(const std::string& name);

/// Parses `I/N`, or `auto`: then the index is FAQEM_SHARD_INDEX, or that of an array job of Slurm, AWS Batch or
/// Kubernetes, or RANK, plus FAQEM_SHARD_OFFSET; the number is FAQEM_SHARD_COUNT, or that of the array.
/// \throws OptionError  the text has another form, the index is not below the number, or `auto` finds no index or number
Shard parse_shard(const std::string& text, const Environment& environment = environment_variable);

/// The output of a model that the list gives none, relative to the output directory: `ab/ID.glb`, where `ab` are the
/// first two digits of the SHA-256 of the id, and bytes of the id other than letters, digits, `.`, `_` and `-` are
/// written as `%20`; an id that is too long for the name of a file is replaced by its hash.
/// \param extension  with the dot
std::string default_output(const std::string& id, const std::string& extension);

}  // namespace faqem::cli
