#include "asset/io/held_signals.hpp"

#include <atomic>

#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

constexpr int held_signals[] = {SIGHUP,  SIGINT,  SIGQUIT,   SIGTERM, SIGALRM,
                                SIGUSR1, SIGUSR2, SIGVTALRM, SIGPROF, SIGXCPU};

/// Number of threads that are replacing files; `ending` after begin_exit().
std::atomic<int> replacing = 0;
constexpr int ending = -1;
static_assert(std::atomic<int>::is_always_lock_free, "used in a signal handler");

}  // namespace

HeldSignals::HeldSignals() {
    sigset_t held;
    sigemptyset(&held);
    for (const int number : held_signals) sigaddset(&held, number);
    pthread_sigmask(SIG_BLOCK, &held, &before_);
    int count = replacing;
    do {
        if (count != ending) continue;
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
        throw WriteError("cannot write: the process is ending");
    } while (!replacing.compare_exchange_weak(count, count + 1));
}

HeldSignals::~HeldSignals() {
    --replacing;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

bool begin_exit() noexcept {
    int none = 0;
    return replacing.compare_exchange_strong(none, ending) || none == ending;
}

}  // namespace faqem::detail
