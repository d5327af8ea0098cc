#include "cli/batch/worker.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>

#include "cli/process/interrupt.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

namespace {

/// Makes the process end with its parent, and be the first to be killed when the machine has no memory left.
void become_worker(pid_t parent) {
    install_worker_signal_handlers();
    ::prctl(PR_SET_PDEATHSIG, worker_end_signal);
    if (::getppid() != parent) ::_exit(0);  // the parent ended before the call
    std::ofstream("/proc/self/oom_score_adj") << "500";
}

}  // namespace

void Channel::send(const Json& message) {
    const std::string line = json_line(message);
    for (std::size_t sent = 0; sent < line.size();) {
        const ssize_t count = ::send(descriptor(), line.data() + sent, line.size() - sent, MSG_NOSIGNAL);
        if (count < 0 && errno != EINTR) return;
        if (count > 0) sent += static_cast<std::size_t>(count);
    }
}

std::optional<Json> Channel::receive() {
    for (std::size_t searched = 0;;) {
        const std::size_t end = unread_.find('\n', searched);
        if (end != std::string::npos) {
            Json message = Json::parse(unread_.substr(0, end));
            unread_.erase(0, end + 1);
            return message;
        }
        searched = unread_.size();
        char bytes[4096];
        const ssize_t count = ::recv(descriptor(), bytes, sizeof bytes, 0);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return std::nullopt;
        unread_.append(bytes, static_cast<std::size_t>(count));
    }
}

Worker::Worker(const std::function<void(Channel&)>& work) {
    const auto fail = [] {
        throw Error("cannot start a process for the models of the batch: " +
                    std::generic_category().message(errno));
    };
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) fail();
    channel_.emplace(ends[0]);
    const pid_t parent = ::getpid();
    process_ = ::fork();
    if (process_ == 0) {
        become_worker(parent);
        Channel channel(ends[1]);
        work(channel);
        ::_exit(0);
    }
    ::close(ends[1]);
    if (process_ < 0) {
        process_ = 0;
        fail();
    }
}

Worker::~Worker() {
    if (process_ == 0) return;
    ::kill(process_, SIGKILL);
    wait();
}

void Worker::cancel() {
    if (process_ != 0) ::kill(process_, worker_cancel_signal);
}

int Worker::wait() {
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = 0;
    return status;
}

}  // namespace faqem::cli
