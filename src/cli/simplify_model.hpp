#pragma once
/// \file
/// Loading, simplifying and checking one model, shared by `simplify`, `batch`, `lod` and `truncate`.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/budget/byte_budget.hpp"
#include "cli/exit_code.hpp"
#include "cli/no_larger.hpp"
#include "faqem/bake.hpp"
#include "faqem/error.hpp"
#include "faqem/report.hpp"

namespace faqem::cli {

/// Whether input that load() repairs or leaves out is an error.
enum class Strictness { lenient, strict };

/// Loads a model and checks that it has triangles.
/// \throws ReadError         the file cannot be read
/// \throws InputError        the file is damaged or has no triangles, or with Strictness::strict needs repair
/// \throws UnsupportedError  the format or a feature of the file is not supported
Asset load_model(const std::filesystem::path& file, Strictness strictness);

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

/// Replaces Bake::automatic for output formats without textures and for sources without appearance.
/// STL, and PLY and OBJ if the source has neither materials nor colours: Bake::none. PLY otherwise:
/// Bake::vertex. For STL the transfer of normals is also turned off, because it would need the map to the
/// original. Untouched parts are baked if they come from glTF and the output is OBJ or PLY, which lack parts of
/// its materials. Other kinds and other formats are returned unchanged.
/// \param out  output file; only its extension is used
/// \throws OptionError  ImageFormat::webp is asked for, and the output is not glTF
BakeOptions resolve_automatic_bake(BakeOptions requested, const Asset& source,
                                   const std::filesystem::path& out);

/// Options of vertices for an output file: Quantize::off for formats other than glTF.
/// \throws OptionError  Quantize::on is asked for, and the output is not glTF
QuantizeOptions resolve_quantize(QuantizeOptions requested, const std::filesystem::path& out);

/// Returns the total size of a model and of the files that it refers to, bytes.
std::uint64_t input_bytes(const std::filesystem::path& model);

/// `2 warnings`, and a line for each, as the summaries of commands print them.
std::string warnings_text(const std::vector<std::string>& warnings);

/// Calls simplify_within_bytes() if there is a budget, otherwise simplify_no_larger().
/// \param file  name of the source, prepended to error messages
/// \throws whatever these functions throw
SimplifiedAsset simplify_model(const Asset& source, const std::filesystem::path& file, const Options& options,
                               const SizeRule& rule, const std::optional<ByteBudget>& budget = std::nullopt);

/// Returns exit_bad_input (nothing is left), exit_target_missed or exit_error_exceeded if the result must not be
/// written, otherwise exit_ok. An empty model is useless to the next program, and usually means that the faces of
/// the input have no area, or that --weld is larger than the model.
ExitCode rejection_code(const Report& report, bool strict_target);

/// Returns the error message for a rejected result. \pre `rejection` is not exit_ok
/// \param in, out  names of the input and of the file that was not written
std::string rejection_message(ExitCode rejection, const std::filesystem::path& in,
                              const std::filesystem::path& out, const Report& report);

}  // namespace faqem::cli
