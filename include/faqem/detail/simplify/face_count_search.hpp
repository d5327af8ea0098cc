#pragma once
/// \file
/// Chooses the face counts to try in the search for the smallest mesh within an error.

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "faqem/detail/simplify/run.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

/// A bracketing search over target face counts. The error is not a monotone function of the target, and a run
/// may end above or far below its target. First a bracket in the logarithms of face count and error is
/// narrowed to 2%, with at most `bracket_runs` runs (regula falsi and bisection); then a few counts below its
/// accepted end are tried. Deterministic: depends only on the arguments of its functions.
class FAQEM_EXPORT FaceCountSearch {
public:
    static constexpr std::uint64_t bracket_runs = 8;
    /// Counts that are tried after the bracket, as ratios of the smallest accepted count.
    static constexpr std::array<double, 4> refinement_ratios = {0.6, 0.8, 0.9, 0.95};
    static constexpr std::uint64_t max_runs = bracket_runs + refinement_ratios.size();

    /// \param faces    face count of the original, which is assumed to be within the error
    /// \param allowed  maximum error, >= 0
    FaceCountSearch(std::uint64_t faces, double allowed);

    /// The next target, lower than the face count of the best result; nullopt when the search has ended.
    std::optional<std::uint64_t> next();

    /// Adds the result of the run with the last target.
    /// \param faces   face count of the result
    /// \param error   error of the result; a lower bound is sufficient if `within` is false
    /// \param within  whether the result is within the allowed error
    void add_result(std::uint64_t faces, double error, bool within);

private:
    /// One end of the bracket.
    struct End {
        double faces = 0;
        std::optional<double> error = {};  ///< nullopt: not measured
    };

    bool is_bracketing() const;
    double guess() const;

    double allowed_;
    End good_, bad_;
    double reachable_ = static_cast<double>(min_target_faces);     ///< smallest face count that a run reaches
    double last_width_ = std::numeric_limits<double>::infinity();  ///< width of the bracket, in logarithms
    std::uint64_t target_ = 0;
    std::uint64_t runs_ = 0;  ///< number of runs that narrow the bracket
    std::size_t step_ = 0;    ///< next entry of `refinement_ratios`
};

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/face_count_search-inl.hpp"
#endif
