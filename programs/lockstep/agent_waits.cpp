#include "programs/lockstep/agent_waits.h"

#include <fmt/format.h>
#include <linux/futex.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <span>
#include <stdexcept>
#include <utility>

namespace programs::lockstep {
namespace {

using netns::SlotState;
using netns::WaitKind;
using netns::WaitPage;
using netns::WaitSlot;

constexpr std::int64_t kMicrosecond = 1000, kMillisecond = 1'000'000, kSecond = 1'000'000'000;

std::int64_t wall_time() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecond + now.tv_nsec;
}

void futex_wake(std::atomic<std::uint32_t>& word) {
  syscall(SYS_futex, &word, FUTEX_WAKE, 1, nullptr, nullptr, 0);
}

bool sleeps(KernelState state) {
  return state == KernelState::kAsleep || state == KernelState::kStopped;
}

}  // namespace

AgentWaits::AgentWaits(WaitPage& page, Settings settings)
    : page_(page),
      settings_(std::move(settings)),
      tasks_(std::move(settings_.processes)),
      charge_(settings_.per_wake) {}

void AgentWaits::set_time(std::int64_t now) { page_.now.store(now); }

std::size_t AgentWaits::reserve() {
  const auto free = std::ranges::find_if(
      page_.slots, [](const WaitSlot& one) { return one.state.load() == SlotState::kFree; });
  if (free == page_.slots.end()) {
    throw std::runtime_error(
        fmt::format("{} has more than {} threads and timers, the most in "
                    "lock-step",
                    settings_.agent, WaitPage::kSlots));
  }
  const auto i = static_cast<std::size_t>(free - page_.slots.begin());
  free->deadline = netns::kNever;
  free->process = free->thread = 0;
  free->grant = free->expired = free->readings = 0;
  free->state = SlotState::kExpected;
  page_.used = std::max(page_.used.load(), static_cast<std::uint32_t>(i + 1));
  threads_[i] = {};
  threads_[i].is_program = true;
  return i;
}

void AgentWaits::started(std::size_t i, pid_t process) {
  std::int32_t unknown = 0;
  slot(i).process.compare_exchange_strong(unknown, process);
}

void AgentWaits::not_started(std::size_t i) {
  threads_[i] = {};
  slot(i).state = SlotState::kFree;
}

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

void AgentWaits::wait_for_event(std::uint32_t seen, std::int64_t longest) {
  const timespec time{0, longest};
  page_.is_awaited.store(1);
  if (page_.event.load() == seen)
    syscall(SYS_futex, &page_.event, FUTEX_WAIT, seen, &time, nullptr, 0);
  page_.is_awaited.store(0);
}

/// The parent of a process is told of its end after /proc shows it, under a lock that getpriority()
/// takes, too (exit_notify() of kernel/exit.c).
void AgentWaits::release(std::size_t i) {
  getpriority(PRIO_PGRP, 0);
  looks_at_parked_ = true;  // SIGCHLD
  WaitSlot& one = slot(i);
  if (one.thread.load() == one.process.load()) tasks_.forget(one.process.load());
  if (threads_[i].is_program) ended_.push_back(i);
  threads_[i] = {};
  const pid_t process = one.process.exchange(0);
  one.thread = 0;
  one.state = SlotState::kFree;
  if (process != 0) release_timers(process);
  wake(netns::kFileLockObject);
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

void AgentWaits::grant(std::size_t i) {
  ++counts_.turns;
  threads_[i].asleep_since = 0;
  threads_[i].is_in_unknown_call = false;
  running_since_ = wall_time();
  has_warned_ = false;
  slot(i).state.store(SlotState::kRunning);
  slot(i).grant.store(1);
  futex_wake(slot(i).grant);
}

/// Once it is, it stays so: whoever waits inside a wait is told, too.
bool AgentWaits::is_broken_off() {
  const std::int64_t now = wall_time();
  if (is_broken_off_ || now - asked_at_ < 50 * kMillisecond) return is_broken_off_;
  asked_at_ = now;
  is_broken_off_ = !settings_.may_go_on();
  return is_broken_off_;
}

bool AgentWaits::is_broken_off_meanwhile() {
  warn_of_long_run();
  return is_broken_off();
}

/// Whether something has to be waited for before the next thread may go on.
bool AgentWaits::is_unsettled(std::uint32_t seen) {
  if (is_one_running(seen)) return true;
  if (!release_ended()) return !are_all_asleep();
  wait_for_event(seen, 30 * kMicrosecond);
  return true;
}

std::optional<std::size_t> AgentWaits::next_turn(Turns turns) {
  const auto wants = [this](std::size_t i) { return slot(i).state.load() == SlotState::kWants; };
  std::size_t first = charge_.slot().value_or(0);
  if (!wants(first)) {
    charge_.drop();
    for (first = 0; first < used() && !wants(first);) ++first;
  }
  if (first == used()) return std::nullopt;
  if (turns == Turns::kFree) {
    charge_.drop();
  } else if (!charge_.is_paid(first, page_.now.load())) {
    return std::nullopt;
  }
  return first;
}

bool AgentWaits::settle(Turns turns) {
  running_since_ = wall_time();
  is_stirred_ = true;
  while (!is_broken_off()) {
    const std::uint32_t seen = page_.event.load();
    if (is_unsettled(seen)) continue;
    if (const auto next = next_turn(turns)) {
      grant(*next);
    } else if (page_.event.load() == seen && !looks_at_parked_) {
      return true;
    }
  }
  return false;
}

bool AgentWaits::is_one_waiting(std::uint64_t object) const {
  return std::any_of(page_.slots.begin(), page_.slots.begin() + static_cast<std::ptrdiff_t>(used()),
                     [object](const WaitSlot& one) {
                       return one.object.load() == object &&
                              one.state.load() == SlotState::kWaiting;
                     });
}

bool AgentWaits::wake_for_room() { return wake(netns::kRoomObject); }

bool AgentWaits::wake(std::uint64_t object) {
  bool is_one = false;
  for (std::size_t i = 0; i < used(); ++i) {
    WaitSlot& one = slot(i);
    if (one.object.load() != object || one.state.load() != SlotState::kWaiting) continue;
    one.state = SlotState::kWants;
    is_one = true;
  }
  return is_one;
}

std::vector<std::size_t> AgentWaits::take_ended() { return std::exchange(ended_, {}); }

}  // namespace programs::lockstep
