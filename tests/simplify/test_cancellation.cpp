#include <atomic>
#include <functional>
#include <stdexcept>
#include <thread>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/fitting/vertex_fitting.hpp"
#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/detail/measure/hausdorff.hpp"
#include "faqem/detail/simplify/preprocess.hpp"
#include "faqem/levels.hpp"
#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using engine::Cancelled;
using engine::RunContext;

namespace {

// Number of calls of the callback during `work`.
template <class Work>
std::size_t callback_calls(Work&& work, std::uint32_t threads = 1) {
    std::size_t count = 0;
    work(RunContext(threads, [&](Phase, double) { return ++count, Continue::yes; }));
    return count;
}

Options with(Preset preset, Target target) { return {.target = target, .preset = preset, .threads = 3}; }

using EntryPoint = std::function<Report(const Options&)>;

// Cancels, or throws, at some of the calls of the progress callback, and checks that no further call follows.
// Runs on one thread, since the number of calls while waiting for other threads depends on time.
// \param times  number of calls to try, spread over the whole work
void stop_anywhere(Options options, std::size_t times, const EntryPoint& entry_point) {
    options.threads = 1;
    std::size_t all = 0;
    options.progress = [&](Phase, double) { return ++all, Continue::yes; };
    CHECK(entry_point(options).stop != StopReason::cancelled);
    REQUIRE(all > 4);
    for (std::size_t stop = 1; stop <= all; stop += 1 + all / times) {
        std::size_t calls = 0;
        options.progress = [&](Phase, double) { return ++calls == stop ? Continue::cancel : Continue::yes; };
        CHECK(entry_point(options).stop == StopReason::cancelled);
        CHECK(calls == stop);
        calls = 0;
        options.progress = [&](Phase, double) {
            if (++calls == stop) throw std::runtime_error("from the callback");
            return Continue::yes;
        };
        CHECK_THROWS_WITH(entry_point(options), "from the callback");
        CHECK(calls == stop);
    }
}

}  // namespace

TEST_CASE("steps that may take long check for cancellation several times") {
    const TriangleMesh mesh = test::icosphere(6), coarse = test::icosphere(3);
    CHECK(callback_calls([&](const RunContext& context) {
              detail::preprocess(mesh.view(), detail::settings({}), context);
          }) >= 3);
    CHECK(callback_calls([&](const RunContext& context) {
              detail::Bvh(mesh.positions, mesh.triangles, context);
          }) >= mesh.triangles.size() / RunContext::interval);
    const detail::Surface from = detail::extract_surface(mesh.view()),
                          to = detail::extract_surface(coarse.view());
    const detail::Bvh tree_from(from.positions, from.triangles), tree_to(to.positions, to.triangles);
    for (const std::uint32_t threads : {1u, 3u}) {
        CHECK(callback_calls(
                  [&](const RunContext& context) {
                      detail::two_sided_hausdorff(from, tree_from, to, tree_to, {}, context);
                  },
                  threads) >= (threads == 1 ? 10 : 1));
        const std::vector<engine::Vector3> original = test::vectors(mesh), positions = test::vectors(coarse);
        const std::vector<std::uint8_t> fixed(positions.size(), 0);
        CHECK(callback_calls(
                  [&](const RunContext& context) {
                      detail::fit_vertices({original, mesh.triangles}, {positions, coarse.triangles}, fixed,
                                           0.3, detail::EdgeFlips::on, {}, context);
                  },
                  threads) >= 100);
    }
}

TEST_CASE("cancellation is checked after each block of a parallel loop") {
    int blocks = 0;
    CHECK(callback_calls([&](const RunContext& context) {
              detail::parallel_blocks(10, 3, context, [&](std::size_t, std::size_t) { ++blocks; });
          }) == 4);
    CHECK(blocks == 4);
}

