#include "faqem/detail/simplify/face_count_search.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "support/catch.hpp"

using faqem::detail::FaceCountSearch;

namespace {

struct Searched {
    std::uint64_t best = 0;              ///< smallest face count within the error
    std::vector<std::uint64_t> targets;  ///< in order
};

/// Runs a search with a given error function.
/// \param floor  smallest face count of any result
Searched search(std::uint64_t faces, double allowed, const std::function<double(std::uint64_t)>& error,
                std::uint64_t floor = 1) {
    FaceCountSearch search(faces, allowed);
    Searched result{faces, {}};
    while (const auto target = search.next()) {
        REQUIRE(*target >= 4);
        REQUIRE(*target < result.best);
        result.targets.push_back(*target);
        REQUIRE(result.targets.size() <= FaceCountSearch::max_runs);
        const std::uint64_t out = std::max(*target, floor);
        const bool within = error(out) <= allowed;
        search.add_result(out, error(out), within);
        if (within) result.best = std::min(result.best, out);
    }
    return result;
}

}  // namespace

TEST_CASE("face count search: a monotone error is solved to two percent of the smallest count") {
    for (const double power : {0.5, 1.0, 2.0}) {
        for (const double exact : {7.0, 60.0, 1'234.0, 50'000.0, 990'000.0}) {
            CAPTURE(power, exact);
            const Searched found = search(1'000'000, 1e-3, [&](std::uint64_t n) {
                return 1e-3 * std::pow(exact / static_cast<double>(n), power);
            });
            CHECK(static_cast<double>(found.best) >= exact);
            CHECK(static_cast<double>(found.best) <= std::max(exact + 1, 1.02 * exact));
        }
    }
}

TEST_CASE("face count search: a step and a second interval below it are found") {
    const auto step = [](std::uint64_t n) { return n >= 3000 ? 0.0 : 1.0; };
    // Eight bisections leave at most 8%, and the counts that are tried below the bracket improve on that.
    CHECK(search(100'000, 0.5, step).best <= 3240);
    // The error is also small from 2500 to 2900.
    const auto island = [&](std::uint64_t n) { return n >= 2500 && n <= 2900 ? 0.1 : step(n); };
    CHECK(search(100'000, 0.5, island).best <= 2900);
}

TEST_CASE("face count search: four faces are tried early if all counts are within the error") {
    const Searched found = search(1'000'000, 1, [](std::uint64_t) { return 1e-9; });
    CHECK(found.best == 4);
    CHECK(found.targets.size() <= 3);
    CHECK(search(1'000'000, 0, [](std::uint64_t) { return 0.0; }).best == 4);
}

TEST_CASE("face count search: the input is the best mesh if no count is within the error") {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double error : {2.0, 1e300, infinity, std::nan("")}) {
        const Searched found = search(5000, 1, [&](std::uint64_t) { return error; });
        CHECK(found.best == 5000);
        CHECK(*std::max_element(found.targets.begin(), found.targets.end()) >= 4900);
    }
}

TEST_CASE("face count search: unreachable face counts are not tried again") {
    const Searched found = search(
        10'000, 1, [](std::uint64_t) { return 0.5; }, 700);
    CHECK(found.best == 700);
    CHECK(found.targets.size() <= 3);
    const Searched never = search(
        10'000, 1, [](std::uint64_t) { return 2.0; }, 700);
    CHECK(never.best == 10'000);
}

TEST_CASE("face count search: meshes of at most four faces need no runs") {
    for (std::uint64_t faces = 0; faces <= 4; ++faces) {
        CHECK(search(faces, 1, [](std::uint64_t) { return 0.0; }).targets.empty());
    }
    CHECK(search(5, 1, [](std::uint64_t) { return 0.0; }).best == 4);
}
