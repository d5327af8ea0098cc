#pragma once
/// \file
/// Files are renamed without interruption: signals that would end the process are held meanwhile.

#include <signal.h>

namespace faqem::detail {

/// States that the calling thread is replacing files, and holds the signals that end a process by default and that users,
/// shells and timers send (HUP, INT, QUIT, TERM, ALRM, USR1, USR2 ...) for it: they are delivered at destruction. In a
/// process with several threads, another thread may receive such a signal; its handler should call
/// remove_temporary_files() and end the process only if that returns true.
class HeldSignals {
public:
    /// \throws WriteError  begin_exit() has returned true: the process is about to end
    HeldSignals();
    ~HeldSignals();
    HeldSignals(const HeldSignals&) = delete;
    HeldSignals& operator=(const HeldSignals&) = delete;

private:
    sigset_t before_;
};

/// Returns whether the process may end: no thread is replacing files. From then on none can begin to.
/// Async-signal-safe.
bool begin_exit() noexcept;

}  // namespace faqem::detail
