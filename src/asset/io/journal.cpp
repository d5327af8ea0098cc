#include "asset/io/journal.hpp"

#include <fcntl.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <set>
#include <system_error>
#include <utility>

#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view journal_title = "faqem-journal 1\n", journal_end = "end ";
constexpr std::size_t max_journal_size = std::size_t{1} << 24;
constexpr std::size_t id_digits = 24;
constexpr std::string_view hex_digits = "0123456789abcdef";

std::span<const std::uint8_t> as_bytes(std::string_view text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::string hash_text(std::uint64_t hash) {
    std::array<char, 17> text = {};
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash));
    return text.data();
}

std::string closing_line(std::string_view lines) {
    ContentHash hash;
    hash.add(as_bytes(lines));
    return std::string(journal_end) + hash_text(hash.value()) + "\n";
}

/// All bytes but letters, digits, `-`, `.` and `_` as two hexadecimal digits after a percent sign: names may
/// contain blanks and line ends.
std::string escaped_name(std::string_view name) {
    std::string text;
    for (const char c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                           c == '-' || c == '.' || c == '_';
        const auto byte = static_cast<unsigned char>(c);
        if (plain)
            text += c;
        else
            text += {'%', hex_digits[byte / 16], hex_digits[byte % 16]};
    }
    return text;
}

/// Returns nothing if a percent sign is not followed by two digits.
std::optional<std::string> unescaped_name(std::string_view text) {
    std::string name;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            name += text[i];
            continue;
        }
        if (i + 2 >= text.size()) return std::nullopt;
        const std::size_t high = hex_digits.find(text[i + 1]), low = hex_digits.find(text[i + 2]);
        if (high == std::string_view::npos || low == std::string_view::npos) return std::nullopt;
        name += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return name;
}

/// A name that a model, report or history may have: neither a path nor a file of this mechanism.
bool is_valid_target(const std::string& name) {
    return !name.empty() && name != "." && name != ".." && name.size() <= 255 &&
           !name.starts_with(".faqem-") && name.find('/') == std::string::npos &&
           name.find('\0') == std::string::npos;
}

std::string_view cut_word(std::string_view& line) {
    const std::size_t end = std::min(line.find(' '), line.size());
    const std::string_view word = line.substr(0, end);
    line.remove_prefix(std::min(end + 1, line.size()));
    return word;
}

bool parse_number(std::string_view text, int base, std::uint64_t& value) {
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
    return error == std::errc{} && stop == text.data() + text.size() && !text.empty();
}

std::optional<ContentStamp> parse_stamp(std::string_view size, std::string_view hash) {
    ContentStamp stamp;
    if (!parse_number(size, 10, stamp.size) || !parse_number(hash, 16, stamp.hash)) return std::nullopt;
    return stamp;
}

std::optional<JournalEntry> parse_entry(std::string_view line) {
    JournalEntry entry;
    entry.id = cut_word(line);
    if (entry.id.size() != id_digits || entry.id.find_first_not_of(hex_digits) != std::string::npos)
        return std::nullopt;
    const std::string_view new_size = cut_word(line), new_hash = cut_word(line);
    const std::string_view old_size = cut_word(line), old_hash = cut_word(line);
    const std::optional<ContentStamp> new_content = parse_stamp(new_size, new_hash);
    if (!new_content) return std::nullopt;
    entry.new_content = *new_content;
    if (old_size != "-") {
        entry.old_content = parse_stamp(old_size, old_hash);
        if (!entry.old_content) return std::nullopt;
    }
    const std::optional<std::string> name = unescaped_name(line);
    if (!name || !is_valid_target(*name)) return std::nullopt;
    entry.name = *name;
    return entry;
}

}  // namespace

std::optional<ContentStamp> stamp_of(int file, std::uint64_t size) {
    ContentHash hash;
    std::vector<std::uint8_t> buffer(std::size_t{1} << 16);
    for (std::uint64_t done = 0; done < size;) {
        const ssize_t got = ::pread(file, buffer.data(), buffer.size(), static_cast<off_t>(done));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return std::nullopt;
        hash.add(std::span(buffer).first(static_cast<std::size_t>(got)));
        done += static_cast<std::uint64_t>(got);
    }
    return ContentStamp{size, hash.value()};
}

