#include "cli/report/html.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace faqem::cli {

std::string escape_html(std::string_view text) {
    constexpr std::string_view special = "&<>\"'";
    constexpr std::array<std::string_view, 5> entities = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
    std::string result;
    for (const char c : text) {
        const std::size_t at = special.find(c);
        result += at == std::string_view::npos ? std::string_view(&c, 1) : entities[at];
    }
    return result;
}

std::string breakable_html(std::string_view text) {
    std::string result = escape_html(text);
    for (std::size_t at = 0; (at = result.find('/', at)) != std::string::npos; at += 6)
        result.insert(at + 1, "<wbr>");
    return result;
}

std::string fill_template(std::string_view text,
                          const std::vector<std::pair<std::string_view, std::string>>& values) {
    std::string result;
    while (true) {
        const std::size_t begin = text.find("@@");
        result += text.substr(0, begin);
        if (begin == std::string_view::npos) return result;
        const std::size_t end = text.find("@@", begin + 2);
        const auto value = std::ranges::find(values, text.substr(begin + 2, end - begin - 2),
                                             [](const auto& pair) { return pair.first; });
        assert(value != values.end());
        result += value->second;
        text.remove_prefix(end + 2);
    }
}

std::string html_table(const std::string& caption, const std::vector<std::string>& titles,
                       const std::vector<std::vector<std::string>>& rows) {
    std::string html = "<div><table>\n<caption>" + escape_html(caption) + "</caption>\n<thead><tr>";
    for (const std::string& title : titles)
        html += title.empty() ? "<td></td>" : "<th scope=\"col\">" + breakable_html(title) + "</th>";
    html += "</tr></thead>\n<tbody>\n";
    for (const std::vector<std::string>& row : rows) {
        html += "<tr><th scope=\"row\">" + breakable_html(row.at(0)) + "</th>";
        for (std::size_t i = 1; i < row.size(); ++i) html += "<td>" + escape_html(row[i]) + "</td>";
        html += "</tr>\n";
    }
    return html + "</tbody>\n</table></div>\n";
}

std::string base64(std::span<const std::uint8_t> bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

}  // namespace faqem::cli
