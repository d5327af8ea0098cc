#include "bake/atlas/charts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <queue>
#include <tuple>
#include <utility>

#include "bake/atlas/parametrization.hpp"
#include "bake/atlas/segmentation.hpp"
#include "faqem/detail/base/portable_math.hpp"

namespace faqem::detail {
namespace {

constexpr double max_stretch = 1.06;
// Work limits, in flattenings of every face of the region or page.
constexpr std::uint64_t work_per_region = 24, work_for_merging = 32;

// Length of the diagonal of the chart's bounding box.
double bounding_box_diagonal(const Chart& chart) {
    Box2 box;
    for (const Triangle2& t : chart.points)
        for (const Point2& p : t) box.add(p);
    return length(box.high - box.low);
}

// \param page_side  of a square with the texels of all faces
bool is_acceptable(const Parametrization& parametrization, std::span<const PageTriangle> all,
                   double page_side) {
    // The chart of all faces may fill a page, which is square or half as high as wide.
    const double max_diagonal = (parametrization.chart.faces.size() == all.size() ? 1.6 : 0.9) * page_side;
    return parametrization.outcome == Parametrization::Outcome::valid &&
           parametrization.chart.stretch <= max_stretch &&
           bounding_box_diagonal(parametrization.chart) <= max_diagonal;
}

// Divides one region into charts.
Charts parametrize_region(std::span<const PageTriangle> all, const std::vector<Index>& region,
                          double page_side, const RunContext& context) {
    Charts result;
    std::uint64_t work = work_per_region * parametrization_work_per_face * region.size();
    std::vector<std::vector<Index>> waiting = {region};
    while (!waiting.empty()) {
        std::vector<Index> faces = std::move(waiting.back());
        waiting.pop_back();
        context.count(faces.size());
        if (faces.size() > 1 && work == 0) {
            result.faces_over_work_limit += faces.size();
            for (Index f : faces) waiting.push_back({f});
            continue;
        }
        Parametrization parametrization = parametrize(all, faces, work);
        if (faces.size() == 1 || is_acceptable(parametrization, all, page_side)) {
            result.charts.push_back(std::move(parametrization.chart));
            continue;
        }
        const std::vector<Index>& flipped = parametrization.flipped_faces;
        if (!flipped.empty() && 4 * flipped.size() <= faces.size()) {
            std::vector<Index> rest;
            std::set_difference(faces.begin(), faces.end(), flipped.begin(), flipped.end(),
                                std::back_inserter(rest));
            for (const std::vector<Index>& part : {rest, flipped})
                for (std::vector<Index>& group : connected_subsets(all, part))
                    waiting.push_back(std::move(group));
            continue;
        }
        for (std::vector<Index>& half : bisect(all, faces)) waiting.push_back(std::move(half));
    }
    return result;
}

// Merges neighbouring charts. Pairs come in descending order of the shared boundary length divided by the
// smaller perimeter.
class ChartMerging {
public:
    ChartMerging(std::span<const PageTriangle> all, std::vector<Chart> charts, double page_side,
                 const RunContext& context)
        : all_(all),
          charts_(std::move(charts)),
          chart_of_face_(all.size()),
          page_side_(page_side),
          context_(context) {
        for (std::size_t i = 0; i < charts_.size(); ++i) assign_faces(static_cast<Index>(i));
        for (std::size_t i = 0; i < charts_.size(); ++i)
            enqueue_candidates(static_cast<Index>(i), Neighbours::later);
    }

    std::vector<Chart> run() {
        std::uint64_t work = work_for_merging * parametrization_work_per_face * all_.size();
        while (!queue_.empty() && work > 0) {
            const MergeCandidate merge = queue_.top();
            queue_.pop();
            if (!is_valid(merge)) continue;
            Parametrization parametrization = merged_parametrization(merge, work);
            if (!is_acceptable(parametrization, all_, page_side_)) continue;
            charts_[merge.a] = charts_[merge.b] = {};
            charts_.push_back(std::move(parametrization.chart));
            assign_faces(static_cast<Index>(charts_.size() - 1));
            enqueue_candidates(static_cast<Index>(charts_.size() - 1), Neighbours::all);
        }
        std::erase_if(charts_, [](const Chart& c) { return c.faces.empty(); });
        return std::move(charts_);
    }

private:
    struct MergeCandidate {
        double share;
        Index a, b;

        bool operator<(const MergeCandidate& o) const {  // largest share on top, ties by smallest indices
            return std::tuple(share, o.a, o.b) < std::tuple(o.share, a, b);
        }
    };
    enum class Neighbours { later, all };
    struct SpeculativeMerge {
        MergeCandidate merge;
        std::uint64_t allowed, left;  // work limit before and after the attempt
        Parametrization parametrization;
    };

    bool is_valid(const MergeCandidate& merge) const {
        const std::size_t a = charts_[merge.a].faces.size(), b = charts_[merge.b].faces.size();
        return a > 0 && b > 0 && a + b <= max_faces_per_chart;
    }