std::string journal_text(std::span<const JournalEntry> entries) {
    std::string text(journal_title);
    for (const JournalEntry& entry : entries) {
        const ContentStamp& content = entry.new_content;
        text += entry.id + " " + std::to_string(content.size) + " " + hash_text(content.hash);
        if (entry.old_content)
            text += " " + std::to_string(entry.old_content->size) + " " + hash_text(entry.old_content->hash);
        else
            text += " - -";
        text.append(" ").append(escaped_name(entry.name)).append("\n");  // g++ 12 warns falsely about " " +
    }
    return text + closing_line(text);
}

std::optional<std::vector<JournalEntry>> parse_journal(std::string_view text) {
    if (!text.starts_with(journal_title) || !text.ends_with('\n')) return std::nullopt;
    const std::size_t end = text.rfind('\n', text.size() - 2) + 1;  // of the lines before the last one
    if (text.substr(end) != closing_line(text.substr(0, end))) return std::nullopt;
    std::vector<JournalEntry> entries;
    std::set<std::string> ids, names;
    for (std::size_t start = journal_title.size(); start < end;) {
        const std::size_t stop = text.find('\n', start);
        std::optional<JournalEntry> entry = parse_entry(text.substr(start, stop - start));
        if (!entry || !ids.insert(entry->id).second || !names.insert(entry->name).second) return std::nullopt;
        entries.push_back(std::move(*entry));
        start = stop + 1;
    }
    if (entries.empty()) return std::nullopt;
    return entries;
}

std::optional<std::vector<JournalEntry>> read_journal(int file, int& error) {
    error = 0;
    struct stat status = {};
    if (::fstat(file, &status) != 0) {
        error = errno;
        return std::nullopt;
    }
    if (!S_ISREG(status.st_mode)) return std::nullopt;
    const auto size = static_cast<std::uint64_t>(status.st_size);
    if (size == 0 || size > max_journal_size) return std::nullopt;
    std::string text(size, '\0');
    for (std::size_t done = 0; done < size;) {
        const ssize_t got = ::pread(file, text.data() + done, size - done, static_cast<off_t>(done));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) error = errno;
        if (got <= 0) return std::nullopt;
        done += static_cast<std::size_t>(got);
    }
    return parse_journal(text);
}

std::optional<LockedJournal> open_journal(const fs::path& folder, MissingJournal missing, Lock& lock) {
    LockedJournal journal;
    journal.folder = folder;
    lock = Lock::acquired;
    const auto fail = [&](const std::string& what) { throw WriteError(journal.path() + ": " + what); };
    const auto reason_of = [](int error) { return std::generic_category().message(error); };
    journal.folder_file = Descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!journal.folder_file)
        throw WriteError(folder.string() + ": cannot open the folder: " + reason_of(errno));
    for (;;) {
        constexpr int flags = O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
        const std::string path = journal.path();
        journal.file = Descriptor(::open(path.c_str(), flags));
        const bool exists = static_cast<bool>(journal.file) || errno != ENOENT;
        if (!exists && missing == MissingJournal::ignore) return std::nullopt;
        if (!exists) journal.file = Descriptor(::open(path.c_str(), flags | O_CREAT | O_EXCL, 0666));
        if (!journal.file && errno == EEXIST) continue;  // created by another process in the meantime
        if (!journal.file && errno == ELOOP) fail("is not a regular file; remove it");
        if (!journal.file) fail("cannot open: " + reason_of(errno));
        struct stat status = {};
        if (::fstat(journal.file.get(), &status) != 0 || !S_ISREG(status.st_mode))
            fail("is not a regular file; remove it");
        lock = try_lock(journal.file.get());
        if (lock == Lock::held) return std::nullopt;
        if (lock == Lock::unsupported && exists)
            fail("cannot be locked; remove it if no other run writes to this folder");
        if (is_same_file(journal.file.get(), path.c_str())) return journal;
    }
}

void clear_journal(const LockedJournal& journal) {
    while (::ftruncate(journal.file.get(), 0) != 0) {
        const int error = errno;
        if (error == EINTR) continue;
        if (::unlinkat(journal.folder_file.get(), journal_name, 0) == 0) return;
        throw WriteError(journal.path() + ": cannot be removed: " + std::generic_category().message(error));
    }
}

void remove_journal(const LockedJournal& journal) noexcept {
    ::unlinkat(journal.folder_file.get(), journal_name, 0);
}

bool is_backup_name(std::string_view name) {
    constexpr std::string_view prefix = ".faqem-", extension = ".old";
    return name.size() == prefix.size() + id_digits + extension.size() && name.starts_with(prefix) &&
           name.ends_with(extension) &&
           name.substr(prefix.size(), id_digits).find_first_not_of(hex_digits) == std::string_view::npos;
}

}  // namespace faqem::detail
