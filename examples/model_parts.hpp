#pragma once
/// \file
/// The parts of the example urn. `detail` scales the number of grid lines; 1 gives about 220,000 faces in
/// all.

#include <vector>

#include "model_grid.hpp"

namespace model {

/// Where the turned body is at an arc length in [0, 1] of its profile: distance from the axis and height.
struct ProfilePoint {
    double radius, height;
    double normal_out, normal_up;  ///< unit
};
ProfilePoint profile(double arc);

/// The turned and carved body: from the middle of the foot up to an open, scalloped rim.
Grid body(double detail);

/// Handles, the vines around them, leaves below the belly and feathers on the shoulder.
std::vector<Grid> ornaments(double detail);

/// The body's painting at an angle in radians and an arc length of the profile in [0, 1].
Vec3 paint_body(double angle, double arc);

/// How far the carving rises above the profile at such a place, in model units.
double relief(double angle, double arc);

/// Ends of the body's bands as arc lengths: foot, knot, petals, frieze, shoulder, neck and lip lie between
/// them.
namespace band {
enum { base, foot, knot, petals, frieze, shoulder, neck, lip, count };
}
double band_begin(int which);

// Enamel colours, sRGB.
inline constexpr Vec3 ivory = {0.93, 0.89, 0.79}, cobalt = {0.09, 0.17, 0.42}, night = {0.05, 0.08, 0.20},
                      gold = {0.83, 0.62, 0.22}, umber = {0.29, 0.16, 0.08}, coral = {0.76, 0.25, 0.17},
                      jade = {0.17, 0.44, 0.36}, sky = {0.42, 0.62, 0.78};

}  // namespace model
