#pragma once
/// \file
/// The colours of the positions of an OBJ file.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

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
    void add_position(std::span<const double> rgb);

    /// Notes a face.
    void add_face() { starts_run_ = true; }

    /// Whether a line is part of a block.
    static bool is_block(std::string_view line) {
        return line.starts_with("#MRGB") || line.starts_with("#mrgb");
    }

    /// Reads a line of a block. What is not eight digits for each position is counted for a warning.
    /// \param in  at the start of the line
    void read_block(TextScanner& in);

    /// Returns the linear colours of all positions, white for those without; empty if none has a colour.
    std::vector<Vec4f> finish(std::vector<std::string>& warnings);

private:
    void finish_block();

    std::vector<Vec4f> colors_, painted_;  // of numbers, of blocks; may be shorter; alpha 0: none
    std::vector<Vec4f> block_;             // the lines since the last position
    std::size_t count_ = 0, run_ = 0;      // number of positions; the first one of those before a block
    bool starts_run_ = false;              // the next position is the first one after a face or block
    double largest_ = 0;                   // number of a colour
    std::uint64_t malformed_ = 0, excess_ = 0;
};

}  // namespace faqem::detail
