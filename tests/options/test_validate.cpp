#include "faqem/options.hpp"

#include <limits>

#include "faqem/detail/options/option_table.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"
#include "support/message_of.hpp"

using namespace faqem;

namespace {

const double not_a_number = std::numeric_limits<double>::quiet_NaN();

// The error message of validate() for options changed by `change`, or "accepted".
template <class Change>
std::string option_complaint(Change change) {
    Options options;
    change(options);
    return testing::message_of<OptionError>([&] { validate(options); });
}

/// The message for a value outside of a range.
std::string outside(const std::string& must, double value) {
    return must + ", not " + detail::number_text(value);
}

}  // namespace

TEST_CASE("the default options are valid") {
    CHECK(option_complaint([](Options&) {}) == "accepted");
}

TEST_CASE("a target ratio must be above 0 and at most 1 and a face count at least 1") {
    for (const double bad : {0.0, -0.1, 1.0000001, not_a_number, test::infinity}) {
        CHECK(option_complaint([&](Options& o) { o.target = ratio(bad); }) ==
              outside("target ratio must be in (0, 1]", bad));
    }
    CHECK(option_complaint([](Options& o) { o.target = ratio(1); }) == "accepted");
    CHECK(option_complaint([](Options& o) { o.target = ratio(1e-300); }) == "accepted");
    CHECK(option_complaint([](Options& o) { o.target = faces(0); }) ==
          outside("target face count must be >= 1", 0));
    for (const double bad : {0.5, not_a_number, test::infinity}) {
        CHECK(option_complaint([&](Options& o) {
                  o.target = {Target::Kind::faces, bad};
              }) == outside("target face count must be >= 1", bad));
    }
    CHECK(option_complaint([](Options& o) { o.target = faces(1); }) == "accepted");
    CHECK(option_complaint([](Options& o) { o.target = faces(~0ull); }) == "accepted");
}

TEST_CASE("max_error must be finite and positive in either unit") {
    for (const double bad : {0.0, -1e-9, not_a_number, test::infinity}) {
        CHECK(option_complaint([&](Options& o) { o.max_error = model_units(bad); }) ==
              outside("max_error must be finite and > 0", bad));
        CHECK(option_complaint([&](Options& o) { o.max_error = of_diagonal(bad); }) ==
              outside("max_error must be finite and > 0", bad));
    }
    CHECK(option_complaint([](Options& o) { o.max_error = model_units(1e-300); }) == "accepted");
    CHECK(option_complaint([](Options& o) { o.max_error = of_diagonal(2); }) == "accepted");
}

TEST_CASE("weighted visibility with max_error needs a target") {
    const auto both = [](Options& o) {
        o.max_error = of_diagonal(0.1);
        o.visibility = Visibility::weighted;
    };
    CHECK(option_complaint(both) ==
          "visibility must not be weighted if max_error is given without target ratio or target face count: "
          "distances are not weighted");
    CHECK(option_complaint([&](Options& o) { both(o), o.target = faces(10); }) == "accepted");
    CHECK(option_complaint([&](Options& o) { both(o), o.visibility = Visibility::ignored; }) == "accepted");
}

TEST_CASE("the default target is a ratio of 0.1") {
    CHECK(Options{}.target.kind == Target::Kind::unset);
    CHECK(Options{}.target.value == 0.1);
    CHECK(option_complaint([](Options& o) { o.target.value = 0; }) ==
          outside("target ratio must be in (0, 1]", 0));
}

TEST_CASE("weights must be finite and not negative and errors name the weight") {
    const std::pair<std::optional<double> Weights::*, std::string> members[] = {
        {&Weights::area, "area"}, {&Weights::boundary, "boundary"},     {&Weights::normal, "normal"},
        {&Weights::uv, "uv"},     {&Weights::plane_area, "plane_area"},
    };
    for (const auto& [member, name] : members) {
        for (const double bad : {-1e-9, not_a_number, test::infinity}) {
            CHECK(option_complaint([&, at = member](Options& o) { o.weights.*at = bad; }) ==
                  outside("weights." + name + " must be finite and >= 0", bad));
        }
        CHECK(option_complaint([&, at = member](Options& o) { o.weights.*at = 0; }) == "accepted");
    }
}

TEST_CASE("weld and virtual edge distances must be in their ranges") {
    for (const double bad : {-1e-9, not_a_number, test::infinity}) {
        CHECK(option_complaint([&](Options& o) { o.topology.weld_distance = bad; }) ==
              outside("weld_distance must be finite and >= 0", bad));
    }
    CHECK(option_complaint([](Options& o) { o.topology.weld_distance = 0; }) == "accepted");
    for (const double bad : {0.0, -0.1, 1.1, not_a_number}) {
        CHECK(option_complaint([&](Options& o) { o.topology.virtual_edge_distance = bad; }) ==
              outside("virtual_edge_distance must be in (0, 1]", bad));
    }
    CHECK(option_complaint([](Options& o) { o.topology.virtual_edge_distance = 1; }) == "accepted");
}

TEST_CASE("baking options must be in their ranges") {
    for (const std::uint32_t bad : {0u, 32u, 100u, 2047u, 32768u, ~0u}) {
        CHECK(option_complaint([&](Options& o) { o.bake.texture_size = bad; }) ==
              outside("texture_size must be a power of two in [64, 16384]", bad));
    }
    for (const double bad : {0.0, 0.124, 8.1, not_a_number}) {
        CHECK(option_complaint([&](Options& o) { o.bake.texel_density = bad; }) ==
              outside("texel_density must be in [0.125, 8]", bad));
    }
    for (const std::uint32_t bad : {0u, 9u}) {
        CHECK(option_complaint([&](Options& o) { o.bake.samples = bad; }) ==
              outside("samples must be in [1, 8]", bad));
    }
    for (const double bad : {-1.0, 181.0, not_a_number}) {
        CHECK(option_complaint([&](Options& o) { o.bake.crease_angle = bad; }) ==
              outside("crease_angle must be in [0, 180] degrees", bad));
    }
    for (const std::uint32_t bad : {0u, 101u}) {
        CHECK(option_complaint([&](Options& o) { o.bake.jpeg_quality = bad; }) ==
              outside("jpeg_quality must be in [1, 100]", bad));
    }
    CHECK(option_complaint([](Options& o) {
              o.bake = {.kind = Bake::none,
                        .texture_size = 64,
                        .texel_density = 8,
                        .samples = 8,
                        .crease_angle = 180,
                        .jpeg_quality = 1};
          }) == "accepted");
}
