#include "cli/batch/model_list.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

#include "cli/files/sha256.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

namespace {

namespace fs = std::filesystem;

/// The id of a line that begins with it, as list_line() writes it; nothing if it does not, or has an escape.
std::optional<std::string> leading_id(std::string_view line) {
    constexpr std::string_view start = R"({"id":")";
    if (!line.starts_with(start)) return std::nullopt;
    line.remove_prefix(start.size());
    const std::size_t end = line.find_first_of("\"\\");
    if (end == std::string_view::npos || line[end] == '\\') return std::nullopt;
    return std::string(line.substr(0, end));
}

BatchFile parse_line(const std::string& line) {
    const Json json = Json::parse(line, nullptr, false);
    if (!json.is_object()) throw InputError("", "", "is no JSON object");
    BatchFile model;
    json.at("id").get_to(model.name);
    model.in = json.at("input").get<std::string>();
    model.hash = json.value("sha256", "");
    model.bytes = json.value("bytes", std::uint64_t{0});
    model.out_name = json.value("output", "");
    if (json.contains("options")) model.listed_options = json["options"];
    if (model.name.empty() || model.in.empty()) throw InputError("", "", "has an empty id or input");
    if (!model.listed_options.is_null() && !model.listed_options.is_object())
        throw InputError("", "", "options is no object");
    return model;
}

/// The fields of a line of a table (RFC 4180, without line ends in fields).
std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields(1);
    bool is_quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"')
            fields.back() += line[i++];
        else if (line[i] == '"')
            is_quoted = !is_quoted;
        else if (line[i] == ',' && !is_quoted)
            fields.emplace_back();
        else
            fields.back() += line[i];
    }
    return fields;
}

using LineReader = std::function<BatchFile(const std::string& line)>;

/// Reads the lines of a table with this header as those of a list.
LineReader table_reader(const std::string& header) {
    const std::vector<std::string> names = fields_of(header);
    const auto column = [&](const char* name) {
        const auto found = std::ranges::find(names, name);
        if (found == names.end()) throw InputError("", "", std::string("there is no column ") + name);
        return static_cast<std::size_t>(found - names.begin());
    };
    return [id = column("sha256"), input = column("local_path")](const std::string& line) -> BatchFile {
        const std::vector<std::string> fields = fields_of(line);
        if (fields.size() <= std::max(id, input)) throw InputError("", "", "has too few columns");
        if (fields[id].empty() || fields[input].empty())
            throw InputError("", "", "has no sha256 or no local_path");
        return {.in = fields[input], .name = fields[id]};
    };
}

}  // namespace

std::string read_list(const fs::path& list, const std::function<bool(const std::string& id)>& wanted,
                      const std::function<void(BatchFile&&)>& take) {
    std::ifstream in(list, std::ios::binary);
    if (!in || fs::is_directory(list)) throw ReadError(list.string(), "", "cannot read");
    const bool is_table = list.extension() == ".csv";
    LineReader read = is_table ? LineReader() : parse_line;
    std::uint64_t number = 0;
    Sha256 hash;
    for (std::string line; std::getline(in, line);) {
        hash.add(line);
        if (!in.eof()) hash.add("\n");
        ++number;
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (line.empty()) continue;
        try {
            if (!read) {
                read = table_reader(line);
                continue;
            }
            if (const std::optional<std::string> id = leading_id(line); id && !is_table && !wanted(*id))
                continue;
            BatchFile model = read(line);
            if (!wanted(model.name)) continue;
            model.in = list.parent_path() / model.in;
            take(std::move(model));
        } catch (const Json::exception& error) {
            throw InputError(list.string(), "line " + std::to_string(number), error.what());
        } catch (const InputError& error) {
            throw InputError(list.string(), "line " + std::to_string(number), error.what());
        }
    }
    if (in.bad()) throw ReadError(list.string(), "", "cannot read");
    return hash.finish();
}

std::string list_line(const BatchFile& model, const fs::path& folder) {
    const fs::path from = fs::absolute(folder.empty() ? "." : folder).lexically_normal();
    Json json = {{"id", model.name},
                 {"input", fs::absolute(model.in).lexically_normal().lexically_relative(from).string()},
                 {"sha256", model.hash},
                 {"bytes", model.bytes}};
    if (!model.out_name.empty()) json["output"] = model.out_name;
    if (!model.listed_options.is_null()) json["options"] = model.listed_options;
    return json_line(json);
}

}  // namespace faqem::cli
