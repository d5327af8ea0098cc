#include "cli/batch/supervisor.hpp"

#include <poll.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "asset/io/temporary_file.hpp"
#include "cli/batch/memory_queue.hpp"
#include "cli/batch/worker.hpp"
#include "cli/memory/memory_limit.hpp"
#include "cli/process/interrupt.hpp"
#include "faqem/detail/base/stopwatch.hpp"

namespace faqem::cli {

namespace {

constexpr int poll_milliseconds = 100;
/// A process is replaced after this number of models, so that memory that the allocator cannot return stays bounded.
constexpr std::size_t models_per_process = 100;
/// A request for this many bytes is granted only when no other memory is in use.
constexpr std::uint64_t all_memory = std::numeric_limits<std::uint64_t>::max();

/// Work of a process: simplifies the models it is told to.
void work_on_models(Channel& channel, const std::vector<BatchFile>& files, const BatchContext& work) {
    return_freed_memory();
    while (const std::optional<Json> request = channel.receive()) {
        const Overwrite overwrite = request->at("overwrite") ? Overwrite::yes : Overwrite::no;
        AskMemory ask_memory;
        if (!request->at("alone"))
            ask_memory = [&](std::uint64_t bytes) {
                channel.send({{"memory", bytes}});
                const std::optional<Json> answer = channel.receive();
                return answer ? answer->at("memory").get<std::uint64_t>() : 0;
            };
        channel.send(process_batch_file(files[request->at("model")], work, overwrite, ask_memory));
    }
}

/// A process and the model that it works on.
struct Slot {
    std::unique_ptr<Worker> worker;
    std::size_t models = 0;  ///< that the process has got
    bool has_model = false, has_begun = false, is_waiting = false, is_cancelled = false;
    std::size_t model = 0;
    bool alone = false, overwrite = false;
    detail::Stopwatch watch;  ///< since the process was told something
};

/// Runs the models of a batch, as many at a time as there are slots.
struct Supervisor {
    const std::vector<BatchFile>& files;
    const BatchContext& work;
    const BatchEvents& events;
    MemoryQueue memory{work.max_memory};
    std::vector<Slot> slots = std::vector<Slot>(work.jobs);
    std::size_t next_model = 0;  ///< the first one that was not begun

    void run() {
        do {
            for (std::size_t i = 0; i < slots.size(); ++i)
                if (!slots[i].has_model && next_model < files.size()) begin(i);
            grant_memory();
        } while (wait_for_messages());
    }

    /// Gives the next model to a process without one.
    void begin(std::size_t i) {
        if (is_interrupted()) {
            events.ended(next_model++, batch_line(exit_cancelled, "cancelled", "cancelled"));
            return;
        }
        Slot& slot = slots[i];
        slot.model = next_model++;
        slot.has_model = true;
        slot.has_begun = slot.is_cancelled = slot.alone = false;
        slot.overwrite = work.overwrite == Overwrite::yes;
        if (files[slot.model].crashes > 0)
            begin_alone(i);
        else
            tell_model(slot);
    }

    /// Begins a model, perhaps anew, in a new process, as soon as it can have all memory.
    void begin_alone(std::size_t i) {
        slots[i].worker.reset();
        slots[i].alone = true;
        wait_for_memory(i, all_memory);
    }

    void wait_for_memory(std::size_t i, std::uint64_t bytes) {
        memory.release(i);
        memory.request(i, bytes);
        slots[i].is_waiting = true;
    }

    void tell_model(Slot& slot) {
        if (slot.alone) announce(slot);
        if (slot.worker && slot.models >= models_per_process) slot.worker.reset();
        if (!slot.worker) {
            slot.worker =
                std::make_unique<Worker>([this](Channel& channel) { work_on_models(channel, files, work); });
            slot.models = 0;
        }
        ++slot.models;
        tell(slot, {{"model", slot.model}, {"alone", slot.alone}, {"overwrite", slot.overwrite}});
    }

    void announce(Slot& slot) {
        if (!std::exchange(slot.has_begun, true)) events.begun(slot.model);
    }

    static void tell(Slot& slot, const Json& message) {
        slot.watch = {};
        slot.worker->channel().send(message);
    }

