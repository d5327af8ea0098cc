#include "asset/formats/obj_colors.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "asset/image/srgb.hpp"
#include "asset/scene/messages.hpp"

namespace faqem::detail {

void ObjColors::add_position(std::span<const double> rgb) {
    finish_block();
    if (starts_run_) run_ = count_;
    starts_run_ = false;
    ++count_;
    if (rgb.empty()) return;
    colors_.resize(count_);
    for (std::size_t k = 0; k < 3; ++k) {
        colors_.back()[k] = static_cast<float>(linear_from_srgb(rgb[k]));
        if (rgb[k] <= 255) largest_ = std::max(largest_, rgb[k]);
    }
    colors_.back()[3] = 1;
}

void ObjColors::read_block(TextScanner& in) {
    constexpr std::size_t digits = 8;
    in.word();
    for (std::string_view word = in.word(); !word.empty(); word = in.word()) {
        for (; !word.empty(); word.remove_prefix(digits)) {
            std::uint32_t mrgb = 0;
            const char* const end = word.data() + std::min(digits, word.size());
            if (word.size() < digits || std::from_chars(word.data(), end, mrgb, 16).ptr != end) {
                ++malformed_;
                return;
            }
            const auto channel = [&](unsigned shift) {
                return static_cast<float>(linear_from_srgb((mrgb >> shift & 255) / 255.0));
            };
            block_.push_back({channel(16), channel(8), channel(0), 1});
        }
    }
}

void ObjColors::finish_block() {
    if (block_.empty()) return;
    const std::size_t used = std::min(block_.size(), count_);
    excess_ += block_.size() - used;
    painted_.resize(count_);
    std::copy_n(block_.begin(), used,
                painted_.begin() + static_cast<std::ptrdiff_t>(std::min(run_, count_ - used)));
    block_.clear();
    starts_run_ = true;
}

std::vector<Vec4f> ObjColors::finish(std::vector<std::string>& warnings) {
    finish_block();
    if (malformed_)
        warnings.push_back(
            pluralized(malformed_, "line") +
            " of #MRGB with other than 8 hexadecimal digits for each position: the rest of it is ignored");
    if (excess_)
        warnings.push_back(pluralized(excess_, "colour") + " of #MRGB ignored: there are fewer positions");
    if (colors_.empty() && painted_.empty()) return {};
    divide_byte_colors(largest_, {&colors_}, warnings);
    colors_.resize(count_);
    painted_.resize(count_);
    for (std::size_t v = 0; v < count_; ++v) {
        if (painted_[v][3] > 0) colors_[v] = painted_[v];
        const bool has_color = colors_[v][3] > 0;
        colors_[v] = has_color ? Vec4f{colors_[v][0], colors_[v][1], colors_[v][2], 1} : Vec4f{1, 1, 1, 1};
    }
    return std::move(colors_);
}

}  // namespace faqem::detail
