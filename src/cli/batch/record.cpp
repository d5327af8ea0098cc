#include "cli/batch/record.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>

#include "faqem/error.hpp"
#include "cli/json.hpp"

namespace faqem::tool {

namespace {

std::string line_of(const std::string& out_name, const BatchEntry& entry) {
    // Names need not be UTF-8; one that is not would be found again under its replacement, which differs: it
    // is done anew.
    return Json{{"result", out_name},      {"inputs", entry.inputs},     {"options", entry.options},
                {"written", entry.result}, {"faces_in", entry.faces_in}, {"faces_out", entry.faces_out}}
               .dump(-1, ' ', false, Json::error_handler_t::replace) +
           "\n";
}

void read_line(const std::string& line, std::map<std::string, BatchEntry>& entries) {
    try {
        const Json json = Json::parse(line);
        BatchEntry entry;
        json.at("inputs").get_to(entry.inputs);
        json.at("options").get_to(entry.options);
        json.at("written").get_to(entry.result);
        json.at("faces_in").get_to(entry.faces_in);
        json.at("faces_out").get_to(entry.faces_out);
        entries[json.at("result").get<std::string>()] = entry;
    } catch (const Json::exception&) {
    }
}

}  // namespace

BatchRecord::BatchRecord(const std::filesystem::path& out_folder) : file_(out_folder / ".faqem-batch.jsonl") {
    const auto fail = [&](const char* what, int error) {
        if (lock_ >= 0) ::close(lock_);
        throw WriteError(file_.string() + ": " + what + std::generic_category().message(error));
    };
    lock_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (lock_ < 0) fail("cannot write: ", errno);
    if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) fail("another batch is at work in this folder: ", errno);
    std::ifstream in(file_, std::ios::binary);
    bool cut_off = false;
    for (std::string line; std::getline(in, line);) {
        read_line(line, entries_);
        cut_off = in.eof();
    }
    if (cut_off && ::write(lock_, "\n", 1) != 1) fail("cannot write: ", errno);
}

BatchRecord::~BatchRecord() { ::close(lock_); }

std::optional<BatchEntry> BatchRecord::find(const std::string& out_name) const {
    const std::lock_guard guard(mutex_);
    const auto entry = entries_.find(out_name);
    if (entry == entries_.end()) return std::nullopt;
    return entry->second;
}

void BatchRecord::add(const std::string& out_name, const BatchEntry& entry) {
    const std::lock_guard guard(mutex_);
    const std::string line = line_of(out_name, entry);
    if (::write(lock_, line.data(), line.size()) != static_cast<ssize_t>(line.size()))
        throw WriteError(file_.string() + ": cannot write: " + std::generic_category().message(errno));
    entries_[out_name] = entry;
}

}  // namespace faqem::tool