TEST_CASE("the progress callback can cancel or throw in every phase and is not called again") {
    const TriangleMesh sphere = test::shaken(test::icosphere(4), 0.003, 1);
    const TriangleMesh before = sphere;
    const auto simplified = [&](const Options& options) { return simplify(sphere.view(), options).report; };
    stop_anywhere(with(Preset::qem, ratio(0.05)), 7, simplified);
    stop_anywhere(with(Preset::balanced, ratio(0.05)), 7, simplified);
    stop_anywhere(with(Preset::best, ratio(0.05)), 3, simplified);
    Options within = with(Preset::fast, {});
    within.max_error = of_diagonal(0.01);
    stop_anywhere(within, 5, simplified);
    for (const std::vector<Level>& levels : {std::vector<Level>{ratio(0.3), of_diagonal(0.02), faces(60)},
                                             std::vector<Level>{ratio(0.5), ratio(0.3), faces(60)}}) {
        stop_anywhere(with(Preset::fast, {}), 7, [&](const Options& options) {
            return simplify_levels(sphere.view(), levels, options).back().result.report;
        });
    }
    CHECK(sphere.positions == before.positions);
    CHECK(sphere.triangles == before.triangles);
}

TEST_CASE("cancelling before the first collapse gives an empty mesh with stop reason cancelled") {
    const TriangleMesh mesh = test::icosphere(5);
    Options options = with(Preset::best, ratio(0.1));
    options.progress = [](Phase phase, double) {
        CHECK(phase == Phase::weld);
        return Continue::cancel;
    };
    const SimplifyResult result = simplify(mesh.view(), options);
    CHECK(result.report.stop == StopReason::cancelled);
    CHECK(result.mesh.triangles.empty());
    CHECK(result.report.faces_in == mesh.triangles.size());
}

TEST_CASE("helper threads stop if the calling thread is cancelled") {
    std::atomic<int> stopped{0};
    int calls = 0;
    const RunContext context(3,
                             [&](Phase, double) { return ++calls == 3 ? Continue::cancel : Continue::yes; });
    // Blocks that end only by cancellation.
    const auto forever = [&](std::size_t, std::size_t, const RunContext& block_context) {
        struct Leaving {
            std::atomic<int>& count;
            ~Leaving() { ++count; }
        } leaving{stopped};
        while (true) block_context.count();
    };
    CHECK_THROWS_AS(detail::parallel_blocks(3, 1, context, forever), Cancelled);
    CHECK(stopped >= 1);
    CHECK(stopped <= 3);
    CHECK(calls == 3);
}

TEST_CASE("the calling thread checks for cancellation while it waits for helper threads") {
    const std::thread::id here = std::this_thread::get_id();
    const RunContext context(2, [&](Phase, double) {
        CHECK(std::this_thread::get_id() == here);
        return Continue::cancel;
    });
    std::atomic<bool> is_helped{false};
    CHECK_THROWS_AS(detail::parallel_blocks(2, 1, context,
                                            [&](std::size_t, std::size_t, const RunContext& block_context) {
                                                if (std::this_thread::get_id() != here) {
                                                    is_helped = true;
                                                    while (true) block_context.count();
                                                }
                                                while (!is_helped) std::this_thread::yield();
                                            }),
                    Cancelled);
}

TEST_CASE("an exception of the calling thread takes precedence over those of helper threads") {
    std::atomic<bool> has_begun{false}, has_thrown{false};
    const std::thread::id here = std::this_thread::get_id();
    CHECK_THROWS_WITH(detail::parallel_blocks(2, 1, 2,
                                              [&](std::size_t, std::size_t) {
                                                  if (std::this_thread::get_id() != here) {
                                                      while (!has_begun) std::this_thread::yield();
                                                      has_thrown = true;
                                                      throw std::runtime_error("helper");
                                                  }
                                                  has_begun = true;
                                                  while (!has_thrown) std::this_thread::yield();
                                                  throw std::runtime_error("caller");
                                              }),
                      "caller");
}
