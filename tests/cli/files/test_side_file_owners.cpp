// Files beside a model that another model of the same name needs are not overwritten.

#include "cli/files/protected_files.hpp"

#include <map>
#include <vector>

#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"
#include "support/format_support.hpp"

using namespace tool_test;
using faqem::testing::contains;
using faqem::testing::message_of;

namespace {

/// The files that save() writes for a model, in the folder.
std::vector<fs::path> paths(const Folder& folder, const std::vector<std::string>& names) {
    std::vector<fs::path> all;
    for (const std::string& name : names) all.push_back(folder / name);
    return all;
}

std::string refusal(const Folder& folder, const std::vector<std::string>& names) {
    return message_of<faqem::WriteError>(
        [&] { faqem::cli::check_side_files_unshared(paths(folder, names)); });
}

std::map<std::string, std::string> file_contents(const Folder& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder.path())) files[entry.path()] = read(entry.path());
    return files;
}

const std::vector<std::string> gltf_files = {"a_0.png", "a.bin", "a.gltf"};
const std::vector<std::string> obj_files = {"a_0.png", "a.mtl", "a.obj"};
const std::string nothing = "accepted";

}  // namespace

TEST_CASE("an image of a.obj is not replaced by one of a.gltf, and the reverse") {
    const ModelFolder folder("a.obj", sheet(2));
    std::string message = refusal(folder, gltf_files);
    CHECK(contains(message, "a_0.png: is needed by "));
    CHECK(contains(message, "choose another output name"));
    CHECK(refusal(folder, obj_files) == nothing);
    fs::remove(folder / "a.obj");
    message = refusal(folder, gltf_files);
    CHECK(contains(message, "a.mtl"));  // the library alone needs the image, too
    fs::remove(folder / "a.mtl");
    CHECK(refusal(folder, gltf_files) == nothing);

    fs::remove(folder / "a_0.png");
    faqem::save(sheet(2), folder / "a.gltf");
    message = refusal(folder, obj_files);
    CHECK(contains(message, "a_0.png: is needed by "));
    CHECK(contains(message, "a.gltf"));
    CHECK(refusal(folder, gltf_files) == nothing);
}

TEST_CASE("files that no other model of the name refers to may be replaced") {
    const ModelFolder folder("a.obj", sheet(2));
    CHECK(refusal(folder, {"a.bin", "a.gltf"}) == nothing);             // without the image
    CHECK(refusal(folder, {"b_0.png", "b.bin", "b.gltf"}) == nothing);  // another name
    CHECK(refusal(folder, {"a_0.png", "a.glb"}) == nothing);            // no model with files beside it
    write(folder / "a.obj", "mtllib other.mtl\n");
    fs::remove(folder / "a.mtl");
    CHECK(refusal(folder, gltf_files) == nothing);
    write(folder / "a.obj", "call a_0.png\n");
    CHECK(contains(refusal(folder, gltf_files), "a_0.png: is needed by "));
}

TEST_CASE("simplify exits with 7 and writes nothing if another model of the name needs an image") {
    const Folder folder;
    const std::string options = " --bake keep --ratio 0.5 --quiet --force";
    faqem::save(sheet(2), folder / "in.glb");
    REQUIRE(run(folder, "simplify in.glb a.obj" + options).code == 0);
    const auto before = file_contents(folder);
    const Outcome outcome = run(folder, "simplify in.glb a.gltf" + options);
    CHECK(outcome.code == 7);
    CHECK(contains(outcome.err, "faqem: a_0.png: is needed by a.obj; choose another output name"));
    CHECK(file_contents(folder) == before);
    CHECK(run(folder, "simplify in.glb a.obj" + options).code == 0);
    CHECK(run(folder, "simplify in.glb b.gltf" + options).code == 0);
}
