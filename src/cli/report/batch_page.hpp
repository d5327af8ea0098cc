#pragma once
/// \file
/// The page about a batch over a list.

#include <cstdio>
#include <string>
#include <vector>

#include "cli/batch/run_summary.hpp"
#include "cli/report/html.hpp"

namespace faqem::cli {

inline std::string share_text(const Json& record) {
    const double in = record.value("input_bytes", 0.0), out = record.value("bytes", 0.0);
    if (!(in > 0) || !(out > 0)) return "";
    char text[32];
    std::snprintf(text, sizeof text, "%.3f", out / in);
    return text;
}

/// Returns an HTML page: the numbers of models by their end, what is missing, and the worst models.
inline std::string batch_page(const RunSummary& summary) {
    std::vector<std::vector<std::string>> counts, problems, worst;
    for (const auto& [end, count] : summary.counts) counts.push_back({end, std::to_string(count)});
    for (const std::string& problem : summary.problems) problems.push_back({problem});
    for (const Json& record : summary.worst)
        worst.push_back({record.value("id", ""), record.value("event", ""),
                         record.contains("code") ? record["code"].dump() : "", share_text(record),
                         record.value("message", "")});
    std::string page =
        "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>Batch</title>\n"
        "<style>body{font:15px sans-serif;margin:2em}table{border-collapse:collapse;margin:1em 0}"
        "td,th{border:1px solid #bbb;padding:.2em .6em;text-align:left}</style>\n<h1>Batch</h1>\n";
    page += html_table("Models by their end", {"End", "Models"}, counts);
    if (!problems.empty()) page += html_table("What is missing", {"Problem"}, problems);
    return page + html_table("Models without a result, then those with the most bytes out of one byte in",
                             {"Model", "End", "Code", "Bytes out / in", "Message"}, worst);
}

}  // namespace faqem::cli
