#pragma once
/// \file
/// Handling of SIGINT and SIGTERM, on Windows of Ctrl-C, and of the signals for the workers of a batch.

#include <signal.h>

namespace faqem::cli {

/// Installs handlers for SIGINT and SIGTERM. The first signal sets the flag that is_interrupted() returns. A
/// second signal, or one received while an ExitOnInterrupt exists, removes temporary files and ends the
/// process with exit code 8, but never while files are being renamed. After outputs_complete() the first
/// signal is ignored, and a second one ends the process with exit code 0. Also ignores SIGXFSZ, so that a
/// file larger than the shell's limit is a failed write.
void install_signal_handlers();

#ifndef _WIN32
/// Sent to a worker of a batch: is_interrupted() becomes true; the process ends.
inline constexpr int worker_cancel_signal = SIGUSR1, worker_end_signal = SIGHUP;

/// Installs the handlers of a worker of a batch, for the signals above. The process ends as after a second signal:
/// without its temporary files, but never while files are being renamed. Ignores SIGINT and SIGTERM.
void install_worker_signal_handlers();
#endif

/// Returns whether a signal was received. May be called from any thread.
bool is_interrupted();

/// States that all files of the command are written, so that a signal no longer makes it fail.
/// Async-signal-safe.
void outputs_complete() noexcept;

/// While an object of this class exists, a signal ends the process immediately. For work that does not call
/// is_interrupted(): reading and writing files, loading libraries.
class ExitOnInterrupt {
public:
    ExitOnInterrupt();
    ~ExitOnInterrupt();
    ExitOnInterrupt(const ExitOnInterrupt&) = delete;
    ExitOnInterrupt& operator=(const ExitOnInterrupt&) = delete;
};

}  // namespace faqem::cli
