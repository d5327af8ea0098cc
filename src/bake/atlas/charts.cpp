#include "bake/atlas/charts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <queue>
#include <tuple>
#include <utility>

#include "bake/atlas/parametrization.hpp"
#include "bake/atlas/segmentation.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "faqem/detail/base/parallel.hpp"

namespace faqem::detail {
namespace {

constexpr double most_stretch = 1.06;
// In flattenings of every face.
constexpr std::uint64_t work_per_region = 24, work_for_joins = 32;

double extent(const Chart& chart) {
    double low_x = HUGE_VAL, low_y = HUGE_VAL, high_x = -HUGE_VAL, high_y = -HUGE_VAL;
    for (const auto& t : chart.places) {
        for (const ChartPoint& p : t) {
            low_x = std::min(low_x, p.real());
            high_x = std::max(high_x, p.real());
            low_y = std::min(low_y, p.imag());
            high_y = std::max(high_y, p.imag());
        }
    }
    return std::hypot(high_x - low_x, high_y - low_y);
}

bool good(const Flattening& flattening, double longest) {
    return flattening.outcome == Flattening::Outcome::flat && flattening.chart.stretch <= most_stretch &&
           extent(flattening.chart) <= longest;
}

// One region's charts.
Charts lay_region(std::span<const ChartFace> all, const std::vector<Index>& region, double longest,
                  Poll poll) {
    Charts result;
    std::uint64_t work = work_per_region * flatten_work * region.size();
    std::vector<std::vector<Index>> waiting = {region};
    while (!waiting.empty()) {
        std::vector<Index> faces = std::move(waiting.back());
        waiting.pop_back();
        if (faces.size() > 1 && work == 0) {
            result.given_up += faces.size();
            for (Index f : faces) waiting.push_back({f});
            continue;
        }
        Flattening flattening = flatten(all, faces, work, poll);
        if (faces.size() == 1 || good(flattening, longest)) {
            result.charts.push_back(std::move(flattening.chart));
            continue;
        }
        const std::vector<Index>& turned = flattening.turned;
        if (!turned.empty() && 4 * turned.size() <= faces.size()) {
            std::vector<Index> rest;
            std::set_difference(faces.begin(), faces.end(), turned.begin(), turned.end(),
                                std::back_inserter(rest));
            for (const std::vector<Index>& part : {rest, turned}) {
                for (std::vector<Index>& group : connected_groups(all, part))
                    waiting.push_back(std::move(group));
            }
            continue;
        }
        for (std::vector<Index>& half : split_in_two(all, faces)) waiting.push_back(std::move(half));
    }
    return result;
}

// Joins charts, those first that share most of the smaller one's outline.
class Joining {
public:
    Joining(std::span<const ChartFace> all, std::vector<Chart> charts, double longest, Workers workers)
        : all_(all), charts_(std::move(charts)), of_face_(all.size()), longest_(longest), workers_(workers) {
        for (std::size_t i = 0; i < charts_.size(); ++i) own(static_cast<Index>(i));
        for (std::size_t i = 0; i < charts_.size(); ++i) offer(static_cast<Index>(i), Partners::later);
    }

    std::vector<Chart> run() {
        std::uint64_t work = work_for_joins * flatten_work * all_.size();
        while (!queue_.empty() && work > 0) {
            const Join join = queue_.top();
            queue_.pop();
            workers_.poll();
            if (!is_possible(join)) continue;
            Flattening flattening = laid(join, work);
            if (!good(flattening, longest_)) continue;
            charts_[join.a] = charts_[join.b] = {};
            charts_.push_back(std::move(flattening.chart));
            own(static_cast<Index>(charts_.size() - 1));
            offer(static_cast<Index>(charts_.size() - 1), Partners::all);
        }
        std::erase_if(charts_, [](const Chart& c) { return c.faces.empty(); });
        return std::move(charts_);
    }

private:
    struct Join {
        double share;
        Index a, b;

        bool operator<(const Join& o) const {  // the queue's top is its largest
            return std::tuple(share, o.a, o.b) < std::tuple(o.share, a, b);
        }
    };
    enum class Partners { later, all };
    struct Attempt {
        Join join;
        std::uint64_t allowed, left;  // of the work
        Flattening flattening;
    };

    bool is_possible(const Join& join) const {
        const std::size_t a = charts_[join.a].faces.size(), b = charts_[join.b].faces.size();
        return a > 0 && b > 0 && a + b <= most_faces_per_chart;
    }

    // Threads lay the next joins meanwhile: most of them will be wanted as they are.
    Flattening laid(const Join& join, std::uint64_t& work) {
        auto found = find_attempt(join);
        if (found == ahead_.end()) {
            look_ahead(join, work);
            found = find_attempt(join);
        }
        Attempt attempt = std::move(*found);
        ahead_.erase(found);
        const std::uint64_t used = attempt.allowed - attempt.left;
        // What met the limit of the work, or would now, is done with what is left.
        if (attempt.left == 0 || used >= work) return lay(join, work, workers_.poll);
        work -= used;
        return std::move(attempt.flattening);
    }

