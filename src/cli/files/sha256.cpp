#include "cli/files/sha256.hpp"

#include <fstream>
#include <vector>

#include "asset/model_files.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

namespace {

void add_file(Sha256& hash, const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw ReadError(file.string(), "", "cannot read");
    std::vector<char> piece(std::size_t{1} << 18);
    while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())) || in.gcount() > 0)
        hash.add({piece.data(), static_cast<std::size_t>(in.gcount())});
    if (in.bad()) throw ReadError(file.string(), "", "cannot read");
}

}  // namespace

void Sha256::add(std::string_view bytes) {
    SHA256Update(&context_, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    size_ += bytes.size();
}

std::string Sha256::finish() {
    char digits[SHA256_DIGEST_STRING_LENGTH];
    return SHA256End(&context_, digits);
}

std::string sha256(std::string_view text) {
    Sha256 hash;
    hash.add(text);
    return hash.finish();
}

std::uint64_t short_hash(std::string_view text) {
    return std::stoull(sha256(text).substr(0, 16), nullptr, 16);
}

std::string model_hash(const std::filesystem::path& model, std::uint64_t* bytes) {
    Sha256 hash;
    add_file(hash, model);
    for (const std::filesystem::path& file : detail::referenced_files(model, detail::References::readable))
        add_file(hash, file);
    if (bytes) *bytes = hash.size();
    return hash.finish();
}

}  // namespace faqem::cli
