#pragma once
/// \file
/// Simplification of an asset within Options::max_error.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "asset/scene/position_rounding.hpp"
#include "faqem/bake.hpp"
#include "faqem/detail/simplify/error_bound_search.hpp"
#include "scene/scene_size.hpp"

namespace faqem::detail {

/// What is simplified within an error of the original.
enum class Simplified { original, finer_level };

/// The original parts of an asset, to which several results can be compared.
class ReferenceParts {
public:
    /// \param source   the asset; not needed after construction
    /// \param options  options of the runs; must outlive this
    /// \throws InputError if an index is out of range, and whatever `context` throws
    ReferenceParts(const Asset& source, const Options& options, const RunContext& context = {});

    const SceneSize& size() const { return size_; }
    /// Number of faces of all parts.
    std::uint64_t faces() const { return faces_; }
    /// Measures the largest distance of all parts from their originals, in units of the scene. It includes the rounding
    /// of positions that Options::quantize demands.
    /// \param simplified  one result per part
    /// \param allowed     allowed distance, in units of the scene
    /// \param mode        as distance()
    /// \throws OptionError  the rounding alone may be as large as the allowed distance
    /// \throws whatever `context` throws
    MeasuredDistance operator()(const SimplifiedParts& simplified, double allowed, MeasureMode mode,
                                const RunContext& context) const;

    /// The smallest result for a part that was found without a search for its face count, or nothing.
    /// \param part     its index
    /// \param view     the part as the input of simplify()
    /// \param allowed  as above
    /// \param what     the original part, or another surface near to it
    /// \param options  of the part
    std::optional<SimplifyResult> run_within(std::size_t part, const MeshView& view, double allowed,
                                             Simplified what, const Options& options,
                                             const RunContext& context) const;

private:
    double allowed_for(std::size_t part, double allowed) const;

    const Options& options_;
    StoredPrecision precision_;  // to which results are rounded
    SceneSize size_;
    double rounding_;  // largest distance by which positions are rounded afterwards, units of the scene
    std::vector<DistanceReference> originals_;
    std::uint64_t faces_ = 0;
};

/// run_within() for all parts of an asset; empty if it is not possible for one of them.
/// \param source    must outlive the function that is returned, as `measured`
/// \param measured  made from the original
RunWithin<SimplifiedParts> parts_within(const Asset& source, const ReferenceParts& measured,
                                        const Options& options, Simplified what = Simplified::original);

/// simplify_parts() with Options::max_error: each part uses the error everywhere, or, if that is not possible, there is a
/// search over the face count of the whole asset, with one call of simplify_welded_parts() per attempt.
/// \param source   must have passed check_asset()
/// \param options  must be valid, with max_error set
SimplifiedParts simplify_parts_within_error(const Asset& source, const Options& options,
                                            const RunContext& context);

}  // namespace faqem::detail
