#include "cli/process/interrupt.hpp"

#include <unistd.h>

#include <atomic>
#include <initializer_list>
#include <string_view>

#include "asset/io/temporary_file.hpp"
#include "cli/process/exit_code.hpp"
#include "faqem/detail/base/peak_memory.hpp"  // <windows.h>

namespace faqem::cli {

namespace {

// Atomic because a batch calls is_interrupted() on several threads.
std::atomic<int> signal_count = 0, exit_requests = 0;
static_assert(std::atomic<int>::is_always_lock_free, "used in a signal handler");

// Whether all files of the command are written; the result of the process is decided.
std::atomic<bool> outputs_are_complete = false;
static_assert(std::atomic<bool>::is_always_lock_free, "used in a signal handler");

/// Ends the process, unless a thread is replacing files: then the signal is seen by is_interrupted().
void exit_unless_replacing() {
    if (!detail::remove_temporary_files()) return;
    constexpr std::string_view said = "\nfaqem: cancelled\n";
    [[maybe_unused]] const auto count = ::write(STDERR_FILENO, said.data(), said.size());
    _exit(exit_cancelled);
}

void on_signal(int) {
    const int before = signal_count.exchange(1);
    if (outputs_are_complete) {
        if (before != 0) _exit(exit_ok);  // standard output may be blocked
        return;
    }
    if (exit_requests != 0 || before != 0) exit_unless_replacing();
}

#ifndef _WIN32
void on_worker_signal(int number) {
    signal_count = 1;
    if (number == worker_end_signal) exit_unless_replacing();
}

void set_handler(std::initializer_list<int> signals, void (*handler)(int)) {
    struct sigaction action = {};
    action.sa_handler = handler;
    for (const int number : signals) sigaction(number, &action, nullptr);
}
#endif

}  // namespace

#ifdef _WIN32
void install_signal_handlers() {
    SetConsoleCtrlHandler([](DWORD) -> BOOL { return on_signal(SIGINT), TRUE; }, TRUE);
}
#else
void install_signal_handlers() {
    set_handler({SIGINT, SIGTERM}, on_signal);
    // Ignored, so that a file larger than the limit of the shell (ulimit -f) is a failed write with an error
    // message.
    set_handler({SIGXFSZ}, SIG_IGN);
}

void install_worker_signal_handlers() {
    set_handler({worker_cancel_signal, worker_end_signal}, on_worker_signal);
    set_handler({SIGINT, SIGTERM}, SIG_IGN);
}
#endif

bool is_interrupted() { return signal_count != 0; }

void outputs_complete() noexcept {
    outputs_are_complete = true;
    signal_count = 0;
}

ExitOnInterrupt::ExitOnInterrupt() {
    ++exit_requests;
    // A signal may have been received since the last call of is_interrupted().
    if (signal_count != 0 && !outputs_are_complete) exit_unless_replacing();
}
ExitOnInterrupt::~ExitOnInterrupt() { --exit_requests; }

}  // namespace faqem::cli