    std::vector<Attempt>::iterator find_attempt(const Join& join) {
        return std::find_if(ahead_.begin(), ahead_.end(),
                            [&](const Attempt& t) { return t.join.a == join.a && t.join.b == join.b; });
    }

    void look_ahead(const Join& first, std::uint64_t work) {
        std::erase_if(ahead_, [&](const Attempt& t) { return !is_possible(t.join); });
        const std::size_t known = ahead_.size(), most = known + thread_count(workers_.threads);
        ahead_.push_back({first, work, work, {}});
        std::vector<Join> later;
        while (ahead_.size() < most && !queue_.empty()) {
            const Join join = queue_.top();
            queue_.pop();
            if (!is_possible(join)) continue;
            later.push_back(join);
            if (find_attempt(join) == ahead_.end()) ahead_.push_back({join, work, work, {}});
        }
        for (const Join& join : later) queue_.push(join);
        parallel_blocks(ahead_.size() - known, 1, workers_,
                        [&](std::size_t begin, std::size_t end, Poll poll) {
                            for (std::size_t i = known + begin; i < known + end; ++i)
                                ahead_[i].flattening = lay(ahead_[i].join, ahead_[i].left, poll);
                        });
    }

    Flattening lay(const Join& join, std::uint64_t& work, Poll poll) const {
        const std::vector<Index>&a = charts_[join.a].faces, &b = charts_[join.b].faces;
        std::vector<Index> faces;
        std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(faces));
        return flatten(all_, std::move(faces), work, poll);
    }

    void own(Index chart) {
        workers_.poll(charts_[chart].faces.size());
        outline_.resize(charts_.size());
        for (Index f : charts_[chart].faces) of_face_[f] = chart;
        for (Index f : charts_[chart].faces) {
            for (std::size_t c = 0; c < 3; ++c) {
                const Index other = all_[f].across[c].triangle;
                if (other == no_index || of_face_[other] != chart) outline_[chart] += length(f, c);
            }
        }
    }

    double length(Index f, std::size_t c) const {
        const Vec3 &a = all_[f].corners[(c + 1) % 3], &b = all_[f].corners[(c + 2) % 3];
        return all_[f].density * std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    }

    void offer(Index chart, Partners partners) {
        std::vector<std::pair<Index, double>> shared;
        for (Index f : charts_[chart].faces) {
            for (std::size_t c = 0; c < 3; ++c) {
                const Index other = all_[f].across[c].triangle;
                if (other == no_index || all_[f].crease[c] || of_face_[other] == chart) continue;
                if (partners == Partners::later && of_face_[other] < chart) continue;
                shared.emplace_back(of_face_[other], length(f, c));
            }
        }
        std::sort(shared.begin(), shared.end());
        for (std::size_t begin = 0, end; begin < shared.size(); begin = end) {
            double sum = 0;
            for (end = begin; end < shared.size() && shared[end].first == shared[begin].first; ++end)
                sum += shared[end].second;
            const Index other = shared[begin].first;
            const double share = sum / std::min(outline_[chart], outline_[other]);
            if (share > 0) queue_.push({share, std::min(chart, other), std::max(chart, other)});
        }
    }

    std::span<const ChartFace> all_;
    std::vector<Chart> charts_;
    std::vector<Index> of_face_;
    std::vector<double> outline_;  // of the chart
    std::priority_queue<Join> queue_;
    std::vector<Attempt> ahead_;  // joins that may come next
    double longest_;
    Workers workers_;
};

}  // namespace

double wanted_texels(const ChartFace& face) {
    return engine::area_vector(engine::to_eigen(face.corners[0]), engine::to_eigen(face.corners[1]),
                               engine::to_eigen(face.corners[2]))
               .norm() /
           2 * face.density * face.density;
}

Charts make_charts(std::span<const ChartFace> faces, Workers workers) {
    const std::vector<std::vector<Index>> regions = grow_regions(faces, workers.poll);
    double texels = 0;
    for (const ChartFace& face : faces) texels += wanted_texels(face);
    const double longest = 0.9 * std::sqrt(texels);
    std::vector<Charts> laid(regions.size());
    parallel_blocks(regions.size(), 1, workers, [&](std::size_t begin, std::size_t end, Poll poll) {
        for (std::size_t i = begin; i < end; ++i) laid[i] = lay_region(faces, regions[i], longest, poll);
    });
    Charts result;
    for (Charts& region : laid) {
        std::move(region.charts.begin(), region.charts.end(), std::back_inserter(result.charts));
        result.given_up += region.given_up;
    }
    result.charts = Joining(faces, std::move(result.charts), longest, workers).run();
    std::sort(result.charts.begin(), result.charts.end(),
              [](const Chart& a, const Chart& b) { return a.faces.front() < b.faces.front(); });
    return result;
}

}  // namespace faqem::detail
