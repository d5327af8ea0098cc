#pragma once
/// \file
/// Renaming of the temporary files of a set to their final names, all or none.

#include <filesystem>
#include <span>

#include "asset/io/temporary_file.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// A file whose bytes are on the disk under a temporary name.
struct PendingFile {
    std::filesystem::path folder, name;  ///< of the file that is written, links resolved
    TemporaryFile temporary;             ///< in the same folder
    Overwrite overwrite;

    std::filesystem::path target() const { return folder / name; }
};

/// Renames the files of a set in the given order while signals are held: see FileSet::commit(). Steps:
///
/// 1. The set folders of all folders are locked; other processes that write sets there wait.
/// 2. The old files get a second name there (a copy if the file system has no links), and the new files move there.
/// 3. When all of them are on the disk, the set is complete: from now on, a run that finds the folder without its lock
///    goes on with step 4.
/// 4. The files are renamed to their places, and the folders synced. On an error, the files are renamed back.
/// 5. The set folders are removed.
///
/// \param completed  called after step 4, while signals are held; may be null
/// \throws WriteError  no file is replaced, or the message says that the next run completes the set
void replace_files(std::span<PendingFile> files, void (*completed)() noexcept);

}  // namespace faqem::detail
