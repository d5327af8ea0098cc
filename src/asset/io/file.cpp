#include "asset/io/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <charconv>

#include "asset/io/descriptor.hpp"
#include "asset/io/set_folder.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_read(const fs::path& file, int error) {
    throw ReadError(file.string(), "", "cannot read: " + std::generic_category().message(error));
}

/// The name in a reference, with slashes as separators.
std::string name_in(std::string_view reference, ReferenceSyntax kind) {
    if (kind == ReferenceSyntax::uri) return percent_decoded(reference);
    std::string name(reference);
    std::ranges::replace(name, '\\', '/');
    return name;
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool has_scheme(std::string_view text) {
    if (text.empty() || !is_letter(text[0])) return false;
    const auto end = std::ranges::find_if(
        text, [&](char c) { return !is_letter(c) && !is_digit(c) && c != '+' && c != '-' && c != '.'; });
    return end != text.end() && *end == ':';
}

}  // namespace

std::vector<std::uint8_t> read_file(const fs::path& file, std::uint64_t max_bytes) {
    check_completely_replaced(file);
#ifdef _WIN32
    const Descriptor in(::_wopen(file.c_str(), _O_RDONLY | _O_BINARY | _O_NOINHERIT));
#else
    const Descriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
#endif
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

std::vector<std::string> file_names(const fs::path& folder, std::error_code& error) {
    std::vector<std::string> names;
    fs::directory_iterator entry(folder.empty() ? "." : folder, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error))
        names.push_back(entry->path().filename().string());
    return names;
}

std::string percent_decoded(std::string_view text) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char* const digits = text.data() + i + 1;
        std::uint8_t byte = 0;
        const bool is_escape = text[i] == '%' && i + 2 < text.size() &&
                               std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2;
        decoded.push_back(is_escape ? static_cast<char>(byte) : text[i]);
        if (is_escape) i += 2;
    }
    return decoded;
}

std::string percent_encoded(std::string_view text, std::string_view plain) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string encoded;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (is_letter(c) || is_digit(c) || plain.find(c) != std::string_view::npos)
            encoded += c;
        else
            encoded += {'%', digits[byte / 16], digits[byte % 16]};
    }
    return encoded;
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
    if (*relative.lexically_normal().begin() == "..") refuse("is outside the folder of the file");
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
