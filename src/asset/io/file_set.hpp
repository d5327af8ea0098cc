#pragma once
/// \file
/// Writing of files that belong together: all are replaced, or none.

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "asset/io/temporary_file.hpp"
#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Checks whether files may be written together. Called with the paths as given; throws an exception if not.
using WriteCheck = void (*)(std::span<const std::filesystem::path> files);

/// Sets a check that FileSet::add() calls before it writes the first file, on the calling thread. Initially
/// there is none. Not thread-safe: intended for the start of a program.
FAQEM_EXPORT void set_write_check(WriteCheck check);

/// A file to be written. The bytes are borrowed.
struct FileContent {
    std::filesystem::path file;
    std::span<const std::uint8_t> bytes;
};

/// A file whose bytes are on the disk under a temporary name.
struct PendingFile {
    std::filesystem::path folder, name;  ///< of the file that is written, links resolved
    TemporaryFile temporary;             ///< in the same folder
    Overwrite overwrite;

    std::filesystem::path target() const { return folder / name; }
};

/// Writes a file under a temporary name in its folder and syncs it; see FileSet::add().
PendingFile write_temporary_file(const FileContent& content, Overwrite overwrite);

/// Gives files their names; see FileSet::commit().
void replace_files(std::span<PendingFile> files, void (*completed)() noexcept);

/// A set of files that is replaced all or nothing.
///
/// add() writes temporary files. commit() renames them while signals are held. If an error occurs in between,
/// the old files are restored. In each folder the new files are collected in a hidden folder before the first one is
/// renamed (set_folder_name), so that after the end of the process or a loss of power the next run that writes to the
/// folder completes the set (recover_folder()). A single file needs none: it is renamed atomically.
///
/// Files of different folders are replaced together unless the process is killed or the power lost: then the
/// files of one folder may be the new ones, and those of another the old ones.
///
/// Windows: each file is replaced by itself. After an error, or the end of the process, some of them are the new ones.
class FAQEM_EXPORT FileSet {
public:
    FileSet() = default;
    FileSet(const FileSet&) = delete;
    FileSet& operator=(const FileSet&) = delete;

    /// Writes files under temporary names and syncs them. A new file gets the mode 0666 minus the umask; a
    /// replaced file keeps its mode. Symbolic links are followed. First completes or removes what an
    /// interrupted run left in the folders of the files.
    /// \param files      paths and contents, borrowed
    /// \param overwrite  Overwrite::no: an existing file is an error, also if it is created before commit()
    /// \throws WriteError  with the path and the reason; the temporary files of the call are removed
    /// \throws whatever the write check throws; nothing is written then
    void add(std::span<const FileContent> files, Overwrite overwrite);

    /// Gives the files their names, in the order in which they were added: a file that refers to others
    /// should be added after them. The set is empty afterwards.
    /// \param completed  called after the last file was renamed, while signals are still held; may be null
    /// \throws WriteError  no file is replaced. In the rare case that restoring fails, too, the message says
    ///                     so, and the next run that writes to the folder completes the set
    void commit(void (*completed)() noexcept = nullptr);

private:
    std::vector<PendingFile> files_;
};

/// While an object of this class exists, write_file() and write_files() of the same thread add their files to
/// a set, instead of replacing files. Not nested.
class FAQEM_EXPORT CollectWrites {
public:
    explicit CollectWrites(FileSet& set);
    ~CollectWrites();
    CollectWrites(const CollectWrites&) = delete;
    CollectWrites& operator=(const CollectWrites&) = delete;
};

/// Writes a set of one file: see FileSet.
FAQEM_EXPORT void write_file(const std::filesystem::path& file, std::span<const std::uint8_t> bytes,
                             Overwrite overwrite);

/// Writes a set of files, or adds them to that of CollectWrites: see FileSet.
void write_files(std::span<const FileContent> files, Overwrite overwrite);

}  // namespace faqem::detail
