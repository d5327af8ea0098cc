#include "child.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "faqem/detail/base/stopwatch.hpp"

namespace faqem::bench {

namespace {

using nlohmann::json;

/// Limit of the elapsed time as a multiple of the limit of CPU time. On a busy machine a process mostly
/// waits.
constexpr unsigned elapsed_time_factor = 10;

struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

double peak_mebibytes() {
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

void limit(const Limits& limits) {
    const auto bytes = static_cast<rlim_t>(limits.gibibytes * 0x1p30);
    const rlimit memory = {bytes, bytes}, no_core = {0, 0};
    setrlimit(RLIMIT_AS, &memory);
    setrlimit(RLIMIT_CORE, &no_core);
    const rlimit seconds = {limits.seconds, limits.seconds + 1};
    setrlimit(RLIMIT_CPU, &seconds);
    alarm(elapsed_time_factor * limits.seconds);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
}

/// Writes the result as CBOR, or the text of an exception.
void work(std::FILE* file, const Simplify& simplify, const TriangleMesh& mesh, std::size_t target_faces,
          const Limits& limits) {
    ChildResult result = {"ok", Outcome(), 0, 0, 0};
    const double peak_before = peak_mebibytes();
    try {
        double spent = 0;
        for (unsigned run = 0; run < limits.max_runs && spent < limits.enough_time; ++run) {
            const double cpu_before = cpu_seconds();
            const detail::Stopwatch wall;
            Outcome outcome = simplify(mesh, target_faces);
            const double seconds = wall.seconds();
            spent += seconds;
            if (run == 0 || seconds < result.seconds) {
                result.seconds = seconds;
                result.cpu_seconds = cpu_seconds() - cpu_before;
                result.outcome = std::move(outcome);
            }
        }
    } catch (const std::exception& e) {
        result.status = std::string("refused: ") + (*e.what() ? e.what() : "exception");
    }
    alarm(0);
    result.peak_mebibytes = peak_mebibytes() - peak_before;
    const auto& [out, core_seconds, report] = *result.outcome;
    const auto bytes =
        json::to_cbor(json{result.status.substr(0, 209), result.seconds, result.cpu_seconds,
                           result.peak_mebibytes, core_seconds, report, out.positions, out.triangles});
    if (std::fwrite(bytes.data(), bytes.size(), 1, file) != 1 || std::fflush(file) != 0)
        throw std::runtime_error("cannot write the result of the child process");
}

ChildResult collect(std::FILE* file) {
    std::rewind(file);
    const json all = json::from_cbor(file);
    ChildResult result = {all[0], {}, 0, 0, 0};
    if (result.status != "ok") return result;
    result = {"ok", Outcome(), all[1], all[2], all[3]};
    result.outcome->core_seconds = all[4];
    result.outcome->report = all[5];
    all[6].get_to(result.outcome->mesh.positions);
    all[7].get_to(result.outcome->mesh.triangles);
    return result;
}

}  // namespace

ChildResult run_in_child(const Simplify& simplify, const TriangleMesh& mesh, std::size_t target_faces,
                         const Limits& limits) {
    const File file(std::tmpfile());
    if (!file) throw std::runtime_error("cannot create a temporary file");
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("cannot start a child process");
    if (child == 0) {
        int code = 1;
        try {
            limit(limits);
            work(file.get(), simplify, mesh, target_faces, limits);
            code = 0;
        } catch (...) {
        }
        _exit(code);  // skips destructors, which would flush copies of the parent's buffers
    }
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFSIGNALED(status)) {
        const int signal = WTERMSIG(status);
        const bool timeout = signal == SIGXCPU || signal == SIGALRM;
        return {timeout ? "timeout" : std::string("crash: ") + strsignal(signal), {}, 0, 0, 0};
    }
    if (WEXITSTATUS(status) != 0) return {"crash: exit " + std::to_string(WEXITSTATUS(status)), {}, 0, 0, 0};
    return collect(file.get());
}

}  // namespace faqem::bench
