#include "asset/scene/position_rounding.hpp"

#include <cmath>
#include <limits>

#include "asset/formats/formats.hpp"
#include "support/catch.hpp"

using namespace faqem;

namespace {

using Type = StoredPrecision::Type;

std::vector<std::uint8_t> bytes(const std::string& text) { return {text.begin(), text.end()}; }

StoredPrecision of_obj(const std::string& coordinates) {
    return detail::read_obj(bytes("v " + coordinates + "\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "a.obj").precision;
}

double rounded(const StoredPrecision& precision, double x) {
    std::vector<Vec3> positions = {{x, 0, 0}};
    detail::round_positions(precision, {}, positions);
    return positions[0][0];
}

// A square of the given size at a place, with a vertex beside a middle that no float and no short decimal is.
Asset square_at(double x, double size, StoredPrecision precision) {
    Asset asset;
    asset.precision = precision;
    Part& part = asset.parts.emplace_back();
    part.positions = {{x, 0, 0}, {x + size, 0, 0}, {x, size, 0}, {x + size, size, 0}};
    part.triangles = {{0, 1, 3}, {0, 3, 2}};
    return asset;
}

}  // namespace

TEST_CASE("text records the most digits from the first that is not zero and the most decimals") {
    const auto has = [](const StoredPrecision& p, std::uint32_t digits, std::uint32_t decimals) {
        return p.type == Type::decimal && p.digits == digits && p.decimals == decimals;
    };
    CHECK(has(of_obj("0.500000 -12.250000 0.000012"), 8, 6));
    CHECK(has(of_obj("5121946 3 100"), 7, 0));
    CHECK(has(of_obj("1.25e-05 0 +2.5E+3"), 3, 7));
    const std::string off = "OFF\n3 1 0\n0.125 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    CHECK(has(detail::read_off(bytes(off), "a.off").precision, 3, 3));
}

TEST_CASE("PLY files record the type and not whether the values are floats") {
    for (const std::string type : {"float", "double", "int"}) {
        const std::string text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty " + type +
                                 " x\nproperty " + type + " y\nproperty " + type +
                                 " z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                                 "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
        const Type expected = type == "float"    ? Type::float32
                              : type == "double" ? Type::float64
                                                 : Type::unknown;
        CHECK(detail::read_ply(bytes(text), "a.ply").precision.type == expected);
    }
}

TEST_CASE("decimals have the digits of the source, and one more where it has fewer than six") {
    CHECK(rounded({Type::decimal, 7, 6}, 1.23456789) == 1.234568);
    CHECK(rounded({Type::decimal, 6, 6}, 12.3456789) == 12.3457);
    CHECK(rounded({Type::decimal, 3, 2}, 1.23456789) == 1.235);
    CHECK(rounded({Type::decimal, 1, 0}, 0.5678) == 0.6);
    CHECK(rounded({Type::decimal, 13, 6}, 5121946.51312345678) == 5121946.513123);
    CHECK(rounded({Type::decimal, 6, 6}, -1e-9) == 0);
    CHECK(rounded({Type::decimal, 17, 17}, 0.1 + 0.2) == 0.1 + 0.2);
    CHECK(rounded({Type::float32}, 0.1) == double{0.1f});
    CHECK(rounded({}, 0.1) == 0.1);
}

TEST_CASE("a face that rounding would leave without area gets a corner moved by a step") {
    const std::vector<Triangle> faces = {{0, 1, 2}};
    for (const double height : {3e-7, -3e-7}) {
        std::vector<Vec3> sliver = {{0, 0, 0}, {1, 0, 0}, {0.5, height, 0}};
        detail::round_positions({Type::decimal, 7, 6}, faces, sliver);
        const double area = (sliver[1][0] - sliver[0][0]) * (sliver[2][1] - sliver[0][1]) -
                            (sliver[2][0] - sliver[0][0]) * (sliver[1][1] - sliver[0][1]);
        CHECK(area * height > 0);
        for (const Vec3& p : sliver) CHECK(std::abs(p[1]) == Approx(p[1] == 0 ? 0 : 1e-6));
    }
    // Floats near 1e6 have steps of 1/16.
    std::vector<Vec3> far = {{1e6, 0, 0}, {1e6 + 0.01, 0, 0}, {1e6, 1, 0}};
    detail::round_positions({Type::float32}, faces, far);
    CHECK(far[1][0] - far[0][0] == 0.0625);
    CHECK(far[2][1] == 1);
}

TEST_CASE("positions stay exact where rounding would leave many faces without area") {
    std::vector<Vec3> positions;
    std::vector<Triangle> faces;
    for (Index i = 0; i < 600; i += 3) {
        faces.push_back({i, i + 1, i + 2});
        positions.insert(positions.end(), {{1e6, 0, 0}, {1e6 + 0.01, 0, 0}, {1e6, 1, 0}});
    }
    const std::vector<Vec3> before = positions;
    detail::round_positions({Type::float32}, faces, positions);
    CHECK(positions == before);
}

TEST_CASE("results have the precision of the source as far as the format has it") {
    const StoredPrecision text = {Type::decimal, 7, 3};
    const auto type = [](const Asset& asset, ModelFormat format) {
        return detail::result_precision(asset, format).type;
    };
    CHECK(type(square_at(1, 1, {Type::float32}), ModelFormat::ply) == Type::float32);
    CHECK(type(square_at(1e6, 1, {Type::float32}), ModelFormat::ply) == Type::float32);
    CHECK(type(square_at(1, 1, {Type::float64}), ModelFormat::ply) == Type::unknown);
    CHECK(type(square_at(1, 1, {Type::float64}), ModelFormat::stl) == Type::float32);
    CHECK(type(square_at(1, 1, text), ModelFormat::obj) == Type::decimal);
    CHECK(type(square_at(1, 1, text), ModelFormat::ply) == Type::float32);
    // Whole metres far from the origin are floats, but points between them are not.
    CHECK(type(square_at(5121946, 20, text), ModelFormat::ply) == Type::unknown);
    CHECK(type(square_at(1, 1, text), ModelFormat::glb) == Type::unknown);
    CHECK(detail::loses_digits_as_floats(text, {{5121946, 0, 0}, {5121966, 20, 0}}));
    CHECK(!detail::loses_digits_as_floats(text, {{0, 0, 0}, {20, 20, 0}}));
}

TEST_CASE("the rounding of coordinates follows from their type and the digits of text") {
    constexpr double unit = std::numeric_limits<float>::epsilon();  // in the last place of 1
    const auto is = [](double value) { return Approx(value).epsilon(1e-9).margin(0); };
    const auto tolerance = [](const std::vector<Vec3>& positions, const StoredPrecision& stored, double of) {
        return detail::CoordinateRounding(positions, stored).tolerance(of);
    };
    // Binary floats, decimals with few digits, and what programs print for floats.
    CHECK(tolerance({{1, 0.5, -3}, {double{0.1f}, 0, 0}}, {Type::float32}, 4) == is(40 * unit));
    CHECK(tolerance({{0.1, 0.25, 1.5}}, {Type::decimal, 3, 2}, 4) == is(40 * unit));
    CHECK(tolerance({{0.33333334, 0.1, 1.2345678}}, {Type::decimal, 8, 8}, 4) == is(40 * unit));
    // Six decimal places, printed from floats and from doubles.
    CHECK(tolerance({{100.123459, 0.1, 1.234568}}, {Type::decimal, 9, 6}, 100) == is(1000 * unit));
    CHECK(tolerance({{4649776.123456, 0.1, 0.5}}, {Type::decimal, 13, 6}, 4649776) == is(2e-6));
    // Six significant digits.
    const std::vector<Vec3> six = {{1.23457, 123.457, 0.00123457}, {123457, 0, 7}};
    CHECK(tolerance(six, {Type::decimal, 6, 8}, 123) == is(2e-3));
    CHECK(tolerance(six, {Type::decimal, 6, 8}, 0.00123) == is(2e-8));
    // Doubles.
    const std::vector<Vec3> thirds = {{1.0 / 3, 2.0 / 3, 1e300}};
    CHECK(tolerance(thirds, {Type::float64}, 4) == is(40 * std::numeric_limits<double>::epsilon()));
    CHECK(tolerance(thirds, {Type::decimal, 17, 16}, 4) == is(40 * std::numeric_limits<double>::epsilon()));
    CHECK(tolerance({{0, 0, 0}}, {}, 0) == 0);
}
