#include "cli/batch/record.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>

#include "cli/process/json.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

namespace {

std::string line_of_record(const std::string& out_name, const BatchEntry& entry) {
    // Names need not be UTF-8. Invalid bytes are replaced, so that such a name is not found on reading and
    // the model is processed again.
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

BatchRecord::BatchRecord(const std::filesystem::path& out_folder) : file_(path_in(out_folder)) {
    const auto fail = [&](const char* what, int error) {
        if (descriptor_ >= 0) ::close(descriptor_);
        throw WriteError(file_.string() + ": " + what + std::generic_category().message(error));
    };
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail("cannot write: ", errno);
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) fail("another batch is using this directory: ", errno);
    std::ifstream in(file_, std::ios::binary);
    bool is_last_line_incomplete = false;
    for (std::string line; std::getline(in, line);) {
        read_line(line, entries_);
        is_last_line_incomplete = in.eof();
    }
    if (is_last_line_incomplete && ::write(descriptor_, "\n", 1) != 1) fail("cannot write: ", errno);
}

BatchRecord::~BatchRecord() { ::close(descriptor_); }

std::optional<BatchEntry> BatchRecord::find(const std::string& out_name) const {
    const std::lock_guard guard(mutex_);
    const auto entry = entries_.find(out_name);
    if (entry == entries_.end()) return std::nullopt;
    return entry->second;
}

void BatchRecord::add(const std::string& out_name, const BatchEntry& entry) {
    const std::lock_guard guard(mutex_);
    const std::string line = line_of_record(out_name, entry);
    if (::write(descriptor_, line.data(), line.size()) != static_cast<ssize_t>(line.size()))
        throw WriteError(file_.string() + ": cannot write: " + std::generic_category().message(errno));
    entries_[out_name] = entry;
}

}  // namespace faqem::cli
