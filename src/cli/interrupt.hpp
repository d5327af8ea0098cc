#pragma once
/// \file
/// SIGINT and SIGTERM.

namespace faqem::cli {

/// From now on a signal is noted, to be asked for with is_interrupted(). While nobody asks (see ExitOnInterrupt), or
/// when it comes a second time, it removes temporary files and ends the process with exit code 8. A file that
/// grows above the shell's limit becomes a failed write.
void install_signal_handlers();

bool is_interrupted();

/// Alive while work is done that does not ask: reading and writing files, loading libraries.
class ExitOnInterrupt {
public:
    ExitOnInterrupt();
    ~ExitOnInterrupt();
    ExitOnInterrupt(const ExitOnInterrupt&) = delete;
    ExitOnInterrupt& operator=(const ExitOnInterrupt&) = delete;
};

}  // namespace faqem::cli
