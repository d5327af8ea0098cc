#pragma once
/// \file
/// The record of a batch in its output directory, used by `--resume`.

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace faqem::cli {

/// The record of one result.
struct BatchEntry {
    std::string inputs;   ///< modification_stamp() of the model and the files it refers to
    std::string options;  ///< BatchContext::options_key
    std::string result;   ///< modification_stamp() of the result; empty if it was begun and not finished
    std::uint64_t faces_in = 0, faces_out = 0;
};

/// The file `.faqem-batch.jsonl`: one line for every result that was begun and one for every result that was
/// finished; the last line of a result is valid. Each line is written immediately, so that a killed process
/// loses no earlier lines. The file is locked against other processes. find() and add() are thread-safe.
class BatchRecord {
public:
    /// Returns the path of the record in an output directory.
    static std::filesystem::path path_in(const std::filesystem::path& out_folder) {
        return out_folder / ".faqem-batch.jsonl";
    }

    /// Opens and locks the file and reads its entries. Truncated and damaged lines are ignored.
    /// \throws WriteError  the file cannot be opened for writing, or another process has locked it
    explicit BatchRecord(const std::filesystem::path& out_folder);
    ~BatchRecord();
    BatchRecord(const BatchRecord&) = delete;
    BatchRecord& operator=(const BatchRecord&) = delete;

    /// Returns the last entry of a result.
    std::optional<BatchEntry> find(const std::string& out_name) const;

    /// Appends an entry. \throws WriteError  the file cannot be written
    void add(const std::string& out_name, const BatchEntry& entry);

private:
    std::filesystem::path file_;
    int descriptor_ = -1;
    mutable std::mutex mutex_;
    std::map<std::string, BatchEntry> entries_;
};

}  // namespace faqem::cli
