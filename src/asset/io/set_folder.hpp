#pragma once
/// \file
/// The hidden folder by which a set of files is replaced all or nothing, even if the process is killed.

#include <filesystem>
#include <optional>

#include "asset/io/descriptor.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Name of the folder beside the files of a set while they are replaced. It has
/// - `lock`: a file that is locked by the process that replaces the files;
/// - `old`: under their names, the files that are replaced, as links or copies; for a new file an empty folder;
/// - `staged`: under their names, the new files, while they are collected;
/// - `new`: the same folder, renamed when all of them are on the disk. From there they are renamed to their places.
///
/// While a file is in `new`, the set is half replaced. Whoever gets the lock then moves the others to their places, too.
inline constexpr const char* set_folder_name = ".faqem-set";

/// An opened, locked `.faqem-set`. The lock ends with the object.
struct SetFolder {
    std::filesystem::path folder;  ///< of the files
    Descriptor folder_file, set_file, lock_file;

    std::filesystem::path path() const { return folder / set_folder_name; }
};

/// How lock_set_folder() treats a missing folder.
enum class MissingSet { create, ignore };

/// Opens and locks the set folder of a folder without waiting. It is not followed if it is a link.
/// \param lock  receives Lock::held if another process is replacing files in the folder
/// \return nothing if `lock` is Lock::held, or there is no set folder and `missing` is MissingSet::ignore
/// \throws WriteError  it is not a folder, or cannot be created, opened or locked
std::optional<SetFolder> lock_set_folder(const std::filesystem::path& folder, MissingSet missing, Lock& lock);

/// Opens a folder in a folder, or returns nothing and sets errno. Links are not followed.
Descriptor open_subfolder(int folder, const char* name);

/// Syncs a folder, unless its file system cannot. Returns false and sets errno on failure.
bool sync_folder(int folder);

/// Completes the set that a dead process has left half replaced, and removes everything but the lock.
/// \throws WriteError  as recover_folder()
void recover_set(const SetFolder& set);

/// Removes a set folder, which must have nothing in `new`. What cannot be removed is harmless: the next run does.
void remove_set(const SetFolder& set) noexcept;

/// Completes the set that a dead process has left half replaced in a folder, or removes one whose files were not
/// complete yet. A file is replaced only if it still has the size and time of the old file, and is not younger than the
/// new one, and a file that was new only if there is none. If another process is replacing files, the folder is left
/// alone.
/// \param folder  one that does not exist is ignored
/// \throws WriteError  a file was changed since, and none is touched; or a file cannot be renamed. The message says
///     what to do
/// Complexity: O(files of the set).
FAQEM_EXPORT void recover_folder(const std::filesystem::path& folder);

/// Checks that a file to be read does not belong to a set that a dead process left half replaced.
/// \throws ReadError  it does; the message says how to complete the set
/// Complexity: O(1).
FAQEM_EXPORT void check_completely_replaced(const std::filesystem::path& file);

}  // namespace faqem::detail
