#pragma once
/// \file
/// The colours of the positions of an OBJ file.

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "asset/image/srgb.hpp"
#include "asset/scene/messages.hpp"
#include "asset/text/text_scanner.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// Collects the colours of positions: three numbers after a position, from 0 to 1 or, if one is above 2, from 0 to 255;
/// and blocks of ZBrush, comments such as `#MRGB ffff0000ff00ff00` with eight hexadecimal digits (mask, red, green,
/// blue) for each position. Lines of a block follow each other without positions in between. It belongs to the
/// positions before it: from the first one after the last face or block or, if there are fewer of these than
/// colours, to the last ones of the file so far. A block has precedence over numbers.
class ObjColors {
public:
    /// Adds the next position.
    /// \param rgb  its colour, sRGB; empty: it has none
    void add_position(std::span<const double> rgb) {
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

    /// Notes a face.
    void add_face() { starts_run_ = true; }

    /// Whether a line is part of a block.
    static bool is_block(std::string_view line) {
        return line.starts_with("#MRGB") || line.starts_with("#mrgb");
    }

    /// Reads a line of a block. What is not eight digits for each position is counted for a warning.
    /// \param in  at the start of the line
    void read_block(TextScanner& in) {
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

    /// Returns the linear colours of all positions, white for those without; empty if none has a colour.
    std::vector<Vec4f> finish(std::vector<std::string>& warnings) {
        finish_block();
        add_counted(
            warnings, malformed_, "line",
            " of #MRGB with other than 8 hexadecimal digits for each position: the rest of it is ignored");
        add_counted(warnings, excess_, "colour", " of #MRGB ignored: there are fewer positions");
        if (colors_.empty() && painted_.empty()) return {};
        divide_byte_colors(largest_, {&colors_}, warnings);
        colors_.resize(count_);
        painted_.resize(count_);
        for (std::size_t v = 0; v < count_; ++v) {
            if (painted_[v][3] > 0) colors_[v] = painted_[v];
            const bool has_color = colors_[v][3] > 0;
            colors_[v] =
                has_color ? Vec4f{colors_[v][0], colors_[v][1], colors_[v][2], 1} : Vec4f{1, 1, 1, 1};
        }
        return std::move(colors_);
    }

private:
    void finish_block() {
        if (block_.empty()) return;
        const std::size_t used = std::min(block_.size(), count_);
        excess_ += block_.size() - used;
        painted_.resize(count_);
        std::copy_n(block_.begin(), used,
                    painted_.begin() + static_cast<std::ptrdiff_t>(std::min(run_, count_ - used)));
        block_.clear();
        starts_run_ = true;
    }

    std::vector<Vec4f> colors_, painted_;  // of numbers, of blocks; may be shorter; alpha 0: none
    std::vector<Vec4f> block_;             // the lines since the last position
    std::size_t count_ = 0, run_ = 0;      // number of positions; the first one of those before a block
    bool starts_run_ = false;              // the next position is the first one after a face or block
    double largest_ = 0;                   // number of a colour
    std::uint64_t malformed_ = 0, excess_ = 0;
};

}  // namespace faqem::detail
