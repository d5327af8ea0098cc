#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cli/batch/model_list.hpp"
#include "cli/batch/plan.hpp"
#include "cli/commands/commands.hpp"
#include "cli/files/output_file.hpp"
#include "cli/files/sha256.hpp"
#include "cli/options/bound_options.hpp"
#include "cli/process/exit_code.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

namespace {

namespace fs = std::filesystem;

struct ListArguments {
    std::vector<std::string> sources;
    std::string out;
    bool force = false;
};

bool is_list(const fs::path& file) { return file.extension() == ".jsonl" || file.extension() == ".csv"; }

/// Appends the models of a folder, of another list, or a model.
void add_models(const fs::path& source, std::vector<BatchFile>& models) {
    if (fs::is_directory(source)) {
        std::size_t others = 0;
        append(models, find_models(source, others));
    } else if (is_list(source)) {
        read_list(
            source, [](const std::string&) { return true; },
            [&](BatchFile&& model) { models.push_back(std::move(model)); });
    } else {
        models.push_back({.in = source, .name = source.filename().string()});
    }
}

/// \throws InputError  two models have the same id or output
void check_unique(const std::vector<BatchFile>& models) {
    std::map<std::string, const BatchFile*> ids, outputs;
    const auto check = [](auto& owners, const std::string& key, const BatchFile& model, const char* what) {
        const auto [owner, is_new] = owners.emplace(key, &model);
        if (!is_new)
            throw InputError(
                model.in.string(), "",
                "has the same " + std::string(what) + " as " + owner->second->in.string() + ": " + key);
    };
    for (const BatchFile& model : models) {
        check(ids, model.name, model, "id");
        if (!model.out_name.empty())
            check(outputs, fs::path(model.out_name).lexically_normal().string(), model, "output");
    }
}

int run(const ListArguments& arguments) {
    std::vector<BatchFile> models;
    for (const std::string& source : arguments.sources) add_models(source, models);
    check_unique(models);
    std::string lines;
    const fs::path folder = fs::path(arguments.out).parent_path();
    for (BatchFile& model : models) {
        model.hash = model_hash(model.in, &model.bytes);
        lines += list_line(model, folder);
    }
    if (arguments.out.empty())
        std::cout << lines;
    else
        write_only_output(arguments.out, lines, arguments.force ? Overwrite::yes : Overwrite::no);
    return exit_ok;
}

}  // namespace

CommandInfo list_command() {
    const auto arguments = std::make_shared<ListArguments>();
    OptionInfo sources =
        list_option("SOURCE", arguments->sources,
                    "Models, directories of models, lists, or .csv tables with sha256 and local_path");
    sources.kind = detail::OptionKind::text;  // commas do not separate names
    sources.is_required = true;
    return {"list",
            "Write a list of models, with their SHA-256, for faqem batch --list",
            {"faqem list models -o models.jsonl", "faqem list scans metadata.csv -o scans.jsonl"},
            {sources},
            {text_option("-o,--output", "FILE", arguments->out, "The list; default: standard output"),
             force_option(arguments->force)},
            [arguments] { return run(*arguments); }};
}

}  // namespace faqem::cli
