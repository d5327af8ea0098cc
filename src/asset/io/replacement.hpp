#pragma once
/// \file
/// Renaming of the temporary files of a set to their final names, all or none.

#include <filesystem>
#include <span>

#include "asset/io/journal.hpp"
#include "asset/io/temporary_file.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// A file whose bytes are on the disk under a temporary name.
struct PendingFile {
    std::filesystem::path folder, name;  ///< of the file that is written, links resolved
    TemporaryFile temporary;             ///< in the same folder
    ContentStamp content;                ///< of the new file
    Overwrite overwrite;

    std::filesystem::path target() const { return folder / name; }
};

/// Renames the files of a set in the given order while signals are held: see FileSet::commit(). Steps:
///
/// 1. The journals of all folders are locked; other processes that write sets there wait.
/// 2. The old files get a second name (a copy if the file system has no links).
/// 3. The journals are written and synced.
/// 4. The files are renamed, and the folders synced. On an error, the old files are renamed back.
/// 5. The journals are emptied: the set is complete. The second names and the journals are removed.
///
/// \param completed  called after step 5, while signals are held; may be null
/// \throws WriteError  no file is replaced, or the message says that the next run restores the files
void replace_files(std::span<PendingFile> files, void (*completed)() noexcept);

}  // namespace faqem::detail
