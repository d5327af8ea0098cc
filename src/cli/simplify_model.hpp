#pragma once
/// \file
/// What simplify and batch hold a model to.

#include <filesystem>
#include <optional>
#include <string>

#include "cli/byte_budget.hpp"
#include "cli/exit_code.hpp"
#include "faqem/bake.hpp"
#include "faqem/error.hpp"
#include "faqem/report.hpp"

namespace faqem::cli {

/// Whether what load() repairs or leaves out is an error.
enum class Strictness { lenient, strict };

/// load(), and a model without triangles is an error. \throws ReadError, InputError, UnsupportedError
Asset load_model(const std::filesystem::path& file, Strictness strictness);

/// Does the work. What is wrong with an asset is said with the name of its file.
template <class Work>
auto with_file_in_errors(const std::filesystem::path& file, Work&& work) {
    try {
        return work();
    } catch (const UnsupportedError& error) {
        throw UnsupportedError(file.string(), "", error.what());
    } catch (const InputError& error) {
        throw InputError(file.string(), "", error.what());
    }
}

/// What Bake::automatic comes to where the result's file holds no textures, or no more than bare geometry was
/// read: there is nothing to lay out an atlas for. PLY: vertex colours, where the source has any look; STL,
/// and bare geometry into PLY and OBJ: none; STL has no vertex normals from the original either, which would
/// need the map. Other kinds, and other files, stay as they are.
/// \param out  its extension decides
BakeOptions resolve_automatic_bake(BakeOptions requested, const Asset& source,
                                   const std::filesystem::path& out);

/// simplify(), within a budget where there is one. What is wrong with an asset is said with the name of its
/// file.
SimplifiedAsset simplify_model(const Asset& source, const std::filesystem::path& file, const Options& options,
                               const std::optional<ByteBudget>& budget = std::nullopt);

/// Why the result is not to be written, or exit_ok.
ExitCode rejection_code(const Report& report, bool strict_target);

/// One sentence about a result that was refused.
std::string rejection_message(ExitCode rejection, const std::filesystem::path& out, const Report& report);

}  // namespace faqem::cli
