#pragma once
/// \file
/// What all ways of baking share: the parts with their maps, and the result in the making.

#include <algorithm>
#include <string>
#include <vector>

#include "bake/transfer/corners.hpp"
#include "bake/transfer/material_groups.hpp"
#include "bake/transfer/corner_normals.hpp"
#include "faqem/bake.hpp"
#include "faqem/export.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/base/stopwatch.hpp"

namespace faqem::detail {

/// One call of bake().
class BakeJob {
public:
    BakeJob(const Asset& asset, const Options& how) : source(asset), options(how) {}
    BakeJob(const BakeJob&) = delete;

    const Asset& source;
    const Options& options;
    std::vector<SmallPart> parts;
    std::vector<CornerNormals> normals;  ///< by part
    LightAsset result;

    /// Tells how far the work is. \throws engine::Cancelled
    void go_on(Phase phase, double fraction) const {
        phase_ = phase;
        fraction_ = fraction;
        poll().now();
    }
    /// Asks while the work goes on from there.
    Poll poll() const { return options.progress ? Poll(asker_) : Poll(); }
    Workers workers() const { return {options.threads, poll()}; }

    void warn(std::string sentence) { result.report.warnings.push_back(std::move(sentence)); }

private:
    // What the callback is told next; no part of the work.
    mutable Phase phase_ = Phase::map;
    mutable double fraction_ = 0;
    mutable engine::Asker asker_{[this] { return options.progress(phase_, fraction_); }};
};

/// parallel_blocks() with a work that polls; `done` of `total` work was done before.
template <class Work>
void polled_blocks(const BakeJob& job, Phase phase, std::size_t size, std::size_t block, double done,
                   double total, Work&& work) {
    const std::size_t stretch = std::max(block, (size / 32 / block + 1) * block);
    for (std::size_t begin = 0; begin < size; begin += stretch) {
        job.go_on(phase, std::min(1.0, (done + static_cast<double>(begin)) / total));
        const std::size_t count = std::min(stretch, size - begin);
        parallel_blocks(count, block, job.workers(),
                        [&](std::size_t b, std::size_t e, Poll poll) { work(begin + b, begin + e, poll); });
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

/// The source's UVs, colours and images. \throws InputError  the small mesh does not carry them
void bake_keep(BakeJob& job);

/// No UVs, no images.
void bake_none(BakeJob& job);

}  // namespace faqem::detail
