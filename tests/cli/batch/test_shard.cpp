#include "cli/batch/shard.hpp"

#include <map>

#include "cli/batch/run_summary.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"

using namespace faqem::cli;

namespace {

Shard automatic(const std::map<std::string, std::string>& variables) {
    return parse_shard("auto", [&](const std::string& name) {
        const auto found = variables.find(name);
        return found == variables.end() ? std::nullopt : std::optional(found->second);
    });
}

std::string text(const Shard& shard) { return shard.name(); }

}  // namespace

TEST_CASE("each model belongs to one shard: the first 8 bytes of the SHA-256 of its id modulo the number") {
    // sha256("abc") begins with ba7816bf8f01cfea = 13436514500253700074.
    CHECK((Shard{13436514500253700074ULL % 1000, 1000}.contains("abc")));
    for (const char* id : {"a", "b", "models/c.glb", ""}) {
        int owners = 0;
        for (std::uint64_t i = 0; i < 7; ++i) owners += Shard{i, 7}.contains(id);
        CHECK(owners == 1);
    }
}

TEST_CASE("--shard is I/N with I below N") {
    CHECK(text(parse_shard("0/1")) == "0-of-1");
    CHECK(text(parse_shard("99/100")) == "99-of-100");
    for (const char* wrong : {"", "1", "1/1", "2/1", "-1/2", "0/0", "a/2", "1/2/3", "1 /2", "Auto"})
        CHECK_THROWS_AS(parse_shard(wrong), faqem::OptionError);
}

TEST_CASE("--shard auto reads the index and the number of tasks of array jobs") {
    CHECK(text(automatic({{"FAQEM_SHARD_INDEX", "3"}, {"FAQEM_SHARD_COUNT", "10"}, {"RANK", "1"}})) ==
          "3-of-10");
    CHECK(text(automatic({{"JOB_COMPLETION_INDEX", "3"}, {"FAQEM_SHARD_COUNT", "10"}})) == "3-of-10");
    CHECK(text(automatic({{"RANK", "1"}, {"WORLD_SIZE", "2"}})) == "1-of-2");
    CHECK(text(automatic({{"AWS_BATCH_JOB_ARRAY_INDEX", "0"}, {"AWS_BATCH_JOB_ARRAY_SIZE", "5"}})) ==
          "0-of-5");
    const std::map<std::string, std::string> slurm = {
        {"SLURM_ARRAY_TASK_ID", "12"}, {"SLURM_ARRAY_TASK_MIN", "10"}, {"SLURM_ARRAY_TASK_MAX", "14"}};
    const auto with = [&](std::map<std::string, std::string> more) {
        more.insert(slurm.begin(), slurm.end());
        return more;
    };
    CHECK(text(automatic(with({{"SLURM_ARRAY_TASK_COUNT", "5"}}))) == "2-of-5");
    // With a number of shards the index is that of the task, plus the offset.
    CHECK(text(automatic(with({{"FAQEM_SHARD_COUNT", "5000"}, {"FAQEM_SHARD_OFFSET", "1000"}}))) ==
          "1012-of-5000");
    // An array with gaps does not tell the number of shards.
    CHECK_THROWS_AS(automatic(with({{"SLURM_ARRAY_TASK_COUNT", "3"}})), faqem::OptionError);
}

TEST_CASE("--shard auto is an error, and never the whole list, without an index or a number") {
    CHECK_THROWS_AS(automatic({}), faqem::OptionError);
    CHECK_THROWS_AS(automatic({{"FAQEM_SHARD_COUNT", "5"}}), faqem::OptionError);
    CHECK_THROWS_AS(automatic({{"FAQEM_SHARD_INDEX", "5"}}), faqem::OptionError);
    CHECK_THROWS_AS(automatic({{"JOB_COMPLETION_INDEX", "0"}}), faqem::OptionError);
    CHECK_THROWS_AS(automatic({{"RANK", "2"}, {"WORLD_SIZE", "2"}}), faqem::OptionError);
    CHECK_THROWS_AS(automatic({{"RANK", "x"}, {"WORLD_SIZE", "2"}}), faqem::OptionError);
}

TEST_CASE("outputs are in 256 folders, with any id as a file name") {
    CHECK(default_output("abc", ".glb") == "ba/abc.glb");
    const std::string output = default_output("a/b c%\xff", ".ply");
    CHECK(output.substr(2) == "/a%2Fb%20c%25%FF.ply");
}

TEST_CASE("options of sbatch name incomplete shards as ranges below the limit of an array") {
    std::vector<Shard> shards;
    for (const std::uint64_t i : {0, 1, 2, 5, 999, 1000, 1001, 4000}) shards.push_back({i, 5000});
    CHECK(array_options(shards, 1000) ==
          "--array=0-2,5,999 --export=ALL,FAQEM_SHARD_COUNT=5000,FAQEM_SHARD_OFFSET=0\n"
          "--array=0-1 --export=ALL,FAQEM_SHARD_COUNT=5000,FAQEM_SHARD_OFFSET=1000\n"
          "--array=0 --export=ALL,FAQEM_SHARD_COUNT=5000,FAQEM_SHARD_OFFSET=4000\n");
    CHECK(array_options({}, 1000).empty());
}
