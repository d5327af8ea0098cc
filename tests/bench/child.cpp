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
#include <stdexcept>

#include "faqem/detail/base/stopwatch.hpp"

namespace faqem::bench {

namespace {

/// Limit of the elapsed time as a multiple of the limit of CPU time. On a busy machine a process mostly
/// waits.
constexpr unsigned elapsed_time_factor = 10;

/// Fixed part of the data that the child writes; strings and arrays of the given sizes follow.
struct Header {
    double seconds, cpu_seconds, core_seconds, peak_mebibytes;
    std::uint64_t error, report, vertices, faces;
};

struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

void write(std::FILE* file, const void* data, std::size_t bytes) {
    if (bytes && std::fwrite(data, bytes, 1, file) != 1)
        throw std::runtime_error("cannot write the result of the child process");
}

void read(std::FILE* file, void* data, std::size_t bytes) {
    if (bytes && std::fread(data, bytes, 1, file) != 1)
        throw std::runtime_error("the result of the child process is truncated");
}

double cpu_seconds() {
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

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

void work(std::FILE* file, const Simplify& simplify, const TriangleMesh& mesh, std::size_t target_faces,
          const Limits& limits) {
    Header header = {};
    Outcome best;
    std::string error;
    const double peak_before = peak_mebibytes();
    try {
        double spent = 0;
        for (unsigned run = 0; run < limits.max_runs && spent < limits.enough_time; ++run) {
            const double cpu_before = cpu_seconds();
            const detail::Stopwatch wall;
            Outcome outcome = simplify(mesh, target_faces);
            const double seconds = wall.seconds();
            spent += seconds;
            if (run == 0 || seconds < header.seconds) {
                header.seconds = seconds;
                header.cpu_seconds = cpu_seconds() - cpu_before;
                best = std::move(outcome);
            }
        }
    } catch (const std::exception& e) {
        error = *e.what() ? e.what() : "exception";
    }
    alarm(0);
    header.peak_mebibytes = peak_mebibytes() - peak_before;
    header.core_seconds = best.core_seconds;
    header.error = error.size();
    header.report = best.report.size();
    header.vertices = best.mesh.positions.size();
    header.faces = best.mesh.triangles.size();
    write(file, &header, sizeof(header));
    write(file, error.data(), error.size());
    write(file, best.report.data(), best.report.size());
    write(file, best.mesh.positions.data(), header.vertices * sizeof(Vec3));
    write(file, best.mesh.triangles.data(), header.faces * sizeof(Triangle));
    std::fflush(file);
}

ChildResult collect(std::FILE* file) {
    std::rewind(file);
    Header header = {};
    read(file, &header, sizeof(header));
    std::string error(header.error, ' ');
    read(file, error.data(), error.size());
    if (!error.empty()) return {"refused: " + error.substr(0, 200), {}, 0, 0, 0};
    Outcome outcome;
    outcome.core_seconds = header.core_seconds;
    outcome.report.resize(header.report);
    read(file, outcome.report.data(), header.report);
    outcome.mesh.positions.resize(header.vertices);
    read(file, outcome.mesh.positions.data(), header.vertices * sizeof(Vec3));
    outcome.mesh.triangles.resize(header.faces);
    read(file, outcome.mesh.triangles.data(), header.faces * sizeof(Triangle));
    return {"ok", std::move(outcome), header.seconds, header.cpu_seconds, header.peak_mebibytes};
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
