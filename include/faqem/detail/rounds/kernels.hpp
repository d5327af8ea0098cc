#pragma once
/// \file
/// Arithmetic of rounds on plain arrays, in a form that compilers vectorise. The order of operations is fixed.

#include <array>
#include <cmath>

#include "faqem/engine/util/vectorised.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN
namespace rounds {

using Vector = std::array<float, 3>;

/// Sum of area x n n^T over planes: xx, xy, xz, yy, yz, zz.
using Planes = std::array<float, 6>;

inline Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline float dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline float length(const Vector& a) { return std::sqrt(dot(a, a)); }

/// The squared ratio of height and longest edge below which single precision does not hold the plane of a face.
inline constexpr float narrow = 1e-8f;

/// Values that are computed at once: as many as a vector register of AVX2 has.
inline constexpr int lanes = 8;

/// Edges whose costs are computed at once.
struct EdgeBatch {
    static constexpr int size = lanes;
    // Input: planes of both ends minus half of those of the shared faces; planes of the second end, and the vector
    // from the first end to it.
    float sum[6][size], second[6][size], t[3][size];
    // Output: the new vertex relative to the first end, and the cost.
    float x[3][size], cost[size];
    // Of the minimum: the term that makes the matrix regular, pivots, squared distance from the midpoint; costs.
    float regular[size], pivot_1[size], pivot_2[size], away[size], at_minimum[size];
    float half[size], at_first[size], at_middle[size], at_second[size];  ///< half: squared half length
};

/// Sets edge i from u to v, which is at t relative to u.
inline void put(EdgeBatch& b, int i, const Planes& u, const Planes& v, const Planes& shared,
                const Vector& t) {
    for (unsigned j = 0; j < 6; ++j) {
        b.second[j][i] = v[j];
        b.sum[j][i] = u[j] + v[j] - 0.5f * shared[j];
    }
    for (unsigned j = 0; j < 3; ++j) b.t[j][i] = t[j];
}

/// Minimum of the quadric of edge i, by an LDL^T decomposition of the matrix, which is made regular by a term that
/// pulls towards the midpoint. Without control flow, which compilers do not vectorise.
inline void minimise(EdgeBatch& b, int i) {
    const float tx = b.t[0][i], ty = b.t[1][i], tz = b.t[2][i];
    const float vxx = b.second[0][i], vxy = b.second[1][i], vxz = b.second[2][i], vyy = b.second[3][i],
                vyz = b.second[4][i], vzz = b.second[5][i];
    const float xx = b.sum[0][i], xy = b.sum[1][i], xz = b.sum[2][i], yy = b.sum[3][i], yz = b.sum[4][i],
                zz = b.sum[5][i];
    const float mx = vxx * tx + vxy * ty + vxz * tz, my = vxy * tx + vyy * ty + vyz * tz,
                mz = vxz * tx + vyz * ty + vzz * tz;
    const float c = mx * tx + my * ty + mz * tz;
    const float hx = 0.5f * tx, hy = 0.5f * ty, hz = 0.5f * tz;
    const float s = 1e-6f * (xx + yy + zz) + 1e-37f;
    const float d0 = xx + s, l10 = xy / d0, l20 = xz / d0;
    const float d1 = yy + s - l10 * xy, e = yz - l20 * xy, l21 = e / d1;
    const float d2 = zz + s - l20 * xz - l21 * e;
    const float r0 = mx + s * hx, r1 = my + s * hy, r2 = mz + s * hz;
    const float y1 = r1 - l10 * r0, y2 = r2 - l20 * r0 - l21 * y1;
    const float pz = y2 / d2, py = y1 / d1 - l21 * pz, px = r0 / d0 - l10 * py - l20 * pz;
    const float dx = px - hx, dy = py - hy, dz = pz - hz;
    const auto cost_at = [&](float x, float y, float z) {
        const float qx = xx * x + xy * y + xz * z, qy = xy * x + yy * y + yz * z,
                    qz = xz * x + yz * y + zz * z;
        return (qx - 2 * mx) * x + (qy - 2 * my) * y + (qz - 2 * mz) * z + c;
    };
    b.x[0][i] = px, b.x[1][i] = py, b.x[2][i] = pz;
    b.regular[i] = s, b.pivot_1[i] = d1, b.pivot_2[i] = d2;
    b.away[i] = dx * dx + dy * dy + dz * dz;
    b.half[i] = hx * hx + hy * hy + hz * hz;
    b.at_minimum[i] = cost_at(px, py, pz);
    b.at_first[i] = c;
    b.at_middle[i] = cost_at(hx, hy, hz);
    b.at_second[i] = cost_at(tx, ty, tz);
}

/// Position and cost of edge i after minimise(): an end that is in all planes up to rounding, so that flat parts stay
/// flat, else the minimum, or where the arithmetic fails (a NaN does), the best of the midpoint and both ends.
inline void choose(EdgeBatch& b, int i) {
    const float rounding = 4 * b.regular[i] * b.half[i], least_pivot = 0.3f * b.regular[i];
    float part = 0.5f, best = b.at_middle[i];
    if (b.at_first[i] < best) part = 0, best = b.at_first[i];
    if (b.at_second[i] < best) part = 1, best = b.at_second[i];
    const bool is_first = b.at_first[i] <= rounding, is_second = !is_first && b.at_second[i] <= rounding;
    if (is_first) part = 0, best = b.at_first[i];
    if (is_second) part = 1, best = b.at_second[i];
    if (!is_first && !is_second && b.pivot_1[i] > least_pivot && b.pivot_2[i] > least_pivot &&
        b.away[i] <= 64 * b.half[i] && b.at_minimum[i] <= best)
        best = b.at_minimum[i];
    else
        for (int k = 0; k < 3; ++k) b.x[k][i] = part * b.t[k][i];
    b.cost[i] = best < 1e-37f ? 1e-37f : best;
}

inline void solve(EdgeBatch& b, int i) {
    minimise(b, i);
    choose(b, i);
}

inline void solve(EdgeBatch& b) {
    for (int i = 0; i < EdgeBatch::size; ++i) minimise(b, i);
    for (int i = 0; i < EdgeBatch::size; ++i) choose(b, i);
}

/// The faces around a pair that remain after its collapse: face i has the corners centre, ring[i] and ring[i + 1],
/// counterclockwise. Positions are relative to the first vertex of the pair.
struct Star {
    static constexpr int most = 56;
    static constexpr int room = 64;
    float ring[3][room + 1];                ///< ring[size] is ring[0]
    float centre[3][room];                  ///< before the collapse, per face
    float before[6][room], after[6][room];  ///< planes
    float normal[3][room];                  ///< after the collapse, times twice the area
    float before_length[room], after_length[room], along[room], slack[room];
};

/// Computes the planes of `count` faces around the new vertex x (rounded up to a multiple of `lanes`).
inline void compute_planes(Star& s, int count, const float (&x)[3]) {
    const float px = x[0], py = x[1], pz = x[2];
    float n[3][lanes];
    for (int begin = 0; begin < count; begin += lanes) {
        for (int j = 0; j < lanes; ++j) {
            const int i = begin + j;
            const float ax = s.ring[0][i], ay = s.ring[1][i], az = s.ring[2][i];
            const float bx = s.ring[0][i + 1], by = s.ring[1][i + 1], bz = s.ring[2][i + 1];
            const float ex = bx - ax, ey = by - ay, ez = bz - az;
            const float ox = ax - s.centre[0][i], oy = ay - s.centre[1][i], oz = az - s.centre[2][i];
            const float qx = ax - px, qy = ay - py, qz = az - pz;
            n[0][j] = oy * ez - oz * ey, n[1][j] = oz * ex - ox * ez, n[2][j] = ox * ey - oy * ex;
            const float mx = qy * ez - qz * ey, my = qz * ex - qx * ez, mz = qx * ey - qy * ex;
            s.normal[0][i] = mx, s.normal[1][i] = my, s.normal[2][i] = mz;
            s.before_length[i] = n[0][j] * n[0][j] + n[1][j] * n[1][j] + n[2][j] * n[2][j];
            s.after_length[i] = mx * mx + my * my + mz * mz;
            s.along[i] = n[0][j] * mx + n[1][j] * my + n[2][j] * mz;
            const float e2 = ex * ex + ey * ey + ez * ez, q2 = qx * qx + qy * qy + qz * qz;
            const float longest = e2 > q2 ? e2 : q2;
            s.slack[i] = s.after_length[i] - narrow * longest * longest;
        }
        for (int j = 0; j < lanes; ++j) {
            s.before_length[begin + j] = std::sqrt(s.before_length[begin + j]);
            s.after_length[begin + j] = std::sqrt(s.after_length[begin + j]);
        }
        for (int j = 0; j < lanes; ++j) {
            const int i = begin + j;
            const float wn = 0.5f / (s.before_length[i] + 1e-30f);
            const float wm = 0.5f / (s.after_length[i] + 1e-30f);
            const float nx = wn * n[0][j], ny = wn * n[1][j], nz = wn * n[2][j];
            const float kx = s.normal[0][i], ky = s.normal[1][i], kz = s.normal[2][i];
            const float mx = wm * kx, my = wm * ky, mz = wm * kz;
            s.before[0][i] = nx * n[0][j], s.before[1][i] = nx * n[1][j], s.before[2][i] = nx * n[2][j];
            s.before[3][i] = ny * n[1][j], s.before[4][i] = ny * n[2][j], s.before[5][i] = nz * n[2][j];
            s.after[0][i] = mx * kx, s.after[1][i] = mx * ky, s.after[2][i] = mx * kz;
            s.after[3][i] = my * ky, s.after[4][i] = my * kz, s.after[5][i] = mz * kz;
        }
    }
}

/// Whether a face loses its area, or its normal turns by more than a cosine allows.
inline bool turns(const Star& s, int count, float least_cosine) {
    for (int i = 0; i < count; ++i) {
        if (!(s.along[i] >= least_cosine * s.before_length[i] * s.after_length[i])) return true;
        if (!(s.slack[i] > 0)) return true;
    }
    return false;
}

/// The cosine below which the normals of two faces at an edge make it a fold.
inline constexpr float fold_cosine = -0.9f;

/// Whether an edge of the new vertex is a fold.
inline bool folds_inside(const Star& s, int count) {
    int last = count - 1;
    for (int i = 0; i < count; last = i++) {
        const float along = s.normal[0][i] * s.normal[0][last] + s.normal[1][i] * s.normal[1][last] +
                            s.normal[2][i] * s.normal[2][last];
        if (along < fold_cosine * s.after_length[i] * s.after_length[last]) return true;
    }
    return false;
}

}  // namespace rounds
FAQEM_DETAIL_END