    // Parametrizes the next candidates in parallel and ahead of time: most of these results will be used.
    Parametrization merged_parametrization(const MergeCandidate& merge, std::uint64_t& work) {
        auto found = find_speculative(merge);
        if (found == speculative_merges_.end()) {
            speculate(merge, work);
            found = find_speculative(merge);
        }
        SpeculativeMerge speculative = std::move(*found);
        speculative_merges_.erase(found);
        const std::uint64_t used = speculative.allowed - speculative.left;
        // An attempt that reached its work limit, or used at least as much as is left now, is repeated with
        // what is left, so that the result does not depend on the number of threads.
        if (speculative.left == 0 || used >= work) return parametrize_merge(merge, work);
        work -= used;
        return std::move(speculative.parametrization);
    }

    std::vector<SpeculativeMerge>::iterator find_speculative(const MergeCandidate& merge) {
        return std::find_if(
            speculative_merges_.begin(), speculative_merges_.end(),
            [&](const SpeculativeMerge& t) { return t.merge.a == merge.a && t.merge.b == merge.b; });
    }

    void speculate(const MergeCandidate& first, std::uint64_t work) {
        std::erase_if(speculative_merges_, [&](const SpeculativeMerge& t) { return !is_valid(t.merge); });
        const std::size_t known = speculative_merges_.size(), most = known + thread_count(context_.threads);
        speculative_merges_.push_back({first, work, work, {}});
        std::vector<MergeCandidate> later;
        while (speculative_merges_.size() < most && !queue_.empty()) {
            const MergeCandidate merge = queue_.top();
            queue_.pop();
            if (!is_valid(merge)) continue;
            later.push_back(merge);
            if (find_speculative(merge) == speculative_merges_.end())
                speculative_merges_.push_back({merge, work, work, {}});
        }
        for (const MergeCandidate& merge : later) queue_.push(merge);
        parallel_each(speculative_merges_.size() - known, 1, context_, [&](std::size_t i) {
            SpeculativeMerge& made = speculative_merges_[known + i];
            made.parametrization = parametrize_merge(made.merge, made.left);
        });
    }

    Parametrization parametrize_merge(const MergeCandidate& merge, std::uint64_t& work) const {
        const std::vector<Index>&a = charts_[merge.a].faces, &b = charts_[merge.b].faces;
        std::vector<Index> faces;
        std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(faces));
        return parametrize(all_, std::move(faces), work);
    }

    void assign_faces(Index chart) {
        perimeters_.resize(charts_.size());
        for (Index f : charts_[chart].faces) chart_of_face_[f] = chart;
        for (Index f : charts_[chart].faces) {
            for (std::size_t c = 0; c < 3; ++c) {
                const Index other = all_[f].adjacent[c].triangle;
                if (other == no_index || chart_of_face_[other] != chart) perimeters_[chart] += length(f, c);
            }
        }
    }

    double length(Index f, std::size_t c) const {
        const Vec3 &a = all_[f].corners[(c + 1) % 3], &b = all_[f].corners[(c + 2) % 3];
        return all_[f].density * portable_length(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    }

    void enqueue_candidates(Index chart, Neighbours partners) {
        std::vector<std::pair<Index, double>> shared;
        for (Index f : charts_[chart].faces) {
            for (std::size_t c = 0; c < 3; ++c) {
                const Index other = all_[f].adjacent[c].triangle;
                if (other == no_index || all_[f].crease[c] || chart_of_face_[other] == chart) continue;
                if (partners == Neighbours::later && chart_of_face_[other] < chart) continue;
                shared.emplace_back(chart_of_face_[other], length(f, c));
            }
        }
        std::sort(shared.begin(), shared.end());
        for (std::size_t begin = 0, end; begin < shared.size(); begin = end) {
            double sum = 0;
            for (end = begin; end < shared.size() && shared[end].first == shared[begin].first; ++end)
                sum += shared[end].second;
            const Index other = shared[begin].first;
            const double share = sum / std::min(perimeters_[chart], perimeters_[other]);
            if (share > 0) queue_.push({share, std::min(chart, other), std::max(chart, other)});
        }
    }

    std::span<const PageTriangle> all_;
    std::vector<Chart> charts_;
    std::vector<Index> chart_of_face_;
    std::vector<double> perimeters_;  // by chart
    std::priority_queue<MergeCandidate> queue_;
    std::vector<SpeculativeMerge> speculative_merges_;  // attempts made ahead of time
    double page_side_;
    const engine::RunContext& context_;
};

}  // namespace

Charts make_charts(std::span<const PageTriangle> faces, const RunContext& context) {
    const std::vector<std::vector<Index>> regions = cluster_faces(faces, context);
    double texels = 0;
    for (const PageTriangle& face : faces) texels += wanted_texels(face);
    const double page_side = std::sqrt(texels);
    std::vector<Charts> by_region(regions.size());
    parallel_blocks(regions.size(), 1, context,
                    [&](std::size_t i, std::size_t, const RunContext& block_context) {
                        by_region[i] = parametrize_region(faces, regions[i], page_side, block_context);
                    });
    Charts result;
    for (Charts& region : by_region) {
        std::move(region.charts.begin(), region.charts.end(), std::back_inserter(result.charts));
        result.faces_over_work_limit += region.faces_over_work_limit;
    }
    result.charts = ChartMerging(faces, std::move(result.charts), page_side, context).run();
    std::ranges::sort(result.charts, {}, [](const Chart& chart) { return chart.faces.front(); });
    return result;
}

}  // namespace faqem::detail
