#include "cli/interrupt.hpp"

#include <signal.h>
#include <unistd.h>

#include <atomic>

#include "asset/io/temporary_file.hpp"
#include "cli/exit_code.hpp"

namespace faqem::cli {

namespace {

// Atomic because a batch calls is_interrupted() on several threads.
std::atomic<int> signal_count = 0, exit_requests = 0;
static_assert(std::atomic<int>::is_always_lock_free, "used in a signal handler");

void on_signal(int) {
    if (exit_requests == 0 && signal_count == 0) {
        signal_count = 1;
        return;
    }
    detail::remove_temporary_files();
    _exit(exit_cancelled);
}

}  // namespace

void install_signal_handlers() {
    struct sigaction action = {};
    action.sa_handler = on_signal;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    // Ignored, so that a file larger than the limit of the shell (ulimit -f) is a failed write with an error
    // message.
    action.sa_handler = SIG_IGN;
    sigaction(SIGXFSZ, &action, nullptr);
}

bool is_interrupted() { return signal_count != 0; }

ExitOnInterrupt::ExitOnInterrupt() {
    ++exit_requests;
    if (signal_count != 0) _exit(exit_cancelled);  // received since the last call of is_interrupted()
}
ExitOnInterrupt::~ExitOnInterrupt() { --exit_requests; }

}  // namespace faqem::cli
