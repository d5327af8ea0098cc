#pragma once
/// \file
/// State that all kinds of baking share: the parts with their surface maps, and the result.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "bake/texture/image_choice.hpp"
#include "bake/texture/pending_images.hpp"
#include "bake/transfer/corner_normals.hpp"
#include "bake/transfer/corners.hpp"
#include "bake/transfer/material_groups.hpp"
#include "bake/transfer/texture_sampling.hpp"
#include "faqem/bake.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "faqem/detail/base/time_limit.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// State of one call of bake().
class BakeJob {
public:
    BakeJob(const Asset& asset, const Options& how) : source(asset), options(how) {}
    BakeJob(const BakeJob&) = delete;

    const Asset& source;
    const Options& options;
    std::vector<BakePart> parts;
    std::vector<CornerNormals> normals;  ///< by part
    /// By part: whether baking leaves it empty in the result, because it is added later: it keeps its vertices, or
    /// its UVs.
    std::vector<std::uint8_t> skipped;
    DecodedImages images;  ///< those of the source that were needed
    SimplifiedAsset result;
    std::vector<PendingImage> pending;  ///< images of the result that are not encoded yet
    PicturePsnr pictures;               ///< of the parts that choose_kept_uvs() has compared
    /// Whether the UVs and images of the source are kept because the time was over before new textures were complete.
    bool is_late = false;

    /// Calls the progress callback.
    /// \param fraction  of the phase, 0 to 1
    /// \throws engine::Cancelled if the callback cancels or the time is over, and whatever it throws
    void report_progress(Phase phase, double fraction) const {
        set_progress(phase, fraction);
        cancellation_check().now();
    }
    /// Sets what the next call of the progress callback is told. On the calling thread only.
    void set_progress(Phase phase, double fraction) const {
        phase_ = phase;
        fraction_ = fraction;
    }
    /// Check for loops on the calling thread. It passes on the progress that was reported last.
    CancellationCheck cancellation_check() const { return CancellationCheck(monitor_); }
    Workers workers() const { return {options.threads, cancellation_check()}; }

    /// Whether images of ImageFormat::automatic may be WebP: glTF needs an extension for it, which the source has then.
    bool tries_webp() const {
        return source.source &&
               std::any_of(source.images.begin(), source.images.end(),
                           [](const Image& image) { return image.mime_type == "image/webp"; });
    }

    /// Does work that Options::max_seconds may stop; other work is always completed.
    /// \return false if the time was over before the work was complete
    /// \throws engine::Cancelled if the callback cancels, and whatever it and `work` throw
    template <class Work>
    bool run_in_time(Work&& work) {
        bool is_complete = true;
        monitor_.set_deadline(deadline_);
        try {
            cancellation_check().now();
            work();
        } catch (const engine::Cancelled& stopped) {
            if (stopped.reason == StopReason::cancelled) throw;
            is_complete = false;
        }
        monitor_.set_deadline(no_deadline);
        return is_complete;
    }

    void warn(std::string sentence) { result.report.warnings.push_back(std::move(sentence)); }

private:
    Deadline deadline_ = deadline_of(options);
    // Arguments of the next call of the callback.
    mutable Phase phase_ = Phase::map;
    mutable double fraction_ = 0;
    mutable engine::ProgressMonitor monitor_{
        [this] { return options.progress ? options.progress(phase_, fraction_) : Continue::yes; }};
};

/// Makes the surface maps and the normals of all parts that are not skipped.
/// \param simplified  by part of the source; borrowed by the job
void map_parts(BakeJob& job, std::span<const SimplifyResult> simplified);

/// parallel_blocks() that reports progress.
/// \param size   number of elements
/// \param done   number of elements that were processed before
/// \param total  number of elements that `done` and `size` are part of
/// \param work   called as work(begin, end, check_cancelled)
template <class Work>
void parallel_blocks_with_progress(const BakeJob& job, Phase phase, std::size_t size, std::size_t block,
                                   double done, double total, Work&& work) {
    job.report_progress(phase, std::min(1.0, done / total));
    const std::thread::id caller = std::this_thread::get_id();
    std::atomic<std::size_t> finished{0};
    parallel_blocks(size, block, job.workers(),
                    [&](std::size_t begin, std::size_t end, CancellationCheck check_cancelled) {
                        work(begin, end, check_cancelled);
                        const std::size_t now = finished += end - begin;
                        // The callback is called on this thread only, after each block.
                        if (std::this_thread::get_id() == caller)
                            job.set_progress(phase, std::min(1.0, (done + static_cast<double>(now)) / total));
                    });
}

/// Bakes new images with a new atlas.
/// \return false, without changing anything, if a page has more charts than texels or, for an atlas by
///     triangle, more triangles
bool bake_pages(BakeJob& job);

/// Bakes the base colour into vertex colours. The result has no textures.
void bake_vertex(BakeJob& job);

/// Keeps the source's UVs, vertex colours and images.
/// \throws InputError if the simplified mesh has no UVs and vertex colours, unless job.is_late
void bake_keep(BakeJob& job);

/// Removes UVs, vertex colours and images.
void bake_none(BakeJob& job);

}  // namespace faqem::detail
