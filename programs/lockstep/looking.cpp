// What the kernel says of the threads: the part of AgentWaits that finds out whether all of them
// wait.
#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "programs/lockstep/agent_waits.h"
#include "programs/lockstep/wall_time.h"

namespace programs::lockstep {
namespace {

using netns::SlotState;
using netns::WaitKind;
using netns::WaitSlot;

bool sleeps(KernelState state) {
  return state == KernelState::kAsleep || state == KernelState::kStopped;
}

}  // namespace

KernelState AgentWaits::look(std::size_t i) {
  ++counts_.looks;
  WaitSlot& one = slot(i);
  Thread& thread = threads_[i];
  const pid_t process = one.process.load(), named = one.thread.load();
  if (named == netns::kNewThread)
    return tasks_.has_ended(process) ? KernelState::kGone : KernelState::kAwake;
  const pid_t number = named != 0 ? named : process;
  if (number == 0) return KernelState::kAwake;  // it begins
  if (thread.number != number) {
    thread.kernel = tasks_.find(process, number);
    thread.number = number;
  }
  const KernelState state = thread.kernel.look();
  if (state == KernelState::kGone) thread.number = 0;
  return state;
}

/// A thread that says that it runs, and sleeps, is in a call of which the library does not know
/// that it waits. For a short while that may be a lock inside the C library, whose owner is about
/// to give it back: a thread that begins or ends.
void AgentWaits::look_at_running(std::size_t i) {
  constexpr std::int64_t kSure = 200 * kMillisecond;
  Thread& thread = threads_[i];
  const SlotState before = slot(i).state.load();
  const KernelState state = look(i);
  if (slot(i).state.load() != before) return;
  if (state == KernelState::kGone) return release(i);
  if (state == KernelState::kAwake) {
    thread.asleep_since = 0;
    return;
  }
  if (state == KernelState::kStopped) return go_on_without(i);
  if (thread.asleep_since == 0) {
    thread.asleep_since = wall_time();
    return;
  }
  if (wall_time() - thread.asleep_since < kSure) return;
  const std::string what = fmt::format("{}: {} waits in {}, of which lock-step does not know",
                                       settings_.agent, thread.kernel.name(), thread.kernel.call());
  if (!settings_.allow_unknown) throw std::runtime_error(what);
  ++counts_.unknown;
  go_on_without(i);
}

void AgentWaits::go_on_without(std::size_t i) {
  threads_[i].is_in_unknown_call = true;
  auto running = SlotState::kRunning;
  slot(i).state.compare_exchange_strong(running, SlotState::kUnknown);
}

/// Whether it is in an unknown call, or stopped, still, so that the others need not wait for it.
bool AgentWaits::is_in_unknown_call(std::size_t i) {
  if (!threads_[i].is_in_unknown_call) return false;
  const KernelState state = look(i);
  if (state == KernelState::kGone) release(i);
  if (state != KernelState::kAwake) return true;
  if (slot(i).state.load() != SlotState::kUnknown) {
    threads_[i].is_in_unknown_call = false;
    threads_[i].asleep_since = 0;
  }
  return false;
}

bool AgentWaits::is_one_running(std::uint32_t seen) {
  bool is_one = false;
  for (std::size_t i = 0; i < used(); ++i) {
    const SlotState state = slot(i).state.load();
    const bool is_busy = state == SlotState::kRunning || state == SlotState::kExpected ||
                         state == SlotState::kUnknown;
    if (is_busy && !is_in_unknown_call(i)) is_one = true;
  }
  if (!is_one) return false;
  wait_for_event(seen, 500 * kMicrosecond);
  if (page_.event.load() != seen) return true;
  warn_of_long_run();
  for (std::size_t i = 0; i < used(); ++i) {
    const SlotState state = slot(i).state.load();
    if (state == SlotState::kRunning || state == SlotState::kExpected) look_at_running(i);
  }
  return true;
}

void AgentWaits::warn_of_long_run() {
  constexpr std::int64_t kLong = 4 * kSecond;
  if (has_warned_ || wall_time() - running_since_ < kLong) return;
  has_warned_ = true;
  for (std::size_t i = 0; i < used(); ++i) {
    if (slot(i).state.load() == SlotState::kExpected) {
      settings_.warn(
          fmt::format("{}: a program does not load libbaraka_lockstep.so", settings_.agent));
    }
    if (const std::string debugger = threads_[i].kernel.debugger(); !debugger.empty()) {
      settings_.warn(fmt::format("{}: {} is stopped by {}; virtual time stands until it goes on",
                                 settings_.agent, threads_[i].kernel.name(), debugger));
      continue;
    }
    if (slot(i).state.load() != SlotState::kRunning || look(i) == KernelState::kGone) continue;
    settings_.warn(
        fmt::format("{}: {} has run for {} s without waiting for anything; virtual time "
                    "stands until it does",
                    settings_.agent, threads_[i].kernel.name(), kLong / kSecond));
  }
}

/// @return whether some are still there.
bool AgentWaits::release_ended() {
  bool is_one = false;
  for (std::size_t i = 0; i < used(); ++i) {
    if (slot(i).state.load() != SlotState::kEnding) continue;
    if (look(i) == KernelState::kGone) {
      release(i);
    } else {
      is_one = true;
    }
  }
  return is_one;
}

/// Looks until it is, or its slot says something else. @return false: the latter.
bool AgentWaits::is_asleep(std::size_t i) {
  constexpr int kShortWaits = 16;
  const SlotState before = slot(i).state.load();
  for (int looks = 0; slot(i).state.load() == before; ++looks) {
    const std::uint32_t seen = page_.event.load();
    const KernelState state = look(i);
    if (slot(i).state.load() != before) break;
    if (sleeps(state)) return true;
    has_seen_awake_ = true;
    if (state == KernelState::kGone) {
      release(i);
      break;
    }
    // It may have to run on this thread's processor.
    wait_for_event(seen, (looks < kShortWaits ? 30 : 300) * kMicrosecond);
    if (looks > kShortWaits && is_broken_off_meanwhile()) break;
  }
  return false;
}

/// Once at least in each wait: what it waits for may have come before it began.
bool AgentWaits::is_to_be_seen(std::size_t i, bool looks_at_parked, bool is_stirred) const {
  const WaitSlot& one = page_.slots[i];
  const SlotState state = one.state.load();
  if (state == SlotState::kWants) return looks_at_parked;
  if (state != SlotState::kWaiting) return false;
  return looks_at_parked || (is_stirred && one.kind.load() == WaitKind::kInKernel) ||
         threads_[i].ticket != one.ticket.load();
}

bool AgentWaits::are_all_asleep() {
  const std::uint32_t signals = page_.signals.load();
  looks_at_parked_ = looks_at_parked_ || signals != signals_;
  signals_ = signals;
  const bool looks_at_parked = std::exchange(looks_at_parked_, false);
  const std::uint32_t stirs = page_.stirs.load();
  const bool is_stirred = is_stirred_ || looks_at_parked || stirs != stirs_;
  stirs_ = stirs;
  has_seen_awake_ = false;
  bool are_all = true;
  for (std::size_t i = 0; i < used(); ++i) {
    if (!is_to_be_seen(i, looks_at_parked, is_stirred)) continue;
    const std::uint64_t ticket = slot(i).ticket.load();
    if (is_asleep(i)) {
      threads_[i].ticket = ticket;
    } else {
      are_all = false;
    }
  }
  // A handler may have run in a thread that waits as before: it may have woken those that were
  // looked at before it.
  looks_at_parked_ = looks_at_parked_ || (looks_at_parked && has_seen_awake_);
  is_stirred_ = !are_all || looks_at_parked_;
  return !is_stirred_;
}

}  // namespace programs::lockstep
