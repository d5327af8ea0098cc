#pragma once
/// \file
/// The steps of simplify(file, out, options), for programs that do something in between.

#include <filesystem>
#include <functional>

#include "faqem/bake.hpp"
#include "faqem/error.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Returns `work()`. The file name is prepended to the message of any InputError or UnsupportedError.
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

/// Loads a model, without coarser levels of detail. \throws InputError  it has no triangles
/// \throws whatever load() throws
FAQEM_EXPORT Asset load_triangles(const std::filesystem::path& file);

/// Loads a model and simplifies it. Options::max_seconds holds for both together.
/// \param loaded  called in between; may throw
/// \throws whatever load_triangles() and simplify() throw; messages name the file
FAQEM_EXPORT SimplifiedAsset simplify_file(const std::filesystem::path& file, const Options& options,
                                           const std::function<void(const Asset&)>& loaded);

/// Saves a result and completes its report: the size of the files and what holds it, what they cannot
/// store, and the time.
/// \throws whatever save() throws
/// \param options  of simplify_file()
FAQEM_EXPORT void save_result(SimplifiedAsset& result, const std::filesystem::path& file,
                              const Options& options, Overwrite overwrite);

}  // namespace faqem::detail
