// Simplifies COUNT defective meshes to 1% with every preset: `faqem_soak COUNT [FIRST]`, beginning with
// number FIRST. Prints each failure with the number of its mesh, then a table. There is one worker thread per
// processor; each run uses one to three threads.

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "faqem/error.hpp"
#include "soak/check.hpp"
#include "soak/dirty_mesh.hpp"

using namespace faqem;

namespace {

constexpr double share = 0.01;

/// Counts of the results of one preset.
struct Row {
    std::uint64_t tried = 0;
    std::uint64_t refused = 0;    ///< invalid meshes
    std::uint64_t on_target = 0;  ///< the target was reached
    std::uint64_t stopped = 0;    ///< ended above the target
    std::uint64_t repaired = 0;   ///< degenerate or duplicate faces were removed
    std::uint64_t empty = 0;      ///< the result is empty, because no face had area
    std::uint64_t failed = 0;
    double outside = 0;  ///< largest distance of a vertex from the bounding box, in diagonals

    Row& operator+=(const Row& o) {
        tried += o.tried, refused += o.refused, on_target += o.on_target, stopped += o.stopped;
        repaired += o.repaired, empty += o.empty, failed += o.failed;
        outside = std::max(outside, o.outside);
        return *this;
    }
};

/// Simplifies one mesh and counts the result.
/// \return a description of the fault; empty if there is none
std::string run(const soak::DirtyMesh& dirty, const Options& options, Row& row) try {
    const SimplifyResult result = simplify(dirty.mesh.view(), options);
    if (dirty.is_invalid) return "the mesh is invalid, but was not refused";
    ++(result.report.stop == StopReason::reached_target ? row.on_target : row.stopped);
    row.repaired += result.report.faces_dropped > 0;
    row.empty += result.mesh.triangles.empty();
    row.outside = soak::outside_box(dirty.mesh, result.mesh);
    return soak::fault(dirty.mesh, share, result);
} catch (const InputError& error) {
    row.refused += dirty.is_invalid;
    return dirty.is_invalid ? "" : error.what();
} catch (const std::exception& error) {
    return error.what();
}

/// The results of all threads.
class Table {
public:
    void run_all(std::uint32_t number) {
        const soak::DirtyMesh dirty = soak::dirty_mesh(number);
        for (const Preset preset : all_presets) {
            Options options{.target = ratio(share), .preset = preset, .threads = 1 + number % 3};
            Row row;
            const std::string fault = run(dirty, options, row);
            row.tried = 1;
            row.failed = !fault.empty();
            const std::lock_guard lock(mutex_);
            rows_[static_cast<std::size_t>(preset)] += row;
            if (fault.empty()) continue;
            std::printf("%u (%s), %zu faces, %s: %s\n", number, dirty.description.c_str(),
                        dirty.mesh.triangles.size(), name(preset).data(), fault.c_str());
        }
    }

    /// Prints the table. \return true if nothing failed
    bool print() const {
        bool is_good = true;
        std::puts(
            "| preset | tried | refused | on target | stopped above | repaired | empty | failed | outside |\n"
            "|---|---|---|---|---|---|---|---|---|");
        for (const Preset preset : all_presets) {
            const Row& row = rows_[static_cast<std::size_t>(preset)];
            std::printf("| `%s` |", name(preset).data());
            for (const std::uint64_t number :
                 {row.tried, row.refused, row.on_target, row.stopped, row.repaired, row.empty, row.failed})
                std::printf(" %llu |", static_cast<unsigned long long>(number));
            std::printf(" %.2f |\n", row.outside);
            is_good = is_good && row.failed == 0;
        }
        return is_good;
    }

private:
    std::mutex mutex_;
    Row rows_[all_presets.size()];
};

}  // namespace

int main(int count, char** arguments) {
    if (count < 2) {
        std::fputs("usage: faqem_soak COUNT [FIRST]\n", stderr);
        return 2;
    }
    const auto number = [](const char* text) {
        return static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10));
    };
    const std::uint32_t first = count > 2 ? number(arguments[2]) : 0, end = first + number(arguments[1]);
    Table table;
    std::atomic<std::uint32_t> next = first;
    std::vector<std::thread> threads(std::max(1u, std::thread::hardware_concurrency()));
    for (std::thread& thread : threads) {
        thread = std::thread([&] {
            for (std::uint32_t i; (i = next++) < end;) table.run_all(i);
        });
    }
    for (std::thread& thread : threads) thread.join();
    return table.print() ? 0 : 1;
}
