#pragma once
/// \file
/// How far images and pictures of models differ.

#include <cmath>

namespace faqem::detail {

/// Peak signal-to-noise ratio of a mean squared difference of values in [0, 1], in dB; infinity if nothing differs.
/// \param unseen  mean squared difference that is added, since it is not seen: limits the ratio
inline double psnr(double mean_square, double unseen = 0) { return -10 * std::log10(mean_square + unseen); }

/// The mean squared difference of a ratio in dB.
inline double mean_square_of(double psnr) { return std::pow(10, -psnr / 10); }

/// A mean squared difference that is not seen in pictures: 50 dB.
inline constexpr double invisible_difference = 1e-5;

/// Mean squared differences of sRGB values in [0, 1], over the pixels that show one of two models.
struct PictureDifference {
    double unlit = 0;  ///< base colours
    double lit = 0;    ///< with light; equal to `unlit` where lit pictures are not compared

    /// Of both kinds of pictures together.
    double sum() const { return unlit + lit; }

    /// Differences of different causes, or sums of squares, add up.
    PictureDifference& operator+=(const PictureDifference& other) {
        unlit += other.unlit;
        lit += other.lit;
        return *this;
    }
};

inline PictureDifference operator+(PictureDifference a, const PictureDifference& b) { return a += b; }
inline PictureDifference operator-(const PictureDifference& a, const PictureDifference& b) {
    return {a.unlit - b.unlit, a.lit - b.lit};
}

/// A share of a difference.
inline PictureDifference operator*(const PictureDifference& difference, double factor) {
    return {difference.unlit * factor, difference.lit * factor};
}

}  // namespace faqem::detail
