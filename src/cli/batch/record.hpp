#pragma once
/// \file
/// What a batch has done, kept in the folder of its results.

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace faqem::cli {

/// One result.
struct BatchEntry {
    std::string inputs;   ///< modification_stamp() the model and the files it refers to
    std::string options;  ///< what the result depends on besides
    std::string result;   ///< modification_stamp() the result; empty: it was begun and not finished
    std::uint64_t faces_in = 0, faces_out = 0;
};

/// The file `.faqem-batch.jsonl`: a line for every result begun and for every one finished; the last one
/// counts. Lines are written one by one, so that whatever ends the process, all before are there. Another
/// process that works in the same folder is kept out. Several threads may use it.
class BatchRecord {
public:
    /// Reads what is there. A line that is cut off or damaged is passed over.
    /// \throws WriteError  it cannot be written, or another process is using it
    explicit BatchRecord(const std::filesystem::path& out_folder);
    ~BatchRecord();
    BatchRecord(const BatchRecord&) = delete;
    BatchRecord& operator=(const BatchRecord&) = delete;

    /// The last entry for a result.
    std::optional<BatchEntry> find(const std::string& out_name) const;

    /// \throws WriteError
    void add(const std::string& out_name, const BatchEntry& entry);

private:
    std::filesystem::path file_;
    int descriptor_ = -1;
    mutable std::mutex mutex_;
    std::map<std::string, BatchEntry> entries_;
};

}  // namespace faqem::cli
