#include "cli/budget/budget_choices.hpp"

#include <cmath>

#include "support/catch.hpp"

using namespace faqem::cli;

namespace {

// Bytes in proportion to the faces, errors to their inverse square.
std::vector<TriedFaces> quartered() {
    return {{6400, 64000, {0, 0}}, {1600, 16000, {1e-4, 2e-4}}, {400, 4000, {16e-4, 32e-4}}};
}

// Vertices that are not rounded.
const std::vector<TriedRounding> exact = {{{}, 64000, {0, 0}}};

}  // namespace

TEST_CASE("faces within bytes: the ones that were tried, and powers between them") {
    const std::vector<TriedFaces> tried = quartered();
    CHECK(faces_within(tried, 1'000'000) == 6400);
    CHECK(faces_within(tried, 64000) == 6400);
    CHECK(faces_within(tried, 4000) == 400);
    CHECK_FALSE(faces_within(tried, 3999));
    CHECK(std::abs(static_cast<double>(*faces_within(tried, 8000)) - 800) <= 1);
    CHECK(std::abs(static_cast<double>(*faces_within(tried, 32000)) - 3200) <= 1);
}

TEST_CASE("error of faces: a power between those that were tried, and what is missing near all faces") {
    const std::vector<TriedFaces> tried = quartered();
    CHECK(error_of_faces(tried, 6400).unlit == 0);
    CHECK(error_of_faces(tried, 1600).unlit == Approx(1e-4));
    CHECK(error_of_faces(tried, 400).lit == Approx(32e-4));
    CHECK(error_of_faces(tried, 800).unlit == Approx(4e-4));
    CHECK(error_of_faces(tried, 100).unlit == Approx(16e-4));
    // 1/3200 is a third of the way from 1/6400 to 1/1600.
    CHECK(error_of_faces(tried, 3200).unlit == Approx(1e-4 / 3));
}

TEST_CASE("choices: images that leave no bytes for faces are left out, and the least error comes first") {
    const std::vector<TriedImages> images = {
        {1024, 40.0, 60000, {0, 0}}, {512, 34.0, 4000, {1e-5, 1e-5}}, {256, 28.0, 1000, {1e-2, 1e-2}}};
    const std::vector<BudgetChoice> choices = budget_choices(quartered(), images, exact, 20000);
    REQUIRE(choices.size() == 2);
    CHECK(choices[0].images == 1);
    CHECK(choices[0].faces == 1600);
    const double unlit = 1e-4 + 1e-5, lit = 2e-4 + 1e-5;
    CHECK(choices[0].psnr == Approx(-5 * (std::log10(unlit) + std::log10(lit))).epsilon(1e-4));
    CHECK(choices[1].images == 2);
    CHECK(choices[1].faces > 1600);
    CHECK(budget_choices(quartered(), images, exact, 4500).size() == 0);
}

TEST_CASE("choices: equal ones are in the order of the images, and errors that are no numbers come last") {
    const double nan = std::nan("");
    const std::vector<TriedImages> images = {
        {64, 30.0, 1000, {nan, nan}}, {128, 30.0, 1000, {1e-4, 1e-4}}, {128, 34.0, 1000, {1e-4, 1e-4}}};
    const std::vector<BudgetChoice> choices = budget_choices(quartered(), images, exact, 20000);
    REQUIRE(choices.size() == 3);
    CHECK(choices[0].images == 1);
    CHECK(choices[1].images == 2);
    CHECK(choices[2].images == 0);
}

TEST_CASE(
    "choices: finer positions where the bytes are enough for all faces, coarser ones where faces are "
    "missing") {
    const std::vector<TriedImages> images = {{512, 34.0, 4000, {1e-6, 1e-6}}};
    const std::vector<TriedRounding> roundings = {
        {14, 64000, {1e-5, 1e-5}}, {13, 60000, {4e-5, 4e-5}}, {16, 72000, {1e-6, 1e-6}}};
    const auto best = [&](std::uint64_t bytes) {
        return budget_choices(quartered(), images, roundings, bytes).at(0);
    };
    CHECK(roundings[best(76000).rounding].position_bits == 16u);
    CHECK(best(76000).faces == 6400);
    CHECK(best(76000).psnr == Approx(-10 * std::log10(2e-6)).epsilon(1e-3));
    CHECK(roundings[best(9000).rounding].position_bits == 13u);
    // 5000 bytes of 60 for each face of 64.
    CHECK(std::abs(static_cast<double>(best(9000).faces) - 533) <= 1);
    CHECK(as_first_rounding(roundings, 0, 5000) == 5000);
    CHECK(as_first_rounding(roundings, 2, 9000) == 8000);
}
