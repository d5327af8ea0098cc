#pragma once
/// \file
/// Quadric Q(p) = p^T A p + 2 b^T p + c: a weighted sum of squared distances to planes (Garland and
/// Heckbert 1997; paper eq. 1).

#include <optional>

#include "faqem/engine/mesh/vector.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// A symmetric 3 x 3 matrix, by default zero.
struct Symmetric3 {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

    /// Adds w n n^T.
    void add(const Vector3& n, double w) {
        const Vector3 m = w * n;
        xx += m.x() * n.x(), xy += m.x() * n.y(), xz += m.x() * n.z();
        yy += m.y() * n.y(), yz += m.y() * n.z(), zz += m.z() * n.z();
    }
    /// Adds w times another matrix.
    void add(const Symmetric3& o, double w) {
        xx += w * o.xx, xy += w * o.xy, xz += w * o.xz, yy += w * o.yy, yz += w * o.yz, zz += w * o.zz;
    }

    /// The product with a vector.
    Vector3 apply(const Vector3& p) const {
        return {xx * p.x() + xy * p.y() + xz * p.z(), xy * p.x() + yy * p.y() + yz * p.z(),
                xz * p.x() + yz * p.y() + zz * p.z()};
    }

    double trace() const { return xx + yy + zz; }
    /// \pre the determinant is not zero
    Symmetric3 inverse() const {
        const double cxx = yy * zz - yz * yz, cxy = xz * yz - xy * zz, cxz = xy * yz - xz * yy;
        const double cyy = xx * zz - xz * xz, cyz = xy * xz - xx * yz, czz = xx * yy - xy * xy;
        const double f = 1 / (xx * cxx + xy * cxy + xz * cxz);
        return {f * cxx, f * cxy, f * cxz, f * cyy, f * cyz, f * czz};
    }
};

/// Coefficients of a quadric: A, b and c. A default-constructed quadric is zero.
struct Quadric : Symmetric3 {
    Vector3 b = Vector3::Zero();
    double c = 0;

    /// The quadric w (n.p + d)^2.
    /// \param n  normal of the plane; need not have unit length, and the paper's boundary planes do not
    /// \param d  offset of the plane
    /// \param w  weight
    static Quadric plane(const Vector3& n, double d, double w) {
        return {{w * n.x() * n.x(), w * n.x() * n.y(), w * n.x() * n.z(), w * n.y() * n.y(),
                 w * n.y() * n.z(), w * n.z() * n.z()},
                w * d * n,
                w * d * d};
    }

    /// The quadric of the plane with normal `n` through `point`, with weight `w`.
    static Quadric plane_through(const Vector3& n, const Vector3& point, double w) {
        return plane(n, -n.dot(point), w);
    }

    /// The quadric w/2 |e x p + t|^2 with e = b - a, t = a x b: w/2 times the squared doubled area of the
    /// triangle with corners a, b and p (Lindstrom and Turk 1998; paper eq. 11).
    /// \param a, b  ends of the edge
    /// \param w     weight
    static Quadric edge_area(const Vector3& a, const Vector3& b, double w) {
        const Vector3 e = b - a;
        const Vector3 t = a.cross(b);
        const double h = 0.5 * w;
        const double s = e.squaredNorm();
        // |e x p|^2 = p^T (|e|^2 I - e e^T) p and t.(e x p) = (t x e).p
        Quadric q;
        q.xx = h * (s - e.x() * e.x());
        q.xy = -h * e.x() * e.y();
        q.xz = -h * e.x() * e.z();
        q.yy = h * (s - e.y() * e.y());
        q.yz = -h * e.y() * e.z();
        q.zz = h * (s - e.z() * e.z());
        q.b = h * t.cross(e);
        q.c = h * t.squaredNorm();
        return q;
    }

    Quadric& operator+=(const Quadric& o) {
        xx += o.xx, xy += o.xy, xz += o.xz, yy += o.yy, yz += o.yz, zz += o.zz;
        b += o.b;
        c += o.c;
        return *this;
    }
    friend Quadric operator+(Quadric l, const Quadric& r) { return l += r; }

    Quadric& operator*=(double s) {
        xx *= s, xy *= s, xz *= s, yy *= s, yz *= s, zz *= s;
        b *= s;
        c *= s;
        return *this;
    }

    /// The same quadric in coordinates with the given origin: q.relative_to(o)(p) = q(p + o).
    Quadric relative_to(const Vector3& o) const {
        Quadric q = *this;
        const Vector3 at = apply(o);
        q.b += at;
        q.c += 2 * b.dot(o) + o.dot(at);
        return q;
    }

    /// Evaluates Q(p). The result may be slightly negative due to rounding.
    double operator()(const Vector3& p) const { return p.dot(apply(p)) + 2 * b.dot(p) + c; }

    /// The point that minimises Q, or nothing if A is nearly singular: det A <= 1e-9 (trace A)^3. This test
    /// is independent of the scale of the model.
    std::optional<Vector3> minimum() const {
        const double cxx = yy * zz - yz * yz;
        const double cxy = xz * yz - xy * zz;
        const double cxz = xy * yz - xz * yy;
        const double det = xx * cxx + xy * cxy + xz * cxz;
        if (!(det > 1e-9 * trace() * trace() * trace())) return std::nullopt;
        const double cyy = xx * zz - xz * xz;
        const double cyz = xy * xz - xx * yz;
        const double czz = xx * yy - xy * xy;
        const Vector3 p(-(cxx * b.x() + cxy * b.y() + cxz * b.z()) / det,
                        -(cxy * b.x() + cyy * b.y() + cyz * b.z()) / det,
                        -(cxz * b.x() + cyz * b.y() + czz * b.z()) / det);
        if (!p.allFinite()) return std::nullopt;
        return p;
    }
};

FAQEM_ENGINE_END
