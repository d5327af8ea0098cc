#pragma once
/// \file
/// The processes that simplify the models of a batch, so that a crash or a hang costs one model.

#include <sys/types.h>

#include <functional>
#include <optional>
#include <string>

#include "asset/io/descriptor.hpp"
#include "cli/process/json.hpp"

namespace faqem::cli {

/// One end of a connection over which a batch and a worker exchange JSON objects.
class Channel {
public:
    /// \param descriptor  of a stream socket; owned
    explicit Channel(int descriptor) : descriptor_(descriptor) {}

    int descriptor() const { return descriptor_.get(); }
    /// Sends an object. Nothing is sent if the other process has ended.
    void send(const Json& message);
    /// Waits for an object. \return nothing if the other process has ended
    std::optional<Json> receive();

private:
    detail::Descriptor descriptor_;
    std::string unread_;  // received bytes after the last returned line
};

/// A copy of this process that works for it. It ends with this process, and ignores SIGINT and SIGTERM, which a
/// terminal or a service manager sends to the whole group: this process tells it what to do.
class Worker {
public:
    /// Starts the process: it calls `work` and ends.
    /// \pre this process has one thread, since a copy made by fork() has no other
    /// \throws Error  the process cannot be started
    explicit Worker(const std::function<void(Channel&)>& work);
    /// Kills the process and removes nothing that it has written.
    ~Worker();

    Channel& channel() { return *channel_; }
    /// Makes is_interrupted() true in the process.
    void cancel();
    /// Waits for the end of a process that is ending. \return its status, as of waitpid()
    int wait();

private:
    pid_t process_ = 0;  ///< 0: ended
    std::optional<Channel> channel_;
};

}  // namespace faqem::cli
