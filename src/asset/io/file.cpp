#include "asset/io/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "asset/io/locked_file.hpp"
#include "asset/io/temporary_file.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

[[noreturn]] void fail_read(const fs::path& file, int error) {
    throw ReadError(file.string(), "", "cannot read: " + reason(error));
}

[[noreturn]] void fail_write(const fs::path& file, const char* action, int error) {
    throw WriteError(file.string() + ": cannot " + action + ": " + reason(error));
}

void write_all(const fs::path& target, int file, std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const std::size_t chunk_size = std::min(bytes.size(), std::size_t{1} << 30);
        const ssize_t written = ::write(file, bytes.data(), chunk_size);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) fail_write(target, "write", written < 0 ? errno : EIO);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

bool rename_if_absent(const char* from, const char* to) {
#ifdef RENAME_NOREPLACE
    if (::renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE) == 0) return true;
    if (errno != EINVAL && errno != ENOSYS) return false;
#endif
    // Fallback: link() fails if the target exists; after success the temporary name is no longer needed.
    return ::link(from, to) == 0 && ::unlink(from) == 0;
}

/// A file whose bytes are on the disk under a temporary name. `target` is the path with links resolved.
struct PendingFile {
    fs::path target;
    Descriptor folder;
    TemporaryFile temporary;
};

PendingFile write_temporary_file(const FileContent& content, Overwrite overwrite) {
    fs::path target = content.file;
    struct stat old = {};
    const bool exists = ::stat(target.c_str(), &old) == 0;
    if (!exists && errno != ENOENT) fail_write(target, "write", errno);
    if (exists && !S_ISREG(old.st_mode)) throw WriteError(target.string() + ": is not a regular file");
    if (exists && overwrite == Overwrite::no) fail_write(target, "write", EEXIST);
    if (exists) target = fs::canonical(target);

    const fs::path parent = target.has_parent_path() ? target.parent_path() : fs::path(".");
    Descriptor folder(::open(parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!folder) fail_write(content.file, "open its folder", errno);
    const mode_t mode = exists ? old.st_mode & 07777 : 0666;
    TemporaryFile temporary(target, mode & 0666);
    const int file = temporary.file();
    write_all(content.file, file, content.bytes);
    if (exists && ::fchmod(file, mode) != 0) fail_write(content.file, "set the permissions", errno);
    if (::fsync(file) != 0) fail_write(content.file, "write to the disk", errno);
    return {std::move(target), std::move(folder), std::move(temporary)};
}

void commit_file(PendingFile& pending, Overwrite overwrite) {
    const char* from = pending.temporary.name();
    const char* to = pending.target.c_str();
    if (pending.temporary.is_removed()) fail_write(pending.target, "write", EINTR);
    const bool renamed = overwrite == Overwrite::yes ? ::rename(from, to) == 0 : rename_if_absent(from, to);
    if (!renamed) fail_write(pending.target, "write", errno);
    pending.temporary.release();
    // Some file systems cannot sync a folder and return EINVAL.
    if (::fsync(pending.folder.get()) != 0 && errno != EINVAL)
        fail_write(pending.target, "sync its folder", errno);
}

WriteCheck write_check = nullptr;

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/// Decodes percent escapes. A percent sign that is not followed by two hexadecimal digits is kept.
std::string percent_decoded(std::string_view text) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const int high = text[i] == '%' && i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
        const int low = high >= 0 ? hex_digit(text[i + 2]) : -1;
        decoded.push_back(low >= 0 ? static_cast<char>(high * 16 + low) : text[i]);
        if (low >= 0) i += 2;
    }
    return decoded;
}

/// The name in a reference, with slashes as separators.
std::string name_in(std::string_view reference, ReferenceSyntax kind) {
    if (kind == ReferenceSyntax::uri) return percent_decoded(reference);
    std::string name(reference);
    std::replace(name.begin(), name.end(), '\\', '/');
    return name;
}

