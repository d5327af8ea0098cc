#include "asset/formats/formats.hpp"
#include "asset/formats/mtl.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;

// Reading small damaged files must give an asset with valid indices or an InputError. With AddressSanitizer,
// these tests also check that no byte outside the file is read.

namespace {

using Reader = Asset (*)(std::span<const std::uint8_t>, const std::filesystem::path&);

/// Reads a text and returns whether the result is a valid asset or an InputError that names the file. The
/// text is copied to memory of exactly its size, so that a read beyond its end is out of bounds.
bool is_harmless(Reader read, const std::string& text) {
    const std::vector<std::uint8_t> exact(text.begin(), text.end());
    try {
        const Asset asset = read(exact, "no-such-folder/a");
        for (const Part& part : asset.parts) {
            if (part.triangles.empty() || part.face_material.size() != part.triangles.size()) return false;
            for (const Triangle& t : part.triangles)
                for (const Index v : t)
                    if (v >= part.positions.size()) return false;
            for (const auto& set : part.uvs)
                if (set.size() != part.positions.size()) return false;
            if (!part.normals.empty() && part.normals.size() != part.positions.size()) return false;
            if (!part.colors.empty() && part.colors.size() != part.positions.size()) return false;
        }
    } catch (const InputError& error) {
        return contains(error.what(), "no-such-folder/a");
    }
    return true;
}

std::string binary_ply() {
    std::string text =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float "
        "y\nproperty float z\n"
        "property list uchar ushort l\nproperty uchar red\nproperty uchar green\nproperty uchar "
        "blue\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n";
    for (int v = 0; v < 3; ++v)
        text += std::string(12, static_cast<char>(v)) + std::string("\1\5\0\xFF\x80\0", 6);
    return text + std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13);
}

std::string binary_stl() {
    return std::string(80, 'x') + std::string("\2\0\0\0", 4) + std::string(100, '\1');
}

struct Sample {
    const char* name;
    Reader read;
    std::string text;
};

std::vector<Sample> samples() {
    return {{"obj", read_obj,
             "\xEF\xBB\xBFmtllib a.mtl\r\no a\nv 0 0 0 1 0 0\nv 1e0 -0 +0\rv 1 1 \\\n 0\nv 0 nan 0\nvt 0 "
             ".5\nvn 0 0 1\n"
             "usemtl m\nf 1/1/1 2/1/1 3/1/1\nf -4//-1 2 3/1 4\nl 1 2\n"},
            {"ascii ply", read_ply,
             "ply\nformat ascii 1.0\ncomment x\nelement vertex 3\nproperty double x\nproperty float "
             "y\nproperty int z\n"
             "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
             "property list uchar uint vertex_index\nend_header\n0 0 0 1 2 3\n1.5 0 0 1 2 3\n1 1e1 0 1 2 "
             "3\n3 0 1 2\n"},
            {"binary ply", read_ply, binary_ply()},
            {"ascii stl", read_stl,
             "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 "
             "0\nendloop\nendfacet\nendsolid a\n"},
            {"binary stl", read_stl, binary_stl()},
            {"off", read_off,
             "STCNOFF # c\n3 1 3\n0 0 0 0 0 1 255 0 0 0.5 0\n1 0 0 0 0 1 0.5 0 0 1 1 0\n1 1 0 0 0 1 0 0 0 1 "
             "1\n3 0 1 2 1 1 1\n"}};
}

}  // namespace

TEST_CASE("files truncated at any byte give an error or a valid asset", "[truncation]") {
    for (const Sample& sample : samples())
        for (std::size_t size = 0; size <= sample.text.size(); ++size) {
            const bool harmless = is_harmless(sample.read, sample.text.substr(0, size));
            if (!harmless) FAIL(sample.name << " cut off after " << size << " bytes");
        }
    SUCCEED();
}

TEST_CASE("the complete samples are read", "[truncation]") {
    for (const Sample& sample : samples()) {
        CAPTURE(sample.name);
        CHECK(!sample.read(bytes_of(sample.text), "no-such-folder/a").parts.at(0).triangles.empty());
    }
}

TEST_CASE("files with any byte replaced or removed give an error or a valid asset", "[truncation]") {
    for (const Sample& sample : samples())
        for (std::size_t at = 0; at < sample.text.size(); ++at) {
            std::string shorter = sample.text;
            shorter.erase(at, 1);
            bool harmless = is_harmless(sample.read, shorter);
            for (const char c : {'\0', '\xFF', '\x7F', '-', '9', ' ', '\n', '\r', '\\', '/', '#', '.', 'e'}) {
                std::string changed = sample.text;
                changed[at] = c;
                harmless &= is_harmless(sample.read, changed);
            }
            if (!harmless) FAIL(sample.name << " changed at " << at);
        }
    SUCCEED();
}

TEST_CASE("material libraries truncated at any byte give an error or materials", "[truncation]") {
    const std::string text =
        "newmtl a\nKd 1 .5 \\\n 0\nd -halo 0.5\nNs 10\nmap_Kd -s 1 2 3 -o 1 -clamp on a b.png\nKe xyz 1 1 "
        "1\nmap_d -mm 0 1 x\n";
    for (std::size_t size = 0; size <= text.size(); ++size) {
        const std::vector<std::uint8_t> exact(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(size));
        std::vector<std::string> warnings;
        IgnoredStatements ignored;
        try {
            const std::size_t materials = read_mtl(exact, "a.mtl", warnings, ignored).size();
            CHECK(materials == (size < 6 ? 0u : 1u));
        } catch (const InputError& error) {
            CHECK(contains(error.what(), "a.mtl: line "));
        }
    }
}
