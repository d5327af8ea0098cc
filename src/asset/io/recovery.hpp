#pragma once
/// \file
/// Recovery of sets of files that a dead process left half replaced.

#include <filesystem>

#include "asset/io/journal.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Completes the set that the journal of a folder describes, or restores the old one, and removes the files
/// of the mechanism. The set is completed if every file is either new already, or is still the old one and
/// its new content is complete; otherwise it is restored if every file is old or its backup is complete. A
/// file is renamed or removed only if it still has the recorded size and hash. Without a journal this does
/// nothing; an invalid journal, which a process was writing when it died, is removed. If another process
/// holds the lock of the journal, it is replacing files, and the folder is left alone.
/// \param folder  the folder; one that does not exist is ignored
/// \throws WriteError  neither is possible, since files were changed, or a file cannot be renamed. Nothing is
///                     touched in the first case. The message says what to do
/// Complexity: O(size of the files of the set).
FAQEM_EXPORT void recover_folder(const std::filesystem::path& folder);

/// The same for a journal that is locked already. Leaves an empty, locked journal.
/// \return false if files of the mechanism cannot be removed: then the journal must remain, so that the next
///         run tries again
bool recover_journal(LockedJournal& journal);

/// Checks that a file to be read does not belong to a set that a dead process left half replaced.
/// \throws ReadError  it does; the message says how to complete the set
/// Complexity: O(1) without a journal in the folder of the file, otherwise O(size of the journal).
FAQEM_EXPORT void check_completely_replaced(const std::filesystem::path& file);

}  // namespace faqem::detail