bool has_scheme(std::string_view text) {
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    if (text.empty() || !is_letter(text[0])) return false;
    const auto end = std::find_if(text.begin(), text.end(), [&](char c) {
        return !is_letter(c) && !(c >= '0' && c <= '9') && c != '+' && c != '-' && c != '.';
    });
    return end != text.end() && *end == ':';
}

bool escapes_folder(const fs::path& relative) {
    std::ptrdiff_t depth = 0;
    for (const fs::path& step : relative) {
        if (step == "..")
            --depth;
        else if (!step.empty() && step != ".")
            ++depth;
        if (depth < 0) return true;
    }
    return false;
}

}  // namespace

std::vector<std::uint8_t> read_file(const fs::path& file, std::uint64_t max_bytes) {
    const Descriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!in) fail_read(file, errno);
    struct stat status = {};
    if (::fstat(in.get(), &status) != 0) fail_read(file, errno);
    if (!S_ISREG(status.st_mode)) throw ReadError(file.string(), "", "is not a regular file");
    const auto size = static_cast<std::uint64_t>(status.st_size);
    if (size > max_bytes)
        throw ReadError(
            file.string(), "",
            "has " + std::to_string(size) + " bytes; the limit is " + std::to_string(max_bytes) + " bytes");
    std::vector<std::uint8_t> bytes(size);
    for (std::uint64_t done = 0; done < size;) {
        const ssize_t got =
            ::read(in.get(), bytes.data() + done, std::min<std::uint64_t>(size - done, 1u << 30));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail_read(file, errno);
        if (got == 0) throw ReadError(file.string(), "", "was truncated while it was being read");
        done += static_cast<std::uint64_t>(got);
    }
    return bytes;
}

void set_write_check(WriteCheck check) { write_check = check; }

void write_files(std::span<const FileContent> files, Overwrite overwrite) {
    if (write_check) {
        std::vector<fs::path> paths;
        for (const FileContent& content : files) paths.push_back(content.file);
        write_check(paths);
    }
    std::vector<PendingFile> pending;
    pending.reserve(files.size());
    try {
        for (const FileContent& content : files) pending.push_back(write_temporary_file(content, overwrite));
        for (PendingFile& file : pending) commit_file(file, overwrite);
    } catch (const fs::filesystem_error& error) {
        throw WriteError(error.path1().string() + ": cannot write: " + error.code().message());
    }
}

void write_file(const fs::path& file, std::span<const std::uint8_t> bytes, Overwrite overwrite) {
    const FileContent content{file, bytes};
    write_files({&content, 1}, overwrite);
}

fs::path resolve_inside(const fs::path& folder, std::string_view reference, ReferenceSyntax kind) {
    const auto refuse = [&](const char* why) {
        throw InputError(folder.string(), "reference '" + std::string(reference) + "'", why);
    };
    const std::string name = name_in(reference, kind);
    if (name.empty()) refuse("is empty");
    if (name.find('\0') != std::string::npos) refuse("contains a zero byte");
    if (has_scheme(name)) refuse("is not a relative path");
    const fs::path relative(name);
    if (relative.is_absolute()) refuse("is an absolute path");
    if (escapes_folder(relative)) refuse("is outside the folder of the file");
    try {
        const fs::path root = fs::canonical(folder.empty() ? fs::path(".") : folder);
        fs::path found = fs::canonical(root / relative);
        if (std::mismatch(root.begin(), root.end(), found.begin(), found.end()).first != root.end())
            refuse("is outside the folder of the file");
        if (!fs::is_regular_file(found)) refuse("is not a regular file");
        return found;
    } catch (const fs::filesystem_error& error) {
        throw ReadError(folder.string(), "reference '" + std::string(reference) + "'",
                        "cannot read: " + error.code().message());
    }
}

fs::path referenced_path(const fs::path& folder, std::string_view reference, ReferenceSyntax kind) {
    constexpr std::string_view scheme = "file://";  // followed by an empty host and an absolute path
    if (kind == ReferenceSyntax::uri && reference.starts_with(scheme)) reference.remove_prefix(scheme.size());
    return folder / name_in(reference, kind);
}

}  // namespace faqem::detail
