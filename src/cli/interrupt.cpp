#include "cli/interrupt.hpp"

#include <signal.h>
#include <unistd.h>

#include <atomic>

#include "asset/file.hpp"
#include "cli/exit_code.hpp"

namespace faqem::tool {

namespace {

// Atomic: a batch asks on several threads.
std::atomic<int> signals = 0, unattended = 0;
static_assert(std::atomic<int>::is_always_lock_free, "used in a signal handler");

void on_signal(int) {
    if (unattended == 0 && signals == 0) {
        signals = 1;
        return;
    }
    detail::remove_temporary_files();
    _exit(exit_cancelled);
}

}  // namespace

void handle_interrupts() {
    struct sigaction action = {};
    action.sa_handler = on_signal;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    // A file above the limit of the shell (ulimit -f) is then a write that fails, not the end.
    action.sa_handler = SIG_IGN;
    sigaction(SIGXFSZ, &action, nullptr);
}

bool interrupted() { return signals != 0; }

Unattended::Unattended() {
    ++unattended;
    if (signals != 0) _exit(exit_cancelled);  // it came after the last question and before this
}
Unattended::~Unattended() { --unattended; }

}  // namespace faqem::tool
