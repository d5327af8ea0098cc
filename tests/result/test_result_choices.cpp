#include "result/result_choices.hpp"

#include <cmath>

#include "support/catch.hpp"

using namespace faqem::detail;

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

TEST_CASE("choices: the images that leave enough bytes for faces have the least error in all") {
    const TriedImages images = {
        {{60000, {0, 0}, 1024}, {4000, {1e-5, 1e-5}, 512}, {1000, {1e-2, 1e-2}, 256}}};
    const std::vector<ResultChoice> choices = result_choices(quartered(), images, exact, 20000);
    REQUIRE(!choices.empty());
    CHECK(choices[0].images == std::vector<std::size_t>{1});
    CHECK(choices[0].image_bytes == 4000);
    CHECK(choices[0].faces == 1600);
    const double unlit = 1e-4 + 1e-5, lit = 2e-4 + 1e-5;
    CHECK(choices[0].psnr == Approx(-5 * (std::log10(unlit) + std::log10(lit))).epsilon(1e-4));
    for (std::size_t i = 1; i < choices.size(); ++i) CHECK(choices[i].psnr <= choices[i - 1].psnr);
    CHECK(result_choices(quartered(), images, exact, 4500).empty());
}

TEST_CASE("choices: bytes go to the image whose error they lower most") {
    // The second image is seen ten times as much.
    const TriedImages images = {{{1000, {4e-5, 4e-5}, 64}, {2000, {1e-5, 1e-5}, 128}},
                                {{1000, {4e-4, 4e-4}, 64}, {2000, {1e-4, 1e-4}, 128}}};
    const auto chosen = [&](std::uint64_t bytes) {
        const std::vector<TriedFaces> faces = {{100, 500, {0, 0}}};
        return result_choices(faces, images, exact, bytes).at(0).images;
    };
    CHECK(chosen(2500) == std::vector<std::size_t>{0, 0});
    CHECK(chosen(3500) == std::vector<std::size_t>{0, 1});
    CHECK(chosen(4500) == std::vector<std::size_t>{1, 1});
}

TEST_CASE("choices: the bytes that are left are used for an encoding between the best ones") {
    // The middle one is above the line between the others, so that it is never the best for a byte.
    const TriedImages images = {
        {{1000, {1e-2, 1e-2}, 64}, {2000, {9e-3, 9e-3}, 64}, {3000, {1e-4, 1e-4}, 64}}};
    const std::vector<TriedFaces> faces = {{100, 500, {0, 0}}};
    CHECK(result_choices(faces, images, exact, 3000).at(0).images.at(0) == 1);
    CHECK(result_choices(faces, images, exact, 3500).at(0).images.at(0) == 2);
}

TEST_CASE("choices: without images all bytes go to faces, and errors that are no numbers are not chosen") {
    CHECK(result_choices(quartered(), {}, exact, 16000).at(0).faces == 1600);
    const double nan = std::nan("");
    const TriedImages images = {
        {{1000, {1e-4, 1e-4}, 64}, {2000, {nan, nan}, 128}, {3000, {1e-5, 1e-5}, 128}}};
    const ResultChoice best = result_choices(quartered(), images, exact, 70000).at(0);
    CHECK(best.images.at(0) == 2);
    CHECK(best.faces == 6400);
}

TEST_CASE("choices: finer positions where the bytes are enough for all faces, otherwise coarser ones") {
    const TriedImages images = {{{4000, {1e-6, 1e-6}, 512}}};
    const std::vector<TriedRounding> roundings = {
        {14, 64000, {1e-5, 1e-5}}, {13, 60000, {4e-5, 4e-5}}, {16, 72000, {1e-6, 1e-6}}};
    const auto best = [&](std::uint64_t bytes) {
        return result_choices(quartered(), images, roundings, bytes).at(0);
    };
    CHECK(roundings[best(76000).rounding].position_bits == 16u);
    CHECK(best(76000).faces == 6400);
    CHECK(best(76000).psnr == Approx(-10 * std::log10(2e-6)).epsilon(1e-3));
    CHECK(roundings[best(9000).rounding].position_bits == 13u);
    // 5000 bytes of 60 for each face of 64.
    CHECK(std::abs(static_cast<double>(best(9000).faces) - 533) <= 1);
    // Bytes that are enough for all faces are not rounded to fewer.
    const std::vector<TriedRounding> odd = {
        {14, 64000, {1e-5, 1e-5}}, {13, 60007, {9, 9}}, {15, 65011, {0, 0}}};
    const ResultChoice all = result_choices(quartered(), images, odd, 100000).at(0);
    CHECK(odd[all.rounding].position_bits == 15u);
    CHECK(all.faces == 6400);
    CHECK(as_first_rounding(roundings, 0, 5000) == 5000);
    CHECK(as_first_rounding(roundings, 2, 9000) == 8000);
}
