#pragma once
/// \file
/// What all ways of baking share: the parts with their maps, and the result in the making.

#include <algorithm>
#include <string>
#include <vector>

#include "bake/transfer/corner_normals.hpp"
#include "bake/transfer/corners.hpp"
#include "bake/transfer/material_groups.hpp"
#include "faqem/bake.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// One call of bake().
class BakeJob {
public:
    BakeJob(const Asset& asset, const Options& how) : source(asset), options(how) {}
    BakeJob(const BakeJob&) = delete;

    const Asset& source;
    const Options& options;
    std::vector<BakePart> parts;
    std::vector<CornerNormals> normals;  ///< by part
    SimplifiedAsset result;

    /// Tells how far the work is. \throws engine::Cancelled
    void report_progress(Phase phase, double fraction) const {
        phase_ = phase;
        fraction_ = fraction;
        check_cancelled().now();
    }
    /// Asks while the work goes on from there.
    CancellationCheck cancellation_check() const {
        return options.progress ? CancellationCheck(monitor_) : CancellationCheck();
    }
    Workers workers() const { return {options.threads, check_cancelled()}; }

    void warn(std::string sentence) { result.report.warnings.push_back(std::move(sentence)); }

private:
    // What the callback is told next; no part of the work.
    mutable Phase phase_ = Phase::map;
    mutable double fraction_ = 0;
    mutable engine::ProgressMonitor monitor_{[this] { return options.progress(phase_, fraction_); }};
};

/// parallel_blocks() with a work that polls; `done` of `total` work was done before.
template <class Work>
void parallel_blocks_with_progress(const BakeJob& job, Phase phase, std::size_t size, std::size_t block,
                                   double done, double total, Work&& work) {
    const std::size_t stretch = std::max(block, (size / 32 / block + 1) * block);
    for (std::size_t begin = 0; begin < size; begin += stretch) {
        job.report_progress(phase, std::min(1.0, (done + static_cast<double>(begin)) / total));
        const std::size_t count = std::min(stretch, size - begin);
        parallel_blocks(count, block, job.workers(),
                        [&](std::size_t b, std::size_t e, CancellationCheck check_cancelled) {
                            work(begin + b, begin + e, check_cancelled);
                        });
    }
}

/// `material 'red'`, or by number where it has no name.
std::string material_title(const Asset& asset, Index material);

/// `part 'leg'`, or by number where it has no name.
FAQEM_EXPORT std::string part_title(const Asset& asset, std::size_t part);

/// A new atlas and new images. \return false, with nothing done, if there are more triangles than texels
bool bake_pages(BakeJob& job);

/// Colours on vertices.
void bake_vertex(BakeJob& job);

/// The source's UVs, colours and images. \throws InputError  the simplified mesh does not carry them
void bake_keep(BakeJob& job);

/// No UVs, no images.
void bake_none(BakeJob& job);

}  // namespace faqem::detail
