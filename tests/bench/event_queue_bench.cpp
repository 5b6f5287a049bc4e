// The hold model of an event queue (Vaucher and Duval, "A comparison of simulation event list
// algorithms", 1975): a fixed number of pending events, each of which schedules its successor after
// an exponential delay of 1 ms in the mean. With `cancelled`, each also schedules a timeout and
// cancels that of its predecessor, so that half of what is scheduled never runs.
//
//   event_queue_bench [EVENTS [PENDING [plain|cancelled]]]
//
// Prints "key: value" lines; the rate counts events that ran, per second of user time.

#include <fmt/core.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/core/event_queue.h"

namespace {

constexpr std::uint64_t kAgents = 1000;

double user_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

class HoldModel {
 public:
  HoldModel(std::size_t pending, bool with_timeouts)
      : with_timeouts_(with_timeouts), timeouts_(with_timeouts ? pending : 0) {
    for (std::uint32_t i = 0; i < pending; ++i) schedule_next(i);
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

  void schedule_next(std::uint32_t i) {
    const hal::AgentId agent{static_cast<std::uint16_t>(1 + i % kAgents)};
    queue_.schedule(queue_.now() + delay(), sim::Rank::kRadio, agent, [this, i] { hop(i); });
    if (!with_timeouts_) return;
    // Later than the successor, which cancels it.
    timeouts_[i] = queue_.schedule(queue_.now() + hal::Duration{50'000'000} + delay(),
                                   sim::Rank::kNodeTimer, agent, [] {});
  }

  void hop(std::uint32_t i) {
    if (with_timeouts_) queue_.cancel(timeouts_[i]);
    schedule_next(i);
  }

  sim::EventQueue queue_;
  bool with_timeouts_;
  std::vector<sim::EventQueue::EventId> timeouts_;
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
