#pragma once
/// \file
/// The journal of a set of files that is being replaced: plain data, its text, and its lock.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asset/io/locked_file.hpp"

namespace faqem::detail {

/// Hash of the content of a file (FNV-1a, 64 bits). It detects files that were changed by other programs or
/// damaged by a loss of power. It does not detect intent: anyone can construct a file with a given hash.
class ContentHash {
public:
    void add(std::span<const std::uint8_t> bytes) {
        for (const std::uint8_t byte : bytes) value_ = (value_ ^ byte) * 0x100000001b3u;
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

/// Size and hash of a file.
struct ContentStamp {
    std::uint64_t size = 0, hash = 0;
    bool operator==(const ContentStamp&) const = default;
};

/// Returns the stamp of an opened regular file, nothing if it cannot be read. \param size  as of fstat()
std::optional<ContentStamp> stamp_of(int file, std::uint64_t size);

/// One file of a set. `.faqem-ID.tmp` has the new content until it is renamed to `name`; `.faqem-ID.old` is
/// the old file until the set is complete.
struct JournalEntry {
    std::string id;                           ///< 24 hexadecimal digits
    std::string name;                         ///< final name of the file, in the folder of the journal
    ContentStamp new_content;                 ///< of the new file
    std::optional<ContentStamp> old_content;  ///< of the file that it replaces; nothing if there is none

    std::string temporary_name() const { return ".faqem-" + id + ".tmp"; }
    std::string backup_name() const { return ".faqem-" + id + ".old"; }
    bool operator==(const JournalEntry&) const = default;
};

/// Name of the journal in the folder of the files.
inline constexpr const char* journal_name = ".faqem-journal";

/// Returns the text of a journal: a line for each file, and a hash of all lines.
std::string journal_text(std::span<const JournalEntry> entries);

/// Parses a journal. Returns nothing if the text is incomplete, damaged, of another version, or names
/// anything but plain files: names with slashes, names of temporary files, and names that occur twice are
/// invalid.
std::optional<std::vector<JournalEntry>> parse_journal(std::string_view text);

/// Reads and parses an opened journal. Returns nothing if it is invalid, no regular file, or larger than
/// 16 MiB.
/// \param error  receives 0, or errno if the journal cannot be read: it may be valid then
std::optional<std::vector<JournalEntry>> read_journal(int file, int& error);

/// An opened, locked journal with its folder.
struct LockedJournal {
    std::filesystem::path folder;
    Descriptor folder_file, file;

    std::string path() const { return (folder / journal_name).string(); }
};

/// How open_journal() treats a missing journal.
enum class MissingJournal { create, ignore };

/// Opens and locks the journal of a folder without waiting. The file is not followed if it is a link.
/// \param lock  receives Lock::held if another process is replacing files in the folder
/// \return nothing if `lock` is Lock::held, or there is no journal and `missing` is MissingJournal::ignore
/// \throws WriteError  the journal is not a regular file, or cannot be opened or locked
std::optional<LockedJournal> open_journal(const std::filesystem::path& folder, MissingJournal missing,
                                          Lock& lock);

/// Makes a journal invalid: the set is complete or restored. \throws WriteError  this fails
void clear_journal(const LockedJournal& journal);

/// Removes a cleared journal. If this fails, the empty file is harmless.
void remove_journal(const LockedJournal& journal) noexcept;

/// Whether a file name is that of a backup.
bool is_backup_name(std::string_view name);

}  // namespace faqem::detail
