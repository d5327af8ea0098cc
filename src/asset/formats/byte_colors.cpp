#include "asset/formats/byte_colors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "asset/image/srgb.hpp"

namespace faqem::detail {

void divide_byte_colors(double largest, std::initializer_list<std::vector<Vec4f>*> colors,
                        std::vector<std::string>& warnings) {
    constexpr double largest_unit_color = 2;
    if (!(largest > largest_unit_color)) return;
    warnings.push_back("colours stored as numbers up to " +
                       std::to_string(static_cast<int>(std::ceil(largest))) + " are divided by 255");
    for (std::vector<Vec4f>* const list : colors) {
        for (Vec4f& c : *list) {
            for (std::size_t k = 0; k < 3; ++k)
                c[k] = static_cast<float>(linear_from_srgb(srgb_from_linear(c[k]) / 255));
            c[3] = std::min(c[3] / 255, 1.0f);
        }
    }
}

}  // namespace faqem::detail
