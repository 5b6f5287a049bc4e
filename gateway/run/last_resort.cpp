#include "gateway/run/last_resort.h"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <utility>

#include "gateway/exit_status.h"
#include "gateway/run/wall_pace.h"
#include "hal/exchange/foreign_call.h"
#include "hal/runtime/standard_output.h"
#include "hal/types/printable.h"
#include "hal/types/terminal_colours.h"

namespace gateway {
namespace {

using namespace std::chrono_literals;

constexpr auto kLookEvery = 50ms;
/// A run that is interrupted ends by itself between two exchanges; this is how long one may take.
constexpr auto kInterruptGrace = 2s;

}  // namespace

LastResort::LastResort(Conclude conclude) : conclude_(std::move(conclude)) {
  exit_watch_.emplace(
      [this](const hal::runtime::ExitCall& call) { return status_of_end(call.text(), true); });
  watcher_ = std::thread([this] { watch(); });
}

LastResort::~LastResort() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  over_changed_.notify_all();
  watcher_.join();
}

void LastResort::watch() {
  using Clock = std::chrono::steady_clock;
  std::optional<Clock::time_point> since;
  std::unique_lock lock(mutex_);
  while (!over_changed_.wait_for(lock, kLookEvery, [this] { return over_; })) {
    if (const auto fault = hal::runtime::FaultWatch::held_fault()) {
      status_of_end(*fault, true);
      hal::runtime::FaultWatch::end();
    }
    if (!interrupted()) continue;
    if (!since) since = Clock::now();
    if (Clock::now() - *since >= kInterruptGrace) end_stuck_run();
  }
}

/// Unless the run's thread is about its own business, and so about to notice by itself.
void LastResort::end_stuck_run() {
  const auto call = hal::exchange::seize_call();
  if (!call) return;
  hal::runtime::leave(
      status_of_end(fmt::format("interrupted while waiting for {} of {}, called at {:.9f} s",
                                call->what, call->who, hal::to_seconds(call->at)),
                    false));
}

int LastResort::status_of_end(const std::string& what, bool failed) {
  try {
    return hal::runtime::with_output_written(conclude_(what, failed));
  } catch (const std::exception& e) {
    hal::print_line(hal::Tone::kMistake, "error: " + hal::printable_lines(e.what()));
    return kRunFailed;
  }
}

}  // namespace gateway
