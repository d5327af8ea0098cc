#pragma once
/// \file
/// The parts of the example urn. `detail` scales the number of grid lines; 1 gives about 276,000 faces.

#include <vector>

#include "model_grid.hpp"

namespace model {

/// A point of the body's profile curve, by arc length in [0, 1]: distance from the axis, and height.
struct ProfilePoint {
    double radius, height;
    double normal_out, normal_up;  ///< unit normal: away from the axis, and upwards
};
ProfilePoint profile(double arc);

/// The body, a carved surface of revolution from the centre of the foot to an open, scalloped rim.
Grid body(double detail);

/// Two handles with vines around them, leaves below the belly and feathers on the shoulder.
std::vector<Grid> ornaments(double detail);

/// Colour of the body (sRGB) at an angle in radians and an arc length of the profile in [0, 1].
Vec3 paint_body(double angle, double arc);

/// Height of the carving above the profile at an angle and an arc length, model units.
double relief(double angle, double arc);

/// The ornamental bands of the body, from bottom to top.
namespace band {
enum { base, foot, knot, petals, frieze, shoulder, neck, lip, count };
}
/// Arc length in [0, 1] at which a band begins; band::count gives the end of the last one.
double band_begin(int which);

// Enamel colours, sRGB.
inline constexpr Vec3 ivory = {0.93, 0.89, 0.79}, cobalt = {0.09, 0.17, 0.42}, night = {0.05, 0.08, 0.20},
                      gold = {0.83, 0.62, 0.22}, umber = {0.29, 0.16, 0.08}, coral = {0.76, 0.25, 0.17},
                      jade = {0.17, 0.44, 0.36}, sky = {0.42, 0.62, 0.78};

}  // namespace model
