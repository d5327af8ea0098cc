#include <benchmark/benchmark.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <map>

#include "allocations.hpp"
#include "faqem/compare.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "faqem/error.hpp"
#include "faqem/report_json.hpp"
#include "faqem/simplify.hpp"
#include "isosurface.hpp"
#include "simplifier.hpp"
#include "speed.hpp"
#include "wasm.hpp"

namespace faqem::bench {

namespace {

using Simplifier = std::function<Run(const FloatMesh&, std::size_t target_faces)>;

std::vector<Vec3> as_doubles(const std::vector<Vec3f>& positions) {
    std::vector<Vec3> all;
    all.reserve(positions.size());
    for (const Vec3f& p : positions) all.push_back({p[0], p[1], p[2]});
    return all;
}

Run run_meshoptimizer(const FloatMesh& in, std::size_t target_faces) {
    Run run;
    run.mesh.triangles.resize(in.triangles.size());
    Index* out = run.mesh.triangles.front().data();
    std::size_t indices = 0;
    {
        const PeakMemory memory;
        const double cpu = cpu_seconds();
        const detail::Stopwatch watch;
        indices = meshopt_simplify(out, in.triangles.front().data(), 3 * in.triangles.size(),
                                   in.positions.front().data(), in.positions.size(), sizeof(Vec3f),
                                   3 * target_faces, std::numeric_limits<float>::max(), 0, nullptr);
        run.seconds = watch.seconds();
        run.cpu_seconds = cpu_seconds() - cpu;
        run.bytes = memory.bytes();
    }
    run.mesh.triangles.resize(indices / 3);
    run.mesh.positions = as_doubles(in.positions);
    return run;
}

Run run_faqem(const FloatMesh& in, std::size_t target_faces, Options options) {
    options.target = faces(target_faces);
    const MeshView view = {.positions = in.positions, .triangles = in.triangles};
    const PeakMemory memory;
    const double cpu = cpu_seconds();
    const detail::Stopwatch watch;
    SimplifyResult result = simplify(view, options);
    Run run;
    run.seconds = watch.seconds();
    run.cpu_seconds = cpu_seconds() - cpu;
    run.bytes = memory.bytes();
    run.report = Json::parse(to_json(result.report));
    run.mesh = std::move(result.mesh);
    return run;
}

#ifdef FAQEM_BENCH_CGAL
Run run_cgal(const FloatMesh& in, std::size_t target_faces) {
    const TriangleMesh mesh = {as_doubles(in.positions), in.triangles, {}, {}};
    const double cpu = cpu_seconds();
    Outcome outcome = cgal_lindstrom_turk(mesh, target_faces);
    Run run;
    run.seconds = outcome.core_seconds;
    run.cpu_seconds = cpu_seconds() - cpu;
    run.mesh = std::move(outcome.mesh);
    return run;
}
#endif

Simplifier simplifier_of(const std::string& name) {
    if (name == "meshoptimizer") return run_meshoptimizer;
#ifdef FAQEM_BENCH_WASM
    if (is_wasm(name)) {
        return [name](const FloatMesh& mesh, std::size_t target) { return run_wasm(mesh, target, name); };
    }
#endif
#ifdef FAQEM_BENCH_CGAL
    if (name == "cgal-lt") return run_cgal;
#endif
    const std::size_t dash = name.find('-');
    Options options{.preset = preset_named(name.substr(0, dash))};
    const char *first = name.data() + std::min(dash, name.size() - 1) + 1, *end = name.data() + name.size();
    if (std::from_chars(first, end, options.threads).ptr != end || first == end)
        throw OptionError("simplifier " + name + ": expected PRESET-THREADS");
    return [options](const FloatMesh& mesh, std::size_t target) { return run_faqem(mesh, target, options); };
}

/// Collects the times of all repetitions by the name of the benchmark.
class Times : public benchmark::BenchmarkReporter {
public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<benchmark::BenchmarkReporter::Run>& runs) override {
        for (const auto& run : runs) {
            if (run.run_type != benchmark::BenchmarkReporter::Run::RT_Iteration) continue;
            if (run.error_occurred)
                errors[run.run_name.function_name] = run.error_message;
            else {
                seconds[run.run_name.function_name].push_back(run.GetAdjustedRealTime());
                cpu_seconds[run.run_name.function_name].push_back(run.counters.at("cpu"));
            }
        }
    }
    std::map<std::string, std::vector<double>> seconds, cpu_seconds;
    std::map<std::string, std::string> errors;
};

void add_run(Json& row, const FloatMesh& mesh, const Run& run, bool quality) {
    row["faces_out"] = run.mesh.triangles.size();
    if (run.bytes)
        row["peak_bytes_per_face"] =
            static_cast<double>(run.bytes) / static_cast<double>(mesh.triangles.size());
    if (!run.report.is_null()) row["phases"] = run.report["seconds"];
    if (!quality) return;
    const Comparison c = compare({.positions = mesh.positions, .triangles = mesh.triangles}, run.mesh.view(),
                                 {.tolerance = std::numeric_limits<double>::infinity()});
    row["chamfer"] = c.chamfer / (c.diagonal * c.diagonal);
    row["hausdorff"] = c.hausdorff / c.diagonal;
}

}  // namespace

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

FloatMesh float_mesh(const std::string& name, const TriangleMesh& mesh) {
    FloatMesh all = {name, {}, mesh.triangles};
    all.positions.reserve(mesh.positions.size());
    for (const Vec3& p : mesh.positions)
        all.positions.push_back(
            {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
    return all;
}

void measure_simplifiers(const FloatMesh& mesh, const SpeedOptions& options, const WriteRow& write) {
    const auto target = static_cast<std::size_t>(options.ratio * static_cast<double>(mesh.triangles.size()));
    FloatMesh other = mesh;
    shuffle(other.positions, other.triangles, 1);
    Times times;
    benchmark::ClearRegisteredBenchmarks();
    for (const std::string& name : options.simplifiers) {
        const Simplifier simplifier = simplifier_of(name);
        for (const FloatMesh* one : {&mesh, static_cast<const FloatMesh*>(&other)}) {
            const std::string label = (one == &mesh ? "file:" : "shuffled:") + name;
            benchmark::RegisterBenchmark(label.c_str(),
                                         [simplifier, one, target](benchmark::State& state) {
                                             for (auto _ : state) {
                                                 try {
                                                     const Run run = simplifier(*one, target);
                                                     state.SetIterationTime(run.seconds);
                                                     state.counters["cpu"] = run.cpu_seconds;
                                                 } catch (const std::exception& error) {
                                                     state.SkipWithError(error.what());
                                                     break;
                                                 }
                                             }
                                         })
                ->Iterations(1)
                ->Repetitions(options.repetitions)
                ->UseManualTime()
                ->Unit(benchmark::kSecond);
        }
    }
    benchmark::RunSpecifiedBenchmarks(&times);
    for (const std::string& name : options.simplifiers) {
        Json row = {
            {"mesh", mesh.name}, {"faces", mesh.triangles.size()}, {"target", target}, {"simplifier", name}};
        for (const char* order : {"file", "shuffled"}) {
            const std::string label = std::string(order) + ":" + name;
            if (times.errors.contains(label)) {
                row["error"] = times.errors[label];
            } else {
                row[order] = {{"median", median(times.seconds[label])},
                              {"cpu", median(times.cpu_seconds[label])},
                              {"all", times.seconds[label]}};
            }
        }
        if (!row.contains("error")) add_run(row, mesh, simplifier_of(name)(mesh, target), options.quality);
        write(row);
    }
}

}  // namespace faqem::bench
