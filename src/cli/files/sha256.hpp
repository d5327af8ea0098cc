#pragma once
/// \file
/// SHA-256 (FIPS 180-4), which identifies models in lists and records.

#include <sha2.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace faqem::cli {

class Sha256 {
public:
    Sha256() { SHA256Init(&context_); }

    void add(std::string_view bytes);
    /// Number of bytes that were added.
    std::uint64_t size() const { return size_; }
    /// Returns the digest of all bytes, as 64 hexadecimal digits. The object must not be used afterwards.
    std::string finish();

private:
    SHA2_CTX context_;
    std::uint64_t size_ = 0;  // bytes added so far
};

/// The digest of a text, as 64 hexadecimal digits.
std::string sha256(std::string_view text);

/// The first 8 bytes of the digest of a text, as a big-endian number.
std::uint64_t short_hash(std::string_view text);

/// The hash of a model: of its bytes, followed by those of the files that it refers to and that can be read, in the
/// order of References::readable.
/// \param bytes  receives the size of these files, if not null
/// \return 64 hexadecimal digits
/// \throws ReadError  the model cannot be read
/// Complexity: reads each file once, in pieces.
std::string model_hash(const std::filesystem::path& model, std::uint64_t* bytes = nullptr);

}  // namespace faqem::cli
