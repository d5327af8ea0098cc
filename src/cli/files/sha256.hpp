#pragma once
/// \file
/// SHA-256 (FIPS 180-4), which identifies models in lists and records.

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace faqem::cli {

class Sha256 {
public:
    void add(std::span<const std::uint8_t> bytes);
    /// Number of bytes that were added.
    std::uint64_t size() const { return size_; }
    /// Returns the digest of all bytes, as 64 hexadecimal digits. The object must not be used afterwards.
    std::string finish();

private:
    void add_block(const std::uint8_t* block);

    std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                           0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    std::array<std::uint8_t, 64> rest_ = {};  // bytes that are no whole block yet
    std::uint64_t size_ = 0;                  // bytes added so far
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