    void grant_memory() {
        while (const std::optional<MemoryQueue::Grant> grant = memory.grant()) {
            Slot& slot = slots[grant->worker];
            slot.is_waiting = false;
            if (slot.alone)
                tell_model(slot);
            else
                tell(slot, {{"memory", std::min(grant->bytes, memory.limit())}});
        }
    }

    /// Waits until a process says something, ends or takes too long, for a short time. \return false if there are no
    /// more models
    bool wait_for_messages() {
        std::vector<pollfd> polled;
        std::vector<std::size_t> owners;
        for (std::size_t i = 0; i < slots.size(); ++i) {
            const Slot& slot = slots[i];
            if (!slot.has_model || slot.is_waiting) continue;
            polled.push_back({slot.worker->channel().descriptor(), POLLIN, 0});
            owners.push_back(i);
        }
        if (polled.empty()) return next_model < files.size();
        if (work.until_eof && !is_interrupted()) polled.push_back({STDIN_FILENO, POLLIN, 0});
        const int ready = ::poll(polled.data(), polled.size(), poll_milliseconds);
        if (char byte; polled.size() > owners.size() && polled.back().revents != 0 &&
                       ::read(STDIN_FILENO, &byte, 1) <= 0)
            std::raise(SIGTERM);
        for (std::size_t k = 0; k < owners.size(); ++k) {
            Slot& slot = slots[owners[k]];
            if (ready > 0 && polled[k].revents != 0)
                on_message(owners[k]);
            else if (slot.watch.seconds() > work.end_after)
                on_end(owners[k],
                       "did not end within " + std::to_string(std::lround(work.end_after)) + " seconds");
            else if (is_interrupted() && !std::exchange(slot.is_cancelled, true))
                slot.worker->cancel();
        }
        return true;
    }

    void on_message(std::size_t i) {
        Slot& slot = slots[i];
        std::optional<Json> message = slot.worker->channel().receive();
        if (!message) {
            on_death(i);
        } else if (message->contains("memory")) {
            announce(slot);
            // After a signal no model begins: the process sees it and needs no memory.
            wait_for_memory(i, is_interrupted() ? 0 : message->at("memory").get<std::uint64_t>());
        } else if (message->contains("retry")) {
            slot.overwrite = message->at("overwrite");
            begin_alone(i);
        } else {
            end_model(i, *message);
        }
    }

    void on_death(std::size_t i) {
        Slot& slot = slots[i];
        const int status = slot.worker->wait();
        if (WIFSIGNALED(status)) {
            const int number = WTERMSIG(status);
            on_end(
                i,
                "the process ended with signal " + std::to_string(number) + " (" + ::strsignal(number) + ")",
                number == SIGKILL);
        } else if (WEXITSTATUS(status) != exit_no_memory) {
            on_end(i, "the process ended with code " + std::to_string(WEXITSTATUS(status)));
        } else if (slot.alone) {
            end_model(i, batch_line(exit_no_memory, "failed", "not enough memory"));
        } else {
            remove_leftovers_of(slot);
            begin_alone(i);
        }
    }

    /// The process of a model has ended, or is to be killed, without a result.
    /// \param is_killed  by another process, as the kernel does when the memory of the machine is exhausted
    void on_end(std::size_t i, const std::string& how, bool is_killed = false) {
        Slot& slot = slots[i];
        slot.worker.reset();
        remove_leftovers_of(slot);
        Json line = batch_line(exit_internal, "failed", files[slot.model].in.string() + ": " + how);
        line["killed"] = is_killed;
        end_model(i, line);
    }

    void remove_leftovers_of(const Slot& slot) const {
        detail::remove_leftovers(files[slot.model].out.parent_path());
    }

    void end_model(std::size_t i, const Json& members) {
        memory.release(i);
        Slot& slot = slots[i];
        const NextStep next = events.ended(slot.model, members);
        if (next == NextStep::again_alone) {
            slot.has_begun = false;
            return begin_alone(i);
        }
        slot.has_model = false;
        if (next == NextStep::stop) next_model = files.size();
    }
};

}  // namespace

void process_batch(const std::vector<BatchFile>& files, const BatchContext& work, const BatchEvents& events) {
    Supervisor{files, work, events}.run();
}

}  // namespace faqem::cli
