#pragma once
/// \file
/// Which face counts to try on the way to the smallest mesh within an error.

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "faqem/detail/simplify/target.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// A search over targets where neither the error nor the face count follows the target exactly: the error is
/// not monotone, and a run may end above its target or far below. First a bracket in the logarithms of count
/// and error is narrowed to 2%, with at most `bracket_runs` runs; then a few counts below its good end are
/// tried. Depends on nothing but what it is told.
class FAQEM_EXPORT FaceCountSearch {
public:
    static constexpr std::uint64_t bracket_runs = 8;
    /// Counts that are tried in the end, as shares of the smallest good one.
    static constexpr std::array<double, 4> refinement_ratios = {0.6, 0.8, 0.9, 0.95};
    static constexpr std::uint64_t max_runs = bracket_runs + refinement_ratios.size();

    /// \param faces    of the original, which is taken to be within
    /// \param allowed  largest error
    FaceCountSearch(std::uint64_t faces, double allowed);

    /// The next target, fewer faces than the best result has; nothing when the search has ended.
    std::optional<std::uint64_t> next();

    /// What the run with the last target gave.
    /// \param error   of the result; where it is not within, a lower bound will do
    /// \param within  whether it counts
    void add_result(std::uint64_t faces, double error, bool within);

private:
    /// One end of the bracket.
    struct End {
        double faces = 0;
        std::optional<double> error = {};  ///< nothing: not measured
    };

    bool is_bracketing() const;
    double guess() const;

    double allowed_;
    End good_, bad_;
    double reachable_ = static_cast<double>(min_target_faces);     ///< fewer faces do not come out
    double last_width_ = std::numeric_limits<double>::infinity();  ///< of the bracket, in logarithms
    std::uint64_t target_ = 0;
    std::uint64_t runs_ = 0;  ///< to narrow the bracket
    std::size_t step_ = 0;    ///< into `refinement_ratios`
};

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/face_count_search-inl.hpp"
#endif
