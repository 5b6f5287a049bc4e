#include "baraka/run/forced_end.h"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <utility>

#include "baraka/run/pace/interrupts.h"
#include "gateway/process/exit_status.h"
#include "gateway/process/standard_output.h"
#include "hal/node/exchange/foreign_call.h"
#include "hal/types/printable.h"
#include "hal/types/terminal_colours.h"

namespace baraka::run {
namespace {

using namespace std::chrono_literals;

constexpr auto kLookEvery = 50ms;
/// An interrupted run ends by itself between two exchanges. If an exchange takes longer than this,
/// the run is ended from outside.
constexpr auto kInterruptGrace = 2s;

}  // namespace

ForcedEnd::ForcedEnd(Conclude conclude) : conclude_(std::move(conclude)) {
  exit_watch_.emplace(
      [this](const gateway::runtime::ExitCall& call) { return status_of_end(call.text(), true); });
  watcher_ = std::thread([this] { watch(); });
}

ForcedEnd::~ForcedEnd() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  over_changed_.notify_all();
  watcher_.join();
}

void ForcedEnd::watch() {
  using Clock = std::chrono::steady_clock;
  std::optional<Clock::time_point> since;
  std::unique_lock lock(mutex_);
  while (!over_changed_.wait_for(lock, kLookEvery, [this] { return over_; })) {
    if (const auto fault = gateway::runtime::FaultWatch::held_fault()) {
      status_of_end(*fault, true);
      gateway::runtime::FaultWatch::end();
    }
    if (!pace::interrupted()) continue;
    if (!since) since = Clock::now();
    if (Clock::now() - *since >= kInterruptGrace) end_stuck_run();
  }
}

/// Does nothing unless the run's thread is inside a call; otherwise it notices the interrupt
/// itself.
void ForcedEnd::end_stuck_run() {
  const auto call = hal::node::exchange::seize_call();
  if (!call) return;
  gateway::runtime::leave(
      status_of_end(fmt::format("interrupted while waiting for {} of {}, called at {:.9f} s",
                                call->what, call->who, hal::to_seconds(call->at)),
                    false));
}

int ForcedEnd::status_of_end(const std::string& what, bool failed) {
  try {
    return gateway::process::with_output_written(conclude_(what, failed));
  } catch (const std::exception& e) {
    hal::print_line(hal::Tone::kMistake, "error: " + hal::printable_lines(e.what()));
    return gateway::process::kRunFailed;
  }
}

}  // namespace baraka::run
