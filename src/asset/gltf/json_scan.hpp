#pragma once
/// \file
/// Reading of the JSON of glTF files without a document in memory.

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "asset/gltf/json.hpp"

namespace faqem::detail {

/// Handles the events of the parser for a glTF document, which therefore needs no memory, and keeps the path
/// to the current value. The parser stops when a function returns false, and at an error of the document.
class JsonScan : public Json::json_sax_t {
public:
    bool null() override { return number(0); }
    bool boolean(bool) override { return number(0); }
    bool number_integer(Json::number_integer_t) override { return number(0); }
    bool number_float(Json::number_float_t, const std::string&) override { return number(0); }
    bool number_unsigned(Json::number_unsigned_t value) override { return number(value); }
    bool binary(Json::binary_t&) override { return true; }
    bool parse_error(std::size_t, const std::string&, const Json::exception&) override { return false; }
    bool key(std::string& name) override {
        keys_[depth_] = name;
        return on_key(name);
    }
    bool string(std::string& value) override { return on_string(value); }
    bool start_object(std::size_t) override { return start(true); }
    bool start_array(std::size_t) override { return start(false); }
    bool end_object() override { return end(); }
    bool end_array() override { return end(); }

protected:
    static constexpr std::size_t max_depth = 64;  // load() rejects deeper documents

    /// Called for numbers, literals and null; `value` is 0 if it is not an unsigned integer.
    virtual bool number(std::uint64_t /*value*/) { return true; }
    virtual bool on_key(const std::string&) { return true; }
    virtual bool on_string(const std::string&) { return true; }
    /// Called before the depth changes.
    virtual bool on_start(bool /*is_object*/) { return true; }
    virtual void on_end() {}

    /// Number of objects and arrays around the current value.
    std::size_t depth() const { return depth_; }
    /// Last key of the object at a depth; the document has depth 1. Empty in an array.
    const std::string& key_at(std::size_t depth) const { return keys_[depth]; }

private:
    bool start(bool is_object) {
        if (depth_ == max_depth || !on_start(is_object)) return false;
        keys_[++depth_].clear();
        return true;
    }
    bool end() {
        on_end();
        --depth_;
        return true;
    }

    std::size_t depth_ = 0;
    std::array<std::string, max_depth + 1> keys_;
};

/// Reads the JSON of a .gltf or .glb file.
/// \param model  a regular file. Of a file that is damaged or no glTF, the part before the error is read
void scan_gltf(const std::filesystem::path& model, JsonScan& events);

}  // namespace faqem::detail
