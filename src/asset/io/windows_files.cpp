/// \file
/// Replacing files on Windows, which deletes temporary files when their process ends; file names in UTF-8.

#include <algorithm>
#include <codecvt>
#include <cstring>
#include <mutex>
#include <string>
#include <system_error>

#include "asset/io/file.hpp"
#include "asset/io/file_set.hpp"
#include "asset/io/set_folder.hpp"
#include "faqem/detail/base/peak_memory.hpp"  // <windows.h>
#include "faqem/error.hpp"

/// Takes the place of std::codecvt<wchar_t, char, std::mbstate_t>::do_in(), by an option of the linker: a path is made of
/// text by it, in the encoding of a C library that does not know UTF-8. The text of a path is UTF-8 in any case.
extern "C" std::codecvt_base::result __wrap__ZNKSt7codecvtIwciE5do_inERiPKcS3_RS3_PwS5_RS5_(
    const void*, std::mbstate_t& state, const char* from, const char* end, const char*& from_next,
    wchar_t* to, wchar_t* to_end, wchar_t*& to_next) {
    return std::codecvt_utf8_utf16<wchar_t>().in(state, from, end, from_next, to, to_end, to_next);
}

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

/// Locked while files get their names, and from then on that the process ends.
std::mutex replacing;

[[noreturn]] void fail(const fs::path& file, const std::string& action, DWORD error = GetLastError()) {
    const std::error_code code(static_cast<int>(error), std::system_category());
    throw WriteError(file.string() + ": cannot " + action + ": " + code.default_error_condition().message());
}

/// Sets whether a file is deleted when it is closed.
bool set_temporary(HANDLE file, bool temporary) {
    FILE_DISPOSITION_INFO info = {temporary};
    return SetFileInformationByHandle(file, FileDispositionInfo, &info, sizeof info);
}

bool set_name(HANDLE file, const fs::path& target, bool replaces) {
    const std::size_t bytes = target.native().size() * sizeof(wchar_t);
    std::vector<std::uint64_t> buffer((sizeof(FILE_RENAME_INFO) + bytes) / sizeof(std::uint64_t) + 1);
    auto* const info = reinterpret_cast<FILE_RENAME_INFO*>(buffer.data());
    info->ReplaceIfExists = replaces;
    info->FileNameLength = static_cast<DWORD>(bytes);
    std::memcpy(info->FileName, target.c_str(), bytes);
    return SetFileInformationByHandle(file, FileRenameInfo, info,
                                      static_cast<DWORD>(buffer.size() * sizeof(std::uint64_t)));
}

}  // namespace

std::optional<FileId> file_id(const fs::path& file) {
    constexpr DWORD shared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
    HANDLE const opened = CreateFileW(file.c_str(), 0, shared, nullptr, OPEN_EXISTING, 0, nullptr);
    if (opened == INVALID_HANDLE_VALUE) return std::nullopt;
    BY_HANDLE_FILE_INFORMATION info = {};
    GetFileInformationByHandle(opened, &info);
    CloseHandle(opened);
    return FileId(info.dwVolumeSerialNumber, std::uint64_t{info.nFileIndexHigh} << 32 | info.nFileIndexLow);
}

PendingFile write_temporary_file(const FileContent& content, Overwrite overwrite) {
    fs::path target = content.file;
    const bool exists = fs::exists(target);
    if (exists && !fs::is_regular_file(target)) throw WriteError(target.string() + ": is not a regular file");
    if (exists && overwrite == Overwrite::no) fail(target, "write without overwriting", ERROR_FILE_EXISTS);
    if (exists) target = fs::canonical(target);
    const fs::path folder = fs::canonical(parent_of(target));
    HANDLE const created = CreateFileW((folder / temporary_name()).c_str(), GENERIC_WRITE | DELETE, 0,
                                       nullptr, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr);
    if (created == INVALID_HANDLE_VALUE) fail(content.file, "create a temporary file in its folder");
    const TemporaryFile temporary(created, CloseHandle);
    if (!set_temporary(created, true)) fail(content.file, "create a temporary file in its folder");
    for (std::span<const std::uint8_t> rest = content.bytes; !rest.empty();) {
        DWORD written = 0;
        const auto count = static_cast<DWORD>(std::min(rest.size(), std::size_t{1} << 30));
        if (!WriteFile(created, rest.data(), count, &written, nullptr)) fail(content.file, "write");
        rest = rest.subspan(written);
    }
    if (!FlushFileBuffers(created)) fail(content.file, "write to the disk");
    return {folder, target.filename(), temporary, overwrite};
}

void replace_files(std::span<PendingFile> files, void (*completed)() noexcept) {
    const std::lock_guard guard(replacing);
    for (const PendingFile& file : files) {
        HANDLE const temporary = file.temporary.get();
        if (set_temporary(temporary, false) &&
            set_name(temporary, file.target(), file.overwrite == Overwrite::yes))
            continue;
        const DWORD error = GetLastError();
        set_temporary(temporary, true);
        fail(file.target(), "write", error);
    }
    if (completed) completed();
}

bool remove_temporary_files() noexcept { return replacing.try_lock(); }

// Windows deletes temporary files, and each file of a set is replaced by itself.
void remove_leftovers(const fs::path&) noexcept {}
void recover_folder(const fs::path&) {}
void check_completely_replaced(const fs::path&) {}

}  // namespace faqem::detail
