#include "bake/page/sample_order.hpp"

#include <algorithm>

namespace faqem::detail {
namespace {

using Places = std::vector<std::array<std::uint32_t, 2>>;

// The first samples, then the others row by row.
std::vector<SamplePlace> order(std::uint32_t samples, Places places) {
    for (std::uint32_t row = 0; row < samples; ++row)
        for (std::uint32_t column = 0; column < samples; ++column)
            if (std::find(places.begin(), places.end(), std::array{column, row}) == places.end())
                places.push_back({column, row});
    std::vector<SamplePlace> result;
    for (const auto& [column, row] : places)
        result.push_back({column, row, (column + 0.5) / samples, (row + 0.5) / samples});
    return result;
}

}  // namespace

SampleOrder::SampleOrder(std::uint32_t samples) {
    const std::uint32_t last = samples - 1, middle = last / 2;
    std::array<Places, 2> first;
    if (samples == 1)
        first = {{{{0, 0}}, {{0, 0}}}};
    else if (samples == 2)
        first = {{{{0, 0}, {1, 1}}, {{1, 0}, {0, 1}}}};
    else
        first[0] = first[1] = {{middle, middle}, {0, 0}, {last, 0}, {0, last}, {last, last}};
    first_samples_ = first[0].size();
    for (std::size_t i = 0; i < 2; ++i) orders_[i] = order(samples, first[i]);
}

}  // namespace faqem::detail
