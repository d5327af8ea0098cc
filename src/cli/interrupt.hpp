#pragma once
/// \file
/// SIGINT and SIGTERM.

namespace faqem::tool {

/// From now on a signal is noted, to be asked for with interrupted(). While nobody asks (see Unattended), or
/// when it comes a second time, it removes temporary files and ends the process with exit code 8. A file that
/// grows above the shell's limit becomes a failed write.
void handle_interrupts();

bool interrupted();

/// Alive while work is done that does not ask: reading and writing files, loading libraries.
class Unattended {
public:
    Unattended();
    ~Unattended();
    Unattended(const Unattended&) = delete;
    Unattended& operator=(const Unattended&) = delete;
};

}  // namespace faqem::tool
