// The hold model of an event queue (Vaucher and Duval, "A comparison of simulation event list
// algorithms", 1975): a fixed number of pending events, each of which schedules its successor after
// an exponential delay of 1 ms in the mean. With `cancelled`, half of those pending are timeouts:
// each other event cancels the timeout that was set with it, and sets one of 50 ms with its
// successor, so that half of what is scheduled never runs.
//
//   event_queue_bench [EVENTS [PENDING [plain|cancelled]]]
//
// Prints "key: value" lines. The rate counts events that ran, per second of user time: with
// `cancelled`, an event that ran stands for two that were scheduled and one that was cancelled.

#include <fmt/core.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "sim/core/event_queue.h"

namespace {

constexpr std::uint64_t kAgents = 1000;
constexpr hal::Duration kTimeout{50'000'000};  // no delay is longer than 37 ms

double user_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

class HoldModel {
 public:
  HoldModel(std::size_t pending, bool with_timeouts) : with_timeouts_(with_timeouts) {
    const std::size_t chains = with_timeouts ? pending / 2 : pending;
    for (std::uint32_t i = 0; i < chains; ++i) schedule_next(i);
  }

  void run(std::uint64_t events) {
    while (queue_.executed() < events) queue_.run_next();
  }

 private:
  /// As cheap as the peer's, so that the queues are compared.
  hal::Duration delay() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    const double uniform = (static_cast<double>(state_ >> 11) + 1) * 0x1p-53;
    return hal::Duration{static_cast<std::int64_t>(-1e6 * std::log(uniform))};
  }

  void schedule_next(std::uint32_t chain) {
    const hal::AgentId agent{static_cast<std::uint16_t>(1 + chain % kAgents)};
    if (!with_timeouts_) {
      queue_.schedule(queue_.now() + delay(), sim::Rank::kRadio, agent,
                      [this, chain] { schedule_next(chain); });
      return;
    }
    const auto timeout =
        queue_.schedule(queue_.now() + kTimeout, sim::Rank::kNodeTimer, agent, [] {});
    queue_.schedule(queue_.now() + delay(), sim::Rank::kRadio, agent, [this, chain, timeout] {
      auto id = timeout;
      queue_.cancel(id);
      schedule_next(chain);
    });
  }

  sim::EventQueue queue_;
  bool with_timeouts_;
  std::uint64_t state_ = 88172645463325252ULL;
};

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t events = argc > 1 ? std::stoull(argv[1]) : 5'000'000;
  const std::size_t pending = argc > 2 ? std::stoull(argv[2]) : 100'000;
  const bool cancelled = argc > 3 && argv[3] == std::string("cancelled");
  HoldModel model(pending, cancelled);
  const double begin = user_seconds();
  model.run(events);
  const double user = user_seconds() - begin;
  fmt::print("events: {}\npending: {}\nuser_s: {:.3f}\nrate: {:.0f}\n", events, pending, user,
             static_cast<double>(events) / user);
}
